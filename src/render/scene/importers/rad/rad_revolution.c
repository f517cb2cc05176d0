/* genrev MATERIAL NAME 'Z(T)' 'R(T)' N [-s]: the surface of revolution of a curve about z, in N segments. */
#include <math.h>

#include "render/scene/importers/rad/rad_reader.h"

enum { MOST_PIECES = 100000 };

/* A segment between two heights and radii, facing away from the axis where the curve rises. */
static aur_result add_piece(const aur_rad_generator *self, const double z[2], const double r[2]) {
    const double rise = z[1] - z[0], spread = r[1] - r[0], least = 1e-6;
    const bool flat = fabs(rise) <= least, upright = fabs(spread) <= least;
    double numbers[8] = {0.0, 0.0, z[0], 0.0, 0.0, z[1], r[0], r[1]};
    if (flat && upright)
        return AUR_OK;
    if (upright)
        return self->take(self->rad, rise < 0.0 ? "tube" : "cylinder", self->words[1], 7, numbers);
    if (flat)
        numbers[5] = spread < 0.0 ? 1.0 : -1.0;
    const char *const type = flat ? "ring" : rise < 0.0 ? "cup" : "cone";
    return self->take(self->rad, type, self->words[1], 8, numbers);
}

aur_result aur_rad_generate_revolution(aur_rad_generator *self) {
    const aur_rad *const rad = self->rad;
    const size_t line = self->words[0].line;
    double pieces = 0.0, z[2], r[2];
    if (self->count < 6)
        return aur_rad_fail(rad, line, AUR_ERROR_FORMAT,
                            "genrev: a material, a name, z(t), r(t) and the number of pieces expected");
    aur_result result = aur_rad_evaluate(rad, self->words[5], 0.0, &pieces);
    if (result == AUR_OK && !(pieces >= 0.5 && pieces < MOST_PIECES))
        result = aur_rad_fail(rad, line, AUR_ERROR_FORMAT,
                              "genrev: the number of pieces must be from 1 to %d", (int)MOST_PIECES);
    /* -s only smooths normals: segments remain cones, as in Radiance. */
    for (self->at = 6; self->at < self->count && result == AUR_OK; ++self->at)
        if (!aur_rad_is_word(self->words[self->at], "-s"))
            return aur_rad_generator_fail(self);
    const double count = floor(pieces + 0.5);
    for (double i = 0.0; i <= count && result == AUR_OK; ++i) {
        z[0] = z[1];
        r[0] = r[1];
        result = aur_rad_evaluate(rad, self->words[3], i / count, &z[1]);
        if (result == AUR_OK)
            result = aur_rad_evaluate(rad, self->words[4], i / count, &r[1]);
        if (result == AUR_OK && !(r[1] >= -1e-6))
            result = aur_rad_fail(rad, line, AUR_ERROR_FORMAT, "genrev: r(%g) = %g must not be below 0",
                                  i / count, r[1]);
        r[1] = fmax(r[1], 0.0);
        if (result == AUR_OK && i > 0.0)
            result = add_piece(self, z, r);
    }
    return result;
}
