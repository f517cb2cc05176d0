#include "transport/gather/sample.h"

#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "transport/gather/chain.h"
#include "transport/gather/drawn_light.h"
#include "transport/gather/shade.h"
#include "transport/lights/shading.h"
#include "transport/packets/interleave.h"

struct aur_gather_group {
    aur_gather_places places;
    aur_gather_sums sums;
    aur_gather_scratch *scratch;
    aur_camera_sample samples[AUR_PACKET_SIZE]; /* the rays become those after the last bounce */
    float weights[AUR_PACKET_SIZE];
    aur_stratum *strata[AUR_PACKET_SIZE]; /* that the lanes' samples go to; NULL: none */
};

aur_gather_group *aur_gather_group_create(const aur_gather_plan *plan) {
    aur_gather_group *const group = calloc(1, sizeof *group);
    if (group == NULL)
        return NULL;
    group->scratch = aur_gather_scratch_create(plan);
    if (group->scratch != NULL)
        return group;
    free(group);
    return NULL;
}

void aur_gather_group_destroy(aur_gather_group *group) {
    if (group == NULL)
        return;
    aur_gather_scratch_destroy(group->scratch);
    free(group);
}

static void begin(aur_gather_group *group, const aur_gather_task *task, aur_counters *counters) {
    aur_gather_places *const places = &group->places;
    aur_gather_sums *const sums = &group->sums;
    size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
    aur_group_pixels(task->group, task->x, task->y, x, y);
    aur_view_samples(task->view, AUR_PACKET_SIZE, x, y, task->index, group->samples, group->weights);
    places->lanes = task->lanes;
    places->group = task->group;
    places->index = task->index;
    places->tile = aur_hash2(task->y, task->x);
    places->sampler = task->view->sampler;
    sums->counters = counters;
    sums->pooled_lanes = 0;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        places->pixels[lane] = group->samples[lane].stream.pixel;
        places->throughput[lane] = (aur_vector){1.0f, 1.0f, 1.0f};
        sums->radiance[lane] = (aur_vector){0};
        sums->directions[lane] = 0;
        group->strata[lane] = NULL;
    }
}

/* Traces the rays of all lanes; returns those that hit something. */
static uint32_t trace(const aur_gather_plan *plan, aur_gather_group *group) {
    aur_packet *const packet = &group->scratch->rays.packet;
    aur_packet_empty(packet);
    for (uint32_t rest = group->places.lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_packet_set(packet, lane, &group->samples[lane].ray);
    }
    const aur_embree_order order = group->places.bounces == 0 ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
    return aur_gather_intersect(plan, order, packet, group->sums.counters);
}

/* Counts what the eye's rays met. Lanes that need no shading for it are taken out. */
static void count_seen(aur_gather_group *group, const aur_gather_task *task, uint32_t found,
                       aur_pixel_strata *strata) {
    const aur_packet *const packet = &group->scratch->rays.packet;
    for (uint32_t rest = group->places.lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const uint64_t key =
            aur_has_lane(found, lane) ? aur_gather_surface_key(task->plan->classes, packet, lane) : 0;
        bool known;
        aur_stratum *const stratum =
            aur_pixel_strata_find(&strata[aur_group_pixel(task->group, lane)], key, &known);
        stratum->seen += (double)group->weights[lane];
        if (task->only_new && known && stratum->shaded > 0.0)
            group->places.lanes &= ~(1u << lane);
        else
            group->strata[lane] = stratum;
    }
}

/* Light from beyond the scene, for lanes whose ray left it. */
static void add_sky(const aur_gather_plan *plan, aur_gather_group *group, uint32_t lanes) {
    if (plan->policy.direct == AUR_DIRECT_NONE || !aur_scene_has_environment(plan->scene))
        return;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_gather_add(&group->sums, &group->places, lane,
                       aur_scene_environment(plan->scene, group->samples[lane].ray.direction));
    }
}

