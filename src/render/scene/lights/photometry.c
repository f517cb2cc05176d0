#include "render/scene/lights/photometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/file.h"
#include "points/base/text.h"
#include "points/base/vector3d.h"

enum { LARGEST = 1 << 26, MOST_ANGLES = 100000 };

static const double pi = 3.14159265358979323846;

typedef struct reader {
    const char *path, *at, *end;
    size_t line;
    aur_error *error;
} reader;

static aur_result fail(const reader *self, const char *text) {
    return aur_fail_at(self->error, (aur_location){self->path, self->line, 0}, AUR_ERROR_FORMAT, "%s", text);
}

/* The next line, without its line end; false at the end of the file. */
static bool next_line(reader *self, const char **line, size_t *length) {
    if (self->at >= self->end)
        return false;
    const char *const stop = memchr(self->at, '\n', (size_t)(self->end - self->at));
    *line = self->at;
    *length = (size_t)((stop != NULL ? stop : self->end) - self->at);
    self->at = stop != NULL ? stop + 1 : self->end;
    while (*length > 0 && (unsigned char)(*line)[*length - 1] <= ' ')
        --*length;
    ++self->line;
    return true;
}

/* The next number. Blanks, commas and line ends separate numbers; EULUMDAT may use decimal commas. */
static aur_result next_number(reader *self, const char *what, double *number) {
    char text[64];
    size_t length = 0;
    for (; self->at < self->end && ((unsigned char)*self->at <= ' ' || *self->at == ','); ++self->at)
        self->line += *self->at == '\n';
    while (self->at < self->end && (unsigned char)*self->at > ' ' && *self->at != ',' &&
           length + 1 < sizeof text)
        text[length++] = *self->at++;
    text[length] = '\0';
    const char *const after = aur_read_double(text, AUR_NUMBER_FINITE, number);
    if (length > 0 && after != NULL && *after == '\0')
        return AUR_OK;
    return aur_fail_at(self->error, (aur_location){self->path, self->line, 0}, AUR_ERROR_FORMAT,
                       length > 0 ? "%s expected (found '%s')" : "%s expected (the file ends)", what, text);
}

static aur_result next_numbers(reader *self, const char *what, size_t count, double *numbers) {
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = next_number(self, what, &numbers[i]);
    return result;
}

static aur_result allocate(const reader *self, aur_photometry *photometry) {
    const size_t cells = photometry->plane_count * photometry->angle_count;
    if (cells > LARGEST / 16)
        return fail(self, "the table has more than 4 million values");
    photometry->planes =
        malloc((photometry->plane_count + photometry->angle_count) * sizeof(double) + cells * sizeof(float));
    if (photometry->planes == NULL)
        return aur_fail_memory(self->error);
    photometry->angles = photometry->planes + photometry->plane_count;
    photometry->candela = (float *)(void *)(photometry->angles + photometry->angle_count);
    return AUR_OK;
}

/* Reads a count of angles. */
static aur_result read_count(reader *self, const char *what, size_t *count) {
    double number;
    const aur_result result = next_number(self, what, &number);
    if (result == AUR_OK && !(number >= 1.0 && number <= MOST_ANGLES && number == floor(number)))
        return aur_fail_at(self->error, (aur_location){self->path, self->line, 0}, AUR_ERROR_FORMAT,
                           "%s: a whole number from 1 to %d expected (found %g)", what, (int)MOST_ANGLES,
                           number);
    *count = (size_t)number;
    return result;
}

static aur_result check_angles(const reader *self, size_t count, const double *angles, const char *what) {
    for (size_t i = 1; i < count; ++i)
        if (!(angles[i] > angles[i - 1]))
            return aur_fail_at(self->error, (aur_location){self->path, self->line, 0}, AUR_ERROR_FORMAT,
                               "%s angles must ascend (found %g after %g)", what, angles[i], angles[i - 1]);
    return AUR_OK;
}

static aur_result read_table(reader *self, aur_photometry *photometry, double factor) {
    double value;
    aur_result result = AUR_OK;
    for (size_t i = 0; i < photometry->plane_count * photometry->angle_count && result == AUR_OK; ++i) {
        result = next_number(self, "a luminous intensity", &value);
        if (result == AUR_OK && value < 0.0)
            return fail(self, "luminous intensities must not be below 0");
        photometry->candela[i] = (float)(factor * value);
    }
    return result;
}

/* --- LM-63 */

static bool begins_with(const char *line, size_t length, const char *start) {
    return length >= strlen(start) && strncmp(line, start, strlen(start)) == 0;
}

