/* Shapes, groups of them and the groups' instances. */
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "render/scene/load/loader.h"

/* The type of instances. Instances are aur_instance objects and groups aur_shape_group objects, not
 * aur_shape. */
static const char *const instance_plugin = "instance";

bool aur_is_shape_of_shapes(const char *plugin) {
    return strcmp(plugin, AUR_GROUP_PLUGIN) == 0 || strcmp(plugin, instance_plugin) == 0;
}

/* Default material: grey, or black for emitters. */
static aur_result default_bsdf(aur_loader *self, bool light, const aur_bsdf **bsdf) {
    const aur_bsdf **const cached = light ? &self->black_bsdf : &self->default_bsdf;
    *bsdf = *cached;
    if (*cached != NULL)
        return AUR_OK;
    aur_parameters parameters;
    aur_result result = aur_parameters_init(&parameters, "bsdf", "diffuse", (aur_location){0}, self->error);
    if (result != AUR_OK)
        return result;
    void *object = NULL;
    result = aur_parameters_add_text(&parameters, AUR_PARAMETER_FLOAT, "reflectance", light ? "0" : "0.5",
                                     (aur_location){0}, self->error);
    if (result == AUR_OK)
        result = aur_build_bsdf(self, &parameters, &object);
    *bsdf = *cached = object;
    aur_parameters_release(&parameters);
    return result;
}

static aur_result add_to_group(aur_loader *self, aur_shape_group *group, const aur_xml_node *child,
                               const aur_xml_node *target) {
    const char *const plugin = aur_xml_attribute_value(target, "type");
    aur_shape *const shape = target->object;
    if (strcmp(plugin, AUR_GROUP_PLUGIN) == 0 || strcmp(plugin, instance_plugin) == 0 || shape->grouped)
        return aur_xml_fail(child, self->error,
                            "a shapegroup takes shapes only, no instances or other groups");
    if (shape->emitter != AUR_NO_EMITTER)
        return aur_fail_at(self->error, child->location, AUR_ERROR_UNSUPPORTED,
                           "a shape in a shapegroup cannot be a light");
    shape->grouped = true;
    group->shapes[group->count++] = shape->index;
    return AUR_OK;
}

/* <shape type="shapegroup">: its shapes are visible through instances only. */
static aur_result build_group(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_result result = aur_loader_reserve(self, &scene->groups, scene->group_count, &scene->group_capacity);
    aur_shape_group *const group = calloc(1, sizeof *group);
    if (result != AUR_OK || group == NULL) {
        free(group);
        return aur_fail_memory(self->error);
    }
    scene->groups[scene->group_count++] = *object = group;
    size_t capacity = 0;
    for (aur_xml_node *child = self->node->first_child; child != NULL; child = child->next) {
        aur_xml_node *target;
        if (aur_xml_is_property(child->tag))
            continue;
        if (!aur_array_reserve(&group->shapes, &capacity, group->count + 1, sizeof *group->shapes))
            return aur_fail_memory(self->error);
        result = aur_loader_find_target(self, child, &target);
        if (result == AUR_OK && strcmp(target->tag, "shape") == 0)
            result = add_to_group(self, group, child, target);
        if (result != AUR_OK)
            return result;
    }
    if (group->count == 0)
        return aur_xml_fail(self->node, self->error, "a shapegroup needs a shape");
    return aur_parameters_finish(parameters, self->error);
}

static const aur_key instance_keys[] = {
    {AUR_KEY_OF_TRANSFORM(aur_instance, "to_world", to_world, "group to world")},
};

static aur_result build_instance(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    void *group;
    aur_result result =
        aur_loader_reserve(self, &scene->instances, scene->instance_count, &scene->instance_capacity);
    aur_instance *const instance = calloc(1, sizeof *instance);
    if (result != AUR_OK || instance == NULL) {
        free(instance);
        return aur_fail_memory(self->error);
    }
    scene->instances[scene->instance_count++] = *object = instance;
    instance->location = parameters->location;
    result = aur_loader_nested(self, parameters, "shape", &group);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < scene->group_count; ++i)
        if (scene->groups[i] == group)
            instance->group = scene->groups[i];
    if (instance->group == NULL)
        return aur_parameters_fail(parameters, self->error, AUR_ERROR_FORMAT,
                                   "it needs a reference to a shapegroup");
    result = aur_keys_read(sizeof instance_keys / sizeof instance_keys[0], instance_keys, parameters,
                           instance, self->error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &instance->to_world, &instance->to_local, self->error);
    return result == AUR_OK ? aur_parameters_finish(parameters, self->error) : result;
}

