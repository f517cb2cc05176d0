/* An object is built when the traversal reaches it or when another object refers to it, whichever comes
 * first. */
#include "render/scene/load/loader.h"

#include <stdio.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/names.h"

/* Maximum nesting and reference depth: the resulting objects are traversed recursively. */
enum { DEEPEST_OBJECT = 100 };

const aur_object_kind *aur_loader_find_kind(const aur_loader *self, const char *tag) {
    for (size_t i = 0; i < self->kind_count; ++i)
        if (strcmp(self->kinds[i].tag, tag) == 0)
            return &self->kinds[i];
    return NULL;
}

/* The nested object with that name, which must be of that kind. */
static aur_result find_nested(aur_loader *self, aur_parameters *parameters, const char *name,
                              const char *kind, void **object) {
    *object = NULL;
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (item->kind != AUR_PARAMETER_OBJECT || strcmp(item->object_kind, kind) != 0)
        return aur_fail_at(self->error, item->location, AUR_ERROR_FORMAT, "%s '%s': '%s' must be a <%s>",
                           parameters->kind, parameters->plugin, name, kind);
    *object = (void *)(uintptr_t)item->object;
    return AUR_OK;
}

aur_result aur_loader_nested(aur_loader *self, aur_parameters *parameters, const char *kind, void **object) {
    return find_nested(self, parameters, kind, kind, object);
}

aur_result aur_loader_medium(aur_loader *self, aur_parameters *parameters, const char *name, void **medium) {
    return find_nested(self, parameters, name, "medium", medium);
}

aur_result aur_loader_reserve(aur_loader *self, void *array, size_t count, size_t *capacity) {
    return aur_array_reserve(array, capacity, count + 1, sizeof(void *)) ? AUR_OK
                                                                         : aur_fail_memory(self->error);
}

/* Whether a nested object has a name that states its role. */
static bool has_name(const char *tag, const aur_parameters *parameters) {
    return strcmp(tag, "texture") == 0 || strcmp(tag, "volume") == 0 ||
           (strcmp(tag, "medium") == 0 && strcmp(parameters->kind, "shape") == 0);
}

/* The parameter name of a nested object: its name, or its kind with its number among objects of that kind
 * ("bsdf", "bsdf2", ...). */
static aur_result nested_name(aur_loader *self, const aur_xml_node *child, const char *tag,
                              const aur_parameters *parameters, char *name, size_t capacity) {
    const char *given = aur_xml_attribute_value(child, "name");
    const bool named = has_name(tag, parameters);
    /* The single texture of a bumpmap or a `scale` may have any name. */
    if (named && strcmp(parameters->plugin, "bumpmap") == 0)
        given = "texture";
    if (named && strcmp(parameters->plugin, "scale") == 0)
        given = "value";
    if (named && given == NULL)
        return aur_xml_fail(child, self->error, "a %s inside an object needs a 'name'", tag);
    size_t count = 1;
    for (size_t i = 0; i < parameters->count; ++i)
        count += parameters->items[i].kind == AUR_PARAMETER_OBJECT &&
                 strcmp(parameters->items[i].object_kind, tag) == 0;
    if (named || count == 1)
        snprintf(name, capacity, "%s", named ? given : tag);
    else
        snprintf(name, capacity, "%s%zu", tag, count);
    return AUR_OK;
}

static const char *id_at(const void *ids, size_t index) {
    return ((const aur_xml_id *)ids)[index].id;
}

