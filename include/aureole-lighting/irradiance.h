/* Irradiance: how much light arrives at points that look in given directions, with how sure that is.
 *
 * A sensor is a point and a normal; it receives what comes from the hemisphere about the normal, weighted by
 * the cosine. Values are in the unit of the scene's radiance times steradians: watts a square metre where
 * radiance is in watts a square metre and steradian.
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

/* Sensors in arrays of the caller's, which are only read. */
typedef struct aur_sensors_view {
    size_t size; /* of the caller's struct, so that it can grow */
    size_t count;
    const double *positions; /* 3 * count, in scene units */
    const double *normals;   /* 3 * count, of any length but 0 */
    const size_t *lines;     /* count: the line of each sensor in its file, for messages; or NULL */
    const char *file;        /* for messages; NULL: none */
    /* Of sensors on a mesh, for files that show it: the sensors at its corners, 3 * triangle_count, where
     * they stand on vertices; the corners themselves, 9 * count, where they stand on faces; else NULL. */
    size_t triangle_count;
    const uint32_t *triangles;
    const double *corners;
} aur_sensors_view;

/* Sensors that the library read, and keeps until aur_sensors_destroy (NULL is allowed). */
typedef struct aur_sensors aur_sensors;

/* Where sensors stand on a mesh: in the middle of each triangle, with its normal, or at each vertex, with the
 * mean of the normals around it by their angles there. */
typedef enum aur_sensors_place { AUR_SENSORS_ON_FACES, AUR_SENSORS_ON_VERTICES } aur_sensors_place;

/* All zero but `size`, as aur_sensors_options_init fills it, takes the defaults. */
typedef struct aur_sensors_options {
    size_t size; /* of the caller's struct, so that it can grow */
    aur_sensors_place place;
    double lift;           /* all sensors are moved so far along their normals, in scene units */
    aur_warnings warnings; /* of meshes: facets that lie on each other, open or inconsistent edges */
} aur_sensors_options;

