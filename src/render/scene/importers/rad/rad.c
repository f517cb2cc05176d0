#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/names.h"
#include "points/base/text.h"
#include "render/scene/importers/rad/rad_reader.h"

bool aur_rad_is_name(const char *path) {
    const size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".rad") == 0;
}

static const char *row_name(const void *list, size_t index) {
    return ((const aur_rad_row *)list)[index].name;
}

/* --- reading */

static aur_result read_count(aur_rad *self, const char *what, size_t *count) {
    aur_rad_word word;
    uint64_t value = 0;
    aur_rad_next_word(self, &word);
    /* There cannot be more words than bytes. */
    const char *const after =
        word.length > 0 ? aur_read_integer(word.text, (uint64_t)(self->end - word.text), &value) : NULL;
    if (after != word.text + word.length)
        return aur_rad_fail_end(self, what, word);
    *count = (size_t)value;
    return AUR_OK;
}

static aur_result read_arguments(aur_rad *self, aur_rad_primitive *item) {
    size_t integers = 0;
    aur_result result = read_count(self, "the number of strings", &item->string_count);
    if (result != AUR_OK)
        return result;
    if (!aur_array_reserve(&self->words, &self->word_capacity, item->string_count + 1, sizeof *self->words))
        return aur_fail_memory(self->error);
    for (size_t i = 0; i < item->string_count; ++i)
        if (!aur_rad_next_word(self, &self->words[i]))
            return aur_rad_fail_end(self, "a string", self->words[i]);
    result = read_count(self, "0, the number of integers,", &integers);
    if (result == AUR_OK && integers != 0)
        return aur_rad_fail(self, self->line, AUR_ERROR_UNSUPPORTED, "%.*s: integers are not read",
                            (int)item->type.length, item->type.text);
    if (result == AUR_OK)
        result = read_count(self, "the number of numbers", &item->number_count);
    if (result != AUR_OK)
        return result;
    if (!aur_array_reserve(&self->numbers, &self->number_capacity, item->number_count + 1,
                           sizeof *self->numbers))
        return aur_fail_memory(self->error);
    for (size_t i = 0; i < item->number_count; ++i) {
        aur_rad_word word;
        if (!aur_rad_next_word(self, &word) ||
            aur_read_double(word.text, AUR_NUMBER_FINITE, &self->numbers[i]) != word.text + word.length)
            return aur_rad_fail_end(self, "a number", word);
    }
    item->strings = self->words;
    item->numbers = self->numbers;
    return AUR_OK;
}

static aur_rad_material *find_material(const aur_rad *self, aur_rad_word name) {
    aur_rad_material *const materials = self->scene->materials;
    for (size_t i = self->scene->material_count; i-- > 0;)
        if (materials[i].name.length == name.length &&
            memcmp(materials[i].name.text, name.text, name.length) == 0)
            return &materials[i];
    return NULL;
}

static aur_result fail_modifier(const aur_rad *self, aur_rad_word name) {
    return aur_rad_is_word(name, "void")
               ? aur_rad_fail(self, name.line, AUR_ERROR_UNSUPPORTED,
                              "a surface needs a material, not 'void'")
               : aur_rad_fail(self, name.line, AUR_ERROR_NAME, "there is no material '%.*s' above",
                              (int)name.length, name.text);
}

/* What a surface is made of. An unsupported material is reported once, at its own place. */
static aur_result find_modifier(const aur_rad *self, aur_rad_word name, const aur_rad_material **found) {
    aur_rad_material *const material = find_material(self, name);
    if (material == NULL)
        return fail_modifier(self, name);
    *found = material;
    if (material->unsupported == NULL)
        return AUR_OK;
    if (self->error != NULL)
        *self->error = *material->unsupported;
    const bool again = material->reported;
    material->reported = true;
    return again ? AUR_ERROR_NAME : AUR_ERROR_UNSUPPORTED;
}

static aur_result need_void(const aur_rad *self, const aur_rad_primitive *item) {
    return aur_rad_is_word(item->modifier, "void")
               ? AUR_OK
               : aur_rad_fail(
                     self, item->modifier.line, AUR_ERROR_UNSUPPORTED,
                     "%.*s: patterns, textures and mixtures are not read: its modifier must be 'void', not "
                     "'%.*s'",
                     (int)item->type.length, item->type.text, (int)item->modifier.length,
                     item->modifier.text);
}

static aur_result add_material(aur_rad *self, aur_rad_material material) {
    aur_rad_scene *const scene = self->scene;
    material.name.text = aur_arena_copy(scene->arena, material.name.text, material.name.length);
    if (material.name.text == NULL || !aur_array_reserve(&scene->materials, &scene->material_capacity,
                                                         scene->material_count + 1, sizeof material))
        return aur_fail_memory(self->error);
    scene->materials[scene->material_count++] = material;
    return AUR_OK;
}

