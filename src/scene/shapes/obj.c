/* Wavefront OBJ: v, vt, vn and f; polygons become fans; names, groups and materials are left out. */
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "scene/shapes/mesh_file.h"

typedef struct number_list {
    size_t count, capacity, width; /* in groups of `width` */
    double *values;
} number_list;

/* A corner of a face: vertex, texture coordinate and normal, or NONE. */
typedef struct corner {
    uint32_t index[3];
} corner;

#define NONE UINT32_MAX

typedef struct obj {
    aur_mesh_file *file;
    number_list lists[3]; /* v, vt, vn */
    number_list colors;   /* of vertices, 1 where a line has none; empty: no line has any */
    size_t corner_count, corner_capacity;
    corner *corners; /* three a triangle */
} obj;

/* `least` numbers at least, and at most as many as the list is wide; those that are missing are 0. */
static aur_result read_values(obj *self, number_list *list, size_t least) {
    aur_scanner *const scanner = &self->file->scanner;
    if (!aur_array_reserve(&list->values, &list->capacity, list->count + 1,
                           list->width * sizeof *list->values))
        return aur_fail_memory(self->file->error);
    for (size_t i = 0; i < list->width; ++i) {
        double value = 0.0;
        if ((i < least || !aur_scan_line_done(scanner)) && !aur_scan_double(scanner, &value))
            return aur_mesh_file_fail(self->file, "expected %zu numbers", list->width);
        if (!(fabs(value) <= 1e30))
            return aur_mesh_file_fail(self->file, "a coordinate is not finite, or beyond 1e30");
        list->values[list->width * list->count + i] = value;
    }
    ++list->count;
    return AUR_OK;
}

/* "v x y z r g b": three more numbers are a colour, one alone is a weight. */
static aur_result read_color(obj *self) {
    aur_scanner *const scanner = &self->file->scanner;
    double color[3];
    size_t count = 0;
    while (count < 3 && !aur_scan_line_done(scanner) && aur_scan_double(scanner, &color[count]) &&
           fabs(color[count]) <= 1e30)
        ++count;
    if (count < 3 && self->colors.count == 0)
        return AUR_OK;
    number_list *const list = &self->colors;
    if (!aur_array_reserve(&list->values, &list->capacity, self->lists[0].count, 3 * sizeof *list->values))
        return aur_fail_memory(self->file->error);
    for (; list->count < self->lists[0].count; ++list->count)
        for (size_t i = 0; i < 3; ++i)
            list->values[3 * list->count + i] =
                count == 3 && list->count + 1 == self->lists[0].count ? color[i] : 1.0;
    return AUR_OK;
}

/* "v", "v/t", "v//n" or "v/t/n"; indices count from 1, negative ones from the last. */
static aur_result read_corner(obj *self, corner *result) {
    static const char *const what[] = {"vertex", "texture coordinate", "normal"};
    aur_scanner *const scanner = &self->file->scanner;
    *result = (corner){{NONE, NONE, NONE}};
    aur_scan_blanks(scanner);
    for (size_t i = 0; i < 3; ++i) {
        if (i > 0 && *scanner->at != '/')
            continue;
        scanner->at += i > 0;
        if (i > 0 && (*scanner->at == '/' || aur_is_blank(*scanner->at) || *scanner->at == '\n'))
            continue;
        int64_t number;
        if (!aur_scan_integer(scanner, &number))
            return aur_mesh_file_fail(self->file, "a face needs indices such as 1, 1/1 or 1/1/1");
        const int64_t count = (int64_t)self->lists[i].count;
        const int64_t index = number < 0 ? count + number : number - 1;
        if (number == 0 || index < 0 || index >= count)
            return aur_mesh_file_fail(self->file, "index %lld is no %s: there are %lld so far",
                                      (long long)number, what[i], (long long)count);
        if (index >= (int64_t)NONE)
            return aur_mesh_file_fail(self->file, "more than 2^32 - 2 vertices");
        result->index[i] = (uint32_t)index;
    }
    return AUR_OK;
}

