#include "render/scene/importers/model/import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "points/base/array.h"
#include "points/base/file.h"
#include "points/base/io.h"
#include "points/base/text.h"

enum { MOST_REQUESTS = 100000, MOST_NOTES = 100, LONGEST_NAME = 4096 };

typedef struct message {
    aur_import_kind kind;
    uint32_t value;
    size_t size;
    char *data; /* malloc'ed, with a zero byte after it */
} message;

typedef struct conversation {
    aur_child *child; /* on rank 0; NULL on others */
    const aur_model_source *source;
    aur_model_files *files;
    size_t first; /* number of this model's first file */
    size_t requests, notes, images;
    aur_named_files named;
    uint64_t received; /* bytes */
    aur_nodes *nodes;
    aur_xml_node *parent;
    aur_error *error;
} conversation;

/* --- messages, which rank 0 broadcasts */

static aur_result receive_here(conversation *self, message *got) {
    aur_import_header header = {0};
    if (!aur_child_receive(self->child, sizeof header, &header))
        return aur_child_fail(self->child, self->source->location, self->error);
    self->received += header.size < UINT64_MAX / 2 ? header.size : UINT64_MAX / 2;
    if (self->received > aur_child_memory(self->child))
        return aur_fail_at(self->error, self->source->location, AUR_ERROR_FORMAT,
                           "this model cannot be read: assimp makes more than %llu bytes of it",
                           (unsigned long long)aur_child_memory(self->child));
    if (!aur_child_receive_all(self->child, header.size, &got->data))
        return aur_child_fail(self->child, self->source->location, self->error);
    got->kind = header.kind;
    got->value = header.value;
    got->size = (size_t)header.size;
    return AUR_OK;
}

/* An error on one rank is reported on all. */
static aur_result agree(aur_error *error, aur_result result) {
    aur_error failure = {0};
    const aur_result heard = aur_io_agree(sizeof result, &result, &failure);
    if (result != AUR_OK)
        (void)aur_io_agree(sizeof *error, error, NULL);
    else if (heard != AUR_OK)
        *error = failure;
    return result != AUR_OK ? result : heard;
}

static aur_result receive(conversation *self, message *got) {
    *got = (message){0};
    const aur_io *const io = aur_io_here();
    aur_result result = agree(self->error, self->child != NULL ? receive_here(self, got) : AUR_OK);
    if (io == NULL || result != AUR_OK)
        return result;
    (void)aur_io_agree(sizeof got->kind, &got->kind, NULL);
    (void)aur_io_agree(sizeof got->value, &got->value, NULL);
    result = io->share(io->user, &got->data, &got->size, self->error);
    return result;
}

static aur_result send(conversation *self, aur_import_kind kind, uint32_t value, size_t size,
                       const void *data) {
    const aur_import_header header = {kind, value, size};
    aur_result result = AUR_OK;
    if (self->child != NULL &&
        (!aur_child_send(self->child, sizeof header, &header) || !aur_child_send(self->child, size, data)))
        result = aur_child_fail(self->child, self->source->location, self->error);
    return agree(self->error, result);
}

/* --- requests of the program */

static aur_result answer_open(conversation *self, const message *got) {
    const aur_model_source *const source = self->source;
    char *data = NULL, *used = NULL;
    size_t size = source->size;
    const bool is_model = strcmp(got->data, source->name) == 0;
    aur_result result =
        is_model ? AUR_OK : aur_named_read_part(&self->named, got->data, &used, &size, &data, self->error);
    const bool found = is_model || data != NULL;
    if (result == AUR_OK && found && self->child != NULL)
        aur_child_grant(self->child, size);
    if (result == AUR_OK)
        result = send(self, AUR_IMPORT_ANSWER, found, found ? size : 0, is_model ? source->data : data);
    free(data);
    free(used);
    return result;
}

static aur_result answer_find(conversation *self, const message *got) {
    char *used;
    aur_result result = aur_named_find_image(&self->named, got->data, &used, self->error);
    if (result == AUR_OK)
        result = send(self, AUR_IMPORT_ANSWER, used != NULL, used != NULL ? strlen(used) : 0, used);
    free(used);
    return result;
}

/* --- results of the program */

static aur_result add_part(conversation *self, message *got) {
    aur_model_files *const files = self->files;
    const char *const kind = got->kind == AUR_IMPORT_MESH ? "mesh" : "image";
    char text[512];
    snprintf(text, sizeof text, "%s, %s %zu", self->source->name, kind, files->count - self->first + 1);
    char *const name = strdup(text);
    if (name == NULL ||
        !aur_array_reserve(&files->items, &files->capacity, files->count + 1, sizeof *files->items)) {
        free(name);
        return aur_fail_memory_at(self->error, self->source->location);
    }
    files->items[files->count++] = (aur_model_file){name, got->size, got->data};
    got->data = NULL;
    return AUR_OK;
}

static aur_result take_image(conversation *self, message *got) {
    char name[32];
    snprintf(name, sizeof name, "image %zu", ++self->images);
    const bool good = aur_named_is_image(&self->named, name, got->size, got->data);
    const aur_result result = good ? add_part(self, got) : AUR_OK;
    return result == AUR_OK ? send(self, AUR_IMPORT_ANSWER, good, 0, NULL) : result;
}

static aur_result fail_damaged(const conversation *self) {
    return aur_fail_at(self->error, self->source->location, AUR_ERROR_FORMAT,
                       "this model cannot be read: what assimp makes of it is damaged");
}

