/* Wavefront OBJ: v, vt, vn and f; polygons become fans; names, groups and materials are left out. */
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "scene/shape.h"
#include "scene/shapes/text_scanner.h"

#define LARGEST_FILE ((size_t)1 << 35)

typedef struct float_list {
    size_t count, capacity, width; /* in groups of `width` */
    float *values;
} float_list;

/* A corner of a face: vertex, texture coordinate and normal, or NONE. */
typedef struct corner {
    uint32_t index[3];
} corner;

#define NONE UINT32_MAX

typedef struct obj {
    aur_scanner scanner;
    const char *file;
    aur_error *error;
    float_list lists[3]; /* v, vt, vn */
    size_t corner_count, corner_capacity;
    corner *corners; /* three a triangle */
} obj;

static aur_location here(const obj *self) {
    return (aur_location){self->file, self->scanner.line, 0};
}

static aur_result fail_memory(const obj *self) {
    return aur_fail_memory_at(self->error, here(self));
}

static aur_result read_values(obj *self, float_list *list, size_t least) {
    double value[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < list->width; ++i) {
        if (i >= least && aur_scan_line_done(&self->scanner))
            break;
        if (!aur_scan_double(&self->scanner, &value[i]))
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "expected %zu numbers",
                               list->width);
        if (!isfinite(value[i]) || fabs(value[i]) > 1e30)
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT,
                               "a coordinate is not finite, or beyond 1e30");
    }
    if (list->count == list->capacity) {
        const size_t capacity = list->capacity == 0 ? 1024 : 2 * list->capacity;
        float *const larger = realloc(list->values, capacity * list->width * sizeof(float));
        if (larger == NULL)
            return fail_memory(self);
        list->values = larger;
        list->capacity = capacity;
    }
    for (size_t i = 0; i < list->width; ++i)
        list->values[list->width * list->count + i] = (float)value[i];
    ++list->count;
    return AUR_OK;
}

/* "v", "v/t", "v//n" or "v/t/n"; indices count from 1, negative ones from the last. */
static aur_result read_corner(obj *self, corner *result) {
    static const char *const what[] = {"vertex", "texture coordinate", "normal"};
    aur_scan_blanks(&self->scanner);
    for (size_t i = 0; i < 3; ++i) {
        result->index[i] = NONE;
        if (i > 0 && *self->scanner.at != '/')
            continue;
        if (i > 0)
            ++self->scanner.at;
        if (i > 0 &&
            (*self->scanner.at == '/' || aur_is_blank(*self->scanner.at) || *self->scanner.at == '\n'))
            continue;
        int64_t number;
        if (!aur_scan_integer(&self->scanner, &number))
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT,
                               "a face needs indices such as 1, 1/1 or 1/1/1");
        const int64_t count = (int64_t)self->lists[i].count;
        const int64_t index = number < 0 ? count + number : number - 1;
        if (number == 0 || index < 0 || index >= count)
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT,
                               "index %lld is no %s: there are %lld so far", (long long)number, what[i],
                               (long long)count);
        if (index >= (int64_t)NONE)
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "more than 2^32 - 2 vertices");
        result->index[i] = (uint32_t)index;
    }
    return AUR_OK;
}

static aur_result read_face(obj *self) {
    corner first = {{0}}, previous = {{0}}, current;
    for (size_t count = 0;; ++count) {
        if (aur_scan_line_done(&self->scanner)) {
            if (count >= 3)
                return AUR_OK;
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "a face needs at least 3 corners");
        }
        const aur_result result = read_corner(self, &current);
        if (result != AUR_OK)
            return result;
        if (count == 0)
            first = current;
        if (count >= 2) {
            if (self->corner_count + 3 > self->corner_capacity) {
                const size_t capacity = self->corner_capacity == 0 ? 3072 : 2 * self->corner_capacity;
                corner *const larger = realloc(self->corners, capacity * sizeof *larger);
                if (larger == NULL)
                    return fail_memory(self);
                self->corners = larger;
                self->corner_capacity = capacity;
            }
            self->corners[self->corner_count++] = first;
            self->corners[self->corner_count++] = previous;
            self->corners[self->corner_count++] = current;
        }
        previous = current;
    }
}