/* Skips to the line TILT=, and past the data of TILT=INCLUDE, which do not apply to an upright luminaire.
 */
static aur_result skip_head(reader *self) {
    const char *line = NULL;
    size_t length = 0, count = 0;
    double unused;
    bool found = false;
    while (!found && next_line(self, &line, &length))
        found = begins_with(line, length, "TILT=");
    if (!found)
        return fail(self, "the line 'TILT=...' expected");
    ++self->line; /* start of the numbers */
    if (!begins_with(line, length, "TILT=INCLUDE"))
        return AUR_OK;
    aur_result result = next_number(self, "the lamp's orientation", &unused);
    if (result == AUR_OK)
        result = read_count(self, "the number of tilt angles", &count);
    for (size_t i = 0; i < 2 * count && result == AUR_OK; ++i)
        result = next_number(self, "a tilt angle or factor", &unused);
    return result;
}

/* Negative dimensions mark round openings. */
static void take_opening(aur_photometry *photometry, double unit, const double size[3]) {
    photometry->round = size[0] < 0.0 || size[1] < 0.0;
    photometry->width = unit * fabs(size[0]);
    photometry->length = unit * (size[1] == 0.0 && size[0] < 0.0 ? fabs(size[0]) : fabs(size[1]));
    photometry->height = unit * fabs(size[2]);
}

static aur_result read_ies(reader *self, aur_photometry *photometry) {
    double head[3], type = 0.0, rest[7] = {0.0}, unit;
    aur_result result = skip_head(self);
    if (result == AUR_OK)
        result = next_numbers(self, "lamps, lumens and a multiplier", 3, head);
    if (result == AUR_OK)
        result = read_count(self, "the number of vertical angles", &photometry->angle_count);
    if (result == AUR_OK)
        result = read_count(self, "the number of horizontal angles", &photometry->plane_count);
    if (result == AUR_OK)
        result = next_number(self, "the photometric type", &type);
    if (result == AUR_OK && type != 1.0 && type != 2.0 && type != 3.0)
        return fail(self, "the photometric type must be 1 (C), 2 (B) or 3 (A)");
    if (result == AUR_OK)
        result = next_number(self, "the unit", &unit);
    if (result == AUR_OK && unit != 1.0 && unit != 2.0)
        return fail(self, "the unit must be 1 (feet) or 2 (metres)");
    if (result == AUR_OK)
        result = next_numbers(self, "three dimensions, two factors and the watts", 6, rest);
    if (result != AUR_OK)
        return result;
    const double factor = head[2] * rest[3] * (rest[4] > 0.0 ? rest[4] : 1.0);
    if (!(factor > 0.0))
        return fail(self, "the multiplier and the ballast factor must be above 0");
    photometry->type = (aur_photometric_type)type;
    photometry->lumens = head[1] > 0.0 ? head[0] * head[1] : 0.0;
    take_opening(photometry, unit == 1.0 ? 0.3048 : 1.0, rest);
    result = allocate(self, photometry);
    if (result == AUR_OK)
        result = next_numbers(self, "a vertical angle", photometry->angle_count, photometry->angles);
    if (result == AUR_OK)
        result = check_angles(self, photometry->angle_count, photometry->angles, "vertical");
    if (result == AUR_OK)
        result = next_numbers(self, "a horizontal angle", photometry->plane_count, photometry->planes);
    if (result == AUR_OK)
        result = check_angles(self, photometry->plane_count, photometry->planes, "horizontal");
    return result == AUR_OK ? read_table(self, photometry, factor) : result;
}

/* --- EULUMDAT (Stockmar 1990): one value per line */

typedef struct eulumdat {
    double symmetry, planes, plane_step, angles, angle_step;
    double sizes[9]; /* of the luminaire, then of the opening, in millimetres */
    double conversion, lumens;
} eulumdat;

static aur_result line_number(reader *self, const char *what, double *number) {
    const char *line;
    size_t length;
    char text[64] = "";
    if (!next_line(self, &line, &length))
        return fail(self, "the file ends in its head");
    while (length > 0 && (unsigned char)*line <= ' ') {
        ++line;
        --length;
    }
    if (length < sizeof text)
        memcpy(text, line, length);
    for (char *c = text; *c != '\0'; ++c)
        *c = *c == ',' ? '.' : *c;
    const char *const after = aur_read_double(text, AUR_NUMBER_FINITE, number);
    return after != NULL && *after == '\0'
               ? AUR_OK
               : aur_fail_at(self->error, (aur_location){self->path, self->line, 0}, AUR_ERROR_FORMAT,
                             "%s expected (found '%s')", what, text);
}

