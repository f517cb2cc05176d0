#include "lighting/viewfactors/covers.h"

#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/parallel.h"

/* Steeper facets cross this height in a strip no wider than a few times the height. */
static const double NEARLY_PARALLEL = 0.99;

enum { BLOCK = 1024 };

typedef struct cover_list {
    size_t count, capacity;
    uint32_t *covers;
} cover_list;

typedef struct search {
    const aur_facets *facets;
    const aur_box_tree *tree;
    cover_list *lists; /* per block, facet by facet */
    size_t *counts;    /* per facet */
} search;

static aur_vector vector_of(const double v[3]) {
    return (aur_vector){(float)v[0], (float)v[1], (float)v[2]};
}

float aur_facet_offset(const aur_facets *facets, size_t facet) {
    const double(*const c)[3] = (const double(*)[3])facets->corners[facet];
    return aur_triangle_offset(vector_of(c[0]), vector_of(c[1]), vector_of(c[2]),
                               vector_of(facets->planes[facet].normal));
}

/* Up to this height above the facet's plane, rays from anywhere cannot resolve which surface they hit. */
static double height_of(const aur_facets *facets, size_t facet) {
    return 2.0 *
           (double)aur_surface_offset(vector_of(facets->reach), vector_of(facets->planes[facet].normal));
}

