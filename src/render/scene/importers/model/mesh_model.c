#include "render/scene/importers/model/import.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

typedef struct mesh_model {
    const aur_model_source *source;
    aur_model_files *files;
    aur_nodes *nodes;
    aur_xml_node *parent;
    aur_error *error;
    aur_mesh_data data;
    aur_named_files named;
    aur_mtl_library library;
    uint32_t *numbers; /* index of each vertex in the part being written, or NONE */
    uint32_t *used;    /* vertices of that part */
} mesh_model;

#define NONE UINT32_MAX

static aur_result add_part(mesh_model *self, size_t size, char *bytes) {
    aur_model_files *const files = self->files;
    char *const name = strdup(self->source->name);
    if (name == NULL || bytes == NULL ||
        !aur_array_reserve(&files->items, &files->capacity, files->count + 1, sizeof *files->items)) {
        free(name);
        free(bytes);
        return aur_fail_memory(self->error);
    }
    files->items[files->count++] = (aur_model_file){name, size, bytes};
    return AUR_OK;
}

static bool has_colors(const aur_mesh_data *data, size_t *index) {
    for (*index = 0; *index < data->attribute_count; ++*index)
        if (strcmp(data->attributes[*index].name, "vertex_color") == 0 && data->attributes[*index].width == 3)
            return true;
    return false;
}

static aur_result add_shape(mesh_model *self, const char *type, const aur_mtl_material *material,
                            bool colored) {
    aur_xml_node *const shape = aur_node_object(self->nodes, self->parent, "shape", type);
    aur_node_property(self->nodes, shape, "string", "filename", "*%zu", self->files->count - 1);
    if (self->data.normals == NULL) /* 30 degrees, as in VTK and Blender */
        aur_node_property(self->nodes, shape, "float", "crease_angle", "30");
    aur_mesh_material_add(material, colored, self->nodes, shape);
    if (aur_mesh_material_emits(material)) {
        aur_mesh_material_add_emitter(material, self->nodes, shape);
    }
    return self->nodes->result;
}

static aur_result fail_empty(const mesh_model *self) {
    return aur_fail_at(self->error, self->source->location, AUR_ERROR_FORMAT, "this model has no triangle");
}

/* --- PLY, STL and OFF: the file is used unchanged */

static aur_result add_whole(mesh_model *self, const char *type) {
    const aur_model_source *const source = self->source;
    aur_mtl_material *const grey = aur_mtl_add(&self->library, "", 0);
    char *const bytes = malloc(source->size + 1);
    size_t index;
    if (bytes != NULL)
        memcpy(bytes, source->data, source->size + 1);
    const aur_result result =
        grey != NULL ? add_part(self, source->size, bytes) : aur_fail_memory(self->error);
    if (grey == NULL)
        free(bytes);
    return result == AUR_OK ? add_shape(self, type, grey, has_colors(&self->data, &index)) : result;
}

/* --- OBJ: one part per material */

static aur_result read_libraries(mesh_model *self) {
    aur_result result = AUR_OK;
    for (size_t i = 0; i < self->data.libraries.count && result == AUR_OK; ++i) {
        char *used, *text;
        size_t size;
        result = aur_named_read_part(&self->named, self->data.libraries.items[i], &used, &size, &text,
                                     self->error);
        if (result == AUR_OK && text != NULL)
            result = aur_mtl_read(&self->library, size, text, self->error);
        free(used);
        free(text);
    }
    return result;
}

/* Material of each span; the last one is for faces without a material. */
static size_t material_of(const aur_mesh_data *data, size_t face, size_t *span) {
    while (*span + 1 < data->span_count && data->spans[*span + 1].first_face <= face)
        ++*span;
    const uint32_t material = data->span_count > 0 ? data->spans[*span].material : AUR_MESH_NO_MATERIAL;
    return material == AUR_MESH_NO_MATERIAL ? data->materials.count : material;
}

