#include "scene/xml/xml.h"

#include <ctype.h>
#include <expat.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/array.h"
#include "core/file.h"
#include "core/text.h"
#include "scene/xml/variables.h"

/* A few kilobytes of includes or <default>s that double each other must not become an endless scene, so that
 * files, their bytes and what $names become have a limit. */
enum { DEEPEST_INCLUDE = 15, DEEPEST_ELEMENT = 100, MOST_FILES = 10000, MOST_SUBSTITUTED = 1 << 26 };
#define LARGEST_SCENE ((size_t)1 << 30)

/* What all files of a scene share. */
typedef struct reading {
    aur_xml_document *document;
    const aur_scene_options *options;
    aur_xml_variables variables;
    size_t id_capacity;
    size_t file_count, file_bytes, substituted_bytes;
    aur_error *error;
} reading;

/* One file being parsed. */
typedef struct file_reading {
    reading *shared;
    XML_Parser expat;
    const char *file;
    size_t include_depth;
    bool legacy; /* version < 2 */
    aur_result result;
    aur_xml_node
        *target;  /* what an included file's elements are put into; NULL: this is the scene's own file */
    size_t depth; /* open elements */
    aur_xml_node *open[DEEPEST_ELEMENT + 1]; /* NULL for elements that leave no node */
} file_reading;

static aur_result read_file(reading *shared, const char *path, size_t include_depth, bool legacy,
                            aur_xml_node *target);

static aur_location here(const file_reading *reader) {
    return (aur_location){reader->file, XML_GetCurrentLineNumber(reader->expat),
                          XML_GetCurrentColumnNumber(reader->expat) + 1};
}

static void stop(file_reading *reader, aur_result result) {
    reader->result = result;
    XML_StopParser(reader->expat, XML_FALSE);
}

static aur_result fail_memory(const file_reading *reader) {
    return aur_fail_memory_at(reader->shared->error, here(reader));
}

/* "toWorld" to "to_world". */
static char *snake_case(aur_arena *arena, const char *name) {
    char *const result = aur_arena_allocate(arena, 2 * strlen(name) + 1);
    if (result == NULL)
        return NULL;
    char *out = result;
    for (const char *c = name; *c != '\0'; ++c) {
        if (c > name && isupper((unsigned char)*c) && islower((unsigned char)c[-1]))
            *out++ = '_';
        *out++ = (char)tolower((unsigned char)*c);
    }
    *out = '\0';
    return result;
}

const char *aur_xml_attribute_value(const aur_xml_node *node, const char *name) {
    for (size_t i = 0; i < node->attribute_count; ++i)
        if (strcmp(node->attributes[i].name, name) == 0)
            return node->attributes[i].value;
    return NULL;
}

static aur_result make_node(file_reading *reader, const char *tag, const char **attributes,
                            aur_xml_node **made) {
    aur_arena *const arena = &reader->shared->document->arena;
    const aur_location location = here(reader);
    aur_xml_node *const node = aur_arena_allocate(arena, sizeof *node);
    size_t count = 0;
    while (attributes[2 * count] != NULL)
        ++count;
    if (node == NULL)
        return fail_memory(reader);
    const bool look_at = reader->legacy && strcmp(tag, "lookAt") == 0;
    node->tag = aur_arena_copy(arena, look_at ? "lookat" : tag, strlen(tag));
    node->location = location;
    node->attributes = aur_arena_allocate(arena, (count + 1) * sizeof *node->attributes);
    if (node->tag == NULL || node->attributes == NULL)
        return fail_memory(reader);
    for (size_t i = 0; i < count; ++i) {
        char *value;
        const aur_result result = aur_xml_variables_substitute(
            &reader->shared->variables, attributes[2 * i + 1], location, &value, reader->shared->error);
        if (result != AUR_OK)
            return result;
        aur_xml_attribute *const attribute = &node->attributes[node->attribute_count++];
        attribute->name = aur_arena_copy(arena, attributes[2 * i], strlen(attributes[2 * i]));
        attribute->value = reader->legacy && strcmp(attributes[2 * i], "name") == 0
                               ? snake_case(arena, value)
                               : aur_arena_copy(arena, value, strlen(value));
        const size_t before = strlen(attributes[2 * i + 1]), after = strlen(value);
        free(value);
        reader->shared->substituted_bytes += after > before ? after - before : 0;
        if (reader->shared->substituted_bytes > MOST_SUBSTITUTED)
            return aur_fail_at(reader->shared->error, location, AUR_ERROR_FORMAT,
                               "the values of $names make the scene more than %d bytes longer",
                               MOST_SUBSTITUTED);
        if (attribute->name == NULL || attribute->value == NULL)
            return fail_memory(reader);
    }
    *made = node;
    return AUR_OK;
}