static aur_result read_line(obj *self) {
    const char *word;
    const size_t length = aur_scan_word(&self->scanner, &word);
    if (length == 1 && word[0] == 'v')
        return read_values(self, &self->lists[0], 3);
    if (length == 2 && word[0] == 'v' && word[1] == 't')
        return read_values(self, &self->lists[1], 1);
    if (length == 2 && word[0] == 'v' && word[1] == 'n')
        return read_values(self, &self->lists[2], 3);
    if (length == 1 && word[0] == 'f')
        return read_face(self);
    static const char *const left_out[] = {
        "g",          "o",         "s",     "usemtl", "mtllib", "l",     "p",        "vp",       "cstype",
        "deg",        "end",       "curv",  "curv2",  "surf",   "parm",  "trim",     "hole",     "scrv",
        "sp",         "con",       "bmat",  "step",   "mg",     "bevel", "c_interp", "d_interp", "lod",
        "shadow_obj", "trace_obj", "ctech", "stech",  "call",   "csh"};
    for (size_t i = 0; i < sizeof left_out / sizeof left_out[0]; ++i)
        if (strlen(left_out[i]) == length && memcmp(left_out[i], word, length) == 0)
            return AUR_OK;
    /* Any file may be named by a scene, so that its words are not quoted. */
    return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT,
                       "the line begins with no keyword of an OBJ file");
}

static aur_result read_all(obj *self) {
    while (self->scanner.at < self->scanner.end) {
        if (!aur_scan_line_done(&self->scanner)) {
            const aur_result result = read_line(self);
            if (result != AUR_OK)
                return result;
        }
        if (*self->scanner.at == '\0' && self->scanner.at < self->scanner.end)
            return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "a zero byte: this is no OBJ file");
        aur_scan_next_line(&self->scanner);
    }
    return AUR_OK;
}

static uint64_t hash_corner(const corner *c) {
    uint64_t h = c->index[0] * UINT64_C(0x9e3779b97f4a7c15);
    h = (h ^ (h >> 32) ^ c->index[1]) * UINT64_C(0xbf58476d1ce4e5b9);
    h = (h ^ (h >> 32) ^ c->index[2]) * UINT64_C(0x94d049bb133111eb);
    return h ^ (h >> 29);
}

/* Gives each distinct corner a vertex of its own: corner_vertex[corner_count] and *unique, the first corner
 * of each vertex. */
static aur_result merge_corners(const obj *self, uint32_t *corner_vertex, uint32_t *unique,
                                size_t *unique_count) {
    size_t slots = 16;
    while (slots < 2 * self->corner_count)
        slots *= 2;
    uint32_t *const table = malloc(slots * sizeof *table);
    if (table == NULL)
        return fail_memory(self);
    memset(table, 0xff, slots * sizeof *table);
    *unique_count = 0;
    for (size_t i = 0; i < self->corner_count; ++i) {
        size_t slot = hash_corner(&self->corners[i]) & (slots - 1);
        while (table[slot] != NONE &&
               memcmp(&self->corners[unique[table[slot]]], &self->corners[i], sizeof(corner)) != 0)
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == NONE) {
            table[slot] = (uint32_t)*unique_count;
            unique[(*unique_count)++] = (uint32_t)i;
        }
        corner_vertex[i] = table[slot];
    }
    free(table);
    return AUR_OK;
}

/* Without texture coordinates and normals the file's own vertices serve. */
static aur_result make_plain(const obj *self, aur_mesh *mesh) {
    const float_list *const v = &self->lists[0];
    const aur_result result =
        aur_mesh_allocate(mesh, v->count, self->corner_count / 3, 0, here(self), self->error);
    if (result != AUR_OK)
        return result;
    if (v->count > 0)
        memcpy(mesh->positions, v->values, 3 * v->count * sizeof(float));
    for (size_t i = 0; i < self->corner_count; ++i)
        mesh->indices[i] = self->corners[i].index[0];
    return AUR_OK;
}

