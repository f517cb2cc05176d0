/* Participating media: media that absorb and scatter light between surfaces. Each stands in a file of the
 * folder media and has one line in media/table.c.
 *
 * Light paths are drawn by one colour channel, and weighed over all three and over both ways to find a light
 * by the balance heuristic (Veach 1997; Wilkie and others 2014; Miller, Georgiev and Jarosz 2019). */
#pragma once

#include "render/scene/phase.h"
#include "render/scene/scene.h"
#include "render/scene/volume.h"

/* A light path on its way, by channel. All three are over the density with which it has been drawn, and any
 * common factor of them is of no account: the estimate is a quotient. */
typedef struct aur_medium_walk {
    aur_vector throughput;
    /* The density with which each channel would have drawn it, and with which each would have drawn its part
     * since the last scattering as a way to a point on a light. */
    aur_vector path, light;
    size_t channel; /* 0 to 2, that draws */
    uint64_t hash;  /* of the next number (aur_draw_unit) */
    bool cut;       /* ended after too many null collisions: what it would still bring is missing */
    bool stopped;   /* ended because the work is to stop: what it has found is of no use */
} aur_medium_walk;

typedef struct aur_medium_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor */
    size_t size; /* of what medium->data points to: zeroed before `create`, freed in the end */
    /* Reads its keys. */
    aur_result (*create)(aur_parameters *parameters, aur_medium *medium, aur_error *error);
    void (*release)(void *data); /* what medium->data points to further; NULL: nothing */
    /* Goes along a ray for `distance`, which may be infinite, or until light is scattered: then *way is how
     * far that is and the answer true. `u` in [0,1) is the first number. */
    bool (*travel)(const aur_medium *medium, const aur_ray *ray, float distance, float u,
                   aur_medium_walk *walk, float *way);
    /* Goes all the way to a point on a light: the transmittance. */
    void (*pass)(const aur_medium *medium, const aur_ray *ray, float distance, aur_medium_walk *walk);
} aur_medium_descriptor;

struct aur_medium {
    const aur_medium_descriptor *descriptor;
    void *data;
    const aur_phase *phase;
    bool samples_emitters; /* points on lights are drawn where it scatters */
    aur_location location;
};

extern const aur_table aur_medium_table;

/* Builds the medium that parameters->plugin names. */
aur_result aur_medium_create(aur_parameters *parameters, aur_medium **medium, aur_error *error);
void aur_medium_destroy(aur_medium *medium);

static inline float *aur_channel(aur_vector *color, size_t channel) {
    return channel == 0 ? &color->x : channel == 1 ? &color->y : &color->z;
}
