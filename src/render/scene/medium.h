/* Participating media: absorption and scattering between surfaces. To add one: a file in the folder media,
 * and one line in media/table.c.
 *
 * Paths are sampled by one colour channel, and weighted over all three channels and both ways to find a light
 * by the balance heuristic (Veach 1997; Wilkie et al. 2014; Miller, Georgiev and Jarosz 2019). */
#pragma once

#include "render/scene/phase.h"
#include "render/scene/scene.h"
#include "render/scene/volume.h"

/* State of a path in media, by channel. All three members are relative to the pdf with which the path was
 * sampled, and a common factor cancels: the estimate is a quotient. */
typedef struct aur_medium_walk {
    aur_vector throughput;
    /* The pdf with which each channel would have sampled the path, and that with which each would have
     * sampled the part since the last scattering as a connection to a point on a light. */
    aur_vector path, light;
    size_t channel; /* 0 to 2: the sampling channel */
    uint64_t hash;  /* state of the random numbers (aur_draw_unit) */
    bool cut;       /* ended after too many null collisions: its remaining contribution is missing */
    bool stopped;   /* ended on cancellation: its result is invalid */
} aur_medium_walk;

typedef struct aur_medium_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor */
    size_t size; /* size of medium->data: zeroed before `create`, freed in the end */
    /* Reads its parameters. */
    aur_result (*create)(aur_parameters *parameters, aur_medium *medium, aur_error *error);
    void (*release)(void *data); /* frees what medium->data points to; NULL: nothing */
    /* Samples a free path up to `distance`, which may be infinite. True if scattered; *way is the distance
     * then. `u` in [0,1) is the first random number. */
    bool (*travel)(const aur_medium *medium, const aur_ray *ray, float distance, float u,
                   aur_medium_walk *walk, float *way);
    /* The transmittance to a point on a light. */
    void (*pass)(const aur_medium *medium, const aur_ray *ray, float distance, aur_medium_walk *walk);
} aur_medium_descriptor;

struct aur_medium {
    const aur_medium_descriptor *descriptor;
    void *data;
    const aur_phase *phase;
    bool samples_emitters; /* whether light sampling is used at scattering events */
    aur_location location;
};

extern const aur_table aur_medium_table;

/* Builds the medium of parameters->plugin. */
aur_result aur_medium_create(aur_parameters *parameters, aur_medium **medium, aur_error *error);
void aur_medium_destroy(aur_medium *medium);

static inline float *aur_channel(aur_vector *color, size_t channel) {
    return channel == 0 ? &color->x : channel == 1 ? &color->y : &color->z;
}
