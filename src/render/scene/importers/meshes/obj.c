/* Wavefront OBJ: v, vt, vn and f, with groups and material names. */
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/text.h"
#include "render/scene/importers/meshes/mesh_reader.h"

typedef struct number_list {
    size_t count, capacity, width; /* `width` numbers per item */
    float *values;
} number_list;

/* A corner of a face: vertex, texture coordinate and normal, or AUR_MESH_NO_INDEX. */
typedef struct corner {
    uint32_t index[3];
} corner;

enum { VERTEX, TEXTURE, NORMAL };

typedef struct obj {
    aur_mesh_reader *reader;
    number_list lists[3]; /* vertex positions are in the mesh */
    number_list colors;   /* one per vertex, 1 if the line has none; empty: no line has any */
    /* Corners read, up to the last one that has more than a vertex index. */
    size_t corner_count, corner_capacity;
    corner *corners;
    aur_mesh_span span; /* group and material of the next face */
    /* The largest index of each kind, with its line: checked at the end, as indices may precede their
     * definitions. */
    uint32_t largest[3];
    size_t largest_line[3];
} obj;

static size_t count_of(const obj *self, size_t kind) {
    return kind == VERTEX ? self->reader->data->vertex_count : self->lists[kind].count;
}

/* --- numbers */

/* Reads `least` to `width` numbers; missing ones are 0. */
static aur_result read_numbers(obj *self, size_t width, size_t least, double *values) {
    aur_scanner *const scanner = &self->reader->scanner;
    for (size_t i = 0; i < width; ++i) {
        values[i] = 0.0;
        if ((i < least || !aur_scan_line_done(scanner)) && !aur_scan_double(scanner, &values[i]))
            return aur_mesh_reader_fail(self->reader, "expected %zu numbers", width);
        if (!aur_mesh_is_usable(values[i]))
            return aur_mesh_reader_fail(self->reader, "a coordinate is not finite, or beyond 1e30");
    }
    return AUR_OK;
}

static aur_result read_list(obj *self, number_list *list, size_t least) {
    double values[3];
    const aur_result result = read_numbers(self, list->width, least, values);
    if (result != AUR_OK)
        return result;
    if (!aur_array_reserve(&list->values, &list->capacity, list->count + 1, list->width * sizeof(float)))
        return aur_fail_memory(self->reader->error);
    for (size_t i = 0; i < list->width; ++i)
        list->values[list->width * list->count + i] = (float)values[i];
    ++list->count;
    return AUR_OK;
}

/* "v x y z r g b": three extra numbers are a colour, one is a weight. */
static aur_result read_color(obj *self) {
    aur_scanner *const scanner = &self->reader->scanner;
    double color[3];
    size_t count = 0;
    while (count < 3 && !aur_scan_line_done(scanner) && aur_scan_double(scanner, &color[count]) &&
           aur_mesh_is_usable(color[count]))
        ++count;
    if (count < 3 && self->colors.count == 0)
        return AUR_OK;
    number_list *const list = &self->colors;
    const size_t vertices = count_of(self, VERTEX);
    if (!aur_array_reserve(&list->values, &list->capacity, vertices, 3 * sizeof(float)))
        return aur_fail_memory(self->reader->error);
    for (; list->count < vertices; ++list->count)
        for (size_t i = 0; i < 3; ++i)
            list->values[3 * list->count + i] =
                count == 3 && list->count + 1 == vertices ? (float)color[i] : 1.0f;
    return AUR_OK;
}

static aur_result read_vertex(obj *self) {
    double point[3];
    aur_result result = read_numbers(self, 3, 3, point);
    if (result == AUR_OK)
        result = aur_mesh_reader_add_vertex(self->reader, point);
    return result == AUR_OK ? read_color(self) : result;
}

/* --- faces */

static const char *const kind_names[] = {"vertex", "texture coordinate", "normal"};

