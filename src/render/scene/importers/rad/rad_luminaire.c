/* Photometric luminaires as ies2rad writes them: brightdata by directions of source.cal on a light. */
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

enum { MOST_ANGLES = 4096 };

static const double PI = 3.14159265358979323846;

/* Radiance by direction: `factor` times values[planes][angles], divided by the cosine for flat sources. */
struct aur_rad_luminaire {
    bool flat;
    double factor;
    double turn[3][3]; /* columns: axes of the luminaire's frame in the world */
    size_t plane_count, angle_count;
    double *planes, *angles, *values; /* in the scene's arena */
    /* Of a spotlight: its axis in the world and the cosine of half its cone, and the distance of the focus
     * behind the surface; its frame follows from the surface. */
    bool spot;
    double aim[3], edge, focus;
};

static aur_result fail(const aur_rad *self, const aur_rad_primitive *item, const char *what) {
    return aur_rad_fail(self, item->type.line, AUR_ERROR_UNSUPPORTED, "%.*s: %s", (int)item->type.length,
                        item->type.text, what);
}

static bool next_number(aur_rad *reading, double *number) {
    aur_rad_word word;
    return aur_rad_next_word(reading, &word) && aur_rad_number(word, number);
}

/* One dimension of the file: begin, end and count. If begin and end are 0, the coordinates follow. */
static double *read_angles(aur_rad *self, aur_rad *reading, size_t *count) {
    double begin, end, number;
    if (!next_number(reading, &begin) || !next_number(reading, &end) || !next_number(reading, &number) ||
        !(number >= 1.0 && number <= MOST_ANGLES))
        return NULL;
    *count = (size_t)number;
    double *const angles = aur_arena_allocate(self->scene->arena, *count * sizeof *angles);
    for (size_t i = 0; i < *count && angles != NULL; ++i) {
        angles[i] = *count > 1 ? begin + (end - begin) * (double)i / (double)(*count - 1) : begin;
        if (begin == end && *count > 1 && !next_number(reading, &angles[i]))
            return NULL;
    }
    return angles;
}

static bool read_values(aur_rad *self, aur_rad *reading, struct aur_rad_luminaire *luminaire,
                        size_t dimensions) {
    static double zero[1];
    double number = 0.0;
    luminaire->plane_count = 1;
    luminaire->planes = zero;
    if (!next_number(reading, &number) || number != (double)dimensions)
        return false;
    if (dimensions == 2)
        luminaire->planes = read_angles(self, reading, &luminaire->plane_count);
    luminaire->angles = read_angles(self, reading, &luminaire->angle_count);
    if (luminaire->planes == NULL || luminaire->angles == NULL)
        return false;
    const size_t count = luminaire->plane_count * luminaire->angle_count;
    luminaire->values = aur_arena_allocate(self->scene->arena, count * sizeof *luminaire->values);
    for (size_t i = 0; i < count && luminaire->values != NULL; ++i)
        if (!next_number(reading, &luminaire->values[i]))
            return false;
    return luminaire->values != NULL;
}

/* Combines the rotations of the file's pose and the pattern's; scales are ignored. */
static aur_result take_turn(aur_rad *self, const aur_rad_primitive *item, size_t first,
                            struct aur_rad_luminaire *luminaire) {
    size_t used = 0;
    aur_result result = aur_rad_read_xform(self, item->string_count - first, item->strings + first, &used);
    if (result == AUR_OK && (used + first < item->string_count || self->pose_count != 1))
        result = fail(self, item, "options of xform expected after the angles");
    if (result == AUR_OK) {
        const aur_rad_pose pose = aur_rad_pose_multiply(&self->pose, &self->poses[0]);
        if (aur_rad_pose_mirrors(&pose))
            result = fail(self, item, "a mirrored luminaire is not read");
        for (size_t i = 0; i < 3; ++i)
            for (size_t k = 0; k < 3; ++k)
                luminaire->turn[i][k] = pose.m[4 * i + k] / pose.scale;
    }
    self->pose_count = 0;
    return result;
}

/* brightdata: flatcorr or corr, FILE, source.cal, [src_phi, src_phi2 or src_phi4] src_theta, xform options;
 * one number, the factor. */