/* A modifier that is not supported, as the error says: only a surface that uses it makes that matter. */
static aur_result add_unsupported(aur_rad *self, const aur_rad_primitive *item) {
    aur_error *const copy = aur_arena_allocate(self->scene->arena, sizeof *copy);
    if (copy == NULL)
        return aur_fail_memory(self->error);
    *copy = *self->error;
    return add_material(self, (aur_rad_material){.name = item->name, .row = item->row, .unsupported = copy});
}

/* `void alias NAME KNOWN`: another name. */
static aur_result read_alias(aur_rad *self, const aur_rad_primitive *item) {
    aur_rad_word known;
    aur_result result = need_void(self, item);
    if (result == AUR_OK && !aur_rad_next_word(self, &known))
        result = aur_rad_fail_end(self, "the name of a material", known);
    if (result != AUR_OK)
        return result;
    const aur_rad_material *const material = find_material(self, known);
    if (material == NULL)
        return fail_modifier(self, known);
    aur_rad_material copy = *material;
    copy.name = item->name;
    return add_material(self, copy);
}

static aur_result read_material(aur_rad *self, const aur_rad_primitive *item) {
    aur_result result = need_void(self, item);
    if (result != AUR_OK)
        return result;
    aur_rad_material material = {.name = item->name, .row = item->row};
    for (size_t i = 0; i < 3; ++i)
        material.radiance[i] = item->numbers[i];
    result = item->row->add(self, item, &material);
    material.bsdf = self->parent->last_child;
    return result == AUR_OK ? add_material(self, material) : result;
}

static aur_result fail_type(const aur_rad *self, aur_rad_word type) {
    char name[64], hint[AUR_HINT_CAPACITY];
    const size_t length = type.length < sizeof name ? type.length : sizeof name - 1;
    memcpy(name, type.text, length);
    name[length] = '\0';
    aur_names_hint((aur_names){AUR_RAD_ROWS, row_name, aur_rad_rows}, name, "''", hint);
    return aur_rad_fail(self, type.line, AUR_ERROR_UNSUPPORTED, "'%s' is not read%s", name, hint);
}

/* Notes what is not read, and goes on to the next thing. What refers to a thing that is not there may do so
 * because that was left out. */
static aur_result leave_out(aur_rad *self, aur_result result) {
    aur_error *const last = self->scene->left_out;
    if (result == AUR_ERROR_NAME && last->result != AUR_OK)
        return AUR_OK;
    if (result != AUR_ERROR_UNSUPPORTED)
        return result;
    aur_warn_error(self->scene->warnings, last);
    *last = *self->error;
    return AUR_OK;
}

/* Radiance's materials, patterns, textures and mixtures (its manual page "rad"), but for those of
 * aur_rad_rows. */
static bool is_modifier(aur_rad_word type) {
    static const char *const names[] = {
        "illum",     "spotlight",  "mirror",    "prism1",     "prism2",     "trans",     "plastic2",
        "metal2",    "trans2",     "ashik2",    "dielectric", "interface",  "plasfunc",  "metfunc",
        "transfunc", "BRTDfunc",   "plasdata",  "metdata",    "transdata",  "BSDF",      "aBSDF",
        "WGMDfunc",  "antimatter", "mist",      "texfunc",    "texdata",    "colorfunc", "brightfunc",
        "colordata", "brightdata", "colorpict", "colortext",  "brighttext", "mixfunc",   "mixdata",
        "mixpict",   "mixtext",    "spectrum",  "specfile",   "specfunc",   "specdata",  "specpict"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        if (aur_rad_is_word(type, names[i]))
            return true;
    return false;
}

/* What a primitive becomes whose arguments have been read. */
static aur_result use_primitive(aur_rad *self, const aur_rad_primitive *item) {
    if (item->row == NULL) {
        const aur_result result = fail_type(self, item->type);
        return is_modifier(item->type) ? add_unsupported(self, item) : result;
    }
    if (item->number_count < item->row->least || item->number_count > item->row->most)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT, "%s takes %zu numbers%s, not %zu",
                            item->row->name, item->row->least,
                            item->row->most > item->row->least ? " or more" : "", item->number_count);
    aur_result result = AUR_OK;
    if (item->string_count > 0 && !item->row->names_file)
        result = aur_rad_fail(self, item->strings[0].line, AUR_ERROR_UNSUPPORTED, "%s takes no strings",
                              item->row->name);
    self->nodes->location.line = item->modifier.line;
    if (result == AUR_OK && item->row->material)
        result = read_material(self, item);
    if (item->row->material)
        return result == AUR_ERROR_UNSUPPORTED ? add_unsupported(self, item) : result;
    if (result != AUR_OK)
        return result;
    const aur_rad_material *material = NULL;
    result = find_modifier(self, item->modifier, &material);
    return result == AUR_OK ? item->row->add(self, item, material) : result;
}

