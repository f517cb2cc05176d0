/* Materials, textures and lights. */
#include <stdlib.h>
#include <string.h>

#include "scene/load/loader.h"

aur_result aur_build_bsdf(aur_loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    aur_bsdf *bsdf;
    aur_result result = aur_bsdf_create(parameters, &bsdf, self->error);
    if (result != AUR_OK)
        return result;
    result =
        aur_loader_append(self, &scene->bsdf_count, &scene->bsdf_capacity, (void ***)&scene->bsdfs, bsdf);
    if (result != AUR_OK)
        aur_bsdf_destroy(bsdf);
    *object = bsdf;
    return result;
}

/* A picture's `filename` becomes a path that opens. */
static aur_result resolve_filename(aur_loader *self, aur_parameters *parameters) {
    for (size_t i = 0; i < parameters->count; ++i) {
        aur_parameter *const item = &parameters->items[i];
        if (strcmp(item->name, "filename") != 0 || item->kind != AUR_PARAMETER_STRING)
            continue;
        char *path;
        const aur_result result =
            aur_xml_find_asset(&self->scene->document, item->location, item->text, &path, self->error);
        if (result != AUR_OK)
            return result;
        free(item->text);
        item->text = path;
    }
    return AUR_OK;
}

aur_result aur_build_texture(aur_loader *self, aur_xml_node *node, aur_parameters *parameters,
                             void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    aur_texture *texture;
    aur_result result = resolve_filename(self, parameters);
    if (result == AUR_OK)
        result = aur_texture_create(parameters, &texture, self->error);
    if (result != AUR_OK)
        return result;
    result = aur_loader_append(self, &scene->texture_count, &scene->texture_capacity,
                               (void ***)&scene->textures, texture);
    if (result != AUR_OK)
        aur_texture_destroy(texture);
    *object = texture;
    return result;
}

aur_result aur_build_emitter(aur_loader *self, aur_xml_node *node, aur_parameters *parameters,
                             void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    aur_emitter *emitter;
    aur_result result = resolve_filename(self, parameters);
    if (result == AUR_OK)
        result = aur_emitter_create(parameters, &emitter, self->error);
    if (result != AUR_OK)
        return result;
    result = aur_loader_append(self, &scene->emitter_count, &scene->emitter_capacity,
                               (void ***)&scene->emitters, emitter);
    if (result != AUR_OK) {
        aur_emitter_destroy(emitter);
        return result;
    }
    emitter->index = (uint32_t)(scene->emitter_count - 1);
    *object = emitter;
    return AUR_OK;
}
