/* Elements that are other elements by another name: they are rewritten before anything is built. A new form
 * is one function and one row of the table. */
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/load/loader.h"
#include "render/scene/load/spectrum.h"

typedef struct form {
    const char *tag, *type; /* type NULL: any */
    aur_result (*rewrite)(aur_nodes *nodes, aur_xml_node *node);
} form;

static void set_type(aur_xml_node *node, const char *type) {
    for (size_t i = 0; i < node->attribute_count; ++i)
        if (strcmp(node->attributes[i].name, "type") == 0)
            node->attributes[i].value = type;
}

static bool has_row(const aur_table *table, const char *name) {
    return aur_names_find(aur_names_of_table(table), name) < table->count;
}

/* In Mitsuba 3 spectra and textures are one kind of plugin. */
static aur_result rewrite_spectrum(aur_nodes *nodes, aur_xml_node *node) {
    (void)nodes;
    const char *const type = aur_xml_attribute_value(node, "type");
    if (type != NULL && !has_row(&aur_spectrum_table, type) && has_row(&aur_texture_table, type))
        node->tag = "texture";
    return AUR_OK;
}

/* --- mixturebsdf of Mitsuba 0.6: blendbsdfs, each of one material and the rest */

typedef struct mixture {
    size_t count; /* of materials */
    double *weights, sum;
    aur_xml_node **parts;
} mixture;

static bool is_bsdf(const aur_xml_node *node) {
    return strcmp(node->tag, "bsdf") == 0 || strcmp(node->tag, "ref") == 0;
}

static aur_result read_mixture(const aur_xml_node *node, mixture *self, aur_error *error) {
    const char *text = "";
    size_t room = 0, count = 0;
    for (aur_xml_node *child = node->first_child; child != NULL; child = child->next)
        ++room;
    self->parts = calloc(room + 1, sizeof *self->parts);
    self->weights = calloc(room + 1, sizeof *self->weights);
    if (self->parts == NULL || self->weights == NULL)
        return aur_fail_memory_at(error, node->location);
    for (aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        const char *const name = aur_xml_attribute_value(child, "name");
        if (is_bsdf(child))
            self->parts[self->count++] = child;
        else if (name != NULL && strcmp(name, "weights") == 0)
            text = aur_xml_attribute_value(child, "value");
        else if (name == NULL || strcmp(name, "ensureEnergyConservation") != 0)
            return aur_xml_fail(child, error,
                                "bsdf 'mixturebsdf': expected 'weights' and nested bsdfs, not <%s>",
                                child->tag);
    }
    text = text != NULL ? text : "";
    count = aur_parse_doubles(text, self->weights, room + 1);
    if (self->count == 0 || count != self->count)
        return aur_xml_fail(node, error,
                            "bsdf 'mixturebsdf': 'weights' must be one number for each of its %zu bsdfs "
                            "(found '%s')",
                            self->count, text);
    for (size_t i = 0; i < count; ++i) {
        if (!(self->weights[i] >= 0.0 && self->weights[i] <= 1e6))
            return aur_xml_fail(node, error,
                                "bsdf 'mixturebsdf': 'weights' must be between 0 and 1 (found '%s')", text);
        self->sum += self->weights[i];
    }
    return AUR_OK;
}

static void add_part(aur_xml_node *parent, aur_xml_node *part) {
    part->next = NULL;
    aur_xml_node_append(parent, part);
}

/* Weights whose sum is above 1 are scaled, as Mitsuba 0.6 does; what the sum lacks is black. */
static aur_result rewrite_mixture(aur_nodes *nodes, aur_xml_node *node) {
    mixture self = {.count = 0};
    const aur_result result = read_mixture(node, &self, nodes->error);
    double rest = self.sum > 1.0 ? self.sum : 1.0;
    set_type(node, "blendbsdf");
    if (result == AUR_OK)
        node->first_child = node->last_child = NULL;
    aur_xml_node *blend = node;
    for (size_t i = 0; i < self.count && result == AUR_OK && nodes->result == AUR_OK; ++i) {
        const double others = rest - self.weights[i];
        nodes->location = self.parts[i]->location;
        aur_node_property(nodes, blend, "float", "weight", "%.17g",
                          rest > 0.0 && others > 0.0 ? others / rest : 0.0);
        add_part(blend, self.parts[i]);
        const bool last = i + 1 == self.count, next_is_last = i + 2 == self.count;
        rest = others;
        if (last || (next_is_last && rest <= self.weights[i + 1])) {
            if (!last)
                add_part(blend, self.parts[++i]);
            else
                aur_node_property(nodes, aur_node_object(nodes, blend, "bsdf", "diffuse"), "float",
                                  "reflectance", "0");
        } else {
            blend = aur_node_object(nodes, blend, "bsdf", "blendbsdf");
        }
    }
    free(self.weights);
    free(self.parts);
    return result == AUR_OK ? nodes->result : result;
}

/* --- the walk */

static const form forms[] = {
    {"spectrum", NULL, rewrite_spectrum},
    {"bsdf", "mixturebsdf", rewrite_mixture},
};

/* The shapes of a `merge` stand in its place. */
static void splice_merge(aur_xml_node *parent, aur_xml_node *before, aur_xml_node *node) {
    const char *const type = aur_xml_attribute_value(node, "type");
    if (strcmp(node->tag, "shape") != 0 || type == NULL || strcmp(type, "merge") != 0)
        return;
    for (const aur_xml_node *child = node->first_child; child != NULL; child = child->next)
        if (strcmp(child->tag, "shape") != 0)
            return;
    if (node->first_child == NULL)
        return;
    if (before != NULL)
        before->next = node->first_child;
    else
        parent->first_child = node->first_child;
    node->last_child->next = node->next;
    if (parent->last_child == node)
        parent->last_child = node->last_child;
}

/* A sensor inside a shape is one of the scene that refers to the shape. */
static void move_sensors(aur_nodes *nodes, aur_xml_node *shape) {
    const char *const type = aur_xml_attribute_value(shape, "type");
    if (strcmp(shape->tag, "shape") != 0 || type == NULL || aur_is_shape_of_shapes(type))
        return;
    aur_xml_node *before = NULL, *next;
    for (aur_xml_node *child = shape->first_child; child != NULL; child = next) {
        next = child->next;
        if (strcmp(child->tag, "sensor") != 0) {
            before = child;
            continue;
        }
        if (before != NULL)
            before->next = next;
        else
            shape->first_child = next;
        if (next == NULL)
            shape->last_child = before;
        nodes->location = child->location;
        aur_node_refer(nodes, child, shape);
        add_part(nodes->tree->root, child);
    }
}

aur_result aur_loader_rewrite(aur_nodes *nodes, aur_xml_node *node) {
    move_sensors(nodes, node);
    aur_result result = nodes->result;
    const char *const type = aur_xml_attribute_value(node, "type");
    for (size_t i = 0; i < sizeof forms / sizeof forms[0] && result == AUR_OK; ++i)
        if (strcmp(forms[i].tag, node->tag) == 0 &&
            (forms[i].type == NULL || (type != NULL && strcmp(forms[i].type, type) == 0)))
            result = forms[i].rewrite(nodes, node);
    aur_xml_node *before = NULL;
    for (aur_xml_node *child = node->first_child; child != NULL && result == AUR_OK; child = child->next) {
        splice_merge(node, before, child);
        child = before != NULL ? before->next : node->first_child;
        result = aur_loader_rewrite(nodes, child);
        before = child;
    }
    return result;
}
