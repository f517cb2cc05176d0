#include "scene/shapes/ply.h"

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
             {"r", AUR_PLY_RED},
             {"g", AUR_PLY_GREEN},
             {"b", AUR_PLY_BLUE},
             {"red", AUR_PLY_RED},
             {"green", AUR_PLY_GREEN},
             {"blue", AUR_PLY_BLUE},
             {"r", AUR_PLY_FACE_RED},
             {"g", AUR_PLY_FACE_GREEN},
             {"b", AUR_PLY_FACE_BLUE},
             {"red", AUR_PLY_FACE_RED},
             {"green", AUR_PLY_FACE_GREEN},
             {"blue", AUR_PLY_FACE_BLUE},
             {"vertex_indices", AUR_PLY_INDICES},
             {"vertex_index", AUR_PLY_INDICES}};

static bool find_type(aur_word word, aur_ply_type *type) {
    *type = (aur_ply_type)(aur_word_find(word, 2 * AUR_PLY_TYPE_COUNT, type_names) / 2);
    return *type < AUR_PLY_TYPE_COUNT;
}

static aur_result fail_header(const aur_ply *self, const char *what) {
    return aur_mesh_file_fail(self->file, "PLY header: %s", what);
}

static aur_result read_format(aur_ply *self) {
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const size_t format = aur_word_find(aur_scan_word(&self->file->scanner), 3, formats);
    if (format == 3)
        return fail_header(self, "the format must be ascii, binary_little_endian or binary_big_endian");
    self->format = (aur_ply_format)format;
    return aur_word_is(aur_scan_word(&self->file->scanner), "1.0")
               ? AUR_OK
               : fail_header(self, "the version must be 1.0");
}

static aur_result read_element(aur_ply *self) {
    if (self->element_count == AUR_PLY_MOST_ELEMENTS)
        return fail_header(self, "too many elements");
    aur_ply_element *const element = &self->elements[self->element_count++];
    aur_scanner *const scanner = &self->file->scanner;
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
    aur_scanner *const scanner = &self->file->scanner;
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
    property->role = AUR_PLY_LEFT_OUT;
    for (size_t i = 0; i < sizeof roles / sizeof roles[0]; ++i) {
        const bool of_face = roles[i].role >= AUR_PLY_FACE_RED;
        const bool fits = (roles[i].role == AUR_PLY_INDICES ? property->list && property->type < AUR_PLY_FLOAT
                                                            : !property->list) &&
                          (of_face ? strcmp(element->name, "face") == 0 : element == self->vertices);
        if (fits && aur_word_is(word, roles[i].name))
            property->role = roles[i].role;
    }
    self->has[property->role] = true;
    return AUR_OK;
}

aur_result aur_ply_read_header(aur_ply *self) {
    aur_scanner *const scanner = &self->file->scanner;
    if (!aur_word_is(aur_scan_word(scanner), "ply"))
        return fail_header(self, "the file must begin with 'ply'");
    bool has_format = false;
    for (bool done = false; !done;) {
        static const char *const words[] = {"end_header", "format",   "element", "property",
                                            "comment",    "obj_info", ""};
        aur_scan_next_line(scanner);
        if (scanner->at >= scanner->end)
            return fail_header(self, "'end_header' is missing");
        const size_t which = aur_word_find(aur_scan_word(scanner), sizeof words / sizeof words[0], words);
        done = which == 0;
        has_format = has_format || which == 1;
        const aur_result result = which == 1   ? read_format(self)
                                  : which == 2 ? read_element(self)
                                  : which == 3 ? read_property(self)
                                  : which < 7
                                      ? AUR_OK
                                      : fail_header(self, "a line must begin with format, element, property, "
                                                          "comment or end_header");
        if (result != AUR_OK)
            return result;
    }
    if (!has_format)
        return fail_header(self, "the format is missing");
    if (!self->has[AUR_PLY_X] || !self->has[AUR_PLY_Y] || !self->has[AUR_PLY_Z])
        return fail_header(self, "element vertex needs the properties x, y and z");
    if (!self->has[AUR_PLY_INDICES])
        return fail_header(self, "element face needs the list vertex_indices");
    aur_scan_next_line(scanner);
    return AUR_OK;
}
