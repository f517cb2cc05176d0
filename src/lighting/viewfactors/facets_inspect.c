/* Warnings about a mesh: one per kind, with the count and the first location. */
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/facets.h"
#include "points/base/random.h"
#include "render/scene/scene_data.h"

/* Sets the location of a warning to the first of some facets. */
typedef struct finding {
    size_t count, first;
} finding;

static void find(finding *f, size_t facet) {
    if (f->count++ == 0 || facet < f->first)
        f->first = facet;
}

static void report(const aur_facets *facets, const aur_warnings *warnings, const finding *f,
                   const char *what) {
    if (f->count == 0)
        return;
    const aur_location location = {facets->path,
                                   facets->lines != NULL ? facets->lines[facets->sources[f->first]] : 0, 0};
    aur_warn_at(warnings, location, "%zu %s (facet %zu is the first)", f->count, what,
                (size_t)facets->sources[f->first]);
}

/* An edge in the direction of its facet's boundary, or a facet's three corners, by vertex numbers. */
typedef struct use {
    uint32_t low, middle, high;
    uint32_t facet;
    bool turned; /* reversed relative to (low, high), or an odd permutation of the corners */
} use;

static int compare_uses(const void *left, const void *right) {
    const use *const a = left, *const b = right;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->middle != b->middle)
        return a->middle < b->middle ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    return (a->facet > b->facet) - (a->facet < b->facet);
}

static bool same_position(const use *a, const use *b) {
    return a->low == b->low && a->middle == b->middle && a->high == b->high;
}

/* Numbers the corner positions: equal coordinates have equal numbers. */
static bool number_corners(const aur_facets *facets, uint32_t *corner_ids) {
    size_t slots = 16;
    while (slots < 6 * facets->count)
        slots *= 2;
    uint32_t *const table = malloc(slots * sizeof *table);
    if (table == NULL)
        return false;
    memset(table, 0xff, slots * sizeof *table);
    const double(*const corners)[3] = (const double(*)[3])facets->corners;
    for (size_t i = 0; i < 3 * facets->count; ++i) {
        uint64_t bits[3];
        double clean[3];
        for (int d = 0; d < 3; ++d)
            clean[d] = corners[i][d] + 0.0; /* -0 becomes 0 */
        memcpy(bits, clean, sizeof bits);
        size_t slot = aur_hash3(bits[0], bits[1], bits[2]) & (slots - 1);
        while (table[slot] != UINT32_MAX &&
               !(corners[table[slot]][0] == clean[0] && corners[table[slot]][1] == clean[1] &&
                 corners[table[slot]][2] == clean[2]))
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == UINT32_MAX)
            table[slot] = (uint32_t)i;
        corner_ids[i] = table[slot];
    }
    free(table);
    return true;
}

static void exchange(uint32_t *a, uint32_t *b, bool *turned) {
    if (*a <= *b)
        return;
    const uint32_t swap = *a;
    *a = *b;
    *b = swap;
    *turned = !*turned;
}

static void find_sheets(const aur_facets *facets, const uint32_t *corner_ids, use *uses,
                        const aur_warnings *warnings) {
    size_t count = 0;
    for (size_t i = 0; i < facets->count; ++i) {
        if (facets->areas[i] == 0.0)
            continue;
        use u = {corner_ids[3 * i], corner_ids[3 * i + 1], corner_ids[3 * i + 2], (uint32_t)i, false};
        exchange(&u.low, &u.middle, &u.turned);
        exchange(&u.middle, &u.high, &u.turned);
        exchange(&u.low, &u.middle, &u.turned);
        uses[count++] = u;
    }
    qsort(uses, count, sizeof *uses, compare_uses);
    finding inverted = {0};
    for (size_t i = 0, end; i < count; i = end)
        for (end = i + 1; end < count && same_position(&uses[i], &uses[end]); ++end)
            if (uses[i].turned != uses[end].turned)
                find(&inverted, uses[end].facet);
    report(facets, warnings, &inverted, "facets lie back to back with others, a sheet without thickness");
}

