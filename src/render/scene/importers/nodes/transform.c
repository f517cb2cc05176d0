/* Transforming everything that one file adds to a scene. */
#include <math.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/importers/nodes/node.h"

typedef struct motion {
    double m[16]; /* row major */
} motion;

static motion motion_of(const aur_scene_placement *placement, bool z_up) {
    const double scale = placement->scale > 0.0 ? placement->scale : 1.0;
    const double angle = placement->turn * 3.14159265358979323846 / 180.0;
    const double c = scale * cos(angle), s = scale * sin(angle);
    const size_t up = z_up ? 2 : 1, first = z_up ? 0 : 2, second = z_up ? 1 : 0;
    motion result = {.m = {[15] = 1.0}};
    result.m[5 * up] = scale;
    result.m[4 * first + first] = result.m[4 * second + second] = c;
    result.m[4 * first + second] = -s;
    result.m[4 * second + first] = s;
    for (size_t d = 0; d < 3; ++d)
        result.m[4 * d + 3] = placement->position[d];
    return result;
}

static bool is_named(const aur_xml_node *node, const char *tag, const char *name) {
    const char *const value = aur_xml_attribute_value(node, "name");
    return strcmp(node->tag, tag) == 0 && value != NULL && strcmp(value, name) == 0;
}

/* The value of <point name="position"> or <vector name="direction">. */
static void move_value(aur_nodes *nodes, aur_xml_node *node, const motion *by, bool point) {
    for (size_t i = 0; i < node->attribute_count; ++i) {
        double from[3], to[3];
        if (strcmp(node->attributes[i].name, "value") != 0 ||
            aur_parse_doubles(node->attributes[i].value, from, 3) != 3)
            continue;
        for (size_t d = 0; d < 3; ++d)
            to[d] = by->m[4 * d] * from[0] + by->m[4 * d + 1] * from[1] + by->m[4 * d + 2] * from[2] +
                    (point ? by->m[4 * d + 3] : 0.0);
        node->attribute_count = 0; /* and has capacity for it */
        aur_node_set(nodes, node, "name", "%s", point ? "position" : "direction");
        aur_node_set_numbers(nodes, node, "value", 3, to);
        return;
    }
}

static void move(aur_nodes *nodes, aur_xml_node *object, const motion *by) {
    aur_xml_node *to_world = NULL;
    bool moved = false;
    for (aur_xml_node *child = object->first_child; child != NULL; child = child->next) {
        if (is_named(child, "transform", "to_world") || is_named(child, "transform", "toWorld"))
            to_world = child;
        const bool point = is_named(child, "point", "position");
        if (strcmp(object->tag, "emitter") == 0 && (point || is_named(child, "vector", "direction"))) {
            move_value(nodes, child, by, point);
            moved = true;
        }
    }
    if (moved)
        return;
    if (to_world == NULL) {
        to_world = aur_node_add(nodes, object, "transform");
        aur_node_set(nodes, to_world, "name", "to_world");
    }
    aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "matrix"), "value", 16, by->m);
}

void aur_nodes_transform(aur_nodes *nodes, aur_xml_node *first, const aur_scene_placement *placement,
                         bool z_up) {
    static const char *const moved[] = {"shape", "emitter", "sensor"};
    const motion by = motion_of(placement, z_up);
    for (aur_xml_node *node = first; node != NULL; node = node->next) {
        const char *const type = aur_xml_attribute_value(node, "type");
        if (type == NULL || strcmp(type, "shapegroup") == 0 || strcmp(type, "constant") == 0)
            continue;
        for (size_t i = 0; i < sizeof moved / sizeof moved[0]; ++i)
            if (strcmp(node->tag, moved[i]) == 0)
                move(nodes, node, &by);
    }
}
