/* Quadrature on the sphere: worst-case errors and the sample weights that minimise them.
 *
 * The integral is I = integral of f(u) p(u) over the sphere, f unknown but smooth of order s, p a known
 * density. Everywhere here p is normalised to integral 1, so equal weights are 1/N; multiply by
 * aur_potential_mass for the unnormalised density. The kernel is K(u,v) = 2^{2s-1}/s - |u-v|^{2s-2} for 1 < s
 * < 2 (Marques 2018 eq. 3), and for other s below 6 that are no integers (-1)^{L+1} |u-v|^{2s-2} plus a
 * polynomial of degree L, the integer part of s - 1, that makes every Legendre coefficient positive
 * (Brauchart, Saff, Sloan and Womersley 2014, section 5); z(u) = integral of K(u,v) p(v) (eq. 12) is called
 * the potential of p, V = integral of z p (eq. 10) its self-energy. Directions are unit vectors x,y,z, one
 * after another; the surface normal is +z. Weights are bit-identical on every processor and for any number of
 * threads.
 *
 * Experimental: merged patterns (aur_oswa) and tables of weights (aur_weight_table) may change in any
 * version. */
#ifndef AUREOLE_QUADRATURE_H
#define AUREOLE_QUADRATURE_H

#include <aureole/sphere.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- densities */

typedef enum aur_density_kind {
    AUR_DENSITY_COSINE_POWER, /* cos^exponent of the angle to the axis, on the hemisphere about the axis */
    AUR_DENSITY_SPHERE,       /* 1 on the whole sphere */
    AUR_DENSITY_GGX,          /* GGX reflection times cosine for a view direction, Fresnel term 1 */
    AUR_DENSITY_FUNCTION,     /* any function >= 0, by importance-sampled spherical Fibonacci points */
    AUR_DENSITY_NODES         /* point masses: any measure, and any quadrature of one */
} aur_density_kind;

/* Writes p, up to a factor, at `count` unit vectors directions[3 * count] into values[count]; finite and >=
 * 0. Called by aur_potential_create, and by aur_potential_density on the caller's thread. A result other than
 * AUR_OK ends either with that result, and may fill `error`. */
typedef aur_result (*aur_density_function)(void *user, size_t count, const double *directions, double *values,
                                           aur_error *error);

/* Each field names the kinds that use it; other kinds ignore it. All zero except `size` is the uniform
 * hemisphere about +z. */
typedef struct aur_density {
    size_t size; /* sizeof the caller's struct */
    aur_density_kind kind;
    /* COSINE_POWER, FUNCTION: a unit vector; all zero: +z. */
    double axis[3];
    /* COSINE_POWER: m in [0, AUR_EXPONENT_MAXIMUM]. FUNCTION: m of the lobe about the axis that the nodes are
     * drawn from, which must cover the support of p. */
    double exponent;
    bool clipped;                  /* COSINE_POWER: only the part above the surface, z > 0 */
    double alpha;                  /* GGX: roughness in [1e-4, 1] */
    double view_degrees;           /* GGX: of the view direction from +z towards +x, in [0,90) */
    aur_density_function function; /* FUNCTION: required */
    void *user;                    /* FUNCTION: its first argument */
    bool whole_sphere;             /* FUNCTION: the nodes are drawn evenly from the whole sphere instead */
    size_t node_count;             /* NODES: 1 to 2^24; GGX and FUNCTION: 0: 4096 */
    const double *nodes;           /* NODES: unit vectors, 3 * node_count; copied */
    const double *masses;          /* NODES: node_count, >= 0, not all 0; copied */
} aur_density;

#define AUR_EXPONENT_MAXIMUM 1e5

/* The uniform hemisphere about +z. */
AUR_API aur_result aur_density_init(aur_density *density, aur_error *error) AUR_NONNULL(1);

/* Sets *density, whose `size` the caller sets, to the density of a lobe on a domain: cos^M or GGX on the
 * hemisphere, 1 on the sphere, which supports only the uniform lobe. Errors: UNSUPPORTED for another lobe on
 * the sphere and for other domains; ARGUMENT for a size that was not set. */
AUR_API aur_result aur_density_from_lobe(const aur_lobe *lobe, aur_domain domain, aur_density *density,
                                         aur_error *error) AUR_NONNULL(1, 3);

