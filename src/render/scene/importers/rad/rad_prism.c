/* genprism MATERIAL NAME (N X1 Y1 ... | FILE) [-l X Y Z] [-r RADIUS] [-c] [-e]: an outline extruded along a
 * vector, optionally with rounded edges. */
#include <math.h>
#include <stdlib.h>

#include "render/scene/importers/rad/rad_reader.h"

enum { MOST_CORNERS = 1024 };

typedef struct prism {
    size_t count;
    double corners[MOST_CORNERS][2], way[3], radius;
    bool complete, open;
    /* For rounded edges: `side` is the reverse direction of the edge that ends at a corner, `turn` the
     * tangent of half the angle between the two edges there, and `rises` 1 or -1 for the sign of `way`. */
    double side[MOST_CORNERS][2], turn[MOST_CORNERS], rises;
} prism;

static aur_result take_corners(const aur_rad_generator *self, size_t size, const char *text, prism *shape) {
    aur_rad reading = {.at = text, .end = text + size, .line = 1};
    double *const numbers = shape->corners[0];
    aur_rad_word word;
    size_t count = 0;
    for (; aur_rad_next_word(&reading, &word); ++count)
        if (count == 2 * MOST_CORNERS || !aur_rad_number(word, &numbers[count]))
            return aur_rad_fail(self->rad, self->words[3].line, AUR_ERROR_FORMAT,
                                "genprism: '%.*s':%zu: x and y of at most %d corners expected",
                                (int)self->words[3].length, self->words[3].text, word.line,
                                (int)MOST_CORNERS);
    shape->count = count / 2;
    return count % 2 == 0 && count >= 6
               ? AUR_OK
               : aur_rad_fail(self->rad, self->words[3].line, AUR_ERROR_FORMAT,
                              "genprism: '%.*s': x and y of three corners or more expected (%zu numbers)",
                              (int)self->words[3].length, self->words[3].text, count);
}

static aur_result read_corners(aur_rad_generator *self, prism *shape) {
    double count = 0.0;
    if (!aur_rad_number(self->words[self->at], &count)) {
        char *text;
        size_t size;
        aur_result result = aur_rad_read_file(self->rad, self->words[self->at++], &text, &size);
        if (result == AUR_OK)
            result = take_corners(self, size, text, shape);
        free(text);
        return result;
    }
    ++self->at;
    if (!(count >= 3.0 && count <= MOST_CORNERS && count == floor(count)))
        return aur_rad_fail(self->rad, self->words[0].line, AUR_ERROR_FORMAT,
                            "genprism: the number of corners must be from 3 to %d", (int)MOST_CORNERS);
    shape->count = (size_t)count;
    return aur_rad_generator_numbers(self, "x and y of each corner", 2 * shape->count, shape->corners[0]);
}

static aur_result read_options(aur_rad_generator *self, prism *shape) {
    aur_result result = AUR_OK;
    while (result == AUR_OK && self->at < self->count) {
        const aur_rad_word word = self->words[self->at];
        const bool way = aur_rad_is_word(word, "-l"), round = aur_rad_is_word(word, "-r"),
                   ends = aur_rad_is_word(word, "-e");
        if (!way && !round && !ends && !aur_rad_is_word(word, "-c"))
            return aur_rad_generator_fail(self);
        ++self->at;
        if (way || round)
            result = aur_rad_generator_numbers(self, way ? "three numbers after -l" : "a radius after -r",
                                               way ? 3 : 1, way ? shape->way : &shape->radius);
        else
            *(ends ? &shape->open : &shape->complete) ^= true;
    }
    return result;
}

static aur_result add_ends(const aur_rad_generator *self, const prism *shape) {
    double end[3 * MOST_CORNERS];
    const size_t n = shape->count;
    aur_result result = AUR_OK;
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        for (size_t i = 0; i < n; ++i) {
            const double *const corner = shape->corners[k == 0 ? i : n - 1 - i];
            for (size_t d = 0; d < 3; ++d)
                end[3 * i + d] = (d < 2 ? corner[d] : 0.0) + (k == 0 ? 0.0 : shape->way[d]);
        }
        result = self->take(self->rad, "polygon", self->words[1], 3 * n, end);
    }
    return result;
}

static aur_result add_sides(const aur_rad_generator *self, const prism *shape) {
    const size_t n = shape->count;
    aur_result result = AUR_OK;
    for (size_t i = 0; i < (shape->complete ? n - 1 : n) && result == AUR_OK; ++i) {
        const double *const a = shape->corners[i], *const b = shape->corners[(i + 1) % n],
                            *const l = shape->way;
        double side[12] = {a[0],        a[1],        0.0,  a[0] + l[0], a[1] + l[1], l[2],
                           b[0] + l[0], b[1] + l[1], l[2], b[0],        b[1],        0.0};
        result = self->take(self->rad, "polygon", self->words[1], 12, side);
    }
    return result;
}

/* --- rounded edges, as Radiance's genprism.c */

