/* Sixteen pixels at a time: what the eye's rays meet, and what becomes of it. */
#include <stdlib.h>
#include <string.h>

#include "transport/gather/group.h"
#include "transport/lights/shading.h"

aur_group *aur_group_create(const aur_final_gather *data) {
    aur_group *const group = aligned_alloc(64, (sizeof(aur_group) + 63) / 64 * 64);
    if (group == NULL)
        return NULL;
    memset(group, 0, sizeof *group);
    aur_packet_clear(&group->rays.packet);
    size_t most = 0;
    for (size_t i = 0; i < data->pair_count; ++i)
        if (aur_gather_pair_share(data->pairs[i]) > most)
            most = aur_gather_pair_share(data->pairs[i]);
    group->values = malloc((3 * AUR_PACKET_SIZE * data->most_directions + 1) * sizeof *group->values);
    group->merged = calloc(2 * most * (AUR_PACKET_SIZE + 1) + 1, sizeof *group->merged);
    if (group->merged != NULL && group->values != NULL)
        return group;
    aur_group_destroy(group);
    return NULL;
}

void aur_group_destroy(aur_group *group) {
    if (group == NULL)
        return;
    free(group->merged);
    free(group->values);
    free(group);
}

static bool has_specular(const aur_gather_place *p) {
    return (aur_bsdf_scatters(p->surface.bsdf, p->view.z) & AUR_SCATTERS_SPECULAR) != 0;
}

static void set_place(const aur_scene *scene, const aur_ray *ray, const aur_hit *hit, aur_gather_place *p) {
    aur_scene_surface(scene, ray, hit, &p->surface);
    const aur_vector view = aur_vector_scale(ray->direction, -1.0f);
    p->side = aur_vector_dot(p->surface.geometric_normal, view) < 0.0f ? -1.0f : 1.0f;
    p->view = aur_frame_to_local(&p->surface.frame, view);
    p->origin = aur_surface_ray(&p->surface, aur_vector_scale(p->surface.geometric_normal, p->side)).origin;
    p->lobe_count = aur_bsdf_lobes(p->surface.bsdf, p->surface.texture, p->view, p->lobes);
}

/* Whether a packet from these places is coherent: from normals and positions, never from timing. */
static bool are_flat(const aur_group *group) {
    if (aur_lane_count(group->lanes) < AUR_PACKET_SIZE / 2)
        return false;
    const aur_gather_place *const first = &group->places[aur_first_lane(group->lanes)];
    for (uint32_t rest = group->lanes; rest != 0; rest &= rest - 1) {
        const aur_gather_place *const p = &group->places[aur_first_lane(rest)];
        const aur_vector offset = aur_vector_subtract(p->origin, first->origin);
        const float height = aur_vector_dot(offset, first->surface.geometric_normal);
        if (aur_vector_dot(p->surface.frame.z, first->surface.frame.z) * p->side * first->side < 0.995f ||
            height * height > 0.01f * aur_vector_dot(offset, offset))
            return false;
    }
    return true;
}

uint64_t aur_final_gather_key(const aur_final_gather *data, const aur_packet *packet, size_t lane) {
    const struct RTCRay16 *const rays = &packet->query.ray;
    const struct RTCHit16 *const hits = &packet->query.hit;
    const uint32_t shape = hits->geomID[lane];
    const aur_shape_class *const class = &data->classes[shape];
    const uint64_t key = (class->emits ? AUR_KEY_EMITS : 0) | ((uint64_t)shape * 8 + 1);
    if (class->curved)
        return key;
    const aur_vector n = {hits->Ng_x[lane], hits->Ng_y[lane], hits->Ng_z[lane]};
    const bool behind = n.x * rays->dir_x[lane] + n.y * rays->dir_y[lane] + n.z * rays->dir_z[lane] > 0.0f;
    return key + aur_vector_facing(behind ? aur_vector_scale(n, -1.0f) : n);
}

