#include "render/scene/load/loader.h"

#include <math.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/transform.h"

aur_result aur_xml_read_triple(const aur_xml_node *node, double missing, double triple[3], aur_error *error) {
    static const char *const axes[] = {"x", "y", "z"};
    const char *const value = aur_xml_attribute_value(node, "value");
    bool given = false;
    for (size_t i = 0; i < 3; ++i) {
        const char *const text = aur_xml_attribute_value(node, axes[i]);
        triple[i] = missing;
        given = given || text != NULL;
        if (text != NULL && !aur_parse_double(text, &triple[i]))
            return aur_xml_fail(node, error, "<%s>: '%s' must be a number, not '%s'", node->tag, axes[i],
                                text);
    }
    if (value == NULL)
        return given ? AUR_OK
                     : aur_xml_fail(node, error, "<%s> needs 'value' or 'x', 'y' and 'z'", node->tag);
    if (given)
        return aur_xml_fail(node, error, "<%s>: give 'value' or 'x', 'y', 'z', not both", node->tag);
    const size_t count = aur_parse_doubles(value, triple, 3);
    if (count == 1)
        triple[2] = triple[1] = triple[0];
    if (count == 1 || count == 3)
        return AUR_OK;
    return aur_xml_fail(node, error, "<%s>: 'value' must be one or three numbers, not '%s'", node->tag,
                        value);
}

static aur_result read_translate(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    double v[3];
    const aur_result result = aur_xml_read_triple(node, 0.0, v, error);
    if (result == AUR_OK)
        *step = aur_transform_translate(v[0], v[1], v[2]);
    return result;
}

static aur_result read_scale(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    double v[3];
    const aur_result result = aur_xml_read_triple(node, 1.0, v, error);
    if (result != AUR_OK)
        return result;
    if (v[0] == 0.0 || v[1] == 0.0 || v[2] == 0.0)
        return aur_xml_fail(node, error, "<scale> must not be 0");
    *step = aur_transform_scale(v[0], v[1], v[2]);
    return AUR_OK;
}

static aur_result read_rotate(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    double axis[3], degrees;
    const char *const text = aur_xml_attribute_value(node, "angle");
    const aur_result result = aur_xml_read_triple(node, 0.0, axis, error);
    if (result != AUR_OK)
        return result;
    if (!aur_parse_double(text, &degrees))
        return aur_xml_fail(node, error, "<rotate>: 'angle' must be degrees, not '%s'", text);
    /* Exporters write a rotation by 0 without an axis. */
    *step = aur_transform_identity();
    if (degrees != 0.0 && !aur_transform_rotate(axis, degrees, step))
        return aur_xml_fail(node, error, "<rotate>: the axis must not be 0 0 0");
    return AUR_OK;
}

static aur_result read_matrix(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    double values[16];
    const size_t count = aur_parse_doubles(aur_xml_attribute_value(node, "value"), values, 16);
    *step = aur_transform_identity();
    if (count != 16 && count != 9)
        return aur_xml_fail(node, error, "<matrix>: 'value' must be 16 numbers, row by row (or 9), not %s",
                            count == SIZE_MAX ? "something that is not a number" : "another count of them");
    const size_t side = count == 16 ? 4 : 3;
    for (size_t i = 0; i < count; ++i)
        step->m[4 * (i / side) + i % side] = values[i];
    return AUR_OK;
}

static aur_result read_look_at(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    static const char *const names[] = {"origin", "target", "up"};
    double v[3][3] = {{0.0}};
    for (size_t i = 0; i < 3; ++i) {
        const char *const text = aur_xml_attribute_value(node, names[i]);
        if (text != NULL && aur_parse_doubles(text, v[i], 3) != 3)
            return aur_xml_fail(node, error, "<%s>: '%s' must be three numbers, not '%s'", node->tag,
                                names[i], text);
    }
    const double *const origin = v[0], *const target = v[1];
    double *const up = v[2];
    if (up[0] == 0.0 && up[1] == 0.0 && up[2] == 0.0) {
        /* Any axis that is not parallel to the view will do. */
        const bool along_z =
            fabs(target[2] - origin[2]) > fabs(target[0] - origin[0]) + fabs(target[1] - origin[1]);
        up[along_z ? 1 : 2] = 1.0;
    }
    if (aur_transform_look_at(origin, target, up, step))
        return AUR_OK;
    return aur_xml_fail(
        node, error, "<lookat>: 'target' must differ from 'origin', and 'up' must not point along the view");
}

typedef struct transform_step {
    aur_xml_rule rule;
    aur_result (*read)(const aur_xml_node *node, aur_transform *step, aur_error *error);
} transform_step;

static const transform_step steps[] = {
    {{"translate", 0, {"value", "x", "y", "z"}}, read_translate},
    {{"scale", 0, {"value", "x", "y", "z"}}, read_scale},
    {{"rotate", 1, {"angle", "value", "x", "y", "z"}}, read_rotate},
    {{"matrix", 1, {"value"}}, read_matrix},
    {{"lookat", 2, {"origin", "target", "up"}}, read_look_at},
};

enum { STEP_COUNT = sizeof steps / sizeof steps[0] };

static aur_result read_step(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    const char *names[STEP_COUNT];
    for (size_t i = 0; i < STEP_COUNT; ++i) {
        names[i] = steps[i].rule.tag;
        if (strcmp(node->tag, names[i]) != 0)
            continue;
        const aur_result result = aur_xml_check(node, &steps[i].rule, error);
        return result == AUR_OK ? steps[i].read(node, step, error) : result;
    }
    return aur_xml_fail_tag(node, STEP_COUNT, names, error);
}

aur_result aur_xml_add_transform(const aur_xml_node *node, aur_parameters *parameters, aur_error *error) {
    aur_transform transform = aur_transform_identity(), step, inverse;
    for (const aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        const aur_result result = read_step(child, &step, error);
        if (result != AUR_OK)
            return result;
        transform = aur_transform_multiply(&step, &transform);
    }
    if (!aur_transform_inverse(&transform, &inverse))
        return aur_xml_fail(node, error, "<transform>: the matrix has no inverse");
    return aur_parameters_add_transform(parameters, aur_xml_attribute_value(node, "name"), transform.m,
                                        node->location, error);
}