aur_result aur_rad_add_distribution(aur_rad *self, const aur_rad_primitive *item,
                                    aur_rad_material *material) {
    const size_t count = item->string_count;
    const bool flat = count > 3 && aur_rad_is_word(item->strings[0], "flatcorr");
    const bool plain = count > 3 && aur_rad_is_word(item->strings[0], "corr");
    const size_t dimensions = count > 3 && aur_rad_is_word(item->strings[3], "src_theta") ? 1 : 2;
    if (!(flat || plain) || !aur_rad_is_word(item->strings[2], "source.cal") || count < 3 + dimensions ||
        (dimensions == 2 && (strncmp(item->strings[3].text, "src_phi", 7) != 0 ||
                             !aur_rad_is_word(item->strings[4], "src_theta"))))
        return fail(self, item,
                    "only corr and flatcorr by angles of source.cal are read, as ies2rad writes them");
    struct aur_rad_luminaire *const luminaire = aur_arena_allocate(self->scene->arena, sizeof *luminaire);
    if (luminaire == NULL)
        return aur_fail_memory(self->error);
    *luminaire =
        (struct aur_rad_luminaire){.flat = flat, .factor = item->number_count > 0 ? item->numbers[0] : 1.0};
    char *text;
    size_t size;
    aur_result result = aur_rad_read_file(self, item->strings[1], &text, &size);
    if (result != AUR_OK)
        return result == AUR_ERROR_OPEN ? AUR_ERROR_UNSUPPORTED : result; /* it may be unused */
    aur_rad reading = {.at = text, .end = text + size, .line = 1};
    if (!read_values(self, &reading, luminaire, dimensions))
        result = aur_rad_fail(self, item->strings[1].line, AUR_ERROR_FORMAT,
                              "'%.*s':%zu: a table of %zu dimensions expected", (int)item->strings[1].length,
                              item->strings[1].text, reading.line, dimensions);
    free(text);
    if (result == AUR_OK)
        result = take_turn(self, item, 3 + dimensions, luminaire);
    material->luminaire = luminaire;
    return result;
}

/* The opening: centre, area, and sizes along the luminaire's x and y; `round` for ellipses. */
typedef struct opening {
    double middle[3], area, sizes[2];
    bool round;
} opening;

/* A rectangle along the luminaire's axes. */
static bool measure_rectangle(const struct aur_rad_luminaire *luminaire, const aur_rad_primitive *item,
                              opening *measured) {
    const double *const p = item->numbers;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, twice[3] = {0.0};
    const size_t count = item->number_count / 3;
    for (size_t i = 0; i < count; ++i) {
        double cross[3];
        aur_cross3(p + 3 * i, p + 3 * ((i + 1) % count), cross);
        for (size_t d = 0; d < 3; ++d) {
            twice[d] += cross[d];
            measured->middle[d] += p[3 * i + d] / (double)count;
        }
        for (size_t k = 0; k < 2; ++k) {
            const double along = p[3 * i] * luminaire->turn[0][k] + p[3 * i + 1] * luminaire->turn[1][k] +
                                 p[3 * i + 2] * luminaire->turn[2][k];
            low[k] = fmin(low[k], along);
            high[k] = fmax(high[k], along);
        }
    }
    measured->area = 0.5 * aur_length3(twice);
    measured->sizes[0] = high[0] - low[0];
    measured->sizes[1] = high[1] - low[1];
    return count == 4 &&
           fabs(measured->sizes[0] * measured->sizes[1] - measured->area) <= 1e-3 * measured->area;
}

static bool measure(const aur_rad *self, const struct aur_rad_luminaire *luminaire,
                    const aur_rad_primitive *item, opening *measured) {
    const double *const x = item->numbers;
    const bool ring = strcmp(item->row->name, "ring") == 0, ball = strcmp(item->row->name, "sphere") == 0;
    *measured = (opening){.round = ring};
    if (strcmp(item->row->name, "polygon") == 0 && luminaire->flat && item->number_count % 3 == 0) {
        for (size_t i = 0; i < item->number_count / 3; ++i)
            aur_rad_pose_apply(&self->pose, 1.0, item->numbers + 3 * i);
        return measure_rectangle(luminaire, item, measured);
    }
    if (!(ring && luminaire->flat) && !(ball && !luminaire->flat))
        return false;
    memcpy(measured->middle, x, sizeof measured->middle);
    aur_rad_pose_apply(&self->pose, 1.0, measured->middle);
    const double inner = ring ? fmin(x[6], x[7]) : 0.0,
                 radius = self->pose.scale * (ring ? fmax(x[6], x[7]) : x[3]);
    measured->area = PI * radius * radius;
    measured->sizes[0] = measured->sizes[1] = ring ? 2.0 * radius : 0.0;
    return inner == 0.0 && radius > 0.0;
}

