/* The centres of HEALPix's pixels in rings (Gorski, Hivon, Banday, Wandelt, Hansen, Reinecke and Bartelmann
 * 2005, eqs 2 to 9): 12 k^2 points of equal areas on rings of equal latitude, for comparisons and for reading
 * maps. Point i is pixel i of the ring scheme or of the nested one, in which the 12 first pixels are split in
 * four again and again. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/sphere/native.h"

/* Of the set, and of numbers of pixels in 62 bits. */
enum { LARGEST_SIDE = 1 << 24, LARGEST_INDEX_SIDE = 1 << 29, FACES = 12 };

typedef struct healpix {
    uint64_t side; /* k */
    enum { ORDER_RING, ORDER_NESTED } order;
} healpix;

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(healpix, "order", order, "ring",
                       "ring: from north to south; nested: pixels split in four, k a power of 2", "ring",
                       "nested")},
};

static bool is_power(uint64_t side) {
    return (side & (side - 1)) == 0;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    healpix read;
    const aur_result result = aur_row_read(row, parameters, &read, error);
    if (result != AUR_OK)
        return result;
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
    if (read.order == ORDER_NESTED && !is_power(side))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'healpix': nested pixels have a side of a power of 2, not %llu",
                        (unsigned long long)side);
    healpix *const set = malloc(sizeof *set);
    if (set == NULL)
        return aur_fail_memory(error);
    *set = (healpix){.side = side, .order = read.order};
    *data = set;
    return AUR_OK;
}

static void place(double z, double radius, double azimuth, double *xyz) {
    xyz[0] = radius * cos(azimuth);
    xyz[1] = radius * sin(azimuth);
    xyz[2] = z;
}

/* Ring i = 1, 2, ... about a pole has 4 i pixels, 2 i (i - 1) before it. `sign` is -1 at the south pole,
 * where pixels are counted from the end. */
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

/* The bits of all pairs, nibbles, ... of a number, and so on: groups of 1, 2, 4, ... bits, every other one.
 */
static const uint64_t groups[] = {0x5555555555555555, 0x3333333333333333, 0x0f0f0f0f0f0f0f0f,
                                  0x00ff00ff00ff00ff, 0x0000ffff0000ffff, 0x00000000ffffffff};

/* Every other bit, from the lowest on. */
static uint64_t even_bits(uint64_t x) {
    x &= groups[0];
    for (unsigned k = 0; k < 5; ++k)
        x = (x | x >> (1u << k)) & groups[k + 1];
    return x;
}

static uint64_t spread_bits(uint64_t x) {
    for (unsigned k = 5; k > 0; --k)
        x = (x | x << (1u << (k - 1))) & groups[k - 1];
    return x;
}

/* A position on one of the twelve faces: x to the north-east, y to the north-west. */
static uint64_t nested_of(uint64_t side, uint64_t face, uint64_t x, uint64_t y) {
    return face * side * side + spread_bits(x) + 2 * spread_bits(y);
}

/* The distance of the face's southern corner from the north pole in sides, and its azimuth in half sides. */
static const unsigned char face_rows[FACES] = {2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4};
static const unsigned char face_columns[FACES] = {1, 3, 5, 7, 0, 2, 4, 6, 1, 3, 5, 7};

static uint64_t ring_of_nested(uint64_t side, uint64_t pixel) {
    const uint64_t face = pixel / (side * side), within = pixel % (side * side);
    const uint64_t x = even_bits(within), y = even_bits(within >> 1);
    const uint64_t row = face_rows[face] * side - x - y - 1, cap = 2 * side * (side - 1);
    uint64_t length = side, before = cap + (row - side) * 4 * side, turned = (row - side) & 1u;
    if (row < side || row > 3 * side) {
        length = row < side ? row : 4 * side - row;
        before = row < side ? 2 * row * (row - 1) : 12 * side * side - 2 * length * (length + 1);
        turned = 0;
    }
    /* One more turn, so that no value is negative. */
    const uint64_t along = (face_columns[face] * length + x + 8 * length + 1 + turned - y) / 2;
    return before + (along - 1) % (4 * length);
}

/* `at` modulo `length`, of at most twice the length. */
static uint64_t wrapped(uint64_t at, uint64_t length) {
    return at < length ? at : at - length;
}

