#include "render/scene/importers/xml/xml.h"

#include <ctype.h>
#include <expat.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "points/base/array.h"
#include "points/base/file.h"
#include "points/base/text.h"
#include "points/base/words.h"
#include "render/scene/importers/nodes/node.h"
#include "render/scene/importers/rad/rad.h"

/* Limits files and their bytes: a few kilobytes of includes that double each other must not make an endless
 * scene. */
enum { DEEPEST_INCLUDE = 15, DEEPEST_ELEMENT = 100, MOST_FILES = 10000 };
#define LARGEST_SCENE ((size_t)1 << 30)

/* State shared by all files of a scene. */
typedef struct reading {
    aur_xml_document *document;
    aur_xml_variables variables;
    aur_rad_scene rad;
    size_t file_count, file_bytes;
    const aur_scene_options *options;
    aur_error *error;
} reading;

/* A file being parsed. */
typedef struct file_reading {
    reading *shared;
    XML_Parser expat; /* NULL: not XML */
    const char *file;
    bool from_rad; /* a Radiance file, or included by one */
    size_t include_depth;
    bool legacy; /* version < 2 */
    aur_result result;
    /* The parent of an included file's elements; NULL: this is the scene's main file. */
    aur_xml_node *target;
    size_t depth;                            /* open elements */
    aur_xml_node *open[DEEPEST_ELEMENT + 1]; /* NULL for elements without a node */
} file_reading;

static aur_result read_file(reading *shared, const char *path, const file_reading *from,
                            aur_xml_node *target);

/* --- nodes and their attributes */

static aur_location here(const file_reading *reader) {
    return (aur_location){reader->file, XML_GetCurrentLineNumber(reader->expat),
                          XML_GetCurrentColumnNumber(reader->expat) + 1};
}

/* "toWorld" to "to_world". */
static char *snake_case(aur_arena *arena, const char *name) {
    char *const result = aur_arena_allocate(arena, 2 * strlen(name) + 1);
    char *out = result;
    for (const char *c = name; result != NULL && *c != '\0'; ++c) {
        if (c > name && isupper((unsigned char)*c) && islower((unsigned char)c[-1]))
            *out++ = '_';
        *out++ = (char)tolower((unsigned char)*c);
    }
    return result;
}

static aur_result make_node(file_reading *reader, const char *tag, const char **attributes,
                            aur_xml_node **created) {
    aur_xml_tree *const tree = &reader->shared->document->tree;
    aur_error *const error = reader->shared->error;
    size_t count = 0;
    while (attributes[2 * count] != NULL)
        ++count;
    const bool look_at = reader->legacy && strcmp(tag, "lookAt") == 0;
    tag = aur_arena_copy(&tree->arena, look_at ? "lookat" : tag, strlen(tag));
    aur_xml_node *const node = *created =
        tag != NULL ? aur_xml_node_create(tree, tag, here(reader), count) : NULL;
    if (node == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i) {
        const char *const name = attributes[2 * i];
        char *value;
        const aur_result result = aur_xml_variables_substitute(
            &reader->shared->variables, attributes[2 * i + 1], node->location, &value, error);
        if (result != AUR_OK)
            return result;
        if (reader->legacy && strcmp(name, "name") == 0)
            value = snake_case(&tree->arena, value);
        node->attributes[i] = (aur_xml_attribute){aur_arena_copy(&tree->arena, name, strlen(name)), value};
        if (node->attributes[i].name == NULL || value == NULL)
            return aur_fail_memory(error);
        node->attribute_count = i + 1;
    }
    return AUR_OK;
}

static aur_result add_id(reading *shared, const char *id, aur_xml_node *node) {
    return aur_xml_tree_add_id(&shared->document->tree, id, node) ? AUR_OK : aur_fail_memory(shared->error);
}

/* --- elements without a node */

static aur_result do_default(file_reading *reader, aur_xml_node *node, aur_xml_node *parent) {
    (void)parent;
    return aur_xml_variables_default(&reader->shared->variables, aur_xml_attribute_value(node, "name"),
                                     aur_xml_attribute_value(node, "value"), node->location,
                                     reader->shared->error);
}