/* LM-63 stores intensities: radiance times projected area. */
static char *write_ies(const struct aur_rad_luminaire *luminaire, const opening *o, size_t *size) {
    char *text = NULL;
    FILE *const stream = open_memstream(&text, size);
    if (stream == NULL)
        return NULL;
    const double sign = o->round ? -1.0 : 1.0;
    aur_print(stream, "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 %zu %zu 1 2 %.9g %.9g 0\n1 1 0\n",
              luminaire->angle_count, luminaire->plane_count, sign * o->sizes[1], sign * o->sizes[0]);
    for (size_t i = 0; i < luminaire->angle_count; ++i)
        aur_print(stream, "%.9g\n", luminaire->angles[i]);
    for (size_t i = 0; i < luminaire->plane_count; ++i)
        aur_print(stream, "%.9g\n", luminaire->planes[i]);
    for (size_t i = 0; i < luminaire->plane_count * luminaire->angle_count; ++i)
        aur_print(stream, "%.9g\n", 179.0 * o->area * luminaire->factor * luminaire->values[i]);
    if (fclose(stream) == 0)
        return text;
    free(text);
    return NULL;
}

/* --- spotlights */

/* spotlight: R G B, the full angle of the cone in degrees, its axis. */
aur_result aur_rad_add_spotlight(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    const double *const x = item->numbers;
    struct aur_rad_luminaire *const luminaire = aur_arena_allocate(self->scene->arena, sizeof *luminaire);
    if (luminaire == NULL)
        return aur_fail_memory(self->error);
    *luminaire = (struct aur_rad_luminaire){.factor = 1.0, .spot = true, .aim = {x[4], x[5], x[6]}};
    aur_rad_pose_apply(&self->pose, 0.0, luminaire->aim);
    luminaire->focus = aur_normalize3(luminaire->aim);
    if (!(x[3] >= 0.01 && x[3] <= 360.0) || !(luminaire->focus > 0.0) ||
        !(fmin(fmin(x[0], x[1]), x[2]) >= 0.0))
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "spotlight: R G B of 0 or more, an angle from .01 to 360 degrees, and a "
                            "direction expected");
    luminaire->edge = cos(0.5 * x[3] * PI / 180.0);
    memcpy(material->radiance, x, sizeof material->radiance);
    material->luminaire = luminaire;
    material->emits = true;
    return AUR_OK;
}

/* The frame of a spotlight on a surface: -z along its normal, x along the first edge of a polygon. */
static bool set_frame(const aur_rad *self, const aur_rad_primitive *item,
                      struct aur_rad_luminaire *luminaire) {
    double x[3] = {0.0}, y[3], z[3];
    memcpy(z, luminaire->aim, sizeof z);
    luminaire->flat = strcmp(item->row->name, "sphere") != 0;
    if (strcmp(item->row->name, "polygon") == 0 && item->number_count >= 9) {
        const double *const p = item->numbers;
        for (size_t d = 0; d < 3; ++d) {
            x[d] = p[3 + d] - p[d];
            y[d] = p[6 + d] - p[3 + d];
        }
        aur_cross3(x, y, z);
        aur_rad_pose_apply(&self->pose, 0.0, x);
    } else if (strcmp(item->row->name, "ring") == 0) {
        memcpy(z, item->numbers + 3, sizeof z);
    } else if (luminaire->flat) {
        return false;
    }
    if (luminaire->flat)
        aur_rad_pose_apply(&self->pose, 0.0, z);
    const double sign = self->pose.inverts ? 1.0 : -1.0;
    if (!(aur_normalize3(z) > 0.0))
        return false;
    if (aur_normalize3(x) > 0.0)
        aur_cross3(x, z, y);
    else
        aur_frame3(z, x, y);
    for (size_t d = 0; d < 3; ++d)
        z[d] *= luminaire->flat ? sign : -1.0;
    aur_cross3(z, x, y);
    for (size_t d = 0; d < 3; ++d) {
        luminaire->turn[d][0] = x[d];
        luminaire->turn[d][1] = y[d];
        luminaire->turn[d][2] = z[d];
    }
    return true;
}

/* Within the cone, radiance 1: intensities are exact up to interpolation about the normal. Otherwise the edge
 * is blurred within a degree. */
