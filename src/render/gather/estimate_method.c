/* Lobes gathered by a method that the caller supplies, and the functions that it calls. */
#include <string.h>

#include "points/base/random.h"
#include "render/gather/estimators.h"

_Static_assert((int)AUR_GATHER_LANES == (int)AUR_PACKET_SIZE,
               "a lane of a caller's method is one of a packet");

/* --- one lobe by a pattern */

uint32_t aur_gather_trace(aur_gather_sweep *sweep, uint32_t lanes, size_t index,
                          float values[3][AUR_GATHER_LANES]) {
    float factor[AUR_PACKET_SIZE];
    sweep->lanes = lanes;
    sweep->sums->rays.radiance = values;
    const uint32_t aimed =
        aur_gather_sweep_trace(sweep->surface_points, sweep, index, false, sweep->sums, factor);
    aur_gather_rays_finish(sweep->surface_points->plan, &sweep->sums->rays);
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            values[c][k] = aur_has_lane(aimed, k) ? factor[k] * values[c][k] : 0.0f;
    return aimed;
}

void aur_gather_finish(aur_gather_sweep *sweep, size_t lane, const float integral[3], size_t directions,
                       size_t level) {
    aur_gather_sums *const sums = sweep->sums;
    aur_gather_add(sums, sweep->surface_points, lane,
                   aur_vector_multiply((aur_vector){integral[0], integral[1], integral[2]},
                                       sweep->surface_points->at[lane].lobes[sweep->lobe].coefficient));
    sums->directions[lane] += (uint32_t)directions;
    if (level < AUR_RENDER_LEVELS)
        ++sums->counters->levels[level];
}

void aur_gather_by_method(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule,
                          size_t lobe, uint32_t lanes, aur_gather_sums *sums) {
    aur_gather_sweep sweep;
    aur_gather_sweep_start(surface_points, rule, lobe, lanes, &sweep, &sums->rays);
    sweep.surface_points = surface_points;
    sweep.sums = sums;
    surface_points->plan->rules.method->gather(rule->state, lanes, &sweep, sums->numbers);
}

/* --- pairs of lobes, and GGX lobes */

static void write_vector(aur_vector vector, float numbers[3]) {
    numbers[0] = vector.x;
    numbers[1] = vector.y;
    numbers[2] = vector.z;
}

/* Writes axis and colour of a lobe that is gathered. */
static void describe_lobe(const aur_gather_plan *plan, const aur_gather_point *surface_point, size_t lobe,
                          size_t which, aur_gather_shading_point *point) {
    write_vector(aur_gather_point_axis(surface_point, lobe), point->axes[which]);
    if (aur_gather_plan_gathers(plan, &surface_point->lobes[lobe]))
        write_vector(surface_point->lobes[lobe].coefficient, point->colours[which]);
}

/* Whether a point gathers for one diffuse lobe only; its number goes to `lobe`. */
static bool is_diffuse(const aur_gather_plan *plan, const aur_gather_point *surface_point, size_t *lobe) {
    size_t gathered = 0;
    bool diffuse = false;
    for (size_t i = 0; i < surface_point->lobe_count; ++i) {
        const aur_bsdf_lobe *const bsdf_lobe = &surface_point->lobes[i];
        const bool has_formula = bsdf_lobe->shape == AUR_LOBE_SHAPE_COSINE_POWER;
        if (!aur_gather_plan_gathers(plan, bsdf_lobe) || !aur_gather_point_has(surface_point, i))
            continue;
        ++gathered;
        diffuse =
            has_formula && bsdf_lobe->diffuse && bsdf_lobe->exponent == 1.0f && bsdf_lobe->factor == NULL;
        *lobe = i;
    }
    return gathered == 1 && diffuse;
}

static bool describe_pair(const aur_gather_points *surface_points, size_t lane,
                          aur_gather_shading_point *point) {
    const aur_gather_plan *const plan = surface_points->plan;
    const aur_gather_point *const surface_point = &surface_points->at[lane];
    size_t lobe = 0;
    if (surface_point->paired) {
        const size_t *const pair = surface_point->pair;
        point->state = surface_point->rules[pair[1]]->state;
        point->times_cosine = surface_point->lobes[pair[1]].times_cosine;
        for (size_t k = 0; k < 2; ++k)
            describe_lobe(plan, surface_point, pair[k], k, point);
        return true;
    }
    if (!is_diffuse(plan, surface_point, &lobe))
        return false;
    const aur_gather_rotation rotation =
        aur_gather_rotation_at(surface_points, &plan->rules.lobes[0], lane, lobe);
    point->cosine = rotation.cosine;
    point->sine = rotation.sine;
    point->first = rotation.first;
    describe_lobe(plan, surface_point, lobe, 0, point);
    return true;
}