aur_result aur_xml_check_attributes(const aur_xml_node *node, size_t count, const char *const *names,
                                    aur_error *error) {
    for (size_t i = 0; i < node->attribute_count; ++i) {
        const char *const name = node->attributes[i].name;
        bool known = false;
        for (size_t k = 0; k < count && !known; ++k)
            known = strcmp(name, names[k]) == 0;
        if (known)
            continue;
        const char *const nearest = aur_nearest_name(name, count, names);
        if (nearest != NULL)
            return aur_fail_at(error, node->location, AUR_ERROR_NAME,
                               "<%s> has no attribute '%s'; did you mean '%s'?", node->tag, name, nearest);
        return aur_fail_at(error, node->location, AUR_ERROR_NAME, "<%s> has no attribute '%s'", node->tag,
                           name);
    }
    return AUR_OK;
}

aur_result aur_xml_require(const aur_xml_node *node, const char *name, const char **value, aur_error *error) {
    *value = aur_xml_attribute_value(node, name);
    if (*value != NULL)
        return AUR_OK;
    return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "<%s> needs the attribute '%s'", node->tag,
                       name);
}

/* All of `count` attributes must be there, and no other one. */
static aur_result required(file_reading *reader, const aur_xml_node *node, size_t count,
                           const char *const *names) {
    const char *value;
    aur_result result = aur_xml_check_attributes(node, count, names, reader->shared->error);
    for (size_t k = 0; k < count && result == AUR_OK; ++k)
        result = aur_xml_require(node, names[k], &value, reader->shared->error);
    return result;
}

static aur_result add_id(reading *shared, const char *id, aur_xml_node *node, aur_location location) {
    aur_xml_document *const document = shared->document;
    if (!aur_array_reserve(&document->ids, &shared->id_capacity, document->id_count + 1,
                           sizeof *document->ids))
        return aur_fail_memory(shared->error);
    document->ids[document->id_count] = (aur_xml_id){id, node, location, document->id_count};
    ++document->id_count;
    return AUR_OK;
}

static aur_result do_default(file_reading *reader, const aur_xml_node *node) {
    static const char *const names[] = {"name", "value"};
    const aur_result result = required(reader, node, 2, names);
    return result != AUR_OK
               ? result
               : aur_xml_variables_default(&reader->shared->variables, aur_xml_attribute_value(node, "name"),
                                           aur_xml_attribute_value(node, "value"), node->location,
                                           reader->shared->error);
}

static aur_result do_include(file_reading *reader, const aur_xml_node *node, aur_xml_node *parent) {
    static const char *const names[] = {"filename"};
    aur_result result = required(reader, node, 1, names);
    if (result != AUR_OK)
        return result;
    if (reader->include_depth == DEEPEST_INCLUDE)
        return aur_fail_at(reader->shared->error, node->location, AUR_ERROR_FORMAT,
                           "includes are nested deeper than %d: does a file include itself?",
                           DEEPEST_INCLUDE);
    char *path;
    result = aur_xml_find_asset(reader->shared->document, node->location,
                                aur_xml_attribute_value(node, "filename"), &path, reader->shared->error);
    if (result != AUR_OK)
        return result;
    result = read_file(reader->shared, path, reader->include_depth + 1, reader->legacy, parent);
    free(path);
    return result;
}

static aur_result do_path(file_reading *reader, const aur_xml_node *node) {
    static const char *const names[] = {"value"};
    aur_result result = required(reader, node, 1, names);
    if (result != AUR_OK)
        return result;
    char *path;
    aur_xml_document *const document = reader->shared->document;
    result = aur_xml_find_folder(document, node->location, aur_xml_attribute_value(node, "value"), &path,
                                 reader->shared->error);
    if (result != AUR_OK)
        return result;
    aur_xml_folder *const folder = aur_arena_allocate(&document->arena, sizeof *folder);
    if (folder != NULL)
        folder->path = aur_arena_copy(&document->arena, path, strlen(path));
    free(path);
    if (folder == NULL || folder->path == NULL)
        return fail_memory(reader);
    aur_xml_folder **end = &document->folders;
    while (*end != NULL)
        end = &(*end)->next;
    *end = folder;
    return AUR_OK;
}

/* <alias id="known" as="other">: the node is found when all ids are there. */
static aur_result do_alias(file_reading *reader, aur_xml_node *node) {
    static const char *const names[] = {"id", "as"};
    const aur_result result = required(reader, node, 2, names);
    return result != AUR_OK
               ? result
               : add_id(reader->shared, aur_xml_attribute_value(node, "as"), node, node->location);
}

static bool read_version(const char *text, unsigned *major) {
    uint64_t parts[3] = {0};
    size_t count = 0;
    for (; count < 3 && text != NULL; ++count) {
        text = aur_read_integer(text, UINT32_MAX, &parts[count]);
        if (text == NULL || *text != '.')
            break;
        ++text;
    }
    *major = (unsigned)parts[0];
    return text != NULL && *text == '\0' && (count == 1 || count == 2);
}