static aur_result skip_lines(reader *self, size_t count) {
    const char *line;
    size_t length;
    for (size_t i = 0; i < count; ++i)
        if (!next_line(self, &line, &length))
            return fail(self, "the file ends in its head");
    return AUR_OK;
}

static aur_result read_sets(reader *self, eulumdat *head) {
    double sets = 0.0, lumens = 0.0;
    aur_result result = line_number(self, "the number of sets of lamps", &sets);
    if (result == AUR_OK && !(sets >= 1.0 && sets <= 100.0))
        return fail(self, "the number of sets of lamps must be from 1 to 100");
    for (size_t i = 0; i < (size_t)sets && result == AUR_OK; ++i) {
        result = skip_lines(self, 2);
        if (result == AUR_OK)
            result = line_number(self, "lumens of the lamps", &lumens);
        if (result == AUR_OK && i == 0) /* the other sets are alternatives */
            head->lumens = lumens;
        if (result == AUR_OK)
            result = skip_lines(self, 3);
    }
    return result == AUR_OK ? skip_lines(self, 10) : result;
}

static aur_result read_head(reader *self, eulumdat *head) {
    double *const first[] = {&head->symmetry, &head->planes, &head->plane_step, &head->angles,
                             &head->angle_step};
    double unused;
    aur_result result = skip_lines(self, 1);
    if (result == AUR_OK)
        result = line_number(self, "the type", &unused);
    for (size_t i = 0; i < 5 && result == AUR_OK; ++i)
        result = line_number(self, "symmetry, numbers and steps of angles", first[i]);
    if (result == AUR_OK)
        result = skip_lines(self, 5);
    for (size_t i = 0; i < 9 && result == AUR_OK; ++i)
        result = line_number(self, "a dimension", &head->sizes[i]);
    for (size_t i = 0; i < 2 && result == AUR_OK; ++i)
        result = line_number(self, "a percentage", &unused);
    if (result == AUR_OK)
        result = line_number(self, "the conversion factor", &head->conversion);
    if (result == AUR_OK)
        result = line_number(self, "the tilt", &unused);
    return result == AUR_OK ? read_sets(self, head) : result;
}

/* The number of planes stored, given the symmetry, and the first of them. */
static size_t planes_given(const eulumdat *head, size_t all, size_t *first) {
    *first = head->symmetry == 3.0 ? 3 * all / 4 : 0;
    return head->symmetry == 0.0   ? all
           : head->symmetry == 1.0 ? 1
           : head->symmetry == 4.0 ? all / 4 + 1
                                   : all / 2 + 1;
}

static aur_result read_eulumdat(reader *self, aur_photometry *photometry) {
    eulumdat head = {0};
    aur_result result = read_head(self, &head);
    if (result != AUR_OK)
        return result;
    ++self->line; /* start of the angles */
    if (!(head.symmetry >= 0.0 && head.symmetry <= 4.0) || head.symmetry != floor(head.symmetry))
        return fail(self, "the symmetry must be from 0 to 4");
    if (!(head.planes >= 1.0 && head.planes <= 721.0 && head.angles >= 2.0 && head.angles <= 361.0))
        return fail(self, "from 1 to 721 planes and 2 to 361 angles expected");
    if (!(head.lumens > 0.0) || !(head.conversion > 0.0))
        return fail(self, "the lumens of the lamps and the conversion factor must be above 0");
    const size_t all = (size_t)head.planes;
    size_t first;
    photometry->type = AUR_PHOTOMETRIC_C;
    photometry->plane_count = planes_given(&head, all, &first);
    photometry->angle_count = (size_t)head.angles;
    photometry->lumens = head.lumens;
    photometry->round = head.sizes[4] == 0.0;
    photometry->length = 1e-3 * fabs(head.sizes[3]);
    photometry->width = photometry->round ? photometry->length : 1e-3 * fabs(head.sizes[4]);
    result = allocate(self, photometry);
    double *const angles = result == AUR_OK ? malloc((all + 1) * sizeof *angles) : NULL;
    if (result == AUR_OK && angles == NULL)
        result = aur_fail_memory(self->error);
    if (result == AUR_OK)
        result = next_numbers(self, "an angle of a plane", all, angles);
    for (size_t i = 0; i < photometry->plane_count && result == AUR_OK;
         ++i) /* C continues past 360 back to the start */
        photometry->planes[i] = angles[(first + i) % all] + (first + i >= all ? 360.0 : 0.0);
    free(angles);
    if (result == AUR_OK)
        result = check_angles(self, photometry->plane_count, photometry->planes, "plane");
    if (result == AUR_OK)
        result = next_numbers(self, "an angle", photometry->angle_count, photometry->angles);
    if (result == AUR_OK)
        result = check_angles(self, photometry->angle_count, photometry->angles, "vertical");
    return result == AUR_OK ? read_table(self, photometry, head.conversion * head.lumens / 1000.0) : result;
}

