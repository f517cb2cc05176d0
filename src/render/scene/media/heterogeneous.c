/* Heterogeneous media. Distances are sampled by delta tracking, transmittance is estimated by ratio tracking
 * (Woodcock et al. 1965; Novak, Selle and Jarosz 2014). The majorant is the largest extinction of any channel
 * per cell of a coarse grid. */
#include <stdlib.h>

#include "points/base/parallel.h"
#include "points/base/random.h"
#include "render/scene/media/majorants.h"

typedef struct heterogeneous {
    double scale;
    aur_volume_value albedo, extinction; /* extinction: before `scale` */
    aur_majorants majorants;
} heterogeneous;

static const aur_key keys[] = {
    {AUR_VOLUME_KEY("albedo", "0.75", "share of scattered light in an interaction, from 0 to 1")},
    {AUR_VOLUME_KEY("sigma_t", "1", "extinction: scattering and absorption, an inverse length")},
    {AUR_KEY_OF_REAL(heterogeneous, "scale", scale, 0.0, 1e30, "1", "factor of sigma_t")},
};

extern const aur_medium_descriptor aur_medium_homogeneous;

/* A constant medium is homogeneous, and needs no tracking. */
static aur_result become_homogeneous(aur_parameters *parameters, aur_medium *medium, aur_error *error) {
    free(medium->data);
    medium->descriptor = &aur_medium_homogeneous;
    medium->data = calloc(1, medium->descriptor->size);
    return medium->data != NULL ? medium->descriptor->create(parameters, medium, error)
                                : aur_fail_memory_at(error, parameters->location);
}

static aur_result create(aur_parameters *parameters, aur_medium *medium, aur_error *error) {
    heterogeneous *const self = medium->data;
    aur_result result = aur_keys_read(sizeof keys / sizeof keys[0], keys, parameters, self, error);
    if (result == AUR_OK)
        result = aur_volume_value_read(parameters, "albedo", 0.75f, 1.0f, &self->albedo, error);
    if (result == AUR_OK)
        result = aur_volume_value_read(parameters, "sigma_t", 1.0f, 1e30f, &self->extinction, error);
    if (result != AUR_OK)
        return result;
    const aur_volume *const varying = self->extinction.volume;
    if (varying == NULL)
        return become_homogeneous(parameters, medium, error);
    if (!(self->scale * (double)varying->maximum <= 1e30))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "'sigma_t' times 'scale' must be at most 1e30");
    return aur_majorants_create(varying, (float)self->scale, &self->majorants, error);
}

static void release(void *data) {
    aur_majorants_release(&((heterogeneous *)data)->majorants);
}

/* Iteration over tentative collisions. */
typedef struct tracking {
    const heterogeneous *medium;
    const aur_ray *ray;
    aur_medium_walk *walk;
    uint32_t count;
    aur_majorant_walk cells;
    float at, end;   /* distance in the cell */
    float majorant;  /* of the cell */
    aur_vector real; /* extinction over majorant at the last collision: at most 1 */
    aur_vector position;
} tracking;

static void begin(const heterogeneous *self, const aur_ray *ray, float distance, aur_medium_walk *walk,
                  tracking *t) {
    *t = (tracking){.medium = self, .ray = ray, .walk = walk, .at = 0.0f, .end = -1.0f};
    aur_majorant_walk_begin(&self->majorants, ray, distance, &t->cells);
}

/* A voxel of 1e20 would make free paths shorter than the float spacing, and the ray would never leave it. */
enum { MOST_COLLISIONS = 1 << 20, COLLISIONS_BETWEEN = 1 << 14 };

/* Whether the ray continues after `count` collisions. */
static bool goes_on(tracking *t) {
    t->walk->cut = t->count >= MOST_COLLISIONS;
    t->walk->stopped = aur_parallel_stops();
    return !t->walk->cut && !t->walk->stopped;
}

