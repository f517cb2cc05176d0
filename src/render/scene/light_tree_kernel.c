/* The approximate contribution of a node's children. Branch-free, so that the loop vectorises. Operations are
 * not contracted or reordered: results are bit-identical for all instruction sets. */
#include "render/scene/light_tree.h"

#include "points/base/simd_lanes.h"

/* Bound on the rounding error of cosines: a child is skipped only if surely dark. */
#define COSINE_MARGIN 1e-5f
/* Minimum cosine of a child that may be lit. */
#define LEAST_COSINE 1e-3f

/* Branch-free: comparisons would not vectorise. */
static inline float at_least(float x, float least) {
    return x > least ? x : least;
}

static inline float sine_of(float cosine) {
    return sqrtf(at_least(1.0f - cosine * cosine, 0.0f));
}

/* Averages the value at the centre and the bound. The bound alone overestimates large children, and the
 * centre alone makes some lights nearly dark that are not. */
static inline float mean_cosine(float center, float most) {
    return aur_smaller(0.5f * (at_least(center, LEAST_COSINE) + at_least(most, LEAST_COSINE)), 1.0f);
}

/* Of child i to a reference. */
static inline float importance_of(const aur_light_children *all, size_t i, aur_vector from,
                                  aur_vector normal) {
    const float any_side = aur_vector_dot(normal, normal) > 0.0f ? 0.0f : 1.0f;
    const aur_vector way = {all->center[0][i] - from.x, all->center[1][i] - from.y,
                            all->center[2][i] - from.z};
    const aur_vector axis = {all->axis[0][i], all->axis[1][i], all->axis[2][i]};
    const float radius = all->radius[i], spread_cosine = all->spread_cosine[i];
    const float spread_sine = all->spread_sine[i];
    const float distance = at_least(aur_vector_dot(way, way), radius * radius);
    const float scale = 1.0f / sqrtf(distance);
    /* Half the angle subtended by the sphere; from inside, any direction is possible. */
    const float seen_sine = radius * scale, seen_cosine = sine_of(seen_sine);
    const float inside = seen_sine >= 1.0f ? 1.0f : 0.0f;

    const float up = aur_vector_dot(normal, way) * scale, up_sine = sine_of(up);
    const float out = -aur_vector_dot(axis, way) * scale, out_sine = sine_of(out);
    /* Cosines of angles to the normals: at the centre, and the largest possible; differences of angles are at
     * least 0. */
    const float facing = at_least(up, inside + any_side);
    const float less_seen = up * seen_cosine + up_sine * seen_sine;
    const float facing_most = at_least(up > seen_cosine ? 1.0f : less_seen, inside + any_side);
    const float less_spread = out * spread_cosine + out_sine * spread_sine;
    const float less_spread_sine = out_sine * spread_cosine - out * spread_sine;
    const float off = out > spread_cosine ? 1.0f : less_spread;
    const float off_sine = out > spread_cosine ? 0.0f : less_spread_sine;
    const float leaving = at_least(off, inside);
    const float off_less_seen = off * seen_cosine + off_sine * seen_sine;
    const float leaving_most = at_least(off > seen_cosine ? 1.0f : off_less_seen, inside);

    const float value =
        all->power[i] * mean_cosine(facing, facing_most) * mean_cosine(leaving, leaving_most) / distance;
    const float some = aur_smaller(at_least(value, 1e-37f), 1e37f);
    const float lit = facing_most > -COSINE_MARGIN ? some : 0.0f;
    return leaving_most > all->dark_cosine[i] ? lit : 0.0f;
}

static void children_importance(const aur_light_children *given, uint32_t first,
                                const aur_light_reference *reference, float *restrict importance) {
    const aur_light_children all = *given; /* the output must not alias these */
    const aur_vector from = reference->position, normal = reference->normal;
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_LIGHT_CHILDREN; ++k)
        importance[k] = importance_of(&all, first + k, from, normal);
}

/* --- choices of sixteen lanes, without branches: those on random numbers are mispredicted */

