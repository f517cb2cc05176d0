#include "transport/kd_tree.h"

#include <stdlib.h>

#include "core/parallel.h"

enum { ITEM_MASK = (1 << AUR_KD_ITEM_BITS) - 1 };

static float coordinate(const aur_vector *v, unsigned axis) {
    return axis == 0 ? v->x : axis == 1 ? v->y : v->z;
}

/* Ties are broken by the item's number, so that the order is total and the tree unique. */
static bool before(const aur_kd_node *a, const aur_kd_node *b, unsigned axis) {
    const float x = coordinate(&a->position, axis), y = coordinate(&b->position, axis);
    return x < y || (x == y && (a->item & ITEM_MASK) < (b->item & ITEM_MASK));
}

static void swap(aur_kd_node *a, aur_kd_node *b) {
    const aur_kd_node t = *a;
    *a = *b;
    *b = t;
}

/* Hoare's quickselect: nodes[middle] becomes what it would be if nodes[low..high) were sorted along the axis.
 */
static void select_middle(aur_kd_node *nodes, size_t low, size_t high, size_t middle, unsigned axis) {
    while (high - low > 1) {
        const size_t centre = low + (high - low) / 2;
        aur_kd_node *const a = &nodes[low], *const b = &nodes[centre], *const c = &nodes[high - 1];
        const aur_kd_node *const median = before(a, b, axis) ? (before(b, c, axis)   ? b
                                                                : before(a, c, axis) ? c
                                                                                     : a)
                                                             : (before(a, c, axis)   ? a
                                                                : before(b, c, axis) ? c
                                                                                     : b);
        const aur_kd_node pivot = *median;
        size_t i = low, j = high - 1;
        for (;;) {
            while (before(&nodes[i], &pivot, axis))
                ++i;
            while (before(&pivot, &nodes[j], axis))
                --j;
            if (i >= j)
                break;
            swap(&nodes[i], &nodes[j]);
            ++i;
            --j;
        }
        /* Now [low, i) is before or at the pivot and [i, high) at or after it, with i <= j + 1. */
        if (i == low)
            i = low + 1;
        if (middle < i)
            high = i;
        else
            low = i;
    }
}

static unsigned widest_axis(const aur_kd_node *nodes, size_t low, size_t high) {
    aur_vector least = nodes[low].position, most = least;
    for (size_t i = low + 1; i < high; ++i) {
        const aur_vector p = nodes[i].position;
        least = (aur_vector){fminf(least.x, p.x), fminf(least.y, p.y), fminf(least.z, p.z)};
        most = (aur_vector){fmaxf(most.x, p.x), fmaxf(most.y, p.y), fmaxf(most.z, p.z)};
    }
    const aur_vector size = aur_vector_subtract(most, least);
    if (size.x >= size.y && size.x >= size.z)
        return 0;
    return size.y >= size.z ? 1 : 2;
}

/* Puts the node of [low, high) in its place and returns where that is. */
static size_t split(aur_kd_node *nodes, size_t low, size_t high) {
    const size_t middle = low + (high - low) / 2;
    const unsigned axis = widest_axis(nodes, low, high);
    select_middle(nodes, low, high, middle, axis);
    nodes[middle].item |= (uint32_t)axis << AUR_KD_ITEM_BITS;
    return middle;
}

static void build_range(aur_kd_node *nodes, size_t low, size_t high) {
    while (high - low > 1) {
        const size_t middle = split(nodes, low, high);
        build_range(nodes, low, middle);
        low = middle + 1;
    }
}

enum { PARALLEL_LEVELS = 6, PARALLEL_RANGES = 1 << PARALLEL_LEVELS };

typedef struct build_work {
    aur_kd_node *nodes;
    size_t bounds[PARALLEL_RANGES + 1][2];
} build_work;

static aur_result build_item(void *context, size_t index) {
    const build_work *const work = context;
    build_range(work->nodes, work->bounds[index][0], work->bounds[index][1]);
    return AUR_OK;
}

