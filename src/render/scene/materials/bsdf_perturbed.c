/* Materials with a perturbed normal, from a normal map or a bump map. The nested material is evaluated in the
 * frame of the perturbed normal, by the formulas of Mitsuba 3. */
#include "render/scene/materials/texture.h"

typedef struct perturbed {
    const aur_bsdf *nested;
    aur_color map; /* normals encoded as (n + 1) / 2; or heights */
    float scale;
    bool by_height;
    bool flips;   /* normals that face away from the view are flipped */
    bool shadows; /* fades out light near the horizon, instead of cutting it off */
    /* Indices of the nested material's lobes in this one. */
    size_t number[AUR_BSDF_LOBE_CAPACITY];
} perturbed;

#define PERTURBED_KEYS                                                                                       \
    AUR_NESTED_BSDF_KEY("bsdf", NULL, "nested bsdf; must be given"),                                         \
        {AUR_KEY_OF_BOOLEAN(perturbed, "flip_invalid_normals", flips, "true",                                \
                            "flip normals that face away from the view")},                                   \
    {                                                                                                        \
        AUR_KEY_OF_BOOLEAN(perturbed, "use_shadowing_function", shadows, "true",                             \
                           "light fades out before it sets (Conty Estevez et al. 2019)")                     \
    }

static const aur_key normal_keys[] = {
    {AUR_KEY_OF_COLOR(perturbed, "normalmap", map, 1.0, "0.5 0.5 1",
                      "normals in the surface's frame, (n + 1) / 2: a bitmap with raw=true")},
    {AUR_KEY_OF_REAL(perturbed, "scale", scale, -1e30, 1e30, "1", "factor of the x and y of normals")},
    PERTURBED_KEYS,
};
static const aur_key bump_keys[] = {
    {AUR_KEY_OF_COLOR(perturbed, "texture", map, 1e30, "0", "heights: a bitmap with raw=true, of any name")},
    {AUR_KEY_OF_REAL(perturbed, "scale", scale, -1e30, 1e30, "1", "factor of heights")},
    PERTURBED_KEYS,
};

/* Specular lobes stay specular. All others become sampled lobes, as they are not about the surface normal. */
static aur_result create(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    perturbed *const self = bsdf->data;
    const aur_result result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->nested, error);
    if (result != AUR_OK)
        return result;
    if (self->nested == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT, "bsdf '%s' needs a nested bsdf",
                           parameters->plugin);
    bsdf->anisotropic = true;
    aur_bsdf_lobe rest = {.shape = AUR_LOBE_SHAPE_SAMPLED};
    for (size_t i = 0; i < self->nested->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &self->nested->lobes[i];
        if (lobe->shape == AUR_LOBE_SHAPE_SPECULAR) {
            self->number[i] = aur_bsdf_add_lobe(bsdf, lobe);
            continue;
        }
        rest.sides |= lobe->sides;
        rest.transmits = rest.transmits || lobe->transmits;
    }
    const size_t last = rest.sides != 0 ? aur_bsdf_add_lobe(bsdf, &rest) : 0;
    for (size_t i = 0; i < self->nested->lobe_count; ++i)
        if (self->nested->lobes[i].shape != AUR_LOBE_SHAPE_SPECULAR)
            self->number[i] = last;
    return AUR_OK;
}

static aur_result create_bump(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    perturbed *const self = bsdf->data;
    self->by_height = true;
    bsdf->bumpy = true;
    if (self->map.texture == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT, "bsdf 'bumpmap' needs a texture");
    return create(parameters, bsdf, error);
}

/* The perturbed normal, not normalised. */
static aur_vector normal_at(const perturbed *self, aur_bsdf_point point) {
    if (!self->by_height) {
        const aur_vector color = aur_color_at(&self->map, point);
        return (aur_vector){self->scale * (2.0f * color.x - 1.0f), self->scale * (2.0f * color.y - 1.0f),
                            2.0f * color.z - 1.0f};
    }
    float slope[2] = {0.0f, 0.0f};
    if (self->map.texture->descriptor->slope != NULL)
        self->map.texture->descriptor->slope(self->map.texture, point, slope);
    const aur_vector u = {point.tangents[0], 0.0f, self->scale * slope[0]};
    const aur_vector v = {point.tangents[1], point.tangents[2], self->scale * slope[1]};
    const aur_vector normal = aur_vector_cross(u, v);
    return normal.z < 0.0f ? aur_vector_scale(normal, -1.0f) : normal;
}

