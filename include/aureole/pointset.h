/* Point sets on the unit cube [0,1)^d, their scramblings, and files of points.
 *
 * A set is named by the same text everywhere: NAME[:key=value[,key=value...]], file:PATH, file:NAME-%d.csv or
 * file:FOLDER with a file for each number of points (%d in the name, or the last number of the names in the
 * folder), or callback:NAME for a function of aur_set_register. Points are random access: point i is computed
 * from i, so that any thread can compute any part of a set in any order. */
#ifndef AUREOLE_POINTSET_H
#define AUREOLE_POINTSET_H

#include <aureole/tables.h>
#include <stdbool.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The domain of points. The disk is the unit disk; hemisphere and sphere have z up, polar angle theta from
 * +z, azimuth phi from +x towards +y, and unit radius. AUR_DOMAIN_CUBE is [0,1)^d with d other than 2. AXES
 * are undirected lines, the projective plane: x and -x are one axis, and sets return the one with z >= 0.
 * ROTATIONS are unit quaternions w,x,y,z; q and -q are one rotation. */
typedef enum aur_domain {
    AUR_DOMAIN_SQUARE,
    AUR_DOMAIN_CUBE,
    AUR_DOMAIN_DISK,
    AUR_DOMAIN_HEMISPHERE,
    AUR_DOMAIN_SPHERE,
    AUR_DOMAIN_AXES,
    AUR_DOMAIN_ROTATIONS
} aur_domain;

/* "square", "cube", "disk", "hemisphere", "sphere", "axes", "rotations" to the value and back. Errors: NAME;
 * the name of a value out of range is NULL. */
