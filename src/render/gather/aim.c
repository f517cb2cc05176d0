#include "render/gather/aim.h"

#include "points/base/random.h"
#include "render/sampling/rule.h"
#include "render/trace/interleave.h"
#include "render/vertex/shading.h"

/* --- randomisations of the patterns */

bool aur_gather_splits(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule) {
    const aur_gather_plan *const plan = surface_points->plan;
    return plan->policy.share == AUR_SHARE_BLOCKS && rule == &plan->rules.lobes[0] &&
           surface_points->bounces == 0;
}

bool aur_gather_pools(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule) {
    const aur_gather_plan *const plan = surface_points->plan;
    return plan->policy.share != AUR_SHARE_NONE && rule == &plan->rules.lobes[0] &&
           surface_points->bounces == 0;
}

/* Whether all rotations of a tile derive from one hash. */
static bool rotates_by_tile(const aur_gather_plan *plan, const aur_gather_rule *rule) {
    return plan->policy.decorrelation == AUR_DECORRELATION_BLUE && rule->rotation_count > 0;
}

static uint64_t tile_hash(const aur_gather_points *surface_points, size_t lane, uint64_t lobe) {
    const aur_gather_plan *const plan = surface_points->plan;
    const uint64_t pattern = aur_gather_points_hash(surface_points, lane, surface_points->tile);
    const uint64_t tile = aur_hash4(plan->seed, pattern, surface_points->bounces, lobe);
    /* Without splitting, each sample of a pixel gets another rotation. */
    return plan->rules.whole ? aur_hash2(tile, surface_points->index[lane]) : tile;
}

/* Of a nested rule, for several lanes. */
static void nested_rotations(const aur_gather_points *surface_points, const aur_gather_rule *rule,
                             uint32_t lanes, uint64_t lobe, aur_gather_rotation rotations[AUR_PACKET_SIZE]) {
    const size_t first = aur_first_lane(lanes);
    uint64_t tile = tile_hash(surface_points, first, lobe);
    float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)tile), cosine = cosf(angle), sine = sinf(angle);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest), pixel = surface_points->place[lane];
        const uint64_t hash = surface_points->grouped ? tile : tile_hash(surface_points, lane, lobe);
        if (hash != tile) {
            tile = hash;
            angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)tile);
            cosine = cosf(angle);
            sine = sinf(angle);
        }
        const size_t number = aur_nested_number(tile, pixel % AUR_TILE_SIZE, pixel / AUR_TILE_SIZE);
        rotations[lane] = aur_gather_rotation_by(rule->rotations[number], cosine, sine);
    }
}

aur_gather_rotation aur_gather_rotation_at(const aur_gather_points *surface_points,
                                           const aur_gather_lobe_rule *lobe_rule, size_t lane,
                                           uint64_t lobe) {
    const aur_gather_plan *const plan = surface_points->plan;
    const aur_gather_rule *const rule = &lobe_rule->rule;
    if (plan->policy.decorrelation == AUR_DECORRELATION_NONE)
        return aur_gather_rule_rotation(rule, 0);
    if (!rotates_by_tile(plan, rule))
        return aur_gather_rule_rotation(
            rule,
            aur_hash4(plan->seed, aur_gather_points_hash(surface_points, lane, surface_points->pixels[lane]),
                      surface_points->bounces, lobe));
    if (rule->nested) {
        aur_gather_rotation rotations[AUR_PACKET_SIZE];
        nested_rotations(surface_points, rule, 1u << lane, lobe, rotations);
        return rotations[lane];
    }
    const uint64_t tile = tile_hash(surface_points, lane, lobe);
    const uint32_t rank =
        aur_gather_splits(surface_points, lobe_rule) ? 0 : aur_group_rank(surface_points->group[lane]);
    /* Sixteen patterns repeated in every tile would be visible as texture. */
    if (rule->scramble != AUR_SCRAMBLE_ROTATE) {
        const uint64_t k = (rank ^ (tile & 15u)) * rule->rotation_count / 16;
        aur_gather_rotation rotation = aur_gather_rule_rotation(rule, k);
        rotation.word_v ^= rule->scramble != AUR_SCRAMBLE_NONE ? (uint32_t)(tile >> 32) : 0;
        return rotation;
    }
    aur_gather_rotation rotation = aur_gather_rule_rotation(rule, rank * rule->rotation_count / 16);
    rotation.word_v ^= (uint32_t)(tile >> 32);
    const float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)tile);
    return aur_gather_rotation_by(rotation, cosf(angle), sinf(angle));
}

size_t aur_gather_prepared_rotation(const aur_gather_points *surface_points, size_t rotations, size_t lane,
                                    bool *mirrored) {
    const aur_gather_settings *const policy = &surface_points->plan->policy;
    *mirrored = false;
    if (policy->decorrelation == AUR_DECORRELATION_NONE)
        return 0;
    const bool random = policy->decorrelation == AUR_DECORRELATION_RANDOM;
    const uint64_t hash =
        aur_hash3(surface_points->plan->seed,
                  aur_gather_points_hash(surface_points, lane,
                                         random ? surface_points->pixels[lane] : surface_points->tile),
                  surface_points->bounces);
    *mirrored = hash >> 63 != 0;
    if (random)
        return (hash & UINT32_MAX) % rotations;
    return (aur_group_rank(surface_points->group[lane]) ^ (hash & 15u)) * rotations / 16;
}

