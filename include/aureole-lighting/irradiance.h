/* Irradiance at sensor points, with standard errors and confidence intervals.
 *
 * A sensor is a point and a normal; it receives the light of the hemisphere about the normal, weighted by the
 * cosine. Values are in the unit of the scene's radiance times steradians: W/m^2 if radiance is in W/m^2/sr.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_IRRADIANCE_H
#define AUREOLE_IRRADIANCE_H

#include <aureole-render/scene.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- sensors */

/* Sensors in the caller's arrays, which are only read. */
typedef struct aur_sensors_view {
    size_t size; /* of the caller's struct, so that it can grow */
    size_t count;
    const double *positions; /* 3 * count, in scene units */
    const double *normals;   /* 3 * count, of any nonzero length */
    const size_t *lines;     /* count: the line of each sensor in its file, for messages; or NULL */
    const char *file;        /* for messages; NULL: none */
    /* For sensors on a mesh, for files that show the mesh: if sensors are at vertices, the sensors at the
     * triangles' corners, 3 * triangle_count; if sensors are on faces, the corners, 9 * count; else NULL. */
    size_t triangle_count;
    const uint32_t *triangles;
    const double *corners;
} aur_sensors_view;

/* Sensors that the library has read; valid until aur_sensors_destroy (NULL is allowed). */
typedef struct aur_sensors aur_sensors;

/* Placement of sensors on a mesh: at the middle of each triangle with its normal, or at each vertex with the
 * angle-weighted mean normal. */
typedef enum aur_sensors_place { AUR_SENSORS_ON_FACES, AUR_SENSORS_ON_VERTICES } aur_sensors_place;

/* All zero but `size`, as set by aur_sensors_options_init, selects the defaults. */
typedef struct aur_sensors_options {
    size_t size; /* of the caller's struct, so that it can grow */
    aur_sensors_place place;
    double lift;           /* offset of all sensors along their normals, in scene units */
    aur_warnings warnings; /* of meshes: overlapping facets, open or inconsistent edges */
} aur_sensors_options;

