/* Maps from the unit square to the disk and to caps of the sphere, with their inverses.
 *
 * All but POLAR preserve area. A disk of squared radius a = r^2 is lifted to a cap of height h about +z by
 * z = 1 - h a, which is Archimedes' theorem: h = 1 is the hemisphere, h = 2 the sphere. */
#include <math.h>

#include <aureole/sphere.h>

#include "core/names.h"
#include "core/vector.h"
#include "sphere/phase.h"

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

/* A point of the disk by polar coordinates. The radius may be negative. */
typedef struct polar_point {
    double radius, area; /* area is the radius squared */
    double sine, cosine;
} polar_point;

/* Shirley and Chiu 1997: squares about the centre become circles. */
static polar_point concentric_polar(const double square[2]) {
    const double a = 2.0 * square[0] - 1.0;
    const double b = 2.0 * square[1] - 1.0;
    polar_point point = {.radius = fabs(a) > fabs(b) ? a : b};
    if (point.radius == 0.0)
        return (polar_point){.cosine = 1.0};
    const double turns = fabs(a) > fabs(b) ? b / a / 8.0 : 0.25 - a / b / 8.0;
    point.area = point.radius * point.radius;
    aur_phase_sincos(aur_phase_from_turns(turns), &point.sine, &point.cosine);
    return point;
}

static polar_point to_polar(aur_map map, const double square[2]) {
    if (map == AUR_MAP_CONCENTRIC)
        return concentric_polar(square);
    const double u = square[0];
    polar_point point = {.area = map == AUR_MAP_POLAR ? u * u : u};
    point.radius = map == AUR_MAP_POLAR ? u : sqrt(u);
    aur_phase_sincos(aur_phase_from_turns(square[1]), &point.sine, &point.cosine);
    return point;
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

/* The first coordinate that belongs to a squared radius. */
static double area_to(aur_map map, double area) {
    return map == AUR_MAP_POLAR ? sqrt(area) : area;
}

/* Into [0,1): a coordinate of 1 is the greatest number below it. */
static double clamp_unit(double value) {
    return fmin(fmax(value, 0.0), 0x1.fffffffffffffp-1);
}

static double azimuth_turns(double x, double y) {
    const double turns = atan2(y, x) / (2.0 * AUR_PI);
    const double positive = turns < 0.0 ? turns + 1.0 : turns;
    return positive < 1.0 ? positive : 0.0;
}

void aur_map_to_disk(aur_map map, const double square[2], double disk[2]) {
    const polar_point point = to_polar(map, square);
    disk[0] = point.radius * point.cosine;
    disk[1] = point.radius * point.sine;
}

void aur_map_from_disk(aur_map map, const double disk[2], double square[2]) {
    if (map == AUR_MAP_CONCENTRIC) {
        concentric_from_disk(disk, square);
    } else {
        const double area = disk[0] * disk[0] + disk[1] * disk[1];
        square[0] = area_to(map, area);
        square[1] = azimuth_turns(disk[0], disk[1]);
    }
    square[0] = clamp_unit(square[0]);
    square[1] = clamp_unit(square[1]);
}

void aur_map_to_cap(aur_map map, double height, const double square[2], double direction[3]) {
    const polar_point point = to_polar(map, square);
    const double depth = height * point.area;
    const double radius = copysign(sqrt(depth * (2.0 - depth)), point.radius);
    direction[0] = radius * point.cosine;
    direction[1] = radius * point.sine;
    direction[2] = 1.0 - depth;
}

void aur_map_from_cap(aur_map map, double height, const double direction[3], double square[2]) {
    const double across = direction[0] * direction[0] + direction[1] * direction[1];
    /* 1 - z without cancellation about the pole. */
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

double aur_map_weight(aur_map map, const double square[2]) {
    return map == AUR_MAP_POLAR ? 2.0 * square[0] : 1.0;
}
