#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/names.h"
#include "points/base/text.h"
#include "render/scene/importers/rad/rad_reader.h"

bool aur_rad_is_name(const char *path) {
    static const char *const endings[] = {".rad", ".mat", ".sky"};
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; ++i)
        if (length > 4 && strcmp(path + length - 4, endings[i]) == 0)
            return true;
    return false;
}

static const char *row_name(const void *list, size_t index) {
    return ((const aur_rad_row *const *)list)[index]->name;
}

enum { MOST_ROWS = 32 };

static size_t list_rows(const aur_rad_row *rows[MOST_ROWS]) {
    size_t count = 0;
    for (const aur_rad_row *row = aur_rad_surfaces; row->name != NULL; ++row)
        rows[count++] = row;
    for (const aur_rad_row *row = aur_rad_materials; row->name != NULL; ++row)
        rows[count++] = row;
    return count;
}

static const aur_rad_row *find_row(aur_rad_word type) {
    const aur_rad_row *rows[MOST_ROWS];
    const size_t count = list_rows(rows);
    for (size_t i = 0; i < count; ++i)
        if (aur_rad_is_word(type, rows[i]->name))
            return rows[i];
    return NULL;
}

bool aur_rad_is_text(size_t size, const char *data) {
    static const char compiled[] = "#?RADIANCE"; /* octrees, meshes, images */
    if (size >= sizeof compiled - 1 && memcmp(data, compiled, sizeof compiled - 1) == 0)
        return false;
    aur_rad self = {.at = data, .end = data + size, .line = 1};
    aur_rad_word modifier, type;
    if (!aur_rad_next_word(&self, &modifier))
        return false;
    for (size_t i = 0; i < modifier.length; ++i)
        if ((unsigned char)modifier.text[i] < 32)
            return false;
    if (modifier.text[0] == '!')
        return true;
    return aur_rad_next_word(&self, &type) &&
           (find_row(type) != NULL || aur_rad_is_modifier(type) || aur_rad_is_word(type, "alias"));
}

/* --- parsing */

static aur_result read_count(aur_rad *self, const char *what, size_t *count) {
    aur_rad_word word;
    uint64_t value = 0;
    aur_rad_next_word(self, &word);
    /* The file size bounds the number of words. */
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
    result = read_count(self, "the number of integers", &integers);
    if (result == AUR_OK && integers != 0 && item->row != NULL)
        return aur_rad_fail(self, self->line, AUR_ERROR_FORMAT, "%s takes no integers, not %zu",
                            item->row->name, integers);
    for (aur_rad_word word; integers > 0 && result == AUR_OK; --integers)
        if (!aur_rad_next_word(self, &word))
            result = aur_rad_fail_end(self, "an integer", word);
    if (result == AUR_OK)
        result = read_count(self, "the number of numbers", &item->number_count);
    if (result != AUR_OK)
        return result;
    if (!aur_array_reserve(&self->numbers, &self->number_capacity, item->number_count + 1,
                           sizeof *self->numbers))
        return aur_fail_memory(self->error);
    for (size_t i = 0; i < item->number_count; ++i) {
        aur_rad_word word;
        if (!aur_rad_next_word(self, &word) || !aur_rad_number(word, &self->numbers[i]))
            return aur_rad_fail_end(self, "a number", word);
    }
    item->strings = self->words;
    item->numbers = self->numbers;
    return AUR_OK;
}

aur_rad_material *aur_rad_find_material(const aur_rad *self, aur_rad_word name) {
    aur_rad_material *const materials = self->scene->materials;
    for (size_t i = self->scene->material_count; i-- > 0;)
        if (materials[i].name.length == name.length &&
            memcmp(materials[i].name.text, name.text, name.length) == 0)
            return &materials[i];
    return NULL;
}

static aur_result fail_modifier(const aur_rad *self, aur_rad_word name) {
    return aur_rad_fail(self, name.line, AUR_ERROR_NAME, "unknown material '%.*s': it is not defined above",
                        (int)name.length, name.text);
}

/* The material of a surface; surfaces of `void` are omitted. An unsupported material is reported once, at its
 * own line. */
