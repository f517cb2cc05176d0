/* The facets between which light goes: the triangles of a scene, in double precision, and what they belong
 * to. */
#pragma once

#include <aureole-lighting/view_factors.h>

#include "points/base/vector3d.h"
#include "render/scene/scene.h"

/* What sees and is seen is a patch: the front of each facet, patch 0 .. count - 1, and, when both sides are
 * asked for, its back, patch count .. 2 count - 1. */
struct aur_facets {
    aur_scene *scene;
    char *path;
    size_t count, patch_count;
    double (*corners)[3][3]; /* of facets, counter-clockwise seen from the front, from the scene's origin */
    aur_plane *planes;       /* of facets; zero without area */
    double *areas;           /* of facets; 0 for those that are left out */
    bool open;               /* some edge belongs to one facet only */
    uint32_t *first;         /* shape -> its first facet */
    size_t source_count;     /* triangles of the file */
    size_t *lines;           /* of these, in a mesh file of text; else NULL */
    uint32_t *source_groups; /* of these */
    uint32_t *sources;       /* of facets: the triangle of the file that each is, or is a part of */
    /* Where facets see with their fronts alone: of each facet, those of others that look the opposite way and
     * lie in its plane are opposites[opposite_starts[facet]] .. opposites[opposite_starts[facet + 1] - 1].
     * NULL: there are none. */
    size_t *opposite_starts;
    uint32_t *opposites;
    /* Of each facet, those that floats cannot order with it are covers[cover_starts[facet]] ..
     * covers[cover_starts[facet + 1] - 1] (covers.h). NULL: there are none. */
    size_t *cover_starts;
    uint32_t *covers;
    double reach[3]; /* the largest coordinates, either side of 0 */
    /* Rows of the matrix: triangles of the file, or groups of them; those of backs follow. */
    size_t front_rows;
    uint32_t *rows; /* of the fronts of facets */
    bool grouped;
    size_t group_count;
    uint32_t *groups; /* of facets */
    char **names;     /* of groups */
    size_t row_count;
    double *row_areas;
    double *emittances; /* of rows, where the file has them; else NULL */
};

/* View3D's input as one of Radiance's scenes: a polygon for each surface. */
typedef struct aur_vs3 {
    size_t length;
    char *text;
    size_t shape_count, group_count, name_count;
    uint32_t *groups;   /* of shapes */
    char **names;       /* of groups, and behind them further ones */
    double *emittances; /* of groups */
} aur_vs3;

/* Errors: OPEN, FORMAT, UNSUPPORTED, MEMORY, with the file's line. */
aur_result aur_vs3_read(const char *path, aur_vs3 *made, aur_error *error);
/* The same from memory; `path` is for messages. */
aur_result aur_vs3_parse(const char *path, size_t size, const char *data, aur_vs3 *made, aur_error *error);
void aur_vs3_release(aur_vs3 *self);

static inline size_t aur_facet_of(const aur_facets *facets, size_t patch) {
    return patch < facets->count ? patch : patch - facets->count;
}

static inline size_t aur_facets_row(const aur_facets *facets, size_t patch) {
    return facets->rows[aur_facet_of(facets, patch)] + (patch < facets->count ? 0 : facets->front_rows);
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

/* Finds what lies back to back, where facets see with their fronts alone. Errors: MEMORY. */
aur_result aur_facets_find_sheets(aur_facets *facets, aur_error *error);
/* Whether they lie back to back in one plane, where they see nothing of each other. */
bool aur_facets_are_sheet(const aur_facets *facets, size_t first, size_t second);
/* Whether the point lies in the facet, seen along its normal. */
bool aur_facet_contains(const aur_facets *facets, size_t facet, const double point[3]);
/* The facet that looks the opposite way at a point of a facet of a sheet; SIZE_MAX: none. Where
 * opposite_starts is not NULL. */
size_t aur_facets_other_side(const aur_facets *facets, size_t facet, const double point[3]);

/* As aur_facets_load, but surfaces in one plane stay as they are: for sensors, which are no surfaces. */
aur_result aur_facets_load_uncut(const char *path, const aur_facets_options *options, aur_facets **facets,
                                 aur_error *error);

/* The lines of a mesh file's triangles, and the groups of an OBJ's. The file has been loaded, so that nothing
 * in it is wrong. */
aur_result aur_facets_read_places(aur_facets *facets, aur_error *error);

/* Looks for what makes factors wrong or odd (facets without area, in one plane, open or inconsistent
 * surfaces) and sends one counted warning for each kind. Errors: MEMORY. */
aur_result aur_facets_inspect(aur_facets *facets, const aur_warnings *warnings, aur_error *error);
