/* Tree traversal for sixteen half planes. Loops over lanes have no branches and no floating-point
 * contraction, so that every instruction set gives bit-identical results. */
#include <math.h>
#include <string.h>

#include "lighting/viewfactors/slice_kernel.h"

enum { LANES = AUR_SLICE_LANES, STACK = 64, LAST = AUR_SLICE_CELLS };

/* Compilers lose `restrict` when they inline a function: a third of the speed. */
#define APART static __attribute__((noinline))

/* Above all slopes, but finite: times 0 it is 0. */
#define STEEPEST 1e30f

/* Tolerance of a bound for rounding, in cells: neighbours that share an edge leave no gap. */
#define ROUNDING 1e-3f

/* Hidden cells: a bit per cell, from the lowest one; the number of set bits before the first clear one (the
 * floor), and the slope below which these cells are. */
typedef struct hidden_cells {
    uint32_t bits[AUR_SLICE_WORDS][LANES];
    float cells[LANES], slope[LANES];
} hidden_cells;

/* Whether a part of the box may be in front of the plane. */
static inline bool is_before(const aur_slice_view *view, const aur_slice_node *node) {
    double height = -view->offset;
    for (int d = 0; d < 3; ++d)
        height += view->normal[d] * (double)(view->normal[d] > 0.0 ? node->upper[d] : node->lower[d]);
    return height > view->slack;
}

/* Whether the box reaches into the visible part of any half plane. */
APART bool is_open(const aur_slice_node *node, const aur_slices *restrict s,
                   const hidden_cells *restrict hidden) {
    const float x = 0.5f * (node->lower[0] + node->upper[0]), wide = 0.5f * (node->upper[0] - node->lower[0]);
    const float y = 0.5f * (node->lower[1] + node->upper[1]), deep = 0.5f * (node->upper[1] - node->lower[1]);
    const float top = node->upper[2];
    int open = 0;
    for (unsigned l = 0; l < LANES; ++l) {
        const float dx = x - s->origin[0][l], dy = y - s->origin[1][l];
        const float c = s->way[0][l], d = s->way[1][l];
        const float across = fabsf(c * dy - d * dx), along = c * dx + d * dy;
        const float half_across = fabsf(d) * wide + fabsf(c) * deep,
                    half_along = fabsf(c) * wide + fabsf(d) * deep;
        const float far = along + half_along, near = along - half_along;
        const float rise = top - s->origin[2][l];
        const float distance = rise > 0.0f ? (near > 0.0f ? near : 0.0f) : far;
        open |= (across <= half_across) & (far >= 0.0f) & (rise >= hidden->slope[l] * distance);
    }
    return open != 0;
}

/* Intersection of a polygon with the half planes: distance from the edge line, and height. */
typedef struct cut_points {
    float along[LANES], height[LANES];
} cut_points;

/* The edge from corner i to corner k: the polygon's segment begins there in some half planes, and ends there
 * in others. */
APART void cut_edge(const float *restrict along0, const float *restrict along1, const float *restrict across0,
                    const float *restrict across1, float top0, float top1, const float *restrict base,
                    cut_points *restrict enter, cut_points *restrict leave) {
    for (unsigned l = 0; l < LANES; ++l) {
        const float p = across0[l], q = across1[l];
        const int enters = (p >= 0.0f) & (q < 0.0f), leaves = (p < 0.0f) & (q >= 0.0f);
        /* An edge gives bit-identical results for the polygons on both sides. */
        const float u = 1.0f / (p - q);
        const float s = (p * along1[l] - q * along0[l]) * u;
        const float h = (p * (top1 - base[l]) - q * (top0 - base[l])) * u;
        enter->along[l] = enters ? s : enter->along[l];
        enter->height[l] = enters ? h : enter->height[l];
        leave->along[l] = leaves ? s : leave->along[l];
        leave->height[l] = leaves ? h : leave->height[l];
    }
}