static aur_result find_modifier(const aur_rad *self, aur_rad_word name, aur_rad_material *found) {
    *found = (aur_rad_material){.nothing = true};
    if (aur_rad_is_word(name, "void"))
        return AUR_OK;
    aur_rad_material *const material = aur_rad_find_material(self, name);
    if (material == NULL)
        return fail_modifier(self, name);
    *found = *material;
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

/* Stores the error of an unsupported modifier: it is raised only when a surface uses it. */
static aur_result add_unsupported(aur_rad *self, const aur_rad_primitive *item) {
    aur_error *const copy = aur_arena_allocate(self->scene->arena, sizeof *copy);
    if (copy == NULL)
        return aur_fail_memory(self->error);
    *copy = self->error != NULL ? *self->error : (aur_error){.result = AUR_ERROR_UNSUPPORTED};
    return add_material(self, (aur_rad_material){.name = item->name, .unsupported = copy});
}

/* `void alias NAME TARGET`: another name for a modifier. */
static aur_result read_alias(aur_rad *self, const aur_rad_primitive *item) {
    aur_rad_word target;
    aur_result result = self->scene->diffuse ? AUR_OK : need_void(self, item);
    if (result == AUR_OK && !aur_rad_next_word(self, &target))
        result = aur_rad_fail_end(self, "the name of a material", target);
    if (result != AUR_OK)
        return result;
    aur_rad_material material = {.nothing = true};
    if (!aur_rad_is_word(target, "void")) {
        const aur_rad_material *const found = aur_rad_find_material(self, target);
        if (found == NULL)
            return fail_modifier(self, target);
        material = *found;
    }
    material.name = item->name;
    return add_material(self, material);
}

/* Whether a material's modifier has no effect: none, or another material. */
static bool is_plain(const aur_rad *self, aur_rad_word name) {
    const aur_rad_material *const under = aur_rad_find_material(self, name);
    return aur_rad_is_word(name, "void") || (under != NULL && under->unsupported == NULL);
}

static aur_result read_material(aur_rad *self, const aur_rad_primitive *item) {
    aur_rad_material material = {.name = item->name};
    const aur_rad_material *const under = aur_rad_find_material(self, item->modifier);
    const bool emits = item->row->emits,
               patterned = under != NULL && (under->sky != NULL || under->luminaire != NULL) && !under->emits;
    const bool plain = is_plain(self, item->modifier) && (emits || !patterned);
    aur_result result = plain || (self->scene->diffuse && !emits) ? AUR_OK : need_void(self, item);
    if (result == AUR_OK && !plain)
        ++self->scene->diffuse_count;
    if (result == AUR_OK && emits && patterned) {
        material.sky = under->sky;
        material.luminaire = under->luminaire;
    }
    if (result == AUR_OK)
        result = item->row->add(self, item, &material);
    return result == AUR_OK ? add_material(self, material) : result;
}

static aur_result fail_type(const aur_rad *self, aur_rad_word type) {
    const aur_rad_row *rows[MOST_ROWS];
    const size_t count = list_rows(rows);
    char name[64], hint[AUR_HINT_CAPACITY];
    const size_t length = type.length < sizeof name ? type.length : sizeof name - 1;
    memcpy(name, type.text, length);
    name[length] = '\0';
    aur_names_hint((aur_names){count, row_name, rows}, name, "''", hint);
    return aur_rad_fail(self, type.line, AUR_ERROR_UNSUPPORTED, "'%s' is not read%s", name, hint);
}

/* Records an ignored primitive and continues. A later reference to an undefined name may be a consequence. */
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

/* A modifier without a table row. With --diffuse, its diffuse part is used; patterns and textures are
 * replaced by what they modify. */
static aur_result read_modifier(aur_rad *self, const aur_rad_primitive *item) {
    const aur_rad_material *mixed = NULL, *const under = aur_rad_find_material(self, item->modifier);
    aur_rad_material material = {.name = item->name};
    for (size_t i = 0; i < 2 && i < item->string_count && mixed == NULL; ++i)
        mixed = aur_rad_find_material(self, item->strings[i]);
    aur_result result = fail_type(self, item->type);
    if (self->scene->diffuse)
        result = aur_rad_add_diffuse_part(self, item, mixed, &material);
    if (result == AUR_ERROR_UNSUPPORTED && self->scene->diffuse && under != NULL) {
        material = *under;
        material.name = item->name;
        ++self->scene->diffuse_count;
        result = AUR_OK;
    }
    return result == AUR_ERROR_UNSUPPORTED ? add_unsupported(self, item)
           : result == AUR_OK              ? add_material(self, material)
                                           : result;
}

/* Adds a surface, transformed by the file's pose. */
static aur_result read_surface(aur_rad *self, const aur_rad_primitive *item) {
    aur_rad_material material;
    const aur_rad_word override = self->pose.modifier;
    const aur_rad_word name = override.length > 0 ? override : item->modifier;
    const char *const light = self->scene->light;
    const aur_result result = find_modifier(self, name, &material);
    if (result == AUR_OK && material.emits && light != NULL) {
        const bool chosen = aur_rad_is_word(name, light);
        self->scene->has_light = self->scene->has_light || chosen;
        for (size_t i = 0; i < 3 && !chosen; ++i)
            material.radiance[i] = 0.0;
    }
    if (result != AUR_OK || (material.nothing && strcmp(item->row->name, "instance") != 0))
        return result;
    return material.luminaire != NULL ? aur_rad_add_luminaire(self, item, &material)
                                      : item->row->add(self, item, &material);
}

/* Converts a primitive whose arguments have been read. */
static aur_result use_primitive(aur_rad *self, const aur_rad_primitive *item) {
    if (item->row == NULL)
        return aur_rad_is_modifier(item->type) ? read_modifier(self, item) : fail_type(self, item->type);
    if (item->number_count < item->row->least || item->number_count > item->row->most)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT, "%s takes %zu numbers%s, not %zu",
                            item->row->name, item->row->least,
                            item->row->most > item->row->least ? " or more" : "", item->number_count);
    if (item->string_count > item->row->most_strings)
        return aur_rad_fail(self, item->strings[0].line, AUR_ERROR_FORMAT, "%s takes no %sstrings",
                            item->row->name, item->row->most_strings > 0 ? "more " : "");
    self->nodes->location.line = item->modifier.line;
    if (!item->row->material)
        return read_surface(self, item);
    const aur_result result = read_material(self, item);
    if (result != AUR_ERROR_UNSUPPORTED)
        return result;
    /* With --diffuse a pattern is replaced by what it modifies. An illum with a pattern is replaced by its
     * window. */
    const bool pattern =
                   aur_rad_is_word(item->type, "brightfunc") || aur_rad_is_word(item->type, "brightdata"),
               window = aur_rad_is_word(item->type, "illum") && item->string_count > 0;
    const aur_rad_material *const under =
        aur_rad_find_material(self, window ? item->strings[0] : item->modifier);
    if (!self->scene->diffuse || !(pattern || window) || under == NULL)
        return add_unsupported(self, item);
    aur_rad_material material = *under;
    material.name = item->name;
    ++self->scene->diffuse_count;
    return add_material(self, material);
}