/* Indices count from 1, negative ones from the last item. Positive ones may refer to later items. */
static aur_result read_index(obj *self, size_t kind, uint32_t *index) {
    int64_t number;
    if (!aur_scan_integer(&self->reader->scanner, &number))
        return aur_mesh_reader_fail(self->reader, "a face needs indices such as 1, 1/1 or 1/1/1");
    const int64_t count = (int64_t)count_of(self, kind);
    const int64_t found = number < 0 ? count + number : number - 1;
    if (found < 0 || found >= (int64_t)AUR_MESH_NO_INDEX - 1)
        return aur_mesh_reader_fail(self->reader, "index %lld is not a %s: there are %lld so far",
                                    (long long)number, kind_names[kind], (long long)count);
    *index = (uint32_t)found;
    if (*index >= self->largest[kind]) {
        self->largest[kind] = *index + 1;
        self->largest_line[kind] = self->reader->scanner.line;
    }
    return AUR_OK;
}

/* "v", "v/t", "v//n" or "v/t/n"; indices after a slash may be missing. */
static aur_result read_corner(obj *self, corner *result) {
    aur_scanner *const scanner = &self->reader->scanner;
    *result = (corner){{AUR_MESH_NO_INDEX, AUR_MESH_NO_INDEX, AUR_MESH_NO_INDEX}};
    for (size_t i = 0; i < 3; ++i) {
        if (i > 0 && *scanner->at != '/')
            break;
        scanner->at += i > 0;
        const char c = *scanner->at;
        if (i > 0 && (c == '/' || c == '\0' || aur_is_blank(c) || aur_is_line_end(c)))
            continue;
        const aur_result read = read_index(self, i, &result->index[i]);
        if (read != AUR_OK)
            return read;
    }
    const char c = *scanner->at;
    return c == '\0' || c == '#' || c == '\\' || aur_is_blank(c) || aur_is_line_end(c)
               ? AUR_OK
               : aur_mesh_reader_fail(self->reader, "a face needs indices such as 1, 1/1 or 1/1/1");
}

/* The index of a name in the list of distinct names; the last one is compared first. */
static aur_result find_name(obj *self, aur_mesh_names *names, aur_word word, uint32_t *index) {
    for (size_t i = names->count; i-- > 0;)
        if (aur_word_is(word, names->items[i])) {
            *index = (uint32_t)i;
            return AUR_OK;
        }
    char *const copy = strndup(word.text, word.length);
    if (copy == NULL ||
        !aur_array_reserve(&names->items, &names->capacity, names->count + 1, sizeof *names->items)) {
        free(copy);
        return aur_fail_memory(self->reader->error);
    }
    *index = (uint32_t)names->count;
    names->items[names->count++] = copy;
    return AUR_OK;
}

static aur_result read_group(obj *self) {
    static const aur_word unnamed = {7, "default"};
    const aur_word word = aur_scan_rest(&self->reader->scanner);
    return find_name(self, &self->reader->data->groups, word.length > 0 ? word : unnamed, &self->span.group);
}

static aur_result read_material(obj *self) {
    return find_name(self, &self->reader->data->materials, aur_scan_rest(&self->reader->scanner),
                     &self->span.material);
}

static aur_result read_library(obj *self) {
    uint32_t ignored;
    return find_name(self, &self->reader->data->libraries, aur_scan_rest(&self->reader->scanner), &ignored);
}

static aur_result begin_face(obj *self) {
    aur_mesh_data *const data = self->reader->data;
    if (data->groups.count == 0) {
        const aur_result result = find_name(self, &data->groups, (aur_word){7, "default"}, &self->span.group);
        if (result != AUR_OK)
            return result;
    }
    const aur_mesh_span *const last = data->span_count > 0 ? &data->spans[data->span_count - 1] : NULL;
    if (last != NULL && last->group == self->span.group && last->material == self->span.material)
        return AUR_OK;
    if (!aur_array_reserve(&data->spans, &data->span_capacity, data->span_count + 1, sizeof *data->spans))
        return aur_fail_memory(self->reader->error);
    self->span.first_face = data->face_count;
    data->spans[data->span_count++] = self->span;
    return AUR_OK;
}

/* Converts the reader's vertex indices to corners. */
static aur_result fill_corners(obj *self) {
    const aur_mesh_reader *const reader = self->reader;
    if (!aur_array_reserve(&self->corners, &self->corner_capacity, reader->corner_count, sizeof(corner)))
        return aur_fail_memory(reader->error);
    for (; self->corner_count < reader->corner_count; ++self->corner_count)
        self->corners[self->corner_count] =
            (corner){{reader->corners[self->corner_count], AUR_MESH_NO_INDEX, AUR_MESH_NO_INDEX}};
    return AUR_OK;
}

