/* Geodesic grids (Sadourny, Arakawa and Mintz 1968): each edge of an icosahedron is cut into f parts, each
 * face into f^2 triangles, and their corners are projected to the sphere: 10 f^2 + 2 points, corners first,
 * then those on edges, then those within faces. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/sphere/native.h"

enum { CORNERS = 12, EDGES = 30, FACES = 20, LARGEST = 1 << 24 };

typedef struct icosahedral {
    uint64_t parts; /* f */
    double corners[CORNERS][3];
    unsigned char edges[EDGES][2], faces[FACES][3];
} icosahedral;

/* Poles and two rings of five. */
static void fill_corners(icosahedral *set) {
    for (size_t i = 0; i < CORNERS; ++i) {
        const bool pole = i == 0 || i == CORNERS - 1, north = i < CORNERS / 2;
        const double z = (north ? 1.0 : -1.0) * (pole ? 1.0 : sqrt(0.2)), radius = pole ? 0.0 : sqrt(0.8);
        const double azimuth = AUR_PI / 5.0 * (double)(2 * (i - 1) + (north ? 0 : 1));
        set->corners[i][0] = radius * cos(azimuth);
        set->corners[i][1] = radius * sin(azimuth);
        set->corners[i][2] = z;
    }
}

static bool are_neighbours(const icosahedral *set, size_t a, size_t b) {
    const double *const x = set->corners[a], *const y = set->corners[b];
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] > 0.4; /* sqrt(1/5), or negative */
}

static void fill_edges(icosahedral *set) {
    size_t edges = 0, faces = 0;
    for (unsigned a = 0; a < CORNERS; ++a)
        for (unsigned b = a + 1; b < CORNERS; ++b) {
            if (!are_neighbours(set, a, b))
                continue;
            set->edges[edges][0] = (unsigned char)a;
            set->edges[edges++][1] = (unsigned char)b;
            for (unsigned c = b + 1; c < CORNERS; ++c)
                if (are_neighbours(set, a, c) && are_neighbours(set, b, c)) {
                    set->faces[faces][0] = (unsigned char)a;
                    set->faces[faces][1] = (unsigned char)b;
                    set->faces[faces++][2] = (unsigned char)c;
                }
        }
}

static uint64_t size_of(uint64_t parts) {
    return 10 * parts * parts + 2;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)parameters;
    if (request->height != 2.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set '%s' fills the whole sphere, not a cap",
                        row->name);
    uint64_t parts = request->count > 2 ? (uint64_t)llround(sqrt(((double)request->count - 2.0) / 10.0)) : 0;
    if (parts == 0 || size_of(parts) != request->count) {
        parts += parts == 0;
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set '%s' has 10 f^2 + 2 points: %llu, %llu, ..., not %llu", row->name,
                        (unsigned long long)size_of(parts), (unsigned long long)size_of(parts + 1),
                        (unsigned long long)request->count);
    }
    icosahedral *const set = malloc(sizeof *set);
    if (set == NULL)
        return aur_fail_memory(error);
    set->parts = parts;
    fill_corners(set);
    fill_edges(set);
    *data = set;
    return AUR_OK;
}

/* The point with the given barycentric parts of three corners, projected to the sphere. */
static void place(const icosahedral *set, const unsigned char corners[3], const double parts[3],
                  double *xyz) {
    double sum[3] = {0.0};
    for (size_t c = 0; c < 3; ++c)
        for (size_t d = 0; d < 3; ++d)
            sum[d] += parts[c] * set->corners[corners[c]][d];
    const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (size_t d = 0; d < 3; ++d)
        xyz[d] = sum[d] / length;
}

static void place_in_face(const icosahedral *set, uint64_t index, double *xyz) {
    const uint64_t f = set->parts, within = (f - 1) * (f - 2) / 2, at = index % within;
    /* Row r = 1, 2, .. has r points, r (r - 1) / 2 before it. */
    uint64_t r = (uint64_t)((1.0 + sqrt(8.0 * (double)at + 1.0)) / 2.0);
    while (r * (r - 1) / 2 > at)
        --r;
    while (r * (r + 1) / 2 <= at)
        ++r;
    const double third = (double)(at - r * (r - 1) / 2 + 1), second = (double)(r + 1) - third;
    place(set, set->faces[index / within], (const double[3]){(double)f - second - third, second, third}, xyz);
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const icosahedral *const set = data;
    const uint64_t f = set->parts, edges = EDGES * (f - 1);
    for (size_t i = 0; i < count; ++i) {
        const uint64_t at = first + i;
        if (at < CORNERS) {
            place(set, (const unsigned char[3]){(unsigned char)at, 0, 0}, (const double[3]){1.0, 0.0, 0.0},
                  xyz + 3 * i);
        } else if (at < CORNERS + edges) {
            const unsigned char *const edge = set->edges[(at - CORNERS) / (f - 1)];
            const double along = (double)((at - CORNERS) % (f - 1) + 1);
            place(set, (const unsigned char[3]){edge[0], edge[1], 0},
                  (const double[3]){(double)f - along, along, 0.0}, xyz + 3 * i);
        } else {
            place_in_face(set, at - CORNERS - edges, xyz + 3 * i);
        }
    }
}

static uint64_t size_at(size_t index) {
    return index < LARGEST ? size_of((uint64_t)index + 1) : 0;
}

const aur_native_set aur_native_icosahedral = {
    .description = {.row = {.name = "icosahedral",
                            .summary =
                                "corners of an icosahedron's faces cut into f^2 triangles: 10 f^2 + 2 points",
                            .source = "Sadourny, Arakawa, Mintz 1968"},
                    .domains = AUR_ON_SPHERE,
                    .dimensions = {3, 3},
                    .size_at = size_at,
                    .maximum_size = UINT64_C(10) * LARGEST * LARGEST + 2},
    .prepare = prepare,
    .fill = fill,
};
