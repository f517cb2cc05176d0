/* Queries of a material: answered by its own functions, or derived from its lobes. */
#include "render/scene/materials/bsdf.h"

#include <stdlib.h>
#include <string.h>

#include "render/scene/materials/sampling.h"

size_t aur_bsdf_add_lobe(aur_bsdf *bsdf, const aur_bsdf_lobe *lobe) {
    if (bsdf->lobe_count < AUR_BSDF_LOBE_CAPACITY)
        bsdf->lobes[bsdf->lobe_count] = *lobe;
    return bsdf->lobe_count++;
}

size_t aur_bsdf_lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    for (size_t i = 0; i < bsdf->lobe_count; ++i)
        lobes[i] = bsdf->lobes[i];
    bsdf->descriptor->weigh(bsdf, point, view, lobes);
    return bsdf->lobe_count;
}

/* --- derived from the lobes */

/* The lobes at a point, and their sampling weights: reflectance, ignoring the cut at the horizon. */
typedef struct weighed_lobes {
    size_t count;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    float probabilities[AUR_BSDF_LOBE_CAPACITY], total; /* unnormalised weights, and their sum */
} weighed_lobes;

static void weigh_lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, weighed_lobes *all) {
    all->count = aur_bsdf_lobes(bsdf, point, view, all->lobes);
    all->total = 0.0f;
    for (size_t i = 0; i < all->count; ++i) {
        const aur_bsdf_lobe *const lobe = &all->lobes[i];
        float mass = lobe->ior_squared > 0.0f ? lobe->ior_squared : 1.0f;
        if (lobe->shape == AUR_LOBE_SHAPE_COSINE_POWER)
            mass = 2.0f * AUR_PI_F / (lobe->exponent + (lobe->times_cosine ? 2.0f : 1.0f));
        all->probabilities[i] = mass * aur_luminance(lobe->coefficient);
        all->total += all->probabilities[i];
    }
}

/* Value and pdf of all lobes for `light`; both use the same powers of cosines. */
static aur_vector value_of(const weighed_lobes *all, aur_vector light, float *pdf) {
    aur_vector sum = {0};
    float density = 0.0f;
    for (size_t i = 0; i < all->count; ++i) {
        const aur_bsdf_lobe *const lobe = &all->lobes[i];
        const float cosine = aur_vector_dot(lobe->axis, light);
        if (lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER || aur_vector_is_zero(lobe->coefficient) ||
            cosine <= 0.0f)
            continue;
        const float power = lobe->exponent == 1.0f ? cosine : powf(cosine, lobe->exponent);
        sum = aur_vector_add(sum, aur_lobe_value_of_power(lobe, power, light));
        if (all->probabilities[i] > 0.0f)
            density +=
                all->probabilities[i] *
                (lobe->diffuse ? power / AUR_PI_F : (lobe->exponent + 1.0f) / (2.0f * AUR_PI_F) * power);
    }
    *pdf = all->total > 0.0f ? density / all->total : 0.0f;
    return sum;
}

