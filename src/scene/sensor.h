/* Cameras. One a file of sensors, with one line in its table.c. */
#pragma once

#include "core/keys.h"
#include "scene/scene.h"
#include "scene/transform.h"

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
    aur_result (*create)(aur_parameters *parameters, aur_sensor *sensor, aur_error *error);
    /* The ray in camera space through the film point; `aspect` is width over height and x, y are in [0, 1], y
     * downwards. The direction is of any length, and nearest and farthest are depths along +z. */
    void (*ray)(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2], aur_ray *ray);
    bool is_pinhole; /* all rays begin at the origin, in directions aur_sensor_direction */
} aur_sensor_descriptor;

struct aur_sensor {
    const aur_sensor_descriptor *descriptor;
    float to_world[12]; /* row major 3x4 */
    float near_clip, far_clip;
    float offset_x, offset_y; /* principal point, as a share of the film */
    aur_fov_axis axis;
    float tangent; /* of half the field of view, along `axis` */
    float aperture_radius, focus_distance;
};

extern const aur_table aur_sensor_table;

/* Builds the sensor that parameters->plugin names. */
aur_result aur_sensor_create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error);

/* The keys that perspective cameras share. */
typedef struct aur_lens_keys {
    double fov; /* degrees; 0: not given */
    aur_fov_axis fov_axis;
    double offset_x, offset_y;
    const aur_parameter *focal_length;
} aur_lens_keys;

/* As rows of a table of keys, of a struct whose first member is an aur_lens_keys. */
#define AUR_LENS_KEYS                                                                                        \
    {AUR_KEY_OF_REAL(aur_lens_keys, "fov", fov, 1e-6, 180.0 - 1e-6, "by focal_length",                       \
                     "field of view, degrees"),                                                              \
     .computed = true},                                                                                      \
        {AUR_KEY_OF_CHOICE(aur_lens_keys, "fov_axis", fov_axis, "x", "the side of the film that fov spans",  \
                           "x", "y", "diagonal", "smaller", "larger")},                                      \
        {AUR_KEY_OF_REAL(aur_lens_keys, "principal_point_offset_x", offset_x, -1e3, 1e3, "0",                \
                         "shifts the picture, in widths")},                                                  \
        {AUR_KEY_OF_REAL(aur_lens_keys, "principal_point_offset_y", offset_y, -1e3, 1e3, "0",                \
                         "shifts the picture, in heights")},                                                 \
    {                                                                                                        \
        AUR_KEY_OF_ITEM(aur_lens_keys, "focal_length", focal_length, "50mm",                                 \
                        "in place of fov, on 35 mm film", "millimetres")                                     \
    }

/* Sets the sensor's lens by these keys. */
aur_result aur_sensor_set_lens(const aur_parameters *parameters, const aur_lens_keys *keys,
                               aur_sensor *sensor, aur_error *error);
/* Half the film's width at z = 1. */
float aur_sensor_half_width(const aur_sensor *sensor, float aspect);

/* The direction with z = 1 through the film point, by half the film's width. */
static inline aur_vector aur_sensor_direction(const aur_sensor *sensor, float half, float aspect, float x,
                                              float y) {
    /* +x is the left of the picture. */
    return (aur_vector){(1.0f - 2.0f * (x + sensor->offset_x)) * half,
                        (1.0f - 2.0f * (y + sensor->offset_y)) * half / aspect, 1.0f};
}
