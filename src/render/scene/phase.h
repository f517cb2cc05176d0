/* Phase functions: how a medium scatters light. To add one: a file in the folder phases, and one line in
 * phases/table.c.
 *
 * They depend only on the scattering angle, equal the pdf of the sampled direction, and integrate to 1 over
 * the sphere. `cosine` is that of the scattering angle: 1 is forward. */
#pragma once

#include "points/base/keys.h"

typedef struct aur_phase aur_phase;

typedef struct aur_phase_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor; its parameters are read into
                    phase->data */
    size_t size; /* size of phase->data: zeroed before parameters are read, freed in the end */
    /* Completes phase->data; NULL: nothing to do. Reads the parameters that the row only names. */
    aur_result (*create)(aur_parameters *parameters, aur_phase *phase, aur_error *error);
    void (*release)(void *data); /* frees what phase->data points to; NULL: nothing */
    /* Per steradian. */
    float (*evaluate)(const aur_phase *phase, aur_vector position, float cosine);
    /* The cosine sampled by u in [0,1). */
    float (*draw)(const aur_phase *phase, aur_vector position, float u);
} aur_phase_descriptor;

struct aur_phase {
    const aur_phase_descriptor *descriptor;
    void *data;
    size_t evaluations; /* number of nested phase functions evaluated per query, with multiplicity */
};

extern const aur_table aur_phase_table;

/* Builds the phase function of parameters->plugin. */
aur_result aur_phase_create(aur_parameters *parameters, aur_phase **phase, aur_error *error);
void aur_phase_destroy(aur_phase *phase);

/* The isotropic phase function: the default of media. */
extern const aur_phase aur_phase_uniform;

static inline float aur_phase_evaluate(const aur_phase *phase, aur_vector position, float cosine) {
    return phase->descriptor->evaluate(phase, position, cosine);
}

static inline float aur_phase_draw(const aur_phase *phase, aur_vector position, float u) {
    return phase->descriptor->draw(phase, position, u);
}
