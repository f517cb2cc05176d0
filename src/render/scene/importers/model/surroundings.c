#include "render/scene/importers/model/import.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "points/base/text.h"

static const double ANGLE = 35.0; /* vertical field of view of the default camera, in degrees */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double value, double lower, double upper) {
    return fmin(fmax(value, lower), upper);
}

/* --- the camera */

static void add_appearance(aur_nodes *nodes, aur_xml_node *to_world, const aur_import_camera *camera) {
    const double *const o = camera->origin, *const d = camera->direction;
    double up[3] = {camera->up[0], camera->up[1], camera->up[2]};
    /* Replaces an up vector that is parallel to the view by another direction. */
    const double product = dot(d, up);
    if (!(product * product < 0.9998 * dot(d, d) * dot(up, up))) {
        up[0] = fabs(d[0]) < 0.9 * sqrt(dot(d, d)) ? 1.0 : 0.0;
        up[1] = 1.0 - up[0];
        up[2] = 0.0;
    }
    /* At map coordinates, a target one unit away would round the view direction. */
    const double far = 1.0 + fabs(o[0]) + fabs(o[1]) + fabs(o[2]);
    const double target[3] = {o[0] + far * d[0], o[1] + far * d[1], o[2] + far * d[2]};
    aur_xml_node *const lookat = aur_node_add(nodes, to_world, "lookat");
    aur_node_set_numbers(nodes, lookat, "origin", 3, o);
    aur_node_set_numbers(nodes, lookat, "target", 3, target);
    aur_node_set_numbers(nodes, lookat, "up", 3, up);
}

/* A property that $name may override. */
static void add_variable(aur_nodes *nodes, aur_xml_node *parent, const char *tag, const char *property,
                         const char *name, const char *otherwise) {
    aur_node_property(nodes, parent, tag, property, "%s", aur_node_variable(nodes, name, otherwise));
}

/* Bright rough materials of models return more light than they receive (bsdf_principled.c): without a limit,
 * paths inside of a body grow to fireflies. Longer paths than these carry less than 1e-6 of a body on a
 * floor. */
static void add_integrator(aur_nodes *nodes, aur_xml_node *parent) {
    aur_xml_node *const integrator =
        aur_node_object(nodes, parent, "integrator", aur_node_variable(nodes, "integrator", "path"));
    add_variable(nodes, integrator, "integer", "max_depth", "max_depth", "32");
}

static void add_film(aur_nodes *nodes, aur_xml_node *sensor, double ratio) {
    const double width = 960.0;
    char height[32];
    aur_format(height, sizeof height, "%.0f", clamp(round(width / ratio), 1.0, 9600.0));
    aur_xml_node *const film = aur_node_object(nodes, sensor, "film", "hdrfilm");
    add_variable(nodes, film, "integer", "width", "resx", "960");
    add_variable(nodes, film, "integer", "height", "resy", height);
    aur_node_object(nodes, film, "rfilter", aur_node_variable(nodes, "rfilter", "gaussian"));
}

/* Where the camera stands. */
static void add_pose(aur_nodes *nodes, aur_xml_node *sensor, const aur_import_camera *camera) {
    aur_xml_node *const to_world = aur_node_add(nodes, sensor, "transform");
    aur_node_set(nodes, to_world, "name", "to_world");
    if (camera->half_width > 0.0) {
        aur_xml_node *const scale = aur_node_add(nodes, to_world, "scale");
        aur_node_set_numbers(nodes, scale, "x", 1, &camera->half_width);
        aur_node_set_numbers(nodes, scale, "y", 1, &camera->half_width);
    }
    add_appearance(nodes, to_world, camera);
}

/* Models have any size: near and far clipping must not remove anything. */
static void add_sensor(aur_nodes *nodes, aur_xml_node *parent, const aur_import_camera *camera) {
    const bool there = camera->is_there != 0, flat = there && camera->half_width > 0.0;
    aur_xml_node *const sensor =
        aur_node_object(nodes, parent, "sensor", flat ? "orthographic" : "perspective");
    if (!flat) {
        aur_node_property(nodes, sensor, "string", "fov_axis", "%s",
                          there && camera->angle_is_vertical == 0 ? "x" : "y");
        aur_node_property(nodes, sensor, "float", "fov", "%.17g",
                          there ? clamp(camera->angle, 0.01, 179.0) : ANGLE);
    }
    aur_node_property(nodes, sensor, "float", "near_clip", "0");
    aur_node_property(nodes, sensor, "float", "far_clip", "1e30");
    if (there)
        add_pose(nodes, sensor, camera);
    add_variable(nodes, aur_node_object(nodes, sensor, "sampler", "multijitter"), "integer", "sample_count",
                 "spp", "64");
    add_film(nodes, sensor, there && camera->aspect > 0.0 ? camera->aspect : 4.0 / 3.0);
}

aur_result aur_model_surround(const aur_model_source *source, const aur_import_camera *camera,
                              aur_nodes *nodes, aur_xml_node *parent) {
    aur_model_stage *const stage = source->stage;
    stage->alone = true;
    stage->framed = camera->is_there != 0;
    stage->location = source->location;
    /* Most formats are y-up, or assimp makes them so; CAD formats are z-up. */
    const char *const dot_at = strrchr(source->name, '.');
    stage->z_up = dot_at != NULL && strcasecmp(dot_at, ".stl") == 0;
    add_integrator(nodes, parent);
    add_sensor(nodes, parent, camera);
    return nodes->result;
}
