#include "scene/rad/rad.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "core/names.h"
#include "core/text.h"
#include "core/vector3d.h"

bool aur_rad_is_name(const char *path) {
    const size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".rad") == 0;
}

/* A piece of the text. */
typedef struct rad_word {
    const char *text;
    size_t length, line;
} rad_word;

/* Radiance (Ward): `modifier type identifier`, then counted strings, integers and numbers. */
typedef struct primitive {
    rad_word modifier, type, name;
    const struct rad_type *row;
    size_t string_count, number_count;
    rad_word *strings; /* into the reader's words */
    double *numbers;   /* into the reader's numbers */
} primitive;

/* A material under its name; a later one of the same name hides it. */
typedef struct rad_material {
    rad_word name;
    const struct rad_type *row;
    size_t id; /* m0, m1, ... of the XML */
    double radiance[3];
} rad_material;

typedef struct reader {
    const char *path, *at, *end;
    size_t line;
    rad_word *words;
    double *numbers;
    size_t word_capacity, number_capacity;
    rad_material *materials;
    size_t material_count, material_capacity, bsdf_count;
    char *xml;
    size_t xml_size, xml_capacity, xml_line;
    aur_error *error;
} reader;

typedef struct rad_type {
    const char *name;
    size_t least, most; /* numbers */
    bool material, emits;
    aur_result (*write)(reader *self, const primitive *item, const rad_material *material);
} rad_type;

/* --- messages and output */

static aur_result fail(const reader *self, size_t line, aur_result result, const char *format, ...)
    AUR_PRINTF(4, 5);

static aur_result fail(const reader *self, size_t line, aur_result result, const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return aur_fail_at(self->error, (aur_location){self->path, line, 0}, result, "%s", text);
}

static bool append(reader *self, size_t length, const char *text) {
    if (!aur_array_reserve(&self->xml, &self->xml_capacity, self->xml_size + length + 1, 1))
        return false;
    memcpy(self->xml + self->xml_size, text, length);
    self->xml_size += length;
    return true;
}

static aur_result put(reader *self, const char *format, ...) AUR_PRINTF(2, 3);

static aur_result put(reader *self, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    const int length = aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return length >= 0 && (size_t)length < sizeof text && append(self, (size_t)length, text)
               ? AUR_OK
               : aur_fail_memory(self->error);
}

static aur_result put_numbers(reader *self, size_t count, const double *numbers) {
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = put(self, i == 0 ? "%.17g" : " %.17g", numbers[i]);
    return result;
}

/* A file's name as an attribute, in which `$` would be a variable. */
static aur_result put_file_name(reader *self, rad_word name) {
    aur_result result = AUR_OK;
    for (size_t i = 0; i < name.length && result == AUR_OK; ++i) {
        const char c = name.text[i];
        if (c == '$' || c == '\\')
            result = put(self, "\\%c", c);
        else if (strchr("<>&\"'", c) != NULL || (unsigned char)c < ' ')
            result = put(self, "&#%d;", (int)(unsigned char)c);
        else
            result = put(self, "%c", c);
    }
    return result;
}

/* --- surfaces */

/* What a surface is made of, and its end. */
static aur_result put_end(reader *self, const rad_material *material) {
    if (!material->row->emits)
        return put(self, "<ref id=\"m%zu\"/></shape>", material->id);
    const double *const l = material->radiance;
    return put(
        self, "<emitter type=\"area\"><rgb name=\"radiance\" value=\"%.17g %.17g %.17g\"/></emitter></shape>",
        l[0], l[1], l[2]);
}

