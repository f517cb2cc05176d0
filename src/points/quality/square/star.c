/* The star discrepancy on the square, exactly (Bundschuh and Zhu 1993 give the candidates).
 *
 * Points enter in order of x. With M points entered and y_1 <= ... <= y_M their heights, the candidates for a
 * box of width x are k/N - x y_k (closed) and x y_k - (k-1)/N, x - M/N (open). Their maxima over k are
 * tangents to the convex hulls of the points (y_k, k); the heights are stored in about sqrt N blocks with a
 * hull each. Entering a point rebuilds the hull of one block and shifts those of the blocks above: O(N^1.5)
 * in all. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/quality/measure.h"

typedef struct planar_point {
    double x, y, weight;
} planar_point;

/* The heights of one block: slots in order of y, some of which have entered. */
typedef struct block {
    size_t first, count; /* slots */
    double below;        /* the mass that has entered in lower blocks */
    size_t closed_first, closed_count, open_first, open_count;
} block;

/* A corner of a hull: height, and the mass up to it, including or excluding that of its point. */
typedef struct corner {
    double y, mass;
} corner;

typedef struct heights {
    size_t slot_count, block_size, block_count;
    double *y, *weight; /* one per slot; weight 0 before the point has entered */
    unsigned char *entered;
    block *blocks;
    corner *closed, *open; /* the hulls of block b begin at slot b * block_size */
} heights;

static double cross(corner a, corner b, corner c) {
    return (b.y - a.y) * (c.mass - a.mass) - (b.mass - a.mass) * (c.y - a.y);
}

/* Closed boxes use the upper hull (much mass below small heights), open boxes the lower hull. */
static void rebuild(heights *h, block *b) {
    corner *const closed = h->closed + b->first;
    corner *const open = h->open + b->first;
    size_t closed_count = 0, open_count = 0;
    double mass = 0.0;
    for (size_t s = b->first; s < b->first + b->count; ++s) {
        if (!h->entered[s])
            continue;
        const corner without = {h->y[s], mass};
        mass += h->weight[s];
        const corner with = {h->y[s], mass};
        while (closed_count >= 2 && cross(closed[closed_count - 2], closed[closed_count - 1], with) >= 0.0)
            --closed_count;
        closed[closed_count++] = with;
        while (open_count >= 2 && cross(open[open_count - 2], open[open_count - 1], without) <= 0.0)
            --open_count;
        open[open_count++] = without;
    }
    *b = (block){b->first,     b->count, b->below,  closed_count > 0 ? closed_count - 1 : 0,
                 closed_count, 0,        open_count};
}

static double closed_value(corner c, double x) {
    return c.mass - x * c.y;
}

static double open_value(corner c, double x) {
    return x * c.y - c.mass;
}

/* As x grows the best height of closed boxes falls and that of open boxes rises. */
static double best_closed(const heights *h, block *b, double x) {
    const corner *const hull = h->closed + b->first;
    while (b->closed_first > 0 &&
           closed_value(hull[b->closed_first - 1], x) >= closed_value(hull[b->closed_first], x))
        --b->closed_first;
    return b->below + closed_value(hull[b->closed_first], x);
}

static double best_open(const heights *h, block *b, double x) {
    const corner *const hull = h->open + b->first;
    while (b->open_first + 1 < b->open_count &&
           open_value(hull[b->open_first + 1], x) >= open_value(hull[b->open_first], x))
        ++b->open_first;
    return open_value(hull[b->open_first], x) - b->below;
}

static double greatest_closed(heights *h, double x) {
    double best = 0.0;
    for (size_t b = 0; b < h->block_count; ++b)
        if (h->blocks[b].closed_count > 0)
            best = fmax(best, best_closed(h, &h->blocks[b], x));
    return best;
}

static double greatest_open(heights *h, double x) {
    double best = 0.0;
    for (size_t b = 0; b < h->block_count; ++b)
        if (h->blocks[b].open_count > 0)
            best = fmax(best, best_open(h, &h->blocks[b], x));
    return best;
}

static void enter(heights *h, size_t slot, double weight) {
    h->entered[slot] = 1;
    h->weight[slot] = weight;
    const size_t b = slot / h->block_size;
    rebuild(h, &h->blocks[b]);
    for (size_t above = b + 1; above < h->block_count; ++above)
        h->blocks[above].below += weight;
}

static int by_x(const void *a, const void *b) {
    const planar_point *const p = a;
    const planar_point *const q = b;
    return (p->x > q->x) - (p->x < q->x);
}

typedef struct height_order {
    double y;
    size_t point;
} height_order;

