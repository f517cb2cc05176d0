/* Volumes: values that vary over space. To add one: a file in the folder volumes, and one line in
 * volumes/table.c. */
#pragma once

#include "points/base/keys.h"
#include "render/scene/transform.h"

typedef struct aur_volume aur_volume;

typedef struct aur_volume_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor; its parameters are read into
                    volume->data */
    size_t size; /* size of volume->data: zeroed before parameters are read, freed in the end */
    /* Reads the remaining parameters, and sets the fields of the volume below. */
    aur_result (*create)(aur_parameters *parameters, aur_volume *volume, aur_error *error);
    void (*release)(void *data); /* frees what volume->data points to; NULL: nothing */
    aur_vector (*evaluate)(const aur_volume *volume, aur_vector position);
    /* The largest value of any channel in a box of the unit cube; for varying volumes. */
    float (*maximum_within)(const aur_volume *volume, const float lower[3], const float upper[3]);
} aur_volume_descriptor;

struct aur_volume {
    const aur_volume_descriptor *descriptor;
    void *data;
    float minimum, maximum; /* maximum over all channels and positions */
    bool constant;          /* if false, the volume is in the unit cube of its local space: */
    aur_transform to_world;
    float
        to_local[12]; /* row major 3x4, from scene coordinates relative to the origin: aur_volume_recenter */
    size_t voxels[3];
};

extern const aur_table aur_volume_table;

/* Builds the volume of parameters->plugin. A grid's `filename` must already be resolved. */
aur_result aur_volume_create(aur_parameters *parameters, aur_volume **volume, aur_error *error);
void aur_volume_destroy(aur_volume *volume);
/* Computes `to_local` for scene coordinates relative to `origin`. */
void aur_volume_recenter(aur_volume *volume, const double origin[3]);

/* A parameter of a medium: a constant, or a volume. */
typedef struct aur_volume_value {
    aur_vector constant;
    const aur_volume *volume; /* NULL: constant */
} aur_volume_value;

/* A row for tables of parameters, for aur_volume_value_read. */
#define AUR_VOLUME_KEY(name_, default_, help_)                                                               \
    AUR_KEY_READ_APART(AUR_KEY_ITEM, name_, default_, help_), .words = (const char *const[]) {               \
        "number", "color", "volume", NULL                                                                    \
    }

/* Reads the value of a parameter, by default `fallback`; `name` is a string literal. Errors: FORMAT, with
 * location, for values that are not a number, colour or volume, or are below 0 or above `maximum`. */
aur_result aur_volume_value_read(aur_parameters *parameters, const char *name, float fallback, float maximum,
                                 aur_volume_value *value, aur_error *error);

static inline aur_vector aur_volume_value_at(const aur_volume_value *value, aur_vector position) {
    return value->volume == NULL ? value->constant
                                 : value->volume->descriptor->evaluate(value->volume, position);
}

/* A point and a direction in the volume's local space; the ray parameter is preserved. */
static inline aur_vector aur_volume_local_direction(const aur_volume *volume, aur_vector direction) {
    const float *const m = volume->to_local;
    return (aur_vector){m[0] * direction.x + m[1] * direction.y + m[2] * direction.z,
                        m[4] * direction.x + m[5] * direction.y + m[6] * direction.z,
                        m[8] * direction.x + m[9] * direction.y + m[10] * direction.z};
}

static inline aur_vector aur_volume_local(const aur_volume *volume, aur_vector position) {
    const float *const m = volume->to_local;
    return aur_vector_add(aur_volume_local_direction(volume, position), (aur_vector){m[3], m[7], m[11]});
}