static uint64_t pixel_in_belt(uint64_t side, bool nested, double z, double quarters) {
    const double across = (double)side * (0.5 + quarters), along = (double)side * 0.75 * z;
    const uint64_t down = (uint64_t)(across - along), up = (uint64_t)(across + along);
    if (nested) {
        const uint64_t p = down / side, m = up / side;
        return nested_of(side,
                         p == m  ? p % 4 + 4
                         : p < m ? p
                                 : m + 8,
                         up & (side - 1), side - (down & (side - 1)) - 1);
    }
    const uint64_t ring = side + 1 + down - up, turned = ring % 2 == 0 ? 1 : 0;
    const uint64_t at = (down + up + 7 * side + turned + 1) / 2 - 4 * side;
    return 2 * side * (side - 1) + (ring - 1) * 4 * side + wrapped(at, 4 * side);
}

static uint64_t least_of(uint64_t a, uint64_t b) {
    return a < b ? a : b;
}

/* `depth`: sqrt(3 (1 - |z|)). */
static uint64_t pixel_near_pole(uint64_t side, bool nested, double depth, bool north, double quarters) {
    const uint64_t quarter = least_of((uint64_t)quarters, 3);
    const double within = quarters - (double)quarter, rings = (double)side * depth;
    const uint64_t down = least_of((uint64_t)(within * rings), side - 1);
    const uint64_t up = least_of((uint64_t)((1.0 - within) * rings), side - 1);
    if (nested)
        return north ? nested_of(side, quarter, side - up - 1, side - down - 1)
                     : nested_of(side, quarter + 8, down, up);
    const uint64_t ring = down + up + 1, at = wrapped((uint64_t)(quarters * (double)ring), 4 * ring);
    return north ? 2 * ring * (ring - 1) + at : 12 * side * side - 2 * ring * (ring + 1) + at;
}

aur_result aur_healpix_pixels(uint64_t side, bool nested, size_t count, const double *xyz, size_t capacity,
                              uint64_t *pixels, aur_error *error) {
    if (side == 0 || side > LARGEST_INDEX_SIDE || (nested && !is_power(side)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the side of HEALPix's pixels must be from 1 to %d%s, not %llu", LARGEST_INDEX_SIDE,
                        nested ? ", a power of 2" : "", (unsigned long long)side);
    if (capacity < count)
        return aur_fail(error, AUR_ERROR_CAPACITY, "%zu pixels do not fit into %zu", count, capacity);
    for (size_t i = 0; i < count; ++i) {
        const double x = xyz[3 * i], y = xyz[3 * i + 1];
        double across = sqrt(x * x + y * y), length = sqrt(x * x + y * y + xyz[3 * i + 2] * xyz[3 * i + 2]);
        if (!(length > 1e-100 && length < 1e100)) { /* squares may be beyond the range of numbers */
            across = hypot(x, y);
            length = hypot(across, xyz[3 * i + 2]);
        }
        if (!(length > 0.0 && length < INFINITY))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "vector %zu has no direction", i + 1);
        const double z = xyz[3 * i + 2] / length, quarters = atan2(y, x) / (AUR_PI / 2.0);
        const double turned = quarters < 0.0 ? quarters + 4.0 : quarters;
        /* 1 - |z| = sin^2 / (1 + |z|), without cancellation. */
        pixels[i] = fabs(z) <= 2.0 / 3.0
                        ? pixel_in_belt(side, nested, z, turned < 4.0 ? turned : 0.0)
                        : pixel_near_pole(side, nested, across / length * sqrt(3.0 / (1.0 + fabs(z))),
                                          z > 0.0, turned < 4.0 ? turned : 0.0);
    }
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const healpix *const set = data;
    const uint64_t side = set->side;
    const uint64_t cap = 2 * side * (side - 1), all = 12 * side * side;
    for (size_t i = 0; i < count; ++i) {
        const uint64_t pixel = set->order == ORDER_NESTED ? ring_of_nested(side, first + i) : first + i;
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
                            .summary = "centres of the 12 k^2 pixels of HEALPix, in ring or nested order",
                            .source = "Gorski 2005",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SPHERE,
                    .dimensions = {3, 3},
                    .size_at = size_at,
                    .maximum_size = UINT64_C(12) * LARGEST_SIDE * LARGEST_SIDE},
    .prepare = prepare,
    .fill = fill,
};