/* The potential and the self-energy of one density for one smoothness: immutable, usable by any number of
 * threads.
 *
 * COSINE_POWER by the Legendre series with real m, to 1e-11 for s >= 1.3 (1e-9 at s = 1.1, m = 0); clipped by
 * product quadrature of the part below the surface, to 1e-6 or better; SPHERE exact; GGX, FUNCTION and NODES
 * are exact for their nodes. */
typedef struct aur_potential aur_potential;

/* The exclusive limit of the smoothness. Beyond it errors of order N^{-s/2} are below the rounding error,
 * about 1e-8, even for a few hundred points. */
#define AUR_SMOOTHNESS_MAXIMUM 6.0

/* `smoothness` in (1, AUR_SMOOTHNESS_MAXIMUM) and above 2 at least .01 from an integer; 0: 1.5. Everything
 * that `density` points to is copied except `user` of its function. Errors: ARGUMENT (which, and the range),
 * MEMORY. On failure *potential is NULL. */
AUR_API aur_result aur_potential_create(const aur_density *density, double smoothness,
                                        aur_potential **potential, aur_error *error) AUR_NONNULL(1, 3);
AUR_API void aur_potential_destroy(aur_potential *potential); /* NULL is allowed */

/* s, with the default filled in. */
AUR_API double aur_potential_smoothness(const aur_potential *potential) AUR_NONNULL(1);
/* The integral of the density before normalisation, in steradians for COSINE_POWER and SPHERE: 2 pi/(m+1)
 * times the part above the surface, 4 pi. */
AUR_API double aur_potential_mass(const aur_potential *potential) AUR_NONNULL(1);
/* Writes p at `count` unit vectors xyz[3 * count], normalised to integral 1, in 1/steradian, into
 * values[count]. Errors: UNSUPPORTED for NODES, which have no density; those of a FUNCTION. */
AUR_API aur_result aur_potential_density(const aur_potential *potential, size_t count, const double *xyz,
                                         double *values, aur_error *error) AUR_NONNULL(1);
/* z[count] at `count` unit vectors xyz[3 * count], which are not checked: NaN gives NaN except for SPHERE,
 * which is constant. O(count) for COSINE_POWER and SPHERE, O(count * nodes) for the others. */
AUR_API void aur_potential_evaluate(const aur_potential *potential, size_t count, const double *xyz,
                                    double *z) AUR_NONNULL(1, 3, 4);
/* V. Densities with nodes take the square of the node count in kernel evaluations. */
AUR_API double aur_potential_self_energy(const aur_potential *potential) AUR_NONNULL(1);

/* Writes to *energy the integral of K(u,v) p(u) q(v) for two unclipped cos^m lobes; `cosine` is that of the
 * angle between their axes. The worst-case error of a sum of two lobes needs it. Exponents as for
 * COSINE_POWER, smoothness as for aur_potential_create. Errors: ARGUMENT (which, and the range), MEMORY. */
AUR_API aur_result aur_cross_energy(double exponent, double other_exponent, double cosine, double smoothness,
                                    double *energy, aur_error *error) AUR_NONNULL(5);

/* The kernel at a chord |u-v| in [0,2]; NaN for a chord or a smoothness out of range. */
AUR_API double aur_kernel(double smoothness, double chord);

/* --- worst-case error */

/* All zero except `size`: the defaults, as aur_worst_case_options_init sets them. */
typedef struct aur_worst_case_options {
    size_t size;    /* sizeof the caller's struct */
    size_t threads; /* 0: all; results are bit-identical for any number */
    aur_progress progress;
} aur_worst_case_options;

AUR_API aur_result aur_worst_case_options_init(aur_worst_case_options *options, aur_error *error)
    AUR_NONNULL(1);

/* sup |I - sum w_i f(u_i)| over f of norm 1 (Marques 2018 eq. 9): sqrt(W'KW - 2 Z'W + V), which is limited by
 * rounding to about 1e-8 times the root of K(u,u). `weights` may be NULL: 1/N. O(N^2) time, O(N) memory.
 * `options` may be NULL. Errors: ARGUMENT for a vector that is not of unit length (which), CANCELLED. */
AUR_API aur_result aur_worst_case_error(size_t count, const double *xyz, const double *weights,
                                        const aur_potential *potential, const aur_worst_case_options *options,
                                        double *value, aur_error *error) AUR_NONNULL(2, 4, 6);

/* --- optimal weights */

#define AUR_REGULARIZATION_DEFAULT 1e-6

