/* Sensors on the faces or vertices of a mesh. */
#include <stdlib.h>
#include <string.h>

#include "lighting/irradiance/sensors.h"
#include "lighting/viewfactors/facets.h"
#include "render/scene/scene_data.h"

/* Facets without area have no sensor; a warning has been sent. */
static aur_result stand_on_faces(const aur_facets *facets, const char *path, aur_sensors *sensors,
                                 aur_error *error) {
    const double *const origin = facets->scene->origin;
    size_t count = 0;
    for (size_t i = 0; i < facets->count; ++i)
        count += facets->areas[i] > 0.0;
    if (count == 0)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                           "no facet has an area: no sensor is placed");
    const aur_result result = aur_sensors_allocate(path, count, sensors, error);
    if (result != AUR_OK)
        return result;
    sensors->corners = malloc(9 * count * sizeof *sensors->corners);
    sensors->lines = facets->lines != NULL ? malloc(count * sizeof *sensors->lines) : NULL;
    if (sensors->corners == NULL || (sensors->lines == NULL && facets->lines != NULL))
        return aur_fail_memory(error);
    for (size_t i = 0, k = 0; i < facets->count; ++i) {
        if (!(facets->areas[i] > 0.0))
            continue;
        for (size_t d = 0; d < 3; ++d) {
            const double sum = facets->corners[i][0][d] + facets->corners[i][1][d] + facets->corners[i][2][d];
            for (size_t c = 0; c < 3; ++c)
                sensors->corners[9 * k + 3 * c + d] = facets->corners[i][c][d] + origin[d];
            sensors->numbers[3 * k + d] = sum / 3.0 + origin[d];
            sensors->numbers[3 * (count + k) + d] = facets->planes[i].normal[d];
        }
        if (facets->lines != NULL)
            sensors->lines[k] = facets->lines[facets->sources[i]];
        ++k;
    }
    sensors->view.corners = sensors->corners;
    sensors->view.lines = sensors->lines;
    return AUR_OK;
}

/* Vertices without triangles are omitted; `numbers` receives those of the others. */
static size_t number_used(const aur_mesh *mesh, uint32_t *numbers) {
    size_t used = 0;
    memset(numbers, 0xff, mesh->vertex_count * sizeof *numbers);
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i)
        numbers[mesh->indices[i]] = 0;
    for (size_t i = 0; i < mesh->vertex_count; ++i)
        if (numbers[i] == 0)
            numbers[i] = (uint32_t)used++;
    return used;
}

static aur_result stand_on_vertices(const aur_mesh *mesh, const char *path, aur_sensors *sensors,
                                    aur_error *error) {
    aur_mesh smooth = *mesh; /* without its normals */
    smooth.normals = NULL;
    uint32_t *const numbers = malloc((mesh->vertex_count + 1) * sizeof *numbers);
    sensors->triangles = malloc((3 * mesh->triangle_count + 1) * sizeof *sensors->triangles);
    aur_result result = numbers != NULL && sensors->triangles != NULL ? AUR_OK : aur_fail_memory(error);
    if (result == AUR_OK)
        result = aur_mesh_smooth(&smooth, (aur_location){.file = path}, error);
    const size_t count = result == AUR_OK ? number_used(mesh, numbers) : 0;
    if (result == AUR_OK)
        result = aur_sensors_allocate(path, count, sensors, error);
    for (size_t i = 0; i < mesh->vertex_count && result == AUR_OK; ++i)
        for (size_t d = 0; d < 3 && numbers[i] != UINT32_MAX; ++d) {
            sensors->numbers[3 * (size_t)numbers[i] + d] = mesh->points[3 * i + d];
            sensors->numbers[3 * (count + numbers[i]) + d] = (double)smooth.normals[3 * i + d];
        }
    for (size_t i = 0; i < 3 * mesh->triangle_count && result == AUR_OK; ++i)
        sensors->triangles[i] = numbers[mesh->indices[i]];
    sensors->view.triangle_count = mesh->triangle_count;
    sensors->view.triangles = sensors->triangles;
    free(numbers);
    free(smooth.normals);
    return result;
}

aur_result aur_sensors_take_mesh(const char *path, const aur_sensors_options *options, aur_sensors *sensors,
                                 aur_error *error) {
    aur_facets_options load = {.size = sizeof load};
    aur_facets_options_init(&load, NULL);
    aur_facets *facets = NULL;
    load.warnings = options->warnings;
    aur_result result = aur_facets_load_uncut(path, &load, &facets, error);
    if (result == AUR_OK)
        result = options->place == AUR_SENSORS_ON_VERTICES
                     ? stand_on_vertices(&facets->scene->shapes[0]->mesh, path, sensors, error)
                     : stand_on_faces(facets, path, sensors, error);
    aur_facets_destroy(facets);
    return result;
}
