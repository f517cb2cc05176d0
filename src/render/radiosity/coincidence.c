/* Coincident triangles: a box that stands exactly on a floor, for example. Particles between them are on the
 * wrong side of one, so they leave the scene. Found by intersecting a tree of boxes with itself. */
#include "render/radiosity/scene.h"

#include <stdlib.h>

enum { LEAF = 4 };

typedef struct box {
    float low[3], high[3];
} box;

typedef struct item {
    box bounds; /* grown by what the triangle's plane may be off */
    float key;  /* to sort by */
    uint32_t triangle;
} item;

/* The children of node i are 2 i + 1 and 2 i + 2, with half of its items each. */
typedef struct node {
    box bounds;
    size_t first, count;
} node;

typedef struct search {
    const aur_radiosity_scene *scene;
    item *items;
    node *nodes;
    aur_radiosity_coincidence *found;
} search;

static void corners_of(const aur_radiosity_triangle *t, aur_vector corner[3]) {
    corner[0] = t->corner;
    corner[1] = aur_vector_add(t->corner, t->edge[0]);
    corner[2] = aur_vector_add(t->corner, t->edge[1]);
}

static bool boxes_overlap(search *s, const box *a, const box *b) {
    ++s->found->compared;
    for (size_t k = 0; k < 3; ++k)
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k])
            return false;
    return true;
}

/* --- two triangles */

static float slack_of(const aur_radiosity_triangle *t) {
    return 2.0f * t->offset;
}

/* Whether an edge of `a` separates it from all of `b`, up to rounding in that direction. */
static bool separates(const aur_radiosity_triangle *a, const aur_vector p[3], const aur_vector q[3]) {
    for (size_t i = 0; i < 3; ++i) {
        const aur_vector edge = aur_vector_subtract(p[(i + 1) % 3], p[i]);
        const aur_vector outwards = aur_vector_normalize(aur_vector_cross(edge, a->frame.z));
        const float slack = 8.0f * fmaxf(aur_triangle_offset(p[0], p[1], p[2], outwards),
                                         aur_triangle_offset(q[0], q[1], q[2], outwards));
        float nearest = INFINITY;
        for (size_t k = 0; k < 3; ++k)
            nearest = fminf(nearest, aur_vector_dot(outwards, aur_vector_subtract(q[k], p[i])));
        if (nearest > -slack)
            return true;
    }
    return false;
}

static bool coincide(const aur_radiosity_triangle *a, const aur_radiosity_triangle *b) {
    const float slack = fmaxf(slack_of(a), slack_of(b));
    if (fabsf(aur_vector_dot(a->frame.z, b->frame.z)) < 0.9999f)
        return false;
    aur_vector p[3], q[3];
    corners_of(a, p);
    corners_of(b, q);
    for (size_t k = 0; k < 3; ++k)
        if (fabsf(aur_vector_dot(a->frame.z, aur_vector_subtract(q[k], p[0]))) > slack)
            return false;
    return !separates(a, p, q) && !separates(b, q, p);
}

/* --- the tree */

static void make_items(search *s) {
    for (size_t i = 0; i < s->scene->triangle_count; ++i) {
        const aur_radiosity_triangle *const t = &s->scene->triangles[i];
        const float slack = slack_of(t);
        aur_vector p[3];
        corners_of(t, p);
        s->items[i] = (item){.bounds = {{fminf(p[0].x, fminf(p[1].x, p[2].x)) - slack,
                                         fminf(p[0].y, fminf(p[1].y, p[2].y)) - slack,
                                         fminf(p[0].z, fminf(p[1].z, p[2].z)) - slack},
                                        {fmaxf(p[0].x, fmaxf(p[1].x, p[2].x)) + slack,
                                         fmaxf(p[0].y, fmaxf(p[1].y, p[2].y)) + slack,
                                         fmaxf(p[0].z, fmaxf(p[1].z, p[2].z)) + slack}},
                             .triangle = (uint32_t)i};
    }
}

static int by_key(const void *a, const void *b) {
    const float x = ((const item *)a)->key, y = ((const item *)b)->key;
    return (x > y) - (x < y);
}

