#include "render/scene/importers/nodes/node.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/names.h"
#include "points/base/text.h"

void aur_xml_tree_release(aur_xml_tree *tree) {
    free(tree->ids);
    aur_arena_release(&tree->arena);
    *tree = (aur_xml_tree){0};
}

/* --- reading */

const char *aur_xml_attribute_value(const aur_xml_node *node, const char *name) {
    for (size_t i = 0; i < node->attribute_count; ++i)
        if (strcmp(node->attributes[i].name, name) == 0)
            return node->attributes[i].value;
    return NULL;
}

aur_result aur_xml_fail(const aur_xml_node *node, aur_error *error, const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "%s", text);
}

aur_result aur_xml_check(const aur_xml_node *node, const aur_xml_rule *rule, aur_error *error) {
    aur_names names = aur_names_of(0, rule->names);
    while (rule->names[names.count] != NULL)
        ++names.count;
    for (size_t i = 0; i < node->attribute_count; ++i) {
        const char *const name = node->attributes[i].name;
        char hint[AUR_HINT_CAPACITY];
        if (aur_names_find(names, name) == names.count)
            return aur_fail_at(error, node->location, AUR_ERROR_NAME, "<%s> has no attribute '%s'%s",
                               node->tag, name, aur_names_hint(names, name, "''", hint));
    }
    for (size_t i = 0; i < rule->required; ++i)
        if (aur_xml_attribute_value(node, rule->names[i]) == NULL)
            return aur_xml_fail(node, error, "<%s> needs the attribute '%s'", node->tag, rule->names[i]);
    return AUR_OK;
}

aur_result aur_xml_fail_tag(const aur_xml_node *node, size_t count, const char *const *names,
                            aur_error *error) {
    char hint[AUR_HINT_CAPACITY];
    return aur_fail_at(error, node->location, AUR_ERROR_NAME, "unknown element <%s>%s", node->tag,
                       aur_names_hint(aur_names_of(count, names), node->tag, "<>", hint));
}

/* --- adding: pieces */

aur_xml_node *aur_xml_node_create(aur_xml_tree *tree, const char *tag, aur_location location,
                                  size_t attribute_capacity) {
    aur_xml_node *const node = aur_arena_allocate(&tree->arena, sizeof *node);
    if (node == NULL)
        return NULL;
    *node = (aur_xml_node){.tag = tag, .location = location, .attribute_capacity = attribute_capacity};
    node->attributes = aur_arena_allocate(&tree->arena, attribute_capacity * sizeof *node->attributes);
    return node->attributes != NULL ? node : NULL;
}

void aur_xml_node_append(aur_xml_node *parent, aur_xml_node *node) {
    if (parent->last_child != NULL)
        parent->last_child->next = node;
    else
        parent->first_child = node;
    parent->last_child = node;
}

bool aur_xml_tree_add_id(aur_xml_tree *tree, const char *id, aur_xml_node *node) {
    if (!aur_array_reserve(&tree->ids, &tree->id_capacity, tree->id_count + 1, sizeof *tree->ids))
        return false;
    tree->ids[tree->id_count] = (aur_xml_id){id, node, tree->id_count};
    ++tree->id_count;
    return true;
}

/* --- adding: whole elements */

aur_xml_node *aur_node_add(aur_nodes *nodes, aur_xml_node *parent, const char *tag) {
    enum { MOST_ATTRIBUTES = 3 };
    if (nodes->result != AUR_OK)
        return NULL;
    aur_xml_node *const node = aur_xml_node_create(nodes->tree, tag, nodes->location, MOST_ATTRIBUTES);
    if (node == NULL)
        nodes->result = aur_fail_memory(nodes->error);
    else if (parent != NULL)
        aur_xml_node_append(parent, node);
    else
        nodes->tree->root = node;
    return node;
}

/* `value`: in the arena; NULL: out of memory. */
static void set(aur_nodes *nodes, aur_xml_node *node, const char *name, const char *value) {
    const bool is_id = strcmp(name, "id") == 0 && strcmp(node->tag, "ref") != 0;
    if (value == NULL)
        nodes->result = aur_fail_memory(nodes->error);
    else if (node->attribute_count == node->attribute_capacity)
        nodes->result = aur_xml_fail(node, nodes->error, "<%s> has too many attributes", node->tag);
    else if (is_id && !aur_xml_tree_add_id(nodes->tree, value, node))
        nodes->result = aur_fail_memory(nodes->error);
    else
        node->attributes[node->attribute_count++] = (aur_xml_attribute){name, value};
}

static void set_list(aur_nodes *nodes, aur_xml_node *node, const char *name, const char *format,
                     va_list arguments) {
    if (nodes->result != AUR_OK)
        return;
    char unused[1];
    va_list again;
    va_copy(again, arguments);
    const int length = aur_format_list(unused, sizeof unused, format, arguments);
    char *const value = length >= 0 ? aur_arena_allocate(&nodes->tree->arena, (size_t)length + 1) : NULL;
    if (value != NULL)
        aur_format_list(value, (size_t)length + 1, format, again);
    va_end(again);
    set(nodes, node, name, value);
}

void aur_node_set(aur_nodes *nodes, aur_xml_node *node, const char *name, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    set_list(nodes, node, name, format, arguments);
    va_end(arguments);
}

void aur_node_set_numbers(aur_nodes *nodes, aur_xml_node *node, const char *name, size_t count,
                          const double *numbers) {
    enum { LONGEST = 25 }; /* for "%.17g" and a blank */
    char few[16 * LONGEST + 1];
    if (nodes->result != AUR_OK)
        return;
    char *const text = count <= 16 ? few : malloc(count * LONGEST + 1);
    size_t used = 0;
    if (text != NULL)
        text[0] = '\0';
    for (size_t i = 0; text != NULL && i < count; ++i)
        used += (size_t)aur_format(text + used, LONGEST + 1, i == 0 ? "%.17g" : " %.17g", numbers[i]);
    set(nodes, node, name, text != NULL ? aur_arena_copy(&nodes->tree->arena, text, used) : NULL);
    if (text != few)
        free(text);
}

aur_xml_node *aur_node_object(aur_nodes *nodes, aur_xml_node *parent, const char *tag, const char *type) {
    aur_xml_node *const node = aur_node_add(nodes, parent, tag);
    aur_node_set(nodes, node, "type", "%s", type);
    return node;
}

void aur_node_property(aur_nodes *nodes, aur_xml_node *parent, const char *tag, const char *name,
                       const char *format, ...) {
    aur_xml_node *const node = aur_node_add(nodes, parent, tag);
    va_list arguments;
    va_start(arguments, format);
    aur_node_set(nodes, node, "name", "%s", name);
    set_list(nodes, node, "value", format, arguments);
    va_end(arguments);
}

void aur_node_numbers(aur_nodes *nodes, aur_xml_node *parent, const char *tag, const char *name, size_t count,
                      const double *numbers) {
    aur_xml_node *const node = aur_node_add(nodes, parent, tag);
    aur_node_set(nodes, node, "name", "%s", name);
    aur_node_set_numbers(nodes, node, "value", count, numbers);
}

void aur_node_refer(aur_nodes *nodes, aur_xml_node *parent, aur_xml_node *target) {
    aur_xml_node *const node = aur_node_add(nodes, parent, "ref");
    if (node != NULL)
        node->target = target;
}

const char *aur_node_variable(aur_nodes *nodes, const char *name, const char *otherwise) {
    const char *value = NULL;
    if (nodes->result == AUR_OK)
        nodes->result =
            aur_xml_variables_get(nodes->variables, name, otherwise, nodes->location, &value, nodes->error);
    return value;
}