static int by_y(const void *a, const void *b) {
    const height_order *const p = a;
    const height_order *const q = b;
    if (p->y != q->y)
        return p->y < q->y ? -1 : 1;
    return (p->point > q->point) - (p->point < q->point);
}

static bool heights_create(heights *h, size_t count, aur_arena *arena) {
    const size_t side = (size_t)ceil(sqrt((double)count));
    *h = (heights){.slot_count = count, .block_size = side, .block_count = (count + side - 1) / side};
    h->y = aur_arena_allocate(arena, count * sizeof *h->y);
    h->weight = aur_arena_allocate(arena, count * sizeof *h->weight);
    h->entered = aur_arena_allocate(arena, count * sizeof *h->entered);
    h->blocks = aur_arena_allocate(arena, h->block_count * sizeof *h->blocks);
    h->closed = aur_arena_allocate(arena, count * sizeof *h->closed);
    h->open = aur_arena_allocate(arena, count * sizeof *h->open);
    if (h->y == NULL || h->weight == NULL || h->entered == NULL || h->blocks == NULL || h->closed == NULL ||
        h->open == NULL)
        return false;
    for (size_t b = 0; b < h->block_count; ++b) {
        const size_t first = b * side;
        h->blocks[b].first = first;
        h->blocks[b].count = first + side <= count ? side : count - first;
    }
    return true;
}

/* Points sorted by x, and the slot of each. */
static void sort_points(const aur_points_view *source, planar_point *points, size_t *slots,
                        height_order *order, heights *h) {
    const size_t count = source->count;
    const bool line = source->dimension == 1;
    for (size_t i = 0; i < count; ++i) {
        const double *const x = aur_point_at(source, i);
        points[i] = (planar_point){x[0], line ? 0.0 : x[1], source->weights[i]};
    }
    qsort(points, count, sizeof *points, by_x);
    for (size_t i = 0; i < count; ++i)
        order[i] = (height_order){points[i].y, i};
    qsort(order, count, sizeof *order, by_y);
    for (size_t s = 0; s < count; ++s) {
        h->y[s] = order[s].y;
        slots[order[s].point] = s;
    }
}

static aur_result sweep(const aur_measure_request *request, const planar_point *points, const size_t *slots,
                        heights *h, double *value, aur_error *error) {
    const size_t count = request->points->count;
    const aur_progress *const progress = &request->options.progress;
    double best = 0.0, mass = 0.0;
    for (size_t i = 0; i < count;) {
        const double x = points[i].x;
        best = fmax(best, fmax(greatest_open(h, x), x - mass));
        for (; i < count && points[i].x == x; ++i) {
            enter(h, slots[i], points[i].weight);
            mass += points[i].weight;
        }
        best = fmax(best, greatest_closed(h, x));
        if (i % 1024 == 0 && aur_progress_stops(progress, "sweeping", i, count))
            return aur_fail(error, AUR_ERROR_CANCELLED, "star discrepancy: cancelled");
    }
    *value = fmax(best, greatest_open(h, 1.0));
    return AUR_OK;
}

/* Boxes are intervals (Niederreiter 1992, theorem 2.6). */
static double star_on_the_line(const planar_point *points, size_t count) {
    double best = 0.0, mass = 0.0;
    for (size_t i = 0; i < count; ++i) {
        best = fmax(best, points[i].x - mass);
        mass += points[i].weight;
        best = fmax(best, mass - points[i].x);
    }
    return best;
}

static aur_result star(const aur_measure_request *request, double *value, aur_error *error) {
    const aur_points_view *const source = request->points;
    if (source->dimension > 2)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "the exact star discrepancy is for one and two dimensions, not %zu: 'star-bound' bounds "
            "it from below",
            source->dimension);
    const size_t count = source->count;
    planar_point *const points = aur_arena_allocate(request->arena, count * sizeof *points);
    size_t *const slots = aur_arena_allocate(request->arena, count * sizeof *slots);
    height_order *const order = aur_arena_allocate(request->arena, count * sizeof *order);
    heights h;
    if (points == NULL || slots == NULL || order == NULL || !heights_create(&h, count, request->arena))
        return aur_fail_memory(error);
    sort_points(source, points, slots, order, &h);
    if (source->dimension > 1)
        return sweep(request, points, slots, &h, value, error);
    *value = star_on_the_line(points, count);
    return AUR_OK;
}

const aur_measure_row aur_measure_star = {
    {.row = {.name = "star",
             .summary =
                 "exact star discrepancy D*, the supremum over boxes at the origin (one and two dimensions)",
             .source = "Bundschuh and Zhu 1993"},
     .domains = "square, cube"},
    .masses = 1,
    .compute = star};