/* Sorts the triangles by material: order[firsts[m]] ... order[firsts[m + 1] - 1]. */
static bool sort_triangles(const aur_mesh_data *data, size_t *firsts, uint32_t *order) {
    size_t span = 0;
    uint32_t *const materials = malloc((data->triangle_count + 1) * sizeof *materials);
    if (materials == NULL)
        return false;
    for (size_t i = 0; i < data->triangle_count; ++i) {
        materials[i] = (uint32_t)material_of(data, aur_mesh_face(data, i), &span);
        ++firsts[materials[i] + 2];
    }
    for (size_t m = 0; m <= data->materials.count; ++m)
        firsts[m + 2] += firsts[m + 1];
    for (size_t i = 0; i < data->triangle_count; ++i)
        order[firsts[materials[i] + 1]++] = (uint32_t)i;
    free(materials);
    return true;
}

static size_t number_vertices(mesh_model *self, size_t count, const uint32_t *triangles) {
    size_t used = 0;
    for (size_t i = 0; i < 3 * count; ++i) {
        const uint32_t vertex = self->data.indices[3 * (size_t)triangles[i / 3] + i % 3];
        if (self->numbers[vertex] != NONE)
            continue;
        self->numbers[vertex] = (uint32_t)used;
        self->used[used++] = vertex;
    }
    return used;
}

static char *append(char *at, const void *values, size_t size) {
    memcpy(at, values, size);
    return at + size;
}

static char *append_vertex(char *at, const aur_mesh_data *data, size_t vertex, const float *colors) {
    at = append(at, &data->points[3 * vertex], 3 * sizeof(double));
    if (data->normals != NULL)
        at = append(at, &data->normals[3 * vertex], 3 * sizeof(float));
    if (data->uvs != NULL) /* OBJ counts v upwards from the bottom */
        at = append(at, (float[2]){data->uvs[2 * vertex], 1.0f - data->uvs[2 * vertex + 1]},
                    2 * sizeof(float));
    if (colors != NULL)
        at = append(at, &colors[3 * vertex], 3 * sizeof(float));
    return at;
}

/* Writes triangles as a PLY file; coordinates are stored as doubles. */
static char *write_ply(mesh_model *self, size_t count, const uint32_t *triangles, size_t *size) {
    const aur_mesh_data *const data = &self->data;
    const size_t vertices = number_vertices(self, count, triangles);
    size_t index;
    const float *const colors = has_colors(data, &index) ? data->attributes[index].values : NULL;
    const uint16_t one = 1;
    char header[512];
    const int length = snprintf(
        header, sizeof header,
        "ply\nformat binary_%s_endian 1.0\nelement vertex %zu\nproperty double x\nproperty double y\n"
        "property double z\n%s%s%selement face %zu\nproperty list uchar uint vertex_indices\nend_header\n",
        *(const unsigned char *)&one == 1 ? "little" : "big", vertices,
        data->normals != NULL ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        data->uvs != NULL ? "property float u\nproperty float v\n" : "",
        colors != NULL ? "property float r\nproperty float g\nproperty float b\n" : "", count);
    const size_t floats =
        (data->normals != NULL ? 3u : 0u) + (data->uvs != NULL ? 2u : 0u) + (colors != NULL ? 3u : 0u);
    *size = (size_t)length + vertices * (3 * sizeof(double) + floats * sizeof(float)) +
            count * (1 + 3 * sizeof(uint32_t));
    char *const bytes = malloc(*size + 1);
    char *at = bytes != NULL ? append(bytes, header, (size_t)length) : NULL;
    for (size_t i = 0; bytes != NULL && i < vertices; ++i)
        at = append_vertex(at, data, self->used[i], colors);
    for (size_t i = 0; bytes != NULL && i < 3 * count; ++i) {
        if (i % 3 == 0)
            *at++ = 3;
        at =
            append(at, &self->numbers[data->indices[3 * (size_t)triangles[i / 3] + i % 3]], sizeof(uint32_t));
    }
    if (bytes != NULL)
        *at = '\0';
    for (size_t i = 0; i < vertices; ++i)
        self->numbers[self->used[i]] = NONE;
    return bytes;
}

