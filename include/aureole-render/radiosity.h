/* Quasi-Monte Carlo radiosity (Keller 1994): particles from the lights walk through a scene of diffuse
 * triangles and mirrors, all triangles at once, by the points of one (2M + 4)-dimensional set. The result is
 * a mean radiance for every triangle.
 *
 * A solution is a function of the scene and the options. It does not depend on threads or on the division of
 * its paths into calls: sums are in fixed point, so their order does not matter.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_RADIOSITY_H
#define AUREOLE_RADIOSITY_H

#include <aureole-render/scene.h>
#include <aureole/pointset.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The map from two coordinates u, u' to a direction. COSINE: sin^2 theta = u, so flights do not change the
 * power. UNIFORM_ANGLE: theta = pi/2 u, as in the paper (eq. 15); each flight then multiplies the power by
 * (pi/2) sin(pi u). In both phi = 2 pi u'. */
typedef enum aur_radiosity_directions {
    AUR_RADIOSITY_COSINE,
    AUR_RADIOSITY_UNIFORM_ANGLE
} aur_radiosity_directions;

/* Where paths begin: on lights in proportion to their power, or evenly by area (the paper). */
typedef enum aur_radiosity_emission { AUR_RADIOSITY_BY_POWER, AUR_RADIOSITY_BY_AREA } aur_radiosity_emission;

typedef struct aur_radiosity_options {
    size_t size; /* of the caller's struct, so that it can grow */
    /* A SET of 2 bounces + 4 dimensions or more; NULL: "sobol". Where all coordinates of point 0 are zero the
     * walk begins with point 1, because the ray of point 0 would run along an edge. */
    const char *sequence;
    aur_scramble scramble;
    uint64_t seed; /* of scrambling and of random sets */
    aur_radiosity_directions directions;
    aur_radiosity_emission emission;
    size_t bounces; /* the paper's M: paths have M + 1 flights; 1 .. 10000 */
    /* Independent randomisations of the set, 1 .. 1024; path i is taken from number i modulo this. From 2 on
     * there are standard errors. */
    size_t randomizations;
    /* 0: no change. Any other number randomises the order of the lights and rotates the local frame of every
     * triangle at random about its normal. */
    uint64_t variant;
    size_t threads; /* 0: all */
    aur_progress progress;
    aur_warnings warnings; /* open scenes, coincident surfaces, albedos of 1, lost paths */
} aur_radiosity_options;

/* Sobol points, cosine directions, emission by power, 6 bounces, 1 randomisation. */
AUR_EXPERIMENTAL aur_result aur_radiosity_options_init(aur_radiosity_options *options, aur_error *error)
    AUR_NONNULL(1);

typedef struct aur_radiosity aur_radiosity;

/* A solution without paths. The scene must outlive it; `options` may be NULL. Errors: UNSUPPORTED for scenes
 * with shapes other than triangle meshes, without lights, or with lights of no area (each with its position);
 * ARGUMENT, NAME for options; MEMORY. */
AUR_EXPERIMENTAL aur_result aur_radiosity_create(const aur_scene *scene, const aur_radiosity_options *options,
                                                 aur_radiosity **radiosity, aur_error *error)
    AUR_NONNULL(1, 3);
AUR_EXPERIMENTAL void aur_radiosity_destroy(aur_radiosity *radiosity); /* NULL is allowed */

/* Traces until there are `paths` paths in total; existing ones are kept. Errors: ARGUMENT for 0 paths or
 * fewer than there are, UNSUPPORTED to continue with a set that is not extensible, CANCELLED. */
AUR_EXPERIMENTAL aur_result aur_radiosity_trace(aur_radiosity *radiosity, uint64_t paths, aur_error *error)
    AUR_NONNULL(1);