static aur_result make_merged(const obj *self, bool flip_v, aur_mesh *mesh) {
    if (self->corner_count >= NONE)
        return aur_fail_at(self->error, here(self), AUR_ERROR_FORMAT, "more than 2^32 - 2 corners");
    uint32_t *const unique = malloc((self->corner_count + 1) * sizeof *unique);
    uint32_t *const vertex = malloc((self->corner_count + 1) * sizeof *vertex);
    size_t count = 0;
    aur_result result = AUR_OK;
    if (unique == NULL || vertex == NULL)
        result = fail_memory(self);
    if (result == AUR_OK)
        result = merge_corners(self, vertex, unique, &count);
    const unsigned parts =
        (self->lists[1].count > 0 ? AUR_MESH_UVS : 0u) | (self->lists[2].count > 0 ? AUR_MESH_NORMALS : 0u);
    if (result == AUR_OK)
        result = aur_mesh_allocate(mesh, count, self->corner_count / 3, parts, here(self), self->error);
    for (size_t i = 0; result == AUR_OK && i < count; ++i) {
        const corner *const c = &self->corners[unique[i]];
        memcpy(&mesh->positions[3 * i], &self->lists[0].values[3 * (size_t)c->index[0]], 3 * sizeof(float));
        if (c->index[1] != NONE) {
            const float *const uv = &self->lists[1].values[2 * (size_t)c->index[1]];
            mesh->uvs[2 * i] = uv[0];
            mesh->uvs[2 * i + 1] = flip_v ? 1.0f - uv[1] : uv[1];
        }
        if (c->index[2] != NONE)
            memcpy(&mesh->normals[3 * i], &self->lists[2].values[3 * (size_t)c->index[2]], 3 * sizeof(float));
    }
    if (result == AUR_OK)
        memcpy(mesh->indices, vertex, self->corner_count * sizeof *vertex);
    free(unique);
    free(vertex);
    return result;
}

static aur_result read_file(const char *path, bool face_normals, bool flip_v, aur_mesh *mesh,
                            aur_error *error) {
    char *data;
    size_t size;
    aur_result result = aur_file_read(path, LARGEST_FILE, &data, &size, error);
    if (result != AUR_OK)
        return result;
    obj self = {.scanner = {data, data + size, 1}, .file = path, .error = error};
    self.lists[0].width = self.lists[2].width = 3;
    self.lists[1].width = 2;
    result = read_all(&self);
    if (result == AUR_OK && self.corner_count == 0)
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT, "no face in this file");
    if (face_normals)
        self.lists[2].count = 0;
    for (size_t i = 0; face_normals && i < self.corner_count; ++i)
        self.corners[i].index[2] = NONE;
    if (result == AUR_OK)
        result = self.lists[1].count == 0 && self.lists[2].count == 0 ? make_plain(&self, mesh)
                                                                      : make_merged(&self, flip_v, mesh);
    for (size_t i = 0; i < 3; ++i)
        free(self.lists[i].values);
    free(self.corners);
    free(data);
    return result;
}

typedef struct obj_keys {
    const char *filename;
    bool face_normals, flip_v;
} obj_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(obj_keys, "filename", filename, NULL, "the file, beside the scene; must be given")},
    {AUR_KEY_OF_BOOLEAN(obj_keys, "face_normals", face_normals, "false",
                        "flat triangles, whatever normals the file has")},
    {AUR_KEY_OF_BOOLEAN(obj_keys, "flip_tex_coords", flip_v, "true",
                        "v of the texture coordinates is turned over")},
};

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    obj_keys p = {.filename = NULL};
    char *path = NULL;
    aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result == AUR_OK)
        result = aur_shape_filename(input, p.filename, &path, error);
    if (result == AUR_OK)
        result = read_file(path, p.face_normals, p.flip_v, &shape->mesh, error);
    free(path);
    if (result != AUR_OK)
        return result;
    const bool smooth = !p.face_normals && shape->mesh.normals == NULL;
    aur_shape_place(input, shape);
    return smooth ? aur_mesh_smooth(&shape->mesh, input->parameters->location, error) : AUR_OK;
}

const aur_shape_descriptor aur_shape_obj = {
    .row = {.name = "obj", .summary = "a Wavefront OBJ file", .source = "", AUR_ROW_KEYS(keys)},
    .create = create};