static aur_result add_triangles(mesh_model *self, size_t material, size_t count, const uint32_t *triangles) {
    const char *const name =
        material < self->data.materials.count ? self->data.materials.items[material] : "";
    aur_mtl_material *found = aur_mtl_find(&self->library, name);
    if (found == NULL)
        found = aur_mtl_add(&self->library, name, strlen(name));
    aur_result result = found != NULL ? aur_mesh_material_find(found, &self->named, self->error)
                                      : aur_fail_memory(self->error);
    if (result != AUR_OK)
        return result;
    size_t size = 0, index;
    char *const bytes = write_ply(self, count, triangles, &size);
    result = add_part(self, size, bytes);
    return result == AUR_OK ? add_shape(self, "ply", found, has_colors(&self->data, &index)) : result;
}

static aur_result add_parts(mesh_model *self) {
    const aur_mesh_data *const data = &self->data;
    size_t *const firsts = calloc(data->materials.count + 3, sizeof *firsts);
    uint32_t *const order = malloc((data->triangle_count + 1) * sizeof *order);
    self->numbers = malloc((data->vertex_count + 1) * sizeof *self->numbers);
    self->used = malloc((data->vertex_count + 1) * sizeof *self->used);
    aur_result result = AUR_OK;
    if (firsts == NULL || order == NULL || self->numbers == NULL || self->used == NULL ||
        !sort_triangles(data, firsts, order))
        result = aur_fail_memory(self->error);
    if (result == AUR_OK)
        memset(self->numbers, 0xff, data->vertex_count * sizeof *self->numbers);
    for (size_t m = 0; m <= data->materials.count && result == AUR_OK; ++m)
        if (firsts[m + 1] > firsts[m])
            result = add_triangles(self, m, firsts[m + 1] - firsts[m], &order[firsts[m]]);
    free(firsts);
    free(order);
    return result;
}

static void warn_of_flaws(const mesh_model *self) {
    const aur_face_flaws *const flaws = &self->data.flaws;
    for (aur_face_flaw flaw = AUR_FACE_GOOD + 1; flaw < AUR_FACE_FLAW_COUNT; ++flaw)
        if (flaws->counts[flaw] > 0)
            aur_warn_at(self->source->warnings,
                        (aur_location){.file = self->source->location.file, .line = flaws->lines[flaw]},
                        "%zu of %zu faces %s", flaws->counts[flaw], flaws->face_count,
                        aur_face_flaw_text(flaw));
}

/* --- entry point */

static aur_result add_model(mesh_model *self, aur_mesh_format format) {
    static const char *const types[AUR_MESH_FORMAT_COUNT] = {"obj", "ply", "stl", "off"};
    aur_result result = AUR_OK;
    if (self->data.triangle_count == 0)
        return fail_empty(self);
    if (format == AUR_MESH_OBJ) {
        result = read_libraries(self);
        if (result == AUR_OK)
            result = add_parts(self);
        warn_of_flaws(self);
    } else {
        result = add_whole(self, types[format]);
    }
    aur_named_warn(&self->named);
    return result == AUR_OK && self->source->stage != NULL
               ? aur_model_surround(self->source, &(aur_import_camera){0}, self->nodes, self->parent)
               : result;
}

aur_result aur_model_from_mesh(const aur_model_source *source, aur_mesh_format format, aur_model_files *files,
                               aur_nodes *nodes, aur_xml_node *parent) {
    const aur_mesh_source mesh = {
        .path = source->location.file, .format = format, .size = source->size, .data = source->data};
    mesh_model self = {.source = source,
                       .files = files,
                       .nodes = nodes,
                       .parent = parent,
                       .error = nodes->error,
                       .named = {.source = source}};
    aur_result result = aur_mesh_read(&mesh, &self.data, nodes->error);
    if (result != AUR_OK)
        return result;
    const aur_mesh_format detected = aur_mesh_format_of_bytes(source->size, source->data);
    result = add_model(&self, detected < AUR_MESH_FORMAT_COUNT ? detected : format);
    free(self.numbers);
    free(self.used);
    aur_mtl_release(&self.library);
    aur_mesh_data_release(&self.data);
    return result;
}
