/* Line numbers and groups of the facets in a mesh file. */
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/facets.h"
#include "points/base/file.h"
#include "render/scene/importers/meshes/mesh_data.h"

static aur_result take_lines(aur_facets *facets, const aur_mesh_data *data, aur_error *error) {
    if (data->lines == NULL)
        return AUR_OK;
    facets->lines = calloc(facets->source_count + 1, sizeof *facets->lines);
    if (facets->lines == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < facets->source_count; ++i)
        facets->lines[i] = aur_mesh_line(data, aur_mesh_face(data, i));
    return AUR_OK;
}

/* Moves the names from one to the other. */
static void take_groups(aur_facets *facets, aur_mesh_data *data) {
    facets->group_count = data->groups.count;
    facets->names = data->groups.items;
    data->groups = (aur_mesh_names){0};
    for (size_t i = 0, span = 0; i < facets->source_count; ++i) {
        const size_t face = aur_mesh_face(data, i);
        while (span + 1 < data->span_count && data->spans[span + 1].first_face <= face)
            ++span;
        facets->source_groups[i] = data->spans[span].group;
    }
    for (size_t i = 0; i < facets->count; ++i)
        facets->groups[i] = facets->source_groups[facets->sources[i]];
}

aur_result aur_facets_read_sources(aur_facets *facets, aur_error *error) {
    aur_mesh_source source = {.path = facets->path, .format = aur_mesh_format_of_name(facets->path)};
    char *bytes;
    aur_result result = aur_file_read(facets->path, (size_t)1 << 35, &bytes, &source.size, error);
    if (result != AUR_OK)
        return result;
    aur_mesh_data data;
    source.data = bytes;
    source.without_normals = true;
    result = aur_mesh_read(&source, &data, error);
    free(bytes);
    if (result == AUR_OK && data.triangle_count != facets->source_count)
        result = aur_fail_at(error, (aur_location){.file = facets->path}, AUR_ERROR_FORMAT,
                             "the file has changed while it was read");
    if (result == AUR_OK)
        result = take_lines(facets, &data, error);
    if (result == AUR_OK && data.span_count > 0)
        take_groups(facets, &data);
    aur_mesh_data_release(&data);
    return result;
}