static aur_result read_primitive(aur_rad *self, aur_rad_word modifier) {
    aur_rad_primitive item = {.modifier = modifier};
    if (!aur_rad_next_word(self, &item.type))
        return aur_rad_fail_end(self, "a type", item.type);
    if (!aur_rad_next_word(self, &item.name))
        return aur_rad_fail_end(self, "a name", item.name);
    if (aur_rad_is_word(item.type, "alias"))
        return read_alias(self, &item);
    for (size_t i = 0; i < AUR_RAD_ROWS && item.row == NULL; ++i)
        if (aur_rad_is_word(item.type, aur_rad_rows[i].name))
            item.row = &aur_rad_rows[i];
    const aur_result result = read_arguments(self, &item);
    if (result != AUR_OK) /* nobody knows where the next thing begins */
        return item.row == NULL ? fail_type(self, item.type) : result;
    return leave_out(self, use_primitive(self, &item));
}

/* The next word of the line. */
static bool next_of_line(aur_rad *self, aur_rad_word *word) {
    while (self->at < self->end && *self->at != '\n' && aur_is_space(*self->at))
        ++self->at;
    return self->at < self->end && *self->at != '\n' && *self->at != '#' && aur_rad_next_word(self, word);
}

static aur_result add_file(aur_rad *self, aur_rad_word name, size_t index) {
    const aur_result result = aur_rad_check_name(self, name);
    if (result != AUR_OK)
        return result;
    if (!aur_array_reserve(&self->words, &self->word_capacity, index + 1, sizeof *self->words))
        return aur_fail_memory(self->error);
    self->words[index] = name;
    return AUR_OK;
}

/* `!cat FILE ...` and `!xform [-n NAME] FILE`, the commands that only include files: `command` is the word
 * with the exclamation mark, `!` alone where a blank follows. */
static aur_result read_command(aur_rad *self, aur_rad_word command) {
    static const char advice[] = "write what it makes into the file, or into one of its own beside this one";
    aur_rad_word word = {command.text + 1, command.length - 1, command.line};
    if (word.length == 0 && !next_of_line(self, &word))
        return aur_rad_fail(self, command.line, AUR_ERROR_FORMAT, "a command must stand after '!'");
    const bool moves = aur_rad_is_word(word, "xform");
    if (!moves && !aur_rad_is_word(word, "cat"))
        return aur_rad_fail(self, command.line, AUR_ERROR_UNSUPPORTED,
                            "the command '%.*s' is not run, only cat and xform that include files: %s",
                            word.length > 40 ? 40 : (int)word.length, word.text, advice);
    size_t files = 0;
    aur_result result = AUR_OK;
    while (result == AUR_OK && next_of_line(self, &word)) {
        if (moves && files == 0 && aur_rad_is_word(word, "-n")) { /* names of objects are not kept */
            next_of_line(self, &word);
            continue;
        }
        if (strchr("-|<>;&`$\"'*?\\", word.text[0]) != NULL || (moves && files > 0))
            return aur_rad_fail(self, command.line, AUR_ERROR_UNSUPPORTED,
                                "'%.*s' is not read after %s, which may only include files: %s",
                                word.length > 40 ? 40 : (int)word.length, word.text, moves ? "xform" : "cat",
                                advice);
        result = add_file(self, word, files++);
    }
    self->nodes->location.line = command.line;
    self->include_count = result == AUR_OK ? files : 0;
    self->include_next = 0;
    return result != AUR_OK || files > 0 ? result
                                         : aur_rad_fail(self, command.line, AUR_ERROR_FORMAT,
                                                        "the file that is to be included is missing");
}

aur_result aur_rad_open(aur_rad_scene *scene, aur_nodes *nodes, aur_xml_node *parent, size_t size,
                        const char *data, aur_rad **rad) {
    aur_rad *const self = *rad = calloc(1, sizeof *self);
    /* With a zero byte after it, at which numbers end. */
    char *const text = malloc(size + 1);
    if (self == NULL || text == NULL) {
        free(self);
        free(text);
        *rad = NULL;
        return aur_fail_memory(nodes->error);
    }
    memcpy(text, data, size);
    text[size] = '\0';
    *self = (aur_rad){.scene = scene,
                      .nodes = nodes,
                      .parent = parent,
                      .text = text,
                      .at = text,
                      .end = text + size,
                      .line = 1,
                      .error = nodes->error};
    return AUR_OK;
}

aur_result aur_rad_next(aur_rad *self, const char **included) {
    aur_rad_word word;
    aur_result result = AUR_OK;
    while (result == AUR_OK && self->include_next == self->include_count && aur_rad_next_word(self, &word)) {
        if (word.text[0] != '!') {
            result = read_primitive(self, word);
            continue;
        }
        result = read_command(self, word);
        if (result == AUR_ERROR_UNSUPPORTED) {
            result = leave_out(self, result);
            while (next_of_line(self, &word))
                continue;
        }
    }
    *included = NULL;
    if (result != AUR_OK || self->include_next == self->include_count)
        return result;
    word = self->words[self->include_next++];
    *included = aur_arena_copy(self->scene->arena, word.text, word.length);
    return *included != NULL ? AUR_OK : aur_fail_memory(self->error);
}

void aur_rad_close(aur_rad *self) {
    if (self == NULL)
        return;
    free(self->text);
    free(self->words);
    free(self->numbers);
    free(self);
}

void aur_rad_scene_release(aur_rad_scene *scene) {
    free(scene->materials);
    *scene = (aur_rad_scene){0};
}
