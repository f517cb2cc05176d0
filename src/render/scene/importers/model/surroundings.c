#include "render/scene/importers/model/surroundings.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "render/scene/importers/model/xml_text.h"

static const double pi = 3.14159265358979323846;

enum { ANGLE = 35 }; /* of the camera that is added, in degrees */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double value, double lower, double upper) {
    return fmin(fmax(value, lower), upper);
}

/* --- the camera */

static void put_look(FILE *xml, const aur_import_camera *camera) {
    const double *const o = camera->origin, *const d = camera->direction;
    double up[3] = {camera->up[0], camera->up[1], camera->up[2]};
    /* What is upright along the view does not matter, but must be another direction. */
    const double product = dot(d, up);
    if (!(product * product < 0.9998 * dot(d, d) * dot(up, up))) {
        up[0] = fabs(d[0]) < 0.9 * sqrt(dot(d, d)) ? 1.0 : 0.0;
        up[1] = 1.0 - up[0];
        up[2] = 0.0;
    }
    /* At map coordinates a target one unit away would round the direction. */
    const double far = 1.0 + fabs(o[0]) + fabs(o[1]) + fabs(o[2]);
    aur_model_put(
        xml,
        "<lookat origin=\"%.17g, %.17g, %.17g\" target=\"%.17g, %.17g, %.17g\" up=\"%.17g, %.17g, %.17g\"/>",
        o[0], o[1], o[2], o[0] + far * d[0], o[1] + far * d[1], o[2] + far * d[2], up[0], up[1], up[2]);
}

static void put_sensor(FILE *xml, const aur_import_camera *camera) {
    const double width = 960.0, ratio = camera->aspect > 0.0 ? camera->aspect : 4.0 / 3.0;
    aur_model_put(
        xml,
        "<default name=\"integrator\" value=\"path\"/><default name=\"spp\" value=\"64\"/>"
        "<default name=\"resx\" value=\"%.0f\"/><default name=\"resy\" value=\"%.0f\"/>"
        "<default name=\"rfilter\" value=\"gaussian\"/><default name=\"max_depth\" value=\"-1\"/>\n"
        "<integrator type=\"$integrator\"><integer name=\"max_depth\" value=\"$max_depth\"/></integrator>\n",
        width, clamp(round(width / ratio), 1.0, 9600.0));
    if (camera->half_width > 0.0)
        aur_model_put(
            xml,
            "<sensor type=\"orthographic\"><transform name=\"to_world\"><scale x=\"%.17g\" y=\"%.17g\"/>",
            camera->half_width, camera->half_width);
    else
        aur_model_put(xml,
                      "<sensor type=\"perspective\"><string name=\"fov_axis\" value=\"%s\"/>"
                      "<float name=\"fov\" value=\"%.17g\"/><transform name=\"to_world\">",
                      camera->angle_is_vertical != 0 ? "y" : "x", clamp(camera->angle, 0.01, 179.0));
    put_look(xml, camera);
    aur_model_put(xml,
                  "</transform>\n<sampler type=\"multijitter\"><integer name=\"sample_count\" "
                  "value=\"$spp\"/></sampler>"
                  "<film type=\"hdrfilm\"><integer name=\"width\" value=\"$resx\"/>"
                  "<integer name=\"height\" value=\"$resy\"/><rfilter type=\"$rfilter\"/></film></sensor>\n");
}

/* From the front, above and the right, so far away that all of a ball around the model is seen. */
static aur_import_camera place_camera(const aur_import_scene *scene, bool z_up) {
    aur_import_camera camera = {.angle = ANGLE, .angle_is_vertical = 1};
    const double from[3] = {0.5, z_up ? -1.0 : 0.35, z_up ? 0.35 : 1.0}, length = sqrt(dot(from, from));
    double squared = 0.0;
    for (size_t i = 0; i < 3; ++i)
        squared += pow(scene->upper[i] - scene->lower[i], 2.0);
    const double distance = 0.5 * sqrt(squared) / sin(0.5 * ANGLE * pi / 180.0);
    for (size_t i = 0; i < 3; ++i) {
        camera.direction[i] = -from[i] / length;
        camera.origin[i] = 0.5 * scene->lower[i] + 0.5 * scene->upper[i] - distance * camera.direction[i];
    }
    camera.up[z_up ? 2 : 1] = 1.0;
    return camera;
}

/* --- light */

/* Light from all sides, and more from above and the left: white is about 1 where that falls straight on. */
static void put_lights(FILE *xml, bool z_up) {
    aur_model_put(xml,
                  "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.5\"/></emitter>\n"
                  "<emitter type=\"directional\"><vector name=\"direction\" value=\"%s\"/>"
                  "<rgb name=\"irradiance\" value=\"1.5\"/></emitter>\n",
                  z_up ? "0.5 0.5 -1" : "0.5 -1 -0.5");
}

static void light(const aur_model_source *source, const aur_import_scene *scene, bool z_up, FILE *xml) {
    const bool lit = scene->has_light != 0;
    if (source->light == AUR_MODEL_LIGHT_NONE || (source->light == AUR_MODEL_LIGHT_AUTO && lit))
        return;
    put_lights(xml, z_up);
    if (!lit)
        aur_warn_at(source->warnings, source->location,
                    "this model has no light source%s: it is lit from all sides, and from above and the left",
                    scene->emits != 0 ? " but surfaces that emit" : "");
}

void aur_model_surround(const aur_model_source *source, const aur_import_scene *scene, FILE *xml) {
    if (!(scene->lower[0] <= scene->upper[0])) {
        if (scene->camera.is_there != 0)
            put_sensor(xml, &scene->camera);
        return;
    }
    /* Most formats have y upwards, or assimp turns them so; those of engineers have z. */
    const char *const dot_at = strrchr(source->name, '.');
    const bool z_up = dot_at != NULL && strcasecmp(dot_at, ".stl") == 0;
    if (scene->camera.is_there != 0) {
        put_sensor(xml, &scene->camera);
    } else {
        const aur_import_camera camera = place_camera(scene, z_up);
        put_sensor(xml, &camera);
        aur_warn_at(source->warnings, source->location,
                    "this model has no camera: it is seen from (%.9g, %.9g, %.9g)", camera.origin[0],
                    camera.origin[1], camera.origin[2]);
    }
    light(source, scene, z_up, xml);
}
