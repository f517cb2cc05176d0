/* Conversion of surfaces. Coordinates are transformed before they are stored in nodes: a file moved by xform
 * is bit-identical to one with transformed coordinates. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

static const char *boolean(bool value) {
    return value ? "true" : "false";
}

/* The element of a surface, with its name. */
static aur_xml_node *add_shape(aur_rad *self, const aur_rad_primitive *item, const char *type) {
    aur_xml_node *const shape = aur_node_object(self->nodes, self->parent, "shape", type);
    if (item->name.length > 0)
        aur_node_set(self->nodes, shape, "name", "%.*s", (int)item->name.length, item->name.text);
    return shape;
}

static void refer(aur_nodes *nodes, aur_xml_node *shape, aur_xml_node *medium, const char *name) {
    aur_xml_node *const ref = medium != NULL ? aur_node_add(nodes, shape, "ref") : NULL;
    if (ref == NULL)
        return;
    ref->target = medium;
    aur_node_set(nodes, ref, "name", "%s", name);
}

/* Adds the surface's material. */
static aur_result finish(aur_rad *self, aur_xml_node *shape, const aur_rad_material *material) {
    aur_nodes *const nodes = self->nodes;
    if (material->sky != NULL)
        return aur_rad_fail(self, nodes->location.line, AUR_ERROR_UNSUPPORTED,
                            "the pattern of a sky is read for sources only");
    if (material->emits)
        aur_node_numbers(nodes, aur_node_object(nodes, shape, "emitter", "area"), "rgb", "radiance", 3,
                         material->radiance);
    else
        aur_node_refer(nodes, shape, material->bsdf);
    refer(nodes, shape, material->interior, "interior");
    refer(nodes, shape, material->exterior, "exterior");
    return nodes->result;
}

static void place(const aur_rad *self, double point[3]) {
    aur_rad_pose_apply(&self->pose, 1.0, point);
}

static void turn(const aur_rad *self, double direction[3]) {
    aur_rad_pose_apply(&self->pose, 0.0, direction);
}

static aur_result add_polygon(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    const size_t count = item->number_count / 3;
    double *const x = item->numbers;
    if (item->number_count % 3 != 0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "polygon: %zu numbers are not corners of three coordinates", item->number_count);
    for (size_t i = 0; i < count; ++i)
        place(self, x + 3 * i);
    /* Mirroring a surface preserves which side faces outward. */
    const bool mirrored = aur_rad_pose_mirrors(&self->pose);
    for (size_t i = 0; i < count / 2 && mirrored != self->pose.inverts; ++i)
        for (size_t k = 0; k < 3; ++k) {
            const double swap = x[3 * i + k];
            x[3 * i + k] = x[3 * (count - 1 - i) + k];
            x[3 * (count - 1 - i) + k] = swap;
        }
    aur_xml_node *const shape = add_shape(self, item, "polygon");
    aur_node_numbers(self->nodes, shape, "string", "vertices", item->number_count, x);
    return finish(self, shape, material);
}

static aur_result add_round(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    double *const x = item->numbers;
    const bool sphere = item->number_count == 4;
    const bool inwards = item->type.text[0] == 'b' || item->type.text[0] == 't';
    /* A negative radius reverses the orientation. */
    const double radius = self->pose.scale * x[sphere ? 3 : 6];
    const bool flips = (inwards != (radius < 0.0)) != self->pose.inverts;
    aur_nodes *const nodes = self->nodes;
    place(self, x);
    aur_xml_node *const shape = add_shape(self, item, sphere ? "sphere" : "cylinder");
    aur_node_numbers(nodes, shape, "point", sphere ? "center" : "p0", 3, x);
    if (!sphere) {
        place(self, x + 3);
        aur_node_numbers(nodes, shape, "point", "p1", 3, x + 3);
    }
    aur_node_property(nodes, shape, "float", "radius", "%.17g", fabs(radius));
    aur_node_property(nodes, shape, "boolean", "flip_normals", "%s", boolean(flips));
    return finish(self, shape, material);
}

