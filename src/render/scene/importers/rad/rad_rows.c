/* What surfaces and materials become. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

/* --- surfaces */

/* What a surface is made of, and its end. */
static aur_result put_end(aur_rad *self, const aur_rad_material *material) {
    if (!material->row->emits)
        return aur_rad_put(self, "<ref id=\"m%zu\"/></shape>", material->id);
    const double *const l = material->radiance;
    return aur_rad_put(
        self, "<emitter type=\"area\"><rgb name=\"radiance\" value=\"%.17g %.17g %.17g\"/></emitter></shape>",
        l[0], l[1], l[2]);
}

static aur_result write_polygon(aur_rad *self, const aur_rad_primitive *item,
                                const aur_rad_material *material) {
    if (item->number_count % 3 != 0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "polygon: %zu numbers are no corners of three coordinates", item->number_count);
    aur_result result = aur_rad_put(self, "<shape type=\"polygon\"><string name=\"vertices\" value=\"");
    if (result == AUR_OK)
        result = aur_rad_put_numbers(self, item->number_count, item->numbers);
    if (result == AUR_OK)
        result = aur_rad_put(self, "\"/>");
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_round(aur_rad *self, const aur_rad_primitive *item,
                              const aur_rad_material *material) {
    const double *const x = item->numbers;
    const bool sphere = item->number_count == 4;
    const bool inwards = item->type.text[0] == 'b' || item->type.text[0] == 't';
    /* A negative radius turns the surface, too. */
    const double radius = x[sphere ? 3 : 6];
    aur_result result =
        sphere
            ? aur_rad_put(self, "<shape type=\"sphere\"><point name=\"center\" value=\"%.17g %.17g %.17g\"/>",
                          x[0], x[1], x[2])
            : aur_rad_put(self,
                          "<shape type=\"cylinder\"><point name=\"p0\" value=\"%.17g %.17g %.17g\"/>"
                          "<point name=\"p1\" value=\"%.17g %.17g %.17g\"/>",
                          x[0], x[1], x[2], x[3], x[4], x[5]);
    if (result == AUR_OK)
        result = aur_rad_put(
            self, "<float name=\"radius\" value=\"%.17g\"/><boolean name=\"flip_normals\" value=\"%s\"/>",
            fabs(radius), inwards != (radius < 0.0) ? "true" : "false");
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_ring(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
    const double *const x = item->numbers;
    const double inner = fmin(x[6], x[7]), outer = fmax(x[6], x[7]);
    double axis[3] = {x[3], x[4], x[5]}, up[3], side[3];
    if (!(inner >= 0.0) || !(inner < outer) || !(aur_normalize3(axis) > 0.0))
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "ring: it needs a direction and two different radii, none below 0");
    aur_frame3(axis, up, side);
    const aur_result result = aur_rad_put(
        self,
        "<shape type=\"disk\"><float name=\"inner_radius\" value=\"%.17g\"/><transform name=\"to_world\">"
        "<scale value=\"%.17g\"/><matrix value=\"%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g "
        "%.17g %.17g %.17g 0 0 0 1\"/></transform>",
        inner / outer, outer, up[0], side[0], axis[0], x[0], up[1], side[1], axis[1], x[1], up[2], side[2],
        axis[2], x[2]);
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_mesh(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material) {
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
    aur_result result = aur_rad_put(self, "<shape type=\"obj\"><string name=\"filename\" value=\"");
    if (result == AUR_OK)
        result = aur_rad_put_quoted(self, file);
    if (result == AUR_OK)
        result = aur_rad_put(self, "\"/>");
    return result == AUR_OK ? put_end(self, material) : result;
}

static aur_result write_source(aur_rad *self, const aur_rad_primitive *item,
                               const aur_rad_material *material) {
    const double *const x = item->numbers, *const l = material->radiance;
    if (!material->row->emits)
        return aur_rad_fail(self, item->modifier.line, AUR_ERROR_UNSUPPORTED,
                            "source: its material must be a light or a glow");
    if (!(x[3] >= 0.02) || x[3] > 360.0)
        return aur_rad_fail(self, item->type.line, AUR_ERROR_FORMAT,
                            "source: its angle must be from 0.02 to 360 degrees, not %g", x[3]);
    return aur_rad_put(
        self,
        "<emitter type=\"sun\"><float name=\"half_angle\" value=\"%.17g\"/><vector "
        "name=\"sun_direction\" value=\"%.17g %.17g %.17g\"/><rgb name=\"radiance\" value=\"%.17g %.17g "
        "%.17g\"/></emitter>",
        0.5 * x[3], x[0], x[1], x[2], l[0], l[1], l[2]);
}

/* --- materials */

static aur_result write_diffuse(aur_rad *self, const aur_rad_primitive *item,
                                const aur_rad_material *material) {
    const double *const x = item->numbers;
    if (x[3] != 0.0)
        return aur_rad_fail(
            self, item->type.line, AUR_ERROR_UNSUPPORTED,
            "%.*s: a specularity of %g is not read: Radiance's model of it is none of ours; 0 is "
            "exact",
            (int)item->type.length, item->type.text, x[3]);
    return aur_rad_put(self,
                       "<bsdf type=\"twosided\" id=\"m%zu\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                       "value=\"%.17g %.17g %.17g\"/></bsdf></bsdf>",
                       material->id, x[0], x[1], x[2]);
}

static aur_result write_glass(aur_rad *self, const aur_rad_primitive *item,
                              const aur_rad_material *material) {
    const double *const x = item->numbers;
    return aur_rad_put(self,
                       "<bsdf type=\"glass\" id=\"m%zu\"><float name=\"int_ior\" value=\"%.17g\"/><float "
                       "name=\"ext_ior\" value=\"1\"/><rgb "
                       "name=\"transmissivity\" value=\"%.17g %.17g %.17g\"/></bsdf>",
                       material->id, item->number_count > 3 ? x[3] : 1.52, x[0], x[1], x[2]);
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
    {"polygon", 9, SIZE_MAX, false, false, false, write_polygon},
    {"sphere", 4, 4, false, false, false, write_round},
    {"bubble", 4, 4, false, false, false, write_round},
    {"cylinder", 7, 7, false, false, false, write_round},
    {"tube", 7, 7, false, false, false, write_round},
    {"ring", 8, 8, false, false, false, write_ring},
    {"mesh", 0, 0, false, false, true, write_mesh},
    {"source", 4, 4, false, false, false, write_source},
    {"plastic", 5, 5, true, false, false, write_diffuse},
    {"metal", 5, 5, true, false, false, write_diffuse},
    {"glass", 3, 4, true, false, false, write_glass},
    {"light", 3, 3, true, true, false, check_light},
    {"glow", 4, 4, true, true, false, check_light},
};