/* Sorts the node's items along the axis on which their middles are spread most. */
static void sort_items(item *items, size_t count) {
    float widest = -1.0f;
    size_t axis = 0;
    for (size_t k = 0; k < 3; ++k) {
        float low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; ++i) {
            low = fminf(low, items[i].bounds.low[k] + items[i].bounds.high[k]);
            high = fmaxf(high, items[i].bounds.low[k] + items[i].bounds.high[k]);
        }
        if (high - low > widest) {
            widest = high - low;
            axis = k;
        }
    }
    for (size_t i = 0; i < count; ++i)
        items[i].key = items[i].bounds.low[axis] + items[i].bounds.high[axis];
    qsort(items, count, sizeof *items, by_key);
}

static void make_node(search *s, size_t index, size_t first, size_t count) {
    node *const created = &s->nodes[index];
    *created = (node){.bounds = s->items[first].bounds, .first = first, .count = count};
    for (size_t i = first + 1; i < first + count; ++i)
        for (size_t k = 0; k < 3; ++k) {
            created->bounds.low[k] = fminf(created->bounds.low[k], s->items[i].bounds.low[k]);
            created->bounds.high[k] = fmaxf(created->bounds.high[k], s->items[i].bounds.high[k]);
        }
    if (count <= LEAF)
        return;
    sort_items(&s->items[first], count);
    make_node(s, 2 * index + 1, first, count - count / 2);
    make_node(s, 2 * index + 2, first + (count - count / 2), count / 2);
}

/* --- the search */

static void test_pair(search *s, const item *a, const item *b) {
    const bool ordered = a->triangle < b->triangle;
    const uint32_t low = ordered ? a->triangle : b->triangle, high = ordered ? b->triangle : a->triangle;
    if (!boxes_overlap(s, &a->bounds, &b->bounds) ||
        !coincide(&s->scene->triangles[low], &s->scene->triangles[high]))
        return;
    uint32_t *const first = s->found->triangles;
    if (s->found->pairs++ > 0 && (low > first[0] || (low == first[0] && high > first[1])))
        return;
    first[0] = low;
    first[1] = high;
}

static void test_leaves(search *s, const node *a, const node *b) {
    for (size_t i = a->first; i < a->first + a->count; ++i)
        for (size_t j = a == b ? i + 1 : b->first; j < b->first + b->count; ++j)
            test_pair(s, &s->items[i], &s->items[j]);
}

/* Visits all pairs of an item of node a and another of node b: splits the larger node, or both if they are
 * the same. */
static void join(search *s, size_t a, size_t b) {
    const node *const left = &s->nodes[a], *const right = &s->nodes[b];
    if (s->found->pairs >= AUR_RADIOSITY_MOST_COINCIDENCES ||
        !boxes_overlap(s, &left->bounds, &right->bounds))
        return;
    if (left->count <= LEAF && right->count <= LEAF) {
        test_leaves(s, left, right);
        return;
    }
    if (left->count < right->count) {
        join(s, a, 2 * b + 1);
        join(s, a, 2 * b + 2);
        return;
    }
    join(s, 2 * a + 1, a == b ? 2 * a + 1 : b);
    if (a == b)
        join(s, 2 * a + 1, 2 * a + 2);
    join(s, 2 * a + 2, a == b ? 2 * a + 2 : b);
}

aur_result aur_radiosity_find_coincidences(const aur_radiosity_scene *scene, aur_radiosity_coincidence *found,
                                           aur_error *error) {
    const size_t count = scene->triangle_count;
    search s = {.scene = scene,
                .items = malloc(count * sizeof *s.items),
                .nodes =
                    malloc((count + 1) * sizeof *s.nodes), /* halves of more than LEAF items take fewer */
                .found = found};
    *found = (aur_radiosity_coincidence){0};
    aur_result result = AUR_OK;
    if (s.items == NULL || s.nodes == NULL) {
        result = aur_fail(error, AUR_ERROR_MEMORY, "radiosity: out of memory for %zu triangles", count);
    } else {
        make_items(&s);
        make_node(&s, 0, 0, count);
        join(&s, 0, 0);
    }
    free(s.items);
    free(s.nodes);
    return result;
}