static aur_result read_primitive(aur_rad *self, aur_rad_word modifier) {
    aur_rad_primitive item = {.modifier = modifier};
    if (!aur_rad_next_word(self, &item.type))
        return aur_rad_fail_end(self, "a type", item.type);
    if (!aur_rad_next_word(self, &item.name))
        return aur_rad_fail_end(self, "a name", item.name);
    if (aur_rad_is_word(item.type, "alias"))
        return read_alias(self, &item);
    item.row = find_row(item.type);
    const aur_result result = read_arguments(self, &item);
    if (result != AUR_OK) /* the end of the arguments is uncertain */
        return item.row == NULL && !aur_rad_is_modifier(item.type) ? fail_type(self, item.type) : result;
    return leave_out(self, use_primitive(self, &item));
}

/* --- commands */

/* Replaces the $names in a word of a command by their values, as the shell does for oconv. */
static aur_result substitute(aur_rad *self, aur_rad_word *word) {
    char *replaced = NULL;
    const char *const text = aur_arena_copy(self->scene->arena, word->text, word->length);
    if (text == NULL)
        return aur_fail_memory(self->error);
    const aur_result result = aur_xml_variables_substitute(
        self->nodes->variables, text, (aur_location){self->nodes->location.file, word->line, 0}, &replaced,
        self->error);
    if (result == AUR_OK)
        *word = (aur_rad_word){replaced, strlen(replaced), word->line};
    return result;
}