/* Overlaps that were removed when the scene was loaded. */
static void report_overlaps(const aur_facets *facets, const aur_warnings *warnings) {
    const aur_scene_overlap *const found = &facets->scene->overlap;
    size_t pair[2];
    for (size_t k = 0; k < 2; ++k) {
        pair[k] = found->triangles[k];
        for (size_t i = 0; i < found->shapes[k]; ++i) {
            const aur_mesh *const mesh = &facets->scene->shapes[i]->mesh;
            pair[k] += mesh->sources != NULL ? mesh->source_count : mesh->triangle_count;
        }
    }
    const aur_location location = {facets->path, facets->lines != NULL ? facets->lines[pair[1]] : 0, 0};
    if (found->count > 0)
        aur_warn_at(
            warnings, location,
            "%zu facets lie in the plane of others that come first in the file, and are cut where those "
            "cover them (the first is facet %zu of '%s', behind facet %zu of '%s')",
            found->count, pair[1], facets->names[facets->source_groups[pair[1]]], pair[0],
            facets->names[facets->source_groups[pair[0]]]);
}

static void find_borders(aur_facets *facets, const uint32_t *corner_ids, use *uses,
                         const aur_warnings *warnings) {
    size_t count = 0;
    for (size_t i = 0; i < facets->count; ++i)
        for (size_t k = 0; k < 3 && facets->areas[i] > 0.0; ++k) {
            use u = {corner_ids[3 * i + k], 0, corner_ids[3 * i + (k + 1) % 3], (uint32_t)i, false};
            exchange(&u.low, &u.high, &u.turned);
            uses[count++] = u;
        }
    qsort(uses, count, sizeof *uses, compare_uses);
    finding open = {0}, disagreeing = {0};
    for (size_t i = 0, end; i < count; i = end) {
        size_t turned = 0;
        for (end = i; end < count && same_position(&uses[i], &uses[end]); ++end)
            turned += uses[end].turned;
        if (end - i == 1)
            find(&open, uses[i].facet);
        else if (end - i == 2 && turned != 1)
            find(&disagreeing, uses[i].facet);
    }
    facets->open = open.count > 0;
    report(facets, warnings, &open, "edges belong to one facet only: the surface is open there");
    report(facets, warnings, &disagreeing, "edges join facets that face inwards and outwards");
}

/* Whether the facet's height over its longest side is below the rounding error of rays there. */
static bool is_too_narrow(const aur_facets *facets, size_t facet) {
    const double(*const c)[3] = (const double(*)[3])facets->corners[facet];
    double longest = 0.0, across[3] = {0.0}, reach[3] = {0.0};
    for (size_t k = 0; k < 3; ++k) {
        const double side[3] = {c[(k + 1) % 3][0] - c[k][0], c[(k + 1) % 3][1] - c[k][1],
                                c[(k + 1) % 3][2] - c[k][2]};
        if (aur_length3(side) > longest) {
            longest = aur_length3(side);
            aur_cross3(facets->planes[facet].normal, side, across);
        }
        for (size_t d = 0; d < 3; ++d)
            reach[d] = fmax(reach[d], fabs(c[k][d]));
    }
    aur_normalize3(across);
    const aur_vector direction = {(float)across[0], (float)across[1], (float)across[2]};
    const aur_vector reaches = {(float)reach[0], (float)reach[1], (float)reach[2]};
    return 2.0 * facets->areas[facet] < longest * (double)aur_surface_rounding(reaches, direction);
}

aur_result aur_facets_inspect(aur_facets *facets, const aur_warnings *warnings, aur_error *error) {
    finding empty = {0}, narrow = {0};
    for (size_t i = 0; i < facets->count; ++i)
        if (facets->areas[i] == 0.0)
            find(&empty, i);
        else if (is_too_narrow(facets, i))
            find(&narrow, i);
    report(facets, warnings, &empty, "facets have no area and are left out");
    report(facets, warnings, &narrow,
           "facets are narrower than rays in floats resolve: their rows are not exact");
    report_overlaps(facets, warnings);
    uint32_t *const corner_ids = malloc(3 * facets->count * sizeof *corner_ids);
    use *const uses = malloc(3 * facets->count * sizeof *uses);
    const bool good = corner_ids != NULL && uses != NULL && number_corners(facets, corner_ids);
    if (good) {
        find_sheets(facets, corner_ids, uses, warnings);
        find_borders(facets, corner_ids, uses, warnings);
    }
    free(corner_ids);
    free(uses);
    return good ? AUR_OK : aur_fail_memory(error);
}
