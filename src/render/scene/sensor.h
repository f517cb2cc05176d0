/* Cameras. To add one: a file in the folder sensors, and one line in sensors/table.c. */
#pragma once

#include "points/base/keys.h"
#include "render/scene/patches.h"
#include "render/scene/scene.h"
#include "render/scene/transform.h"

typedef enum aur_fov_axis {
    AUR_FOV_X,
    AUR_FOV_Y,
    AUR_FOV_DIAGONAL,
    AUR_FOV_SMALLER,
    AUR_FOV_LARGER
} aur_fov_axis;

typedef struct aur_sensor aur_sensor;

typedef struct aur_sensor_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor */
    /* Reads its parameters; may be NULL if it has only those of all cameras. */
    aur_result (*create)(aur_parameters *parameters, aur_sensor *sensor, aur_error *error);
    /* The ray in camera space through a film point; `aspect` is width over height, and x, y are in [0, 1], y
     * downwards. The direction may have any length; the origin is the camera's unless set. NULL for a batch,
     * whose parts have theirs. */
    void (*ray)(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2], aur_ray *ray);
    /* Completes its data after all shapes are in scene coordinates; may be NULL. Errors: MEMORY. */
    aur_result (*prepare)(aur_sensor *sensor, aur_error *error);
    float factor;    /* factor of the radiance along its rays; 0: 1, with rays in camera space */
    bool is_pinhole; /* all rays start at the origin, in directions aur_sensor_direction */
} aur_sensor_descriptor;

struct aur_sensor {
    const aur_sensor_descriptor *descriptor;
    double position[3]; /* position in the world */
    float to_world[12]; /* row major 3x4, to coordinates relative to the scene's origin */
    float near_clip, far_clip;
    float offset_x, offset_y; /* principal point, as a fraction of the film */
    aur_fov_axis axis;
    float tangent; /* of half the field of view, along `axis` */
    float aperture_radius, focus_distance;
    const struct aur_shape *shape;   /* shape on which rays start; NULL: none */
    aur_distribution triangles;      /* triangles of that mesh, by area */
    const struct aur_medium *medium; /* medium that contains it; NULL: none */
    size_t part_count;               /* number of cameras in a batch; else 0 */
    struct aur_sensor *const *parts;
};

extern const aur_table aur_sensor_table;

/* Builds the sensor of parameters->plugin. */
aur_result aur_sensor_create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error);

/* Converts to coordinates relative to the scene's origin, after all shapes. Errors: MEMORY. */
aur_result aur_sensor_recenter(aur_sensor *sensor, const double origin[3], aur_error *error);
/* Frees what the sensor points to. */
void aur_sensor_release(aur_sensor *sensor);

/* Half the film's width at z = 1. */
float aur_sensor_half_width(const aur_sensor *sensor, float aspect);

/* The direction with z = 1 through a film point, given half the film's width. */
static inline aur_vector aur_sensor_direction(const aur_sensor *sensor, float half, float aspect, float x,
                                              float y) {
    /* +x is the left of the image. */
    return (aur_vector){(1.0f - 2.0f * (x + sensor->offset_x)) * half,
                        (1.0f - 2.0f * (y + sensor->offset_y)) * half / aspect, 1.0f};
}

/* Reconstruction filters; their functions are in scene.h. */

typedef enum aur_filter_kind {
    AUR_FILTER_BOX,
    AUR_FILTER_TENT,
    AUR_FILTER_GAUSSIAN,
    AUR_FILTER_MITCHELL,
    AUR_FILTER_CATMULLROM,
    AUR_FILTER_LANCZOS
} aur_filter_kind;

/* Limit in pixels; wider filters draw samples by the filter. */
enum { AUR_FILTER_REACH_MAX = 16 };

struct aur_filter {
    aur_filter_kind kind;
    float scale;   /* pixels: the standard deviation of a gaussian, the radius of box and tent */
    float b, c;    /* of mitchell */
    int64_t lobes; /* of lanczos */
};

extern const aur_table aur_filter_table;

/* The filter of parameters->plugin, with its parameters. */
aur_result aur_filter_create(aur_parameters *parameters, aur_filter *filter, aur_error *error);