static aur_result check_root(file_reading *reader, const aur_xml_node *node) {
    const bool scene = strcmp(node->tag, "scene") == 0;
    const char *const version = aur_xml_attribute_value(node, "version");
    aur_error *const error = reader->shared->error;
    if (!scene && reader->target == NULL)
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                           "the first element must be <scene>, not <%s>", node->tag);
    if (version == NULL)
        return scene ? aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                                   "<scene> needs the attribute 'version', such as version=\"3.0.0\"")
                     : AUR_OK;
    unsigned major;
    if (!read_version(version, &major))
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "version must be like 3.0.0, not '%s'",
                           version);
    reader->legacy = major < 2;
    return AUR_OK;
}

static aur_result open_element(file_reading *reader, const char *tag, const char **attributes) {
    aur_error *const error = reader->shared->error;
    if (reader->depth == DEEPEST_ELEMENT)
        return aur_fail_at(error, here(reader), AUR_ERROR_FORMAT, "elements are nested deeper than %d",
                           DEEPEST_ELEMENT);
    aur_xml_node *node = NULL;
    aur_result result = make_node(reader, tag, attributes, &node);
    if (result == AUR_OK && reader->depth == 0)
        result = check_root(reader, node);
    if (result != AUR_OK)
        return result;
    reader->open[++reader->depth] = NULL;
    aur_xml_node *parent = reader->target;
    if (reader->depth > 1) {
        parent = reader->open[reader->depth - 1];
        if (parent == NULL)
            return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "<%s> cannot stand here", tag);
    }
    if (strcmp(tag, "scene") == 0) {
        if (reader->depth > 1)
            return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "<scene> must be the first element");
        reader->open[1] = reader->target != NULL ? reader->target : node;
        if (reader->target == NULL)
            reader->shared->document->root = node;
        return AUR_OK;
    }
    if (strcmp(tag, "default") == 0)
        return do_default(reader, node);
    if (strcmp(tag, "include") == 0)
        return do_include(reader, node, parent);
    if (strcmp(tag, "path") == 0)
        return do_path(reader, node);
    if (strcmp(tag, "alias") == 0)
        return do_alias(reader, node);
    reader->open[reader->depth] = node;
    if (parent->last_child != NULL)
        parent->last_child->next = node;
    else
        parent->first_child = node;
    parent->last_child = node;
    const char *const id = aur_xml_attribute_value(node, "id");
    return id != NULL && strcmp(tag, "ref") != 0 ? add_id(reader->shared, id, node, node->location) : AUR_OK;
}

static void XMLCALL on_start(void *user, const XML_Char *tag, const XML_Char **attributes) {
    file_reading *const reader = user;
    if (reader->result != AUR_OK)
        return;
    const aur_result result = open_element(reader, tag, attributes);
    if (result != AUR_OK)
        stop(reader, result);
}

static void XMLCALL on_end(void *user, const XML_Char *tag) {
    (void)tag;
    file_reading *const reader = user;
    if (reader->depth > 0)
        --reader->depth;
}

static void XMLCALL on_text(void *user, const XML_Char *text, int length) {
    file_reading *const reader = user;
    if (reader->result != AUR_OK)
        return;
    for (int i = 0; i < length; ++i) {
        if (isspace((unsigned char)text[i]))
            continue;
        stop(reader,
             aur_fail_at(reader->shared->error, here(reader), AUR_ERROR_FORMAT,
                         "text between elements: '%.*s'", length - i > 40 ? 40 : length - i, text + i));
        return;
    }
}

static aur_result parse(file_reading *reader, const char *data, size_t size) {
    enum { CHUNK = 1 << 24 };
    do {
        const size_t piece = size < CHUNK ? size : CHUNK;
        const enum XML_Status status = XML_Parse(reader->expat, data, (int)piece, piece == size);
        if (reader->result != AUR_OK)
            return reader->result;
        if (status != XML_STATUS_OK)
            return aur_fail_at(reader->shared->error, here(reader), AUR_ERROR_FORMAT,
                               "not well-formed XML: %s", XML_ErrorString(XML_GetErrorCode(reader->expat)));
        data += piece;
        size -= piece;
    } while (size > 0);
    return AUR_OK;
}

