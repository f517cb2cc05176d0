/* Daylight and luminaires added to a scene by options. */
#include <math.h>
#include <string.h>

#include "points/base/text.h"
#include "points/base/vector3d.h"
#include "render/scene/importers/nodes/node.h"

typedef struct sky_form {
    const char *model;
    size_t cie_type;
    double direct, diffuse; /* irradiances of perez */
    bool needs_sun;
} sky_form;

/* Parses `count` comma-separated numbers. */
static bool read_list(const char *text, size_t count, double *numbers) {
    for (size_t i = 0; i < count && text != NULL; ++i) {
        text = aur_read_double(text, AUR_NUMBER_FINITE, &numbers[i]);
        if (text != NULL && *text != (i + 1 < count ? ',' : '\0'))
            return false;
        text = text != NULL && i + 1 < count ? text + 1 : text;
    }
    return text != NULL;
}

static aur_result read_model(const char *text, sky_form *form, aur_error *error) {
    double numbers[2] = {12.0};
    const bool clear = strcmp(text, "cie-clear") == 0;
    *form = (sky_form){.model = text};
    if (strcmp(text, "uniform") == 0 || strcmp(text, "cie-overcast") == 0)
        return AUR_OK;
    form->needs_sun = true;
    if (clear || (strncmp(text, "cie:", 4) == 0 && read_list(text + 4, 1, numbers) && numbers[0] >= 1.0 &&
                  numbers[0] <= 15.0 && numbers[0] == (double)(size_t)numbers[0])) {
        *form = (sky_form){"cie", (size_t)numbers[0], 0.0, 0.0, true};
        return AUR_OK;
    }
    if (strncmp(text, "perez:", 6) == 0 && read_list(text + 6, 2, numbers) && numbers[0] >= 0.0 &&
        numbers[1] > 0.0) {
        *form = (sky_form){"perez", 0, numbers[0], numbers[1], true};
        return AUR_OK;
    }
    return aur_fail(error, AUR_ERROR_ARGUMENT,
                    "unknown sky '%s': uniform, cie-overcast, cie-clear, cie:N with N from 1 to 15, or "
                    "perez:DNI,DHI in W/m2 with DHI above 0 expected",
                    text);
}

/* A valid day and time such as 2026-06-21T12:00, from 1950 to 2050. */
static bool is_time(const char *text) {
    static const uint64_t most[6] = {2050, 12, 31, 23, 59, 59};
    uint64_t n[6];
    for (size_t i = 0; i < 6; ++i) {
        text = aur_read_integer(text, most[i], &n[i]);
        if (text == NULL || (*text == '\0' && i < 4))
            return false;
        if (*text == '\0')
            break;
        if (strchr(i < 2 ? "-" : i == 2 ? "T " : ":", *text++) == NULL)
            return false;
    }
    const uint64_t length = n[1] == 2 ? 28 + (n[0] % 4 == 0) : 30 + (n[1] + (n[1] > 7)) % 2;
    return *text == '\0' && n[0] >= 1950 && n[1] >= 1 && n[2] >= 1 && n[2] <= length;
}

/* Adds the sun's position to skies and suns. Date and location are validated for skies without a sun too. */
static aur_result add_location(aur_nodes *nodes, aur_xml_node *emitter, const aur_scene_sky *sky, bool sun) {
    static const char *const names[3] = {"latitude", "longitude", "timezone"};
    double numbers[3] = {0.0};
    if (sky->date != NULL && !is_time(sky->date))
        return aur_fail(nodes->error, AUR_ERROR_ARGUMENT,
                        "'%s': expected a date and time such as 2026-06-21T12:00, from 1950 to 2050",
                        sky->date);
    if (sky->location != NULL && (!read_list(sky->location, 3, numbers) || fabs(numbers[0]) > 90.0 ||
                                  fabs(numbers[1]) > 180.0 || fabs(numbers[2]) > 14.0))
        return aur_fail(nodes->error, AUR_ERROR_ARGUMENT,
                        "'%s': expected a location LATITUDE,LONGITUDE,TIMEZONE: degrees north (-90 to 90), "
                        "degrees east (-180 to 180), hours ahead of UTC (-14 to 14)",
                        sky->location);
    if (!sun)
        return nodes->result;
    if (sky->date == NULL || sky->location == NULL)
        return aur_fail(
            nodes->error, AUR_ERROR_ARGUMENT,
            "the sky '%s' needs a date like 2026-06-21T12:00 and a location LATITUDE,LONGITUDE,TIMEZONE "
            "(degrees north, degrees east, hours ahead of UTC)",
            sky->model);
    const char *const split = strpbrk(sky->date, "T ");
    aur_node_property(nodes, emitter, "string", "date", "%.*s", (int)(split - sky->date), sky->date);
    aur_node_property(nodes, emitter, "string", "time", "%s", split + 1);
    for (size_t i = 0; i < 3; ++i)
        aur_node_property(nodes, emitter, "float", names[i], "%.17g", numbers[i]);
    return nodes->result;
}

static bool is_given(const double v[3]) {
    return v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0;
}