AUR_API aur_result aur_domain_from_name(const char *name, aur_domain *domain, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_domain_name(aur_domain domain);

/* How a set is randomised. DIGIT: Kollig-Keller, one XOR word per dimension; OWEN: nested scrambling whose
 * flips are one hash of the preceding digits (Burley 2020). Means and variances are as with uniform
 * scrambling: pairs of points are distributed as under NESTED, larger groups are not; NESTED: Owen's nested
 * uniform scrambling with independent flips, for sets of binary digits, about ten times slower; SHIFT:
 * Cranley-Patterson, addition modulo 1; ROTATE: a random rotation about z (on the square: a shift of the
 * azimuth coordinate, which is the second); ROTATE3D: a uniformly random rotation of the sphere. */
typedef enum aur_scramble {
    AUR_SCRAMBLE_NONE,
    AUR_SCRAMBLE_DIGIT,
    AUR_SCRAMBLE_OWEN,
    AUR_SCRAMBLE_SHIFT,
    AUR_SCRAMBLE_ROTATE,
    AUR_SCRAMBLE_ROTATE3D,
    AUR_SCRAMBLE_NESTED
} aur_scramble;

/* "none", "digit", "owen", "shift", "rotate", "rotate3d", "nested" to the value and back. Errors: NAME,
 * *scramble untouched; the name of a value out of range is NULL. */
AUR_API aur_result aur_scramble_from_name(const char *name, aur_scramble *scramble, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_scramble_name(aur_scramble scramble);

/* Sizes at which a set has its best quality. */
typedef enum aur_sizes {
    AUR_SIZES_ANY,       /* none are */
    AUR_SIZES_POWERS,    /* powers of a base: the points are then a complete net */
    AUR_SIZES_FIBONACCI, /* Fibonacci numbers: the points are then a lattice */
    AUR_SIZES_GRIDS      /* 1, 2, 3 and 4 times BASE * 4^LEVELS: no sub-grid is then left incomplete */
} aur_sizes;

/* One row of the table of sets. */
typedef struct aur_set_description {
    aur_row row;
    /* Bits 1 << aur_domain: the native domains of its points. A map takes points of the square to the disk,
     * the hemisphere and the sphere. */
    unsigned domains;
    size_t dimensions[2]; /* least and largest; {3, 3} for sets that are native to the sphere */
    /* For a set with certain sizes only: the size at an index, ascending, 0 beyond the last. NULL: any size.
     */
    uint64_t (*size_at)(size_t index);
    uint64_t maximum_size;   /* the largest number of points; UINT64_MAX: no limit */
    bool counts_coordinates; /* maximum_size limits points times dimension, the length of a stream of numbers
                              */
    bool sized_by_file;      /* a user's file determines the largest number of points */
    aur_sizes best_sizes;
    uint32_t size_base; /* of POWERS; 0 where a key or a file determines it */
    bool extensible;    /* the first n points of a larger set are the smaller set */
    bool binary_net;    /* 2^k points are a net in base 2: digit and Owen scrambling preserve the net */
} aur_set_description;

/* Describes the sizes: "any", "1..2^48; a lattice at F_k", "4, 8, 18, .. 328": written into text[capacity],
 * always terminated. Returns the length of the whole text, as snprintf does. */
AUR_API size_t aur_set_sizes(const aur_set_description *set, size_t capacity, char *text) AUR_NONNULL(1);

/* A prepared set: an immutable table or rule that any number of threads may read. */
typedef struct aur_pointset aur_pointset;

typedef struct aur_pointset_options {
    size_t size;           /* sizeof the caller's struct */
    uint64_t count;        /* points of the set: at least 1; 0: all points of file:PATH */
    size_t dimension;      /* 0: 2, or that of a file, a vector or a set of one dimension */
    aur_scramble scramble; /* NONE, DIGIT, OWEN, SHIFT or ROTATE */
    uint64_t seed;         /* of scrambling and of random sets */
    aur_warnings warnings; /* "n is not a power of two", ... */
} aur_pointset_options;

/* A set of two dimensions that is not scrambled. */
AUR_API aur_result aur_pointset_options_init(uint64_t count, aur_pointset_options *options, aur_error *error)
    AUR_NONNULL(2);

/* Points computed by a program, as the set "callback:NAME" wherever a SET is read: measures, weights,
 * integrators of scenes, the lab. Experimental. */
typedef struct aur_set_callback {
    size_t size;       /* sizeof the caller's struct */
    const char *name;  /* letters, digits, '-', '_' and '.'; copied */
    aur_domain domain; /* where the points are: those of the SQUARE are mapped as other sets are */
    bool weighted;     /* the function also writes weights; they should add up to 1 */
    void *user;        /* first argument of the function */
    /* Writes `count` >= 1 points one after another into points[count * dimension], which is checked like a
     * file, and weights[count] where weighted (else NULL). dimension is 2 on square and disk, 3 for
     * directions, 4 for rotations (w,x,y,z), and the requested dimension on the cube. Called at any time,
     * also repeatedly, by any thread, several at once: the same arguments must give the same points. A result
     * other than AUR_OK ends the work; the function should then fill *error, which is never NULL here. */
    aur_result (*generate)(void *user, uint64_t count, size_t dimension, double *points, double *weights,
                           aur_error *error);
} aur_set_callback;

/* Registers the set for the whole process, in place of an earlier one of its name; `generate` NULL removes
 * it. Sets created earlier keep their points. May be called by any thread. Errors: ARGUMENT for a name or
 * domain, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_set_register(const aur_set_callback *callback, aur_error *error)
    AUR_NONNULL(1);

/* Prepares the set that `set` names. Errors: NAME for an unknown set or key, FORMAT, ARGUMENT for a count or
 * dimension that the set does not have, UNSUPPORTED for a scrambling that the set does not support, MEMORY.
 */
AUR_API aur_result aur_pointset_create(const char *set, const aur_pointset_options *options,
                                       aur_pointset **pointset, aur_error *error) AUR_NONNULL(1, 2, 3);
AUR_API void aur_pointset_destroy(aur_pointset *pointset); /* NULL is allowed */

/* The number of coordinates per point, and of points: for file:PATH those of the file, unless fewer points
 * were requested. */
AUR_API size_t aur_pointset_dimension(const aur_pointset *pointset) AUR_NONNULL(1);
AUR_API uint64_t aur_pointset_size(const aur_pointset *pointset) AUR_NONNULL(1);

/* Writes points first .. first+count-1, one after another, into points[count * dimension]; `capacity` counts
 * doubles. Every coordinate is in [0,1). Errors: ARGUMENT for a range beyond the set, CAPACITY. */
AUR_API aur_result aur_pointset_points(const aur_pointset *pointset, uint64_t first, size_t count,
                                       size_t capacity, double *points, aur_error *error) AUR_NONNULL(1, 5);

/* The layout of coordinates in memory. POINTS: one point after another, coordinate d of point i at i *
 * dimension + d. ARRAYS: one array per coordinate, at d * stride + i. */
typedef enum aur_layout { AUR_LAYOUT_POINTS, AUR_LAYOUT_ARRAYS } aur_layout;

/* A buffer for coordinates: exactly one of `doubles` and `floats` is not NULL. Floats are the doubles
 * truncated to 24 binary digits, so they stay below 1 and in their elementary intervals. */
typedef struct aur_output {
    aur_layout layout;
    size_t stride;   /* ARRAYS: at least the number of points; 0: that number */
    size_t capacity; /* elements of the buffer */
    double *doubles;
    float *floats;
} aur_output;

/* Coordinates dimension .. dimension + dimension_count - 1 of the points first .. first+count-1 in any
 * layout, as if the points had no others. Errors: ARGUMENT for a dimension or a range beyond the set or an
 * inconsistent output, CAPACITY. */
AUR_API aur_result aur_pointset_coordinates(const aur_pointset *pointset, size_t dimension,
                                            size_t dimension_count, uint64_t first, size_t count,
                                            const aur_output *output, aur_error *error) AUR_NONNULL(1, 6);

/* All coordinates with another seed of the scrambling: any number of independent randomisations of one set,
 * without preparing it again. Random numbers inside the set (random, jittered, permutations, linear
 * scrambling) still come from the set's seed. Errors: also UNSUPPORTED when the set is not scrambled. */
AUR_API aur_result aur_pointset_randomize(const aur_pointset *pointset, uint64_t seed, uint64_t first,
                                          size_t count, const aur_output *output, aur_error *error)
    AUR_NONNULL(1, 5);

/* One coordinate of one point, or NaN for an index or dimension beyond the set. Each call repeats the set-up
 * of a run: in loops aur_pointset_coordinates is faster. */
AUR_API double aur_pointset_coordinate(const aur_pointset *pointset, uint64_t index, size_t dimension)
    AUR_NONNULL(1);

/* A whole golden point set in time proportional to `count` (Schretter 2012, eqs 6-7): coordinates G_s(i), i =
 * 1, .., count, paired with the same numbers in ascending order. Parts of the set cannot be computed: the
 * order is followed from its smallest number. 0 <= s < 1, count <= 2^32. */
AUR_API aur_result aur_golden_set_points(double s, size_t count, const aur_output *output, aur_error *error)
    AUR_NONNULL(3);

/* A view of points in the caller's arrays, which are read, but neither copied nor stored. Functions that
 * measure or write points take a view, so that no program needs to convert its arrays. */
typedef struct aur_points_view {
    size_t size; /* sizeof the caller's struct */
    aur_domain domain;
    size_t count;
    size_t dimension; /* coordinates per point: d on the cube, 2 on square and disk, 3 on hemisphere and
                         sphere */
    size_t stride;    /* doubles from one point to the next, at least `dimension`; 0: `dimension` */
    const double *coordinates;
    const double *weights; /* count, or NULL */
    const size_t *lines;   /* count: the line of each point in its file, for messages; or NULL */
    bool guessed; /* for points of a file: the file does not give the domain, and the numbers are valid in
                     other domains, too */
} aur_points_view;

/* A view of contiguous points without weights. */
static inline aur_points_view aur_points_view_of(aur_domain domain, size_t count, size_t dimension,
                                                 const double *coordinates) {
    aur_points_view view;
    memset(&view, 0, sizeof view);
    view.size = sizeof view;
    view.domain = domain;
    view.count = count;
    view.dimension = dimension;
    view.stride = dimension;
    view.coordinates = coordinates;
    return view;
}

/* Points that the library computed or read. It owns them until aur_points_destroy (NULL is allowed). */
typedef struct aur_points aur_points;
AUR_API void aur_points_destroy(aur_points *points);
/* A view of their arrays, with all fields set; valid as long as the points. */
AUR_API const aur_points_view *aur_points_get_view(const aur_points *points) AUR_NONNULL(1);

/* Reads CSV (header u,v for the square, x,y for the disk, x,y,z for directions, w,x,y,z for rotations,
 * u1,u2,... for the cube, and w or weight after it where there are weights; without a header two columns are
 * u,v and three are x,y,z) or NPY. A comment "# domain: NAME" at the end of the header, or in CSV on a line
 * of its own, gives the domain. Without it directions that all have z >= 0 are of the hemisphere, and
 * `guessed` is set in the view. `domain`, unless NULL, is the required domain: x,y stands for the square too
 * when it is SQUARE or CUBE, directions may be of the hemisphere or the sphere, and CUBE takes any number of
 * coordinates. Errors: OPEN, MEMORY, and FORMAT, which names the line; with `domain` also UNSUPPORTED for
 * points of another domain and FORMAT for directions below the hemisphere. *points is then NULL. */
AUR_API aur_result aur_points_read(const char *path, const aur_domain *domain, aur_points **points,
                                   aur_error *error) AUR_NONNULL(1, 3);
/* The same from the bytes of a file, data[size]; `name` is the file name in messages. */
AUR_API aur_result aur_points_read_memory(const char *name, size_t size, const void *data,
                                          const aur_domain *domain, aur_points **points, aur_error *error)
    AUR_NONNULL(1, 3, 5);

/* How points are written. CSV: a header (u,v on the square, x,y on the disk, x,y,z on hemisphere and sphere,
 * u1,u2,... on the cube, and w with weights; at its end "# domain: NAME" where directions have z >= 0), 17
 * significant digits. JSON: an object with "points" and, with weights, "weights". NPY: float64, one row per
 * point, the weight in the last column, and "# domain: NAME" at the end of the header. PLY: binary, up to
 * three coordinates, the weight as `quality`. */
typedef enum aur_points_format {
    AUR_POINTS_CSV,
    AUR_POINTS_JSON,
    AUR_POINTS_NPY,
    AUR_POINTS_PLY
} aur_points_format;

/* "csv", "json", "npy", "ply" to the value and back. Errors: NAME, *format untouched; the name of a value out
 * of range is NULL. */
AUR_API aur_result aur_points_format_from_name(const char *name, aur_points_format *format, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API const char *aur_points_format_name(aur_points_format format);

/* The origin of points: stored in formats with metadata (JSON, PLY). */
typedef struct aur_points_origin {
    size_t size; /* sizeof the caller's struct */
    const char *set;
    uint64_t count; /* of the set, of which the points may be a part */
    uint64_t first; /* the index of the first one */
    aur_scramble scramble;
    uint64_t seed;
} aur_points_origin;

AUR_API aur_result aur_points_origin_init(aur_points_origin *origin, aur_error *error) AUR_NONNULL(1);

/* Options of writing. Fields that do not apply to the format are an error. */
typedef struct aur_points_write_options {
    size_t size;                     /* sizeof the caller's struct */
    const aur_points_origin *origin; /* or NULL */
    bool no_header;                  /* CSV: numbers only */
    bool single;     /* NPY and PLY: float32; on square and cube truncated, so that it stays below 1 */
    unsigned digits; /* CSV: significant digits, 1 to 17; 0: 17, which are exact */
} aur_points_write_options;

AUR_API aur_result aur_points_write_options_init(aur_points_write_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Writes points to `path`, "-" for standard output; the file is replaced atomically. `options` may be NULL.
 * Errors: ARGUMENT for an unknown format or domain, a stride below the dimension or more than 17 digits,
 * UNSUPPORTED for an option that does not apply to the format and a ply file of more than three coordinates,
 * WRITE. */
AUR_API aur_result aur_points_write(const char *path, aur_points_format format, const aur_points_view *points,
                                    const aur_points_write_options *options, aur_error *error)
    AUR_NONNULL(1, 3);

#ifdef __cplusplus
}
#endif

#endif