AUR_EXPERIMENTAL aur_result aur_sensors_options_init(aur_sensors_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Reads six numbers per line, x y z nx ny nz, separated by blanks or commas (Radiance's .pts, and CSV with or
 * without a header), an NPY array of six columns, or a mesh (.obj, .ply, .stl, .off). `options` may be NULL.
 * Errors: OPEN, MEMORY, ARGUMENT (a lift that is not finite), and FORMAT with the line: numbers that are not
 * finite, a wrong number of columns, a normal of length 0, coordinates beyond 1e18, a file without sensors, a
 * facet without area. */
AUR_EXPERIMENTAL aur_result aur_sensors_read(const char *path, const aur_sensors_options *options,
                                             aur_sensors **sensors, aur_error *error) AUR_NONNULL(1, 3);

/* Sensors at the centres of square cells over planar surfaces. */
typedef struct aur_grid_options {
    size_t size; /* of the caller's struct, so that it can grow */
    /* A surface of the scene by name (the id in XML, the identifier in Radiance's files; * and ? are
     * wildcards, and several surfaces may match), a mesh file, or a rectangle: "X0,Y0,X1,Y1,H" at the height
     * H, or nine numbers, a corner and two edges. */
    const char *target;
    double spacing; /* cell size in scene units, above 0; the grid is centred */
    double height;  /* above the surface */
    double margin;  /* distance to the edges of the union of surfaces, at least 0 */
    double up[3];   /* 0 0 0: +z if the scene has a Radiance file, else +y. Sensors on horizontal surfaces
                     * face up, others along the normal */
    aur_warnings warnings; /* of meshes, as in aur_sensors_options */
} aur_grid_options;

AUR_EXPERIMENTAL aur_result aur_grid_options_init(aur_grid_options *options, aur_error *error) AUR_NONNULL(1);
/* Errors: ARGUMENT (numbers out of range, more than 2^24 cells, no cell on the surface), NAME for a surface
 * that does not exist, those of aur_sensors_read for meshes, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_sensors_grid(const aur_scene *scene, const aur_grid_options *options,
                                             aur_sensors **sensors, aur_error *error) AUR_NONNULL(1, 2, 3);
AUR_EXPERIMENTAL void aur_sensors_destroy(aur_sensors *sensors);
/* Their arrays, with all fields set; valid until the sensors are destroyed. */
AUR_EXPERIMENTAL const aur_sensors_view *aur_sensors_get_view(const aur_sensors *sensors) AUR_NONNULL(1);

/* --- estimates */

enum { AUR_IRRADIANCE_REPLICATES = 16 }; /* independent randomisations, from which errors are estimated */

/* How reflected light is computed: by path tracing; or by a photon map or a radiosity solution, whose bias is
 * removed by tracing a quarter of the paths further. The map and the solution are recomputed by each call, so
 * that they pay off for many sensors. */
typedef enum aur_reflected {
    AUR_REFLECTED_BY_PATHS,
    AUR_REFLECTED_BY_MAP,
    AUR_REFLECTED_BY_RADIOSITY
} aur_reflected;

/* Convert between "paths", "map", "radiosity" and the value. Errors: NAME, *reflected unchanged; the name of
 * a value out of range is NULL. */
AUR_API aur_result aur_reflected_from_name(const char *name, aur_reflected *reflected, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_reflected_name(aur_reflected reflected);

/* All zero but `size`, as set by aur_irradiance_options_init, selects the defaults. */
typedef struct aur_irradiance_options {
    size_t size;       /* of the caller's struct, so that it can grow */
    const char *set;   /* a SET of directions; NULL: "spherical-fibonacci" */
    size_t directions; /* per sensor, over all randomisations, rounded up to a multiple of their number; 0:
                        * 16384. With `error`: the maximum; 0: 2^20 */
    /* Target relative error: directions are added at each sensor until the half width of the confidence
     * interval is at most this fraction of its luminance. 0: the same number of directions at all sensors. */
    double error;
    double confidence; /* in (0,1); 0: .95 */
    size_t max_depth;  /* edges of a light path: 1 is direct light from light sources and the sky; 0: no limit
                        */
    /* Luminance is the sum of r, g, b times these; all 0: 0.2126, 0.7152, 0.0722 (Rec. 709). */
    double luminance[3];
    uint64_t seed;
    size_t threads; /* 0: all */
    aur_progress progress;
    aur_warnings warnings; /* sensors on surfaces, inside solids, without light, or whose target error was not
                            * reached: one warning per kind, with the number and the first sensor */
    aur_reflected reflected;
    size_t particles; /* photons of the map or particles of the solution; 0: 500,000 */
} aur_irradiance_options;

AUR_EXPERIMENTAL aur_result aur_irradiance_options_init(aur_irradiance_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Components of the light: total; direct from light sources; direct from the sky (an environment light);
 * light that was reflected or refracted; direct from the sun (a disk of the sky within 5 degrees of its
 * centre). Light through thin panes counts as direct. */
typedef enum aur_irradiance_part {
    AUR_IRRADIANCE_TOTAL,
    AUR_IRRADIANCE_DIRECT,
    AUR_IRRADIANCE_SKY,
    AUR_IRRADIANCE_REFLECTED,
    AUR_IRRADIANCE_SUN,
    AUR_IRRADIANCE_PARTS
} aur_irradiance_part;

/* r, g, b and luminance. */
enum { AUR_IRRADIANCE_CHANNELS = 4 };

/* The irradiance of one sensor. */
typedef struct aur_irradiance {
    double value[AUR_IRRADIANCE_PARTS][AUR_IRRADIANCE_CHANNELS];
    double error[AUR_IRRADIANCE_PARTS][AUR_IRRADIANCE_CHANNELS]; /* standard errors */
    /* Half width of the confidence interval of the total at the options' confidence: Student's t over the
     * randomisations. */
    double half_width[AUR_IRRADIANCE_CHANNELS];
    uint64_t directions;
    double dark;     /* share of directions that hit the black back of a surface */
    bool on_surface; /* the sensor lies on a surface; it was evaluated just above it */
    bool doubtful;   /* surfaces are too close together to determine whether one covers the sensor */
} aur_irradiance;

/* Estimates the irradiance at each sensor by cosine-distributed directions of one set, randomised
 * independently 16 times per sensor. Each direction is paired with a point on a light source by the power
 * heuristic (Veach 1997); options->reflected selects the further bounces. Unbiased for a fixed number of
 * directions. `results` has sensors->count elements of `result_size` bytes (the caller's sizeof). A sensor's
 * result depends only on the scene, the options, its position and its normal, not on other sensors or
 * threads. Errors: NAME, ARGUMENT (options out of range; a normal of length 0, a number that is not finite or
 * a coordinate beyond 1e18, with its line), UNSUPPORTED (a scene without any light, or one that the map or
 * radiosity does not support, with the place), CANCELLED, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_irradiance_estimate(const aur_scene *scene, const aur_sensors_view *sensors,
                                                    const aur_irradiance_options *options, size_t result_size,
                                                    aur_irradiance *results, aur_error *error)
    AUR_NONNULL(1, 2, 5);

/* Columns to write: by default x, y, z, r, g, b and their standard errors. All zero but `size` selects the
 * defaults. */
typedef struct aur_irradiance_columns {
    size_t size;      /* of the caller's struct, so that it can grow */
    bool luminance;   /* in the place of r, g, b */
    bool parts;       /* direct, sky, reflected and the sun's light after the total */
    bool intervals;   /* half widths after the standard errors of the total */
    bool no_errors;   /* no standard errors */
    bool normals;     /* nx, ny, nz after x, y, z */
    bool directions;  /* how many there were */
    const char *unit; /* the luminance's name in headers; NULL: "luminance" */
} aur_irradiance_columns;

/* Writes to `path` ("-": standard output) atomically. Formats: "csv"; "json", an array of objects; "npy", a
 * float64 array with a row per sensor; "ply", the sensors' mesh, or points, with the columns as properties
 * and sRGB colours: r, g, b scaled by the largest of them, or the luminance; "rtrace", r, g and b only, as
 * Radiance's rtrace -h -I writes them. Errors: NAME, ARGUMENT, WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_irradiance_write(const char *path, const char *format,
                                                 const aur_irradiance_columns *columns,
                                                 const aur_sensors_view *sensors, size_t result_size,
                                                 const aur_irradiance *results, aur_error *error)
    AUR_NONNULL(1, 2, 4, 6);

#ifdef __cplusplus
}
#endif

#endif
