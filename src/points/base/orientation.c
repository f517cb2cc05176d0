#include "points/base/vector3d.h"

#include <math.h>
#include <stddef.h>

/* A sum as components that do not overlap, the smallest first. */
typedef struct expansion {
    size_t count;
    double parts[12];
} expansion;

/* Adds one number exactly (Shewchuk's GROW-EXPANSION). */
static void add(expansion *e, double value) {
    for (size_t i = 0; i < e->count; ++i) {
        const double part = e->parts[i];
        const double sum = value + part;
        const double virtual_part = sum - value;
        e->parts[i] = (value - (sum - virtual_part)) + (part - virtual_part);
        value = sum;
    }
    e->parts[e->count++] = value;
}

static void add_product(expansion *e, double a, double b) {
    const double product = a * b;
    add(e, fma(a, b, -product));
    add(e, product);
}

static double exact(const double a[2], const double b[2], const double c[2]) {
    expansion e = {0};
    add_product(&e, a[0], b[1]);
    add_product(&e, -a[0], c[1]);
    add_product(&e, -c[0], b[1]);
    add_product(&e, -a[1], b[0]);
    add_product(&e, a[1], c[0]);
    add_product(&e, c[1], b[0]);
    double largest = 0.0;
    for (size_t i = 0; i < e.count; ++i)
        largest = e.parts[i] != 0.0 ? e.parts[i] : largest;
    return largest;
}

double aur_orientation(const double a[2], const double b[2], const double c[2]) {
    static const double bound = 3.3306690738754716e-16; /* (3 + 16 u) u with u = 2^-53 */
    const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
    const double difference = left - right;
    return fabs(difference) > bound * (fabs(left) + fabs(right)) ? difference : exact(a, b, c);
}