typedef struct aur_weights_options {
    size_t size;           /* sizeof the caller's struct */
    double regularization; /* added to the diagonal of K: >= 0 and finite */
    bool sum_constraint;   /* sum of weights = 1, so that constants are integrated exactly */
} aur_weights_options;

/* Regularisation 1e-6, sum constraint on. */
AUR_API aur_result aur_weights_options_init(aur_weights_options *options, aur_error *error) AUR_NONNULL(1);

typedef struct aur_weights_report {
    double equal_error;   /* worst-case error with equal weights, 1/visible */
    double optimal_error; /* with the optimal weights */
    double weight_sum;
    size_t visible; /* samples with weights */
} aur_weights_report;

/* Optimal weights of the caller's `count` samples xyz[3 * count] for each of `potential_count` densities
 * (Marques 2018 eq. 14, with one more right-hand side for the sum constraint): weights[potential_count *
 * count], the weights of the first density first; `capacity` counts weights. OSWA is this with two lobes and
 * the union of their samples. All potentials must have the same smoothness. When one of them is clipped or
 * GGX, samples below the surface (z < 0) get weight 0. Coincident samples share their weight. `options` NULL:
 * the default. `reports` (potential_count) and `condition` (an estimate of the 1-norm condition number of the
 * regularised matrix) may be NULL and are then not computed. O(count^3) time, count^2 numbers of memory.
 *
 * Errors: ARGUMENT for a vector that is not of unit length (which), no sample, no visible sample, or options
 * out of range; CAPACITY; MEMORY with the required size; INTERNAL for a matrix that is not positive definite.
 */
AUR_API aur_result aur_weights_solve(size_t count, const double *xyz, size_t potential_count,
                                     const aur_potential *const *potentials,
                                     const aur_weights_options *options, size_t capacity, double *weights,
                                     aur_weights_report *reports, double *condition, aur_error *error)
    AUR_NONNULL(2, 4, 7);

/* Directions with their weights in one call, as final gathering uses them. */
typedef struct aur_rule_options {
    size_t size;     /* sizeof the caller's struct */
    const char *set; /* as in aur_directions_create; NULL: spherical-fibonacci */
    /* Required: count, domain, lobe, density, scrambling; smoothness 0: 1.5. */
    const aur_directions_options *points;
    bool optimal; /* optimal weights; else equal weights, or p/q where q is not the lobe */
    const aur_weights_options *weights; /* of optimal weights; NULL: the default */
} aur_rule_options;

/* The Fibonacci set with equal weights. The points' options must outlive the rule's. */
AUR_API aur_result aur_rule_options_init(const aur_directions_options *points, aur_rule_options *options,
                                         aur_error *error) AUR_NONNULL(2);

/* Fills xyz[3 * count] and weights[count] with the options' count of points, for integrals against the lobe
 * normalised to 1 (plain weights of a GGX lobe: against the density of its visible normals, which has no
 * masking). `capacity` counts doubles of xyz; weights has a third as many elements. Errors: ARGUMENT where
 * the options' points are NULL or their count is 0, or the set has another number of points; CAPACITY; as
 * aur_directions_create, aur_potential_create and aur_weights_solve. */
AUR_API aur_result aur_rule_make(const aur_rule_options *options, size_t capacity, double *xyz,
                                 double *weights, aur_error *error) AUR_NONNULL(1, 3, 4);

/* Writes x,y,z and the weights of one or more densities, density after density, as the columns w, w2, w3, ...
 * of a CSV file ("-": standard output), 17 significant digits, and a comment with the domain if all z >= 0,
 * which would be ambiguous; the file is replaced atomically. Errors: WRITE; ARGUMENT for an unknown domain.
 */
AUR_API aur_result aur_weights_write(const char *path, aur_domain domain, size_t count, const double *xyz,
                                     size_t density_count, const double *weights, aur_error *error)
    AUR_NONNULL(1, 4, 6);

/* The same for points of any domain; columns of rotations, which have a w, are weight, weight2, ... Errors:
 * also ARGUMENT for a stride below the dimension. */