static bool has_formula(const aur_bsdf *bsdf, aur_vector view) {
    return (aur_bsdf_scatters(bsdf, view.z) & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0;
}

static aur_vector evaluate_lobes(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view,
                                 aur_vector light, float *pdf) {
    *pdf = 0.0f;
    if (!(view.z * light.z > 0.0f) || !has_formula(bsdf, view))
        return (aur_vector){0};
    weighed_lobes all;
    weigh_lobes(bsdf, point, view, &all);
    return value_of(&all, light, pdf);
}

/* The lobe selected by u in [0,1); by rounding, the last one. */
static size_t choose_lobe(const weighed_lobes *all, float u) {
    float rest = u * all->total;
    for (size_t i = all->count; i-- > 1;) {
        if (rest < all->probabilities[i])
            return i;
        rest -= all->probabilities[i];
    }
    return 0;
}

static bool draw_lobe(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, const float u[3],
                      aur_bsdf_sample *drawn) {
    weighed_lobes all;
    weigh_lobes(bsdf, point, view, &all);
    if (!(all.total > 0.0f))
        return false;
    const size_t chosen = choose_lobe(&all, u[0]);
    const aur_bsdf_lobe *const lobe = &all.lobes[chosen];
    if (lobe->shape == AUR_LOBE_SHAPE_SPECULAR) {
        *drawn = (aur_bsdf_sample){
            .light = lobe->axis,
            .weight = aur_vector_scale(lobe->coefficient, all.total / all.probabilities[chosen]),
            .specular = true,
            .ior_squared = lobe->ior_squared};
        return all.probabilities[chosen] > 0.0f;
    }
    const aur_frame frame = aur_frame_about(lobe->axis);
    const aur_vector light =
        aur_frame_to_world(&frame, lobe->diffuse ? aur_sample_cosine(u[1], u[2])
                                                 : aur_sample_cosine_power(u[1], u[2], lobe->exponent));
    float pdf;
    const aur_vector value = value_of(&all, light, &pdf);
    if (!(pdf > 0.0f) || !(view.z * light.z > 0.0f))
        return false;
    *drawn = (aur_bsdf_sample){.light = light, .weight = aur_vector_scale(value, 1.0f / pdf), .pdf = pdf};
    return aur_vector_max(value) > 0.0f;
}

/* Albedo of diffuse lobes without a factor: their coefficient times pi. */
static aur_vector albedo_of_lobes(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    aur_vector sum = {0};
    if ((aur_bsdf_scatters(bsdf, side) & AUR_SCATTERS_DIFFUSE) == 0)
        return sum;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    const aur_vector view = {sqrtf(fmaxf(1.0f - side * side, 0.0f)), 0.0f, side};
    const size_t count = aur_bsdf_lobes(bsdf, point, view, lobes);
    for (size_t i = 0; i < count; ++i)
        if (lobes[i].diffuse)
            sum = aur_vector_add_scaled(sum, AUR_PI_F, lobes[i].coefficient);
    return sum;
}

/* --- queries */

aur_vector aur_bsdf_evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                             aur_vector light, float *pdf) {
    const aur_bsdf_descriptor *const descriptor = bsdf->descriptor;
    return descriptor->evaluate != NULL ? descriptor->evaluate(bsdf, part, point, view, light, pdf)
                                        : evaluate_lobes(bsdf, point, view, light, pdf);
}

bool aur_bsdf_draw(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    const aur_bsdf_descriptor *const descriptor = bsdf->descriptor;
    return descriptor->sample != NULL ? descriptor->sample(bsdf, part, point, view, u, drawn)
                                      : draw_lobe(bsdf, point, view, u, drawn);
}

aur_vector aur_bsdf_passed(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view) {
    aur_vector sum = {0};
    if (!bsdf->passes)
        return sum;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    const size_t count = aur_bsdf_lobes(bsdf, point, view, lobes);
    for (size_t i = 0; i < count; ++i)
        if (lobes[i].shape == AUR_LOBE_SHAPE_SPECULAR && lobes[i].way == AUR_LOBE_WAY_UNSCATTERED)
            sum = aur_vector_add(sum, lobes[i].coefficient);
    return sum;
}

aur_vector aur_bsdf_diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const aur_bsdf_descriptor *const descriptor = bsdf->descriptor;
    return descriptor->diffuse_albedo != NULL ? descriptor->diffuse_albedo(bsdf, point, side)
                                              : albedo_of_lobes(bsdf, point, side);
}

aur_result aur_parameters_nested_bsdf(aur_parameters *parameters, const char *name, const aur_bsdf **bsdf,
                                      aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (item->kind != AUR_PARAMETER_OBJECT || strcmp(item->object_kind, "bsdf") != 0)
        return aur_fail_at(error, item->location, AUR_ERROR_FORMAT, "%s '%s': '%s' must be a bsdf",
                           parameters->kind, parameters->plugin, name);
    *bsdf = item->object;
    return AUR_OK;
}