/* Whether all lanes share one rotation. */
static bool rotate_together(const aur_gather_plan *plan, const aur_gather_rule *rule) {
    const aur_gather_decorrelation how = plan->policy.decorrelation;
    return rule->square == NULL && !rule->nested &&
           (how == AUR_DECORRELATION_NONE || rule->scramble == AUR_SCRAMBLE_NONE ||
            (how == AUR_DECORRELATION_BLUE && rule->rotation_count > 0));
}

/* --- rays */

void aur_gather_set_frame(const aur_gather_point *surface_point, size_t lane, const aur_frame *frame,
                          aur_lobe_frames *frames, aur_gather_rays *gather_rays) {
    struct RTCRay16 *const rays = &gather_rays->packet.query.ray;
    const aur_surface *const surface = &surface_point->surface;
    aur_lane_set(&frames->x, lane, frame->x);
    aur_lane_set(&frames->y, lane, frame->y);
    aur_lane_set(&frames->z, lane, frame->z);
    aur_lane_set(&frames->shading, lane, aur_vector_scale(surface->frame.z, surface_point->side));
    aur_lane_set(&frames->geometric, lane, aur_vector_scale(surface->geometric_normal, surface_point->side));
    rays->org_x[lane] = surface_point->origin.x;
    rays->org_y[lane] = surface_point->origin.y;
    rays->org_z[lane] = surface_point->origin.z;
    rays->tnear[lane] = 0.0f;
    gather_rays->reference[lane] = aur_gather_point_reference(surface_point);
}

/* Sets the direction of one lane, in world coordinates; `above` is its height above the surface, by both
 * normals. */
static inline void set_direction(const aur_lobe_frames *restrict frames, size_t k, float x, float y, float z,
                                 struct RTCRay16 *restrict rays, float cosine[AUR_PACKET_SIZE],
                                 float above[AUR_PACKET_SIZE]) {
    cosine[k] = frames->shading.x[k] * x + frames->shading.y[k] * y + frames->shading.z[k] * z;
    const float beyond = frames->geometric.x[k] * x + frames->geometric.y[k] * y + frames->geometric.z[k] * z;
    above[k] = beyond < cosine[k] ? beyond : cosine[k];
    rays->dir_x[k] = x;
    rays->dir_y[k] = y;
    rays->dir_z[k] = z;
    rays->tfar[k] = INFINITY;
}

static inline uint32_t mask_packet(uint32_t lanes, const float above[AUR_PACKET_SIZE], aur_packet *packet) {
    uint32_t aimed = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const bool active = aur_has_lane(lanes, k) && above[k] > 0.0f;
        packet->valid[k] = active ? -1 : 0;
        aimed |= (uint32_t)active << k;
    }
    return aimed;
}

uint32_t aur_gather_aim(uint32_t lanes, const aur_lobe_frames *restrict frames, const aur_lane_vectors *local,
                        aur_packet *packet, float cosine[AUR_PACKET_SIZE]) {
    struct RTCRay16 *const rays = &packet->query.ray;
    float above[AUR_PACKET_SIZE];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float x = local->x[k], y = local->y[k], z = local->z[k];
        set_direction(frames, k, frames->x.x[k] * x + frames->y.x[k] * y + frames->z.x[k] * z,
                      frames->x.y[k] * x + frames->y.y[k] * y + frames->z.y[k] * z,
                      frames->x.z[k] * x + frames->y.z[k] * y + frames->z.z[k] * z, rays, cosine, above);
    }
    return mask_packet(lanes, above, packet);
}

uint32_t aur_gather_aim_world(uint32_t lanes, const aur_lobe_frames *restrict frames,
                              const float directions[3][AUR_PACKET_SIZE], aur_packet *packet,
                              float cosine[AUR_PACKET_SIZE]) {
    float above[AUR_PACKET_SIZE];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        set_direction(frames, k, directions[0][k], directions[1][k], directions[2][k], &packet->query.ray,
                      cosine, above);
    return mask_packet(lanes, above, packet);
}

bool aur_gather_aim_draw(const aur_gather_point *surface_point, size_t lane, const float u[3], float draws,
                         aur_gather_rays *rays, aur_vector *value, float *height) {
    const aur_surface *const surface = &surface_point->surface;
    const aur_shading shading = {surface, surface_point->view};
    aur_bsdf_sample drawn;
    if (!aur_shading_draw(&shading, AUR_BSDF_SAMPLED_LOBES, u, &drawn) || !(drawn.pdf > 0.0f))
        return false;
    *value = aur_vector_scale(drawn.weight, 1.0f / draws);
    *height = fabsf(aur_vector_dot(surface->frame.z, drawn.light));
    const aur_ray ray = aur_surface_ray(surface, drawn.light);
    aur_packet_set(&rays->packet, lane, &ray);
    rays->density[lane] = drawn.pdf * draws;
    rays->reference[lane] = aur_shading_reference(&shading);
    return true;
}

