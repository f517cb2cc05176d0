#include "lighting/daylight/hours.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/vector.h"
#include "points/base/vector3d.h"

/* Directions per patch side, so that all subdivisions sample the sky about equally well. */
enum { FINENESS = 4 };

static size_t patches_of_row(const aur_sky_patches *patches, size_t row) {
    return patches->first[row + 1] - patches->first[row];
}

/* The heights of a row, from 0 to 1. */
static void heights_of(const aur_sky_patches *patches, size_t row, double *low, double *high) {
    *low = sin((double)row * patches->step);
    *high = row + 1 < patches->row_count ? sin((double)(row + 1) * patches->step) : 1.0;
}

/* The midpoints of equal intervals. */
static void set_middles(aur_sky_patches *patches) {
    double(*next)[3] = patches->middles;
    for (size_t row = 0; row < patches->row_count; ++row) {
        double low, high;
        heights_of(patches, row, &low, &high);
        const size_t count = patches_of_row(patches, row);
        const size_t around = count * (count > 1 ? patches->around : patches->around_zenith);
        for (size_t i = 0; i < patches->up * around; ++i) {
            const double height = low + (high - low) * ((double)(i / around) + 0.5) / (double)patches->up;
            const double turn = ((double)(i % around) + 0.5) / (double)around - 0.5 / (double)count;
            const double radius = sqrt(fmax(1.0 - height * height, 0.0));
            (*next)[0] = radius * sin(2.0 * AUR_PI * turn);
            (*next)[1] = radius * cos(2.0 * AUR_PI * turn);
            (*next++)[2] = height;
        }
    }
}

aur_result aur_sky_patches_create(size_t subdivision, aur_sky_patches *patches, aur_error *error) {
    static const size_t around[7] = {30, 30, 24, 24, 18, 12, 6};
    const size_t side = (FINENESS + subdivision - 1) / subdivision;
    aur_sky_patches built = {.subdivision = subdivision,
                             .row_count = 7 * subdivision + 1,
                             .count = 1,
                             .up = side,
                             .around = side,
                             .around_zenith = 6 * side};
    built.step = 0.5 * AUR_PI / ((double)(7 * subdivision) + 0.5);
    for (size_t row = 0; row < built.row_count; ++row) {
        built.first[row] = built.count;
        built.count += row + 1 < built.row_count ? around[row / subdivision] * subdivision : 1;
    }
    built.first[built.row_count] = built.count;
    built.middles = malloc(side * ((built.count - 2) * side + 6 * side) * sizeof *built.middles);
    if (built.middles == NULL)
        return aur_fail_memory(error);
    set_middles(&built);
    *patches = built;
    return AUR_OK;
}

void aur_sky_patches_release(aur_sky_patches *patches) {
    free(patches->middles);
    *patches = (aur_sky_patches){0};
}

static size_t row_of(const aur_sky_patches *patches, size_t patch) {
    size_t row = 0;
    while (patches->first[row + 1] <= patch)
        ++row;
    return row;
}

size_t aur_sky_patches_find(const aur_sky_patches *patches, const double direction[3]) {
    if (direction[2] < 0.0)
        return 0;
    const double height = asin(fmin(direction[2], 1.0)) / patches->step;
    const size_t last = patches->row_count - 1, row = height < (double)last ? (size_t)height : last;
    const size_t count = patches_of_row(patches, row);
    const double turn = atan2(direction[0], direction[1]) / (2.0 * AUR_PI);
    const size_t column = (size_t)((turn < 0.0 ? turn + 1.0 : turn) * (double)count + 0.5);
    return patches->first[row] + (column < count ? column : 0);
}

double aur_sky_patch_angle(const aur_sky_patches *patches, size_t patch) {
    if (patch == 0)
        return 2.0 * AUR_PI;
    double low, high;
    const size_t row = row_of(patches, patch);
    heights_of(patches, row, &low, &high);
    return 2.0 * AUR_PI * (high - low) / (double)patches_of_row(patches, row);
}

double aur_sky_patch_cosine(const aur_sky_patches *patches, size_t patch) {
    if (patch == 0)
        return 0.0;
    double low, high;
    const size_t row = row_of(patches, patch);
    heights_of(patches, row, &low, &high);
    return AUR_PI * (high * high - low * low) / (double)patches_of_row(patches, row);
}

/* Adds the means over the patches of one row. */
static void add_row(const aur_sky_patches *patches, const aur_sky_model *sky, size_t row,
                    const double (*middles)[3], double *radiance) {
    const size_t count = patches_of_row(patches, row);
    const size_t pieces = count > 1 ? patches->around : patches->around_zenith;
    for (size_t i = 0; i < patches->up; ++i) {
        const double share = 1.0 / (double)(patches->up * pieces);
        const double gradation = share * aur_sky_model_gradation(sky, (*middles)[2]);
        for (size_t j = 0; j < count * pieces; ++j, ++middles) {
            const double along = fmin(fmax(aur_dot3(*middles, sky->sun), -1.0), 1.0);
            const double indicatrix = aur_sky_model_indicatrix(sky, acos(along), along);
            radiance[patches->first[row] + j / pieces] += fmax(gradation * indicatrix, 0.0);
        }
    }
}

bool aur_sky_patches_fill(const aur_sky_patches *patches, const aur_sky_model *sky, double diffuse,
                          double *radiance) {
    double whole = 0.0;
    const double(*middles)[3] = (const double(*)[3])patches->middles;
    for (size_t patch = 0; patch < patches->count; ++patch)
        radiance[patch] = 0.0;
    for (size_t row = 0; row < patches->row_count; ++row) {
        add_row(patches, sky, row, middles, radiance);
        const size_t count = patches_of_row(patches, row);
        middles += patches->up * count * (count > 1 ? patches->around : patches->around_zenith);
        const double cosine = aur_sky_patch_cosine(patches, patches->first[row]);
        for (size_t patch = patches->first[row]; patch < patches->first[row + 1]; ++patch)
            whole += cosine * radiance[patch];
    }
    if (!(whole > 0.0) || !isfinite(whole))
        return false;
    for (size_t patch = 1; patch < patches->count; ++patch)
        radiance[patch] *= diffuse / whole;
    return true;
}