static aur_result read_text(reading *shared, const char *path, size_t size, const char *data,
                            size_t include_depth, bool legacy, aur_xml_node *target) {
    aur_result result;
    file_reading *const reader = calloc(1, sizeof *reader);
    const XML_Parser expat = XML_ParserCreate(NULL);
    const char *const file = aur_arena_copy(&shared->document->arena, path, strlen(path));
    if (reader == NULL || expat == NULL || file == NULL) {
        result = aur_fail_memory(shared->error);
    } else {
        *reader = (file_reading){.shared = shared,
                                 .expat = expat,
                                 .file = file,
                                 .include_depth = include_depth,
                                 .legacy = legacy,
                                 .target = target};
        XML_SetUserData(expat, reader);
        XML_SetElementHandler(expat, on_start, on_end);
        XML_SetCharacterDataHandler(expat, on_text);
        result = parse(reader, data, size);
    }
    if (expat != NULL)
        XML_ParserFree(expat);
    free(reader);
    return result;
}

static aur_result read_file(reading *shared, const char *path, size_t include_depth, bool legacy,
                            aur_xml_node *target) {
    char *data;
    size_t size;
    if (++shared->file_count > MOST_FILES)
        return aur_fail_at(shared->error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                           "more than %d files are included, counted each time", MOST_FILES);
    aur_result result = aur_file_read(path, LARGEST_SCENE - shared->file_bytes, &data, &size, shared->error);
    if (result != AUR_OK)
        return result;
    shared->file_bytes += size;
    result = read_text(shared, path, size, data, include_depth, legacy, target);
    free(data);
    return result;
}

static int compare_ids(const void *a, const void *b) {
    const aur_xml_id *const x = a, *const y = b;
    const int order = strcmp(x->id, y->id);
    return order != 0 ? order : (x->order > y->order) - (x->order < y->order);
}

static int compare_id_to_key(const void *key, const void *item) {
    return strcmp(key, ((const aur_xml_id *)item)->id);
}

static aur_xml_id *find_id(const aur_xml_document *document, const char *id) {
    return document->id_count == 0
               ? NULL
               : bsearch(id, document->ids, document->id_count, sizeof *document->ids, compare_id_to_key);
}

const aur_xml_id *aur_xml_find_id(const aur_xml_document *document, const char *id) {
    return find_id(document, id);
}

static aur_result sort_ids(reading *shared) {
    aur_xml_document *const document = shared->document;
    if (document->id_count > 1)
        qsort(document->ids, document->id_count, sizeof *document->ids, compare_ids);
    for (size_t i = 1; i < document->id_count; ++i) {
        const aur_xml_id *const first = &document->ids[i - 1];
        const aur_xml_id *const second = &document->ids[i];
        if (strcmp(first->id, second->id) == 0)
            return aur_fail_at(shared->error, second->location, AUR_ERROR_FORMAT,
                               "id '%s' is given twice, first at %s:%zu:%zu", second->id,
                               first->location.file, first->location.line, first->location.column);
    }
    return AUR_OK;
}

/* The id that an alias is another name of, or NULL. */
static aur_xml_id *next_id(const aur_xml_document *document, const aur_xml_id *alias) {
    return find_id(document, aur_xml_attribute_value(alias->node, "id"));
}

/* Every alias on the way to an object is given that object, so that a chain of aliases is walked once. */
static aur_result resolve_aliases(reading *shared) {
    const aur_xml_document *const document = shared->document;
    for (size_t i = 0; i < document->id_count; ++i) {
        aur_xml_id *const first = &document->ids[i];
        const aur_xml_id *last = first;
        for (size_t hops = 0; strcmp(last->node->tag, "alias") == 0; ++hops) {
            const aur_xml_id *const next = next_id(document, last);
            if (next == NULL || hops > document->id_count)
                return aur_fail_at(shared->error, first->location, AUR_ERROR_NAME,
                                   "<alias>: there is no id '%s'", aur_xml_attribute_value(last->node, "id"));
            last = next;
        }
        for (aur_xml_id *item = first; strcmp(item->node->tag, "alias") == 0;) {
            aur_xml_id *const next = next_id(document, item);
            item->node = last->node;
            item = next;
        }
    }
    return AUR_OK;
}

aur_result aur_xml_read(const char *path, size_t bytes, const char *data, const aur_scene_options *options,
                        aur_xml_document *document, aur_error *error) {
    *document = (aur_xml_document){0};
    reading shared = {.document = document, .options = options, .error = error};
    aur_result result = aur_xml_variables_init(&shared.variables, options, error);
    if (result != AUR_OK)
        return result;
    result = data != NULL ? read_text(&shared, path, bytes, data, 0, false, NULL)
                          : read_file(&shared, path, 0, false, NULL);
    if (result == AUR_OK)
        result = sort_ids(&shared);
    if (result == AUR_OK)
        result = resolve_aliases(&shared);
    if (result == AUR_OK)
        result = aur_xml_variables_finish(&shared.variables, path, error);
    aur_xml_variables_release(&shared.variables);
    if (result != AUR_OK)
        aur_xml_release(document);
    return result;
}

void aur_xml_release(aur_xml_document *document) {
    free(document->ids);
    aur_arena_release(&document->arena);
    *document = (aur_xml_document){0};
}
