#include "render/scene/load/loader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/load/spectrum.h"

typedef struct property {
    aur_xml_rule rule;
    aur_parameter_kind kind;
} property;

static const property properties[] = {
    {{"integer", 2, {"name", "value"}}, AUR_PARAMETER_INTEGER},
    {{"float", 2, {"name", "value"}}, AUR_PARAMETER_FLOAT},
    {{"boolean", 2, {"name", "value"}}, AUR_PARAMETER_BOOLEAN},
    {{"string", 2, {"name", "value"}}, AUR_PARAMETER_STRING},
    {{"point", 1, {"name", "value", "x", "y", "z"}}, AUR_PARAMETER_VECTOR},
    {{"vector", 1, {"name", "value", "x", "y", "z"}}, AUR_PARAMETER_VECTOR},
    {{"rgb", 2, {"name", "value"}}, AUR_PARAMETER_COLOR},
    {{"spectrum", 1, {"name", "value", "filename", "type", "id"}}, AUR_PARAMETER_COLOR},
    {{"transform", 1, {"name"}}, AUR_PARAMETER_TRANSFORM},
};

enum { PROPERTY_COUNT = sizeof properties / sizeof properties[0] };

static const property *find(const char *tag) {
    for (size_t i = 0; i < PROPERTY_COUNT; ++i)
        if (strcmp(properties[i].rule.tag, tag) == 0)
            return &properties[i];
    return NULL;
}

bool aur_xml_is_property(const char *tag) {
    return find(tag) != NULL;
}

/* What a colour property describes, by the parameter names that materials use for refractive indices and by
 * those of lights. */
static aur_spectrum_use use_of(const aur_parameters *parameters, const char *name) {
    if (strcmp(parameters->kind, "emitter") == 0)
        return strstr(name, "albedo") != NULL ? AUR_SPECTRUM_REFLECTS : AUR_SPECTRUM_EMITS;
    return strcmp(name, "eta") == 0 || strcmp(name, "k") == 0 || strcmp(name, "sigma_t") == 0
               ? AUR_SPECTRUM_REFRACTS
               : AUR_SPECTRUM_REFLECTS;
}

static aur_result add_plain(const property *found, const aur_xml_node *node, aur_parameters *parameters,
                            aur_error *error) {
    if (node->first_child != NULL)
        return aur_xml_fail(node->first_child, error, "<%s> is not allowed inside <%s>",
                            node->first_child->tag, node->tag);
    const char *value = aur_xml_attribute_value(node, "value");
    char text[96];
    if (found->kind == AUR_PARAMETER_VECTOR) {
        double triple[3];
        const aur_result result = aur_xml_read_triple(node, 0.0, triple, error);
        if (result != AUR_OK)
            return result;
        aur_format(text, sizeof text, "%.17g %.17g %.17g", triple[0], triple[1], triple[2]);
        value = text;
    }
    return aur_parameters_add_text(parameters, found->kind, aur_xml_attribute_value(node, "name"), value,
                                   node->location, error);
}

/* <spectrum type="...">: defined by its nested properties. */
static aur_result read_typed(const aur_xml_node *node, aur_spectrum_use use, double rgb[3],
                             aur_error *error) {
    aur_parameters nested;
    aur_result result = aur_parameters_init(&nested, "spectrum", aur_xml_attribute_value(node, "type"),
                                            node->location, error);
    if (result != AUR_OK)
        return result;
    for (const aur_xml_node *child = node->first_child; child != NULL && result == AUR_OK;
         child = child->next) {
        const property *const inner = find(child->tag);
        if (inner == NULL || strcmp(child->tag, "spectrum") == 0 || inner->kind == AUR_PARAMETER_TRANSFORM)
            result = aur_xml_fail(child, error, "<%s> is not allowed inside <spectrum>", child->tag);
        if (result == AUR_OK)
            result = aur_xml_check(child, &inner->rule, error);
        if (result == AUR_OK)
            result = add_plain(inner, child, &nested, error);
    }
    if (result == AUR_OK)
        result = aur_spectrum_create(&nested, use, rgb, error);
    aur_parameters_release(&nested);
    return result;
}

static aur_result read_file(aur_loader *self, const aur_xml_node *node, aur_spectrum_use use, double rgb[3]) {
    char *path;
    aur_result result = aur_xml_find_asset(&self->scene->document, node->location,
                                           aur_xml_attribute_value(node, "filename"), &path, self->error);
    if (result != AUR_OK)
        return result;
    result = aur_spectrum_read(path, node->location, use, rgb, self->error);
    free(path);
    return result;
}

/* A spectrum: wavelength-value pairs, a file of them, or a type. A single number is grey; for lights, it is
 * illuminant E of that radiance, as in Mitsuba 3. */
static aur_result add_spectrum(aur_loader *self, const aur_xml_node *node, aur_parameters *parameters) {
    const char *const name = aur_xml_attribute_value(node, "name");
    const char *const value = aur_xml_attribute_value(node, "value");
    const bool typed = aur_xml_attribute_value(node, "type") != NULL;
    const bool from_file = aur_xml_attribute_value(node, "filename") != NULL;
    if ((value != NULL) + typed + from_file != 1)
        return aur_xml_fail(node, self->error, "<spectrum> needs one of 'value', 'filename' and 'type'");
    if (!typed && node->first_child != NULL)
        return aur_xml_fail(node->first_child, self->error,
                            "<%s> is not allowed inside <spectrum> without 'type'", node->first_child->tag);
    const aur_spectrum_use use = use_of(parameters, name);
    double rgb[3], constant;
    aur_result result;
    if (typed) {
        result = read_typed(node, use, rgb, self->error);
    } else if (from_file) {
        result = read_file(self, node, use, rgb);
    } else if (strchr(value, ':') != NULL) {
        result = aur_spectrum_parse(value, node->location, use, rgb, self->error);
    } else if (use == AUR_SPECTRUM_EMITS && aur_parse_double(value, &constant) && constant >= 0.0) {
        aur_spectrum_equal_energy(constant, rgb);
        result = AUR_OK;
    } else {
        return aur_parameters_add_text(parameters, AUR_PARAMETER_COLOR, name, value, node->location,
                                       self->error);
    }
    if (result != AUR_OK)
        return result;
    if (aur_spectrum_clamp(use, rgb))
        aur_warn_at(self->warnings, node->location,
                    "<spectrum> '%s' is outside of sRGB: clamped to %g, %g, %g", name, rgb[0], rgb[1],
                    rgb[2]);
    char text[96];
    aur_format(text, sizeof text, "%.17g %.17g %.17g", rgb[0], rgb[1], rgb[2]);
    return aur_parameters_add_text(parameters, AUR_PARAMETER_COLOR, name, text, node->location, self->error);
}

aur_result aur_loader_add_property(aur_loader *self, const aur_xml_node *node, aur_parameters *parameters) {
    const property *const found = find(node->tag);
    const aur_result result = aur_xml_check(node, &found->rule, self->error);
    if (result != AUR_OK)
        return result;
    if (strcmp(node->tag, "spectrum") == 0)
        return add_spectrum(self, node, parameters);
    return found->kind == AUR_PARAMETER_TRANSFORM ? aur_xml_add_transform(node, parameters, self->error)
                                                  : add_plain(found, node, parameters, self->error);
}