static aur_result write_polygon(reader *self, const primitive *item, const rad_material *material) {
    if (item->number_count % 3 != 0)
        return fail(self, item->type.line, AUR_ERROR_FORMAT,
                    "polygon: %zu numbers are no corners of three coordinates", item->number_count);
    aur_result result = put(self, "<shape type=\"polygon\"><string name=\"vertices\" value=\"");
    if (result == AUR_OK)
        result = put_numbers(self, item->number_count, item->numbers);
    if (result == AUR_OK)
        result = put(self, "\"/>");
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_round(reader *self, const primitive *item, const rad_material *material) {
    const double *const x = item->numbers;
    const bool sphere = item->number_count == 4;
    const bool inwards = item->type.text[0] == 'b' || item->type.text[0] == 't';
    /* A negative radius turns the surface, too. */
    const double radius = x[sphere ? 3 : 6];
    aur_result result =
        sphere ? put(self, "<shape type=\"sphere\"><point name=\"center\" value=\"%.17g %.17g %.17g\"/>",
                     x[0], x[1], x[2])
               : put(self,
                     "<shape type=\"cylinder\"><point name=\"p0\" value=\"%.17g %.17g %.17g\"/>"
                     "<point name=\"p1\" value=\"%.17g %.17g %.17g\"/>",
                     x[0], x[1], x[2], x[3], x[4], x[5]);
    if (result == AUR_OK)
        result =
            put(self, "<float name=\"radius\" value=\"%.17g\"/><boolean name=\"flip_normals\" value=\"%s\"/>",
                fabs(radius), inwards != (radius < 0.0) ? "true" : "false");
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_ring(reader *self, const primitive *item, const rad_material *material) {
    const double *const x = item->numbers;
    const double inner = fmin(x[6], x[7]), outer = fmax(x[6], x[7]);
    double axis[3] = {x[3], x[4], x[5]}, up[3], side[3];
    if (!(inner >= 0.0) || !(inner < outer) || !(aur_normalize3(axis) > 0.0))
        return fail(self, item->type.line, AUR_ERROR_FORMAT,
                    "ring: it needs a direction and two different radii, none below 0");
    aur_frame3(axis, up, side);
    const aur_result result =
        put(self,
            "<shape type=\"disk\"><float name=\"inner_radius\" value=\"%.17g\"/><transform name=\"to_world\">"
            "<scale value=\"%.17g\"/><matrix value=\"%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g "
            "%.17g %.17g %.17g 0 0 0 1\"/></transform>",
            inner / outer, outer, up[0], side[0], axis[0], x[0], up[1], side[1], axis[1], x[1], up[2],
            side[2], axis[2], x[2]);
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_mesh(reader *self, const primitive *item, const rad_material *material) {
    const rad_word file = item->string_count > 0 ? item->strings[0] : (rad_word){"", 0, item->type.line};
    if (file.length < 5 || strncmp(file.text + file.length - 4, ".obj", 4) != 0)
        return fail(self, file.line, AUR_ERROR_UNSUPPORTED,
                    "mesh: '%.*s' is compiled for Radiance; name the OBJ file that it was made from",
                    (int)file.length, file.text);
    if (item->string_count > 1)
        return fail(self, item->strings[1].line, AUR_ERROR_UNSUPPORTED,
                    "mesh: the transform '%.*s ...' is not read; put it into the OBJ file",
                    (int)item->strings[1].length, item->strings[1].text);
    aur_result result = put(self, "<shape type=\"obj\"><string name=\"filename\" value=\"");
    if (result == AUR_OK)
        result = put_file_name(self, file);
    if (result == AUR_OK)
        result = put(self, "\"/>");
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_source(reader *self, const primitive *item, const rad_material *material) {
    const double *const x = item->numbers, *const l = material->radiance;
    if (!material->row->emits)
        return fail(self, item->modifier.line, AUR_ERROR_UNSUPPORTED,
                    "source: its material must be a light or a glow");
    if (!(x[3] >= 0.02) || x[3] > 360.0)
        return fail(self, item->type.line, AUR_ERROR_FORMAT,
                    "source: its angle must be from 0.02 to 360 degrees, not %g", x[3]);
    return put(
        self,
        "<emitter type=\"sun\"><float name=\"half_angle\" value=\"%.17g\"/><vector "
        "name=\"sun_direction\" value=\"%.17g %.17g %.17g\"/><rgb name=\"radiance\" value=\"%.17g %.17g "
        "%.17g\"/></emitter>",
        0.5 * x[3], x[0], x[1], x[2], l[0], l[1], l[2]);
}

/* --- materials */

static aur_result write_diffuse(reader *self, const primitive *item, const rad_material *material) {
    const double *const x = item->numbers;
    if (x[3] != 0.0)
        return fail(self, item->type.line, AUR_ERROR_UNSUPPORTED,
                    "%.*s: a specularity of %g is not read: Radiance's model of it is none of ours; 0 is "
                    "exact",
                    (int)item->type.length, item->type.text, x[3]);
    return put(self,
               "<bsdf type=\"twosided\" id=\"m%zu\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
               "value=\"%.17g %.17g %.17g\"/></bsdf></bsdf>",
               material->id, x[0], x[1], x[2]);
}

static aur_result write_glass(reader *self, const primitive *item, const rad_material *material) {
    const double *const x = item->numbers;
    return put(self,
               "<bsdf type=\"glass\" id=\"m%zu\"><float name=\"int_ior\" value=\"%.17g\"/><float "
               "name=\"ext_ior\" value=\"1\"/><rgb "
               "name=\"transmissivity\" value=\"%.17g %.17g %.17g\"/></bsdf>",
               material->id, item->number_count > 3 ? x[3] : 1.52, x[0], x[1], x[2]);
}

static aur_result check_light(reader *self, const primitive *item, const rad_material *material) {
    (void)material;
    const double *const x = item->numbers;
    if (x[0] < 0.0 || x[1] < 0.0 || x[2] < 0.0)
        return fail(self, item->type.line, AUR_ERROR_FORMAT, "%.*s: radiance must not be below 0",
                    (int)item->type.length, item->type.text);
    if (item->number_count > 3 && x[3] < 0.0)
        return fail(self, item->type.line, AUR_ERROR_UNSUPPORTED,
                    "glow: a radius below 0, light that is seen and lights nothing, is not read");
    return AUR_OK;
}

static const rad_type types[] = {
    {"polygon", 9, SIZE_MAX, false, false, write_polygon},
    {"sphere", 4, 4, false, false, write_round},
    {"bubble", 4, 4, false, false, write_round},
    {"cylinder", 7, 7, false, false, write_round},
    {"tube", 7, 7, false, false, write_round},
    {"ring", 8, 8, false, false, write_ring},
    {"mesh", 0, 0, false, false, write_mesh},
    {"source", 4, 4, false, false, write_source},
    {"plastic", 5, 5, true, false, write_diffuse},
    {"metal", 5, 5, true, false, write_diffuse},
    {"glass", 3, 4, true, false, write_glass},
    {"light", 3, 3, true, true, check_light},
    {"glow", 4, 4, true, true, check_light},
};
enum { TYPES = sizeof types / sizeof types[0] };

static const char *type_name(const void *list, size_t index) {
    return ((const rad_type *)list)[index].name;
}

/* --- reading */

static bool is_word(rad_word word, const char *text) {
    return strlen(text) == word.length && memcmp(word.text, text, word.length) == 0;
}

/* Skips blanks, line ends and comments; false at the end. */
static bool next_word(reader *self, rad_word *word) {
    for (; self->at < self->end; ++self->at) {
        if (*self->at == '#')
            while (self->at + 1 < self->end && self->at[1] != '\n')
                ++self->at;
        else if (*self->at == '\n')
            ++self->line;
        else if (!aur_is_space(*self->at))
            break;
    }
    *word = (rad_word){self->at, 0, self->line};
    while (self->at < self->end && !aur_is_space(*self->at))
        ++self->at;
    word->length = (size_t)(self->at - word->text);
    return word->length > 0;
}

static aur_result fail_end(const reader *self, const char *what, rad_word word) {
    return word.length == 0
               ? fail(self, word.line, AUR_ERROR_FORMAT, "the file ends where %s must stand", what)
               : fail(self, word.line, AUR_ERROR_FORMAT, "%s must stand here, not '%.*s'", what,
                      word.length > 40 ? 40 : (int)word.length, word.text);
}

static aur_result read_count(reader *self, const char *what, size_t *count) {
    rad_word word;
    uint64_t value = 0;
    next_word(self, &word);
    /* There cannot be more words than bytes. */
    const char *const after =
        word.length > 0 ? aur_read_integer(word.text, (uint64_t)(self->end - word.text), &value) : NULL;
    if (after != word.text + word.length)
        return fail_end(self, what, word);
    *count = (size_t)value;
    return AUR_OK;
}

static aur_result read_arguments(reader *self, primitive *item) {
    size_t integers;
    aur_result result = read_count(self, "the number of strings", &item->string_count);
    if (result != AUR_OK)
        return result;
    if (!aur_array_reserve(&self->words, &self->word_capacity, item->string_count + 1, sizeof *self->words))
        return aur_fail_memory(self->error);
    for (size_t i = 0; i < item->string_count; ++i)
        if (!next_word(self, &self->words[i]))
            return fail_end(self, "a string", self->words[i]);
    result = read_count(self, "0, the number of integers,", &integers);
    if (result == AUR_OK && integers != 0)
        return fail(self, self->line, AUR_ERROR_UNSUPPORTED, "%.*s: integers are not read",
                    (int)item->type.length, item->type.text);
    if (result == AUR_OK)
        result = read_count(self, "the number of numbers", &item->number_count);
    if (result != AUR_OK)
        return result;
    if (!aur_array_reserve(&self->numbers, &self->number_capacity, item->number_count + 1,
                           sizeof *self->numbers))
        return aur_fail_memory(self->error);
    for (size_t i = 0; i < item->number_count; ++i) {
        rad_word word;
        if (!next_word(self, &word) ||
            aur_read_double(word.text, AUR_NUMBER_FINITE, &self->numbers[i]) != word.text + word.length)
            return fail_end(self, "a number", word);
    }
    item->strings = self->words;
    item->numbers = self->numbers;
    return AUR_OK;
}

static const rad_material *find_material(const reader *self, rad_word name) {
    for (size_t i = self->material_count; i-- > 0;)
        if (self->materials[i].name.length == name.length &&
            memcmp(self->materials[i].name.text, name.text, name.length) == 0)
            return &self->materials[i];
    return NULL;
}

static aur_result find_modifier(const reader *self, rad_word name, const rad_material **found) {
    *found = find_material(self, name);
    if (*found != NULL)
        return AUR_OK;
    return is_word(name, "void")
               ? fail(self, name.line, AUR_ERROR_UNSUPPORTED, "a surface needs a material, not 'void'")
               : fail(self, name.line, AUR_ERROR_NAME, "there is no material '%.*s' above", (int)name.length,
                      name.text);
}

static aur_result need_void(const reader *self, const primitive *item) {
    return is_word(item->modifier, "void")
               ? AUR_OK
               : fail(self, item->modifier.line, AUR_ERROR_UNSUPPORTED,
                      "%.*s: patterns, textures and mixtures are not read: its modifier must be 'void', not "
                      "'%.*s'",
                      (int)item->type.length, item->type.text, (int)item->modifier.length,
                      item->modifier.text);
}

static aur_result add_material(reader *self, rad_material material) {
    if (!aur_array_reserve(&self->materials, &self->material_capacity, self->material_count + 1,
                           sizeof *self->materials))
        return aur_fail_memory(self->error);
    self->materials[self->material_count++] = material;
    return AUR_OK;
}

/* `void alias NAME KNOWN`: another name. */
static aur_result read_alias(reader *self, const primitive *item) {
    rad_word known;
    const rad_material *material;
    aur_result result = need_void(self, item);
    if (result == AUR_OK && !next_word(self, &known))
        result = fail_end(self, "the name of a material", known);
    if (result == AUR_OK)
        result = find_modifier(self, known, &material);
    if (result != AUR_OK)
        return result;
    rad_material copy = *material;
    copy.name = item->name;
    return add_material(self, copy);
}

static aur_result read_material(reader *self, const primitive *item) {
    aur_result result = need_void(self, item);
    if (result != AUR_OK)
        return result;
    rad_material material = {.name = item->name, .row = item->row, .id = self->bsdf_count++};
    for (size_t i = 0; i < 3; ++i)
        material.radiance[i] = item->numbers[i];
    result = item->row->write(self, item, &material);
    return result == AUR_OK ? add_material(self, material) : result;
}

static aur_result fail_type(const reader *self, rad_word type) {
    char name[64], hint[AUR_HINT_CAPACITY];
    const size_t length = type.length < sizeof name ? type.length : sizeof name - 1;
    memcpy(name, type.text, length);
    name[length] = '\0';
    aur_names_hint((aur_names){TYPES, type_name, types}, name, "''", hint);
    return fail(self, type.line, AUR_ERROR_UNSUPPORTED, "'%s' is not read%s", name, hint);
}

static aur_result read_primitive(reader *self, rad_word modifier) {
    primitive item = {.modifier = modifier};
    if (modifier.text[0] == '!')
        return fail(self, modifier.line, AUR_ERROR_UNSUPPORTED,
                    "commands are not run; write their output into the file (Radiance's xform does)");
    if (!next_word(self, &item.type))
        return fail_end(self, "a type", item.type);
    if (!next_word(self, &item.name))
        return fail_end(self, "a name", item.name);
    if (is_word(item.type, "alias"))
        return read_alias(self, &item);
    for (size_t i = 0; i < TYPES && item.row == NULL; ++i)
        if (is_word(item.type, types[i].name))
            item.row = &types[i];
    if (item.row == NULL)
        return fail_type(self, item.type);
    aur_result result = read_arguments(self, &item);
    if (result != AUR_OK)
        return result;
    if (item.number_count < item.row->least || item.number_count > item.row->most)
        return fail(self, item.type.line, AUR_ERROR_FORMAT, "%s takes %zu numbers%s, not %zu", item.row->name,
                    item.row->least, item.row->most > item.row->least ? " or more" : "", item.number_count);
    if (item.string_count > 0 && item.row->write != write_mesh)
        return fail(self, item.strings[0].line, AUR_ERROR_UNSUPPORTED, "%s takes no strings", item.row->name);
    /* The XML stands on the same line. */
    for (; result == AUR_OK && self->xml_line < modifier.line; ++self->xml_line)
        result = put(self, "\n");
    if (result != AUR_OK)
        return result;
    if (item.row->material)
        return read_material(self, &item);
    const rad_material *material;
    result = find_modifier(self, modifier, &material);
    return result == AUR_OK ? item.row->write(self, &item, material) : result;
}

aur_result aur_rad_to_xml(const char *path, size_t size, const char *data, char **xml, size_t *xml_size,
                          aur_error *error) {
    /* With a zero byte after it, at which numbers end. */
    char *const text = malloc(size + 1);
    if (text == NULL)
        return aur_fail_memory(error);
    memcpy(text, data, size);
    text[size] = '\0';
    reader self = {.path = path, .at = text, .end = text + size, .line = 1, .xml_line = 1, .error = error};
    aur_result result = put(&self, "<scene version=\"3.0.0\">");
    rad_word word;
    while (result == AUR_OK && next_word(&self, &word))
        result = read_primitive(&self, word);
    if (result == AUR_OK)
        result = put(&self, "</scene>");
    free(text);
    free(self.words);
    free(self.numbers);
    free(self.materials);
    *xml = self.xml;
    *xml_size = self.xml_size;
    if (result != AUR_OK) {
        free(self.xml);
        *xml = NULL;
    }
    return result;
}
