/* realpath */
#define _XOPEN_SOURCE 700

#include "lighting/viewfactors/covers.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "points/base/error.h"
#include "points/base/text.h"
#include "render/scene/scene_data.h"

/* The text escaped as an XML attribute value; `$`, which scenes substitute, is escaped too. A buffer of 6
 * bytes per character suffices. */
static void escape(const char *text, char *escaped) {
    static const char special[] = "&<>\"$";
    static const char *const instead[] = {"&amp;", "&lt;", "&gt;", "&quot;", "\\$"};
    for (; *text != '\0'; ++text) {
        const char *const found = strchr(special, *text);
        if (found == NULL)
            *escaped++ = *text;
        else
            escaped = stpcpy(escaped, instead[found - special]);
    }
    *escaped = '\0';
}

/* Loads a mesh as the only shape of a scene, so that it is read, checked and traced like meshes of scenes. */
static aur_result load_mesh(const char *path, aur_overlap_rule rule, const aur_scene_options *options,
                            aur_scene **scene, aur_error *error) {
    static const char *const shapes[AUR_MESH_FORMAT_COUNT] = {"obj", "ply", "stl", "off"};
    char *const absolute = realpath(path, NULL);
    if (absolute == NULL)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_OPEN, "cannot be opened");
    char *const escaped = malloc(6 * strlen(absolute) + 1);
    const size_t capacity = 6 * strlen(absolute) + 400;
    char *const text = malloc(capacity);
    aur_result result = AUR_OK;
    if (escaped == NULL || text == NULL)
        result = aur_fail_memory(error);
    if (result == AUR_OK) {
        escape(absolute, escaped);
        const int length = snprintf(text, capacity,
                                    "<scene version=\"3.0.0\"><shape type=\"%s\">"
                                    "<boolean name=\"face_normals\" value=\"true\"/>"
                                    "<string name=\"filename\" value=\"%s\"/></shape></scene>",
                                    shapes[aur_mesh_format_of_name(path)], escaped);
        result = aur_scene_load_with_points(path, (size_t)length, text, rule, options, scene, error);
    }
    if (result != AUR_OK && error != NULL && strcmp(error->file, absolute) == 0)
        aur_format(error->file, sizeof error->file, "%s", path); /* the caller's path */
    free(absolute);
    free(escaped);
    free(text);
    return result;
}

/* Of the file. */
static size_t triangles_of(const aur_mesh *mesh) {
    return mesh->sources != NULL ? mesh->source_count : mesh->triangle_count;
}

static bool is_vs3(const char *path) {
    const char *const dot = strrchr(path, '.');
    return dot != NULL && strcasecmp(dot, ".vs3") == 0;
}

/* Surfaces that View3D combines, or single ones, form groups. */
static aur_result take_vs3_groups(aur_facets *facets, aur_vs3 *from, aur_error *error) {
    const size_t shapes = facets->scene->shape_count;
    if (shapes != from->shape_count)
        return aur_fail_at(error, (aur_location){.file = facets->path}, AUR_ERROR_FORMAT,
                           "%zu surfaces expected (found %zu)", from->shape_count, shapes);
    for (size_t i = 0, facet = 0, source = 0; i < shapes; ++i) {
        const aur_mesh *const mesh = &facets->scene->shapes[i]->mesh;
        for (size_t k = 0; k < mesh->triangle_count; ++k)
            facets->groups[facet++] = from->groups[i];
        for (size_t k = triangles_of(mesh); k > 0; --k)
            facets->source_groups[source++] = from->groups[i];
    }
    for (size_t i = from->group_count; i < from->name_count; ++i)
        free(from->names[i]);
    facets->group_count = from->group_count;
    facets->names = from->names;
    facets->emittances = from->emittances;
    from->names = NULL;
    from->emittances = NULL;
    from->name_count = 0;
    return AUR_OK;
}

static aur_result check_shapes(const aur_scene *scene, aur_error *error) {
    for (size_t i = 0; i < scene->shape_count; ++i) {
        const aur_shape *const shape = scene->shapes[i];
        if (shape->curved != NULL)
            return aur_fail_at(error, shape->location, AUR_ERROR_UNSUPPORTED,
                               "shape '%s' is not a mesh of triangles: view factors are between plane facets",
                               shape->descriptor->row.name);
        if (shape->grouped)
            return aur_fail_at(error, shape->location, AUR_ERROR_UNSUPPORTED,
                               "shape '%s' is in a shape group: its instances have no facets",
                               shape->descriptor->row.name);
    }
    return AUR_OK;
}