/* Whether the polygon reaches above the plane of the patch. */
static inline bool rises_above(const aur_slice_view *view, const aur_slice_polygon *polygon) {
    double height = -INFINITY;
    for (size_t c = 0; c < polygon->count; ++c) {
        const float *const corner = polygon->corners[c];
        const double h = view->normal[0] * (double)corner[0] + view->normal[1] * (double)corner[1] +
                         view->normal[2] * (double)corner[2];
        height = h > height ? h : height;
    }
    return height - view->offset > view->slack;
}

/* Finds the corners' distances along and across the half planes, and which half planes the polygon intersects
 * (crossed[l] is 0 or 1). Returns whether any of these can be hidden further. */
APART bool find_crossings(const aur_slice_polygon *polygon, const aur_slices *restrict s,
                          const hidden_cells *restrict hidden, float along[restrict AUR_SLICE_CORNERS][LANES],
                          float across[restrict AUR_SLICE_CORNERS][LANES], int *restrict crossed) {
    int left[LANES] = {0}, right[LANES] = {0}, open[LANES] = {0}, ahead[LANES] = {0};
    for (size_t i = 0; i < polygon->count; ++i) {
        const float *const corner = polygon->corners[i];
        const float x = corner[0], y = corner[1], z = corner[2];
        for (unsigned l = 0; l < LANES; ++l) {
            const float c = s->way[0][l], d = s->way[1][l];
            const float dx = x - s->origin[0][l], dy = y - s->origin[1][l];
            const float forward = c * dx + d * dy, sideward = c * dy - d * dx;
            along[i][l] = forward;
            across[i][l] = sideward;
            left[l] |= sideward >= 0.0f;
            right[l] |= sideward < 0.0f;
            /* Above the floor; also behind the edge line, where slopes are undefined. */
            open[l] |= (forward <= 0.0f) | (z - s->origin[2][l] >= hidden->slope[l] * forward);
            ahead[l] |= forward > 0.0f;
        }
    }
    int any = 0;
    for (unsigned l = 0; l < LANES; ++l) {
        crossed[l] = left[l] & right[l];
        any |= crossed[l] & open[l] & ahead[l];
    }
    return any != 0;
}

/* The first cell that the segment from `enter` to `leave` hides, and the one after the last, as floats.
 * Clears `crossed` for half planes that it does not reach. */
APART void find_hidden_cells(const aur_slice_view *view, const aur_slices *restrict s,
                             const cut_points *restrict enter, const cut_points *restrict leave,
                             int *restrict crossed, float *restrict lower, float *restrict upper) {
    /* Loops without branches: compilers create one from a quotient that is selected later in the same loop.
     */
    float turn[LANES];
    for (unsigned l = 0; l < LANES; ++l) {
        const float s0 = enter->along[l], h0 = enter->height[l], s1 = leave->along[l], h1 = leave->height[l];
        lower[l] = h0 / sqrtf(s0 * s0 + h0 * h0);
        upper[l] = h1 / sqrtf(s1 * s1 + h1 * h1);
        /* If the segment continues behind the edge line of the half plane, it hides the cells up to that end.
         */
        turn[l] = copysignf(1.0f, (s1 - s0) * (s1 * h0 - s0 * h1));
        crossed[l] &= (s0 > 0.0f) | (s1 > 0.0f);
    }
    const float scale = 1.0f / view->width, lowest = view->lowest;
    AUR_INDEPENDENT_LOOP
    for (unsigned l = 0; l < LANES; ++l) {
        const float x0 = enter->along[l] > 0.0f ? lower[l] : turn[l],
                    x1 = leave->along[l] > 0.0f ? upper[l] : turn[l];
        const float from = ((x0 < x1 ? x0 : x1) - lowest) * scale - s->jitter[l] + (1.0f - ROUNDING);
        const float to = ((x0 < x1 ? x1 : x0) - lowest) * scale - s->jitter[l] + (1.0f + ROUNDING);
        const float begun = from < (float)LAST ? from : (float)LAST,
                    ended = to < (float)LAST ? to : (float)LAST;
        lower[l] = begun > 0.0f ? begun : 0.0f;
        upper[l] = ended > 0.0f ? ended : 0.0f;
    }
}

/* The polygon's part in each half plane is a segment; it hides the angles between its ends. Returns whether
 * any floor rises. */