/* Whether a part of `other` wider than the height lies within the height of the facet. */
static bool is_cover(const aur_facets *facets, size_t facet, size_t other, double height) {
    const aur_plane *const plane = &facets->planes[facet];
    if (facet == other || facets->areas[other] == 0.0 || aur_facets_are_sheet(facets, facet, other) ||
        fabs(aur_dot3(plane->normal, facets->planes[other].normal)) < NEARLY_PARALLEL)
        return false;
    double low = INFINITY, high = -INFINITY, parts[2][8][3];
    for (size_t c = 0; c < 3; ++c) {
        const double at = aur_plane_height(plane, facets->corners[other][c]);
        low = fmin(low, at);
        high = fmax(high, at);
    }
    if (low > height || high < -height)
        return false;
    aur_plane sides[5] = {*plane, *plane};
    sides[0].offset -= height;
    for (int d = 0; d < 3; ++d)
        sides[1].normal[d] = -plane->normal[d];
    sides[1].offset = -plane->offset - height;
    for (size_t e = 0; e < 3; ++e) {
        const double *const a = facets->corners[facet][e], *const b = facets->corners[facet][(e + 1) % 3];
        const double along[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        aur_cross3(plane->normal, along, sides[2 + e].normal);
        aur_normalize3(sides[2 + e].normal);
        sides[2 + e].offset = aur_dot3(sides[2 + e].normal, a);
    }
    const double(*from)[3] = (const double(*)[3])facets->corners[other];
    size_t count = 3;
    for (size_t s = 0; s < 5 && count > 0; ++s) {
        count = aur_polygon_clip(count, from, &sides[s], parts[s % 2]);
        from = (const double(*)[3])parts[s % 2];
    }
    return count > 2 && aur_polygon_width(count, from) > height;
}

static bool search_facet(const search *s, size_t facet, cover_list *list) {
    const aur_facets *const facets = s->facets;
    const double height = height_of(facets, facet);
    const aur_box box = aur_box_of(3, (const double(*)[3])facets->corners[facet]);
    for (size_t i = 0; i < s->tree->node_count;) {
        const aur_box_node *const node = &s->tree->nodes[i];
        bool meets = true;
        for (int d = 0; d < 3; ++d)
            meets &= node->lower[d] <= box.upper[d] + height && node->upper[d] >= box.lower[d] - height;
        for (size_t k = node->first; meets && node->count <= AUR_BOX_LEAF && k < node->first + node->count;
             ++k) {
            if (!is_cover(facets, facet, s->tree->items[k], height))
                continue;
            if (!aur_array_reserve(&list->covers, &list->capacity, list->count + 1, sizeof *list->covers))
                return false;
            list->covers[list->count++] = s->tree->items[k];
            ++s->counts[facet];
        }
        i = meets ? i + 1 : node->skip;
    }
    return true;
}

static aur_result search_block(void *context, size_t index) {
    const search *const s = context;
    for (size_t i = BLOCK * index; i < s->facets->count && i < BLOCK * (index + 1); ++i)
        if (s->facets->areas[i] > 0.0 && !search_facet(s, i, &s->lists[index]))
            return AUR_ERROR_MEMORY;
    return AUR_OK;
}

/* Concatenates the lists of the blocks. */
static bool join(const search *s, size_t blocks, aur_facets *facets) {
    size_t total = 0;
    for (size_t b = 0; b < blocks; ++b)
        total += s->lists[b].count;
    if (total == 0)
        return true;
    facets->cover_starts = calloc(facets->count + 1, sizeof *facets->cover_starts);
    facets->covers = malloc(total * sizeof *facets->covers);
    if (facets->cover_starts == NULL || facets->covers == NULL)
        return false;
    for (size_t i = 0; i < facets->count; ++i)
        facets->cover_starts[i + 1] = facets->cover_starts[i] + s->counts[i];
    for (size_t b = 0; b < blocks; ++b)
        for (size_t k = 0; k < s->lists[b].count; ++k)
            facets->covers[facets->cover_starts[BLOCK * b] + k] = s->lists[b].covers[k];
    return true;
}

aur_result aur_facets_find_covers(aur_facets *facets, aur_error *error) {
    const size_t blocks = (facets->count + BLOCK - 1) / BLOCK;
    aur_box_tree tree = {0};
    aur_box *const boxes = malloc((facets->count + 1) * sizeof *boxes);
    const search s = {facets, &tree, calloc(blocks + 1, sizeof *s.lists),
                      calloc(facets->count + 1, sizeof *s.counts)};
    aur_result result =
        boxes != NULL && s.lists != NULL && s.counts != NULL ? AUR_OK : aur_fail_memory(error);
    for (size_t i = 0; result == AUR_OK && i < facets->count; ++i)
        boxes[i] = aur_box_of(3, (const double(*)[3])facets->corners[i]);
    if (result == AUR_OK)
        result = aur_box_tree_create(facets->count, boxes, &tree, error);
    const aur_parallel_options parallel = {.what = "looking for covers"};
    if (result == AUR_OK)
        result = aur_parallel_for(&parallel, blocks, search_block, (void *)&s, error);
    if (result == AUR_OK && !join(&s, blocks, facets))
        result = aur_fail_memory(error);
    for (size_t b = 0; s.lists != NULL && b < blocks; ++b)
        free(s.lists[b].covers);
    free(s.lists);
    free(s.counts);
    free(boxes);
    aur_box_tree_release(&tree);
    return result;
}

/* The nearest cover of the facet that the ray hits between two distances, else `met`. */
static size_t first_between(const aur_facets *facets, size_t facet, const double origin[3],
                            const double direction[3], double nearest, double farthest, size_t met) {
    for (size_t k = facets->cover_starts[facet]; k < facets->cover_starts[facet + 1]; ++k) {
        const size_t cover = facets->covers[k];
        const aur_plane *const plane = &facets->planes[cover];
        const double distance = -aur_plane_height(plane, origin) / aur_dot3(plane->normal, direction);
        const double point[3] = {origin[0] + distance * direction[0], origin[1] + distance * direction[1],
                                 origin[2] + distance * direction[2]};
        if (distance > nearest && distance < farthest && aur_facet_contains(facets, cover, point)) {
            farthest = distance;
            met = cover;
        }
    }
    return met;
}

size_t aur_facets_first_met(const aur_facets *facets, size_t facet, const double origin[3],
                            const double direction[3], size_t met) {
    if (facets->cover_starts == NULL)
        return met;
    /* Below this distance only the facet's covers matter, beyond it those of the hit facet. */
    const double cosine = fabs(aur_dot3(facets->planes[facet].normal, direction));
    const double begin = height_of(facets, facet) / cosine;
    const size_t first = first_between(facets, facet, origin, direction, 0.0, begin, SIZE_MAX);
    if (first != SIZE_MAX || met == SIZE_MAX)
        return first != SIZE_MAX ? first : met;
    const aur_plane *const plane = &facets->planes[met];
    const double end = -aur_plane_height(plane, origin) / aur_dot3(plane->normal, direction);
    return first_between(facets, met, origin, direction, begin, end, met);
}
