/* Maps from the unit square to the disk and to caps of the sphere, with their inverses. */
#include "points/sphere/map.h"

#include <math.h>

#include "points/base/error.h"
#include "points/base/names.h"
#include "points/base/vector.h"

static const char *const names[] = {"lambert", "concentric", "azimuthal", "polar"};
enum { NAME_COUNT = sizeof names / sizeof names[0] };

aur_result aur_map_from_name(const char *name, aur_map *map, aur_error *error) {
    size_t index;
    const aur_result result =
        aur_names_choose(aur_names_of(NAME_COUNT, names), "map", name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *map = (aur_map)index;
    return result;
}

const char *aur_map_name(aur_map map) {
    return (size_t)map < NAME_COUNT ? names[map] : NULL;
}

static void concentric_from_disk(const double disk[2], double square[2]) {
    const double radius = hypot(disk[0], disk[1]);
    const double x = fabs(disk[0]);
    const double y = fabs(disk[1]);
    const double along = 4.0 / AUR_PI * atan2(fmin(x, y), fmax(x, y)) * radius;
    const double a = copysign(x > y ? radius : along, disk[0]);
    const double b = copysign(x > y ? along : radius, disk[1]);
    square[0] = 0.5 * (a + 1.0);
    square[1] = 0.5 * (b + 1.0);
}

/* The first coordinate for a squared radius. */
static double area_to(aur_map map, double area) {
    return map == AUR_MAP_POLAR ? sqrt(area) : area;
}

/* Clamps to [0,1): 1 becomes the greatest number below it. */
static double clamp_unit(double value) {
    return fmin(fmax(value, 0.0), 0x1.fffffffffffffp-1);
}

static double azimuth_turns(double x, double y) {
    const double turns = atan2(y, x) / (2.0 * AUR_PI);
    const double positive = turns < 0.0 ? turns + 1.0 : turns;
    return positive < 1.0 ? positive : 0.0;
}

void aur_point_from_disk(aur_map map, const double disk[2], double square[2]) {
    if (map == AUR_MAP_CONCENTRIC) {
        concentric_from_disk(disk, square);
    } else {
        const double area = disk[0] * disk[0] + disk[1] * disk[1];
        square[1] = azimuth_turns(disk[0], disk[1]);
        square[0] = area_to(map, area);
    }
    square[0] = clamp_unit(square[0]);
    square[1] = clamp_unit(square[1]);
}

void aur_point_from_cap(aur_map map, double height, const double direction[3], double square[2]) {
    const double across = direction[0] * direction[0] + direction[1] * direction[1];
    /* 1 - z without cancellation near the pole. */
    const double depth = direction[2] > 0.0 ? across / (1.0 + direction[2]) : 1.0 - direction[2];
    const double area = fmin(fmax(depth / height, 0.0), 1.0);
    if (map == AUR_MAP_CONCENTRIC) {
        /* A pole has no azimuth: it is taken as 0, which keeps the south pole on the rim. */
        const double scale = across > 0.0 ? sqrt(area / across) : 0.0;
        const double disk[2] = {across > 0.0 ? direction[0] * scale : sqrt(area), direction[1] * scale};
        concentric_from_disk(disk, square);
    } else {
        square[0] = area_to(map, area);
        square[1] = azimuth_turns(direction[0], direction[1]);
    }
    square[0] = clamp_unit(square[0]);
    square[1] = clamp_unit(square[1]);
}

static aur_result check(aur_map map, double height, aur_error *error) {
    if ((size_t)map >= NAME_COUNT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown map %d", (int)map);
    if (!(height > 0.0 && height <= 2.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the height of a cap must be above 0 and at most 2, not %g", height);
    return AUR_OK;
}

aur_result aur_map_to_disk(aur_map map, size_t count, const double *square, double *disk, aur_error *error) {
    const aur_result result = check(map, 1.0, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        aur_point_to_disk(map, square + 2 * i, disk + 2 * i);
    return result;
}

aur_result aur_map_from_disk(aur_map map, size_t count, const double *disk, double *square,
                             aur_error *error) {
    const aur_result result = check(map, 1.0, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        aur_point_from_disk(map, disk + 2 * i, square + 2 * i);
    return result;
}

aur_result aur_map_to_cap(aur_map map, double height, size_t count, const double *square, double *xyz,
                          aur_error *error) {
    const aur_result result = check(map, height, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        aur_point_to_cap(map, height, square + 2 * i, xyz + 3 * i);
    return result;
}

aur_result aur_map_from_cap(aur_map map, double height, size_t count, const double *xyz, double *square,
                            aur_error *error) {
    const aur_result result = check(map, height, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        aur_point_from_cap(map, height, xyz + 3 * i, square + 2 * i);
    return result;
}

double aur_map_weight(aur_map map, const double square[2]) {
    return map == AUR_MAP_POLAR ? 2.0 * square[0] : 1.0;
}