static aur_frame frame_at(const perturbed *self, aur_bsdf_point point, aur_vector view) {
    aur_vector normal = normal_at(self, point);
    if (self->flips && view.z * aur_vector_dot(view, normal) <= 0.0f)
        normal = (aur_vector){-normal.x, -normal.y, normal.z};
    const float length = aur_vector_length(normal);
    normal = length > 0.0f && isfinite(length) ? aur_vector_scale(normal, 1.0f / length)
                                               : (aur_vector){0.0f, 0.0f, 1.0f};
    const aur_vector x = aur_vector_add_scaled((aur_vector){1.0f, 0.0f, 0.0f}, -normal.x, normal);
    const float size = aur_vector_length(x);
    aur_frame frame = {.z = normal};
    frame.x = size > 0.0f ? aur_vector_scale(x, 1.0f / size) : (aur_vector){0.0f, 1.0f, 0.0f};
    frame.y = aur_vector_cross(normal, frame.x);
    return frame;
}

static float squared_tangent(aur_vector direction) {
    return (direction.x * direction.x + direction.y * direction.y) / (direction.z * direction.z);
}

/* The factor of light: 0 if it is on different sides of the two normals. */
static float factor_of(const perturbed *self, const aur_frame *frame, aur_vector light) {
    if (!(light.z * aur_vector_dot(frame->z, light) > 0.0f))
        return 0.0f;
    if (!self->shadows)
        return 1.0f;
    const float alpha2 = fminf(0.125f * squared_tangent(frame->z), 1.0f);
    return 2.0f / (1.0f + sqrtf(1.0f + alpha2 * squared_tangent(light)));
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const perturbed *const self = bsdf->data;
    const aur_frame frame = frame_at(self, point, view);
    aur_bsdf_lobe found[AUR_BSDF_LOBE_CAPACITY];
    const size_t count = aur_bsdf_lobes(self->nested, point, aur_frame_to_local(&frame, view), found);
    for (size_t i = 0; i < count; ++i) {
        if (aur_vector_is_zero(found[i].coefficient))
            continue;
        aur_bsdf_lobe *const lobe = &lobes[self->number[i]];
        lobe->axis = aur_frame_to_world(&frame, found[i].axis);
        lobe->ior_squared = found[i].ior_squared;
        lobe->coefficient = lobe->shape == AUR_LOBE_SHAPE_SPECULAR
                                ? aur_vector_scale(found[i].coefficient, factor_of(self, &frame, lobe->axis))
                                : (aur_vector){1.0f, 1.0f, 1.0f};
    }
}

/* All non-specular parts are one sampled lobe, so that both parts have the same value. */
static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    (void)part;
    const perturbed *const self = bsdf->data;
    const aur_frame frame = frame_at(self, point, view);
    const float factor = factor_of(self, &frame, light);
    *pdf = 0.0f;
    if (factor == 0.0f)
        return (aur_vector){0};
    return aur_vector_scale(aur_bsdf_evaluate(self->nested, AUR_BSDF_WHOLE, point,
                                              aur_frame_to_local(&frame, view),
                                              aur_frame_to_local(&frame, light), pdf),
                            factor);
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    const perturbed *const self = bsdf->data;
    const aur_frame frame = frame_at(self, point, view);
    if (!aur_bsdf_draw(self->nested, AUR_BSDF_WHOLE, point, aur_frame_to_local(&frame, view), u, drawn) ||
        (part == AUR_BSDF_SAMPLED_LOBES && drawn->specular))
        return false;
    drawn->light = aur_frame_to_world(&frame, drawn->light);
    const float factor = factor_of(self, &frame, drawn->light);
    drawn->weight = aur_vector_scale(drawn->weight, factor);
    return factor > 0.0f;
}

const aur_bsdf_descriptor aur_bsdf_normalmap = {
    .row = {.name = "normalmap",
            .summary = "normal map: the nested bsdf with perturbed normals",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(normal_keys)},
    .size = sizeof(perturbed),
    .create = create,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
};

const aur_bsdf_descriptor aur_bsdf_bumpmap = {
    .row = {.name = "bumpmap",
            .summary = "bump map: the nested bsdf on a displaced surface",
            .source = "Blinn 1978",
            AUR_ROW_KEYS(bump_keys)},
    .size = sizeof(perturbed),
    .create = create_bump,
    .weigh = weigh,
    .evaluate = evaluate,
    .sample = sample,
};