static aur_result include(const file_reading *reader, aur_location location, const char *name,
                          aur_xml_node *parent) {
    reading *const shared = reader->shared;
    if (reader->include_depth == DEEPEST_INCLUDE)
        return aur_fail_at(shared->error, location, AUR_ERROR_FORMAT,
                           "includes are nested deeper than %d: does a file include itself?",
                           DEEPEST_INCLUDE);
    char *path;
    aur_result result = aur_xml_find_asset(shared->document, location, name, &path, shared->error);
    if (result != AUR_OK)
        return result;
    result = read_file(shared, path, reader, parent);
    free(path);
    return result;
}

static aur_result do_include(file_reading *reader, aur_xml_node *node, aur_xml_node *parent) {
    return include(reader, node->location, aur_xml_attribute_value(node, "filename"), parent);
}

static aur_result do_path(file_reading *reader, aur_xml_node *node, aur_xml_node *parent) {
    (void)parent;
    aur_xml_document *const document = reader->shared->document;
    char *path;
    const aur_result result = aur_xml_find_folder(
        document, node->location, aur_xml_attribute_value(node, "value"), &path, reader->shared->error);
    if (result != AUR_OK)
        return result;
    const char *const copy = aur_arena_copy(&document->tree.arena, path, strlen(path));
    free(path);
    if (copy == NULL || !aur_array_reserve(&document->folders, &document->folder_capacity,
                                           document->folder_count + 1, sizeof *document->folders))
        return aur_fail_memory(reader->shared->error);
    document->folders[document->folder_count++] = copy;
    return AUR_OK;
}

/* <alias id="target" as="other">: resolved after all ids have been read. */
static aur_result do_alias(file_reading *reader, aur_xml_node *node, aur_xml_node *parent) {
    (void)parent;
    return add_id(reader->shared, aur_xml_attribute_value(node, "as"), node);
}

typedef struct directive {
    aur_xml_rule rule;
    aur_result (*act)(file_reading *reader, aur_xml_node *node, aur_xml_node *parent);
} directive;

static const directive directives[] = {{{"default", 2, {"name", "value"}}, do_default},
                                       {{"include", 1, {"filename"}}, do_include},
                                       {{"path", 1, {"value"}}, do_path},
                                       {{"alias", 2, {"id", "as"}}, do_alias}};

/* --- the tree */

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
        return aur_xml_fail(node, error, "the first element must be <scene>, not <%s>", node->tag);
    if (version == NULL && scene)
        return aur_xml_fail(node, error, "<scene> needs the attribute 'version', such as version=\"3.0.0\"");
    unsigned major = reader->legacy ? 1 : 2;
    if (version != NULL && !read_version(version, &major))
        return aur_xml_fail(node, error, "version must be like 3.0.0, not '%s'", version);
    reader->legacy = major < 2;
    return AUR_OK;
}

static aur_result open_element(file_reading *reader, const char *tag, const char **attributes) {
    aur_error *const error = reader->shared->error;
    if (reader->depth == DEEPEST_ELEMENT)
        return aur_fail_at(error, here(reader), AUR_ERROR_FORMAT, "elements are nested deeper than %d",
                           DEEPEST_ELEMENT);
    aur_xml_node *node;
    aur_result result = make_node(reader, tag, attributes, &node);
    if (result == AUR_OK && reader->depth == 0)
        result = check_root(reader, node);
    if (result != AUR_OK)
        return result;
    aur_xml_node *const parent = reader->depth > 0 ? reader->open[reader->depth] : reader->target;
    reader->open[++reader->depth] = NULL;
    if (reader->depth > 1 && parent == NULL)
        return aur_xml_fail(node, error, "<%s> is not allowed here", tag);
    if (strcmp(tag, "scene") == 0) {
        if (reader->depth > 1)
            return aur_xml_fail(node, error, "<scene> must be the first element");
        reader->open[1] = reader->target != NULL ? reader->target : node;
        if (reader->target == NULL)
            reader->shared->document->tree.root = node;
        return AUR_OK;
    }
    for (size_t i = 0; i < sizeof directives / sizeof directives[0]; ++i) {
        if (strcmp(tag, directives[i].rule.tag) != 0)
            continue;
        result = aur_xml_check(node, &directives[i].rule, error);
        return result == AUR_OK ? directives[i].act(reader, node, parent) : result;
    }
    reader->open[reader->depth] = node;
    aur_xml_node_append(parent, node);
    const char *const id = aur_xml_attribute_value(node, "id");
    return id != NULL && strcmp(tag, "ref") != 0 ? add_id(reader->shared, id, node) : AUR_OK;
}

/* --- files */