AUR_API aur_result aur_weights_write_points(const char *path, const aur_points_view *points,
                                            size_t density_count, const double *weights, aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* --- two lobes, one merged set (OSWA) */

/* The published look-up table of z (Marques 2018 section 6.2), bilinear in the polar angle and log(1 + m). It
 * is provided as a baseline for comparisons: K^{-1} magnifies its error. */
typedef struct aur_z_grid {
    size_t angle_count;      /* from 0 to pi, 2 to 65536; 0: no grid */
    size_t exponent_count;   /* from 0 to largest_exponent, 2 to 4096 */
    double largest_exponent; /* in (0, AUR_EXPONENT_MAXIMUM]; larger exponents use the z of this one */
} aur_z_grid;

/* Two patterns of one set: the first follows a lobe about the normal +z; the second a lobe about the mirror
 * direction (-sin a, 0, cos a) of a view at the angle a from the normal towards +x. A GGX lobe takes that
 * angle as its view angle. Both patterns may be rotated about their axes by fractions of a turn in [0,1). */
typedef struct aur_oswa_options {
    size_t size;     /* sizeof the caller's struct */
    const char *set; /* as in aur_directions_create; NULL: spherical-fibonacci */
    size_t count,
        mirror_count;     /* samples of the first and of the second; a GGX lobe may be the only one: 0, N */
    aur_lobe lobe;        /* about the normal: COSINE_POWER */
    aur_lobe mirror_lobe; /* about the mirror direction: COSINE_POWER or GGX */
    bool optimal_density; /* points follow lobe^{2/(s+1)}; those of GGX follow the lobe */
    /* The mirror lobe ends at the horizon and hidden samples get weight 0; always so for a GGX lobe. */
    bool clipped;
    aur_map map;
    aur_scramble scramble;
    uint64_t seed;                      /* of the set, its scrambling, and of the table's turns */
    double smoothness;                  /* 0: 1.5 */
    const aur_weights_options *weights; /* NULL: the default */
    aur_z_grid published_z; /* z as published, for unclipped COSINE_POWER lobes; all zero: exact z */
} aur_oswa_options;

/* Two unclipped uniform lobes of `count` and `mirror_count` samples of the Fibonacci set. */
AUR_EXPERIMENTAL aur_result aur_oswa_options_init(size_t count, size_t mirror_count,
                                                  aur_oswa_options *options, aur_error *error) AUR_NONNULL(3);

/* Both patterns with everything that does not depend on the angle: the two constant blocks of K and their z
 * (Marques 2018 section 6.2). Immutable, usable by any number of threads. */
typedef struct aur_oswa aur_oswa;

/* O(size^2) memory and time. The options, and everything that they point to, are copied. Errors: ARGUMENT
 * (which option, and the range), NAME of the set, UNSUPPORTED for a first lobe other than COSINE_POWER or a
 * grid of z for a clipped or GGX lobe, MEMORY. On failure *oswa is NULL. */
AUR_EXPERIMENTAL aur_result aur_oswa_create(const aur_oswa_options *options, aur_oswa **oswa,
                                            aur_error *error) AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL void aur_oswa_destroy(aur_oswa *oswa);                     /* NULL is allowed */
AUR_EXPERIMENTAL size_t aur_oswa_size(const aur_oswa *oswa) AUR_NONNULL(1); /* count + mirror_count */

/* The merged samples xyz[3 * size], the first pattern first, for an angle in [0, pi/2]. `mirrored` reflects
 * them in the plane of the view (y to -y); the same weights are then optimal. `capacity` counts doubles.
 * Errors: ARGUMENT for another angle, CAPACITY. */
AUR_EXPERIMENTAL aur_result aur_oswa_points(const aur_oswa *oswa, double radians, const double turns[2],
                                            bool mirrored, size_t capacity, double *xyz, aur_error *error)
    AUR_NONNULL(1, 3, 6);
/* weights[2 * size]: of every sample for the first lobe, then for the mirror lobe, both of integral 1
 * (weights[size] for the mirror lobe only if the first has no sample). `radians` in [0, pi/2]; `capacity`
 * counts doubles; *mass, unless NULL, is the integral of the mirror lobe before normalisation. O(size^3)
 * time. Errors: ARGUMENT, CAPACITY, MEMORY, INTERNAL for a system that is not positive definite. */
AUR_EXPERIMENTAL aur_result aur_oswa_solve(const aur_oswa *oswa, double radians, const double turns[2],
                                           size_t capacity, double *weights, double *mass, aur_error *error)
    AUR_NONNULL(1, 3, 5);

/* The turns of rotation number `rotation`, hashed from the seed; weight tables use the same. */
AUR_EXPERIMENTAL void aur_oswa_turns(uint64_t seed, size_t rotation, double turns[2]) AUR_NONNULL(3);

/* --- OSWA from a table */

/* Weights at angles from 0 to 90 degrees, and for a GGX lobe at several roughnesses, for each of some pairs
 * of turns, hashed from the seed, and linear interpolation between: no system to solve while rendering. */
typedef struct aur_weight_table aur_weight_table;

/* The grid of a table. */
typedef struct aur_weight_table_grid {
    size_t size;        /* sizeof the caller's struct */
    size_t angle_count; /* of the view, evenly from 0 to 90 degrees: 2 to 65536 */
    /* For a GGX lobe: roughnesses from the alpha of the options to 1, evenly in logarithms: 1 to 256; 1: that
     * alpha only. */
    size_t roughness_count;
    size_t rotation_count; /* pairs of turns: 1 to 65536 */
} aur_weight_table_grid;

/* 64 angles, one roughness, 16 rotations. */
AUR_EXPERIMENTAL aur_result aur_weight_table_grid_init(aur_weight_table_grid *grid, aur_error *error)
    AUR_NONNULL(1);

/* Solves angles * roughnesses * rotations systems, and more where samples cross the horizon. Results are
 * bit-identical for any number of threads (0: all). `grid` NULL: the default. Errors: as aur_oswa_create and
 * aur_oswa_solve, ARGUMENT for a grid out of range or several roughnesses of another lobe, CANCELLED. */
AUR_EXPERIMENTAL aur_result aur_weight_table_build(const aur_oswa_options *options,
                                                   const aur_weight_table_grid *grid, size_t threads,
                                                   const aur_progress *progress, aur_weight_table **table,
                                                   aur_error *error) AUR_NONNULL(1, 5);
/* The same table, read from the cache of earlier runs where it is there; else it is built and stored there.
 */
AUR_EXPERIMENTAL aur_result aur_weight_table_find(const aur_oswa_options *options,
                                                  const aur_weight_table_grid *grid, size_t threads,
                                                  const aur_progress *progress, aur_weight_table **table,
                                                  aur_error *error) AUR_NONNULL(1, 5);
AUR_EXPERIMENTAL void aur_weight_table_destroy(aur_weight_table *table); /* NULL is allowed */

/* Saves and loads a file with version, options, hash of the patterns and checksum. Loading a file of another
 * version, a damaged file or, unless `expected` is NULL, a file built with other options fails and reports
 * which. Errors: OPEN, FORMAT, MEMORY; saving: WRITE, and UNSUPPORTED for a table made with a grid of z. */
AUR_EXPERIMENTAL aur_result aur_weight_table_save(const aur_weight_table *table, const char *path,
                                                  aur_error *error) AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL aur_result aur_weight_table_load(const char *path, const aur_oswa_options *expected,
                                                  aur_weight_table **table, aur_error *error)
    AUR_NONNULL(1, 3);

/* The options of the table, with those of its weights filled in; owned by the table. `size` is the size of
 * the struct in this library. */
AUR_EXPERIMENTAL const aur_oswa_options *aur_weight_table_options(const aur_weight_table *table)
    AUR_NONNULL(1);
/* The numbers of angles, roughnesses and rotations of the table. */
AUR_EXPERIMENTAL size_t aur_weight_table_angles(const aur_weight_table *table) AUR_NONNULL(1);
AUR_EXPERIMENTAL size_t aur_weight_table_roughnesses(const aur_weight_table *table) AUR_NONNULL(1);
AUR_EXPERIMENTAL size_t aur_weight_table_rotations(const aur_weight_table *table) AUR_NONNULL(1);
/* The number of rows, each of 2 (count + mirror_count) floats, the weights of both lobes (of a single GGX
 * lobe: mirror_count): one for each angle, roughness and rotation. A clipped table has two for each piece of
 * an interval, and pieces end where a sample crosses the horizon. */
AUR_EXPERIMENTAL size_t aur_weight_table_rows(const aur_weight_table *table) AUR_NONNULL(1);
/* For renderers, which store rows in another layout: the weights of one row, below that number, of the
 * first lobe, if it has samples, and then of the mirror lobe, each of integral 1. Owned by the table. */
AUR_EXPERIMENTAL const float *aur_weight_table_row(const aur_weight_table *table, size_t row) AUR_NONNULL(1);
/* The row r below an angle (clamped to [0, pi/2]); the weights at the angle are (1 - *part) times row r plus
 * *part times row r + 1. `slot` is the index of the roughness times the number of rotations, plus that of the
 * rotation; it must be in the table. */
AUR_EXPERIMENTAL size_t aur_weight_table_locate(const aur_weight_table *table, size_t slot, float radians,
                                                float *part) AUR_NONNULL(1, 4);
/* The uniform directions xyz[3 * mirror_count] of the hemisphere that the table maps to the mirror lobe
 * before it applies the turns: of a GGX lobe, the points with which visible normals are sampled. `capacity`
 * counts doubles. Errors: CAPACITY. */
AUR_EXPERIMENTAL aur_result aur_weight_table_uniform(const aur_weight_table *table, size_t capacity,
                                                     double *xyz, aur_error *error) AUR_NONNULL(1, 3);
/* The merged samples xyz[3 * size] of a rotation at an angle in [0, pi/2] and, in a table of several
 * roughnesses, the roughness `alpha` (otherwise ignored); their turns are aur_oswa_turns of the options'
 * seed. `capacity` counts doubles. Errors: ARGUMENT for another angle, a roughness or a rotation that is not
 * in the table, CAPACITY. */
AUR_EXPERIMENTAL aur_result aur_weight_table_points(const aur_weight_table *table, double radians,
                                                    double alpha, size_t rotation, bool mirrored,
                                                    size_t capacity, double *xyz, aur_error *error)
    AUR_NONNULL(1, 7);

/* weights[count + mirror_count] for one lobe (0: the first, 1: the mirror lobe), of integral 1, at an angle
 * in [0, pi/2] and a roughness as above; between two roughnesses hidden samples have weight 0 and the sum of
 * the others is preserved. They are floats, as stored in the table for renderers; `capacity` counts floats.
 * Errors: ARGUMENT for another angle, another lobe, a roughness or a rotation that is not in the table,
 * CAPACITY. */
AUR_EXPERIMENTAL aur_result aur_weight_table_look_up(const aur_weight_table *table, size_t lobe,
                                                     size_t rotation, double radians, double alpha,
                                                     size_t capacity, float *weights, aur_error *error)
    AUR_NONNULL(1, 7);
/* The mass of the mirror lobe at an angle (clamped to [0, pi/2]) and a roughness (clamped to the table's),
 * interpolated likewise. */
AUR_EXPERIMENTAL double aur_weight_table_mass(const aur_weight_table *table, double radians, double alpha)
    AUR_NONNULL(1);

/* --- weights without a linear system */

/* Veach's heuristics for samples drawn by several strategies: BALANCE proportional to n q, POWER to its
 * square. */
typedef enum aur_mis_heuristic { AUR_MIS_BALANCE, AUR_MIS_POWER } aur_mis_heuristic;

/* `count` samples drawn from a lobe. */
typedef struct aur_strategy {
    size_t count;
    aur_lobe sampled;
    double axis[3]; /* COSINE_POWER: its axis, a unit vector; all zero: +z */
} aur_strategy;

/* Multiple importance sampling weights (Veach 1997 ch. 9) of `count` samples xyz for the density `target`,
 * the weights of the first strategy first: h(u) p(u) / (n q(u)). With a single strategy they are the ratio
 * weights p/(n q). Samples where the target is 0 get 0. Errors: ARGUMENT for strategies whose counts do not
 * add up to `count`, whose lobe is out of its range or whose axis is not a unit vector, for a sample that its
 * strategy cannot have drawn, and for a target of kind NODES. */
AUR_API aur_result aur_mis_weights(aur_mis_heuristic heuristic, size_t strategy_count,
                                   const aur_strategy *strategies, const aur_potential *target, size_t count,
                                   const double *xyz, double *weights, aur_error *error)
    AUR_NONNULL(3, 4, 6, 7);

/* The importance re-weighting of Marques 2018 section 5.1: weights for p from weights for p', both
 * normalised: weights[i] *= p(u_i)/p'(u_i). Where p' is 0 the weight must be 0 and remains 0; else ARGUMENT.
 */
AUR_API aur_result aur_weights_reweight(const aur_potential *target, const aur_potential *fitted,
                                        size_t count, const double *xyz, double *weights, aur_error *error)
    AUR_NONNULL(1, 2, 4, 5);

#ifdef __cplusplus
}
#endif

#endif
