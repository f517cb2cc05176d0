/* The centres of HEALPix's pixels in rings (Gorski, Hivon, Banday, Wandelt, Hansen, Reinecke and Bartelmann
 * 2005, eqs 2 to 9): 12 k^2 points of equal areas on rings of equal latitude, to compare with and to read
 * maps by. Point i is pixel i of the ring scheme. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/sphere/native.h"

enum { LARGEST_SIDE = 1 << 24 };

typedef struct healpix {
    uint64_t side; /* k */
} healpix;

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)row;
    (void)parameters;
    if (request->height != 2.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set 'healpix' fills the whole sphere, not a cap");
    uint64_t side = (uint64_t)llround(sqrt((double)request->count / 12.0));
    if (12 * side * side != request->count) {
        side += side == 0;
        return aur_fail(
            error, AUR_ERROR_ARGUMENT, "set 'healpix' has 12 k^2 points: %llu, %llu, ..., not %llu",
            (unsigned long long)(12 * side * side), (unsigned long long)(12 * (side + 1) * (side + 1)),
            (unsigned long long)request->count);
    }
    healpix *const set = malloc(sizeof *set);
    if (set == NULL)
        return aur_fail_memory(error);
    set->side = side;
    *data = set;
    return AUR_OK;
}

static void place(double z, double radius, double azimuth, double *xyz) {
    xyz[0] = radius * cos(azimuth);
    xyz[1] = radius * sin(azimuth);
    xyz[2] = z;
}

/* Ring i = 1, 2, ... about a pole has 4 i pixels, 2 i (i - 1) before it. `sign` is -1 at the south pole,
 * where they are counted from the end. */
static void place_near_pole(uint64_t side, uint64_t pixel, double sign, double *xyz) {
    uint64_t ring = (uint64_t)((1.0 + sqrt(2.0 * (double)pixel + 1.0)) / 2.0);
    while (2 * ring * (ring - 1) > pixel)
        --ring;
    while (2 * ring * (ring + 1) <= pixel)
        ++ring;
    const double along = (double)(pixel - 2 * ring * (ring - 1)) + 0.5;
    const double depth = (double)ring * (double)ring / (3.0 * (double)side * (double)side);
    const double turned = sign > 0.0 ? along : 4.0 * (double)ring - along;
    place(sign * (1.0 - depth), sqrt(depth * (2.0 - depth)), AUR_PI / 2.0 * turned / (double)ring, xyz);
}

static void place_in_belt(uint64_t side, uint64_t pixel, double *xyz) {
    const uint64_t ring = pixel / (4 * side), along = pixel % (4 * side);
    const double z = 2.0 / 3.0 * (1.0 - (double)ring / (double)side);
    const double turned = (double)along + (ring % 2 == 0 ? 0.5 : 0.0);
    place(z, sqrt((1.0 - z) * (1.0 + z)), AUR_PI / 2.0 * turned / (double)side, xyz);
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const uint64_t side = ((const healpix *)data)->side;
    const uint64_t cap = 2 * side * (side - 1), all = 12 * side * side;
    for (size_t i = 0; i < count; ++i) {
        const uint64_t pixel = first + i;
        if (pixel < cap)
            place_near_pole(side, pixel, 1.0, xyz + 3 * i);
        else if (pixel < all - cap)
            place_in_belt(side, pixel - cap, xyz + 3 * i);
        else
            place_near_pole(side, all - 1 - pixel, -1.0, xyz + 3 * i);
    }
}

static uint64_t size_at(size_t index) {
    const uint64_t side = (uint64_t)index + 1;
    return side <= LARGEST_SIDE ? 12 * side * side : 0;
}

const aur_native_set aur_native_healpix = {
    .description = {.row = {.name = "healpix",
                            .summary =
                                "centres of HEALPix's pixels in rings, 12 k^2 of them, to compare with",
                            .source = "Gorski 2005"},
                    .domains = AUR_ON_SPHERE,
                    .dimensions = {3, 3},
                    .size_at = size_at,
                    .maximum_size = UINT64_C(12) * LARGEST_SIDE * LARGEST_SIDE},
    .prepare = prepare,
    .fill = fill,
};