/* From the third corner on, each makes a triangle with the first and the one before. */
static aur_result read_face(obj *self) {
    corner first, previous, current;
    size_t count = 0;
    for (; !aur_scan_line_done(&self->file->scanner); ++count) {
        const aur_result result = read_corner(self, &current);
        if (result != AUR_OK)
            return result;
        if (count == 0)
            first = current;
        if (count >= 2) {
            if (!aur_array_reserve(&self->corners, &self->corner_capacity, self->corner_count + 3,
                                   sizeof *self->corners))
                return aur_fail_memory(self->file->error);
            self->corners[self->corner_count++] = first;
            self->corners[self->corner_count++] = previous;
            self->corners[self->corner_count++] = current;
        }
        previous = current;
    }
    return count >= 3 ? AUR_OK : aur_mesh_file_fail(self->file, "a face needs at least 3 corners");
}

/* The keywords of the format. Lines of the first four are read, those of the others are skipped. */
static const char *const keywords[] = {
    "v",    "vt",         "vn",        "f",     "g",     "o",    "s",     "usemtl", "mtllib",   "l",
    "p",    "vp",         "cstype",    "deg",   "end",   "curv", "curv2", "surf",   "parm",     "trim",
    "hole", "scrv",       "sp",        "con",   "bmat",  "step", "mg",    "bevel",  "c_interp", "d_interp",
    "lod",  "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh"};

static aur_result read_line(obj *self) {
    const size_t count = sizeof keywords / sizeof keywords[0];
    const size_t which = aur_word_find(aur_scan_word(&self->file->scanner), count, keywords);
    if (which < 3) {
        const aur_result result = read_values(self, &self->lists[which], which == 1 ? 1 : 3);
        return result == AUR_OK && which == 0 ? read_color(self) : result;
    }
    if (which == 3)
        return read_face(self);
    /* Any file may be named by a scene, so that its words are not quoted. */
    return which < count ? AUR_OK
                         : aur_mesh_file_fail(self->file, "the line begins with no keyword of an OBJ file");
}

static aur_result read_all(obj *self) {
    aur_scanner *const scanner = &self->file->scanner;
    for (scanner->line = 1; scanner->at < scanner->end; aur_scan_next_line(scanner)) {
        const aur_result result = aur_scan_line_done(scanner) ? AUR_OK : read_line(self);
        if (result != AUR_OK)
            return result;
        if (*scanner->at == '\0' && scanner->at < scanner->end)
            return aur_mesh_file_fail(self->file, "a zero byte: this is no OBJ file");
    }
    if (self->corner_count >= NONE)
        return aur_mesh_file_fail(self->file, "more than 2^32 - 2 corners");
    for (size_t i = 0; self->file->face_normals && i < self->corner_count; ++i)
        self->corners[i].index[2] = NONE;
    if (self->file->face_normals)
        self->lists[2].count = 0;
    return AUR_OK;
}

static uint64_t hash_corner(const corner *c) {
    uint64_t h = c->index[0] * UINT64_C(0x9e3779b97f4a7c15);
    h = (h ^ (h >> 32) ^ c->index[1]) * UINT64_C(0xbf58476d1ce4e5b9);
    h = (h ^ (h >> 32) ^ c->index[2]) * UINT64_C(0x94d049bb133111eb);
    return h ^ (h >> 29);
}

/* Gives each distinct corner a vertex of its own: vertex[corner_count] of the corners, and *unique, the first
 * corner of each vertex. Returns how many there are, and 0 when memory is out. */
static size_t merge_corners(const obj *self, uint32_t *vertex, uint32_t *unique) {
    size_t slots = 16, count = 0;
    while (slots < 2 * self->corner_count)
        slots *= 2;
    uint32_t *const table = malloc(slots * sizeof *table);
    if (table != NULL)
        memset(table, 0xff, slots * sizeof *table);
    for (size_t i = 0; table != NULL && i < self->corner_count; ++i) {
        size_t slot = hash_corner(&self->corners[i]) & (slots - 1);
        while (table[slot] != NONE &&
               memcmp(&self->corners[unique[table[slot]]], &self->corners[i], sizeof(corner)) != 0)
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == NONE) {
            table[slot] = (uint32_t)count;
            unique[count++] = (uint32_t)i;
        }
        vertex[i] = table[slot];
    }
    free(table);
    return count;
}