static void stop_at(file_reading *reader, aur_result result) {
    reader->result = result;
    if (result != AUR_OK)
        XML_StopParser(reader->expat, XML_FALSE);
}

static void XMLCALL on_start(void *user, const XML_Char *tag, const XML_Char **attributes) {
    file_reading *const reader = user;
    if (reader->result == AUR_OK)
        stop_at(reader, open_element(reader, tag, attributes));
}

static void XMLCALL on_end(void *user, const XML_Char *tag) {
    (void)tag;
    file_reading *const reader = user;
    if (reader->depth > 0)
        --reader->depth;
}

static void XMLCALL on_text(void *user, const XML_Char *text, int length) {
    file_reading *const reader = user;
    while (length > 0 && isspace((unsigned char)*text)) {
        ++text;
        --length;
    }
    if (reader->result == AUR_OK && length > 0)
        stop_at(reader, aur_fail_at(reader->shared->error, here(reader), AUR_ERROR_FORMAT,
                                    "text between elements: '%.*s'", length > 40 ? 40 : length, text));
}

/* Encodings that expat lacks: ASCII, and Windows and Latin code pages, read as ISO 8859-1. They differ only
 * in letters, which occur in comments. */
static int XMLCALL on_encoding(void *user, const XML_Char *name, XML_Encoding *encoding) {
    static const char *const latin[] = {"ascii",        "ansi",   "latin1",     "latin-1",
                                        "windows-1252", "cp1252", "iso-8859-15"};
    (void)user;
    for (size_t i = 0; i < sizeof latin / sizeof latin[0]; ++i) {
        if (strcasecmp(name, latin[i]) != 0)
            continue;
        memset(encoding, 0, sizeof *encoding);
        for (int k = 0; k < 256; ++k)
            encoding->map[k] = k;
        return XML_STATUS_OK;
    }
    return XML_STATUS_ERROR;
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

/* The parent for elements of a file that is not XML: the including element, or a new root. */
static aur_nodes begin_nodes(file_reading *reader, size_t line) {
    reading *const shared = reader->shared;
    aur_nodes nodes = {.tree = &shared->document->tree,
                       .variables = &shared->variables,
                       .location = {.file = reader->file, .line = line},
                       .error = shared->error};
    if (reader->target == NULL)
        reader->target = aur_node_add(&nodes, NULL, "scene");
    return nodes;
}

/* A Radiance file: included files are read before the next line, which may use their materials. */
static aur_result read_rad(file_reading *reader, const char *data, size_t size) {
    reading *const shared = reader->shared;
    aur_nodes nodes = begin_nodes(reader, 1);
    aur_rad *rad = NULL;
    reader->from_rad = shared->document->from_radiance = true;
    const char *included = NULL;
    aur_result result = nodes.result;
    if (result == AUR_OK)
        result = aur_rad_open(&shared->rad, &nodes, reader->target, size, data, &rad);
    do {
        if (result == AUR_OK)
            result = aur_rad_next(rad, &included);
        if (result == AUR_OK && included != NULL)
            result = include(reader, nodes.location, included, reader->target);
    } while (result == AUR_OK && included != NULL);
    aur_rad_close(rad);
    return result;
}

/* A Radiance camera, which makes +z the scene's up axis. */
static aur_result read_view(file_reading *reader, const char *data, size_t size) {
    aur_nodes nodes = begin_nodes(reader, 1);
    reader->shared->document->from_radiance = true;
    return nodes.result != AUR_OK ? nodes.result : aur_rad_read_view(&nodes, reader->target, size, data);
}

static aur_result read_model(file_reading *reader, const char *data, size_t size) {
    const bool included = reader->include_depth > 0;
    aur_nodes nodes = begin_nodes(reader, 0);
    return nodes.result != AUR_OK ? nodes.result
                                  : aur_xml_read_model(reader->shared->document, reader->shared->options,
                                                       included, size, data, &nodes, reader->target);
}

/* XML begins with '<', after white space and a byte order mark; a UTF-16 mark suffices. */
static bool begins_as_xml(size_t size, const char *data) {
    static const char *const marks[] = {"\xef\xbb\xbf", "\xfe\xff", "\xff\xfe"};
    size_t at = 0;
    for (size_t i = 0; i < sizeof marks / sizeof marks[0] && at == 0; ++i)
        if (size >= strlen(marks[i]) && memcmp(data, marks[i], strlen(marks[i])) == 0)
            at = strlen(marks[i]);
    const bool wide = at == 2;
    while (at < size && isspace((unsigned char)data[at]))
        ++at;
    return wide || (at < size && data[at] == '<');
}

static bool is_named_xml(const char *path) {
    const char *const dot = strrchr(path, '.');
    return dot != NULL && strcasecmp(dot, ".xml") == 0;
}

static aur_result read_xml(file_reading *reader, const char *data, size_t size) {
    if (!begins_as_xml(size, data) && !is_named_xml(reader->file))
        return aur_fail_at(
            reader->shared->error, (aur_location){.file = reader->file}, AUR_ERROR_FORMAT,
            "unknown kind of file: expected a scene of XML, a file of Radiance's, or a model (.glb, .gltf, "
            ".obj, .fbx, .dae, .stl, .ply, .off, .3ds)");
    reader->expat = XML_ParserCreate(NULL);
    if (reader->expat == NULL)
        return aur_fail_memory(reader->shared->error);
    XML_SetUserData(reader->expat, reader);
    XML_SetElementHandler(reader->expat, on_start, on_end);
    XML_SetCharacterDataHandler(reader->expat, on_text);
    XML_SetUnknownEncodingHandler(reader->expat, on_encoding, NULL);
    /* Other readers allow lines before the XML declaration. */
    while (size > 0 && isspace((unsigned char)*data)) {
        ++data;
        --size;
    }
    const aur_result result = parse(reader, data, size);
    XML_ParserFree(reader->expat);
    return result;
}

/* The main file may be text in memory, so it is hashed at once. */
static aur_result note_scene(reading *shared, const char *path, size_t size, const char *data) {
    aur_xml_document *const document = shared->document;
    const char *const slash = strrchr(path, '/');
    const aur_result result =
        aur_xml_note_file(document, slash != NULL ? slash + 1 : path, path, shared->error);
    if (result == AUR_OK) {
        aur_xml_file *const file = &document->files[document->file_count - 1];
        file->hashed = true;
        file->hash = aur_hash_bytes(size, data);
    }
    return result;
}

/* `from` is the including file. NULL: this is the main file. If it shares no state: this is a further file of
 * the scene. */
static aur_result read_text(reading *shared, const char *path, size_t size, const char *data,
                            const file_reading *from, aur_xml_node *target) {
    file_reading reader = {.shared = shared,
                           .from_rad = aur_rad_is_name(path) || (from != NULL && from->from_rad),
                           .file = aur_arena_copy(&shared->document->tree.arena, path, strlen(path)),
                           .include_depth = from != NULL ? from->include_depth + 1 : 0,
                           .legacy = from != NULL && from->legacy,
                           .target = target};
    if (reader.file == NULL)
        return aur_fail_memory(shared->error);
    if (from == NULL || from->shared == NULL) { /* no file includes it */
        const aur_result result = note_scene(shared, path, size, data);
        if (result != AUR_OK)
            return result;
    }
    if (aur_xml_is_model(path, size, data))
        return read_model(&reader, data, size);
    if (aur_rad_is_view(size, data))
        return read_view(&reader, data, size);
    const bool rad = !begins_as_xml(size, data) && (reader.from_rad || aur_rad_is_text(size, data));
    return rad ? read_rad(&reader, data, size) : read_xml(&reader, data, size);
}

static aur_result read_file(reading *shared, const char *path, const file_reading *from,
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
    result = read_text(shared, path, size, data, from, target);
    free(data);
    return result;
}

/* Moves the children of <scene> after `last` into the scene. */
static void place(reading *shared, size_t file, const aur_xml_node *last) {
    const aur_scene_stage *const stage = &shared->options->stage;
    aur_xml_tree *const tree = &shared->document->tree;
    aur_nodes nodes = {.tree = tree, .error = shared->error};
    for (size_t i = 0; i < stage->placement_count; ++i)
        if (stage->placements[i].file == file && tree->root != NULL)
            aur_nodes_transform(&nodes, last != NULL ? last->next : tree->root->first_child,
                                &stage->placements[i], aur_xml_is_z_up(shared->document, stage));
}

/* Reads an additional file, as if the main file, `path`, included it at its end. */
static aur_result read_further(reading *shared, const char *path, size_t index) {
    const file_reading from = {.file = path};
    const aur_xml_node *const last = shared->document->tree.root->last_child;
    const aur_result result =
        read_file(shared, shared->options->further[index], &from, shared->document->tree.root);
    if (result == AUR_OK)
        place(shared, index + 1, last);
    return result;
}

/* The sky and luminaires of the options. */
static aur_result add_lights(reading *shared, const char *path) {
    const aur_scene_options *const options = shared->options;
    const bool z_up = shared->document->from_radiance;
    aur_nodes nodes = {
        .tree = &shared->document->tree,
        .variables = &shared->variables,
        .location = {.file = aur_arena_copy(&shared->document->tree.arena, path, strlen(path))},
        .error = shared->error};
    aur_result result = options->sky.model != NULL ? aur_nodes_add_sky(&nodes, &options->sky, z_up) : AUR_OK;
    for (size_t i = 0; i < options->luminaire_count && result == AUR_OK; ++i)
        result = aur_nodes_add_luminaire(&nodes, &options->luminaires[i], z_up);
    return result;
}

/* The camera of a Radiance view in the options replaces the scene's cameras. */
static aur_result replace_camera(reading *shared) {
    const char *const view = shared->options->stage.camera;
    aur_xml_node *const root = shared->document->tree.root;
    aur_nodes nodes = {.tree = &shared->document->tree,
                       .variables = &shared->variables,
                       .location = {.file = "--camera", .line = 1},
                       .error = shared->error};
    if (view == NULL || strncmp(view, "-v", 2) != 0)
        return AUR_OK;
    aur_xml_node *last = NULL;
    for (aur_xml_node *child = root->first_child, *next; child != NULL; child = next) {
        next = child->next;
        const bool is_camera = strcmp(child->tag, "sensor") == 0;
        if (is_camera && last != NULL)
            last->next = next;
        else if (is_camera)
            root->first_child = next;
        else
            last = child;
    }
    root->last_child = last;
    return aur_rad_read_view(&nodes, root, strlen(view), view);
}

/* For files that Radiance scenes reference other than by inclusion. */
static aur_result find_file(void *context, aur_location location, const char *name, char **path,
                            aur_error *error) {
    return aur_xml_find_asset(context, location, name, path, error);
}

aur_result aur_xml_read(const char *path, size_t bytes, const char *data, const aur_scene_options *options,
                        aur_xml_document *document, aur_error *error) {
    aur_error unseen;
    error = error != NULL ? error : &unseen;
    *document = (aur_xml_document){0};
    reading shared = {.document = document,
                      .variables = {.arena = &document->tree.arena},
                      .rad = {.arena = &document->tree.arena,
                              .diffuse = options->diffuse,
                              .light = options->light_modifier,
                              .warnings = &options->warnings,
                              .left_out = &document->left_out,
                              .find = find_file,
                              .context = document},
                      .options = options,
                      .error = error};
    aur_result result = aur_xml_variables_define(&shared.variables, options, error);
    if (result == AUR_OK && options->confine)
        result = aur_xml_confine(document, path, error);
    if (result == AUR_OK)
        result = data != NULL ? read_text(&shared, path, bytes, data, NULL, NULL)
                              : read_file(&shared, path, NULL, NULL);
    if (result == AUR_OK)
        place(&shared, 0, NULL);
    for (size_t i = 0; i < options->further_count && result == AUR_OK; ++i)
        result = read_further(&shared, path, i);
    if (result == AUR_OK)
        result = replace_camera(&shared);
    if (result == AUR_OK)
        result = add_lights(&shared, path);
    if (result == AUR_OK && options->light_modifier != NULL && !shared.rad.has_light)
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_NAME,
                             "no light source of the scene's Radiance files has the material '%s'",
                             options->light_modifier);
    if (result == AUR_OK)
        result = aur_xml_settle_ids(document, error);
    if (result == AUR_OK)
        result = aur_xml_variables_finish(&shared.variables, path, error);
    if (shared.rad.diffuse_count > 0)
        aur_warn_at(&options->warnings, (aur_location){.file = path},
                    "%zu patterns, textures and materials of Radiance are not read: their diffuse part "
                    "replaces them",
                    shared.rad.diffuse_count);
    free(shared.variables.items);
    aur_rad_scene_release(&shared.rad);
    if (result != AUR_OK) {
        aur_warn_error(&options->warnings, &document->left_out);
        aur_xml_release(document);
    }
    return result;
}

void aur_xml_release(aur_xml_document *document) {
    free(document->folders);
    free(document->files);
    free(document->confines);
    aur_model_release_files(&document->model_files);
    aur_xml_tree_release(&document->tree);
    *document = (aur_xml_document){0};
}
