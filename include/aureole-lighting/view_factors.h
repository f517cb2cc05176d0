/* View factors: how much of what leaves one surface, diffusely, arrives at another.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_VIEW_FACTORS_H
#define AUREOLE_VIEW_FACTORS_H

#include <aureole-render/scene.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The view factor from a plane convex polygon of from_count corners, from[3 * from_count], to another one,
 * seen from their fronts (corners counter-clockwise), with nothing between them. What lies behind the other's
 * plane does not count. They may touch, but not cut each other. The contour integral in closed form along one
 * edge and by Gauss's rule along the other (Sparrow 1963): about twelve digits. Errors: ARGUMENT for fewer
 * than 3 or more than 2^16 corners, corners that are not finite, not in a plane (to 1e-6 of the polygon's
 * size) or not convex, and polygons without area; MEMORY. */
AUR_EXPERIMENTAL aur_result aur_view_factor_polygons(size_t from_count, const double *from, size_t to_count,
                                                     const double *to, double *factor, aur_error *error)
    AUR_NONNULL(2, 4, 5);

/* --- facets: what light goes between */

/* The triangles of a mesh or of a scene's meshes. They see along their normals (corners are counter-clockwise
 * seen from the front), and hide what is behind them from both sides. Immutable once loaded. */
typedef struct aur_facets aur_facets;

/* All zero but `size`, as aur_facets_options_init fills it: a row for the front of every triangle. */
typedef struct aur_facets_options {
    size_t size;     /* of the caller's struct, so that it can grow */
    bool group;      /* a row for each group of an OBJ, or each shape of a scene or PLY */
    bool both_sides; /* facets see on their backs too: the rows of the backs follow those of the fronts */
    size_t definition_count;
    const aur_definition *definitions; /* of scenes, as in aur_scene_options */
    bool confine;                      /* of scenes, the same */
    /* One for each kind of oddity, with how many there are and the first place: facets without area, facets
     * that lie on each other, open or inconsistent edges. */
    aur_warnings warnings;
    size_t further_count; /* of scenes: more files, as in aur_scene_options */
    const char *const *further;
    bool diffuse; /* of scenes, as in aur_scene_options */
} aur_facets_options;

