/* Cameras that frame the whole scene. */
#include <math.h>
#include <string.h>

#include "points/base/text.h"
#include "points/base/vector3d.h"
#include "render/scene/load/stage.h"

/* The fraction of the image that the scene fills, from edge to edge. */
static const double FILL = 0.9;

typedef struct view_name {
    const char *name;
    double azimuth, elevation; /* degrees; from the front to the right, and up */
} view_name;

static const view_name views[] = {{"front", 0, 0},           {"back", 180, 0},   {"left", -90, 0},
                                  {"right", 90, 0},          {"top", 0, 90},     {"bottom", 0, -90},
                                  {"corner", 26.565, 17.39}, {"iso", 45, 35.264}};

/* --- extent of the scene */

static void widen(void *user, const double point[3]) {
    aur_stage_widen(user, point);
}

static bool is_outside(const void *user, const aur_stage_box *box) {
    const aur_stage_box *const bounds = user;
    bool inside = true;
    for (size_t d = 0; d < 3; ++d)
        inside = inside && box->sides[0][d] >= bounds->sides[0][d] && box->sides[1][d] <= bounds->sides[1][d];
    return !inside;
}

bool aur_stage_bounds(const aur_scene *scene, double lower[3], double upper[3]) {
    aur_stage_box bounds = {{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}}};
    aur_stage_visit_points(scene, &(aur_stage_visitor){widen, is_outside, &bounds});
    memcpy(lower, bounds.sides[0], sizeof bounds.sides[0]);
    memcpy(upper, bounds.sides[1], sizeof bounds.sides[1]);
    return lower[0] <= upper[0];
}

/* --- views that frame it */

/* A camera's axes, the origin of its coordinates, and the extent of the scene beyond the four planes through
 * that origin that bound the image, and along the axes. */
typedef struct reach {
    double axes[3][3]; /* left, up, forward */
    double center[3];
    double tangents[2];
    double beyond[4];
    double nearest;
} reach;

static void extend(void *user, const double point[3]) {
    reach *const self = user;
    double offset[3], along[3];
    for (size_t d = 0; d < 3; ++d)
        offset[d] = point[d] - self->center[d];
    for (size_t k = 0; k < 3; ++k)
        along[k] = aur_dot3(offset, self->axes[k]);
    for (size_t k = 0; k < 2; ++k) {
        const double depth = self->tangents[k] * along[2];
        self->beyond[2 * k] = fmax(self->beyond[2 * k], along[k] - depth);
        self->beyond[2 * k + 1] = fmax(self->beyond[2 * k + 1], -along[k] - depth);
    }
    self->nearest = fmin(self->nearest, along[2]);
}

/* By the minimum and maximum of each step of `extend`, as rounding is monotonic. */
static bool may_extend(const void *user, const aur_stage_box *box) {
    const reach *const self = user;
    double along[2][3];
    for (size_t k = 0; k < 3; ++k)
        for (size_t side = 0; side < 2; ++side) {
            double offset[3];
            for (size_t d = 0; d < 3; ++d)
                offset[d] = box->sides[self->axes[k][d] < 0.0 ? 1 - side : side][d] - self->center[d];
            along[side][k] = aur_dot3(offset, self->axes[k]);
        }
    bool within = along[0][2] >= self->nearest;
    for (size_t k = 0; k < 2; ++k) {
        const double depth = self->tangents[k] * along[0][2];
        within = within && along[1][k] - depth <= self->beyond[2 * k] &&
                 -along[0][k] - depth <= self->beyond[2 * k + 1];
    }
    return !within;
}

/* For a camera at (a, b, c) along its axes: each pair of planes gives the centred position across, and the
 * largest c that leaves the scene between both. */
static void stand_back(const reach *self, double position[3]) {
    const double *const b = self->beyond;
    double along[3] = {0.5 * (b[0] - b[1]), 0.5 * (b[2] - b[3]), HUGE_VAL};
    for (size_t k = 0; k < 2; ++k)
        along[2] =
            fmin(along[2], self->tangents[k] > 0.0 ? -0.5 * (b[2 * k] + b[2 * k + 1]) / self->tangents[k]
                                                   : self->nearest - (b[0] + b[1] + b[2] + b[3]));
    for (size_t d = 0; d < 3; ++d)
        position[d] = self->center[d] + along[0] * self->axes[0][d] + along[1] * self->axes[1][d] +
                      along[2] * self->axes[2][d];
}

