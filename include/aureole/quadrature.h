/* Quadrature on the sphere: worst-case errors and the sample weights that make them smallest.
 *
 * The integral is I = integral of f(u) p(u) over the sphere, f unknown but smooth of order s, p a known
 * density. Everywhere here p is normalised to integral 1, so equal weights are 1/N; multiply by
 * aur_potential_mass for the density as it is written. The kernel is K(u,v) = 2^{2s-1}/s - |u-v|^{2s-2}, 1 <
 * s < 2 (Marques 2018 eq. 3); z(u) = integral of K(u,v) p(v) (eq. 12) is called the potential of p, V =
 * integral of z p (eq. 10) its self-energy. Directions are unit vectors x,y,z, one after another; the surface
 * normal is +z.
 *
 * The first solve holds OpenBLAS to one thread for the whole process, so that results do not depend on how
 * many threads the machine has. */
#ifndef AUREOLE_QUADRATURE_H
#define AUREOLE_QUADRATURE_H

#include <aureole/sphere.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- densities -------------------------------------------------------------------------------------------
 */

typedef enum aur_density_kind {
    AUR_DENSITY_COSINE_POWER, /* cos^exponent of the angle to the axis, on the hemisphere about the axis */
    AUR_DENSITY_SPHERE,       /* 1 on the whole sphere */
    AUR_DENSITY_GGX,          /* GGX reflection times cosine, a view direction given, Fresnel term 1 */
    AUR_DENSITY_FUNCTION,     /* any function >= 0, by importance-sampled spherical Fibonacci points */
    AUR_DENSITY_NODES         /* point masses: any measure, and any quadrature of one */
} aur_density_kind;

/* p at a unit vector, up to a factor; finite and >= 0. Called from one thread. */
typedef double (*aur_density_function)(void *user, const double direction[3]);

/* Fields that a kind does not name are ignored; zero is the uniform hemisphere about +z. */
typedef struct aur_density {
    aur_density_kind kind;
    double axis[3];      /* COSINE_POWER, FUNCTION: unit vector; all zero stands for +z */
    double exponent;     /* COSINE_POWER: m in [0, AUR_EXPONENT_MAXIMUM]. FUNCTION: of the lobe about the axis
                            that     the nodes are drawn from, which must cover the support of p */
    int clipped;         /* COSINE_POWER: only the part above the surface, z > 0 */
    double alpha;        /* GGX: roughness in (0,1] */
    double view_degrees; /* GGX: of the view direction from +z towards +x, in [0,90) */
    aur_density_function function; /* FUNCTION */
    void *user;
    int whole_sphere;     /* FUNCTION: draw the nodes evenly from the whole sphere instead */
    size_t node_count;    /* NODES; for GGX and FUNCTION 0 stands for 4096 */
    const double *nodes;  /* NODES: 3 * node_count; copied */
    const double *masses; /* NODES: node_count, >= 0; copied */
} aur_density;

#define AUR_EXPONENT_MAXIMUM 1e5

/* The density that points of a lobe on a domain are drawn for: cos^M or GGX on the hemisphere, 1 on the
 * sphere (where only the uniform lobe has a meaning: else UNSUPPORTED). */
AUR_API aur_result aur_density_from_lobe(const aur_lobe *lobe, aur_domain domain, aur_density *density,
                                         aur_error *error) AUR_NONNULL(1, 3);

/* The potential and the self-energy of one density for one smoothness, made ready: immutable, for any number
 * of threads.
 *
 * COSINE_POWER by the Legendre series with real m, to 1e-11 for s >= 1.3 (1e-9 at s = 1.1, m = 0); clipped by
 * product quadrature of the part below the surface, to 1e-6 or better; SPHERE exact; GGX, FUNCTION and NODES
 * are exact for the sum over their nodes. */
typedef struct aur_potential aur_potential;