static aur_result add_corner(obj *self, const corner *c) {
    aur_result result = aur_mesh_reader_add_corner(self->reader, c->index[VERTEX]);
    if (result != AUR_OK || (c->index[TEXTURE] == AUR_MESH_NO_INDEX && c->index[NORMAL] == AUR_MESH_NO_INDEX))
        return result;
    result = fill_corners(self);
    if (result == AUR_OK)
        self->corners[self->corner_count - 1] = *c;
    return result;
}

/* Reads plain vertex indices while the line has nothing else. */
static aur_result read_vertices(obj *self) {
    enum { MOST = 8, MOST_DIGITS = 9 };
    aur_scanner *const scanner = &self->reader->scanner;
    uint32_t vertices[MOST];
    size_t count = 0;
    while (count < MOST) {
        const char *c = scanner->at;
        while (aur_is_blank(*c))
            ++c;
        const char *const start = c;
        uint32_t number = 0;
        for (; aur_is_digit(*c) && c - start < MOST_DIGITS; ++c)
            number = 10 * number + (uint32_t)(*c - '0');
        if (number == 0 || !(aur_is_blank(*c) || aur_is_line_end(*c)))
            break;
        if (number > self->largest[VERTEX]) {
            self->largest[VERTEX] = number;
            self->largest_line[VERTEX] = scanner->line;
        }
        vertices[count++] = number - 1;
        scanner->at = c;
    }
    return count > 0 ? aur_mesh_reader_add_corners(self->reader, count, vertices) : AUR_OK;
}

static aur_result read_face(obj *self) {
    aur_mesh_reader *const reader = self->reader;
    const size_t line = reader->scanner.line;
    aur_result result = begin_face(self);
    if (result == AUR_OK)
        result = read_vertices(self);
    while (result == AUR_OK && !aur_scan_line_done(&reader->scanner)) {
        corner c;
        result = read_corner(self, &c);
        if (result == AUR_OK)
            result = add_corner(self, &c);
    }
    return result == AUR_OK ? aur_mesh_reader_end_face(reader, line) : result;
}

/* --- lines */

/* Keywords of the format: those first in the list are read, the others skipped. */
static const char *const keywords[] = {
    "v",    "vt",         "vn",        "f",     "g",     "o",    "usemtl", "mtllib", "s",        "l",
    "p",    "vp",         "cstype",    "deg",   "end",   "curv", "curv2",  "surf",   "parm",     "trim",
    "hole", "scrv",       "sp",        "con",   "bmat",  "step", "mg",     "bevel",  "c_interp", "d_interp",
    "lod",  "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh"};

/* Most keywords are identified by one letter. */
static bool take_letter(aur_scanner *scanner, char letter) {
    const bool is = scanner->at[0] == letter && aur_is_blank(scanner->at[1]);
    scanner->at += is;
    return is;
}

static aur_result read_line(obj *self) {
    const size_t count = sizeof keywords / sizeof keywords[0];
    if (take_letter(&self->reader->scanner, 'v'))
        return read_vertex(self);
    if (take_letter(&self->reader->scanner, 'f'))
        return read_face(self);
    switch (aur_word_find(aur_scan_word(&self->reader->scanner), count, keywords)) {
    case 0:
        return read_vertex(self);
    case 1:
        return read_list(self, &self->lists[TEXTURE], 1);
    case 2:
        return read_list(self, &self->lists[NORMAL], 3);
    case 3:
        return read_face(self);
    case 4:
    case 5:
        return read_group(self);
    case 6:
        return read_material(self);
    case 7:
        return read_library(self);
    case sizeof keywords / sizeof keywords[0]:
        /* A scene may name any file, so error messages do not quote its contents. */
        return aur_mesh_reader_fail(self->reader, "the line begins with no keyword of an OBJ file");
    default:
        return AUR_OK;
    }
}

