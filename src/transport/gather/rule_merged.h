/* Two lobes, one about the normal and one about the mirror direction, gathered with the union of their
 * samples: every ray counts for both (Marques 2018 section 5.3).
 *
 * Both patterns are fixed relative to the normal and the plane of reflection, in one of K prepared turns and
 * its mirror image, so what a sample weighs depends on the angle of reflection only: a look-up in a table,
 * made once an image. The directions of a pattern are shared out among the samples of a pixel: share s of S
 * has every S-th.
 */
#ifndef AUR_TRANSPORT_GATHER_RULE_MERGED_H
#define AUR_TRANSPORT_GATHER_RULE_MERGED_H

#include <aureole/quadrature.h>
#include <stdbool.h>

#include "core/vector.h"

typedef enum aur_pair_method {
    AUR_PAIR_MIS,  /* multiple importance sampling, balance heuristic (Veach 1997) */
    AUR_PAIR_OSWA, /* optimal weights, from a table */
    AUR_PAIR_SOLVE /* optimal weights as published: z from a 2-D table, a system solved at every point */
} aur_pair_method;

typedef struct aur_pair_options {
    aur_pair_method method;
    const char *set;       /* SET syntax */
    size_t count[2];       /* directions of the diffuse and the glossy pattern, multiples of `shares` */
    size_t shares;         /* samples of a pixel */
    double exponent;       /* of the glossy lobe */
    size_t rotations;      /* prepared turns of the patterns: at least 1 */
    aur_map map;           /* of sets of the square */
    aur_scramble scramble; /* of the set, once */
    bool optimal_density;  /* directions follow lobe^{2/(s+1)} */
    bool clipped;          /* OSWA: the glossy lobe ends at the horizon */
    double smoothness;     /* s, in (1, 2) */
    double regularization;
    uint64_t seed;
    size_t threads; /* that make the table; 0: all */
    aur_progress progress;
} aur_pair_options;

enum { AUR_PAIR_DENSITY_STEPS = 1024 };

/* Immutable. Patterns are numbered 0 (diffuse) and 1 (glossy); in the order of shares, those of share s begin
 * at s * count / shares. */
typedef struct aur_gather_pair {
    aur_pair_method method;
    size_t shares, rotations;
    size_t count[2], share_count[2];
    double exponent;
    double mass;            /* of the whole glossy lobe */
    float *direction[2][3]; /* x, y, z: rotation after rotation, about the pattern's axis */
    /* Directions a steradian that the shares of one sample send, by the cosine to the pattern's axis: what a
     * light's own sampling is weighed against. */
    float density[2][AUR_PAIR_DENSITY_STEPS + 1];
    double drawn_exponent[2];
    aur_oswa *oswa; /* SOLVE */
    uint64_t seed;
    aur_weight_table *table; /* OSWA: where angles lie */
    float
        *rows; /* OSWA: for each row of the table, for each share: its samples for one lobe, then the other */
    void *storage;
} aur_gather_pair;

aur_result aur_gather_pair_create(const aur_pair_options *options, aur_gather_pair **pair, aur_error *error);
void aur_gather_pair_destroy(aur_gather_pair *pair); /* NULL is allowed */

/* Samples of both patterns that one share has. */
static inline size_t aur_gather_pair_share(const aur_gather_pair *pair) {
    return pair->share_count[0] + pair->share_count[1];
}

/* Weights of a share's samples, the diffuse pattern's first, for the diffuse lobe and, behind them, for the
 * glossy one: weights[2 * share]. `cosine` is that of the angle between normal and mirror direction. The mean
 * over the shares of the sum of weight * f estimates the integral of cos * f, and that of cos^exponent * f,
 * over the hemisphere (of solid angle). NaN when a system could not be solved. */
void aur_gather_pair_weights(const aur_gather_pair *pair, size_t rotation, size_t share, float cosine,
                             float *weights);

/* The sum of both patterns' densities in a direction whose cosines to the normal and to the mirror direction
 * are given. */
static inline float aur_gather_pair_density(const aur_gather_pair *pair, float normal_cosine,
                                            float mirror_cosine) {
    const float steps = (float)AUR_PAIR_DENSITY_STEPS;
    const float a = normal_cosine > 0.0f ? (normal_cosine < 1.0f ? normal_cosine : 1.0f) : 0.0f;
    const float b = mirror_cosine > 0.0f ? (mirror_cosine < 1.0f ? mirror_cosine : 1.0f) : 0.0f;
    return pair->density[0][(int)(a * steps)] + pair->density[1][(int)(b * steps)];
}

/* The frames of the two patterns. `normal` is on the viewer's side, `mirror` the axis of the glossy lobe. */
static inline void aur_gather_pair_frames(aur_vector normal, aur_vector mirror, bool mirrored,
                                          aur_frame frames[2]) {
    const float cosine = aur_vector_dot(normal, mirror);
    const aur_vector along = aur_vector_add_scaled(mirror, -cosine, normal);
    const float sine = aur_vector_length(along);
    /* Where the plane is lost any will do. */
    const aur_vector x = sine > 1e-6f ? aur_vector_scale(along, -1.0f / sine) : aur_frame_about(normal).x;
    const aur_vector y = aur_vector_scale(aur_vector_cross(normal, x), mirrored ? -1.0f : 1.0f);
    frames[0] = (aur_frame){x, y, normal};
    frames[1] = (aur_frame){
        aur_vector_add_scaled(aur_vector_scale(x, cosine), sine > 1e-6f ? sine : 0.0f, normal), y, mirror};
}

#endif
