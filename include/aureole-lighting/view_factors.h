/* View factors: the fraction of the diffuse light that leaves one surface and arrives at another.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_VIEW_FACTORS_H
#define AUREOLE_VIEW_FACTORS_H

#include <aureole-render/scene.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The view factor from a planar convex polygon of from_count corners, from[3 * from_count], to another one,
 * unoccluded, both seen from their fronts (corners counter-clockwise). Parts behind the other polygon's plane
 * do not count. They may touch, but must not intersect. Contour integral, closed along one edge and by Gauss
 * quadrature along the other (Sparrow 1963): about twelve digits. Errors: ARGUMENT for fewer than 3 or more
 * than 2^16 corners, corners that are not finite, not coplanar (to 1e-6 of the polygon's size) or not convex,
 * and polygons without area; MEMORY. */
AUR_EXPERIMENTAL aur_result aur_view_factor_polygons(size_t from_count, const double *from, size_t to_count,
                                                     const double *to, double *factor, aur_error *error)
    AUR_NONNULL(2, 4, 5);

/* --- facets */

/* The triangles of a mesh or of a scene's meshes. They see along their normals (corners are counter-clockwise
 * seen from the front), and occlude from both sides. Immutable once loaded. */
typedef struct aur_facets aur_facets;

/* All zero but `size`, as set by aur_facets_options_init: one row for the front of every triangle. */
typedef struct aur_facets_options {
    size_t size;     /* of the caller's struct, so that it can grow */
    bool group;      /* one row per group of an OBJ, or per shape of a scene or PLY */
    bool both_sides; /* backs have rows too, after those of the fronts */
    size_t definition_count;
    const aur_definition *definitions; /* for scenes, as in aur_scene_options */
    bool confine;                      /* for scenes, as in aur_scene_options */
    /* One warning per kind, with the number and the first location: facets without area, overlapping facets,
     * open or inconsistent edges. */
    aur_warnings warnings;
    size_t further_count; /* for scenes: additional files, as in aur_scene_options */
    const char *const *further;
    bool diffuse; /* for scenes, as in aur_scene_options */
} aur_facets_options;

