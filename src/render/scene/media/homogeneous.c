/* Homogeneous media: distances are sampled from the exponential distribution, and transmittance is exact
 * (Beer-Lambert law). */
#include "render/scene/medium.h"

typedef struct homogeneous {
    double scale;
    aur_volume_value albedo;
    aur_vector extinction; /* an inverse length, with `scale` applied */
} homogeneous;

static const aur_key keys[] = {
    {AUR_VOLUME_KEY("albedo", "0.75", "share of scattered light in an interaction, from 0 to 1")},
    {AUR_VOLUME_KEY("sigma_t", "1", "extinction: scattering and absorption, an inverse length")},
    {AUR_VOLUME_KEY("sigma_s", NULL, "scattering, with sigma_a instead of albedo and sigma_t (Mitsuba 0.6)")},
    {AUR_VOLUME_KEY("sigma_a", NULL, "absorption")},
    {AUR_KEY_OF_REAL(homogeneous, "scale", scale, 0.0, 1e30, "1", "factor of sigma_t")},
};

/* Extinction and albedo from scattering and absorption coefficients; false: extinction and albedo are given
 * directly. */
static aur_result read_parts(aur_parameters *parameters, homogeneous *self, aur_volume_value *extinction,
                             bool *given, aur_error *error) {
    aur_volume_value scattering = {.volume = NULL}, absorption = {.volume = NULL};
    *given = aur_parameters_find(parameters, "sigma_s") != NULL ||
             aur_parameters_find(parameters, "sigma_a") != NULL;
    if (!*given)
        return AUR_OK;
    if (aur_parameters_find(parameters, "sigma_t") != NULL ||
        aur_parameters_find(parameters, "albedo") != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "give 'sigma_s' and 'sigma_a', or 'sigma_t' and 'albedo', not both");
    aur_result result = aur_volume_value_read(parameters, "sigma_s", 0.0f, 1e30f, &scattering, error);
    if (result == AUR_OK)
        result = aur_volume_value_read(parameters, "sigma_a", 0.0f, 1e30f, &absorption, error);
    if (result == AUR_OK && (scattering.volume != NULL || absorption.volume != NULL))
        return aur_parameters_fail(
            parameters, error, AUR_ERROR_FORMAT,
            "'sigma_s' and 'sigma_a' must be numbers or colours: 'heterogeneous' with sigma_t and "
            "albedo is the medium for what varies");
    extinction->constant = aur_vector_add(scattering.constant, absorption.constant);
    for (size_t c = 0; c < 3; ++c) {
        const float all = *aur_channel(&extinction->constant, c),
                    part = *aur_channel(&scattering.constant, c);
        *aur_channel(&self->albedo.constant, c) = all > 0.0f ? part / all : 0.0f;
    }
    return result;
}

static aur_result create(aur_parameters *parameters, aur_medium *medium, aur_error *error) {
    homogeneous *const self = medium->data;
    aur_result result = aur_keys_read(sizeof keys / sizeof keys[0], keys, parameters, self, error);
    aur_volume_value extinction = {.volume = NULL};
    bool by_parts = false;
    if (result == AUR_OK)
        result = read_parts(parameters, self, &extinction, &by_parts, error);
    if (result == AUR_OK && !by_parts)
        result = aur_volume_value_read(parameters, "albedo", 0.75f, 1.0f, &self->albedo, error);
    if (result == AUR_OK && !by_parts)
        result = aur_volume_value_read(parameters, "sigma_t", 1.0f, 1e30f, &extinction, error);
    if (result == AUR_OK && extinction.volume != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "'sigma_t' varies: 'heterogeneous' is the medium for that");
    self->extinction = aur_vector_scale(extinction.constant, (float)self->scale);
    if (result == AUR_OK && !(aur_vector_max(self->extinction) <= 1e30f))
        result = aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                     "'sigma_t' times 'scale' must be at most 1e30");
    return result;
}

/* exp(-extinction * distance) of all channels over that of one, which becomes exactly 1. */
static aur_vector relative_transmittance(aur_vector extinction, float reference, float distance) {
    const aur_vector more = {extinction.x - reference, extinction.y - reference, extinction.z - reference};
    return (aur_vector){more.x == 0.0f ? 1.0f : expf(-more.x * distance),
                        more.y == 0.0f ? 1.0f : expf(-more.y * distance),
                        more.z == 0.0f ? 1.0f : expf(-more.z * distance)};
}

static bool absorbs_only(const homogeneous *self) {
    return self->albedo.volume == NULL && aur_vector_is_zero(self->albedo.constant);
}

static void absorb(const homogeneous *self, float distance, aur_medium_walk *walk) {
    walk->throughput =
        aur_vector_multiply(walk->throughput, relative_transmittance(self->extinction, 0.0f, distance));
}

static bool travel(const aur_medium *medium, const aur_ray *ray, float distance, float u,
                   aur_medium_walk *walk, float *way) {
    const homogeneous *const self = medium->data;
    aur_vector extinction = self->extinction;
    /* Purely absorbing media need no random decision. */
    if (absorbs_only(self)) {
        absorb(self, distance, walk);
        return false;
    }
    const float reference = *aur_channel(&extinction, walk->channel);
    const float drawn = reference > 0.0f ? -log1pf(-u) / reference : INFINITY;
    const bool scatters = drawn < distance;
    const aur_vector passed = relative_transmittance(extinction, reference, scatters ? drawn : distance);
    walk->throughput = aur_vector_multiply(walk->throughput, passed);
    walk->path = aur_vector_multiply(walk->path, passed);
    if (!scatters) {
        walk->light = aur_vector_scale(walk->light, reference > 0.0f ? expf(reference * distance) : 1.0f);
        return false;
    }
    *way = drawn;
    const aur_vector at = aur_vector_add_scaled(ray->origin, drawn, ray->direction);
    const aur_vector share = {extinction.x / reference, extinction.y / reference, extinction.z / reference};
    walk->path = aur_vector_multiply(walk->path, share);
    walk->throughput = aur_vector_multiply(
        walk->throughput, aur_vector_multiply(aur_volume_value_at(&self->albedo, at), share));
    return true;
}

static void pass(const aur_medium *medium, const aur_ray *ray, float distance, aur_medium_walk *walk) {
    (void)ray;
    const homogeneous *const self = medium->data;
    absorb(self, distance, walk);
    if (!absorbs_only(self))
        walk->path =
            aur_vector_multiply(walk->path, relative_transmittance(self->extinction, 0.0f, distance));
}

const aur_medium_descriptor aur_medium_homogeneous = {
    .row = {.name = "homogeneous",
            .summary = "the same everywhere",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(homogeneous),
    .create = create,
    .travel = travel,
    .pass = pass,
};