static aur_result use_attribute(aur_loader *self, aur_shape *shape, const char *name) {
    bool found = true;
    const aur_result result =
        name != NULL ? aur_shape_use_attribute(shape, name, &found, self->error) : AUR_OK;
    return found ? result
                 : aur_xml_fail(self->node, self->error,
                                "shape '%s' has no attribute '%s', which a texture reads",
                                shape->descriptor->row.name, name);
}

/* Stores the mesh attributes that the shape's material or light reads. */
static aur_result take_attributes(aur_loader *self, aur_shape *shape, const aur_emitter *emitter) {
    const aur_texture *const radiance = emitter != NULL ? emitter->radiance.texture : NULL;
    if (radiance != NULL && radiance->attributes.position)
        return aur_fail_at(self->error, emitter->location, AUR_ERROR_UNSUPPORTED,
                           "emitter 'area': its radiance cannot be a texture 'volume'");
    aur_attributes read = shape->bsdf->attributes;
    if (radiance != NULL)
        aur_attributes_add(&read, &radiance->attributes);
    if (read.too_many)
        return aur_fail_at(self->error, shape->location, AUR_ERROR_UNSUPPORTED,
                           "shape '%s': its textures read more than one attribute of vertices, or of faces",
                           shape->descriptor->row.name);
    aur_result result = use_attribute(self, shape, read.vertex);
    if (result == AUR_OK)
        result = use_attribute(self, shape, read.face);
    aur_shape_release_attributes(shape);
    return result;
}

aur_result aur_build_shape(aur_loader *self, aur_parameters *parameters, void **object) {
    if (strcmp(parameters->plugin, AUR_GROUP_PLUGIN) == 0)
        return build_group(self, parameters, object);
    if (strcmp(parameters->plugin, instance_plugin) == 0)
        return build_instance(self, parameters, object);
    aur_scene *const scene = self->scene;
    void *found = NULL;
    aur_result result = aur_loader_nested(self, parameters, "emitter", &found);
    aur_emitter *emitter = found;
    if (result == AUR_OK)
        result = aur_loader_nested(self, parameters, "bsdf", &found);
    const aur_bsdf *bsdf = found;
    if (result == AUR_OK && bsdf == NULL)
        result = default_bsdf(self, emitter != NULL, &bsdf);
    if (result == AUR_OK && emitter != NULL && emitter->descriptor->is_far)
        result = aur_fail_at(self->error, emitter->location, AUR_ERROR_FORMAT,
                             "emitter '%s' is not allowed inside a shape", emitter->descriptor->row.name);
    if (emitter != NULL &&
        !emitter->descriptor->needs_shape) /* the position of a spot comes from its to_world */
        emitter = NULL;
    if (result == AUR_OK && emitter != NULL && emitter->shape != UINT32_MAX)
        result =
            aur_xml_fail(self->node, self->error, "the emitter of this shape already belongs to another one");
    void *interior = NULL, *exterior = NULL;
    if (result == AUR_OK)
        result = aur_loader_medium(self, parameters, "interior", &interior);
    if (result == AUR_OK)
        result = aur_loader_medium(self, parameters, "exterior", &exterior);
    if (result == AUR_OK)
        result = aur_loader_reserve(self, &scene->shapes, scene->shape_count, &scene->shape_capacity);
    if (result != AUR_OK)
        return result;
    aur_shape **const built = scene->shapes + scene->shape_count;
    result = aur_shape_create(parameters, &scene->document, built, self->error);
    if (result != AUR_OK)
        return result;
    *object = *built;
    const char *const id = aur_xml_attribute_value(self->node, "id");
    (*built)->name = id != NULL ? id : aur_xml_attribute_value(self->node, "name");
    (*built)->bsdf = bsdf;
    (*built)->interior = interior;
    (*built)->exterior = exterior;
    (*built)->bounds_media = interior != NULL || exterior != NULL;
    (*built)->index = (uint32_t)scene->shape_count++;
    if (emitter != NULL) {
        emitter->shape = (*built)->index;
        (*built)->emitter = emitter->index;
    }
    return take_attributes(self, *built, emitter);
}