bool aur_gather_describe(const aur_gather_sweep *sweep, size_t lane, aur_gather_shading_point *point) {
    const aur_gather_points *const surface_points = sweep->surface_points;
    const size_t rotations = surface_points->plan->policy.rotations;
    const aur_gather_point *const surface_point = &surface_points->at[lane];
    *point = (aur_gather_shading_point){0};
    if (!aur_has_lane(sweep->lanes, lane))
        return false;
    write_vector(surface_point->view, point->view);
    if (rotations > 0)
        point->rotation = aur_gather_prepared_rotation(surface_points, rotations, lane, &point->mirrored);
    if (sweep->pairs)
        return describe_pair(surface_points, lane, point);
    point->state = surface_point->ggx;
    return true;
}

size_t aur_gather_subset(const aur_gather_sweep *sweep) {
    return aur_gather_part(sweep->surface_points, 0);
}

/* Traces the packet; radiance is 0 if no lane is aimed. */
static uint32_t trace(aur_gather_sweep *sweep, uint32_t aimed, size_t index,
                      float radiance[3][AUR_GATHER_LANES]) {
    const aur_gather_points *const surface_points = sweep->surface_points;
    aur_gather_rays *const rays = &sweep->sums->rays;
    memset(radiance, 0, 3 * sizeof radiance[0]);
    if (aimed == 0)
        return 0;
    rays->radiance = radiance;
    aur_gather_set_probability(surface_points, sweep, index, rays);
    aur_gather_rays_trace(surface_points->plan, surface_points->order, rays, sweep->sums->counters);
    aur_gather_rays_finish(surface_points->plan, rays);
    return aimed;
}

uint32_t aur_gather_trace_directions(aur_gather_sweep *sweep, uint32_t lanes, size_t index,
                                     const float directions[3][AUR_GATHER_LANES],
                                     const float densities[AUR_GATHER_LANES], float cosines[AUR_GATHER_LANES],
                                     float radiance[3][AUR_GATHER_LANES]) {
    aur_gather_rays *const rays = &sweep->sums->rays;
    memcpy(rays->density, densities, sizeof rays->density);
    return trace(sweep, aur_gather_aim_world(lanes, &sweep->frames, directions, &rays->packet, cosines),
                 index, radiance);
}

uint32_t aur_gather_trace_ggx(aur_gather_sweep *sweep, uint32_t lanes, size_t index, float draws,
                              const float square[2][AUR_GATHER_LANES], float values[3][AUR_GATHER_LANES],
                              float cosines[AUR_GATHER_LANES], float radiance[3][AUR_GATHER_LANES]) {
    aur_gather_rays *const rays = &sweep->sums->rays;
    uint32_t aimed = 0;
    aur_packet_empty(&rays->packet);
    aur_gather_set_probability(sweep->surface_points, sweep, index, rays);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const float u[3] = {aur_unit_float((uint32_t)aur_mix64(aur_gather_rays_hash(rays, lane))),
                            square[0][lane], square[1][lane]};
        aur_vector value;
        if (!aur_gather_aim_draw(&sweep->surface_points->at[lane], lane, u, draws, rays, &value,
                                 &cosines[lane]))
            continue;
        aimed |= 1u << lane;
        values[0][lane] = value.x;
        values[1][lane] = value.y;
        values[2][lane] = value.z;
    }
    return trace(sweep, aimed, index, radiance);
}

void aur_gather_reflect(aur_gather_sweep *sweep, size_t lane, const float radiance[3]) {
    aur_gather_add(sweep->sums, sweep->surface_points, lane,
                   (aur_vector){radiance[0], radiance[1], radiance[2]});
}

void aur_gather_count_unsolved(aur_gather_sweep *sweep) {
    ++sweep->sums->counters->unsolved;
}

uint32_t aur_gather_pairs(const aur_gather_points *surface_points, aur_gather_sums *sums) {
    const aur_gather_rules *const rules = &surface_points->plan->rules;
    aur_gather_sweep sweep = {
        .surface_points = surface_points, .sums = sums, .lanes = surface_points->lanes, .pairs = true};
    for (uint32_t rest = sweep.lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_gather_point *const surface_point = &surface_points->at[lane];
        aur_gather_set_frame(surface_point, lane, &surface_point->surface.frame, &sweep.frames, &sums->rays);
    }
    return sweep.lanes &
           ~rules->method->gather_pairs(rules->lobes[0].state, sweep.lanes, &sweep, sums->numbers);
}

void aur_gather_by_ggx(const aur_gather_points *surface_points, size_t lobe, uint32_t lanes,
                       aur_gather_sums *sums) {
    aur_gather_sweep sweep = {.surface_points = surface_points, .sums = sums, .lobe = lobe, .lanes = lanes};
    surface_points->plan->rules.method->gather_ggx(lanes, &sweep);
}
