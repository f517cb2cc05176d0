/* STL, ascii and binary. Facet normals are ignored: the winding determines them. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "render/scene/importers/meshes/mesh_reader.h"

static aur_result add_corner(aur_mesh_reader *reader, const double point[3]) {
    const aur_result result = aur_mesh_reader_add_vertex(reader, point);
    return result == AUR_OK ? aur_mesh_reader_add_corner(reader, (uint32_t)reader->data->vertex_count - 1)
                            : result;
}

/* --- binary */

static double read_float(const char *at) {
    const unsigned char *const b = (const unsigned char *)at;
    const uint32_t bits = b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* Some writers leave the count 0 or all ones: the file size then determines it. */
static aur_result read_binary(aur_mesh_reader *reader) {
    const aur_mesh_source *const source = reader->source;
    reader->scanner.line = 0;
    reader->scanner.at = source->data;
    if (source->size < AUR_STL_HEAD)
        return aur_mesh_reader_fail(reader, "the file is neither ascii STL nor long enough for binary STL");
    const size_t there = (source->size - AUR_STL_HEAD) / AUR_STL_FACET;
    size_t count = aur_stl_count(source->data);
    if (count == 0 || count == UINT32_MAX)
        count = there;
    reader->scanner.at = source->data + 80;
    if (count > there)
        return aur_mesh_reader_fail(reader, "the header counts %zu facets, and there are bytes for %zu",
                                    count, there);
    reader->scanner.at = source->data + AUR_STL_HEAD;
    for (size_t i = 0; i < count; ++i, reader->scanner.at += AUR_STL_FACET) {
        aur_result result = AUR_OK;
        for (size_t c = 0; c < 3 && result == AUR_OK; ++c) {
            double point[3];
            for (size_t d = 0; d < 3; ++d)
                point[d] = read_float(reader->scanner.at + 12 + 12 * c + 4 * d);
            result = add_corner(reader, point);
        }
        if (result == AUR_OK)
            result = aur_mesh_reader_end_face(reader, 0);
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

/* --- ascii */

static bool is_word(aur_word word, const char *name) {
    return word.length == strlen(name) && strncasecmp(word.text, name, word.length) == 0;
}

static aur_result read_vertex(aur_mesh_reader *reader) {
    double point[3];
    for (size_t d = 0; d < 3; ++d)
        if (!aur_scan_double(&reader->scanner, &point[d]))
            return aur_mesh_reader_fail(reader, "expected three numbers after 'vertex'");
    return add_corner(reader, point);
}

static aur_result read_line(aur_mesh_reader *reader, size_t *facet_line, size_t *corners) {
    static const char *const skipped[] = {"solid", "endsolid", "outer", "endfacet"};
    const aur_word word = aur_scan_word(&reader->scanner);
    if (is_word(word, "facet")) {
        *facet_line = reader->scanner.line;
        *corners = 0;
        return AUR_OK;
    }
    if (is_word(word, "vertex")) {
        ++*corners;
        return read_vertex(reader);
    }
    if (is_word(word, "endloop")) {
        if (*corners < 3)
            return aur_mesh_reader_fail(reader, "a facet of %zu corners: expected 3", *corners);
        return aur_mesh_reader_end_face(reader, *facet_line);
    }
    for (size_t i = 0; i < sizeof skipped / sizeof skipped[0]; ++i)
        if (is_word(word, skipped[i]))
            return AUR_OK;
    return aur_mesh_reader_fail(reader, "the line begins with no keyword of an STL file");
}

static aur_result read_ascii(aur_mesh_reader *reader) {
    aur_scanner *const scanner = &reader->scanner;
    size_t facet_line = 1, corners = 0;
    for (; scanner->at < scanner->end; aur_scan_next_line(scanner)) {
        const aur_result result =
            aur_scan_line_done(scanner) ? AUR_OK : read_line(reader, &facet_line, &corners);
        if (result != AUR_OK)
            return result;
    }
    return reader->corner_count == (reader->data->face_count > 0
                                        ? aur_mesh_reader_end(reader, reader->data->face_count - 1)
                                        : 0)
               ? AUR_OK
               : aur_mesh_reader_fail(reader, "the file ends within a facet");
}

/* --- entry point */

/* Merges corners with equal coordinates into one vertex. */
static aur_result merge_vertices(aur_mesh_reader *reader) {
    aur_mesh_data *const data = reader->data;
    for (size_t i = 0; i < 3 * data->vertex_count; ++i)
        data->points[i] += 0.0; /* -0 is 0 */
    uint32_t *numbers = NULL, *unique = NULL;
    size_t count = 0;
    const aur_result result = aur_mesh_reader_merge(reader, data->vertex_count, 3 * sizeof *data->points,
                                                    data->points, &numbers, &unique, &count);
    for (size_t i = 0; i < reader->corner_count && result == AUR_OK; ++i)
        reader->corners[i] = numbers[reader->corners[i]];
    for (size_t i = 0; i < count;
         ++i) /* in ascending order, so that no corner is overwritten before it is copied */
        memmove(&data->points[3 * i], &data->points[3 * (size_t)unique[i]], 3 * sizeof *data->points);
    data->vertex_count = count;
    free(numbers);
    free(unique);
    return result;
}

aur_result aur_stl_read(aur_mesh_reader *reader) {
    const aur_mesh_source *const source = reader->source;
    /* Binary files may begin with "solid" too. */
    const bool ascii = aur_mesh_format_of_bytes(source->size, source->data) == AUR_MESH_STL &&
                       !(source->size >= AUR_STL_HEAD &&
                         source->size == AUR_STL_HEAD + AUR_STL_FACET * (size_t)aur_stl_count(source->data));
    const aur_result result = ascii ? read_ascii(reader) : read_binary(reader);
    return result == AUR_OK ? merge_vertices(reader) : result;
}