/* The facets in the order of the scene's shapes. */
static aur_result copy_triangles(aur_facets *facets, aur_error *error) {
    const aur_scene *const scene = facets->scene;
    for (size_t i = 0; i < scene->shape_count; ++i) {
        facets->count += scene->shapes[i]->mesh.triangle_count;
        facets->source_count += triangles_of(&scene->shapes[i]->mesh);
    }
    if (facets->count == 0)
        return aur_fail_at(error, (aur_location){.file = facets->path}, AUR_ERROR_FORMAT,
                           "no facet in this file");
    if (facets->count > UINT32_MAX / 4)
        return aur_fail_at(error, (aur_location){.file = facets->path}, AUR_ERROR_UNSUPPORTED,
                           "%zu facets are too many: 2^30 is the most", facets->count);
    facets->corners = malloc(facets->count * sizeof *facets->corners);
    facets->planes = malloc(facets->count * sizeof *facets->planes);
    facets->areas = malloc(facets->count * sizeof *facets->areas);
    facets->sources = malloc(facets->count * sizeof *facets->sources);
    facets->source_groups = calloc(facets->source_count, sizeof *facets->source_groups);
    facets->first = malloc((scene->shape_count + 1) * sizeof *facets->first);
    facets->groups = calloc(facets->count, sizeof *facets->groups);
    if (facets->corners == NULL || facets->planes == NULL || facets->areas == NULL ||
        facets->sources == NULL || facets->source_groups == NULL || facets->first == NULL ||
        facets->groups == NULL)
        return aur_fail_memory(error);
    size_t facet = 0, triangles = 0;
    for (size_t i = 0; i < scene->shape_count; ++i) {
        const aur_mesh *const mesh = &scene->shapes[i]->mesh;
        facets->first[i] = (uint32_t)facet;
        for (size_t k = 0; k < mesh->triangle_count; ++k, ++facet) {
            for (size_t c = 0; c < 3; ++c)
                for (size_t d = 0; d < 3; ++d) {
                    const double at = mesh->points[3 * (size_t)mesh->indices[3 * k + c] + d];
                    facets->corners[facet][c][d] = at - scene->origin[d];
                    facets->reach[d] = fmax(facets->reach[d], fabs(facets->corners[facet][c][d]));
                }
            facets->areas[facet] =
                aur_polygon_plane(3, (const double(*)[3])facets->corners[facet], &facets->planes[facet]);
            facets->groups[facet] = (uint32_t)i;
            facets->sources[facet] = (uint32_t)(triangles + (mesh->sources != NULL ? mesh->sources[k] : k));
        }
        triangles += triangles_of(mesh);
    }
    return AUR_OK;
}

/* The normal of a facet thinner than the rounding of its coordinates is meaningless. */
static void leave_out_slivers(aur_facets *facets) {
    for (size_t i = 0; i < facets->count; ++i) {
        double longest = 0.0;
        for (size_t c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d)
                longest = fmax(longest, fabs(facets->corners[i][c][d] - facets->corners[i][(c + 1) % 3][d]));
        if (!(facets->areas[i] > 1e-10 * longest * longest)) {
            facets->areas[i] = 0.0;
            facets->planes[i] = (aur_plane){{0.0, 0.0, 0.0}, 0.0};
        }
    }
}

/* The ids of a scene's shapes. */
static aur_result name_shapes(aur_facets *facets, aur_error *error) {
    const aur_scene *const scene = facets->scene;
    facets->names = calloc(scene->shape_count, sizeof *facets->names);
    if (facets->names == NULL)
        return aur_fail_memory(error);
    facets->group_count = scene->shape_count;
    for (size_t i = 0, triangle = 0; i < scene->shape_count; ++i) {
        for (size_t k = triangles_of(&scene->shapes[i]->mesh); k > 0; --k)
            facets->source_groups[triangle++] = (uint32_t)i;
        char unnamed[40];
        aur_format(unnamed, sizeof unnamed, "shape-%zu", i);
        const char *name = unnamed;
        for (size_t k = 0; k < scene->document.tree.id_count; ++k)
            if (scene->document.tree.ids[k].node->object == scene->shapes[i])
                name = scene->document.tree.ids[k].id;
        facets->names[i] = strdup(name);
        if (facets->names[i] == NULL)
            return aur_fail_memory(error);
    }
    return AUR_OK;
}

static aur_result make_rows(aur_facets *facets, const aur_facets_options *options, aur_error *error) {
    const size_t sides = options->both_sides ? 2 : 1;
    facets->grouped = options->group;
    facets->patch_count = sides * facets->count;
    facets->front_rows = options->group ? facets->group_count : facets->source_count;
    facets->row_count = sides * facets->front_rows;
    facets->row_areas = calloc(facets->row_count, sizeof *facets->row_areas);
    facets->rows = malloc(facets->count * sizeof *facets->rows);
    if (facets->row_areas == NULL || facets->rows == NULL)
        return aur_fail_memory(error);
    memcpy(facets->rows, options->group ? facets->groups : facets->sources,
           facets->count * sizeof *facets->rows);
    for (size_t i = 0; i < facets->patch_count; ++i)
        facets->row_areas[aur_facets_row(facets, i)] += facets->areas[aur_facet_of(facets, i)];
    return AUR_OK;
}