/* Splits [low, high) `levels` deep and lists the ranges that are left. */
static size_t split_top(build_work *work, size_t count, size_t low, size_t high, unsigned levels) {
    if (levels == 0 || high - low <= 1) {
        work->bounds[count][0] = low;
        work->bounds[count][1] = high;
        return count + 1;
    }
    const size_t middle = split(work->nodes, low, high);
    count = split_top(work, count, low, middle, levels - 1);
    return split_top(work, count, middle + 1, high, levels - 1);
}

aur_result aur_kd_tree_build(aur_kd_tree *tree, size_t count, const aur_vector *positions, size_t threads) {
    *tree = (aur_kd_tree){0};
    if (count > (size_t)ITEM_MASK + 1)
        return AUR_ERROR_ARGUMENT;
    aur_kd_node *const nodes = malloc((count > 0 ? count : 1) * sizeof *nodes);
    if (nodes == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t i = 0; i < count; ++i)
        nodes[i] = (aur_kd_node){positions[i], (uint32_t)i};
    build_work work = {.nodes = nodes};
    if (count > 0) {
        const size_t ranges = split_top(&work, 0, 0, count, PARALLEL_LEVELS);
        aur_parallel_for(&(aur_parallel_options){.threads = threads}, ranges, build_item, &work);
    }
    tree->count = count;
    tree->nodes = nodes;
    return AUR_OK;
}

void aur_kd_tree_release(aur_kd_tree *tree) {
    free(tree->nodes);
    *tree = (aur_kd_tree){0};
}

typedef struct search {
    const aur_kd_node *nodes;
    aur_vector position;
    float bound; /* squared distance that a point must beat */
    aur_kd_accept accept;
    const void *context;
    size_t k, found;
    aur_kd_neighbour *heap; /* the farthest on top once it is full */
} search;

static bool farther(aur_kd_neighbour a, aur_kd_neighbour b) {
    return a.distance_squared > b.distance_squared ||
           (a.distance_squared == b.distance_squared && a.item > b.item);
}

static void sift_down(aur_kd_neighbour *heap, size_t count, size_t at) {
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= count)
            return;
        if (child + 1 < count && farther(heap[child + 1], heap[child]))
            ++child;
        if (!farther(heap[child], heap[at]))
            return;
        const aur_kd_neighbour t = heap[at];
        heap[at] = heap[child];
        heap[child] = t;
        at = child;
    }
}

static void take(search *s, aur_kd_neighbour candidate) {
    if (s->found < s->k) {
        s->heap[s->found++] = candidate;
        if (s->found < s->k)
            return;
        for (size_t i = s->k / 2; i-- > 0;)
            sift_down(s->heap, s->k, i);
    } else {
        if (!farther(s->heap[0], candidate))
            return;
        s->heap[0] = candidate;
        sift_down(s->heap, s->k, 0);
    }
    s->bound = s->heap[0].distance_squared;
}

static void visit(search *s, size_t low, size_t high) {
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const aur_kd_node *const node = &s->nodes[middle];
        const aur_vector offset = aur_vector_subtract(s->position, node->position);
        const float distance_squared = aur_vector_dot(offset, offset);
        const uint32_t item = node->item & ITEM_MASK;
        if (distance_squared <= s->bound && (s->accept == NULL || s->accept(s->context, item)))
            take(s, (aur_kd_neighbour){distance_squared, item});
        const float side = coordinate(&offset, node->item >> AUR_KD_ITEM_BITS);
        if (side < 0.0f) {
            visit(s, low, middle);
            low = middle + 1;
        } else {
            visit(s, middle + 1, high);
            high = middle;
        }
        if (side * side > s->bound)
            return;
    }
}

size_t aur_kd_tree_nearest(const aur_kd_tree *tree, aur_vector position, float radius, aur_kd_accept accept,
                           const void *context, size_t k, aur_kd_neighbour *neighbours) {
    if (k == 0)
        return 0;
    search s = {.nodes = tree->nodes,
                .position = position,
                .bound = radius * radius,
                .accept = accept,
                .context = context,
                .k = k,
                .heap = neighbours};
    visit(&s, 0, tree->count);
    return s.found;
}