AUR_EXPERIMENTAL aur_result aur_sensors_options_init(aur_sensors_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Reads six numbers a line, x y z nx ny nz, with blanks or commas between them (Radiance's .pts, and CSV with
 * or without a header), an NPY array of six columns, or a mesh (.obj, .ply, .stl, .off). `options` may be
 * NULL. Errors: OPEN, MEMORY, ARGUMENT (a lift that is not finite), and FORMAT with the line: numbers that
 * are not finite, other than six columns, a normal of length 0, places beyond 1e18, a file without sensors, a
 * facet without area. */
AUR_EXPERIMENTAL aur_result aur_sensors_read(const char *path, const aur_sensors_options *options,
                                             aur_sensors **sensors, aur_error *error) AUR_NONNULL(1, 3);

/* Sensors in square cells over flat surfaces, at their middles. */
typedef struct aur_grid_options {
    size_t size; /* of the caller's struct, so that it can grow */
    /* A surface of the scene by its name (the id in XML, the identifier in Radiance's files; * and ? match
     * any text, and several surfaces may match), a mesh file, or a rectangle: "X0,Y0,X1,Y1,H" at the height
     * H, or nine numbers, a corner and two edges. */
    const char *target;
    double spacing; /* of the cells, scene units, above 0; as many as fit, centred */
    double height;  /* above the surface */
    double margin;  /* from the edges of all surfaces together, 0 or more */
    double up[3];   /* 0 0 0: +z with a file of Radiance's in the scene, else +y. Sensors on what lies level
                       look up, others along the normal */
    aur_warnings warnings; /* of meshes, as in aur_sensors_options */
} aur_grid_options;

AUR_EXPERIMENTAL aur_result aur_grid_options_init(aur_grid_options *options, aur_error *error) AUR_NONNULL(1);
/* Errors: ARGUMENT (numbers that cannot be, more than 2^24 cells, none on the surface), NAME for a surface
 * that is not there, those of aur_sensors_read for meshes, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_sensors_grid(const aur_scene *scene, const aur_grid_options *options,
                                             aur_sensors **sensors, aur_error *error) AUR_NONNULL(1, 2, 3);
AUR_EXPERIMENTAL void aur_sensors_destroy(aur_sensors *sensors);
/* Their arrays, with all fields set, for as long as they are kept. */
AUR_EXPERIMENTAL const aur_sensors_view *aur_sensors_get_view(const aur_sensors *sensors) AUR_NONNULL(1);

/* --- estimates */

enum { AUR_IRRADIANCE_REPLICATES = 16 }; /* independent randomisations, from which errors come */

/* How light that was reflected is found: by paths; or by a photon map or a radiosity solution, whose errors a
 * quarter of the paths take away, so that there is no bias either. The map and the solution are found again
 * in each call: they are for many sensors. */
typedef enum aur_reflected {
    AUR_REFLECTED_BY_PATHS,
    AUR_REFLECTED_BY_MAP,
    AUR_REFLECTED_BY_RADIOSITY
} aur_reflected;

/* "paths", "map", "radiosity" to the value and back. Errors: NAME, *reflected untouched; the name of a value
 * out of range is NULL. */
AUR_API aur_result aur_reflected_from_name(const char *name, aur_reflected *reflected, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_reflected_name(aur_reflected reflected);

/* All zero but `size`, as aur_irradiance_options_init fills it, takes the defaults. */
typedef struct aur_irradiance_options {
    size_t size;       /* of the caller's struct, so that it can grow */
    const char *set;   /* a SET of directions; NULL: "spherical-fibonacci" */
    size_t directions; /* from each sensor, all randomisations together, rounded up to a multiple of their
                          number; 0: 16384. With `error`: at most so many; 0: 2^20 */
    /* Each sensor goes on until half the width of its interval, of `confidence`, is at most this part of its
     * luminance; 0: all have the same number of directions. */
    double error;
    double confidence; /* in (0,1); 0: .95 */
    size_t max_depth;  /* edges of a light path: 1 is light straight from lights and sky; 0: no limit */
    /* Luminance is the sum of r, g, b times these; all 0: 0.2126, 0.7152, 0.0722 (Rec. 709). */
    double luminance[3];
    uint64_t seed;
    size_t threads; /* 0: all */
    aur_progress progress;
    aur_warnings warnings; /* sensors on surfaces, inside solids, without light, or whose error was not
                              reached: one warning for each kind, with their number and the first */
    aur_reflected reflected;
    size_t particles; /* of the map or the solution; 0: 500,000 */
} aur_irradiance_options;

AUR_EXPERIMENTAL aur_result aur_irradiance_options_init(aur_irradiance_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Where light comes from: all of it; straight from lights; straight from the sky (a light that is all
 * around); all that was reflected or refracted on its way; straight from the sun (a disk of the sky of 5
 * degrees at most from its centre). What goes straight through panes comes straight. */
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

/* What one sensor receives. */
typedef struct aur_irradiance {
    double value[AUR_IRRADIANCE_PARTS][AUR_IRRADIANCE_CHANNELS];
    double error[AUR_IRRADIANCE_PARTS][AUR_IRRADIANCE_CHANNELS]; /* standard errors */
    /* Half the width of the interval of the total that holds the expectation with the options' confidence:
     * Student's, over the randomisations. */
    double half_width[AUR_IRRADIANCE_CHANNELS];
    uint64_t directions;
    double dark;     /* the share of directions that meet the black back of a surface */
    bool on_surface; /* the sensor lay on one, and looked from just above */
    bool doubtful;   /* surfaces there are too near to each other to tell what covers the sensor */
} aur_irradiance;

/* Estimates the irradiance at each sensor: cosine distributed directions of one set, randomised independently
 * 16 times at every sensor, a point on a light for each of them, both weighed by the power heuristic (Veach
 * 1997), and further bounces as options->reflected says. Without bias at a given number of directions.
 * `results` has sensors->count elements of `result_size` bytes, the caller's sizeof. A sensor's result is a
 * function of the scene, the options, its position and its normal: neither of other sensors nor of threads.
 * Errors: NAME, ARGUMENT (options out of range; a normal of length 0, a number that is not finite or a place
 * beyond 1e18, with its line), UNSUPPORTED (a scene without any light, or one that the map or radiosity
 * cannot do, with the place), CANCELLED, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_irradiance_estimate(const aur_scene *scene, const aur_sensors_view *sensors,
                                                    const aur_irradiance_options *options, size_t result_size,
                                                    aur_irradiance *results, aur_error *error)
    AUR_NONNULL(1, 2, 5);

/* What is written of each sensor: x, y, z, r, g, b and their standard errors, unless the options say more or
 * less. All zero but `size` are the defaults. */
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

/* Writes to `path` ("-": standard output), replaced whole or not at all. Formats: "csv"; "json", an array of
 * objects; "npy", an array of float64 with a row a sensor; "ply", the mesh on which sensors stand, or points,
 * with colours and the columns as properties: sRGB of r, g, b over the largest of them, or of the luminance;
 * "rtrace", r, g and b alone as Radiance's rtrace -h -I writes them.
 * Errors: NAME, ARGUMENT, WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_irradiance_write(const char *path, const char *format,
                                                 const aur_irradiance_columns *columns,
                                                 const aur_sensors_view *sensors, size_t result_size,
                                                 const aur_irradiance *results, aur_error *error)
    AUR_NONNULL(1, 2, 4, 6);

#ifdef __cplusplus
}
#endif

#endif
