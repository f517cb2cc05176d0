#include "render/scene/sensor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/parameters.h"
#include "render/scene/materials/sampling.h"

static const aur_filter filters[] = {
    {AUR_FILTER_BOX, 0.5f},
    {AUR_FILTER_TENT, 1.0f},
    {AUR_FILTER_GAUSSIAN, 0.5f},
    {AUR_FILTER_MITCHELL, 1.0f},
};

enum { FILTER_COUNT = sizeof filters / sizeof filters[0] };

/* The gaussian reaches 4 standard deviations, where it is lowered to 0: density ~ exp(-x^2/2) - exp(-8). */
static const float cut = 4.0f;
static const float level = 3.3546262790251185e-4f; /* exp(-8) */

/* Integral of the lowered gaussian from 0 to x. */
static float gaussian_mass(float x) {
    return 1.2533141373155003f * erff(x * 0.70710678118654752f) - level * x;
}

/* Where the mass from 0 to x is t of the whole, for t > 0.9: the gaussian itself gives the first guess,
 * Halley's method the rest. */
static float gaussian_tail(float t) {
    const float total = gaussian_mass(cut);
    float x = fminf(1.41421356f * aur_inverse_erf(fminf(t, 0.9999f)), cut);
    for (size_t i = 0; i < 4; ++i) {
        const float gauss = expf(-0.5f * x * x), density = gauss - level;
        if (!(density > 1e-6f))
            break;
        const float newton = (gaussian_mass(x) - t * total) / density;
        const float step = newton / (1.0f + 0.5f * newton * x * gauss / density);
        x = fminf(fmaxf(x - step, 0.0f), cut);
        if (fabsf(step) < 0.02f)
            break;
    }
    return x;
}

/* The same for t <= 0.9, by a rational function fitted to the solution: good to 2e-6. */
static float gaussian_centre(float t) {
    const float r = t * t;
    const float above = ((-0.0869674683f * r + 0.958392143f) * r - 2.09406877f) * r + 1.25231504f;
    const float below = ((-0.182857022f * r + 1.12697196f) * r - 1.93358779f) * r + 1.0f;
    return t * above / below;
}

/* The offset in standard deviations from the centre. */
static float sample_gaussian(float u) {
    const float t = fabsf(2.0f * u - 1.0f);
    const float x = t <= 0.9f ? gaussian_centre(t) : gaussian_tail(t);
    return u < 0.5f ? -x : x;
}

/* Mitchell and Netravali's filter (1988) with B = C = 1/3 falls below 0 at 8/7 and ends at 2. This is the
 * integral of its absolute value from 0 to x. */
static const float mitchell_turn = 8.0f / 7.0f;

static float mitchell_inner(float x) {
    return (((7.0f / 4.0f * x - 4.0f) * x) * x + 16.0f / 3.0f) * x / 6.0f;
}

static float mitchell_outer(float x) {
    return (((-7.0f / 12.0f * x + 4.0f) * x - 10.0f) * x + 32.0f / 3.0f) * x / 6.0f;
}

static float mitchell_mass(float x) {
    if (x <= 1.0f)
        return mitchell_inner(x);
    const float mass = mitchell_inner(1.0f) + mitchell_outer(fminf(x, mitchell_turn)) - mitchell_outer(1.0f);
    return x <= mitchell_turn ? mass : mass - (mitchell_outer(x) - mitchell_outer(mitchell_turn));
}

/* By bisection: the density vanishes at the turn, where Newton's method fails. */
static float sample_mitchell(float u) {
    const float side = u < 0.5f ? -1.0f : 1.0f;
    const float target = fabsf(2.0f * u - 1.0f) * mitchell_mass(2.0f);
    float low = 0.0f, high = 2.0f;
    for (size_t i = 0; i < 22; ++i) {
        const float middle = 0.5f * (low + high);
        if (mitchell_mass(middle) <= target)
            low = middle;
        else
            high = middle;
    }
    return side * low;
}

float aur_filter_weight(const aur_filter *filter, float offset) {
    if (filter->kind != AUR_FILTER_MITCHELL)
        return 1.0f;
    const float size = 2.0f * mitchell_mass(2.0f);
    return fabsf(offset) > mitchell_turn * filter->scale ? -size : size;
}

float aur_filter_sample(const aur_filter *filter, float u) {
    switch (filter->kind) {
    case AUR_FILTER_TENT: {
        const float side = u < 0.5f ? -1.0f : 1.0f;
        const float t = u < 0.5f ? 2.0f * u : 2.0f - 2.0f * u;
        return side * filter->scale * (1.0f - sqrtf(t));
    }
    case AUR_FILTER_GAUSSIAN:
        return filter->scale * sample_gaussian(u);
    case AUR_FILTER_MITCHELL:
        return filter->scale * sample_mitchell(u);
    case AUR_FILTER_BOX:
        break;
    }
    return 2.0f * filter->scale * (u - 0.5f);
}

static const aur_key tent_keys[] = {
    {AUR_KEY_OF_REAL(aur_filter, "radius", scale, 1e-3, 100.0, "1", "in pixels")},
};

static const aur_key gaussian_keys[] = {
    {AUR_KEY_OF_REAL(aur_filter, "stddev", scale, 1e-3, 25.0, "0.5",
                     "standard deviation in pixels; it ends at 4 of them")},
};

static const aur_row box = {.name = "box", .summary = "the mean over the pixel"};
static const aur_row tent = {.name = "tent", .summary = "falls linearly to 0", AUR_ROW_KEYS(tent_keys)};
static const aur_row gaussian = {.name = "gaussian", .summary = "a bell", AUR_ROW_KEYS(gaussian_keys)};
static const aur_row mitchell = {.name = "mitchell",
                                 .summary = "sharpens a little: it has negative parts",
                                 .source = "Mitchell, Netravali 1988"};

/* In the order of aur_filter_kind. */
static const aur_row *const rows[] = {&box, &tent, &gaussian, &mitchell};

const aur_table aur_filter_table = {
    .kind = "rfilter", .summary = "how samples are weighed around a pixel", AUR_TABLE_ROWS(rows)};

const aur_filter *aur_filter_find(const char *name) {
    for (size_t i = 0; i < FILTER_COUNT; ++i)
        if (strcmp(rows[i]->name, name) == 0)
            return &filters[i];
    return NULL;
}

const char *aur_filter_name(const aur_filter *filter) {
    return rows[filter->kind]->name;
}

aur_result aur_filter_create(aur_parameters *parameters, aur_filter *filter, aur_error *error) {
    const aur_row *row;
    const aur_result result = aur_table_find(&aur_filter_table, parameters, &row, error);
    if (result != AUR_OK)
        return result;
    *filter = *aur_filter_find(row->name);
    return aur_row_read(row, parameters, filter, error);
}