static aur_result read_all(obj *self) {
    aur_mesh_reader *const reader = self->reader;
    aur_scanner *const scanner = &reader->scanner;
    for (; scanner->at < scanner->end; aur_scan_next_line(scanner)) {
        const aur_result result = aur_scan_line_done(scanner) ? AUR_OK : read_line(self);
        if (result != AUR_OK)
            return result;
        if (*scanner->at == '\0' && scanner->at < scanner->end)
            return aur_mesh_reader_fail(reader, "a zero byte: not an OBJ file");
    }
    for (size_t kind = 0; kind < 3; ++kind)
        if (self->largest[kind] > count_of(self, kind)) {
            scanner->line = self->largest_line[kind];
            return aur_mesh_reader_fail(reader, "index %lu is not a %s: there are %zu",
                                        (unsigned long)self->largest[kind], kind_names[kind],
                                        count_of(self, kind));
        }
    for (size_t i = 0; reader->source->without_normals && i < self->corner_count; ++i)
        self->corners[i].index[NORMAL] = AUR_MESH_NO_INDEX;
    if (reader->source->without_normals)
        self->lists[NORMAL].count = 0;
    return AUR_OK;
}

/* --- vertices from corners */

/* Rearranges texture coordinates or normals from corners to vertices; 0 where a corner has none. */
static bool copy_values(const obj *self, size_t kind, size_t count, const uint32_t *unique, float **values) {
    const number_list *const list = &self->lists[kind];
    if (list->count == 0)
        return true;
    *values = calloc(list->width * count + 1, sizeof **values);
    for (size_t i = 0; *values != NULL && i < count; ++i) {
        const uint32_t index = self->corners[unique[i]].index[kind];
        if (index != AUR_MESH_NO_INDEX)
            memcpy(*values + list->width * i, list->values + list->width * index,
                   list->width * sizeof **values);
    }
    return *values != NULL;
}

/* Each distinct corner becomes a vertex. */
static aur_result split_vertices(obj *self) {
    aur_mesh_reader *const reader = self->reader;
    aur_mesh_data *const data = reader->data;
    uint32_t *numbers = NULL, *unique = NULL;
    size_t count = 0;
    aur_result result = fill_corners(self);
    if (result == AUR_OK)
        result = aur_mesh_reader_merge(reader, self->corner_count, sizeof(corner), self->corners, &numbers,
                                       &unique, &count);
    double *const points = malloc((3 * count + 1) * sizeof *points);
    float *const colors = malloc((3 * count + 1) * sizeof *colors);
    if (result == AUR_OK &&
        (points == NULL || colors == NULL || !copy_values(self, TEXTURE, count, unique, &data->uvs) ||
         !copy_values(self, NORMAL, count, unique, &data->normals)))
        result = aur_fail_memory(reader->error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        const size_t vertex = self->corners[unique[i]].index[VERTEX];
        memcpy(&points[3 * i], &data->points[3 * vertex], 3 * sizeof *points);
        if (self->colors.count > 0)
            memcpy(&colors[3 * i], &self->colors.values[3 * vertex], 3 * sizeof *colors);
    }
    free(data->points);
    free(self->colors.values);
    free(reader->corners);
    free(unique);
    data->points = points;
    data->vertex_count = count;
    self->colors.values = colors;
    reader->corners = numbers;
    return result;
}

/* --- entry point */

static aur_result put_colors(obj *self) {
    aur_mesh_data *const data = self->reader->data;
    if (self->colors.count == 0)
        return AUR_OK;
    data->attributes = calloc(1, sizeof *data->attributes);
    if (data->attributes == NULL)
        return aur_fail_memory(self->reader->error);
    data->attribute_count = 1;
    *data->attributes =
        (aur_mesh_attribute){.name = "vertex_color", .width = 3, .values = self->colors.values};
    self->colors.values = NULL;
    return AUR_OK;
}

aur_result aur_obj_read(aur_mesh_reader *reader) {
    obj self = {.reader = reader,
                .lists = {{.width = 3}, {.width = 2}, {.width = 3}},
                .colors = {.width = 3},
                .span = {.material = AUR_MESH_NO_MATERIAL}};
    aur_result result = read_all(&self);
    /* Without texture coordinates and normals, the file's vertices are used directly. */
    if (result == AUR_OK && (self.lists[TEXTURE].count > 0 || self.lists[NORMAL].count > 0))
        result = split_vertices(&self);
    if (result == AUR_OK)
        result = put_colors(&self);
    for (size_t i = 0; i < 3; ++i)
        free(self.lists[i].values);
    free(self.colors.values);
    free(self.corners);
    return result;
}