APART bool hide(const aur_slice_view *view, const aur_slice_polygon *polygon, const aur_slices *restrict s,
                hidden_cells *restrict hidden) {
    float along[AUR_SLICE_CORNERS][LANES], across[AUR_SLICE_CORNERS][LANES], lower[LANES], upper[LANES];
    int crossed[LANES];
    if (!rises_above(view, polygon) || !find_crossings(polygon, s, hidden, along, across, crossed))
        return false;
    cut_points enter = {{0.0f}, {0.0f}}, leave = {{0.0f}, {0.0f}};
    for (size_t i = 0; i < polygon->count; ++i) {
        const size_t k = i + 1 < polygon->count ? i + 1 : 0;
        cut_edge(along[i], along[k], across[i], across[k], polygon->corners[i][2], polygon->corners[k][2],
                 s->origin[2], &enter, &leave);
    }
    find_hidden_cells(view, s, &enter, &leave, crossed, lower, upper);
    int32_t begin[LANES], end[LANES], rises = 0;
    for (unsigned l = 0; l < LANES; ++l) {
        begin[l] = (int32_t)lower[l];
        end[l] = (int32_t)upper[l] & -crossed[l];
        const int32_t floor = (int32_t)hidden->cells[l];
        rises |= (begin[l] <= floor) & (end[l] > floor);
    }
    for (int w = 0; w < AUR_SLICE_WORDS; ++w)
        for (unsigned l = 0; l < LANES; ++l) {
            const int32_t skipped = begin[l] - 32 * w, below = end[l] - 32 * w;
            const uint32_t without = (UINT32_C(1) << (skipped & 31)) - 1,
                           with = (UINT32_C(1) << (below & 31)) - 1;
            const uint32_t low = skipped >= 32 ? UINT32_MAX : skipped > 0 ? without : 0;
            const uint32_t high = below >= 32 ? UINT32_MAX : below > 0 ? with : 0;
            hidden->bits[w][l] |= high & ~low;
        }
    return rises != 0;
}

APART void find_floor(const aur_slice_view *view, const aur_slices *restrict s,
                      hidden_cells *restrict hidden) {
    float cells[LANES] = {0.0f};
    for (int w = AUR_SLICE_WORDS - 1; w >= 0; --w) {
        /* The lowest clear bit is a power of two; its logarithm is the exponent of a float. */
        uint32_t lowest[LANES], bits[LANES];
        float power[LANES];
        for (unsigned l = 0; l < LANES; ++l) {
            const uint32_t word = hidden->bits[w][l];
            lowest[l] = ~word & (word + 1);
            power[l] = (float)(int32_t)(lowest[l] >> 1);
        }
        memcpy(bits, power, sizeof bits);
        for (unsigned l = 0; l < LANES; ++l) {
            const int32_t exponent = (int32_t)(bits[l] >> 23) - 126;
            const float set = (float)(lowest[l] == 1 ? 0 : exponent);
            cells[l] = lowest[l] == 0 ? cells[l] + 32.0f : set;
        }
    }
    const float low = view->lowest, width = view->width;
    for (unsigned l = 0; l < LANES; ++l) {
        const float sine = low + (cells[l] + s->jitter[l]) * width, root = sqrtf(1.0f - sine * sine);
        const float slope = sine / root;
        hidden->cells[l] = cells[l];
        hidden->slope[l] = ((cells[l] == 0.0f) | (sine <= -1.0f)) != 0 ? -STEEPEST
                           : sine >= 1.0f                              ? STEEPEST
                                                                       : slope;
    }
}

/* Nearer nodes first, because they hide most of the rest. */
static inline bool is_nearer(const aur_slice_node *a, const aur_slice_node *b, const float way[2]) {
    float difference = 0.0f;
    for (int d = 0; d < 2; ++d)
        difference += way[d] * ((a->lower[d] + a->upper[d]) - (b->lower[d] + b->upper[d]));
    return difference < 0.0f;
}