static aur_result measure_turns(const aur_rad_generator *self, prism *shape) {
    const size_t n = shape->count, line = self->words[0].line;
    shape->rises = shape->way[2] < 0.0 ? -1.0 : 1.0;
    if (shape->radius > fabs(shape->way[2]))
        return aur_rad_fail(self->rad, line, AUR_ERROR_FORMAT,
                            "genprism: the radius after -r must be at most the height");
    for (size_t i = 0; i < n; ++i) {
        const double *const a = shape->corners[(i + n - 1) % n], *const b = shape->corners[i];
        const double x = a[0] - b[0], y = a[1] - b[1], length = hypot(x, y);
        if (!(length > 1e-7))
            return aur_rad_fail(self->rad, line, AUR_ERROR_FORMAT, "genprism: side %zu has no length", i + 1);
        shape->side[i][0] = x / length;
        shape->side[i][1] = y / length;
    }
    for (size_t i = 0; i < n; ++i) {
        const double *const a = shape->side[i], *const b = shape->side[(i + 1) % n];
        const double cosine = a[0] * b[0] + a[1] * b[1], sine = b[0] * a[1] - b[1] * a[0];
        if (!(1.0 + cosine > 1e-7))
            return aur_rad_fail(self->rad, line, AUR_ERROR_FORMAT,
                                "genprism: the sides at corner %zu lie on each other", i + 1);
        shape->turn[i] = 1.0 - cosine <= 0.0 ? 0.0 : copysign(sqrt((1.0 - cosine) / (1.0 + cosine)), sine);
    }
    shape->radius *= shape->rises;
    return AUR_OK;
}

/* The centre of the sphere at corner i, or of the start of the rounded end, at the base or top height. */
static void find_middle(const prism *shape, size_t i, bool top, double lifted, double point[3]) {
    const double *const u = shape->side[i], a = shape->turn[i], r = shape->radius;
    const double *const l = shape->way;
    point[0] = shape->corners[i][0] + r * (a * u[0] - u[1]) + (top ? l[0] : 0.0);
    point[1] = shape->corners[i][1] + r * (a * u[1] + u[0]) + (top ? l[1] : 0.0);
    point[2] = top ? l[2] - lifted : lifted;
}

static aur_result add_cylinder(const aur_rad_generator *self, const prism *shape, double numbers[7]) {
    numbers[6] = shape->rises * shape->radius;
    return self->take(self->rad, "cylinder", self->words[1], 7, numbers);
}

static aur_result add_round_end(const aur_rad_generator *self, const prism *shape, bool top) {
    double end[3 * MOST_CORNERS], edge[7], ball[4];
    const size_t n = shape->count;
    for (size_t i = 0; i < n; ++i)
        find_middle(shape, top ? n - 1 - i : i, top, 0.0, end + 3 * i);
    aur_result result = self->take(self->rad, "polygon", self->words[1], 3 * n, end);
    for (size_t i = 0; i < n && result == AUR_OK; ++i) {
        find_middle(shape, i, top, shape->radius, ball);
        ball[3] = shape->rises * shape->radius;
        if (shape->rises * shape->turn[i] > 0.0)
            result = self->take(self->rad, "sphere", self->words[1], 4, ball);
        find_middle(shape, (i + n - 1) % n, top, shape->radius, edge);
        find_middle(shape, i, top, shape->radius, edge + 3);
        if (result == AUR_OK)
            result = add_cylinder(self, shape, edge);
    }
    return result;
}

/* The flat part of the side from corner i to j, and the rounded edge at j. */
static aur_result add_round_side(const aur_rad_generator *self, const prism *shape, size_t i, size_t j) {
    const double *const u = shape->side[j], *const l = shape->way, r = shape->radius;
    const double length = sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
    const double sine = shape->rises * (l[1] * u[0] - l[0] * u[1]) / length;
    const double less = 1.0 - sqrt(1.0 - sine * sine);
    const double tilt[3] = {-less * u[1], less * u[0], sine};
    double side[12], edge[7];
    for (size_t k = 0; k < 4; ++k) {
        const bool far = k >= 2, top = k == 1 || k == 2;
        const double *const corner = shape->corners[far ? j : i];
        const double along = far ? shape->turn[j] : -shape->turn[i];
        for (size_t d = 0; d < 2; ++d)
            side[3 * k + d] = corner[d] + (top ? l[d] : 0.0) + r * (tilt[d] + along * u[d]);
        side[3 * k + 2] = (top ? l[2] : 0.0) + r * (tilt[2] + (top ? -1.0 : 1.0));
    }
    const aur_result result = self->take(self->rad, "polygon", self->words[1], 12, side);
    if (result != AUR_OK || shape->rises * shape->turn[j] < 0.0)
        return result;
    find_middle(shape, j, false, r, edge);
    find_middle(shape, j, true, r, edge + 3);
    return add_cylinder(self, shape, edge);
}

static aur_result add_rounded(const aur_rad_generator *self, prism *shape) {
    const size_t n = shape->count;
    aur_result result = measure_turns(self, shape);
    for (size_t k = 0; k < 2 && result == AUR_OK && !shape->open; ++k)
        result = add_round_end(self, shape, k == 1);
    for (size_t i = 0; i < (shape->complete ? n - 1 : n) && result == AUR_OK; ++i)
        result = add_round_side(self, shape, i, (i + 1) % n);
    return result;
}

aur_result aur_rad_generate_prism(aur_rad_generator *self) {
    prism *const shape = calloc(1, sizeof *shape);
    if (shape == NULL)
        return aur_fail_memory(self->rad->error);
    shape->way[2] = 1.0;
    aur_result result = read_corners(self, shape);
    if (result == AUR_OK)
        result = read_options(self, shape);
    if (result == AUR_OK && shape->radius > 1e-7)
        result = add_rounded(self, shape);
    else if (result == AUR_OK) {
        result = shape->open ? AUR_OK : add_ends(self, shape);
        if (result == AUR_OK)
            result = add_sides(self, shape);
    }
    free(shape);
    return result;
}