/* cone and cup. */
static aur_result add_cone(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    double *const x = item->numbers;
    const bool inwards = strncmp(item->type.text, "cup", 3) == 0, below = x[6] < 0.0 || x[7] < 0.0;
    if (x[6] * x[7] < 0.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "%.*s: its radii must not be of different signs", (int)item->type.length,
                            item->type.text);
    place(self, x);
    place(self, x + 3);
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const shape = add_shape(self, item, "cone");
    aur_node_numbers(nodes, shape, "point", "p0", 3, x);
    aur_node_numbers(nodes, shape, "point", "p1", 3, x + 3);
    aur_node_property(nodes, shape, "float", "radius0", "%.17g", fabs(self->pose.scale * x[6]));
    aur_node_property(nodes, shape, "float", "radius1", "%.17g", fabs(self->pose.scale * x[7]));
    aur_node_property(nodes, shape, "boolean", "flip_normals", "%s",
                      boolean((inwards != below) != self->pose.inverts));
    return finish(self, shape, material);
}

static aur_result add_ring(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    double *const x = item->numbers;
    const double inner = self->pose.scale * fmin(x[6], x[7]), outer = self->pose.scale * fmax(x[6], x[7]);
    double axis[3] = {x[3], x[4], x[5]}, up[3], side[3];
    turn(self, axis);
    place(self, x);
    if (!(inner >= 0.0) || !(inner < outer) || !(aur_normalize3(axis) > 0.0))
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "ring: it needs a direction and two different radii, none below 0");
    for (size_t i = 0; i < 3 && self->pose.inverts; ++i)
        axis[i] = -axis[i];
    aur_frame3(axis, up, side);
    const double matrix[16] = {up[0], side[0], axis[0], x[0], up[1], side[1], axis[1], x[1],
                               up[2], side[2], axis[2], x[2], 0.0,   0.0,     0.0,     1.0};
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const shape = add_shape(self, item, "disk");
    aur_node_property(nodes, shape, "float", "inner_radius", "%.17g", inner / outer);
    aur_xml_node *const to_world = aur_node_add(nodes, shape, "transform");
    aur_node_set(nodes, to_world, "name", "to_world");
    aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "scale"), "value", 1, &outer);
    aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "matrix"), "value", 16, matrix);
    return finish(self, shape, material);
}

static bool ends_with(aur_rad_word word, const char *ending) {
    const size_t length = strlen(ending);
    return word.length > length && strncmp(word.text + word.length - length, ending, length) == 0;
}

/* The file named by a mesh or an instance, and its poses from the xform options that follow. */
static aur_result read_file_and_poses(aur_rad *self, const aur_rad_primitive *item, const char *compiled,
                                      const char *source, aur_rad_word *file) {
    *file = item->string_count > 0 ? item->strings[0] : (aur_rad_word){"", 0, item->type.line};
    if (file->length == 0)
        return aur_rad_fail(self, file->line, AUR_ERROR_FORMAT, "%s: the name of a file expected",
                            item->row->name);
    if (ends_with(*file, compiled))
        return aur_rad_fail(self, file->line, AUR_ERROR_UNSUPPORTED,
                            "%s: '%.*s' is compiled for Radiance: name the %s it was compiled from",
                            item->row->name, (int)file->length, file->text, source);
    size_t used = 0;
    aur_result result = aur_rad_check_name(self, *file);
    if (result == AUR_OK)
        result = aur_rad_read_xform(self, item->string_count - 1, item->strings + 1, &used);
    if (result == AUR_OK && used + 1 < item->string_count)
        result =
            aur_rad_fail(self, file->line, AUR_ERROR_FORMAT, "%s: '%.*s' is not an option of xform",
                         item->row->name, (int)item->strings[used + 1].length, item->strings[used + 1].text);
    return result;
}

static aur_result add_mesh(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    aur_rad_word file;
    aur_result result = read_file_and_poses(self, item, ".rtm", "OBJ file", &file);
    if (result == AUR_OK && !ends_with(file, ".obj"))
        result = aur_rad_fail(self, file.line, AUR_ERROR_UNSUPPORTED, "mesh: '%.*s' is not an OBJ file",
                              (int)file.length, file.text);
    aur_nodes *const nodes = self->nodes;
    for (size_t i = 0; i < self->pose_count && result == AUR_OK; ++i) {
        const aur_rad_pose pose = aur_rad_pose_multiply(&self->pose, &self->poses[i]);
        aur_xml_node *const shape = add_shape(self, item, "obj");
        aur_node_property(nodes, shape, "string", "filename", "%.*s", (int)file.length, file.text);
        aur_xml_node *const to_world = aur_node_add(nodes, shape, "transform");
        aur_node_set(nodes, to_world, "name", "to_world");
        aur_node_set_numbers(nodes, aur_node_add(nodes, to_world, "matrix"), "value", 16, pose.m);
        if (pose.inverts)
            aur_node_property(nodes, shape, "boolean", "flip_normals", "true");
        result = finish(self, shape, material);
    }
    self->pose_count = 0;
    return result;
}