/* Right-handed axes, from the direction of the camera's position. */
static void set_axes(double azimuth, double elevation, bool z_up, double axes[3][3]) {
    const double a = azimuth * AUR_PI / 180.0, e = elevation * AUR_PI / 180.0;
    const double ca = cos(a), sa = sin(a), ce = cos(e), se = sin(e);
    const double flat[3][3] = {{-ca, 0.0, sa}, {-se * sa, ce, -se * ca}, {-ce * sa, -se, -ce * ca}};
    for (size_t k = 0; k < 3; ++k) {
        axes[k][0] = flat[k][0];
        axes[k][1] = z_up ? -flat[k][2] : flat[k][1];
        axes[k][2] = z_up ? flat[k][1] : flat[k][2];
    }
}

static void set_sensor(aur_sensor *sensor, double axes[3][3], const double position[3], double scale) {
    for (size_t d = 0; d < 3; ++d) {
        sensor->position[d] = position[d];
        for (size_t k = 0; k < 3; ++k)
            sensor->to_world[4 * d + k] = (float)(axes[k][d] * (k < 2 ? scale : 1.0));
        sensor->to_world[4 * d + 3] = (float)position[d];
    }
    sensor->near_clip = 0.0f;
    sensor->far_clip = 1e30f;
}

static aur_result frame(aur_scene *scene, double azimuth, double elevation, double aspect, bool z_up,
                        aur_error *error) {
    aur_sensor *const sensor = &scene->sensor;
    double lower[3], upper[3];
    reach self = {.beyond = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, .nearest = HUGE_VAL};
    if (!aur_stage_bounds(scene, lower, upper))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the scene has no surface to look at");
    for (size_t d = 0; d < 3; ++d)
        self.center[d] = 0.5 * lower[d] + 0.5 * upper[d];
    set_axes(azimuth, elevation, z_up, self.axes);
    const bool flat = strcmp(sensor->descriptor->row.name, "orthographic") == 0;
    if (!flat) {
        self.tangents[0] = FILL * (double)aur_sensor_half_width(sensor, (float)aspect);
        self.tangents[1] = self.tangents[0] / aspect;
    }
    aur_stage_visit_points(scene, &(aur_stage_visitor){extend, may_extend, &self});
    double position[3];
    stand_back(&self, position);
    const double *const b = self.beyond;
    set_sensor(sensor, self.axes, position,
               flat ? 0.5 / FILL * fmax(b[0] + b[1], aspect * (b[2] + b[3])) : 1.0);
    return AUR_OK;
}

/* --- parsing */

static aur_result parse_lookat(aur_scene *scene, size_t count, const double *numbers, bool z_up,
                               aur_error *error) {
    const double up[3] = {0.0, z_up ? 0.0 : 1.0, z_up ? 1.0 : 0.0}, other[3] = {0.0, up[2], -up[1]};
    aur_transform to_world;
    if (!aur_transform_look_at(numbers, numbers + 3, up, &to_world) &&
        !aur_transform_look_at(numbers, numbers + 3, other, &to_world))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a camera must look at a point other than its position");
    double axes[3][3];
    for (size_t k = 0; k < 3; ++k)
        for (size_t d = 0; d < 3; ++d)
            axes[k][d] = to_world.m[4 * d + k];
    set_sensor(&scene->sensor, axes, numbers, 1.0);
    if (count == 7) {
        scene->sensor.axis = AUR_FOV_Y;
        scene->sensor.tangent = (float)tan(0.5 * numbers[6] * AUR_PI / 180.0);
    }
    return AUR_OK;
}

aur_result aur_stage_set_camera(aur_scene *scene, const char *text, double aspect, bool z_up,
                                aur_error *error) {
    double numbers[8];
    const bool flat = strcmp(scene->sensor.descriptor->row.name, "orthographic") == 0;
    if (scene->sensor.part_count > 0 || (!flat && !(scene->sensor.tangent > 0.0f)))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the sensor '%s' cannot be placed by a camera's view",
                        scene->sensor.descriptor->row.name);
    for (size_t i = 0; i < sizeof views / sizeof views[0]; ++i)
        if (strcmp(views[i].name, text) == 0)
            return frame(scene, views[i].azimuth, views[i].elevation, aspect, z_up, error);
    const size_t count = aur_parse_doubles(text, numbers, 8);
    if (count == 2 && fabs(numbers[0]) <= 360.0 && fabs(numbers[1]) <= 90.0)
        return frame(scene, numbers[0], numbers[1], aspect, z_up, error);
    const bool is_lookat = !flat && (count == 6 || (count == 7 && numbers[6] > 0.0 && numbers[6] < 180.0));
    for (size_t i = 0; is_lookat && i < 6; ++i)
        if (!(fabs(numbers[i]) <= AUR_REACH))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "a camera must be within %g of the origin", AUR_REACH);
    return is_lookat
               ? parse_lookat(scene, count, numbers, z_up, error)
               : aur_fail(error, AUR_ERROR_ARGUMENT,
                          "unknown camera '%s': expected front, back, left, right, top, bottom, corner, iso, "
                          "AZIMUTH,ELEVATION in degrees, or X,Y,Z,X,Y,Z[,FOV]: position, target and "
                          "field of view in degrees",
                          text);
}