static aur_result take_scene(conversation *self, const message *got) {
    aur_import_camera camera;
    if (got->size < sizeof camera)
        return fail_damaged(self);
    memcpy(&camera, got->data, sizeof camera);
    if (!aur_node_records_read(self->nodes, self->parent, got->size - sizeof camera,
                               got->data + sizeof camera))
        return self->nodes->result != AUR_OK ? self->nodes->result : fail_damaged(self);
    aur_named_warn(&self->named);
    return self->source->stage != NULL ? aur_model_surround(self->source, &camera, self->nodes, self->parent)
                                       : AUR_OK;
}

/* --- the protocol */

/* Texts from the program may contain whatever the file contains. */
static void clean_text(message *got) {
    for (size_t i = 0; i < got->size; ++i)
        if ((unsigned char)got->data[i] < 32 || got->data[i] == 127)
            got->data[i] = got->data[i] == '\n' && i + 1 < got->size ? ' ' : '\0';
}

static aur_result take_fail(conversation *self, message *got) {
    const aur_result result = got->value == -AUR_ERROR_MEMORY ? AUR_ERROR_MEMORY : AUR_ERROR_FORMAT;
    clean_text(got);
    return aur_fail_at(self->error, self->source->location, result, "this model cannot be read: %s",
                       got->data);
}

static aur_result take(conversation *self, message *got, bool *over) {
    switch (got->kind) {
    case AUR_IMPORT_OPEN:
    case AUR_IMPORT_FIND:
        if (++self->requests > MOST_REQUESTS || got->size == 0 || got->size > LONGEST_NAME ||
            strlen(got->data) != got->size)
            return fail_damaged(self);
        return got->kind == AUR_IMPORT_OPEN ? answer_open(self, got) : answer_find(self, got);
    case AUR_IMPORT_MESH:
        return add_part(self, got);
    case AUR_IMPORT_IMAGE:
        return take_image(self, got);
    case AUR_IMPORT_NOTE:
        clean_text(got);
        if (++self->notes <= MOST_NOTES)
            aur_warn_at(self->source->warnings, self->source->location, "%s", got->data);
        return AUR_OK;
    case AUR_IMPORT_FAIL:
        return take_fail(self, got);
    case AUR_IMPORT_SCENE:
        *over = true;
        return take_scene(self, got);
    default:
        return fail_damaged(self);
    }
}

static aur_result start(conversation *self) {
    const aur_model_source *const source = self->source;
    const size_t version = strlen(aur_version()) + 1, name = strlen(source->name) + 1;
    char time[32] = "";
    if (source->time != NULL)
        aur_format(time, sizeof time, "%.17g", *source->time);
    const char *const variant = source->variant != NULL ? source->variant : "";
    const size_t size = version + name + strlen(time) + 1 + strlen(variant) + 1;
    char *const text = malloc(size);
    if (text == NULL)
        return aur_fail_memory_at(self->error, source->location);
    memcpy(text, aur_version(), version);
    memcpy(text + version, source->name, name);
    memcpy(text + version + name, time, strlen(time) + 1);
    memcpy(text + version + name + strlen(time) + 1, variant, strlen(variant) + 1);
    const aur_result result = send(self, AUR_IMPORT_START, (uint32_t)self->first, size, text);
    free(text);
    return result;
}

aur_result aur_model_converse(aur_child *child, const aur_model_source *source, aur_model_files *files,
                              aur_nodes *nodes, aur_xml_node *parent) {
    conversation self = {.child = child,
                         .source = source,
                         .named = {.source = source},
                         .files = files,
                         .first = files->count,
                         .nodes = nodes,
                         .parent = parent,
                         .error = nodes->error};
    bool over = false;
    aur_result result = start(&self);
    while (result == AUR_OK && !over) {
        message got;
        result = receive(&self, &got);
        if (result == AUR_OK)
            result = take(&self, &got, &over);
        free(got.data);
    }
    if (child != NULL)
        aur_child_end(child);
    return result;
}

/* --- starting the program */

enum { PATH_CAPACITY = 4096 };

static aur_result find_program(const aur_model_source *source, char path[PATH_CAPACITY], aur_error *error) {
    const char *const named = getenv("AUREOLE_IMPORT");
    if (named != NULL ? snprintf(path, PATH_CAPACITY, "%s", named) < PATH_CAPACITY
                      : aur_module_find_program("aureole-import", PATH_CAPACITY, path))
        return AUR_OK;
    return aur_fail_at(error, source->location, AUR_ERROR_UNSUPPORTED,
                       "models in this format are read by the library assimp, which this build does not "
                       "have: install libassimp-dev and build again, or convert the model to Mitsuba's XML");
}

aur_result aur_model_import(const aur_model_source *source, aur_model_files *files, aur_nodes *nodes,
                            aur_xml_node *parent) {
    aur_error *const error = nodes->error;
    aur_child child;
    char path[PATH_CAPACITY];
    const bool here = aur_io_leads();
    aur_result result = here ? find_program(source, path, error) : AUR_OK;
    if (here && result == AUR_OK)
        result = aur_fail_in(error, aur_child_start(&child, path, &source->progress, error),
                             source->location.file);
    result = agree(error, result);
    if (result == AUR_OK)
        result = aur_model_converse(here ? &child : NULL, source, files, nodes, parent);
    return result;
}