/* `smoothness` in (1,2), 0 stands for 1.5. Errors: ARGUMENT (which, and the range), MEMORY. */
AUR_API aur_result aur_potential_create(const aur_density *density, double smoothness,
                                        aur_potential **potential, aur_error *error) AUR_NONNULL(1, 3);
AUR_API void aur_potential_destroy(aur_potential *potential); /* NULL is allowed */

AUR_API double aur_potential_smoothness(const aur_potential *potential) AUR_NONNULL(1);
/* The integral of the density as it is written, before p is normalised, in steradians for COSINE_POWER and
 * SPHERE: 2 pi/(m+1) times the part above the surface, 4 pi. */
AUR_API double aur_potential_mass(const aur_potential *potential) AUR_NONNULL(1);
/* z at `count` unit vectors. */
AUR_API void aur_potential_evaluate(const aur_potential *potential, size_t count, const double *xyz,
                                    double *z) AUR_NONNULL(1, 3, 4);
/* V. The square of the node count in kernel evaluations for densities made of nodes. */
AUR_API double aur_potential_self_energy(const aur_potential *potential) AUR_NONNULL(1);

/* The integral of K(u,v) p(u) q(v) for two unclipped cos^m lobes whose axes meet at an angle with that
 * cosine: what the worst-case error of a sum of two lobes needs. NaN for arguments out of range. */
AUR_API double aur_cross_energy(double exponent, double other_exponent, double cosine, double smoothness);

/* The kernel at a chord |u-v| in [0,2]. */
AUR_API double aur_kernel(double smoothness, double chord);

/* --- worst-case error ------------------------------------------------------------------------------------
 */

/* sup |I - sum w_i f(u_i)| over f of norm 1 (Marques 2018 eq. 9): sqrt(W'KW - 2 Z'W + V). `weights` may be
 * NULL: 1/N. O(N^2) time, O(N) memory; threads 0: all, and no bit depends on it. Errors: ARGUMENT for a
 * vector that is not of unit length (which), CANCELLED. */
AUR_API aur_result aur_worst_case_error(size_t count, const double *xyz, const double *weights,
                                        const aur_potential *potential, size_t threads,
                                        const aur_progress *progress, double *value, aur_error *error)
    AUR_NONNULL(2, 4, 7);

/* --- optimal weights -------------------------------------------------------------------------------------
 */

#define AUR_REGULARIZATION_DEFAULT 1e-6

typedef struct aur_weights_options {
    double regularization; /* added to the diagonal of K: >= 0 */
    int sum_constraint;    /* sum of weights = 1, so that constants are integrated exactly */
} aur_weights_options;

/* Regularisation 1e-6, sum constraint on. */
AUR_API aur_weights_options aur_weights_options_default(void);

typedef struct aur_weights_report {
    double equal_error;   /* worst-case error with equal weights, 1/visible */
    double optimal_error; /* and with the weights found */
    double weight_sum;
    size_t visible; /* samples that take part */
} aur_weights_report;

/* Optimal weights of `count` samples for each of `potential_count` densities (Marques 2018 eq. 14, with one
 * more right-hand side for the sum constraint): weights[potential_count * count], those of the first density
 * first. Two lobes and the union of their samples make this OSWA. All potentials must have the same
 * smoothness. When one of them is clipped, samples below the surface (z < 0) get weight 0 and take no part.
 * Samples at one place share their weight. `reports` (potential_count) and `condition` (an estimate of the
 * 1-norm condition number of the regularised matrix) may be NULL and are then not computed.
 *
 * Errors: ARGUMENT for a vector that is not of unit length (which), no visible sample, or options out of
 * range; MEMORY with what it would take; INTERNAL for a matrix that is not positive definite. */
AUR_API aur_result aur_weights_solve(size_t count, const double *xyz, size_t potential_count,
                                     const aur_potential *const *potentials,
                                     const aur_weights_options *options, double *weights,
                                     aur_weights_report *reports, double *condition, aur_error *error)
    AUR_NONNULL(2, 4, 6);

#ifdef __cplusplus
}
#endif

#endif
