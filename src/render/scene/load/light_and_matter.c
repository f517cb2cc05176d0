/* Materials, textures, lights and media. */
#include <stdlib.h>
#include <string.h>

#include "render/image/format.h"
#include "render/scene/load/loader.h"

aur_result aur_build_bsdf(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_result result = aur_loader_reserve(self, &scene->bsdfs, scene->bsdf_count, &scene->bsdf_capacity);
    aur_bsdf **const built = scene->bsdfs + scene->bsdf_count;
    if (result == AUR_OK)
        result = aur_bsdf_create(parameters, built, self->error);
    if (result != AUR_OK)
        return result;
    if ((*built)->descriptor->polarizes && !self->said_unpolarized) {
        self->said_unpolarized = true;
        aur_warn_at(self->warnings, parameters->location, "light is unpolarised here: '%s' treats it as such",
                    parameters->plugin);
    }
    *object = *built;
    ++scene->bsdf_count;
    return AUR_OK;
}

/* Replaces an image's `filename` by the path found, unless the image is in a model's memory. */
static aur_result resolve_filename(aur_loader *self, aur_parameters *parameters) {
    for (size_t i = 0; i < parameters->count; ++i) {
        aur_parameter *const item = &parameters->items[i];
        if (strcmp(item->name, "filename") != 0 || item->kind != AUR_PARAMETER_STRING)
            continue;
        if (aur_model_find_file(&self->scene->document.model_files, item->text) != NULL)
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

/* Reports notes of the image reader, and values that were changed. */
static void warn_of_image(const aur_loader *self, const aur_image *image, const char *name) {
    size_t channels[3], found[3] = {0, 0, 0};
    const aur_location where = {.file = name};
    if (aur_image_notes(image)[0] != '\0')
        aur_warn_at(self->warnings, where, "%s", aur_image_notes(image));
    if (image->codes != NULL || !aur_image_color_channels(image, channels))
        return;
    for (size_t i = 0; i < (channels[0] == channels[1] ? 1u : 3u); ++i)
        aur_image_count_odd(image, channels[i], found);
    if (found[0] > 0)
        aur_warn_at(self->warnings, where, "infinite values are read as 65504: %zu", found[0]);
    if (found[1] > 0)
        aur_warn_at(self->warnings, where, "values that are NaN are read as 0: %zu", found[1]);
    if (found[2] > 0)
        aur_warn_at(self->warnings, where,
                    "%zu negative values are read as 0, but as heights of a bumpmap as they are", found[2]);
}

/* The image is passed to its texture as an object. The last image is cached: consecutive textures often use
 * channels of the same image, as in glTF. */
static aur_result add_image(aur_loader *self, aur_parameters *parameters) {
    const aur_parameter *const name = aur_parameters_find(parameters, "filename");
    const bool takes = strcmp(parameters->plugin, "bitmap") == 0 || strcmp(parameters->plugin, "envmap") == 0;
    if (!takes || name == NULL || name->kind != AUR_PARAMETER_STRING)
        return AUR_OK;
    if (self->image == NULL || strcmp(self->image_name, name->text) != 0) {
        aur_loader_drop_image(self);
        self->image_name = strdup(name->text);
        if (self->image_name == NULL)
            return aur_fail_memory(self->error);
        const aur_model_file *const part =
            aur_model_find_file(&self->scene->document.model_files, name->text);
        const aur_result result =
            part != NULL
                ? aur_image_read_memory_coded(part->name, part->size, part->data, &self->image, self->error)
                : aur_image_read_coded(name->text, &self->image, self->error);
        if (result != AUR_OK)
            return result;
        warn_of_image(self, self->image, name->text);
    }
    if (strcmp(parameters->plugin, "envmap") == 0 && aur_image_expand(self->image, self->error) != AUR_OK)
        return AUR_ERROR_MEMORY;
    return aur_parameters_add_object(parameters, "bitmap", "image", self->image, parameters->location,
                                     self->error);
}

void aur_loader_drop_image(aur_loader *self) {
    aur_image_destroy(self->image);
    free(self->image_name);
    self->image = NULL;
    self->image_name = NULL;
}

aur_result aur_build_texture(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_result result = resolve_filename(self, parameters);
    if (result == AUR_OK)
        result = add_image(self, parameters);
    if (result == AUR_OK)
        result = aur_loader_reserve(self, &scene->textures, scene->texture_count, &scene->texture_capacity);
    aur_texture **const built = scene->textures + scene->texture_count;
    if (result == AUR_OK)
        result = aur_texture_create(parameters, scene->texel_pages, built, self->error);
    if (result != AUR_OK)
        return result;
    *object = *built;
    ++scene->texture_count;
    return AUR_OK;
}

aur_result aur_build_emitter(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_result result = resolve_filename(self, parameters);
    if (result == AUR_OK)
        result = add_image(self, parameters);
    if (result == AUR_OK)
        result = aur_loader_reserve(self, &scene->emitters, scene->emitter_count, &scene->emitter_capacity);
    /* A light's exterior medium matters only to paths that start at lights, which are not used with media. */
    void *medium = NULL;
    if (result == AUR_OK)
        result = aur_loader_nested(self, parameters, "medium", &medium);
    aur_emitter **const built = scene->emitters + scene->emitter_count;
    if (result == AUR_OK)
        result = aur_emitter_create(parameters, built, self->error);
    if (strcmp(parameters->plugin, "envmap") == 0)
        aur_loader_drop_image(self); /* environment maps are large */
    if (result != AUR_OK)
        return result;
    *object = *built;
    (*built)->index = (uint32_t)scene->emitter_count++;
    return AUR_OK;
}

aur_result aur_build_volume(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_result result = resolve_filename(self, parameters);
    if (result == AUR_OK)
        result = aur_loader_reserve(self, &scene->volumes, scene->volume_count, &scene->volume_capacity);
    aur_volume **const built = scene->volumes + scene->volume_count;
    if (result == AUR_OK)
        result = aur_volume_create(parameters, built, self->error);
    if (result != AUR_OK)
        return result;
    *object = *built;
    ++scene->volume_count;
    return AUR_OK;
}

aur_result aur_build_phase(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_result result = aur_loader_reserve(self, &scene->phases, scene->phase_count, &scene->phase_capacity);
    aur_phase **const built = scene->phases + scene->phase_count;
    if (result == AUR_OK)
        result = aur_phase_create(parameters, built, self->error);
    if (result != AUR_OK)
        return result;
    *object = *built;
    ++scene->phase_count;
    return AUR_OK;
}

aur_result aur_build_medium(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_result result = aur_loader_reserve(self, &scene->media, scene->medium_count, &scene->medium_capacity);
    aur_medium **const built = scene->media + scene->medium_count;
    if (result == AUR_OK)
        result = aur_medium_create(parameters, built, self->error);
    if (result != AUR_OK)
        return result;
    *object = *built;
    ++scene->medium_count;
    return AUR_OK;
}