static aur_stratum *stratum_of(aur_pixel_strata *pixel, uint64_t key, bool *found) {
    for (uint32_t i = 0; i < pixel->count; ++i)
        if (pixel->strata[i].key == key) {
            *found = true;
            return &pixel->strata[i];
        }
    *found = pixel->count == AUR_STRATUM_COUNT;
    if (*found)
        return &pixel->strata[AUR_STRATUM_COUNT - 1];
    aur_stratum *const added = &pixel->strata[pixel->count++];
    *added = (aur_stratum){.key = key};
    return added;
}

/* Counts what the eye's rays met. Lanes that need no shading for it are taken out. */
static void count_seen(aur_group *group, uint32_t lanes, uint32_t found, aur_pixel_strata *strata,
                       aur_stratum *into[AUR_PACKET_SIZE]) {
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const bool hits = (found >> lane & 1u) != 0;
        const uint64_t key = hits ? aur_final_gather_key(group->task->data, &group->rays.packet, lane) : 0;
        bool known;
        into[lane] = stratum_of(&strata[aur_group_pixel(group->task->group, lane)], key, &known);
        into[lane]->seen += (double)group->weights[lane];
        if (group->task->known && known && into[lane]->shaded > 0.0) {
            group->lanes &= ~(1u << lane);
            into[lane] = NULL;
        }
    }
}

static void add_shared(const aur_group *group, size_t lane, aur_stratum *stratum) {
    const float weight = group->weights[lane];
    stratum->gathers += weight;
    stratum->irradiance = aur_vector_add_scaled(stratum->irradiance, weight, group->irradiance[lane]);
    stratum->coefficient = aur_vector_add_scaled(stratum->coefficient, weight, group->coefficient[lane]);
    stratum->position = aur_vector_add_scaled(stratum->position, weight, group->shared_position[lane]);
    stratum->normal = aur_vector_add_scaled(stratum->normal, weight, group->shared_normal[lane]);
}

static void add_to_strata(const aur_group *group, aur_pixel_strata *strata,
                          aur_stratum *const into[AUR_PACKET_SIZE], aur_counters *counters) {
    for (uint32_t rest = group->task->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        if (into[lane] == NULL)
            continue;
        if (!aur_is_radiance(group->sum[lane])) {
            ++counters->invalid;
            into[lane]->seen -= (double)group->weights[lane];
            continue;
        }
        const double weight = (double)group->weights[lane];
        strata[aur_group_pixel(group->task->group, lane)].directions += group->directions[lane];
        into[lane]->shaded += weight;
        into[lane]->sum[0] += weight * (double)group->sum[lane].x;
        into[lane]->sum[1] += weight * (double)group->sum[lane].y;
        into[lane]->sum[2] += weight * (double)group->sum[lane].z;
        if ((group->shared >> lane & 1u) != 0)
            add_shared(group, lane, into[lane]);
        ++strata[aur_group_pixel(group->task->group, lane)].samples;
    }
}

static void add_light(aur_group *group, size_t lane, aur_vector radiance) {
    group->sum[lane] =
        aur_vector_add(group->sum[lane], aur_vector_multiply(group->throughput[lane], radiance));
}

static void add_sky(aur_group *group, uint32_t lanes) {
    const aur_final_gather *const data = group->task->data;
    if (data->direct == AUR_DIRECT_NONE || !aur_scene_has_environment(data->scene))
        return;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        add_light(group, lane, aur_scene_environment(data->scene, group->samples[lane].ray.direction));
    }
}

static void add_emission(aur_group *group) {
    for (uint32_t rest = group->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_surface *const surface = &group->places[lane].surface;
        if (surface->emitter == AUR_NO_EMITTER)
            continue;
        const aur_vector view = aur_vector_scale(group->samples[lane].ray.direction, -1.0f);
        add_light(group, lane, aur_surface_emission(group->task->data->scene, surface, view));
    }
}

/* Lanes whose surface has a specular lobe go on in its direction; the others are done. A surface with other
 * lobes too has been gathered for them. */
