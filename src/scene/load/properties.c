#include "scene/load/properties.h"

#include <stdio.h>
#include <string.h>

#include "core/text.h"
#include "scene/transform.h"

typedef struct property {
    const char *tag;
    aur_parameter_kind kind;
} property;

static const property properties[] = {
    {"integer", AUR_PARAMETER_INTEGER},     {"float", AUR_PARAMETER_FLOAT},
    {"boolean", AUR_PARAMETER_BOOLEAN},     {"string", AUR_PARAMETER_STRING},
    {"point", AUR_PARAMETER_VECTOR},        {"vector", AUR_PARAMETER_VECTOR},
    {"rgb", AUR_PARAMETER_COLOR},           {"spectrum", AUR_PARAMETER_COLOR},
    {"transform", AUR_PARAMETER_TRANSFORM},
};

enum { PROPERTY_COUNT = sizeof properties / sizeof properties[0] };

static const property *find(const char *tag) {
    for (size_t i = 0; i < PROPERTY_COUNT; ++i)
        if (strcmp(properties[i].tag, tag) == 0)
            return &properties[i];
    return NULL;
}

bool aur_xml_is_property(const char *tag) {
    return find(tag) != NULL;
}

aur_result aur_xml_fail_tag(const aur_xml_node *node, size_t count, const char *const *names,
                            aur_error *error) {
    static const char *const refused[] = {"medium", "phase", "volume"};
    for (size_t i = 0; i < 3; ++i)
        if (strcmp(node->tag, refused[i]) == 0)
            return aur_fail_at(error, node->location, AUR_ERROR_UNSUPPORTED,
                               "<%s>: Aureole renders surfaces only, no participating media", node->tag);
    const char *const nearest = aur_nearest_name(node->tag, count, names);
    if (nearest != NULL)
        return aur_fail_at(error, node->location, AUR_ERROR_NAME, "unknown element <%s>; did you mean <%s>?",
                           node->tag, nearest);
    return aur_fail_at(error, node->location, AUR_ERROR_NAME, "unknown element <%s>", node->tag);
}

/* Three numbers from `value`, or from x, y, z, of which the missing ones are `missing`. */
static aur_result read_triple(const aur_xml_node *node, double missing, double triple[3], aur_error *error) {
    static const char *const axes[] = {"x", "y", "z"};
    const char *const value = aur_xml_attribute_value(node, "value");
    size_t given = 0;
    for (size_t i = 0; i < 3; ++i) {
        const char *const text = aur_xml_attribute_value(node, axes[i]);
        triple[i] = missing;
        if (text == NULL)
            continue;
        ++given;
        if (!aur_parse_double(text, &triple[i]))
            return aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                               "<%s>: '%s' must be a number, not '%s'", node->tag, axes[i], text);
    }
    if (value == NULL) {
        if (given > 0)
            return AUR_OK;
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "<%s> needs 'value' or 'x', 'y' and 'z'",
                           node->tag);
    }
    if (given > 0)
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                           "<%s>: give 'value' or 'x', 'y', 'z', not both", node->tag);
    const size_t count = aur_parse_doubles(value, triple, 3);
    if (count == 1)
        triple[2] = triple[1] = triple[0];
    if (count == 1 || count == 3)
        return AUR_OK;
    return aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                       "<%s>: 'value' must be one or three numbers, not '%s'", node->tag, value);
}

static aur_result read_named_triple(const aur_xml_node *node, const char *name, double triple[3],
                                    aur_error *error) {
    const char *text;
    const aur_result result = aur_xml_require(node, name, &text, error);
    if (result != AUR_OK)
        return result;
    if (aur_parse_doubles(text, triple, 3) == 3)
        return AUR_OK;
    return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "<%s>: '%s' must be three numbers, not '%s'",
                       node->tag, name, text);
}

static aur_result read_translate(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    static const char *const names[] = {"value", "x", "y", "z"};
    double v[3];
    aur_result result = aur_xml_check_attributes(node, 4, names, error);
    if (result == AUR_OK)
        result = read_triple(node, 0.0, v, error);
    if (result == AUR_OK)
        *step = aur_transform_translate(v[0], v[1], v[2]);
    return result;
}

static aur_result read_scale(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    static const char *const names[] = {"value", "x", "y", "z"};
    double v[3];
    aur_result result = aur_xml_check_attributes(node, 4, names, error);
    if (result == AUR_OK)
        result = read_triple(node, 1.0, v, error);
    if (result != AUR_OK)
        return result;
    if (v[0] == 0.0 || v[1] == 0.0 || v[2] == 0.0)
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "<scale> by 0 leaves nothing");
    *step = aur_transform_scale(v[0], v[1], v[2]);
    return AUR_OK;
}

static aur_result read_rotate(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    static const char *const names[] = {"angle", "value", "x", "y", "z"};
    double axis[3], degrees;
    const char *text;
    aur_result result = aur_xml_check_attributes(node, 5, names, error);
    if (result == AUR_OK)
        result = aur_xml_require(node, "angle", &text, error);
    if (result == AUR_OK)
        result = read_triple(node, 0.0, axis, error);
    if (result != AUR_OK)
        return result;
    if (!aur_parse_double(text, &degrees))
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                           "<rotate>: 'angle' must be degrees, not '%s'", text);
    if (!aur_transform_rotate(axis, degrees, step))
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                           "<rotate> needs an axis other than 0 0 0");
    return AUR_OK;
}