/* Adaptive termination (Keller 1994, section 4): after every `interval` paths the change of the solution is
 *
 *     sqrt(sum_k d_k^2 A_k / sum_k A_k) / sum_k L0_k A_k,
 *
 * d_k the Euclidean distance of the powers (eq. 7) that triangle k receives before and after, and L0 A summed
 * over the lights as the length of the colour. It ends as soon as `window` changes in a row are below
 * epsilon. That is a test of changes, not a bound of the error. */
typedef struct aur_radiosity_termination {
    size_t size;       /* of the caller's struct, so that it can grow */
    double epsilon;    /* > 0 */
    uint64_t interval; /* >= 1; 0 means 1000 */
    uint64_t window;   /* >= 1; 0 means 2 */
    uint64_t limit;    /* the most paths; 0: 2^32 */
} aur_radiosity_termination;

AUR_EXPERIMENTAL aur_result aur_radiosity_termination_init(double epsilon, aur_radiosity_termination *rule,
                                                           aur_error *error) AUR_NONNULL(2);

/* Continues from the current number of paths, which must be a multiple of the interval. *converged (may be
 * NULL) becomes true if the changes fell below epsilon, and false if the limit of paths was reached first.
 * Errors: ARGUMENT for an epsilon, interval or limit out of range, and those of aur_radiosity_trace. */
AUR_EXPERIMENTAL aur_result aur_radiosity_terminate(aur_radiosity *radiosity,
                                                    const aur_radiosity_termination *rule, bool *converged,
                                                    aur_error *error) AUR_NONNULL(1, 2);

/* What a solution is and how it came about. `size` is set by the caller to the size of his struct. */
typedef struct aur_radiosity_description {
    size_t size;
    size_t triangles;
    size_t patches;   /* surfaces that can receive light: fronts of triangles, and backs of two-sided ones */
    size_t lights;    /* triangles that emit */
    size_t dimension; /* 2 bounces + 4 */
    double area;      /* of all triangles, square units of the scene */
    uint64_t paths, rays;
    uint64_t lost;       /* paths that left the scene: it is open, or surfaces coincide */
    uint64_t behind;     /* paths that ended on the back of a one-sided triangle */
    uint64_t trapped;    /* paths that ended between mirrors */
    uint64_t coincident; /* pairs of triangles that are coplanar and overlap; counted up to about 2^20 */
    double change;       /* of the last interval of aur_radiosity_terminate; NaN without one */
    double emitted;      /* watts, the three channels summed */
    /* An estimate of what the cut after M bounces leaves out: the power that triangles would still receive,
     * as a part of all that they receive and would receive. 1 when the last bounces do not lose power. */
    double tail;
    /* The standard error in the unit of epsilon: the root mean square, weighted by area, of the triangles'
     * standard errors of power over independent randomisations. NaN with one randomisation. */
    double error;
    double largest_albedo;
} aur_radiosity_description;

/* Errors: ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_radiosity_get_description(const aur_radiosity *radiosity,
                                                          aur_radiosity_description *description,
                                                          aur_error *error) AUR_NONNULL(1, 2);

/* A triangle, seen from the side of its normal; RGB. Triangles are numbered shape by shape in the order of
 * the scene's file. */
typedef struct aur_radiosity_triangle_result {
    double area;
    double albedo[3];         /* diffuse; the mean of textured ones, 0 of mirrors */
    double emission[3];       /* radiance L0 */
    double power[3];          /* received: <L, Psi_k> of eq. 7, watts */
    double radiance[3];       /* emission + eq. 8 */
    double standard_error[3]; /* of the radiance; NaN with one randomisation */
} aur_radiosity_triangle_result;

/* All triangles into results[capacity]; `size` is sizeof *results, so that the struct can grow. Errors:
 * CAPACITY; ARGUMENT for a size that no version of the struct has. */
AUR_EXPERIMENTAL aur_result aur_radiosity_get_results(const aur_radiosity *radiosity, size_t capacity,
                                                      size_t size, aur_radiosity_triangle_result *results,
                                                      aur_error *error) AUR_NONNULL(1, 4);

#ifdef __cplusplus
}
#endif

#endif