/* --- reading either format */

/* LM-63 has the line TILT=; EULUMDAT does not. */
static bool is_ies(size_t size, const char *data) {
    if (begins_with(data, size, "IESNA"))
        return true;
    for (size_t i = 0; i + 5 <= size; ++i)
        if ((i == 0 || data[i - 1] == '\n') && memcmp(data + i, "TILT=", 5) == 0)
            return true;
    return false;
}

/* Whether the angles are those of a symmetry that both formats know. */
static aur_result check_range(const reader *self, const aur_photometry *photometry) {
    const double *const p = photometry->planes, *const a = photometry->angles;
    const double from = p[0], to = p[photometry->plane_count - 1], low = a[0],
                 high = a[photometry->angle_count - 1];
    const bool turns = photometry->type != AUR_PHOTOMETRIC_C;
    if (low < (turns ? -90.0 : 0.0) || high > (turns ? 90.0 : 180.0))
        return fail(self, turns ? "vertical angles must be from -90 to 90"
                                : "vertical angles must be from 0 to 180");
    if (turns)
        return (from == 0.0 || from == -90.0) && to <= 90.0
                   ? AUR_OK
                   : fail(self, "horizontal angles of types A and B must begin at 0 or -90 and end at 90");
    if (photometry->plane_count == 1 ||
        (from == 0.0 && (to == 90.0 || to == 180.0 || (to > 180.0 && to <= 360.0))) ||
        (to - from == 180.0 && (from == 90.0 || from == 270.0)))
        return AUR_OK;
    return fail(self, "horizontal angles must go from 0 to 90, 180 or 360, from 90 to 270, or be one");
}

aur_result aur_photometry_parse(const char *path, size_t size, const char *data, aur_photometry *photometry,
                                aur_error *error) {
    *photometry = (aur_photometry){.type = AUR_PHOTOMETRIC_C};
    reader self = {path, data, data + size, 0, error};
    photometry->ies = is_ies(size, data);
    aur_result result = photometry->ies ? read_ies(&self, photometry) : read_eulumdat(&self, photometry);
    if (result == AUR_OK)
        result = check_range(&self, photometry);
    if (result == AUR_OK && !(aur_photometry_flux(photometry) > 0.0))
        result = fail(&self, "the luminaire emits no light");
    if (result != AUR_OK)
        aur_photometry_release(photometry);
    return result;
}

aur_result aur_photometry_read(const char *path, aur_photometry *photometry, aur_error *error) {
    char *data = NULL;
    size_t size = 0;
    *photometry = (aur_photometry){.type = AUR_PHOTOMETRIC_C};
    aur_result result = aur_file_read(path, LARGEST, &data, &size, error);
    if (result == AUR_OK)
        result = aur_photometry_parse(path, size, data, photometry, error);
    free(data);
    return result;
}

void aur_photometry_release(aur_photometry *photometry) {
    free(photometry->planes);
    photometry->planes = NULL;
}

/* --- evaluation */

/* Finds the interval of ascending values that contains a value: its index, and the fraction within. False
 * outside of the range. */
static bool locate(size_t count, const double *values, double value, size_t *index, double *part) {
    *index = 0;
    *part = 0.0;
    if (value < values[0] || value > values[count - 1])
        return false;
    size_t low = 0, high = count - 1;
    while (high > low + 1) {
        const size_t mid = (low + high) / 2;
        *(values[mid] <= value ? &low : &high) = mid;
    }
    *index = low;
    *part = high > low ? (value - values[low]) / (values[high] - values[low]) : 0.0;
    return true;
}

/* Maps C into the range of the file's planes by symmetry. */
static double fold(const aur_photometry *photometry, double c) {
    const double from = photometry->planes[0], to = photometry->planes[photometry->plane_count - 1];
    if (photometry->plane_count == 1)
        return from;
    if (from == 0.0 && to <= 180.0) {
        c = c > 180.0 ? 360.0 - c : c;
        return to <= 90.0 && c > 90.0 ? 180.0 - c : c;
    }
    if (from == 90.0) /* mirror at the plane of 90 and 270 */
        return c < 90.0 ? 180.0 - c : c > 270.0 ? 540.0 - c : c;
    if (from == 270.0)
        return c >= 270.0 ? c : c <= 90.0 ? c + 360.0 : 540.0 - c;
    return c;
}

