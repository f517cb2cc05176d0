/* Built-in equivalents of the commands genbox, genprism and genrev. */
#include <math.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

/* --- genbox MATERIAL NAME X Y Z [-i] [-r RADIUS | -b BEVEL] */

typedef struct box {
    double size[3], bevel;
    bool rounded, inverted;
} box;

/* A corner, inset by the bevel along the axes of `inset`; bit i of both masks is axis i. */
static void box_point(const box *self, unsigned corner, unsigned inset, double point[3]) {
    for (unsigned i = 0; i < 3; ++i) {
        const double in = (inset >> i & 1u) != 0 ? self->bevel : 0.0;
        point[i] = (corner >> i & 1u) != 0 ? self->size[i] - in : in;
    }
}

/* A polygon that faces along `outward`, or against it if the box is inverted. */
static aur_result add_face(const aur_rad_generator *self, const box *shape, size_t count,
                           double (*corners)[3], const double outward[3]) {
    double a[3], b[3], normal[3];
    for (size_t k = 0; k < 3; ++k) {
        a[k] = corners[1][k] - corners[0][k];
        b[k] = corners[2][k] - corners[0][k];
    }
    aur_cross3(a, b, normal);
    if ((aur_dot3(normal, outward) < 0.0) != shape->inverted)
        for (size_t i = 0; i < count / 2; ++i)
            for (size_t k = 0; k < 3; ++k) {
                const double swap = corners[i][k];
                corners[i][k] = corners[count - 1 - i][k];
                corners[count - 1 - i][k] = swap;
            }
    return self->take(self->rad, "polygon", self->words[1], 3 * count, corners[0]);
}

/* The face on the lower or upper side of an axis. */
static aur_result add_side(const aur_rad_generator *self, const box *shape, unsigned axis, unsigned upper) {
    const unsigned e = (axis + 1) % 3, f = (axis + 2) % 3;
    static const unsigned turns[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double corners[4][3], outward[3] = {0.0};
    for (size_t i = 0; i < 4; ++i)
        box_point(shape, upper << axis | turns[i][0] << e | turns[i][1] << f, 7u & ~(1u << axis), corners[i]);
    outward[axis] = upper != 0 ? 1.0 : -1.0;
    return add_face(self, shape, 4, corners, outward);
}

/* The bevel between two faces: along an edge, at a corner of the plane across it. */
static aur_result add_edge(const aur_rad_generator *self, const box *shape, unsigned axis, unsigned turn) {
    const unsigned e = (axis + 1) % 3, f = (axis + 2) % 3;
    const unsigned corner = (turn & 1u) << e | (turn >> 1 & 1u) << f;
    if (shape->rounded) {
        double numbers[7];
        box_point(shape, corner, 7u, numbers);
        box_point(shape, corner | 1u << axis, 7u, numbers + 3);
        numbers[6] = shape->bevel;
        return self->take(self->rad, shape->inverted ? "tube" : "cylinder", self->words[1], 7, numbers);
    }
    double corners[4][3], outward[3] = {0.0};
    box_point(shape, corner, 7u & ~(1u << e), corners[0]);
    box_point(shape, corner | 1u << axis, 7u & ~(1u << e), corners[1]);
    box_point(shape, corner | 1u << axis, 7u & ~(1u << f), corners[2]);
    box_point(shape, corner, 7u & ~(1u << f), corners[3]);
    outward[e] = (turn & 1u) != 0 ? 1.0 : -1.0;
    outward[f] = (turn >> 1 & 1u) != 0 ? 1.0 : -1.0;
    return add_face(self, shape, 4, corners, outward);
}

static aur_result add_corner(const aur_rad_generator *self, const box *shape, unsigned corner) {
    double corners[3][3], outward[3], ball[4];
    if (shape->rounded) {
        box_point(shape, corner, 7u, ball);
        ball[3] = shape->bevel;
        return self->take(self->rad, shape->inverted ? "bubble" : "sphere", self->words[1], 4, ball);
    }
    for (unsigned i = 0; i < 3; ++i) {
        box_point(shape, corner, 7u & ~(1u << i), corners[i]);
        outward[i] = (corner >> i & 1u) != 0 ? 1.0 : -1.0;
    }
    return add_face(self, shape, 3, corners, outward);
}

static aur_result read_box(aur_rad_generator *self, box *shape) {
    aur_result result = aur_rad_generator_numbers(self, "three sizes", 3, shape->size);
    while (result == AUR_OK && self->at < self->count) {
        const aur_rad_word word = self->words[self->at];
        const bool rounds = aur_rad_is_word(word, "-r"), segments = aur_rad_is_word(word, "-n");
        double ignored;
        if (aur_rad_is_word(word, "-i")) {
            shape->inverted = true;
        } else if (rounds || aur_rad_is_word(word, "-b") || segments) {
            ++self->at;
            result = aur_rad_generator_numbers(self, "a length after -r or -b", 1,
                                               segments ? &ignored : &shape->bevel);
            shape->rounded = shape->rounded || rounds;
            continue;
        } else if (!aur_rad_is_word(word, "-s")) { /* -n, -s: rounded parts are exact */
            return aur_rad_generator_fail(self);
        }
        ++self->at;
    }
    const double least = fmin(fmin(shape->size[0], shape->size[1]), shape->size[2]);
    return result != AUR_OK || (least > 0.0 && shape->bevel >= 0.0 && 2.0 * shape->bevel <= least)
               ? result
               : aur_rad_fail(self->rad, self->words[0].line, AUR_ERROR_FORMAT,
                              "genbox: sizes must be above 0, and a bevel or radius at most half of each");
}

static aur_result generate_box(aur_rad_generator *self) {
    box shape = {.bevel = 0.0};
    aur_result result = read_box(self, &shape);
    for (unsigned i = 0; i < 6 && result == AUR_OK; ++i)
        result = add_side(self, &shape, i / 2, i % 2);
    for (unsigned i = 0; i < 12 && result == AUR_OK && shape.bevel > 0.0; ++i)
        result = add_edge(self, &shape, i / 4, i % 4);
    for (unsigned i = 0; i < 8 && result == AUR_OK && shape.bevel > 0.0; ++i)
        result = add_corner(self, &shape, i);
    return result;
}

aur_result aur_rad_generate(aur_rad *self, size_t count, const aur_rad_word *words, aur_rad_take *take,
                            bool *recognised) {
    static const struct {
        const char *name;
        aur_result (*generate)(aur_rad_generator *self);
    } rows[] = {{"genbox", generate_box},
                {"genprism", aur_rad_generate_prism},
                {"genrev", aur_rad_generate_revolution}};
    aur_rad_generator shape = {.rad = self, .count = count, .at = 3, .words = words, .take = take};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        if (!aur_rad_is_word(words[0], rows[i].name))
            continue;
        return count >= 4 ? rows[i].generate(&shape)
                          : aur_rad_fail(self, words[0].line, AUR_ERROR_FORMAT,
                                         "%s: a material, a name and sizes expected", rows[i].name);
    }
    *recognised = false;
    return AUR_OK;
}
