/* Spherical Fibonacci sets (Marques 2013 eq. 4; Swinbank and Purser 2006).
 *
 * z_j = 1 - 2 (j + offset)/N and phi_j = 2 pi j/Phi for 0 <= j < N; offset 1/2 is the best one for
 * integration (0 adds exactly 1/N^2 to the square of the energy). The hemisphere is the first N points of the
 * set of 2N, a cap of height h the first N of the set of 2N/h. With `epsilon` instead, z_j = 1 - 2 (j +
 * epsilon)/(N - 1 + 2 epsilon) (Roberts 2020): above 1/2 it increases the smallest distance and worsens the
 * energy. `region=octant` selects x, y, z >= 0, N points by a table of their indices. Any N up to 2^50; the
 * azimuth is exact to 3e-12 turn at j = 1e9 (the 64 digits of the golden ratio, times j). The cost is that of
 * a square root and a complex product. */
#include "points/sphere/sets/fibonacci.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/simd_lanes.h"
#include "points/sphere/native.h"

typedef struct fibonacci_set {
    aur_fibonacci points;
    aur_fibonacci_kernel *kernel;
    int octant;
    uint64_t indices[]; /* of the points in the octant, for region=octant */
} fibonacci_set;

static int in_first_quarter(uint64_t index) {
    return index * AUR_GOLDEN_PHASE >> 62 == 0;
}

/* The first `count` points of a hemisphere's set whose azimuth is in the first quarter; the size of the set
 * is as near to four times the count as possible such that the next point would be below the horizon. */
static void choose_octant(fibonacci_set *set, uint64_t count, double offset) {
    uint64_t next = 0;
    for (uint64_t i = 0; i < count; ++i, ++next) {
        while (!in_first_quarter(next))
            ++next;
        set->indices[i] = next;
    }
    uint64_t size = next;
    while (size < 4 * count && !in_first_quarter(size))
        ++size;
    set->points = (aur_fibonacci){.step = 1.0 / (double)size, .offset = offset};
    set->octant = 1;
}

typedef struct fibonacci_keys {
    double offset, epsilon; /* -1: not given */
    enum { REGION_DOMAIN, REGION_OCTANT } region;
} fibonacci_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(fibonacci_keys, "offset", offset, 0.0, 1.0, "0.5",
                     "height of point i is at i + offset: 0.5 is the middle of its band"),
     .computed = true},
    {AUR_KEY_OF_REAL(fibonacci_keys, "epsilon", epsilon, 0.0, 1e6, "none",
                     "instead of offset: distance of the first and last point from the poles, in bands"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(fibonacci_keys, "region", region, "domain", "fill the domain, or one octant of it",
                       "domain", "octant")},
};

/* The lattice of the whole sphere according to the keys. */
static aur_result choose_lattice(const fibonacci_keys *p, const aur_native_request *request,
                                 aur_fibonacci *set, aur_error *error) {
    const double offset = p->offset < 0.0 ? 0.5 : p->offset;
    const double epsilon = p->epsilon;
    const double whole = 2.0 / request->height * (double)request->count;
    *set = (aur_fibonacci){.step = 2.0 / whole, .offset = offset};
    if (epsilon < 0.0)
        return AUR_OK;
    if (p->offset >= 0.0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'spherical-fibonacci': 'offset' and 'epsilon' exclude each other");
    if (!(whole - 1.0 + 2.0 * epsilon > 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'spherical-fibonacci': a single point needs an epsilon above 0");
    *set = (aur_fibonacci){.step = 2.0 / (whole - 1.0 + 2.0 * epsilon), .offset = epsilon};
    return AUR_OK;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    fibonacci_keys p = {.offset = -1.0, .epsilon = -1.0};
    aur_fibonacci lattice;
    aur_result result = aur_row_read(row, parameters, &p, error);
    if (result == AUR_OK)
        result = choose_lattice(&p, request, &lattice, error);
    if (result != AUR_OK)
        return result;
    const bool octant = p.region == REGION_OCTANT;
    if (octant &&
        (lattice.offset > 1.0 || p.epsilon >= 0.0 || (request->height != 1.0 && request->height != 2.0)))
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "set 'spherical-fibonacci': an octant excludes 'epsilon' and a cap: expected an offset");
    if (octant && request->count > SIZE_MAX / 64)
        return aur_fail(error, AUR_ERROR_MEMORY, "the octant's points do not fit into memory");
    fibonacci_set *const stored =
        malloc(sizeof *stored + (octant ? (size_t)request->count * sizeof stored->indices[0] : 0));
    if (stored == NULL)
        return aur_fail_memory(error);
    *stored = (fibonacci_set){.points = lattice, .kernel = AUR_KERNEL_HERE(aur_fibonacci_points)};
    if (octant)
        choose_octant(stored, request->count, lattice.offset);
    *data = stored;
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const fibonacci_set *const set = data;
    if (!set->octant) {
        const bool stream = aur_fibonacci_streams(count);
        set->kernel(&set->points, first, count, stream, xyz);
        if (stream)
            aur_lanes_end_stream();
        return;
    }
    for (size_t i = 0; i < count; ++i)
        aur_fibonacci_point(&set->points, set->indices[first + i], xyz + 3 * i);
}

const aur_native_set aur_native_fibonacci = {
    .description =
        {.row =
             {.name = "spherical-fibonacci",
              .summary =
                  "spiral of golden angles at equal steps of height: among the most uniform sets at any size",
              .source = "Swinbank 2006, Marques 2013",
              AUR_ROW_KEYS(keys)},
         .domains = AUR_ON_SPHERE | AUR_ON_HEMISPHERE | AUR_ON_DISK | AUR_ON_AXES,
         .dimensions = {3, 3},
         .maximum_size = UINT64_C(1) << 50},
    .prepare = prepare,
    .fill = fill,
};
