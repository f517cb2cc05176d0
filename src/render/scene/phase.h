/* Phase functions: how a medium scatters light. Each stands in a file of the folder phases and has one line
 * in phases/table.c.
 *
 * All of them depend on the angle alone by which light is turned, are the density of the direction that is
 * drawn, and integrate to 1 over the sphere. `cosine` is that of the angle: 1 is straight on. */
#pragma once

#include "points/base/keys.h"

typedef struct aur_phase aur_phase;

typedef struct aur_phase_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor; its keys are read into phase->data */
    size_t size; /* of what phase->data points to: zeroed before the keys are read, freed in the end */
    /* Makes the rest of phase->data; NULL: nothing. Keys that the row only names are read here. */
    aur_result (*create)(aur_parameters *parameters, aur_phase *phase, aur_error *error);
    void (*release)(void *data); /* what phase->data points to further; NULL: nothing */
    /* A steradian. */
    float (*evaluate)(const aur_phase *phase, aur_vector position, float cosine);
    /* The cosine that u in [0,1) stands for. */
    float (*draw)(const aur_phase *phase, aur_vector position, float u);
} aur_phase_descriptor;

struct aur_phase {
    const aur_phase_descriptor *descriptor;
    void *data;
    size_t evaluations; /* phase functions inside that may be evaluated for this one, as often as they are
                           named */
};

extern const aur_table aur_phase_table;

/* Builds the phase function that parameters->plugin names. */
aur_result aur_phase_create(aur_parameters *parameters, aur_phase **phase, aur_error *error);
void aur_phase_destroy(aur_phase *phase);

/* The same in all directions: what a medium has that names none. */
extern const aur_phase aur_phase_uniform;

static inline float aur_phase_evaluate(const aur_phase *phase, aur_vector position, float cosine) {
    return phase->descriptor->evaluate(phase, position, cosine);
}

static inline float aur_phase_draw(const aur_phase *phase, aur_vector position, float u) {
    return phase->descriptor->draw(phase, position, u);
}