static aur_result find_reference(aur_loader *self, const aur_xml_node *node, aur_xml_node **target) {
    static const aur_xml_rule rule = {"ref", 1, {"id", "name"}};
    *target = node->target;
    if (node->target != NULL)
        return AUR_OK;
    const aur_result result = aur_xml_check(node, &rule, self->error);
    if (result != AUR_OK)
        return result;
    const aur_xml_document *const document = &self->scene->document;
    const char *const id = aur_xml_attribute_value(node, "id");
    const aur_xml_id *const found_id = aur_xml_find_id(document, id);
    char hint[AUR_HINT_CAPACITY];
    if (found_id != NULL)
        *target = found_id->node;
    else
        aur_names_hint((aur_names){document->tree.id_count, id_at, document->tree.ids}, id, "''", hint);
    return found_id != NULL
               ? AUR_OK
               : aur_fail_at(self->error, node->location, AUR_ERROR_NAME, "unknown id '%s'%s", id, hint);
}

aur_result aur_loader_find_target(aur_loader *self, aur_xml_node *child, aur_xml_node **target) {
    *target = child;
    const aur_result result = strcmp(child->tag, "ref") == 0 ? find_reference(self, child, target) : AUR_OK;
    if (result != AUR_OK)
        return result;
    const aur_location location = (*target)->location;
    if (aur_loader_find_kind(self, (*target)->tag) == NULL)
        return aur_xml_fail(child, self->error, "<%s> cannot be referenced", (*target)->tag);
    if ((*target)->state == AUR_XML_BUILDING)
        return aur_xml_fail(child, self->error,
                            "this refers to the object at %s:%zu:%zu, which contains it: a cycle",
                            location.file, location.line, location.column);
    return AUR_OK;
}

static aur_result add_nested(aur_loader *self, aur_xml_node *child, aur_parameters *parameters) {
    aur_xml_node *target;
    aur_result result = aur_loader_find_target(self, child, &target);
    if (result != AUR_OK)
        return result;
    /* A group may have a hundred thousand shapes, so it iterates over them itself. */
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

/* Converts all children of a node to parameters. */
static aur_result collect(aur_loader *self, const aur_xml_node *node, aur_parameters *parameters) {
    for (aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        aur_result result;
        if (aur_xml_is_property(child->tag)) {
            result = aur_loader_add_property(self, child, parameters);
        } else if (strcmp(child->tag, "ref") == 0 || aur_loader_find_kind(self, child->tag) != NULL) {
            result = add_nested(self, child, parameters);
        } else {
            static const char *const names[] = {
                "integer",    "float",  "boolean", "string",  "point",   "vector", "rgb",     "spectrum",
                "transform",  "ref",    "bsdf",    "texture", "emitter", "film",   "rfilter", "sampler",
                "integrator", "sensor", "shape",   "medium",  "phase",   "volume"};
            result = aur_xml_fail_tag(child, sizeof names / sizeof names[0], names, self->error);
        }
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

aur_result aur_loader_build(aur_loader *self, aur_xml_node *node) {
    static const aur_xml_rule rule = {"object", 1, {"type", "id", "name"}};
    if (node->state == AUR_XML_BUILT)
        return AUR_OK;
    aur_result result = aur_xml_check(node, &rule, self->error);
    if (result != AUR_OK)
        return result;
    if (self->depth == DEEPEST_OBJECT)
        return aur_xml_fail(node, self->error, "objects refer to each other in a chain of more than %d",
                            DEEPEST_OBJECT);
    node->state = AUR_XML_BUILDING;
    aur_parameters parameters;
    result = aur_parameters_init(&parameters, node->tag, aur_xml_attribute_value(node, "type"),
                                 node->location, self->error);
    if (result != AUR_OK)
        return result;
    ++self->depth;
    result = collect(self, node, &parameters);
    --self->depth;
    self->node = node;
    const aur_object_kind *const kind = aur_loader_find_kind(self, node->tag);
    const aur_row *row = NULL;
    if (result == AUR_OK && kind->table != NULL) {
        aur_table_find(kind->table, &parameters, &row, NULL); /* unknown tags are reported below */
        aur_parameters_ignore(&parameters, row, self->warnings);
    }
    if (result == AUR_OK)
        result = kind->build(self, &parameters, &node->object);
    aur_parameters_release(&parameters);
    node->state = AUR_XML_BUILT;
    return result;
}
