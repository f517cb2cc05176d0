/* The approximate contribution of a node's children. Branch-free, so that the loop vectorises. Operations are
 * not contracted or reordered: results are bit-identical for all instruction sets. */
#include "render/scene/light_tree.h"

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

static void children_importance(const aur_light_children *given, uint32_t first,
                                const aur_light_reference *reference, float *restrict importance) {
    const aur_light_children all = *given; /* the output must not alias these */
    const aur_vector from = reference->position, normal = reference->normal;
    const float any_side = aur_vector_dot(normal, normal) > 0.0f ? 0.0f : 1.0f;
    AUR_INDEPENDENT_LOOP
    for (size_t k = 0; k < AUR_LIGHT_CHILDREN; ++k) {
        const size_t i = first + k;
        const aur_vector way = {all.center[0][i] - from.x, all.center[1][i] - from.y,
                                all.center[2][i] - from.z};
        const aur_vector axis = {all.axis[0][i], all.axis[1][i], all.axis[2][i]};
        const float radius = all.radius[i], spread_cosine = all.spread_cosine[i];
        const float spread_sine = all.spread_sine[i];
        const float distance = at_least(aur_vector_dot(way, way), radius * radius);
        const float scale = 1.0f / sqrtf(distance);
        /* Half the angle subtended by the sphere; from inside, any direction is possible. */
        const float seen_sine = radius * scale, seen_cosine = sine_of(seen_sine);
        const float inside = seen_sine >= 1.0f ? 1.0f : 0.0f;

        const float up = aur_vector_dot(normal, way) * scale, up_sine = sine_of(up);
        const float out = -aur_vector_dot(axis, way) * scale, out_sine = sine_of(out);
        /* Cosines of angles to the normals: at the centre, and the largest possible; differences of angles
         * are at least 0. */
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
            all.power[i] * mean_cosine(facing, facing_most) * mean_cosine(leaving, leaving_most) / distance;
        const float some = aur_smaller(at_least(value, 1e-37f), 1e37f);
        const float lit = facing_most > -COSINE_MARGIN ? some : 0.0f;
        importance[k] = leaving_most > all.dark_cosine[i] ? lit : 0.0f;
    }
}

const aur_light_kernels AUR_KERNEL(aur_light_kernels) = {children_importance};
