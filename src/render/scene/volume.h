/* Volumes: values that vary over space. Each stands in a file of the folder volumes and has one line in
 * volumes/table.c. */
#pragma once

#include "points/base/keys.h"
#include "render/scene/transform.h"

typedef struct aur_volume aur_volume;

typedef struct aur_volume_descriptor {
    aur_row
        row; /* first, so that a row of the table is its descriptor; its keys are read into volume->data */
    size_t size; /* of what volume->data points to: zeroed before the keys are read, freed in the end */
    /* Reads what keys do not, and sets the fields of the volume below. */
    aur_result (*create)(aur_parameters *parameters, aur_volume *volume, aur_error *error);
    void (*release)(void *data); /* what volume->data points to further; NULL: nothing */
    aur_vector (*evaluate)(const aur_volume *volume, aur_vector position);
    /* The largest value of any channel in a box of the unit cube; for volumes that vary. */
    float (*maximum_within)(const aur_volume *volume, const float lower[3], const float upper[3]);
} aur_volume_descriptor;

struct aur_volume {
    const aur_volume_descriptor *descriptor;
    void *data;
    float minimum, maximum; /* of any channel anywhere */
    bool constant;          /* else it lies in the unit cube of its own space: */
    aur_transform to_world;
    float to_local[12]; /* row major 3x4, from the scene, whose origin has been chosen: aur_volume_recenter */
    size_t voxels[3];
};

extern const aur_table aur_volume_table;

/* Builds the volume that parameters->plugin names. A grid's `filename` must already be a path that opens. */
aur_result aur_volume_create(aur_parameters *parameters, aur_volume **volume, aur_error *error);
void aur_volume_destroy(aur_volume *volume);
/* Finds `to_local` for a scene whose coordinates count from `origin`. */
void aur_volume_recenter(aur_volume *volume, const double origin[3]);

/* A value of a medium: the same everywhere, or a volume. */
typedef struct aur_volume_value {
    aur_vector constant;
    const aur_volume *volume; /* NULL: constant */
} aur_volume_value;

/* A row for tables of keys, of what aur_volume_value_read reads. */
#define AUR_VOLUME_KEY(name_, default_, help_)                                                               \
    AUR_KEY_READ_APART(AUR_KEY_ITEM, name_, default_, help_), .words = (const char *const[]) {               \
        "number", "color", "volume", NULL                                                                    \
    }

/* Reads the value of a key, which is `fallback` where it is not given; `name` is a string literal. Errors:
 * FORMAT, with the place, for what is no number, colour or volume, or is below 0 or above `maximum`. */
aur_result aur_volume_value_read(aur_parameters *parameters, const char *name, float fallback, float maximum,
                                 aur_volume_value *value, aur_error *error);

static inline aur_vector aur_volume_value_at(const aur_volume_value *value, aur_vector position) {
    return value->volume == NULL ? value->constant
                                 : value->volume->descriptor->evaluate(value->volume, position);
}

/* A point and a direction in the volume's own space, a step along a ray being a step there. */
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