/* The values of a corner, where it has any, as those of a vertex. */
static void copy(const number_list *list, uint32_t index, size_t vertex, float *to) {
    for (size_t i = 0; index != NONE && i < list->width; ++i)
        to[list->width * vertex + i] = (float)list->values[list->width * (size_t)index + i];
}

/* Vertex i of the mesh is corner unique[i], or vertex i of the file where `unique` is NULL: without texture
 * coordinates and normals the file's own vertices serve. */
static aur_result make_mesh(const obj *self, size_t count, const uint32_t *unique, aur_mesh *mesh) {
    const unsigned parts = (self->lists[1].count > 0 ? AUR_MESH_UVS : 0u) |
                           (self->lists[2].count > 0 ? AUR_MESH_NORMALS : 0u) |
                           (self->colors.count > 0 ? AUR_MESH_VERTEX_COLORS : 0u);
    const aur_result result =
        aur_mesh_allocate(mesh, count, 0, parts, (aur_location){.file = self->file->path}, self->file->error);
    for (size_t i = 0; result == AUR_OK && i < count; ++i) {
        const corner c = unique != NULL ? self->corners[unique[i]] : (corner){{(uint32_t)i, NONE, NONE}};
        memcpy(&mesh->points[3 * i], &self->lists[0].values[3 * (size_t)c.index[0]], 3 * sizeof(double));
        copy(&self->lists[1], c.index[1], i, mesh->uvs);
        copy(&self->lists[2], c.index[2], i, mesh->normals);
        if (mesh->vertex_colors != NULL)
            copy(&self->colors, c.index[0], i, mesh->vertex_colors);
        if (c.index[1] != NONE && self->file->flip_v)
            mesh->uvs[2 * i + 1] = 1.0f - mesh->uvs[2 * i + 1];
    }
    return result;
}

static aur_result index_corners(const obj *self, uint32_t **indices, aur_mesh *mesh) {
    const bool plain = self->lists[1].count == 0 && self->lists[2].count == 0;
    uint32_t *const vertex = *indices = malloc((self->corner_count + 1) * sizeof *vertex);
    uint32_t *const unique = plain ? NULL : malloc((self->corner_count + 1) * sizeof *unique);
    if (vertex == NULL || (unique == NULL && !plain)) {
        free(unique);
        return aur_fail_memory(self->file->error);
    }
    for (size_t i = 0; plain && i < self->corner_count; ++i)
        vertex[i] = self->corners[i].index[0];
    const size_t count = plain ? self->lists[0].count : merge_corners(self, vertex, unique);
    const aur_result result = count > 0 || self->corner_count == 0 ? make_mesh(self, count, unique, mesh)
                                                                   : aur_fail_memory(self->file->error);
    free(unique);
    return result;
}

static aur_result read_file(aur_mesh_file *file, aur_mesh *mesh) {
    obj self = {.file = file, .lists = {{.width = 3}, {.width = 2}, {.width = 3}}, .colors = {.width = 3}};
    uint32_t *indices = NULL;
    aur_result result = read_all(&self);
    if (result == AUR_OK)
        result = index_corners(&self, &indices, mesh);
    if (result == AUR_OK)
        aur_mesh_take_indices(mesh, self.corner_count, &indices);
    for (size_t i = 0; i < 3; ++i)
        free(self.lists[i].values);
    free(self.colors.values);
    free(self.corners);
    free(indices);
    return result;
}

static const aur_key keys[] = {
    AUR_MESH_FILE_KEYS,
    {AUR_KEY_OF_BOOLEAN(aur_mesh_file_keys, "flip_tex_coords", flip_v, "true",
                        "v of the texture coordinates is turned over")},
};

const aur_shape_descriptor aur_shape_obj = {
    .row = {.name = "obj", .summary = "a Wavefront OBJ file", AUR_ROW_KEYS(keys)},
    .create = aur_mesh_file_create,
    .read_file = read_file};