AUR_EXPERIMENTAL aur_result aur_facets_options_init(aur_facets_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Reads an OBJ, a PLY, STL or OFF, an input of View3D (.vs3; its combined surfaces are the rows) or a scene
 * (.xml, .rad). `options` may be NULL. Errors: OPEN, FORMAT (with file and line), UNSUPPORTED (other files;
 * shapes other than meshes; instances), those of aur_scene_load, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_facets_load(const char *path, const aur_facets_options *options,
                                            aur_facets **facets, aur_error *error) AUR_NONNULL(1, 3);
AUR_EXPERIMENTAL void aur_facets_destroy(aur_facets *facets); /* NULL is allowed */
/* The number of rows, and the area of each of them in squared units of length; owned by the facets. */
AUR_EXPERIMENTAL size_t aur_facets_rows(const aur_facets *facets) AUR_NONNULL(1);
AUR_EXPERIMENTAL const double *aur_facets_areas(const aur_facets *facets) AUR_NONNULL(1);
/* The name of the row's group, owned by the facets; NULL when rows are single facets. */
AUR_EXPERIMENTAL const char *aur_facets_name(const aur_facets *facets, size_t row) AUR_NONNULL(1);

/* The emittance of each row, in [0,1], if the file has them (.vs3); else NULL. Owned by the facets. */
AUR_EXPERIMENTAL const double *aur_facets_emittances(const aur_facets *facets) AUR_NONNULL(1);

/* --- the matrix */

/* All zero but `size`, as set by aur_view_factors_options_init, selects the defaults. */
typedef struct aur_view_factors_options {
    size_t size;           /* of the caller's struct, so that it can grow */
    size_t rays;           /* per facet and side, over all randomisations; 0: 2048 */
    size_t randomizations; /* independent randomisations, 2 .. 64, for confidence intervals; 0: 8 */
    const char *set;       /* a SET of four dimensions: position and direction; NULL: "sobol" */
    uint64_t seed;
    bool rays_only;    /* no closed forms and no half planes; for comparisons */
    double confidence; /* of the intervals, in (0,1); 0: 0.95 */
    size_t threads;    /* 0: all */
    aur_progress progress;
    aur_warnings warnings; /* backs that receive light, rows whose sum cannot be corrected to 1 */
    size_t half_planes;    /* for the sky, per facet and side, over all randomisations; 0: three for two rays
                            */
    /* Target half width: rays and half planes are doubled until no interval of a factor or of the sky is
     * wider; above 0. 0: no doubling. A warning is sent if the maximum of rays does not suffice. */
    double error;
} aur_view_factors_options;

AUR_EXPERIMENTAL aur_result aur_view_factors_options_init(aur_view_factors_options *options, aur_error *error)
    AUR_NONNULL(1);

typedef struct aur_view_factors aur_view_factors;

/* The view factors between all rows of `facets`, which may be destroyed afterwards. Pairs of facets that are
 * certainly unoccluded use the contour integral: no facet intersects the convex hull of the two, to the
 * precision of the mesh's coordinates. All others are estimated by rays with independent randomisations. The
 * sky is measured in half planes, exactly in elevation. Then the sampled factors are corrected by weighted
 * least squares (weights: their variances), so that every row with sky and backs sums to 1 and A_i F_ij = A_j
 * F_ji; no factor is negative. The result depends only on the facets and the options, not on threads. Errors:
 * NAME, ARGUMENT (options out of range), UNSUPPORTED (a set without four dimensions), CANCELLED, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_view_factors_create(const aur_facets *facets,
                                                    const aur_view_factors_options *options,
                                                    aur_view_factors **factors, aur_error *error)
    AUR_NONNULL(1, 3);
AUR_EXPERIMENTAL void aur_view_factors_destroy(aur_view_factors *factors); /* NULL is allowed */

/* The matrix as compressed sparse rows, owned by the view factors: row i has the entries starts[i] ..
 * starts[i+1]-1, columns ascending. `half_widths` are those of the intervals, 0 for closed forms. `sky` is
 * the fraction that leaves the scene; `back` is the fraction that arrives at backs of one-sided facets. A row
 * with both sums to 1. */
typedef struct aur_view_factors_matrix {
    size_t size; /* of the caller's struct, so that it can grow */
    size_t rows;
    const uint64_t *starts;    /* rows + 1 */
    const uint32_t *columns;   /* starts[rows] */
    const double *values;      /* starts[rows] */
    const double *half_widths; /* starts[rows] */
    const double *areas;       /* rows, as for all arrays below */
    const double *sky, *sky_half_widths;
    const double *back;
} aur_view_factors_matrix;

/* Errors: ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_view_factors_get_matrix(const aur_view_factors *factors,
                                                        aur_view_factors_matrix *matrix, aur_error *error)
    AUR_NONNULL(1, 2);

/* Statistics of the computation. The caller sets `size`. */
typedef struct aur_view_factors_description {
    size_t size;
    uint64_t rays;         /* traced */
    uint64_t closed_pairs; /* pairs of patches computed in closed form */
    uint64_t sampled_pairs;
    double closed_share;      /* share of all light between patches that closed forms cover */
    double largest_row_error; /* |sum of a row with sky and back - 1| after the correction */
    double raw_row_error;     /* root mean square of the same before the correction, weighted by area */
    double moved;             /* sum of |changes| of A_i F_ij by the correction, relative to their sum */
    double unseen; /* upper bound, at the options' confidence, of the factor of a pair without an entry: rays
                    * miss a larger one with half the remaining probability */
} aur_view_factors_description;

/* Errors: ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_view_factors_get_description(const aur_view_factors *factors,
                                                             aur_view_factors_description *description,
                                                             aur_error *error) AUR_NONNULL(1, 2);

/* Writes the matrix. Formats: "npz" (for scipy.sparse.load_npz, with the other arrays in the same file),
 * "csv" (one line per entry; the sky has the column -1, backs -2), "view3d" (the text of View3D's output: all
 * rows * rows factors), "udales" (uDALES's vfsparse.inp.NNN, which the path must be named, without factors
 * below 5e-7; svf.inp.NNN and facetarea.inp.NNN are written to the same folder). Errors: NAME, ARGUMENT
 * (another name), WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_view_factors_write(const aur_view_factors *factors, const char *format,
                                                   const char *path, aur_error *error) AUR_NONNULL(1, 2, 3);
/* Writes the facets as an input of View3D (.vs3), groups as combined surfaces. Errors: WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_facets_write_vs3(const aur_facets *facets, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);

/* Script F (Hottel; View3D's emit=1): area_i script_ik times the radiosity of a black row at the temperature
 * of i is the power that row i emits and row k absorbs, over all reflections. `emittances` [rows] are in
 * [0,1]. Row i sums to its emittance, with the sky as a black row. The matrix has an entry for all pairs
 * except rows of emittance 0. Intervals come from solutions for single randomisations. Errors: ARGUMENT (an
 * emittance out of range; no row absorbs and none sees the sky), MEMORY. */
AUR_EXPERIMENTAL aur_result aur_view_factors_script(const aur_view_factors *factors, const double *emittances,
                                                    double confidence, aur_view_factors **script,
                                                    aur_error *error) AUR_NONNULL(1, 2, 4);

/* --- radiosities */

/* Light on facets with diffuse reflection. At least one source must be nonzero. */
typedef struct aur_facets_light {
    size_t size;        /* of the caller's struct, so that it can grow */
    double reflectance; /* in [0,1] */
    double sky;         /* radiosity of the uniform sky */
    double emission;    /* of every facet, on the sides that see */
    double sun[3];      /* towards the sun; the length is the irradiance on a plane facing it; 0: none */
    /* Per row, in place of the two numbers above; NULL: not used. A grey body of emittance e at T kelvin has
     * the reflectance 1 - e and the emission e 5.670374419e-8 T^4. */
    const double *reflectances, *emissions;
} aur_facets_light;

AUR_EXPERIMENTAL aur_result aur_facets_light_init(aur_facets_light *light, aur_error *error) AUR_NONNULL(1);

/* Solves B = emission + reflectance (sun + sky + F B), for each row. With `factors` (of the same facets; else
 * NULL), products use the matrix; intervals come from the solutions for the matrices of single
 * randomisations. Without, rays are traced again for each reflection, in memory linear in the facets; the
 * solution is the mean over the randomisations, which also give the intervals. half_widths may be NULL, which
 * saves their time if there is a matrix. Later reflections, which carry less light, use fewer rays; the last
 * ones, together less than a fiftieth of the rays' error, are extrapolated as a geometric series. `sky` (may
 * be NULL) receives the sky factors. The sunlit part of each facet is always sampled, with four times as many
 * rays. Errors: ARGUMENT (numbers out of range, no source that a row sees, factors of other facets, a closed
 * scene that absorbs almost nothing), and those of aur_view_factors_create. */
AUR_EXPERIMENTAL aur_result aur_view_factors_radiosity(const aur_facets *facets,
                                                       const aur_view_factors *factors,
                                                       const aur_view_factors_options *options,
                                                       const aur_facets_light *light, double *radiosity,
                                                       double *half_widths, double *sky, aur_error *error)
    AUR_NONNULL(1, 4, 5);

/* Results to compute: the caller's arrays, [rows] each, or NULL. */
typedef struct aur_facets_radiosities {
    size_t size;         /* of the caller's struct, so that it can grow */
    double *radiosity;   /* light that leaves a row */
    double *half_widths; /* of the radiosity */
    double *sky;         /* sky factors */
    double *incoming;    /* light that arrives at a row: sun + sky + F B */
    double *incoming_half_widths;
} aur_facets_radiosities;

AUR_EXPERIMENTAL aur_result aur_facets_radiosities_init(aur_facets_radiosities *radiosities, aur_error *error)
    AUR_NONNULL(1);

/* As aur_view_factors_radiosity, with the incoming light. The net flux of a row is radiosity - incoming. */
AUR_EXPERIMENTAL aur_result aur_view_factors_solve(const aur_facets *facets, const aur_view_factors *factors,
                                                   const aur_view_factors_options *options,
                                                   const aur_facets_light *light,
                                                   const aur_facets_radiosities *radiosities,
                                                   aur_error *error) AUR_NONNULL(1, 4, 5);

#ifdef __cplusplus
}
#endif

#endif
