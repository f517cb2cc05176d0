/* The smallest cap that holds all points (Welzl 1991). */
#include <math.h>

#include "core/random.h"
#include "core/vector3d.h"
#include "quality/sphere/voronoi.h"

typedef struct sphere_cap {
    double centre[3];
    double cosine; /* of its radius */
} sphere_cap;

/* The points in an order that a hash has mixed: every stride-th, with a stride that is prime to the count. */
typedef struct mixed_points {
    const aur_points_view *points;
    uint64_t stride;
} mixed_points;

static const double *point_at(const mixed_points *mixed, size_t i) {
    return mixed->points->coordinates + 3 * (size_t)((uint64_t)i * mixed->stride % mixed->points->count);
}

static int coprime(uint64_t a, uint64_t b) {
    while (b != 0) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a == 1;
}

static mixed_points mix(const aur_points_view *points) {
    mixed_points mixed = {points, aur_hash2(points->count, 1) % points->count};
    while (!coprime(mixed.stride, points->count))
        ++mixed.stride;
    return mixed;
}

static int inside(const sphere_cap *cap, const double *x) {
    return aur_dot3(cap->centre, x) >= cap->cosine - 1e-14;
}

static sphere_cap cap_of_one(const double *x) {
    return (sphere_cap){{x[0], x[1], x[2]}, 1.0};
}

static sphere_cap cap_about(double w[3], const double *x) {
    if (aur_normalize3(w) < 1e-14)
        return cap_of_one(x);
    return (sphere_cap){{w[0], w[1], w[2]}, aur_dot3(w, x)};
}

static sphere_cap cap_of_two(const double *a, const double *b) {
    double w[3] = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    if (aur_dot3(w, w) < 1e-24) { /* opposite points: any hemisphere through both */
        double other[3];
        aur_frame3(a, w, other);
    }
    return cap_about(w, a);
}

static sphere_cap cap_of_three(const double *a, const double *b, const double *c) {
    const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    double w[3];
    aur_cross3(p, q, w);
    const double side = aur_dot3(w, a) < 0.0 ? -1.0 : 1.0;
    for (int d = 0; d < 3; ++d)
        w[d] *= side;
    return cap_about(w, a);
}

/* The smallest cap of the first `i` points and point i, which is on its boundary. */
static sphere_cap cap_with(const mixed_points *mixed, size_t i) {
    const double *const a = point_at(mixed, i);
    sphere_cap cap = cap_of_one(a);
    for (size_t j = 0; j < i; ++j) {
        const double *const b = point_at(mixed, j);
        if (inside(&cap, b))
            continue;
        cap = cap_of_two(a, b);
        for (size_t k = 0; k < j; ++k)
            if (!inside(&cap, point_at(mixed, k)))
                cap = cap_of_three(a, b, point_at(mixed, k));
    }
    return cap;
}

double aur_smallest_cap(const aur_points_view *points) {
    const mixed_points mixed = mix(points);
    sphere_cap cap = cap_of_one(point_at(&mixed, 0));
    for (size_t i = 1; i < points->count; ++i)
        if (!inside(&cap, point_at(&mixed, i)))
            cap = cap_with(&mixed, i);
    return acos(fmin(fmax(cap.cosine, 0.0), 1.0));
}