AUR_EXPERIMENTAL aur_result aur_facets_options_init(aur_facets_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Reads an OBJ, a PLY, STL or OFF, an input of View3D (.vs3; its surfaces, combined as it says, are the rows)
 * or a scene (.xml, .rad). `options` may be NULL. Errors: OPEN, FORMAT (with file and line), UNSUPPORTED
 * (other files; shapes that are no meshes, or instances), those of aur_scene_load, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_facets_load(const char *path, const aur_facets_options *options,
                                            aur_facets **facets, aur_error *error) AUR_NONNULL(1, 3);
AUR_EXPERIMENTAL void aur_facets_destroy(aur_facets *facets); /* NULL is allowed */
/* The number of rows, and the area of each of them in squared units of length; owned by the facets. */
AUR_EXPERIMENTAL size_t aur_facets_rows(const aur_facets *facets) AUR_NONNULL(1);
AUR_EXPERIMENTAL const double *aur_facets_areas(const aur_facets *facets) AUR_NONNULL(1);
/* The name of the row's group, owned by the facets; NULL when rows are single facets. */
AUR_EXPERIMENTAL const char *aur_facets_name(const aur_facets *facets, size_t row) AUR_NONNULL(1);

/* The emittance of each row, in [0,1], where the file has them (.vs3); NULL elsewhere. Owned by the facets.
 */
AUR_EXPERIMENTAL const double *aur_facets_emittances(const aur_facets *facets) AUR_NONNULL(1);

/* --- the matrix */

/* All zero but `size`, as aur_view_factors_options_init fills it, takes the defaults. */
typedef struct aur_view_factors_options {
    size_t size;           /* of the caller's struct, so that it can grow */
    size_t rays;           /* from each facet and side, all randomisations together; 0: 2048 */
    size_t randomizations; /* independent ones, 2 .. 64, from which intervals come; 0: 8 */
    const char *set;       /* a SET of four dimensions: place and direction; NULL: "sobol" */
    uint64_t seed;
    bool rays_only;    /* no closed forms and no half planes: for comparisons */
    double confidence; /* of the intervals, in (0,1); 0: 0.95 */
    size_t threads;    /* 0: all */
    aur_progress progress;
    aur_warnings warnings; /* backs that are seen, rows that cannot be made to add up */
    size_t half_planes;    /* for the sky, from each facet and side, all randomisations together; 0: three
                              for two rays */
    /* Rays and half planes are doubled until no half width of a factor, and of the sky, is larger; above 0.
     * 0: once. A warning says when the most rays do not suffice. */
    double error;
} aur_view_factors_options;

AUR_EXPERIMENTAL aur_result aur_view_factors_options_init(aur_view_factors_options *options, aur_error *error)
    AUR_NONNULL(1);

typedef struct aur_view_factors aur_view_factors;

/* The view factors between all rows of `facets`, which need not outlive them. Pairs of facets that certainly
 * see each other wholly have the contour integral: nothing that is there crosses the hull of the two, to the
 * precision of the mesh's coordinates. All others are counted along rays, with independent randomisations;
 * the sky is measured in half planes, which have all elevations.
 * Then the sampled factors are moved as little as possible (least squares, in proportion to their variances)
 * so that every row with sky and backs adds up to 1 and A_i F_ij = A_j F_ji; no factor is negative. The
 * result is a function of the facets and the options, whatever the threads. Errors: NAME, ARGUMENT (options
 * out of range), UNSUPPORTED (a set without four dimensions), CANCELLED, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_view_factors_create(const aur_facets *facets,
                                                    const aur_view_factors_options *options,
                                                    aur_view_factors **factors, aur_error *error)
    AUR_NONNULL(1, 3);
AUR_EXPERIMENTAL void aur_view_factors_destroy(aur_view_factors *factors); /* NULL is allowed */

/* The matrix in compressed rows, owned by the view factors: row i has the entries starts[i] .. starts[i+1]-1,
 * columns ascending. `half_widths` are those of the intervals, 0 for closed forms. `sky` is what leaves the
 * scene and `back` what arrives at backs of facets that only see on their fronts: with them a row is 1. */
typedef struct aur_view_factors_matrix {
    size_t size; /* of the caller's struct, so that it can grow */
    size_t rows;
    const uint64_t *starts;    /* rows + 1 */
    const uint32_t *columns;   /* starts[rows] */
    const double *values;      /* starts[rows] */
    const double *half_widths; /* starts[rows] */
    const double *areas;       /* rows, as for all that follow */
    const double *sky, *sky_half_widths;
    const double *back;
} aur_view_factors_matrix;

/* Errors: ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_view_factors_get_matrix(const aur_view_factors *factors,
                                                        aur_view_factors_matrix *matrix, aur_error *error)
    AUR_NONNULL(1, 2);

/* How it came about. `size` is set by the caller. */
typedef struct aur_view_factors_description {
    size_t size;
    uint64_t rays;         /* traced */
    uint64_t closed_pairs; /* pairs of patches that have the closed form */
    uint64_t sampled_pairs;
    double closed_share;      /* of all light between patches, what closed forms carry */
    double largest_row_error; /* |sum of a row with sky and back - 1|: what could not be taken away */
    double raw_row_error;     /* root mean square of the same before the factors were moved, by area */
    double moved;             /* sum of |changes| of A_i F_ij over their sum */
    double unseen; /* a pair without an entry has no larger factor, with the options' confidence: what
                      rays would have missed with half the chance that is left */
} aur_view_factors_description;

/* Errors: ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_view_factors_get_description(const aur_view_factors *factors,
                                                             aur_view_factors_description *description,
                                                             aur_error *error) AUR_NONNULL(1, 2);

/* Writes the matrix. Formats: "npz" (scipy.sparse.load_npz reads it; the other arrays stand beside it),
 * "csv" (one line an entry; the sky has the column -1, backs -2), "view3d" (the text of View3D's output: all
 * rows * rows factors), "udales" (uDALES's vfsparse.inp.NNN, which the path must be named, without factors
 * below 5e-7; svf.inp.NNN and facetarea.inp.NNN go beside it). Errors: NAME, ARGUMENT (another name), WRITE,
 * MEMORY. */
AUR_EXPERIMENTAL aur_result aur_view_factors_write(const aur_view_factors *factors, const char *format,
                                                   const char *path, aur_error *error) AUR_NONNULL(1, 2, 3);
/* Writes the facets as an input of View3D (.vs3), with its groups as combined surfaces. Errors: WRITE,
 * MEMORY.
 */
AUR_EXPERIMENTAL aur_result aur_facets_write_vs3(const aur_facets *facets, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);

/* Script F (Hottel; View3D's emit=1): what leaves row i as its own emission and is absorbed by row k, over
 * all reflections, is area_i script_ik times the radiosity of a black row at the temperature of i.
 * `emittances` [rows] are in [0,1]. Row i adds up to its emittance, with the sky as a black row. The matrix
 * has an entry for all pairs, but for rows of emittance 0. Intervals are from the solutions of single
 * randomisations. Errors: ARGUMENT (an emittance out of range; no row absorbs and none sees the sky), MEMORY.
 */
AUR_EXPERIMENTAL aur_result aur_view_factors_script(const aur_view_factors *factors, const double *emittances,
                                                    double confidence, aur_view_factors **script,
                                                    aur_error *error) AUR_NONNULL(1, 2, 4);

/* --- radiosities */

/* Light on facets that reflect a part of it, diffusely. At least one source is not 0. */
typedef struct aur_facets_light {
    size_t size;        /* of the caller's struct, so that it can grow */
    double reflectance; /* in [0,1] */
    double sky;         /* the sky's radiosity, the same from everywhere */
    double emission;    /* of every facet, where it sees */
    double sun[3];      /* to the sun; the length is the irradiance of what faces it; 0: none */
    /* Of each row, in place of the two numbers above; NULL: those. A grey body of emittance e at T kelvin has
     * the reflectance 1 - e and the emission e 5.670374419e-8 T^4. */
    const double *reflectances, *emissions;
} aur_facets_light;

AUR_EXPERIMENTAL aur_result aur_facets_light_init(aur_facets_light *light, aur_error *error) AUR_NONNULL(1);

/* B = emission + reflectance (sun + sky + F B), for each row. With `factors` (of the same facets; else NULL)
 * the products are the matrix's, and solutions by the matrices of its single randomisations say what the one
 * by their mean errs by. Without, rays are traced again for each reflection, in memory that grows with the
 * facets alone: the solution is the mean of one for each randomisation, from which the intervals come.
 * half_widths may be NULL, which spares their time where there is a matrix. Later reflections, which carry
 * less light, have fewer rays; the last ones, which together are less than a fiftieth of what rays err by,
 * are a geometric series. `sky` (may be NULL) becomes the sky factors. Of the sun, the lit part of each facet
 * is always counted, along four times as many rays. Errors: ARGUMENT (numbers out of range, no source that a
 * row sees, factors of other facets, a closed scene that absorbs almost nothing), and those of
 * aur_view_factors_create. */
AUR_EXPERIMENTAL aur_result aur_view_factors_radiosity(const aur_facets *facets,
                                                       const aur_view_factors *factors,
                                                       const aur_view_factors_options *options,
                                                       const aur_facets_light *light, double *radiosity,
                                                       double *half_widths, double *sky, aur_error *error)
    AUR_NONNULL(1, 4, 5);

/* What is wanted of the rows: arrays of the caller's, [rows] each, or NULL. */
typedef struct aur_facets_radiosities {
    size_t size;         /* of the caller's struct, so that it can grow */
    double *radiosity;   /* what leaves a row */
    double *half_widths; /* of the radiosity */
    double *sky;         /* sky factors */
    double *incoming;    /* what arrives at a row: sun + sky + F B */
    double *incoming_half_widths;
} aur_facets_radiosities;

AUR_EXPERIMENTAL aur_result aur_facets_radiosities_init(aur_facets_radiosities *radiosities, aur_error *error)
    AUR_NONNULL(1);

/* As aur_view_factors_radiosity, with what arrives too. Its net flux is radiosity - incoming. */
AUR_EXPERIMENTAL aur_result aur_view_factors_solve(const aur_facets *facets, const aur_view_factors *factors,
                                                   const aur_view_factors_options *options,
                                                   const aur_facets_light *light,
                                                   const aur_facets_radiosities *radiosities,
                                                   aur_error *error) AUR_NONNULL(1, 4, 5);

#ifdef __cplusplus
}
#endif

#endif
