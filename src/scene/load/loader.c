/* An object is built when the walk meets it or when something refers to it, whichever is first. */
#include "scene/load/loader.h"

#include <stdio.h>
#include <string.h>

#include "core/array.h"
#include "core/names.h"
#include "scene/load/properties.h"

/* Objects may stand in or refer to each other this deep; what they become is walked recursively. */
enum { DEEPEST_OBJECT = 100 };

const aur_object_kind *aur_loader_find_kind(const aur_loader *self, const char *tag) {
    for (size_t i = 0; i < self->kind_count; ++i)
        if (strcmp(self->kinds[i].tag, tag) == 0)
            return &self->kinds[i];
    return NULL;
}

aur_result aur_loader_nested(aur_loader *self, aur_parameters *parameters, const char *kind, void **object) {
    *object = NULL;
    const aur_parameter *const item = aur_parameters_find(parameters, kind);
    if (item == NULL)
        return AUR_OK;
    if (item->kind != AUR_PARAMETER_OBJECT || strcmp(item->object_kind, kind) != 0)
        return aur_fail_at(self->error, item->location, AUR_ERROR_FORMAT, "%s '%s': '%s' must be a <%s>",
                           parameters->kind, parameters->plugin, kind, kind);
    *object = (void *)(uintptr_t)item->object;
    return AUR_OK;
}

aur_result aur_loader_append(aur_loader *self, size_t *count, size_t *capacity, void ***items, void *item) {
    if (!aur_array_reserve(items, capacity, *count + 1, sizeof **items))
        return aur_fail_memory(self->error);
    (*items)[(*count)++] = item;
    return AUR_OK;
}

/* The name under which a nested object is asked for: a texture has a name of its own, any other object is
 * called by its kind and its number among its kind ("bsdf", "bsdf2", ...). */
static aur_result nested_name(aur_loader *self, const aur_xml_node *child, const char *tag,
                              const aur_parameters *parameters, char *name, size_t capacity) {
    const char *const given = aur_xml_attribute_value(child, "name");
    if (strcmp(tag, "texture") == 0) {
        if (given == NULL)
            return aur_fail_at(self->error, child->location, AUR_ERROR_FORMAT,
                               "a texture inside an object needs a 'name': what it is for");
        snprintf(name, capacity, "%s", given);
        return AUR_OK;
    }
    size_t count = 1;
    for (size_t i = 0; i < parameters->count; ++i)
        count += parameters->items[i].kind == AUR_PARAMETER_OBJECT &&
                 strcmp(parameters->items[i].object_kind, tag) == 0;
    if (count == 1)
        snprintf(name, capacity, "%s", tag);
    else
        snprintf(name, capacity, "%s%zu", tag, count);
    return AUR_OK;
}

static const char *id_at(const void *ids, size_t index) {
    return ((const aur_xml_id *)ids)[index].id;
}

static aur_result find_reference(aur_loader *self, const aur_xml_node *node, aur_xml_node **target) {
    static const char *const names[] = {"id", "name"};
    const char *id;
    aur_result result = aur_xml_check_attributes(node, 2, names, self->error);
    if (result == AUR_OK)
        result = aur_xml_require(node, "id", &id, self->error);
    if (result != AUR_OK)
        return result;
    const aur_xml_document *const document = &self->scene->document;
    const aur_xml_id *const known = aur_xml_find_id(document, id);
    if (known != NULL) {
        *target = known->node;
        return AUR_OK;
    }
    const char *const nearest = aur_names_nearest((aur_names){document->id_count, id_at, document->ids}, id);
    if (nearest == NULL)
        return aur_fail_at(self->error, node->location, AUR_ERROR_NAME, "there is no object with the id '%s'",
                           id);
    return aur_fail_at(self->error, node->location, AUR_ERROR_NAME,
                       "there is no object with the id '%s'; did you mean '%s'?", id, nearest);
}

aur_result aur_loader_find_target(aur_loader *self, aur_xml_node *child, aur_xml_node **target) {
    *target = child;
    if (strcmp(child->tag, "ref") == 0) {
        const aur_result result = find_reference(self, child, target);
        if (result != AUR_OK)
            return result;
    }
    if (aur_loader_find_kind(self, (*target)->tag) == NULL)
        return aur_fail_at(self->error, child->location, AUR_ERROR_FORMAT, "<%s> is no object to refer to",
                           (*target)->tag);
    if ((*target)->state == AUR_XML_BUILDING)
        return aur_fail_at(self->error, child->location, AUR_ERROR_FORMAT,
                           "this refers to the object at %s:%zu:%zu, which contains it: a cycle",
                           (*target)->location.file, (*target)->location.line, (*target)->location.column);
    return AUR_OK;
}

static aur_result add_nested(aur_loader *self, aur_xml_node *child, aur_parameters *parameters) {
    aur_xml_node *target;
    aur_result result = aur_loader_find_target(self, child, &target);
    if (result != AUR_OK)
        return result;
    /* A group may have a hundred thousand shapes: it goes through them itself. */
    if (strcmp(target->tag, "shape") == 0 && strcmp(parameters->plugin, AUR_GROUP_PLUGIN) == 0)
        return aur_loader_build(self, target);
    const aur_object_kind *const kind = aur_loader_find_kind(self, target->tag);
    char name[96];
    result = nested_name(self, child, kind->tag, parameters, name, sizeof name);
    if (result == AUR_OK)
        result = aur_loader_build(self, target);
    return result != AUR_OK ? result
                            : aur_parameters_add_object(parameters, name, kind->tag, target->object,
                                                        child->location, self->error);
}

/* All that stands inside a node becomes parameters. */
static aur_result collect(aur_loader *self, const aur_xml_node *node, aur_parameters *parameters) {
    for (aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        aur_result result;
        if (aur_xml_is_property(child->tag)) {
            result = aur_xml_add_property(child, parameters, self->error);
        } else if (strcmp(child->tag, "ref") == 0 || aur_loader_find_kind(self, child->tag) != NULL) {
            result = add_nested(self, child, parameters);
        } else {
            static const char *const names[] = {"integer", "float",      "boolean",  "string",    "point",
                                                "vector",  "rgb",        "spectrum", "transform", "ref",
                                                "bsdf",    "texture",    "emitter",  "film",      "rfilter",
                                                "sampler", "integrator", "sensor",   "shape"};
            result = aur_xml_fail_tag(child, sizeof names / sizeof names[0], names, self->error);
        }
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

aur_result aur_loader_build(aur_loader *self, aur_xml_node *node) {
    static const char *const names[] = {"type", "id", "name"};
    if (node->state == AUR_XML_BUILT)
        return AUR_OK;
    const char *type;
    aur_result result = aur_xml_check_attributes(node, 3, names, self->error);
    if (result == AUR_OK)
        result = aur_xml_require(node, "type", &type, self->error);
    if (result != AUR_OK)
        return result;
    if (self->depth == DEEPEST_OBJECT)
        return aur_fail_at(self->error, node->location, AUR_ERROR_FORMAT,
                           "objects refer to each other in a chain of more than %d", DEEPEST_OBJECT);
    node->state = AUR_XML_BUILDING;
    aur_parameters parameters;
    result = aur_parameters_init(&parameters, node->tag, type, node->location, self->error);
    if (result != AUR_OK)
        return result;
    ++self->depth;
    result = collect(self, node, &parameters);
    --self->depth;
    if (result == AUR_OK)
        result = aur_loader_find_kind(self, node->tag)->build(self, node, &parameters, &node->object);
    aur_parameters_release(&parameters);
    node->state = AUR_XML_BUILT;
    return result;
}