/* The file is included in each pose, as by a command. */
static aur_result add_instance(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    aur_rad_word file;
    const aur_result result = read_file_and_poses(self, item, ".oct", ".rad files", &file);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < self->pose_count && !material->nothing; ++i)
        self->poses[i].modifier = item->modifier;
    self->words[0] = file;
    self->file_count = 1;
    self->next = 0;
    return AUR_OK;
}

/* A sky by its formula, (1 + a exp(b / cos Z)) (1 + c exp(d chi) + e cos^2 chi) or one of two others. */
typedef struct sky_form {
    const char *model;
    double gradation[2], indicatrix[3];
    double scale;  /* common factor */
    double ground; /* brightness below the horizon */
    const double *sun;
} sky_form;

/* False for an intermediate sky, which the emitter cannot represent. */
static bool read_form(const aur_rad_sky *sky, sky_form *form) {
    const double *const x = sky->numbers;
    if (sky->by_irradiance) {
        *form = (sky_form){.model = "perez", .ground = x[2], .sun = x + 7};
        return true;
    }
    *form = (sky_form){.model = "cie", .scale = x[0], .ground = x[1], .sun = x + 7};
    if (sky->perez) {
        memcpy(form->gradation, x + 2, sizeof form->gradation);
        memcpy(form->indicatrix, x + 4, sizeof form->indicatrix);
        return true;
    }
    form->ground = x[2];
    form->sun = x + 4;
    form->scale = x[1];
    if (x[0] == 1.0) { /* .91 + 10 exp(-3 chi) + .45 cos^2 chi */
        form->scale *= 0.91 / x[3];
        form->gradation[0] = -1.0;
        form->gradation[1] = -0.32;
        memcpy(form->indicatrix, (const double[3]){10.0 / 0.91, -3.0, 0.45 / 0.91}, sizeof form->indicatrix);
    }
    if (x[0] == 2.0 || x[0] == 3.0)
        form->model = x[0] == 2.0 ? "cie-overcast" : "uniform";
    return x[0] >= 1.0 && x[0] <= 3.0;
}

/* The emitter uses 1 + c (exp(d chi) - exp(d pi / 2)) + e cos^2 chi: the two differ by a factor. */
static void add_form(aur_rad *self, aur_xml_node *sky, const sky_form *form, const double colour[3]) {
    const double *const a = form->gradation, *const c = form->indicatrix;
    double zenith = form->scale, sun[3] = {form->sun[0], form->sun[1], form->sun[2]};
    if (strcmp(form->model, "cie") == 0) {
        const double k = 1.0 + c[0] * exp(0.5 * 3.14159265358979323846 * c[1]);
        const double height = fmin(fmax(sun[2] / aur_length3(sun), -1.0), 1.0), chi = acos(height);
        const double coefficients[5] = {a[0], fmin(a[1], 0.0), c[0] / k, c[1], c[2] / k};
        zenith *=
            (1.0 + a[0] * exp(coefficients[1])) * (1.0 + c[0] * exp(c[1] * chi) + c[2] * height * height);
        aur_node_numbers(self->nodes, sky, "string", "coefficients", 5, coefficients);
        turn(self, sun);
        aur_node_numbers(self->nodes, sky, "vector", "sun_direction", 3, sun);
    }
    const double radiance[3] = {zenith * colour[0], zenith * colour[1], zenith * colour[2]};
    aur_node_numbers(self->nodes, sky, "rgb", "zenith_radiance", 3, radiance);
}

/* The sky of gendaylit by the irradiances of its command. */
static void add_irradiances(aur_rad *self, aur_xml_node *sky, const aur_rad_material *material) {
    const double *const x = material->sky->numbers, *const colour = material->radiance;
    const double irradiance[3] = {x[1] * colour[0], x[1] * colour[1], x[1] * colour[2]};
    double sun[3] = {x[7], x[8], x[9]};
    turn(self, sun);
    aur_node_numbers(self->nodes, sky, "vector", "sun_direction", 3, sun);
    aur_node_numbers(self->nodes, sky, "rgb", "irradiance", 3, irradiance);
    aur_node_property(self->nodes, sky, "float", "direct_normal", "%.17g", x[0]);
    aur_node_property(self->nodes, sky, "float", "diffuse_horizontal", "%.17g", x[1]);
}