static aur_result fill_cone(aur_rad *self, struct aur_rad_luminaire *luminaire) {
    enum { ABOUT = 360, STEPS = 180, RINGS = 64 };
    double(*const t)[3] = luminaire->turn;
    const double half = acos(luminaire->edge) * 180.0 / PI;
    const double along =
        -(t[0][2] * luminaire->aim[0] + t[1][2] * luminaire->aim[1] + t[2][2] * luminaire->aim[2]);
    const double last = luminaire->flat ? 90.0 : 180.0;
    const bool aligned = along > 1.0 - 1e-9, closed = half >= last - 1e-3;
    luminaire->plane_count = aligned ? 1 : ABOUT + 1;
    luminaire->angle_count = !aligned ? STEPS + 1 : RINGS + (closed ? 1 : 3);
    double *const numbers =
        aur_arena_allocate(self->scene->arena, (luminaire->plane_count + luminaire->angle_count +
                                                luminaire->plane_count * luminaire->angle_count) *
                                                   sizeof *numbers);
    if (numbers == NULL)
        return aur_fail_memory(self->error);
    luminaire->planes = numbers;
    luminaire->angles = numbers + luminaire->plane_count;
    luminaire->values = luminaire->angles + luminaire->angle_count;
    for (size_t i = 0; i < luminaire->plane_count; ++i)
        luminaire->planes[i] = (double)i;
    for (size_t i = 0; i < luminaire->angle_count; ++i)
        luminaire->angles[i] = !aligned        ? last / STEPS * (double)i
                               : i <= RINGS    ? fmin(half, last) / RINGS * (double)i
                               : i > RINGS + 1 ? last
                                               : half + 1e-4;
    for (size_t i = 0; i < luminaire->plane_count * luminaire->angle_count; ++i) {
        const size_t ring = i % luminaire->angle_count;
        const double c = luminaire->planes[i / luminaire->angle_count] * PI / 180.0,
                     g = luminaire->angles[ring] * PI / 180.0;
        double cosine = 0.0;
        for (size_t d = 0; d < 3; ++d)
            cosine += (sin(g) * (cos(c) * t[d][0] + sin(c) * t[d][1]) - cos(g) * t[d][2]) * luminaire->aim[d];
        const bool within = aligned ? ring <= RINGS : cosine >= luminaire->edge;
        luminaire->values[i] = !within ? 0.0 : luminaire->flat ? fmax(cos(g), 0.0) : 1.0;
    }
    return AUR_OK;
}

aur_result aur_rad_add_luminaire(aur_rad *self, const aur_rad_primitive *item,
                                 const aur_rad_material *material) {
    struct aur_rad_luminaire spot = *material->luminaire;
    const struct aur_rad_luminaire *const luminaire = &spot;
    aur_nodes *const nodes = self->nodes;
    opening measured;
    if (spot.spot && !set_frame(self, item, &spot))
        return fail(self, item, "a spotlight on a rectangle, a ring or a sphere expected, with a normal");
    const aur_result result = spot.spot ? fill_cone(self, &spot) : AUR_OK;
    if (result != AUR_OK)
        return result;
    double most = spot.spot ? 0.0 : 1.0;
    for (size_t i = 0; i < spot.plane_count * spot.angle_count && spot.spot; ++i)
        most = fmax(most, spot.values[i]);
    if (!(most > 0.0))
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "the cone of the spotlight is behind its surface: turn one of them");
    if (!measure(self, luminaire, item, &measured))
        return fail(self, item,
                    "a measured luminaire is read on a polygon (a rectangle along its axes) or ring with "
                    "flatcorr, or on "
                    "a sphere with corr; a spotlight on a rectangle, a ring without a hole or a sphere");
    size_t size = 0;
    char *const text = write_ies(luminaire, &measured, &size);
    if (text == NULL)
        return aur_fail_memory(self->error);
    const double *const m = measured.middle;
    double(*const t)[3] = spot.turn;
    const double matrix[16] = {t[0][0], t[0][1], t[0][2], m[0], t[1][0], t[1][1], t[1][2], m[1],
                               t[2][0], t[2][1], t[2][2], m[2], 0.0,     0.0,     0.0,     1.0};
    aur_xml_node *const emitter = aur_node_object(nodes, self->parent, "emitter", "photometric");
    aur_node_property(nodes, emitter, "string", "text", "%s", text);
    aur_node_numbers(nodes, emitter, "rgb", "color", 3, material->radiance);
    if (spot.spot)
        aur_node_property(nodes, emitter, "float", "focus", "%.9g", spot.focus);
    aur_xml_node *const to_world = aur_node_add(nodes, emitter, "transform");
    aur_node_set(nodes, to_world, "name", "to_world");
    aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "matrix"), "value", 16, matrix);
    free(text);
    return nodes->result;
}