/* The next tentative collision, at the optical depth for u; false if there is none before the end. */
static bool collide(tracking *t, float u) {
    if (++t->count % COLLISIONS_BETWEEN == 0 && !goes_on(t))
        return false;
    for (float depth = -log1pf(-u);;) {
        const float cell = t->at < t->end ? t->majorant * (t->end - t->at) : 0.0f;
        if (depth < cell) {
            t->at += depth / t->majorant;
            break;
        }
        depth -= cell;
        if (!aur_majorant_walk_next(&t->cells, &t->at, &t->end, &t->majorant))
            return false;
    }
    t->position = aur_vector_add_scaled(t->ray->origin, t->at, t->ray->direction);
    const aur_vector extinction = aur_volume_value_at(&t->medium->extinction, t->position);
    const float factor = (float)t->medium->scale / t->majorant;
    t->real = (aur_vector){aur_smaller(factor * extinction.x, 1.0f), aur_smaller(factor * extinction.y, 1.0f),
                           aur_smaller(factor * extinction.z, 1.0f)};
    return true;
}

static aur_vector rest_of(aur_vector share) {
    return (aur_vector){1.0f - share.x, 1.0f - share.y, 1.0f - share.z};
}

static bool absorbs_only(const heterogeneous *self) {
    return self->albedo.volume == NULL && aur_vector_is_zero(self->albedo.constant);
}

/* An unbiased estimate of the transmittance, with Russian roulette at low transmittance. */
static void pass(const aur_medium *medium, const aur_ray *ray, float distance, aur_medium_walk *walk) {
    static const float little = 0.1f, go_on = 0.5f;
    const heterogeneous *const self = medium->data;
    aur_vector left = {1.0f, 1.0f, 1.0f};
    tracking t;
    begin(self, ray, distance, walk, &t);
    while (collide(&t, aur_draw_unit(&walk->hash))) {
        left = aur_vector_multiply(left, rest_of(t.real));
        if (!absorbs_only(self))
            walk->path = aur_vector_multiply(walk->path, rest_of(t.real));
        if (!(aur_vector_max(left) < little))
            continue;
        left = aur_vector_scale(left, aur_draw_unit(&walk->hash) < go_on ? 1.0f / go_on : 0.0f);
        if (aur_vector_is_zero(left))
            break;
    }
    walk->throughput = aur_vector_multiply(walk->throughput, left);
}

static bool travel(const aur_medium *medium, const aur_ray *ray, float distance, float u,
                   aur_medium_walk *walk, float *way) {
    const heterogeneous *const self = medium->data;
    if (absorbs_only(self)) {
        pass(medium, ray, distance, walk);
        return false;
    }
    tracking t;
    begin(self, ray, distance, walk, &t);
    for (; collide(&t, u); u = aur_draw_unit(&walk->hash)) {
        const float reference = *aur_channel(&t.real, walk->channel);
        if (aur_draw_unit(&walk->hash) < reference) {
            const aur_vector share = {t.real.x / reference, t.real.y / reference, t.real.z / reference};
            walk->path = aur_vector_multiply(walk->path, share);
            walk->throughput = aur_vector_multiply(
                walk->throughput, aur_vector_multiply(share, aur_volume_value_at(&self->albedo, t.position)));
            *way = t.at;
            return true;
        }
        const float none = 1.0f - reference;
        const aur_vector null = rest_of(t.real), share = {null.x / none, null.y / none, null.z / none};
        walk->throughput = aur_vector_multiply(walk->throughput, share);
        walk->path = aur_vector_multiply(walk->path, share);
        walk->light = aur_vector_scale(walk->light, 1.0f / none);
    }
    return false;
}

const aur_medium_descriptor aur_medium_heterogeneous = {
    .row = {.name = "heterogeneous",
            .summary = "extinction and albedo that vary",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(heterogeneous),
    .create = create,
    .release = release,
    .travel = travel,
    .pass = pass,
};
