/* Facets for radiative exchange: the triangles of a scene in double precision, with their shapes and rows. */
#pragma once

#include <aureole-lighting/view_factors.h>

#include "points/base/vector3d.h"
#include "render/scene/scene.h"

/* A patch is one side of a facet: the fronts are the patches 0 .. count - 1; if both sides are requested, the
 * backs are count .. 2 count - 1. */
struct aur_facets {
    aur_scene *scene;
    char *path;
    size_t count, patch_count;
    double (*corners)[3][3]; /* per facet, counter-clockwise seen from the front, relative to the scene's
                              * origin */
    aur_plane *planes;       /* per facet; zero if it has no area */
    double *areas;           /* per facet; 0 for omitted ones */
    bool open;               /* some edge belongs to only one facet */
    uint32_t *first;         /* first facet of each shape */
    size_t source_count;     /* triangles of the file */
    size_t *lines;           /* line of each, in a mesh file of text; else NULL */
    uint32_t *source_groups; /* group of each */
    uint32_t *sources;       /* per facet: the triangle of the file that contains it */
    /* If facets see with their fronts only: the coplanar facets that face the opposite way to a facet are
     * opposites[opposite_starts[facet]] .. opposites[opposite_starts[facet + 1] - 1]. NULL: none. */
    size_t *opposite_starts;
    uint32_t *opposites;
    /* The facets that float rays cannot separate from a facet are covers[cover_starts[facet]] ..
     * covers[cover_starts[facet + 1] - 1] (covers.h). NULL: none. */
    size_t *cover_starts;
    uint32_t *covers;
    double reach[3]; /* largest absolute coordinates */
    /* Rows of the matrix: triangles of the file, or groups of them; rows of backs follow. */
    size_t front_rows;
    uint32_t *rows; /* row of the front of each facet */
    bool grouped;
    size_t group_count;
    uint32_t *groups; /* group of each facet */
    char **names;     /* name of each group */
    size_t row_count;
    double *row_areas;
    double *emittances; /* per row, if the file has them; else NULL */
};

/* View3D's input as a Radiance scene: a polygon for each surface. */
typedef struct aur_vs3 {
    size_t length;
    char *text;
    size_t shape_count, group_count, name_count;
    uint32_t *groups;   /* per shape */
    char **names;       /* per group, then further names */
    double *emittances; /* per group */
} aur_vs3;

/* Errors: OPEN, FORMAT, UNSUPPORTED, MEMORY, with the line of the file. */
aur_result aur_vs3_read(const char *path, aur_vs3 *model, aur_error *error);
/* The same from memory; `path` is for messages. */
aur_result aur_vs3_parse(const char *path, size_t size, const char *data, aur_vs3 *model, aur_error *error);
void aur_vs3_release(aur_vs3 *self);

static inline size_t aur_facet_of(const aur_facets *facets, size_t patch) {
    return patch < facets->count ? patch : patch - facets->count;
}

static inline size_t aur_facets_row(const aur_facets *facets, size_t patch) {
    return facets->rows[aur_facet_of(facets, patch)] + (patch < facets->count ? 0 : facets->front_rows);
}

/* The plane of a patch; its normal points to the patch's side. */
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

/* Finds back-to-back facets, if facets see with their fronts only. Errors: MEMORY. */
aur_result aur_facets_find_sheets(aur_facets *facets, aur_error *error);
/* Whether two facets are back to back in one plane, and so do not see each other. */
bool aur_facets_are_sheet(const aur_facets *facets, size_t first, size_t second);
/* Whether the point lies in the facet, projected along its normal. */
bool aur_facet_contains(const aur_facets *facets, size_t facet, const double point[3]);
/* The facet that faces the opposite way at a point of a facet of a sheet; SIZE_MAX: none. Requires
 * opposite_starts != NULL. */
size_t aur_facets_other_side(const aur_facets *facets, size_t facet, const double point[3]);

/* As aur_facets_load, but coplanar surfaces are unchanged: for sensors, which are not surfaces. */
aur_result aur_facets_load_uncut(const char *path, const aur_facets_options *options, aur_facets **facets,
                                 aur_error *error);

/* The line numbers of a mesh file's triangles, and the groups of an OBJ's. The file has been loaded, so it is
 * valid. */
aur_result aur_facets_read_sources(aur_facets *facets, aur_error *error);

/* Looks for facets that make factors wrong or suspicious (without area, coplanar and overlapping, open or
 * inconsistent surfaces) and sends one warning per kind with the count. Errors: MEMORY. */
aur_result aur_facets_inspect(aur_facets *facets, const aur_warnings *warnings, aur_error *error);