static double at_plane(const aur_photometry *photometry, size_t plane, size_t index, double part) {
    const float *const row = photometry->candela + plane * photometry->angle_count;
    const double first = (double)row[index];
    return part > 0.0 ? first + part * ((double)row[index + 1] - first) : first;
}

/* Interpolates between the last plane and the first, if the planes end before 360. */
static double between(const aur_photometry *photometry, double plane, size_t index, double part) {
    const size_t last = photometry->plane_count - 1;
    size_t at;
    double along;
    if (locate(photometry->plane_count, photometry->planes, plane, &at, &along)) {
        const double first = at_plane(photometry, at, index, part);
        return along > 0.0 ? first + along * (at_plane(photometry, at + 1, index, part) - first) : first;
    }
    if (photometry->type != AUR_PHOTOMETRIC_C)
        return 0.0;
    const double gap = 360.0 - photometry->planes[last];
    along = fmin(fmax((plane - photometry->planes[last]) / gap, 0.0), 1.0);
    return (1.0 - along) * at_plane(photometry, last, index, part) +
           along * at_plane(photometry, 0, index, part);
}

double aur_photometry_intensity(const aur_photometry *photometry, const double direction[3]) {
    const double length = aur_length3(direction), degrees = 180.0 / pi;
    const double x = direction[0] / length, y = direction[1] / length, z = direction[2] / length;
    double plane, angle, part;
    size_t index;
    if (photometry->type == AUR_PHOTOMETRIC_C) {
        plane = atan2(y, x) * degrees;
        plane = fold(photometry, plane < 0.0 ? plane + 360.0 : plane);
        angle = atan2(hypot(x, y), -z) * degrees;
    } else { /* the axes of Radiance's source.cal: vertical to +x, horizontal to -y */
        const bool a = photometry->type == AUR_PHOTOMETRIC_A;
        angle = (a ? asin(fmin(fmax(x, -1.0), 1.0)) : atan2(x, -z)) * degrees;
        plane = (a ? atan2(-y, -z) : asin(fmin(fmax(-y, -1.0), 1.0))) * degrees;
        plane = photometry->planes[0] == 0.0 ? fabs(plane) : plane;
        angle = photometry->angles[0] == 0.0 ? fabs(angle) : angle;
    }
    return locate(photometry->angle_count, photometry->angles, angle, &index, &part)
               ? between(photometry, plane, index, part)
               : 0.0;
}

/* The integral of a plane's intensity times sin(gamma): exact for the linear interpolation. */
static double zonal(const aur_photometry *photometry, double plane) {
    double sum = 0.0;
    for (size_t i = 0; i + 1 < photometry->angle_count; ++i) {
        const double a = photometry->angles[i] * pi / 180.0, b = photometry->angles[i + 1] * pi / 180.0;
        const double p = between(photometry, plane, i, 0.0), q = between(photometry, plane, i + 1, 0.0);
        const double slope = (q - p) / (b - a);
        sum += p * cos(a) - q * cos(b) + slope * (sin(b) - sin(a));
    }
    return sum;
}

double aur_photometry_flux(const aur_photometry *photometry) {
    const double from = photometry->planes[0], to = photometry->planes[photometry->plane_count - 1];
    double sum = 0.0;
    if (photometry->type == AUR_PHOTOMETRIC_C) {
        if (photometry->plane_count == 1)
            return 2.0 * pi * zonal(photometry, from);
        for (size_t i = 0; i + 1 < photometry->plane_count; ++i)
            sum += 0.5 * (photometry->planes[i + 1] - photometry->planes[i]) *
                   (zonal(photometry, photometry->planes[i]) + zonal(photometry, photometry->planes[i + 1]));
        const bool whole = from == 0.0 && to > 180.0;
        if (whole)
            sum += 0.5 * (360.0 - to) * (zonal(photometry, to) + zonal(photometry, from));
        return sum * 2.0 * pi / (whole ? 360.0 : to - from);
    }
    enum { STEPS = 256 };
    for (size_t i = 0; i < STEPS; ++i)
        for (size_t j = 0; j < STEPS; ++j) {
            const double z = -1.0 + 2.0 * ((double)i + 0.5) / STEPS,
                         turn = 2.0 * pi * ((double)j + 0.5) / STEPS;
            const double side = sqrt(1.0 - z * z);
            sum += aur_photometry_intensity(photometry,
                                            (const double[3]){side * cos(turn), side * sin(turn), z});
        }
    return sum * 4.0 * pi / (STEPS * STEPS);
}