/* The weight of each half plane; cells behind the patch's plane count as hidden. */
APART void begin_slices(const aur_slice_view *view, const aur_slices *restrict s,
                        hidden_cells *restrict hidden, float *restrict facing, float *restrict whole) {
    const float n0 = (float)view->normal[0], n1 = (float)view->normal[1], n2 = (float)view->normal[2];
    for (unsigned l = 0; l < LANES; ++l) {
        facing[l] = n0 * s->way[0][l] + n1 * s->way[1][l];
        whole[l] = 0.0f;
    }
    for (unsigned w = 0; w < AUR_SLICE_WORDS; ++w) {
        const aur_slice_word *const word = &view->words[w];
        const float lowest = n2 * (n2 > 0.0f ? word->lowest_rising : word->highest_rising);
        int wholly = 1;
        for (unsigned l = 0; l < LANES; ++l)
            wholly &=
                lowest + facing[l] * (facing[l] > 0.0f ? word->lowest_level : word->highest_level) > 0.0f;
        uint32_t bits[LANES] = {0};
        if (wholly != 0) {
            for (unsigned l = 0; l < LANES; ++l)
                whole[l] += n2 * word->rising + facing[l] * word->level;
        } else {
            for (unsigned k = 0; k < 32; ++k)
                for (unsigned l = 0; l < LANES; ++l) {
                    const float seen = n2 * view->rising[32 * w + k] + facing[l] * view->level[32 * w + k];
                    bits[l] |= (uint32_t)(seen <= 0.0f) << k;
                    whole[l] += seen > 0.0f ? seen : 0.0f;
                }
        }
        memcpy(hidden->bits[w], bits, sizeof bits);
    }
}

APART void sum_sky(const aur_slice_view *view, const hidden_cells *restrict hidden,
                   const float *restrict facing, float *restrict sky) {
    const float n2 = (float)view->normal[2];
    for (unsigned l = 0; l < LANES; ++l)
        sky[l] = 0.0f;
    for (unsigned w = 0; w < AUR_SLICE_WORDS; ++w) {
        /* Most words are completely hidden or completely visible in all half planes. */
        const aur_slice_word *const word = &view->words[w];
        uint32_t open[LANES], any = 0, all = UINT32_MAX;
        for (unsigned l = 0; l < LANES; ++l) {
            open[l] = ~hidden->bits[w][l];
            any |= open[l];
            all &= open[l];
        }
        if (any == 0)
            continue;
        if (all == UINT32_MAX) {
            for (unsigned l = 0; l < LANES; ++l)
                sky[l] += n2 * word->rising + facing[l] * word->level;
            continue;
        }
        for (unsigned k = 0; k < 32; ++k)
            for (unsigned l = 0; l < LANES; ++l) {
                const float seen = n2 * view->rising[32 * w + k] + facing[l] * view->level[32 * w + k];
                sky[l] += (float)(int32_t)(open[l] >> k & 1) * seen;
            }
    }
}

void AUR_KERNEL(aur_slice_kernel)(const aur_slice_tree *tree, const aur_slice_view *view,
                                  const aur_slices *slices, aur_slice_parts *parts) {
    hidden_cells hidden;
    float facing[LANES];
    begin_slices(view, slices, &hidden, facing, parts->whole);
    find_floor(view, slices, &hidden);
    float way[2] = {0.0f, 0.0f};
    for (unsigned l = 0; l < LANES; ++l)
        for (int d = 0; d < 2; ++d)
            way[d] += slices->way[d][l];
    uint32_t stack[STACK];
    size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const uint32_t index = stack[--depth];
        const aur_slice_node *const node = &tree->nodes[index];
        if (!is_before(view, node) || !is_open(node, slices, &hidden))
            continue;
        if (node->count > tree->leaf) {
            const uint32_t first = index + 1, second = tree->nodes[first].skip;
            const bool ordered = is_nearer(&tree->nodes[first], &tree->nodes[second], way);
            stack[depth++] = ordered ? second : first;
            stack[depth++] = ordered ? first : second;
            continue;
        }
        bool rises = false;
        for (size_t i = node->first; i < node->first + node->count; ++i)
            rises |= hide(view, &tree->polygons[i], slices, &hidden);
        if (rises)
            find_floor(view, slices, &hidden);
    }
    sum_sky(view, &hidden, facing, parts->sky);
}
