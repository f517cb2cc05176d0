/* The facets between which light goes: the triangles of a scene, in double precision, and what they belong
 * to. */
#pragma once

#include <aureole/view_factors.h>

#include "lighting/polygon.h"
#include "scene/scene.h"

/* What sees and is seen is a patch: the front of each facet, patch 0 .. count - 1, and, when both sides are
 * asked for, its back, patch count .. 2 count - 1. */
struct aur_facets {
    aur_scene *scene;
    char *path;
    size_t count, patch_count;
    double (*corners)[3][3]; /* of facets, counter-clockwise seen from the front, from the scene's origin */
    aur_plane *planes;       /* of facets; zero without area */
    double *areas;           /* of facets; 0 for those that are left out */
    bool *doubled;           /* facets on which another one lies */
    bool open;               /* some edge belongs to one facet only */
    uint32_t *first;         /* shape -> its first facet */
    size_t *lines;           /* of the file, for facets of an OBJ; else NULL */
    double reach;            /* the largest coordinate, either side of 0 */
    /* Rows of the matrix: patches, or groups of facets (and their backs after them). */
    bool grouped;
    size_t group_count;
    uint32_t *groups; /* of facets; NULL when not grouped */
    char **names;     /* of groups */
    size_t row_count;
    double *row_areas;
};

static inline size_t aur_facet_of(const aur_facets *facets, size_t patch) {
    return patch < facets->count ? patch : patch - facets->count;
}

static inline size_t aur_facets_row(const aur_facets *facets, size_t patch) {
    if (!facets->grouped)
        return patch;
    return patch < facets->count ? facets->groups[patch]
                                 : facets->group_count + facets->groups[patch - facets->count];
}

/* The plane of a patch: its normal points to the side that sees. */
static inline aur_plane aur_patch_plane(const aur_facets *facets, size_t patch) {
    aur_plane plane = facets->planes[aur_facet_of(facets, patch)];
    if (patch >= facets->count) {
        for (int d = 0; d < 3; ++d)
            plane.normal[d] = -plane.normal[d];
        plane.offset = -plane.offset;
    }
    return plane;
}

/* The corners of a patch, counter-clockwise seen from its side. */
void aur_patch_corners(const aur_facets *facets, size_t patch, double corners[3][3]);

/* Reads the groups of an OBJ file that has been loaded, so that nothing in it is wrong: the group and the
 * line of each triangle. Groups are named by `g`, or `o` where there is no `g` after it. */
aur_result aur_obj_groups(const char *path, aur_facets *facets, aur_error *error);

/* Looks for what makes factors wrong or odd (facets without area, on each other, open or inconsistent
 * surfaces) and sends one counted warning for each kind. Marks facets that lie on each other. */
aur_result aur_facets_inspect(aur_facets *facets, const aur_warnings *warnings, aur_error *error);
