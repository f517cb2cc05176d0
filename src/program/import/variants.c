/* KHR_materials_variants. assimp reads a material only if a primitive refers to it, so the variant's
 * materials are written into the file's text before assimp reads it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/import/gltf.h"

/* The index of the variant with this name; the list's length if there is none. */
static size_t find_variant(const json_value *list, const char *name) {
    const json_value *item = list->first;
    size_t index = 0;
    for (; item != NULL; item = item->next, ++index) {
        const char *const other = json_text(json_member(item, "name"));
        if (other != NULL && strcmp(other, name) == 0)
            break;
    }
    return index;
}

static _Noreturn void fail_unknown(const json_value *list, const char *name) {
    char names[400] = "";
    for (const json_value *item = list->first; item != NULL; item = item->next) {
        const char *const other = json_text(json_member(item, "name"));
        const size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, "%s'%s'", length > 0 ? ", " : "",
                 other != NULL ? other : "");
    }
    stream_fail(AUR_ERROR_FORMAT, "unknown variant '%s': it has %s", name, names);
}

static const json_value *first_of(const json_value *parent, const char *list) {
    const json_value *const found = json_member(parent, list);
    return found != NULL ? found->first : NULL;
}

/* The material of a primitive in a variant; SIZE_MAX: its default material. */
static size_t material_in(const json_value *primitive, size_t variant) {
    const json_value *const extension =
        json_member(json_member(primitive, "extensions"), "KHR_materials_variants");
    for (const json_value *map = first_of(extension, "mappings"); map != NULL; map = map->next)
        for (const json_value *item = first_of(map, "variants"); item != NULL; item = item->next)
            if (json_size(item, SIZE_MAX) == variant)
                return json_size(json_member(map, "material"), SIZE_MAX);
    return SIZE_MAX;
}

/* Copies the bytes up to the primitive's material, then writes the new one. */
static void put_material(const json_value *primitive, size_t material, const char *text, const char *bytes,
                         size_t *from, FILE *to) {
    const json_value *const old = json_member(primitive, "material");
    const bool is_number = old != NULL && old->kind == JSON_NUMBER;
    const size_t at = (size_t)((is_number ? old->source : primitive->source + 1) - text);
    fwrite(bytes + *from, 1, at - *from, to);
    fprintf(to, is_number ? "%zu" : "\"material\":%zu,", material);
    *from = at + (is_number ? strspn(bytes + at, "+-.0123456789eE") : 0);
}

static void put_word(char *bytes, size_t value) {
    for (size_t i = 0; i < 4; ++i)
        bytes[i] = (char)(value >> (8 * i) & 255);
}

void gltf_choose_variant(writer *self, const char *name, model_file *file) {
    const json_value *const list =
        json_member(json_member(json_member(self->gltf, "extensions"), "KHR_materials_variants"), "variants");
    if (list == NULL || list->count == 0) {
        writer_note("it has no variants");
        return;
    }
    const size_t variant = find_variant(list, name);
    if (variant == list->count)
        fail_unknown(list, name);
    size_t size, from = 0;
    char *bytes; /* the bytes as before the parser terminated texts */
    stream_send(AUR_IMPORT_OPEN, 0, strlen(file->name), file->name);
    if (stream_receive(AUR_IMPORT_ANSWER, &size, &bytes) == 0)
        return;
    FILE *const to = open_memstream(&file->bytes, &file->size);
    if (to == NULL)
        stream_fail_memory();
    const char *const start = self->gltf_text; /* offset in the file */
    for (const json_value *mesh = first_of(self->gltf, "meshes"); mesh != NULL; mesh = mesh->next)
        for (const json_value *item = first_of(mesh, "primitives"); item != NULL; item = item->next) {
            const size_t material = material_in(item, variant);
            if (material != SIZE_MAX && item->kind == JSON_OBJECT)
                put_material(item, material, start - self->gltf_head, bytes, &from, to);
        }
    const size_t end = self->gltf_head > 0 ? self->gltf_head + self->gltf_length : size;
    fwrite(bytes + from, 1, end - from, to);
    for (; self->gltf_head > 0 && ftell(to) % 4 != 0;)
        fputc(' ', to);
    const size_t length = (size_t)ftell(to) - self->gltf_head;
    fwrite(bytes + end, 1, size - end, to);
    const bool written = ferror(to) == 0;
    if (fclose(to) != 0 || !written)
        stream_fail_memory();
    free(bytes);
    if (self->gltf_head > 0) { /* a .glb stores its size and that of the JSON at the start */
        put_word(file->bytes + 8, file->size);
        put_word(file->bytes + 12, length);
    }
    gltf_read(self, file);
}
