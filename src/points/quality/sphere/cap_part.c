/* The area is a sum of signed triangles about the pole, one for each side of the polygon. Parts of a side
 * within the rim give triangles, parts outside give sectors of the cap. */
#include "points/quality/sphere/voronoi.h"

#include <math.h>

#include "points/base/vector.h"
#include "points/base/vector3d.h"

aur_rim aur_rim_at(double degrees) {
    const double radians = degrees * (AUR_PI / 180.0), half = sin(0.5 * radians);
    return (aur_rim){cos(radians), sin(radians), 2.0 * half * half};
}

typedef struct part_work {
    const aur_rim *rim;
    const double *point;
    aur_cap_part part;
    size_t exits; /* crossings where the boundary leaves the cap */
    double turn;  /* of the azimuth, along all sides */
} part_work;

/* The direction at t between two, along their great circle. */
static void between(const double a[3], const double b[3], double t, double direction[3]) {
    for (size_t d = 0; d < 3; ++d)
        direction[d] = a[d] + t * (b[d] - a[d]);
    aur_normalize3(direction);
}

static double azimuth_between(const double a[3], const double b[3]) {
    return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

/* Signed area of the triangle of the pole, a and b (Van Oosterom and Strackee 1983). */
static double triangle_at_pole(const double a[3], const double b[3]) {
    return 2.0 * atan2(a[0] * b[1] - a[1] * b[0], 1.0 + a[2] + b[2] + aur_dot3(a, b));
}

static void reach(part_work *work, const double corner[3]) {
    double normal[3];
    aur_cross3(work->point, corner, normal);
    work->part.radius = fmax(work->part.radius, atan2(aur_length3(normal), aur_dot3(work->point, corner)));
}

/* The bilinear form that is 0 for a = b on the double cone of the rim, and negative within it; without
 * cancellation in small caps. */
static double cone(const aur_rim *rim, const double a[3], const double b[3]) {
    return rim->cosine * rim->cosine * (a[0] * b[0] + a[1] * b[1]) - rim->sine * rim->sine * a[2] * b[2];
}

static bool within(const aur_rim *rim, const double x[3]) {
    const bool in_cone = cone(rim, x, x) <= 0.0;
    return rim->cosine > 0.0 ? x[2] > 0.0 && in_cone : x[2] > 0.0 || !in_cone;
}

/* The parameters 0 < t < 1 where the chord from a to b crosses the cone of the rim, ascending; returns their
 * number. */
static size_t crossings(const aur_rim *rim, const double a[3], const double b[3], double t[2]) {
    double step[3];
    for (size_t d = 0; d < 3; ++d)
        step[d] = b[d] - a[d];
    const double k2 = cone(rim, step, step), k1 = cone(rim, a, step), k0 = cone(rim, a, a);
    const double discriminant = k1 * k1 - k2 * k0;
    if (!(discriminant > 0.0))
        return 0;
    const double sum = -(k1 + copysign(sqrt(discriminant), k1));
    const double roots[2] = {k2 != 0.0 ? sum / k2 : -1.0, k0 / sum};
    size_t count = 0;
    for (size_t i = 0; i < 2; ++i)
        /* The other half of the double cone is not the rim. */
        if (roots[i] > 0.0 && roots[i] < 1.0 && (a[2] + roots[i] * step[2]) * rim->cosine >= 0.0)
            t[count++] = roots[i];
    if (count == 2 && t[0] > t[1]) {
        const double larger = t[0];
        t[0] = t[1];
        t[1] = larger;
    }
    return count;
}

static void add_side(part_work *work, const double a[3], const double b[3]) {
    double t[4] = {0.0};
    const size_t crossed = crossings(work->rim, a, b, t + 1);
    t[crossed + 1] = 1.0;
    double from[3] = {a[0], a[1], a[2]};
    bool was_inside = false;
    for (size_t i = 0; i <= crossed; ++i) {
        double to[3], middle[3];
        between(a, b, t[i + 1], to);
        between(a, b, 0.5 * (t[i] + t[i + 1]), middle);
        const bool inside = within(work->rim, middle);
        if (inside) {
            work->part.area += triangle_at_pole(from, to);
            work->part.sides += !was_inside;
            reach(work, from);
            reach(work, to);
        } else
            work->part.area += work->rim->height * azimuth_between(from, to);
        work->exits += was_inside && !inside;
        was_inside = inside;
        for (size_t d = 0; d < 3; ++d)
            from[d] = to[d];
    }
    work->turn += azimuth_between(a, b);
}

/* Whether a convex polygon contains the direction. */
static bool contains(size_t count, const double (*corners)[3], const double direction[3]) {
    for (size_t i = 0; i < count; ++i) {
        double normal[3];
        aur_cross3(corners[i], corners[i + 1 < count ? i + 1 : 0], normal);
        if (aur_dot3(normal, direction) < 0.0)
            return false;
    }
    return true;
}

/* The relevant points of the rim: the farthest from the point, and arcs without ends. */
static void add_rim(part_work *work, size_t count, const double (*corners)[3]) {
    const double *const x = work->point;
    const double off_axis = hypot(x[0], x[1]), sine = work->rim->sine;
    const double opposite[3] = {off_axis > 0.0 ? -sine * x[0] / off_axis : sine,
                                off_axis > 0.0 ? -sine * x[1] / off_axis : 0.0, work->rim->cosine};
    const bool held = contains(count, corners, opposite);
    if (held)
        reach(work, opposite);
    work->part.sides += work->exits == 0 ? held : work->exits;
}

aur_cap_part aur_cap_part_of(const aur_rim *rim, const double point[3], size_t count,
                             const double (*corners)[3]) {
    part_work work = {.rim = rim, .point = point};
    for (size_t i = 0; i < count; ++i)
        add_side(&work, corners[i], corners[i + 1 < count ? i + 1 : 0]);
    /* About the opposite pole the azimuth turns backwards, and the sum is minus the rest of the cap. */
    work.part.area -= rim->height * fmin(work.turn, 0.0);
    add_rim(&work, count, corners);
    return work.part;
}
