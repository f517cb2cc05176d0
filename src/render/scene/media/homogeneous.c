/* The same everywhere: distances are drawn from Beer and Lambert's law, and transmittances known by it. */
#include "render/scene/medium.h"

typedef struct homogeneous {
    double scale;
    aur_volume_value albedo;
    aur_vector extinction; /* an inverse length of the scene, `scale` included */
} homogeneous;

static const aur_key keys[] = {
    {AUR_VOLUME_KEY("albedo", "0.75", "the part of the light it meets that it scatters, from 0 to 1")},
    {AUR_VOLUME_KEY("sigma_t", "1", "extinction: scattering and absorption, an inverse length")},
    {AUR_KEY_OF_REAL(homogeneous, "scale", scale, 0.0, 1e30, "1", "factor of sigma_t")},
};

static aur_result create(aur_parameters *parameters, aur_medium *medium, aur_error *error) {
    homogeneous *const self = medium->data;
    aur_result result = aur_keys_read(sizeof keys / sizeof keys[0], keys, parameters, self, error);
    aur_volume_value extinction = {.volume = NULL};
    if (result == AUR_OK)
        result = aur_volume_value_read(parameters, "albedo", 0.75f, 1.0f, &self->albedo, error);
    if (result == AUR_OK)
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

/* exp(-extinction * distance) of all channels over that of one. Its own is 1 to the bit. */
static aur_vector relative_transmittance(aur_vector extinction, float own, float distance) {
    const aur_vector more = {extinction.x - own, extinction.y - own, extinction.z - own};
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
    /* What only absorbs needs no chance. */
    if (absorbs_only(self)) {
        absorb(self, distance, walk);
        return false;
    }
    const float own = *aur_channel(&extinction, walk->channel);
    const float drawn = own > 0.0f ? -log1pf(-u) / own : INFINITY;
    const bool scatters = drawn < distance;
    const aur_vector passed = relative_transmittance(extinction, own, scatters ? drawn : distance);
    walk->throughput = aur_vector_multiply(walk->throughput, passed);
    walk->path = aur_vector_multiply(walk->path, passed);
    if (!scatters) {
        walk->light = aur_vector_scale(walk->light, own > 0.0f ? expf(own * distance) : 1.0f);
        return false;
    }
    *way = drawn;
    const aur_vector at = aur_vector_add_scaled(ray->origin, drawn, ray->direction);
    const aur_vector share = {extinction.x / own, extinction.y / own, extinction.z / own};
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