/* A source of the upper hemisphere is a sky; a following one of the lower hemisphere is its ground. */
static aur_result add_sky(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
    const double *const x = item->numbers;
    aur_nodes *const nodes = self->nodes;
    const bool above = x[0] == 0.0 && x[1] == 0.0 && x[2] > 0.0;
    sky_form form;
    if (x[0] != 0.0 || x[1] != 0.0 || !(fabs(x[2]) > 0.0) || !(x[3] == 180.0 || (above && x[3] == 360.0)))
        return aur_rad_fail(self, item->type.line, AUR_ERROR_UNSUPPORTED,
                            "source: with the pattern of a sky, '0 0 1 180' or '0 0 -1 180' expected");
    if (!read_form(material->sky, &form))
        return aur_rad_fail(
            self, item->type.line, AUR_ERROR_UNSUPPORTED,
            "skybright.cal: an intermediate sky (%g) is not read: 1 (clear), 2 (overcast) or 3 "
            "(uniform) expected",
            material->sky->numbers[0]);
    if (!above && self->scene->sky == NULL)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_UNSUPPORTED,
                            "source: the ground of a sky must come after the sky, '0 0 1 180'");
    aur_xml_node *sky = self->scene->sky;
    if (above) {
        double up[3] = {0.0, 0.0, 1.0}, north[3] = {0.0, 1.0, 0.0};
        turn(self, up);
        turn(self, north);
        self->scene->sky = sky = aur_node_object(nodes, self->parent, "emitter", "sky");
        aur_node_property(nodes, sky, "string", "model", "%s", form.model);
        aur_node_numbers(nodes, sky, "vector", "up", 3, up);
        aur_node_numbers(nodes, sky, "vector", "north", 3, north);
        aur_node_property(nodes, sky, "boolean", "blend_horizon", "true");
        if (material->sky->by_irradiance)
            add_irradiances(self, sky, material);
        else
            add_form(self, sky, &form, material->radiance);
    }
    if (!above || x[3] == 360.0) {
        const double *const colour = material->radiance;
        const double ground[3] = {form.ground * colour[0], form.ground * colour[1], form.ground * colour[2]};
        aur_node_numbers(nodes, sky, "rgb", "ground", 3, ground);
    }
    return nodes->result;
}

static aur_result add_source(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material) {
    double *const x = item->numbers;
    if (!material->emits)
        return aur_rad_fail(self, item->modifier.line, AUR_ERROR_UNSUPPORTED,
                            "source: its material must be a light or a glow");
    if (!(x[3] >= 0.02) || x[3] > 360.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "source: its angle must be from 0.02 to 360 degrees, not %g", x[3]);
    if (material->sky != NULL)
        return add_sky(self, item, material);
    turn(self, x);
    aur_nodes *const nodes = self->nodes;
    aur_xml_node *const sun = aur_node_object(nodes, self->parent, "emitter", "sun");
    aur_node_property(nodes, sun, "float", "half_angle", "%.17g", 0.5 * x[3]);
    aur_node_numbers(nodes, sun, "vector", "sun_direction", 3, x);
    aur_node_numbers(nodes, sun, "rgb", "radiance", 3, material->radiance);
    return nodes->result;
}

const aur_rad_row aur_rad_surfaces[] = {
    {"polygon", 9, SIZE_MAX, 0, false, false, add_polygon},
    {"sphere", 4, 4, 0, false, false, add_round},
    {"bubble", 4, 4, 0, false, false, add_round},
    {"cylinder", 7, 7, 0, false, false, add_round},
    {"tube", 7, 7, 0, false, false, add_round},
    {"cone", 8, 8, 0, false, false, add_cone},
    {"cup", 8, 8, 0, false, false, add_cone},
    {"ring", 8, 8, 0, false, false, add_ring},
    {"mesh", 0, 0, SIZE_MAX, false, false, add_mesh},
    {"instance", 0, 0, SIZE_MAX, false, false, add_instance},
    {"source", 4, 4, 0, false, false, add_source},
    {.name = NULL},
};
