/* Elements that are equivalent to other elements: they are rewritten before anything is built. To add one:
 * one function and one row of the table. */
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/image/format.h"
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

/* --- mixturebsdf of Mitsuba 0.6: nested blendbsdfs, each of one material and the rest */

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

/* Weights that sum to more than 1 are scaled, as in Mitsuba 0.6; the remainder of a smaller sum is black. */
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

/* --- elements and types of Mitsuba 0.6 with an equivalent */

static void set_value(aur_nodes *nodes, aur_xml_node *node, const double rgb[3]) {
    char text[96];
    aur_format(text, sizeof text, "%.17g %.17g %.17g", rgb[0], rgb[1], rgb[2]);
    const char *const copy = aur_arena_copy(&nodes->tree->arena, text, strlen(text));
    if (copy == NULL)
        nodes->result = aur_fail_memory_at(nodes->error, node->location);
    for (size_t i = 0; copy != NULL && i < node->attribute_count; ++i)
        if (strcmp(node->attributes[i].name, "value") == 0)
            node->attributes[i].value = copy;
}

/* "#rrggbb": false for other texts. */
static bool read_hexadecimal(const char *text, double rgb[3]) {
    if (text == NULL || text[0] != '#' || strlen(text) != 7 ||
        strspn(text + 1, "0123456789abcdefABCDEF") != 6)
        return false;
    const unsigned long code = strtoul(text + 1, NULL, 16);
    for (size_t i = 0; i < 3; ++i)
        rgb[i] = (double)(code >> (16 - 8 * i) & 255) / 255.0;
    return true;
}

/* Mitsuba 0.6 reads the hexadecimal digits of <rgb> as linear values, those of <srgb> as sRGB-encoded. */
static aur_result rewrite_rgb(aur_nodes *nodes, aur_xml_node *node) {
    double rgb[3];
    if (read_hexadecimal(aur_xml_attribute_value(node, "value"), rgb))
        set_value(nodes, node, rgb);
    return nodes->result;
}

static aur_result rewrite_srgb(aur_nodes *nodes, aur_xml_node *node) {
    const char *const value = aur_xml_attribute_value(node, "value");
    double rgb[3] = {0.0, 0.0, 0.0};
    const size_t count = value == NULL                  ? 0
                         : read_hexadecimal(value, rgb) ? 3
                                                        : aur_parse_doubles(value, rgb, 3);
    if (count != 1 && count != 3)
        return aur_xml_fail(node, nodes->error, "<srgb> needs a 'value' of one or three numbers, or #rrggbb");
    for (size_t i = 3; i-- > 0;)
        rgb[i] = aur_srgb_decode(rgb[count == 1 ? 0 : i]);
    node->tag = "rgb";
    set_value(nodes, node, rgb);
    return nodes->result;
}

/* <blackbody name temperature="5000K">: <spectrum type="blackbody">. */
static aur_result rewrite_blackbody(aur_nodes *nodes, aur_xml_node *node) {
    static const aur_xml_rule rule = {"blackbody", 2, {"name", "temperature"}};
    const aur_result result = aur_xml_check(node, &rule, nodes->error);
    if (result != AUR_OK)
        return result;
    const char *const temperature = aur_xml_attribute_value(node, "temperature");
    const size_t length = strcspn(temperature, "Kk");
    for (size_t i = 0; i < node->attribute_count; ++i)
        if (strcmp(node->attributes[i].name, "temperature") == 0)
            node->attributes[i] = (aur_xml_attribute){"type", "blackbody"};
    node->tag = "spectrum";
    nodes->location = node->location;
    aur_node_property(nodes, node, "float", "temperature", "%.*s", (int)length, temperature);
    return nodes->result;
}

static aur_result rewrite_vertexcolors(aur_nodes *nodes, aur_xml_node *node) {
    set_type(node, "mesh_attribute");
    nodes->location = node->location;
    aur_node_property(nodes, node, "string", "name", "vertex_color");
    return nodes->result;
}

static aur_result rewrite_type(aur_nodes *nodes, aur_xml_node *node) {
    static const char *const pairs[][2] = {{"tiledhdrfilm", "hdrfilm"}, {"volpath_simple", "volpath"}};
    const char *const type = aur_xml_attribute_value(node, "type");
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; ++i)
        if (strcmp(type, pairs[i][0]) == 0)
            set_type(node, pairs[i][1]);
    return nodes->result;
}

/* --- the walk */

static const form forms[] = {
    {"spectrum", NULL, rewrite_spectrum},
    {"bsdf", "mixturebsdf", rewrite_mixture},
    {"rgb", NULL, rewrite_rgb},
    {"srgb", NULL, rewrite_srgb},
    {"blackbody", NULL, rewrite_blackbody},
    {"texture", "vertexcolors", rewrite_vertexcolors},
    {"film", "tiledhdrfilm", rewrite_type},
    {"integrator", "volpath_simple", rewrite_type},
};

/* Replaces a `merge` by its shapes. */
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

/* Moves a sensor from inside a shape to the scene, with a reference to the shape. */
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
