/* What surfaces and materials become. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

/* --- surfaces */

/* Adds what a surface is made of. */
static aur_result add_material(aur_rad *self, aur_xml_node *shape, const aur_rad_material *material) {
    aur_nodes *const nodes = self->nodes;
    if (!material->row->emits)
        aur_node_refer(nodes, shape, material->bsdf);
    else
        aur_node_numbers(nodes, aur_node_object(nodes, shape, "emitter", "area"), "rgb", "radiance", 3,
                         material->radiance);
    return nodes->result;
}

static aur_result add_polygon(aur_rad *self, const aur_rad_primitive *item,
                              const aur_rad_material *material) {
    if (item->number_count % 3 != 0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "polygon: %zu numbers are no corners of three coordinates", item->number_count);
    aur_xml_node *const shape = aur_node_object(self->nodes, self->parent, "shape", "polygon");
    aur_node_numbers(self->nodes, shape, "string", "vertices", item->number_count, item->numbers);
    return add_material(self, shape, material);
}

static aur_result add_round(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
    const double *const x = item->numbers;
    const bool sphere = item->number_count == 4;
    const bool inwards = item->type.text[0] == 'b' || item->type.text[0] == 't';
    /* A negative radius turns the surface, too. */
    const double radius = x[sphere ? 3 : 6];
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const shape = aur_node_object(nodes, self->parent, "shape", sphere ? "sphere" : "cylinder");
    aur_node_numbers(nodes, shape, "point", sphere ? "center" : "p0", 3, x);
    if (!sphere)
        aur_node_numbers(nodes, shape, "point", "p1", 3, x + 3);
    aur_node_property(nodes, shape, "float", "radius", "%.17g", fabs(radius));
    aur_node_property(nodes, shape, "boolean", "flip_normals", "%s",
                      inwards != (radius < 0.0) ? "true" : "false");
    return add_material(self, shape, material);
}

static aur_result add_ring(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
    const double *const x = item->numbers;
    const double inner = fmin(x[6], x[7]), outer = fmax(x[6], x[7]);
    double axis[3] = {x[3], x[4], x[5]}, up[3], side[3];
    if (!(inner >= 0.0) || !(inner < outer) || !(aur_normalize3(axis) > 0.0))
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "ring: it needs a direction and two different radii, none below 0");
    aur_frame3(axis, up, side);
    const double matrix[16] = {up[0], side[0], axis[0], x[0], up[1], side[1], axis[1], x[1],
                               up[2], side[2], axis[2], x[2], 0.0,   0.0,     0.0,     1.0};
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const shape = aur_node_object(nodes, self->parent, "shape", "disk");
    aur_node_property(nodes, shape, "float", "inner_radius", "%.17g", inner / outer);
    aur_xml_node *const to_world = aur_node_add(nodes, shape, "transform");
    aur_node_set(nodes, to_world, "name", "to_world");
    aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "scale"), "value", 1, &outer);
    aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "matrix"), "value", 16, matrix);
    return add_material(self, shape, material);
}

static aur_result add_mesh(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
    const aur_rad_word file =
        item->string_count > 0 ? item->strings[0] : (aur_rad_word){"", 0, item->type.line};
    if (file.length < 5 || strncmp(file.text + file.length - 4, ".obj", 4) != 0)
        return aur_rad_fail(self, file.line, AUR_ERROR_UNSUPPORTED,
                            "mesh: '%.*s' is compiled for Radiance; name the OBJ file that it was made from",
                            (int)file.length, file.text);
    if (item->string_count > 1)
        return aur_rad_fail(self, item->strings[1].line, AUR_ERROR_UNSUPPORTED,
                            "mesh: the transform '%.*s ...' is not read; put it into the OBJ file",
                            (int)item->strings[1].length, item->strings[1].text);
    const aur_result result = aur_rad_check_name(self, file);
    if (result != AUR_OK)
        return result;
    aur_xml_node *const shape = aur_node_object(self->nodes, self->parent, "shape", "obj");
    aur_node_property(self->nodes, shape, "string", "filename", "%.*s", (int)file.length, file.text);
    return add_material(self, shape, material);
}

static aur_result add_source(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
    const double *const x = item->numbers;
    if (!material->row->emits)
        return aur_rad_fail(self, item->modifier.line, AUR_ERROR_UNSUPPORTED,
                            "source: its material must be a light or a glow");
    if (!(x[3] >= 0.02) || x[3] > 360.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "source: its angle must be from 0.02 to 360 degrees, not %g", x[3]);
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const sun = aur_node_object(nodes, self->parent, "emitter", "sun");
    aur_node_property(nodes, sun, "float", "half_angle", "%.17g", 0.5 * x[3]);
    aur_node_numbers(nodes, sun, "vector", "sun_direction", 3, x);
    aur_node_numbers(nodes, sun, "rgb", "radiance", 3, material->radiance);
    return nodes->result;
}

/* --- materials */

static aur_result add_diffuse(aur_rad *self, const aur_rad_primitive *item,
                              const aur_rad_material *material) {
    const double *const x = item->numbers;
    (void)material;
    if (x[3] != 0.0)
        return aur_rad_fail(
            self, item->type.line, AUR_ERROR_UNSUPPORTED,
            "%.*s: a specularity of %g is not read: Radiance's model of it is none of ours; 0 is "
            "exact",
            (int)item->type.length, item->type.text, x[3]);
    aur_xml_node *const diffuse = aur_node_object(
        self->nodes, aur_node_object(self->nodes, self->parent, "bsdf", "twosided"), "bsdf", "diffuse");
    aur_node_numbers(self->nodes, diffuse, "rgb", "reflectance", 3, x);
    return self->nodes->result;
}

static aur_result add_glass(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
    const double *const x = item->numbers;
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const glass = aur_node_object(nodes, self->parent, "bsdf", "glass");
    (void)material;
    aur_node_property(nodes, glass, "float", "int_ior", "%.17g", item->number_count > 3 ? x[3] : 1.52);
    aur_node_property(nodes, glass, "float", "ext_ior", "1");
    aur_node_numbers(nodes, glass, "rgb", "transmissivity", 3, x);
    return nodes->result;
}

static aur_result check_light(aur_rad *self, const aur_rad_primitive *item,
                              const aur_rad_material *material) {
    (void)material;
    const double *const x = item->numbers;
    if (x[0] < 0.0 || x[1] < 0.0 || x[2] < 0.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT, "%.*s: radiance must not be below 0",
                            (int)item->type.length, item->type.text);
    if (item->number_count > 3 && x[3] < 0.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_UNSUPPORTED,
                            "glow: a radius below 0, light that is seen and lights nothing, is not read");
    return AUR_OK;
}

const aur_rad_row aur_rad_rows[AUR_RAD_ROWS] = {
    {"polygon", 9, SIZE_MAX, false, false, false, add_polygon},
    {"sphere", 4, 4, false, false, false, add_round},
    {"bubble", 4, 4, false, false, false, add_round},
    {"cylinder", 7, 7, false, false, false, add_round},
    {"tube", 7, 7, false, false, false, add_round},
    {"ring", 8, 8, false, false, false, add_ring},
    {"mesh", 0, 0, false, false, true, add_mesh},
    {"source", 4, 4, false, false, false, add_source},
    {"plastic", 5, 5, true, false, false, add_diffuse},
    {"metal", 5, 5, true, false, false, add_diffuse},
    {"glass", 3, 4, true, false, false, add_glass},
    {"light", 3, 3, true, true, false, check_light},
    {"glow", 4, 4, true, true, false, check_light},
};