static aur_result load_scene(const char *path, aur_overlap_rule rule, const aur_facets_options *options,
                             bool mesh, const aur_vs3 *surfaces, aur_scene **loaded, aur_error *error) {
    aur_scene_options scene = {.size = sizeof scene};
    aur_scene_options_init(&scene, NULL);
    scene.model_light = AUR_MODEL_LIGHT_NONE; /* no studio either: its ground would be a facet */
    scene.warnings = options->warnings;
    scene.definition_count = options->definition_count;
    scene.confine = options->confine;
    scene.diffuse = options->diffuse;
    scene.definitions = options->definitions;
    scene.further_count = options->further_count;
    scene.further = options->further;
    return mesh ? load_mesh(path, rule, &scene, loaded, error)
                : aur_scene_load_with_points(path, surfaces->length, surfaces->text, rule, &scene, loaded,
                                             error);
}

static aur_result load(const char *path, const aur_facets_options *given, bool uncut, aur_facets **loaded,
                       aur_error *error) {
    *loaded = NULL;
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    aur_result result = aur_options_read(given, sizeof options, &options, "aur_facets_options", error);
    const aur_overlap_rule rule = uncut                ? AUR_OVERLAPS_STAY
                                  : options.both_sides ? AUR_OVERLAPS_CUT
                                                       : AUR_OVERLAPS_OF_FRONTS;
    const bool vs3 = is_vs3(path), mesh = aur_mesh_format_of_name(path) < AUR_MESH_FORMAT_COUNT;
    options.group = options.group || vs3;
    if (result == AUR_OK && (mesh || vs3) && options.further_count > 0)
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_UNSUPPORTED,
                             "a mesh is one file: only scenes go on in '%s'", options.further[0]);
    if (result != AUR_OK)
        return result;
    aur_facets *const facets = calloc(1, sizeof *facets);
    if (facets == NULL || (facets->path = strdup(path)) == NULL) {
        free(facets);
        return aur_fail_memory(error);
    }
    aur_vs3 surfaces = {0};
    result = vs3 ? aur_vs3_read(path, &surfaces, error) : AUR_OK;
    if (result == AUR_OK)
        result = load_scene(path, rule, &options, mesh, &surfaces, &facets->scene, error);
    if (result == AUR_OK)
        result = check_shapes(facets->scene, error);
    if (result == AUR_OK)
        result = copy_triangles(facets, error);
    if (result == AUR_OK)
        leave_out_slivers(facets);
    if (result == AUR_OK && mesh)
        result = aur_facets_read_sources(facets, error);
    if (result == AUR_OK && vs3)
        result = take_vs3_groups(facets, &surfaces, error);
    aur_vs3_release(&surfaces);
    if (result == AUR_OK && facets->names == NULL)
        result = name_shapes(facets, error);
    if (result == AUR_OK)
        result = make_rows(facets, &options, error);
    if (result == AUR_OK && rule == AUR_OVERLAPS_OF_FRONTS)
        result = aur_facets_find_sheets(facets, error);
    if (result == AUR_OK && rule != AUR_OVERLAPS_STAY)
        result = aur_facets_find_covers(facets, error);
    if (result == AUR_OK)
        result = aur_facets_inspect(facets, &options.warnings, error);
    if (result != AUR_OK) {
        aur_facets_destroy(facets);
        return result;
    }
    *loaded = facets;
    return AUR_OK;
}

aur_result aur_facets_load(const char *path, const aur_facets_options *options, aur_facets **facets,
                           aur_error *error) {
    return load(path, options, false, facets, error);
}

aur_result aur_facets_load_uncut(const char *path, const aur_facets_options *options, aur_facets **facets,
                                 aur_error *error) {
    return load(path, options, true, facets, error);
}

void aur_facets_destroy(aur_facets *facets) {
    if (facets == NULL)
        return;
    aur_scene_destroy(facets->scene);
    for (size_t i = 0; i < facets->group_count; ++i)
        free(facets->names[i]);
    free(facets->names);
    free(facets->path);
    free(facets->corners);
    free(facets->planes);
    free(facets->areas);
    free(facets->sources);
    free(facets->source_groups);
    free(facets->rows);
    free(facets->opposites);
    free(facets->opposite_starts);
    free(facets->cover_starts);
    free(facets->covers);
    free(facets->first);
    free(facets->lines);
    free(facets->groups);
    free(facets->row_areas);
    free(facets->emittances);
    free(facets);
}

size_t aur_facets_rows(const aur_facets *facets) {
    return facets->row_count;
}

const double *aur_facets_areas(const aur_facets *facets) {
    return facets->row_areas;
}

const char *aur_facets_name(const aur_facets *facets, size_t row) {
    return facets->grouped && row < facets->row_count ? facets->names[row % facets->group_count] : NULL;
}

const double *aur_facets_emittances(const aur_facets *facets) {
    return facets->emittances;
}

void aur_patch_corners(const aur_facets *facets, size_t patch, double corners[3][3]) {
    memcpy(corners, facets->corners[aur_facet_of(facets, patch)], 9 * sizeof(double));
    if (patch < facets->count)
        return;
    double swap[3];
    memcpy(swap, corners[1], sizeof swap);
    memcpy(corners[1], corners[2], sizeof swap);
    memcpy(corners[2], swap, sizeof swap);
}

aur_result aur_facets_options_init(aur_facets_options *options, aur_error *error) {
    static const aur_facets_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_facets_options", error);
}
