#include "noise.h"

#include "points/base/random.h"

static double corner(int64_t x, int64_t y, int64_t z, double dx, double dy, double dz) {
    const uint64_t hash = aur_hash3((uint64_t)x, (uint64_t)y, (uint64_t)z);
    /* One of the directions to the middles of a cube's 12 edges. */
    const uint64_t edge = hash >> 32 & 15;
    const double u = edge < 8 ? dx : dy;
    const double v = edge < 4 ? dy : edge == 12 || edge == 14 ? dx : dz;
    return ((edge & 1) != 0 ? -u : u) + ((edge & 2) != 0 ? -v : v);
}

static double fade(double t) {
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

static double between(double a, double b, double t) {
    return a + t * (b - a);
}

double noise(vec p) {
    const double fx = floor(p.x), fy = floor(p.y), fz = floor(p.z);
    const int64_t x = (int64_t)fx, y = (int64_t)fy, z = (int64_t)fz;
    const double dx = p.x - fx, dy = p.y - fy, dz = p.z - fz;
    const double u = fade(dx), v = fade(dy), w = fade(dz);
    double plane[2];
    for (int64_t k = 0; k < 2; ++k) {
        double line[2];
        for (int64_t j = 0; j < 2; ++j)
            line[j] = between(corner(x, y + j, z + k, dx, dy - (double)j, dz - (double)k),
                              corner(x + 1, y + j, z + k, dx - 1.0, dy - (double)j, dz - (double)k), u);
        plane[k] = between(line[0], line[1], v);
    }
    return between(plane[0], plane[1], w);
}

double fractal_noise(vec p, int octaves) {
    double sum = 0.0, height = 1.0;
    for (int i = 0; i < octaves; ++i) {
        sum += height * noise(p);
        p = add(scale(p, 2.0), (vec){17.3, -5.1, 9.7});
        height *= 0.5;
    }
    return sum;
}