static aur_xml_node *add_emitter(aur_nodes *nodes, const char *type, const aur_scene_sky *sky, bool z_up) {
    const double up[3] = {0.0, z_up ? 0.0 : 1.0, z_up ? 1.0 : 0.0};
    aur_xml_node *const emitter = aur_node_object(nodes, nodes->tree->root, "emitter", type);
    aur_node_numbers(nodes, emitter, "vector", "up", 3, is_given(sky->up) ? sky->up : up);
    if (is_given(sky->north))
        aur_node_numbers(nodes, emitter, "vector", "north", 3, sky->north);
    return emitter;
}

/* Removes a shape's emitter. The shape stays black, as emitters are, unless it names a material. */
static void darken_shape(aur_nodes *nodes, aur_xml_node *shape) {
    aur_xml_node *last = NULL;
    bool lit = false, made_of = false;
    for (aur_xml_node *child = shape->first_child; child != NULL; child = child->next) {
        const bool light = strcmp(child->tag, "emitter") == 0;
        lit = lit || light;
        made_of = made_of || strcmp(child->tag, "bsdf") == 0 || strcmp(child->tag, "ref") == 0;
        if (!light)
            last = child;
        else if (last != NULL)
            last->next = child->next;
        else
            shape->first_child = child->next;
    }
    shape->last_child = last;
    if (lit && !made_of)
        aur_node_property(nodes, aur_node_object(nodes, shape, "bsdf", "diffuse"), "rgb", "reflectance", "0");
}

static void leave_out_lights(aur_nodes *nodes) {
    aur_xml_node *const root = nodes->tree->root;
    darken_shape(nodes, root);
    for (aur_xml_node *node = root->first_child; node != NULL; node = node->next)
        if (strcmp(node->tag, "shape") == 0)
            darken_shape(nodes, node);
}

aur_result aur_nodes_add_sky(aur_nodes *nodes, const aur_scene_sky *sky, bool z_up) {
    sky_form form;
    aur_result result = read_model(sky->model, &form, nodes->error);
    if (result != AUR_OK)
        return result;
    const bool perez = form.direct + form.diffuse > 0.0;
    if (perez && sky->illuminance > 0.0)
        return aur_fail(nodes->error, AUR_ERROR_ARGUMENT, "the sky 'perez' is as bright as its DHI says");
    if (sky->alone)
        leave_out_lights(nodes);
    aur_xml_node *const emitter = add_emitter(nodes, "sky", sky, z_up);
    aur_node_property(nodes, emitter, "string", "model", "%s", form.model);
    if (form.cie_type > 0)
        aur_node_property(nodes, emitter, "integer", "cie_type", "%zu", form.cie_type);
    if (perez) {
        aur_node_property(nodes, emitter, "float", "direct_normal", "%.17g", form.direct);
        aur_node_property(nodes, emitter, "float", "diffuse_horizontal", "%.17g", form.diffuse);
        aur_node_property(nodes, emitter, "boolean", "sun_lights_ground", "true");
    } else {
        aur_node_property(nodes, emitter, "float", "illuminance", "%.17g",
                          sky->illuminance > 0.0 ? sky->illuminance : 1e4);
    }
    aur_node_property(nodes, emitter, "rgb", "ground_albedo", "%.17g", sky->ground_albedo);
    result = add_location(nodes, emitter, sky, form.needs_sun);
    if (result != AUR_OK || !(form.direct > 0.0))
        return result;
    aur_xml_node *const sun = add_emitter(nodes, "sun", sky, z_up);
    aur_node_property(nodes, sun, "rgb", "irradiance", "%.17g", form.direct);
    return add_location(nodes, sun, sky, true);
}

/* The luminaire points along its local -z, with C 0 along +x. */
aur_result aur_nodes_add_luminaire(aur_nodes *nodes, const aur_scene_luminaire *luminaire, bool z_up) {
    double z[3] = {-luminaire->aim[0], -luminaire->aim[1], -luminaire->aim[2]}, x[3] = {1.0, 0.0, 0.0}, y[3];
    if (!(aur_normalize3(z) > 0.0))
        z[z_up ? 2 : 1] = 1.0;
    if (fabs(z[0]) > 0.99) {
        x[0] = 0.0;
        x[z_up ? 1 : 2] = 1.0;
    }
    const double along = aur_dot3(x, z);
    for (size_t i = 0; i < 3; ++i)
        x[i] -= along * z[i];
    aur_normalize3(x);
    aur_cross3(z, x, y);
    const double *const o = luminaire->position, angle = luminaire->turn * 3.14159265358979323846 / 180.0;
    const double c = cos(angle), s = sin(angle);
    double m[16] = {[15] = 1.0};
    for (size_t i = 0; i < 3; ++i) {
        m[4 * i] = c * x[i] + s * y[i];
        m[4 * i + 1] = c * y[i] - s * x[i];
        m[4 * i + 2] = z[i];
        m[4 * i + 3] = o[i];
    }
    aur_xml_node *const emitter = aur_node_object(nodes, nodes->tree->root, "emitter", "photometric");
    aur_node_property(nodes, emitter, "string", "filename", "%s", luminaire->file);
    aur_xml_node *const to_world = aur_node_add(nodes, emitter, "transform");
    aur_node_set(nodes, to_world, "name", "to_world");
    aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "matrix"), "value", 16, m);
    return nodes->result;
}
