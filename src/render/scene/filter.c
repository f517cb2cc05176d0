#include "render/scene/sensor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/parameters.h"
#include "render/scene/materials/sampling.h"

static const aur_filter filters[] = {
    {.kind = AUR_FILTER_BOX, .scale = 0.5f},
    {.kind = AUR_FILTER_TENT, .scale = 1.0f},
    {.kind = AUR_FILTER_GAUSSIAN, .scale = 0.5f},
    {.kind = AUR_FILTER_MITCHELL, .scale = 2.0f, .b = 1.0f / 3.0f, .c = 1.0f / 3.0f},
    {.kind = AUR_FILTER_CATMULLROM, .scale = 2.0f},
    {.kind = AUR_FILTER_LANCZOS, .scale = 3.0f, .lobes = 3},
};

enum { FILTER_COUNT = sizeof filters / sizeof filters[0] };

/* The gaussian is truncated at 4 standard deviations and lowered to 0 there: density ~ exp(-x^2/2) - exp(-8).
 */
static const float cut = 4.0f;
static const float level = 3.3546262790251185e-4f; /* exp(-8) */

/* Integral of the lowered gaussian from 0 to x. */
static float gaussian_mass(float x) {
    return 1.2533141373155003f * erff(x * 0.70710678118654752f) - level * x;
}

/* The inverse of the normalised integral at t > 0.9: starts from the inverse of the gaussian, then applies
 * Halley's method. */
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

/* The same for t <= 0.9, by a rational fit with error 2e-6. */
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

/* The family of Mitchell and Netravali (1988), at a distance x >= 0. */
static double cubic(double b, double c, double x) {
    if (x < 1.0)
        return (((12.0 - 9.0 * b - 6.0 * c) * x - 18.0 + 12.0 * b + 6.0 * c) * x * x + 6.0 - 2.0 * b) / 6.0;
    return (((-b - 6.0 * c) * x + 6.0 * b + 30.0 * c) * x * x - (12.0 * b + 48.0 * c) * x + 8.0 * b +
            24.0 * c) /
           6.0;
}

static double sinc(double x) {
    return x < 1e-5 ? 1.0 : sin(AUR_PI * x) / (AUR_PI * x);
}

double aur_filter_radius(const aur_filter *filter) {
    switch (filter->kind) {
    case AUR_FILTER_GAUSSIAN:
        return (double)cut * (double)filter->scale;
    case AUR_FILTER_MITCHELL:
    case AUR_FILTER_CATMULLROM:
        return 2.0;
    case AUR_FILTER_LANCZOS:
        return (double)filter->lobes;
    case AUR_FILTER_BOX:
    case AUR_FILTER_TENT:
        break;
    }
    return (double)filter->scale;
}

double aur_filter_value(const aur_filter *filter, double offset) {
    const double x = fabs(offset), radius = aur_filter_radius(filter);
    if (x > radius)
        return 0.0;
    switch (filter->kind) {
    case AUR_FILTER_TENT:
        return 1.0 - x / radius;
    case AUR_FILTER_GAUSSIAN: {
        const double t = x / (double)filter->scale;
        return fmax(exp(-0.5 * t * t) - exp(-8.0), 0.0);
    }
    case AUR_FILTER_MITCHELL:
        return cubic((double)filter->b, (double)filter->c, x);
    case AUR_FILTER_CATMULLROM:
        return cubic(0.0, 0.5, x);
    case AUR_FILTER_LANCZOS:
        return sinc(x) * sinc(x / radius);
    case AUR_FILTER_BOX:
        break;
    }
    return 1.0;
}

bool aur_filter_shares_samples(const aur_filter *filter) {
    enum { STEPS = 4096 };
    const double radius = aur_filter_radius(filter);
    if (filter->kind >= AUR_FILTER_MITCHELL) /* have negative parts, so samples cannot be drawn by them */
        return true;
    if (!(radius > 0.5) || ceil(radius - 0.5) > AUR_FILTER_REACH_MAX)
        return false;
    double size = 0.0, square = 0.0;
    for (size_t i = 0; i < STEPS; ++i) {
        const double value = aur_filter_value(filter, radius * ((double)i + 0.5) / STEPS);
        size += fabs(value) * 2.0 * radius / STEPS;
        square += value * value * 2.0 * radius / STEPS;
    }
    return size * size > square;
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
    case AUR_FILTER_BOX:
    case AUR_FILTER_MITCHELL:
    case AUR_FILTER_CATMULLROM:
    case AUR_FILTER_LANCZOS:
        break;
    }
    return 2.0f * filter->scale * (u - 0.5f);
}

static const aur_key box_keys[] = {
    {AUR_KEY_OF_REAL(aur_filter, "radius", scale, 1e-3, 100.0, "0.5", "in pixels")},
};

static const aur_key tent_keys[] = {
    {AUR_KEY_OF_REAL(aur_filter, "radius", scale, 1e-3, 100.0, "1", "in pixels")},
};

static const aur_key gaussian_keys[] = {
    {AUR_KEY_OF_REAL(aur_filter, "stddev", scale, 1e-3, 25.0, "0.5",
                     "standard deviation in pixels; it ends at 4 of them")},
};

static const aur_key mitchell_keys[] = {
    {AUR_KEY_OF_REAL(aur_filter, "A", b, 0.0, 1.0, "1/3", "B of the paper: blurs"), .computed = true},
    {AUR_KEY_OF_REAL(aur_filter, "B", c, 0.0, 1.0, "1/3", "C of the paper: sharpens"), .computed = true},
};

static const aur_key lanczos_keys[] = {
    {AUR_KEY_OF_INTEGER(aur_filter, "lobes", lobes, 1, AUR_FILTER_REACH_MAX, "3", "its radius in pixels")},
};

static const aur_row box = {.name = "box", .summary = "the mean over the pixel", AUR_ROW_KEYS(box_keys)};
static const aur_row tent = {.name = "tent", .summary = "falls linearly to 0", AUR_ROW_KEYS(tent_keys)};
static const aur_row gaussian = {.name = "gaussian", .summary = "a bell", AUR_ROW_KEYS(gaussian_keys)};
static const aur_row mitchell = {.name = "mitchell",
                                 .summary = "sharpens a little: it has negative parts",
                                 .source = "Mitchell, Netravali 1988",
                                 AUR_ROW_KEYS(mitchell_keys)};
static const aur_row catmullrom = {
    .name = "catmullrom", .summary = "sharpens: it has negative parts", .source = "Catmull, Rom 1974"};
static const aur_row lanczos = {.name = "lanczos",
                                .summary = "a sinc with a window: sharp, with several negative parts",
                                .source = "Duchon 1979",
                                AUR_ROW_KEYS(lanczos_keys)};

/* In the order of aur_filter_kind. */
static const aur_row *const rows[] = {&box, &tent, &gaussian, &mitchell, &catmullrom, &lanczos};

const aur_table aur_filter_table = {.kind = "rfilter",
                                    .summary = "reconstruction filters: weights of samples around a pixel",
                                    AUR_TABLE_ROWS(rows)};

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