/* The words of a command line, without the exclamation mark of the first. */
static aur_result read_line(aur_rad *self, aur_rad_word command, size_t *count) {
    aur_rad_word word = {command.text + 1, command.length - 1, command.line};
    *count = 0;
    for (bool more = word.length > 0 || aur_rad_next_of_line(self, &word); more;
         more = aur_rad_next_of_line(self, &word)) {
        if (!aur_array_reserve(&self->words, &self->word_capacity, *count + 1, sizeof *self->words))
            return aur_fail_memory(self->error);
        if (self->nodes->variables != NULL && memchr(word.text, '$', word.length) != NULL) {
            const aur_result result = substitute(self, &word);
            if (result != AUR_OK)
                return result;
        }
        self->words[(*count)++] = word;
    }
    return *count > 0 ? AUR_OK
                      : aur_rad_fail(self, command.line, AUR_ERROR_FORMAT, "a command must follow '!'");
}

static aur_result fail_command(const aur_rad *self, aur_rad_word word, const char *after) {
    return aur_rad_fail(self, word.line, AUR_ERROR_UNSUPPORTED,
                        "'%.*s' is not supported after %s: write the output of the command to a file",
                        word.length > 40 ? 40 : (int)word.length, word.text, after);
}

/* The words from `first` on are files. */
static aur_result take_files(aur_rad *self, size_t first, size_t count, const char *command) {
    for (size_t i = first; i < count; ++i) {
        const aur_rad_word word = self->words[i];
        if (strchr("-<>;&`$\"'*?\\", word.text[0]) != NULL)
            return fail_command(self, word, command);
        const aur_result result = aur_rad_check_name(self, word);
        if (result != AUR_OK)
            return result;
        self->words[i - first] = word;
    }
    self->file_count = count - first;
    self->next = 0;
    return count > first
               ? AUR_OK
               : aur_rad_fail(self, self->words[0].line, AUR_ERROR_FORMAT, "included file not found");
}

/* A generator's surface is instantiated in all poses of the command. */
static aur_result take_surface(aur_rad *self, const char *type, aur_rad_word modifier, size_t count,
                               double *numbers) {
    double copy[3 * 1024];
    const aur_rad_pose saved = self->pose;
    aur_rad_primitive item = {.modifier = modifier,
                              .type = {type, strlen(type), modifier.line},
                              .name = self->words[2],
                              .number_count = count,
                              .numbers = copy};
    item.row = find_row(item.type);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < self->pose_count && result == AUR_OK; ++i) {
        self->pose = aur_rad_pose_multiply(&saved, &self->poses[i]);
        memcpy(copy, numbers, count * sizeof *copy);
        result = leave_out(self, use_primitive(self, &item));
    }
    self->pose = saved;
    return result;
}

/* Index of the first `|`, or the end. */
static size_t find_pipe(const aur_rad *self, size_t at, size_t count) {
    while (at < count && !aur_rad_is_word(self->words[at], "|"))
        ++at;
    return at;
}

/* `| xform OPTIONS ...` after a command with known poses. */
static aur_result read_pipes(aur_rad *self, size_t at, size_t count) {
    aur_result result = AUR_OK;
    while (at < count && result == AUR_OK) {
        const size_t end = find_pipe(self, at + 1, count);
        size_t used = 0;
        if (at + 1 == end || !aur_rad_is_word(self->words[at + 1], "xform"))
            return at + 1 == end ? fail_command(self, self->words[at], "a command")
                                 : fail_command(self, self->words[at + 1], "'|'");
        result = aur_rad_chain_xform(self, end - at - 2, self->words + at + 2, &used);
        if (result == AUR_OK && used < end - at - 2)
            result = fail_command(self, self->words[at + 2 + used], "'| xform'");
        at = end;
    }
    return result;
}