/* In [0,1), whatever the rounding. */
static inline aur_reals remainder_of(aur_reals above, aur_reals width) {
    const aur_reals rest = above / width, most = aur_lanes_all(0x1.fffffffffffffp-1);
    const aur_reals low = aur_lanes_choose((aur_words)(rest < 0.0), aur_lanes_all(0.0), rest);
    return aur_lanes_choose((aur_words)(low > most), most, low);
}

static void choose_children(const aur_light_children *given, uint32_t first, uint32_t count,
                            const aur_light_references *references, aur_light_draws *restrict draws) {
    const aur_light_children all = *given;
    const aur_lane_vectors from = *references->position, normal = *references->normal;
    _Alignas(64) double importance[AUR_LIGHT_CHILDREN][AUR_PACKET_SIZE];
    for (size_t c = 0; c < count; ++c) {
        AUR_INDEPENDENT_LOOP
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            importance[c][k] =
                (double)importance_of(&all, first + c, (aur_vector){from.x[k], from.y[k], from.z[k]},
                                      (aur_vector){normal.x[k], normal.y[k], normal.z[k]});
    }
    for (size_t k = 0; k < AUR_PACKET_SIZE; k += AUR_LANES) {
        aur_reals total = aur_lanes_all(0.0), sum = total, index = total, below = total, chosen = total;
        for (size_t c = 0; c < count; ++c)
            total += aur_lanes_load(&importance[c][k]);
        const aur_reals target = aur_lanes_load(&draws->rest[k]) * total;
        /* The last child that begins at or before the target. */
        for (size_t c = 0; c < count; ++c) {
            const aur_reals value = aur_lanes_load(&importance[c][k]);
            const aur_words begins = (aur_words)(value > 0.0) & (aur_words)(target >= sum);
            index = aur_lanes_choose(begins, aur_lanes_all((double)c), index);
            chosen = aur_lanes_choose(begins, value, chosen);
            below = aur_lanes_choose(begins, sum, below);
            sum += value;
        }
        /* Rounding may lead beyond the last one. */
        const aur_reals start = aur_lanes_choose((aur_words)(target < total), below, total - chosen);
        aur_lanes_put(&draws->rest[k], remainder_of(target - start, chosen), false);
        aur_lanes_put(&draws->index[k], index, false);
        aur_lanes_put(&draws->probability[k],
                      aur_lanes_choose((aur_words)(total > 0.0), chosen / total, total), false);
    }
}

static void choose_items(size_t count, const double *sums, aur_light_draws *draws) {
    for (size_t k = 0; k < AUR_PACKET_SIZE; k += AUR_LANES) {
        const aur_reals target = aur_lanes_load(&draws->rest[k]) * sums[count];
        aur_reals index = aur_lanes_all(0.0), low = aur_lanes_all(sums[0]), high = aur_lanes_all(sums[1]);
        for (size_t i = 1; i < count; ++i) {
            const aur_words begins = (aur_words)(sums[i] <= target);
            index = aur_lanes_choose(begins, aur_lanes_all((double)i), index);
            low = aur_lanes_choose(begins, aur_lanes_all(sums[i]), low);
            high = aur_lanes_choose(begins, aur_lanes_all(sums[i + 1]), high);
        }
        aur_lanes_put(&draws->rest[k], remainder_of(target - low, high - low), false);
        aur_lanes_put(&draws->index[k], index, false);
    }
}

static void find_digits(const float *restrict choice, const float *restrict u, const float *restrict v,
                        double *restrict digits) {
    uint32_t bits[2][AUR_PACKET_SIZE];
    memcpy(bits[0], u, sizeof bits[0]);
    memcpy(bits[1], v, sizeof bits[1]);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        digits[k] = aur_light_digits(choice[k], bits[0][k], bits[1][k]);
}

const aur_light_kernels AUR_KERNEL(aur_light_kernels) = {children_importance, choose_children, choose_items,
                                                         find_digits};
