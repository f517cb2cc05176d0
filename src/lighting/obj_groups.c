/* Which group of an OBJ file each triangle belongs to. */
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "core/file.h"
#include "lighting/facets.h"
#include "scene/shapes/text_scanner.h"

typedef struct reader {
    aur_scanner scanner;
    aur_facets *facets;
    size_t facet, group_capacity;
    size_t *lines;
    uint32_t *groups;
    uint32_t group; /* of the faces to come */
} reader;

/* The group of this name, new or known. Files have few groups, most of them in order: the last is tried
 * first. */
static bool find_group(reader *self, size_t length, const char *name) {
    aur_facets *const facets = self->facets;
    for (size_t i = facets->group_count; i-- > 0;)
        if (strlen(facets->names[i]) == length && memcmp(facets->names[i], name, length) == 0) {
            self->group = (uint32_t)i;
            return true;
        }
    if (!aur_array_reserve(&facets->names, &self->group_capacity, facets->group_count + 1,
                           sizeof *facets->names))
        return false;
    char *const copy = strndup(name, length);
    if (copy == NULL)
        return false;
    self->group = (uint32_t)facets->group_count;
    facets->names[facets->group_count++] = copy;
    return true;
}

static bool read_name(reader *self) {
    (void)aur_scan_line_done(&self->scanner);
    const char *const start = self->scanner.at;
    const char *end = start;
    while (*end != '\n' && *end != '\r' && *end != '\0' && *end != '#')
        ++end;
    while (end > start && aur_is_blank(end[-1]))
        --end;
    return end == start ? find_group(self, 7, "default") : find_group(self, (size_t)(end - start), start);
}

/* A polygon of n corners has been made n - 2 triangles. */
static bool read_face(reader *self) {
    if (self->facets->group_count == 0 && !find_group(self, 7, "default"))
        return false;
    size_t corners = 0;
    const size_t line = self->scanner.line;
    while (!aur_scan_line_done(&self->scanner) && aur_scan_word(&self->scanner).length > 0)
        ++corners;
    for (size_t i = 2; i < corners && self->facet < self->facets->source_count; ++i, ++self->facet) {
        self->lines[self->facet] = line;
        self->groups[self->facet] = self->group;
    }
    return true;
}

aur_result aur_obj_groups(const char *path, aur_facets *facets, size_t *lines, uint32_t *groups,
                          aur_error *error) {
    char *data;
    size_t size;
    const aur_result result = aur_file_read(path, (size_t)1 << 35, &data, &size, error);
    if (result != AUR_OK)
        return result;
    reader self = {.scanner = {data, data + size, 1}, .facets = facets, .lines = lines, .groups = groups};
    bool good = true;
    while (good && self.scanner.at < self.scanner.end) {
        const aur_word word =
            aur_scan_line_done(&self.scanner) ? (aur_word){0} : aur_scan_word(&self.scanner);
        if (aur_word_is(word, "g") || aur_word_is(word, "o"))
            good = read_name(&self);
        else if (aur_word_is(word, "f"))
            good = read_face(&self);
        aur_scan_next_line(&self.scanner);
    }
    free(data);
    if (!good)
        return aur_fail_memory(error);
    if (self.facet != facets->source_count)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                           "the file has changed while it was read");
    return AUR_OK;
}