static void bounce(aur_group *group) {
    const uint32_t pair = AUR_PAIR_FIRST + AUR_GATHER_PAIRS * group->chain;
    for (uint32_t rest = group->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_place *const p = &group->places[lane];
        bool goes_on = false;
        if (has_specular(p)) {
            float lobe[2], direction[2];
            aur_stream_pair(&group->samples[lane].stream, pair + AUR_GATHER_PAIR_LOBE, lobe);
            aur_stream_pair(&group->samples[lane].stream, pair + AUR_GATHER_PAIR_BOUNCE, direction);
            const aur_shading shading = {&p->surface, p->view};
            aur_bsdf_sample drawn;
            goes_on =
                aur_shading_sample(&shading, (const float[3]){lobe[0], direction[0], direction[1]}, &drawn) &&
                drawn.specular;
            if (goes_on) {
                group->throughput[lane] = aur_vector_multiply(group->throughput[lane], drawn.weight);
                group->samples[lane].ray = aur_surface_ray(&p->surface, drawn.light);
            }
        }
        if (!goes_on)
            group->lanes &= ~(1u << lane);
    }
}

static uint32_t trace(aur_group *group) {
    const aur_final_gather *const data = group->task->data;
    aur_packet *const packet = &group->rays.packet;
    aur_packet_empty(packet);
    for (uint32_t rest = group->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_packet_set(packet, lane, &group->samples[lane].ray);
    }
    const aur_embree_order order = group->chain == 0 ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
    return aur_final_gather_intersect(data, order, packet, group->counters);
}

static void set_places(aur_group *group) {
    const aur_final_gather *const data = group->task->data;
    const aur_scene *const scene = data->scene;
    for (uint32_t rest = group->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_hit hit = aur_packet_hit(scene, &group->rays.packet, lane);
        aur_gather_place *const p = &group->places[lane];
        const aur_ray *const ray = &group->samples[lane].ray;
        set_place(scene, ray, &hit, p);
        if (data->caustics != NULL && data->direct != AUR_DIRECT_NONE)
            add_light(group, lane,
                      aur_irradiance_radiance(data->caustics, scene, &hit, &p->surface,
                                              aur_vector_scale(ray->direction, -1.0f)));
    }
}

void aur_group_add_sample(aur_group *group, const aur_group_task *task, aur_pixel_strata *strata,
                          aur_counters *counters) {
    const aur_final_gather *const data = task->data;
    aur_stratum *into[AUR_PACKET_SIZE] = {0};
    group->task = task;
    group->counters = counters;
    group->lanes = task->lanes;
    group->shared = 0;
    size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
    aur_group_pixels(task->group, task->x, task->y, x, y);
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        group->throughput[lane] = (aur_vector){1.0f, 1.0f, 1.0f};
        group->sum[lane] = (aur_vector){0};
        group->directions[lane] = 0;
    }
    aur_view_samples(task->view, AUR_PACKET_SIZE, x, y, task->index, group->samples, group->weights);
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
        group->pixels[lane] = group->samples[lane].stream.pixel;
    for (group->chain = 0; group->chain <= AUR_LONGEST_CHAIN && group->lanes != 0; ++group->chain) {
        const uint32_t found = trace(group);
        if (group->chain == 0)
            count_seen(group, group->lanes, found, strata, into);
        add_sky(group, group->lanes & ~found);
        group->lanes &= found;
        if (group->lanes == 0)
            break;
        set_places(group);
        if (data->direct != AUR_DIRECT_NONE)
            add_emission(group);
        group->flat = are_flat(group);
        if (data->direct == AUR_DIRECT_NEE && data->max_depth >= 2 &&
            aur_scene_emitter_count(data->scene) > 0)
            aur_group_add_direct_light(group);
        if (data->bright_share > 0)
            aur_group_add_bright_light(group);
        aur_group_gather(group);
        bounce(group);
    }
    add_to_strata(group, strata, into, counters);
}