/* `!cat FILE ...`, `!xform OPTIONS FILE ...`, `!genbox ...`, `!genprism ...`, `!genrev ...`, `!gendaylit ...`
 * and `!gensky ...`, each optionally piped into xform. `command` is the word with the exclamation mark, or
 * `!` alone if a blank follows. */
static aur_result read_command(aur_rad *self, aur_rad_word command) {
    size_t count = 0, used = 0;
    aur_result result = read_line(self, command, &count);
    if (result != AUR_OK)
        return result;
    const aur_rad_word name = self->words[0];
    const size_t end = find_pipe(self, 1, count);
    const bool moves = aur_rad_is_word(name, "xform"), includes = moves || aur_rad_is_word(name, "cat");
    result = aur_rad_read_xform(self, moves ? end - 1 : 0, self->words + 1, &used);
    if (result == AUR_OK)
        result = read_pipes(self, end, count);
    self->nodes->location.line = command.line;
    if (result == AUR_OK && (aur_rad_is_word(name, "gendaylit") || aur_rad_is_word(name, "gensky"))) {
        aur_rad_material pattern = {.name = {"skyfunc", 7, command.line}};
        self->pose_count = 0;
        if (end < count)
            return fail_command(self, self->words[end + 1], "a sky");
        result = aur_rad_read_daylight(self, end, self->words, &pattern);
        return result == AUR_OK ? add_material(self, pattern) : result;
    }
    if (result == AUR_OK && includes)
        return take_files(self, 1 + used, end, moves ? "xform" : "cat");
    bool recognised = true;
    if (result == AUR_OK)
        result = aur_rad_generate(self, end, self->words, take_surface, &recognised);
    self->pose_count = 0;
    return recognised
               ? result
               : aur_rad_fail(self, command.line, AUR_ERROR_UNSUPPORTED,
                              "the command '%.*s' is not run, only cat, xform, genbox, genprism, genrev, "
                              "gendaylit and gensky are: write what it makes into a file and include that",
                              name.length > 40 ? 40 : (int)name.length, name.text);
}

aur_result aur_rad_open(aur_rad_scene *scene, aur_nodes *nodes, aur_xml_node *parent, size_t size,
                        const char *data, aur_rad **rad) {
    aur_rad *const self = *rad = calloc(1, sizeof *self);
    /* Adds a zero byte, which terminates numbers. */
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
                      .pose = scene->pose != NULL ? *scene->pose : aur_rad_pose_identity(),
                      .error = nodes->error};
    scene->pose = NULL;
    return AUR_OK;
}

/* The next file to include, with its pose. */
static aur_result include_next(aur_rad *self, const char **included) {
    const size_t pose = self->next / self->file_count;
    const aur_rad_word word = self->words[self->next++ % self->file_count];
    self->included = aur_rad_pose_multiply(&self->pose, &self->poses[pose]);
    self->scene->pose = &self->included;
    *included = aur_arena_copy(self->scene->arena, word.text, word.length);
    return *included != NULL ? AUR_OK : aur_fail_memory(self->error);
}

aur_result aur_rad_next(aur_rad *self, const char **included) {
    aur_rad_word word;
    aur_result result = AUR_OK;
    *included = NULL;
    self->scene->pose = NULL;
    while (result == AUR_OK) {
        if (self->next < self->file_count * self->pose_count)
            return include_next(self, included);
        self->file_count = self->pose_count = self->next = 0;
        if (!aur_rad_next_word(self, &word))
            break;
        if (word.text[0] != '!' || word.length == 0) {
            result = read_primitive(self, word);
            continue;
        }
        result = read_command(self, word);
        if (result != AUR_OK)
            self->file_count = 0;
        if (result == AUR_ERROR_UNSUPPORTED) {
            result = leave_out(self, result);
            while (aur_rad_next_of_line(self, &word))
                continue;
        }
    }
    return result;
}

void aur_rad_close(aur_rad *self) {
    if (self == NULL)
        return;
    free(self->text);
    free(self->words);
    free(self->numbers);
    free(self->poses);
    free(self);
}

void aur_rad_scene_release(aur_rad_scene *scene) {
    free(scene->materials);
    *scene = (aur_rad_scene){0};
}
