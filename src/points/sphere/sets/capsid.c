#include "points/sphere/sets/capsid.h"

#include <math.h>

typedef struct capsid {
    size_t capacity, count;
    double *x, *y, *z;
} capsid;

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The corners of an icosahedron: cyclic permutations of (0, +-1, +-golden ratio). */
static void fill_corners(double corners[12][3]) {
    const double golden = 0.5 * (1.0 + sqrt(5.0)), length = sqrt(1.0 + golden * golden);
    for (size_t i = 0; i < 12; ++i) {
        const size_t axis = i / 4;
        corners[i][axis] = 0.0;
        corners[i][(axis + 1) % 3] = (i % 2 == 0 ? 1.0 : -1.0) / length;
        corners[i][(axis + 2) % 3] = (i / 2 % 2 == 0 ? golden : -golden) / length;
    }
}

/* Corners and edges belong to several faces. */
static void add(capsid *c, double *point) {
    const double length = sqrt(dot(point, point));
    for (size_t d = 0; d < 3; ++d)
        point[d] /= length;
    for (size_t i = 0; i < c->count; ++i)
        if (fabs(c->x[i] - point[0]) + fabs(c->y[i] - point[1]) + fabs(c->z[i] - point[2]) < 1e-9)
            return;
    if (c->count < c->capacity) {
        c->x[c->count] = point[0];
        c->y[c->count] = point[1];
        c->z[c->count] = point[2];
    }
    ++c->count;
}

/* The lattice points of one face, whose corners have the coordinates (0, 0), (h, k) and (-k, h + k). */
static void fill_face(capsid *c, long h, long k, const double *p, const double *q, const double *r) {
    const long size = h * h + h * k + k * k;
    for (long i = -k; i <= h; ++i)
        for (long j = 0; j <= h + k; ++j) {
            const long b = i * (h + k) + j * k, a = h * j - k * i;
            if (a < 0 || b < 0 || a + b > size)
                continue;
            double point[3];
            for (size_t d = 0; d < 3; ++d)
                point[d] = (double)(size - a - b) * p[d] + (double)b * q[d] + (double)a * r[d];
            add(c, point);
        }
}

bool aur_capsid(size_t count, size_t which, double *x, double *y, double *z) {
    for (long h = 1; 10 * h * h + 2 <= (long)count; ++h)
        for (long k = 0; k <= h; ++k) {
            if (10 * (size_t)(h * h + h * k + k * k) + 2 != count || which-- > 0)
                continue;
            double corners[12][3];
            fill_corners(corners);
            capsid c = {.capacity = count, .x = x, .y = y, .z = z};
            for (size_t face = 0; face < 12 * 12 * 12; ++face) {
                const double *const p = corners[face / 144], *const q = corners[face / 12 % 12],
                                    *const r = corners[face % 12];
                const double normal = p[0] * (q[1] * r[2] - q[2] * r[1]) +
                                      p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
                const bool once = p < q && p < r; /* of its three cyclic orders */
                if (once && normal > 0.0 && dot(p, q) > 0.4 && dot(q, r) > 0.4 && dot(r, p) > 0.4)
                    fill_face(&c, h, k, p, q, r);
            }
            return c.count == count;
        }
    return false;
}