/* --- a rule, direction by direction */

void aur_gather_sweep_start(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule,
                            size_t lobe, uint32_t lanes, aur_gather_sweep *sweep, aur_gather_rays *rays) {
    *sweep = (aur_gather_sweep){.rule = rule,
                                .lobe = lobe,
                                .lanes = lanes,
                                .together = surface_points->grouped &&
                                            rotate_together(surface_points->plan, &rule->rule)};
    const size_t first = aur_first_lane(lanes);
    const bool nested = rule->rule.nested && rotates_by_tile(surface_points->plan, &rule->rule);
    if (nested)
        nested_rotations(surface_points, &rule->rule, lanes, lobe, sweep->rotations);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_point *const surface_point = &surface_points->at[lane];
        const aur_bsdf_lobe *const bsdf_lobe = &surface_point->lobes[lobe];
        if (bsdf_lobe->factor != NULL)
            sweep->factored |= 1u << lane;
        sweep->times_cosine[lane] = bsdf_lobe->times_cosine;
        if (!nested)
            sweep->rotations[lane] = sweep->together && lane != first
                                         ? sweep->rotations[first]
                                         : aur_gather_rotation_at(surface_points, rule, lane, lobe);
        const aur_frame frame = aur_frame_about(aur_gather_point_axis(surface_point, lobe));
        aur_gather_set_frame(surface_point, lane, &frame, &sweep->frames, rays);
    }
}

/* Direction `index` in the frames of all lanes, with its weights and the densities that other strategies are
 * weighed against. Returns the lanes whose part of the rule has it. */
static uint32_t set_directions(const aur_gather_sweep *sweep, size_t index, aur_lane_vectors *local,
                               float weight[AUR_PACKET_SIZE], float density[AUR_PACKET_SIZE]) {
    const aur_gather_rule *const rule = &sweep->rule->rule;
    const float directions = sweep->rule->directions;
    aur_vector direction;
    if (sweep->together) {
        const size_t first = aur_first_lane(sweep->lanes);
        const aur_gather_rotation *const rotation = &sweep->rotations[first];
        index += sweep->part[first];
        if (index >= rule->count)
            return 0;
        const float one = aur_gather_rule_direction(rule, rotation, index, &direction);
        const float drawn = rule->densities[rotation->first + index] * directions;
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            aur_lane_set(local, k, direction);
            weight[k] = one;
            density[k] = drawn;
        }
        return sweep->lanes;
    }
    uint32_t lanes = 0;
    for (uint32_t rest = sweep->lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_rotation *const rotation = &sweep->rotations[lane];
        const size_t number = index + sweep->part[lane];
        if (number >= rule->count)
            continue;
        lanes |= 1u << lane;
        if (rule->square == NULL) {
            weight[lane] = aur_gather_rule_stored(rule, rotation, number, &direction);
            density[lane] = directions * rule->densities[rotation->first + number];
        } else {
            weight[lane] = aur_gather_rule_direction(rule, rotation, number, &direction);
            density[lane] = directions * aur_gather_rule_density(rule, direction.z);
        }
        aur_lane_set(local, lane, direction);
    }
    return lanes;
}

void aur_gather_set_probability(const aur_gather_points *surface_points, const aur_gather_sweep *sweep,
                                size_t index, aur_gather_rays *rays) {
    uint64_t hash = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        if (k == 0 || !surface_points->grouped)
            hash = aur_hash4(surface_points->index[k], surface_points->bounces, sweep->lobe,
                             index + sweep->part[k]);
        rays->hash[k] = hash;
    }
    rays->pixels = surface_points->pixels;
}

uint32_t aur_gather_sweep_trace(const aur_gather_points *surface_points, const aur_gather_sweep *sweep,
                                size_t index, bool weighed, aur_gather_sums *sums,
                                float factor[AUR_PACKET_SIZE]) {
    aur_gather_rays *const rays = &sums->rays;
    aur_lane_vectors local = {0};
    float cosine[AUR_PACKET_SIZE], weight[AUR_PACKET_SIZE] = {0};
    const uint32_t lanes = set_directions(sweep, index, &local, weight, rays->density);
    if (lanes == 0)
        return 0;
    const uint32_t aimed = aur_gather_aim(lanes, &sweep->frames, &local, &rays->packet, cosine);
    if (aimed == 0)
        return 0;
    aur_gather_set_probability(surface_points, sweep, index, rays);
    aur_gather_rays_trace(surface_points->plan, surface_points->order, rays, sums->counters);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        factor[k] = (weighed ? weight[k] : 1.0f) * (sweep->times_cosine[k] ? cosine[k] : 1.0f);
    for (uint32_t rest = sweep->factored & aimed; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        factor[lane] *= aur_lobe_factor(&surface_points->at[lane].lobes[sweep->lobe], cosine[lane]);
    }
    return aimed;
}