/* The surfaces that the rays met, with the light that reaches the eye from them without being gathered:
 * caustics, and what they emit. */
static void set_places(const aur_gather_plan *plan, aur_gather_group *group) {
    const aur_scene *const scene = plan->scene;
    const aur_irradiance_map *const caustics = plan->light.caustics;
    for (uint32_t rest = group->places.lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_hit hit = aur_packet_hit(scene, &group->scratch->rays.packet, lane);
        const aur_ray *const ray = &group->samples[lane].ray;
        const aur_surface *const surface = &group->places.at[lane].surface;
        aur_gather_place_set(plan, ray, &hit, &group->places.at[lane]);
        if (plan->policy.direct == AUR_DIRECT_NONE)
            continue;
        const aur_vector view = aur_vector_scale(ray->direction, -1.0f);
        if (caustics != NULL)
            aur_gather_add(&group->sums, &group->places, lane,
                           aur_irradiance_radiance(caustics, scene, &hit, surface, view));
        if (surface->emitter != AUR_NO_EMITTER)
            aur_gather_add(&group->sums, &group->places, lane, aur_surface_emission(scene, surface, view));
    }
    group->places.order = aur_gather_places_order(&group->places);
}

/* A lane's ray in the direction of a specular lobe; false where there is none, or it absorbs the light. */
static bool bounce_lane(aur_gather_group *group, size_t lane) {
    const aur_gather_place *const place = &group->places.at[lane];
    if ((aur_bsdf_scatters(place->surface.bsdf, place->view.z) & AUR_SCATTERS_SPECULAR) == 0)
        return false;
    const uint32_t pair = aur_gather_first_pair(group->places.bounces);
    const aur_stream *const stream = &group->samples[lane].stream;
    float lobe[2], direction[2];
    aur_stream_pair(stream, pair + AUR_GATHER_PAIR_LOBE, lobe);
    aur_stream_pair(stream, pair + AUR_GATHER_PAIR_BOUNCE, direction);
    const aur_shading shading = {&place->surface, place->view};
    aur_bsdf_sample drawn;
    if (!aur_shading_sample(&shading, (const float[3]){lobe[0], direction[0], direction[1]}, &drawn) ||
        !drawn.specular)
        return false;
    aur_vector *const throughput = &group->places.throughput[lane];
    *throughput = aur_vector_multiply(*throughput, drawn.weight);
    group->samples[lane].ray = aur_surface_ray(&place->surface, drawn.light);
    return true;
}

/* Lanes whose surface has a specular lobe go on in its direction; the others are done. The other lobes of
 * either have been gathered for. */
static void bounce(aur_gather_group *group) {
    for (uint32_t rest = group->places.lanes; rest != 0; rest &= rest - 1)
        if (!bounce_lane(group, aur_first_lane(rest)))
            group->places.lanes &= ~(1u << aur_first_lane(rest));
}

void aur_gather_add_samples(aur_gather_group *group, const aur_gather_task *task, aur_pixel_strata *strata,
                            aur_counters *counters) {
    const aur_gather_plan *const plan = task->plan;
    aur_gather_places *const places = &group->places;
    begin(group, task, counters);
    for (places->bounces = 0; places->bounces <= AUR_LONGEST_CHAIN && places->lanes != 0; ++places->bounces) {
        const uint32_t found = trace(plan, group);
        if (places->bounces == 0)
            count_seen(group, task, found, strata);
        add_sky(plan, group, places->lanes & ~found);
        places->lanes &= found;
        if (places->lanes == 0)
            break;
        set_places(plan, group);
        aur_gather_shade(plan, places, &group->sums, group->scratch);
        bounce(group);
    }
    counters->cut += aur_lane_count(places->lanes);
    for (uint32_t rest = task->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        if (group->strata[lane] != NULL)
            aur_pixel_strata_add(&strata[aur_group_pixel(task->group, lane)], group->strata[lane],
                                 &group->sums, lane, group->weights[lane]);
    }
}
