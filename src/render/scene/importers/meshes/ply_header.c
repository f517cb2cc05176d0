#include "render/scene/importers/meshes/ply.h"

#include <string.h>

/* Each type has two names. */
static const char *const type_names[] = {"char",   "int8",    "uchar",  "uint8",  "short", "int16",
                                         "ushort", "uint16",  "int",    "int32",  "uint",  "uint32",
                                         "float",  "float32", "double", "float64"};

static const struct {
    const char *name;
    aur_ply_role role;
} roles[] = {{"x", AUR_PLY_X},
             {"y", AUR_PLY_Y},
             {"z", AUR_PLY_Z},
             {"nx", AUR_PLY_NX},
             {"ny", AUR_PLY_NY},
             {"nz", AUR_PLY_NZ},
             {"u", AUR_PLY_U},
             {"v", AUR_PLY_V},
             {"s", AUR_PLY_U},
             {"t", AUR_PLY_V},
             {"texture_u", AUR_PLY_U},
             {"texture_v", AUR_PLY_V},
             {"vertex_indices", AUR_PLY_INDICES},
             {"vertex_index", AUR_PLY_INDICES}};

static bool find_type(aur_word word, aur_ply_type *type) {
    *type = (aur_ply_type)(aur_word_find(word, 2 * AUR_PLY_TYPE_COUNT, type_names) / 2);
    return *type < AUR_PLY_TYPE_COUNT;
}

static aur_result fail_header(const aur_ply *self, const char *what) {
    return aur_mesh_reader_fail(self->reader, "PLY header: %s", what);
}

static aur_result read_format(aur_ply *self) {
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const size_t format = aur_word_find(aur_scan_word(&self->reader->scanner), 3, formats);
    if (format == 3)
        return fail_header(self, "the format must be ascii, binary_little_endian or binary_big_endian");
    self->format = (aur_ply_format)format;
    return aur_word_is(aur_scan_word(&self->reader->scanner), "1.0")
               ? AUR_OK
               : fail_header(self, "the version must be 1.0");
}

static aur_result read_element(aur_ply *self) {
    if (self->element_count == AUR_PLY_MOST_ELEMENTS)
        return fail_header(self, "too many elements");
    aur_ply_element *const element = &self->elements[self->element_count++];
    aur_scanner *const scanner = &self->reader->scanner;
    const aur_word word = aur_scan_word(scanner);
    int64_t count;
    if (word.length == 0 || word.length >= sizeof element->name || !aur_scan_integer(scanner, &count) ||
        count < 0 || !aur_scan_line_done(scanner))
        return fail_header(self, "an element needs a name and a count");
    memcpy(element->name, word.text, word.length);
    element->count = (size_t)count;
    if (self->vertices == NULL && aur_word_is(word, "vertex"))
        self->vertices = element;
    return AUR_OK;
}

static aur_result read_property(aur_ply *self) {
    if (self->element_count == 0)
        return fail_header(self, "a property before any element");
    aur_ply_element *const element = &self->elements[self->element_count - 1];
    if (element->property_count == AUR_PLY_MOST_PROPERTIES)
        return fail_header(self, "too many properties");
    aur_ply_property *const property = &element->properties[element->property_count++];
    aur_scanner *const scanner = &self->reader->scanner;
    aur_word word = aur_scan_word(scanner);
    property->list = aur_word_is(word, "list");
    if (property->list) {
        if (!find_type(aur_scan_word(scanner), &property->count_type) ||
            property->count_type >= AUR_PLY_FLOAT)
            return fail_header(self, "the count of a list needs a whole type such as uchar");
        word = aur_scan_word(scanner);
    }
    if (!find_type(word, &property->type))
        return fail_header(self, "a property needs a type such as float, int or uchar");
    word = aur_scan_word(scanner);
    if (word.length == 0)
        return fail_header(self, "a property needs a name");
    memcpy(property->name, word.text, word.length < sizeof property->name ? word.length : 0);
    property->role = AUR_PLY_OTHER;
    for (size_t i = 0; i < sizeof roles / sizeof roles[0]; ++i) {
        const bool fits =
            roles[i].role == AUR_PLY_INDICES
                ? property->list && property->type < AUR_PLY_FLOAT && strcmp(element->name, "face") == 0
                : !property->list && element == self->vertices;
        if (fits && !self->has[roles[i].role] && aur_word_is(word, roles[i].name))
            property->role = roles[i].role;
    }
    if (property->role == AUR_PLY_INDICES)
        self->faces = element;
    self->has[property->role] = true;
    return AUR_OK;
}

/* Offset after the last line end of the header. If that is a lone carriage return, a following line feed
 * belongs to the binary data. */
static void end_header(aur_scanner *scanner, bool returns_alone) {
    while (scanner->at < scanner->end && !aur_is_line_end(*scanner->at))
        ++scanner->at;
    if (returns_alone && scanner->at < scanner->end) {
        ++scanner->at;
        ++scanner->line;
    } else {
        aur_scan_next_line(scanner);
    }
}

static aur_result read_line(aur_ply *self, bool *has_format, bool *done) {
    static const char *const words[] = {"end_header", "format",   "element", "property",
                                        "comment",    "obj_info", ""};
    switch (aur_word_find(aur_scan_word(&self->reader->scanner), sizeof words / sizeof words[0], words)) {
    case 0:
        *done = true;
        return AUR_OK;
    case 1:
        *has_format = true;
        return read_format(self);
    case 2:
        return read_element(self);
    case 3:
        return read_property(self);
    case 4:
    case 5:
    case 6:
        return AUR_OK;
    default:
        return fail_header(self, "a line must begin with format, element, property, comment or end_header");
    }
}

aur_result aur_ply_read_header(aur_ply *self) {
    aur_scanner *const scanner = &self->reader->scanner;
    if (!aur_word_is(aur_scan_word(scanner), "ply"))
        return fail_header(self, "the file must begin with 'ply'");
    aur_scan_blanks(scanner);
    const bool returns_alone = scanner->at[0] == '\r' && scanner->at[1] != '\n';
    bool has_format = false;
    for (bool done = false; !done;) {
        aur_scan_next_line(scanner);
        if (scanner->at >= scanner->end)
            return fail_header(self, "'end_header' is missing");
        const aur_result result = read_line(self, &has_format, &done);
        if (result != AUR_OK)
            return result;
    }
    if (!has_format)
        return fail_header(self, "the format is missing");
    if (!self->has[AUR_PLY_X] || !self->has[AUR_PLY_Y] || !self->has[AUR_PLY_Z])
        return fail_header(self, "element vertex needs the properties x, y and z");
    if (!self->has[AUR_PLY_INDICES])
        return fail_header(self, "element face needs the list vertex_indices");
    end_header(scanner, returns_alone);
    return AUR_OK;
}