aur_stage_axes aur_stage_axes_of(const aur_scene *scene, bool z_up) {
    const float *const m = scene->sensor.to_world;
    aur_stage_axes axes = {.up = {0.0, z_up ? 0.0 : 1.0, z_up ? 1.0 : 0.0}};
    /* Seen from above or below, the front is at the lower edge of the image. */
    const double ahead[3] = {(double)m[2], (double)m[6], (double)m[10]};
    const double above[3] = {(double)m[1], (double)m[5], (double)m[9]};
    const double steep = aur_dot3(ahead, axes.up);
    const bool level = steep * steep < 0.97 * aur_dot3(ahead, ahead);
    const double sign = steep > 0.0 ? 1.0 : -1.0;
    for (size_t d = 0; d < 3; ++d)
        axes.toward[d] = level ? -ahead[d] : sign * above[d];
    const double height = aur_dot3(axes.toward, axes.up);
    for (size_t d = 0; d < 3; ++d)
        axes.toward[d] -= height * axes.up[d];
    if (!(aur_normalize3(axes.toward) > 0.0))
        axes.toward[z_up ? 1 : 2] = z_up ? -1.0 : 1.0;
    aur_cross3(axes.up, axes.toward, axes.right);
    return axes;
}

/* --- turning */

static double clamp(double value, double lower, double upper) {
    return fmin(fmax(value, lower), upper);
}

/* Rotation about a unit axis, by Rodrigues' formula. */
static void rotate(const double axis[3], double angle, double v[3]) {
    double across[3];
    const double c = cos(angle), s = sin(angle), along = aur_dot3(axis, v) * (1.0 - c);
    aur_cross3(axis, v, across);
    for (size_t d = 0; d < 3; ++d)
        v[d] = c * v[d] + s * across[d] + along * axis[d];
}

aur_result aur_scene_turn(aur_scene *scene, double azimuth, double elevation, double distance,
                          aur_error *error) {
    aur_sensor *const sensor = &scene->sensor;
    if (!scene->has_sensor || sensor->part_count > 0 || !isfinite(azimuth) || !isfinite(elevation) ||
        !(distance > 0.0 && distance < HUGE_VAL))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "this camera cannot be turned so");
    const aur_stage_axes axes = aur_stage_axes_of(scene, scene->document.stage.z_up);
    double from[3];
    for (size_t d = 0; d < 3; ++d)
        from[d] = sensor->position[d] - scene->middle[d];
    const double length = aur_length3(from);
    const double now = length > 0.0 ? asin(clamp(aur_dot3(from, axes.up) / length, -1.0, 1.0)) : 0.0;
    const double most = 89.0 * AUR_PI / 180.0, least = scene->has_ground ? AUR_PI / 180.0 : -most;
    const double rise = clamp(now + elevation * AUR_PI / 180.0, fmin(least, now), fmax(most, now)) - now;
    rotate(axes.right, -rise, from);
    rotate(axes.up, azimuth * AUR_PI / 180.0, from);
    const bool flat = strcmp(sensor->descriptor->row.name, "orthographic") == 0;
    for (size_t k = 0; k < 3; ++k) {
        double column[3];
        for (size_t d = 0; d < 3; ++d)
            column[d] = (double)sensor->to_world[4 * d + k] * (flat && k < 2 ? distance : 1.0);
        rotate(axes.right, -rise, column);
        rotate(axes.up, azimuth * AUR_PI / 180.0, column);
        for (size_t d = 0; d < 3; ++d)
            sensor->to_world[4 * d + k] = (float)column[d];
    }
    for (size_t d = 0; d < 3; ++d)
        sensor->position[d] = scene->middle[d] + from[d] * (flat ? 1.0 : distance);
    return aur_sensor_recenter(sensor, scene->origin, error);
}