static aur_result read_matrix(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    static const char *const names[] = {"value"};
    const char *text;
    aur_result result = aur_xml_check_attributes(node, 1, names, error);
    if (result == AUR_OK)
        result = aur_xml_require(node, "value", &text, error);
    if (result != AUR_OK)
        return result;
    double values[16];
    const size_t count = aur_parse_doubles(text, values, 16);
    *step = aur_transform_identity();
    if (count == 16)
        memcpy(step->m, values, sizeof values);
    else if (count == 9)
        for (size_t i = 0; i < 9; ++i)
            step->m[4 * (i / 3) + i % 3] = values[i];
    else
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT,
                           "<matrix>: 'value' must be 16 numbers, row by row (or 9), not %s",
                           count == SIZE_MAX ? "something that is no number" : "another count of them");
    return AUR_OK;
}

static aur_result read_look_at(const aur_xml_node *node, aur_transform *step, aur_error *error) {
    static const char *const names[] = {"origin", "target", "up"};
    double origin[3], target[3], up[3] = {0.0, 0.0, 0.0};
    aur_result result = aur_xml_check_attributes(node, 3, names, error);
    if (result == AUR_OK)
        result = read_named_triple(node, "origin", origin, error);
    if (result == AUR_OK)
        result = read_named_triple(node, "target", target, error);
    if (result == AUR_OK && aur_xml_attribute_value(node, "up") != NULL)
        result = read_named_triple(node, "up", up, error);
    if (result != AUR_OK)
        return result;
    if (up[0] == 0.0 && up[1] == 0.0 && up[2] == 0.0) {
        /* Any axis that is not along the view will do. */
        const bool along_z =
            fabs(target[2] - origin[2]) > fabs(target[0] - origin[0]) + fabs(target[1] - origin[1]);
        up[along_z ? 1 : 2] = 1.0;
    }
    if (!aur_transform_look_at(origin, target, up, step))
        return aur_fail_at(
            error, node->location, AUR_ERROR_FORMAT,
            "<lookat>: 'target' must differ from 'origin', and 'up' must not point along the view");
    return AUR_OK;
}

typedef aur_result (*step_reader)(const aur_xml_node *node, aur_transform *step, aur_error *error);

static aur_result read_transform(const aur_xml_node *node, aur_transform *transform, aur_error *error) {
    static const char *const names[] = {"translate", "scale", "rotate", "matrix", "lookat"};
    static const step_reader readers[] = {read_translate, read_scale, read_rotate, read_matrix, read_look_at};
    *transform = aur_transform_identity();
    for (const aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        size_t which = 0;
        while (which < 5 && strcmp(child->tag, names[which]) != 0)
            ++which;
        if (which == 5)
            return aur_xml_fail_tag(child, 5, names, error);
        aur_transform step;
        const aur_result result = readers[which](child, &step, error);
        if (result != AUR_OK)
            return result;
        *transform = aur_transform_multiply(&step, transform);
    }
    aur_transform inverse;
    if (!aur_transform_inverse(transform, &inverse))
        return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "<transform>: the matrix has no inverse");
    return AUR_OK;
}

aur_result aur_xml_add_property(const aur_xml_node *node, aur_parameters *parameters, aur_error *error) {
    static const char *const plain[] = {"name", "value"};
    static const char *const vector[] = {"name", "value", "x", "y", "z"};
    static const char *const transform_names[] = {"name"};
    const aur_parameter_kind kind = find(node->tag)->kind;
    const char *name, *value;
    aur_result result;
    if (kind == AUR_PARAMETER_VECTOR)
        result = aur_xml_check_attributes(node, 5, vector, error);
    else if (kind == AUR_PARAMETER_TRANSFORM)
        result = aur_xml_check_attributes(node, 1, transform_names, error);
    else
        result = aur_xml_check_attributes(node, 2, plain, error);
    if (result == AUR_OK)
        result = aur_xml_require(node, "name", &name, error);
    if (result != AUR_OK)
        return result;
    if (kind == AUR_PARAMETER_TRANSFORM) {
        aur_transform transform;
        result = read_transform(node, &transform, error);
        return result != AUR_OK
                   ? result
                   : aur_parameters_add_transform(parameters, name, transform.m, node->location, error);
    }
    if (node->first_child != NULL)
        return aur_fail_at(error, node->first_child->location, AUR_ERROR_FORMAT,
                           "<%s> cannot stand inside <%s>", node->first_child->tag, node->tag);
    if (kind == AUR_PARAMETER_VECTOR) {
        double triple[3];
        char text[96];
        result = read_triple(node, 0.0, triple, error);
        if (result != AUR_OK)
            return result;
        aur_format(text, sizeof text, "%.17g %.17g %.17g", triple[0], triple[1], triple[2]);
        return aur_parameters_add_text(parameters, kind, name, text, node->location, error);
    }
    result = aur_xml_require(node, "value", &value, error);
    if (result != AUR_OK)
        return result;
    if (strcmp(node->tag, "spectrum") == 0 && strchr(value, ':') != NULL)
        return aur_fail_at(error, node->location, AUR_ERROR_UNSUPPORTED,
                           "<spectrum>: wavelengths are not supported; give one number, or <rgb>");
    return aur_parameters_add_text(parameters, kind, name, value, node->location, error);
}
