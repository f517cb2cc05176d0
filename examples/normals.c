/* Normals in 16 bits: the index of the nearest of 65536 spherical Fibonacci points, found and read without a
 * table.
 *
 *     cc examples/normals.c -laureole -lm -o normals && ./normals
 *
 * Prints the largest and the mean angle, in degrees, between 100000 random normals and what comes back, for
 * this code and for an octahedron of 8 + 8 bits. */
#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NORMALS = 100000, POINTS = 65536 };

static double angle(const double a[3], const double b[3]) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return 2.0 * asin(0.5 * sqrt(x * x + y * y + z * z)) * 57.29577951308232;
}

/* To the octahedron's square, rounded to 256 steps a side, and back (Meyer and others 2010). */
static void octahedron(const double n[3], double back[3]) {
    const double norm = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
    double p[2] = {n[0] / norm, n[1] / norm};
    if (n[2] < 0.0) {
        const double x = (1.0 - fabs(p[1])) * copysign(1.0, p[0]);
        p[1] = (1.0 - fabs(p[0])) * copysign(1.0, p[1]);
        p[0] = x;
    }
    for (int d = 0; d < 2; ++d)
        p[d] = floor((0.5 * p[d] + 0.5) * 255.0 + 0.5) / 255.0 * 2.0 - 1.0;
    double v[3] = {p[0], p[1], 1.0 - fabs(p[0]) - fabs(p[1])};
    if (v[2] < 0.0) {
        v[0] = (1.0 - fabs(p[1])) * copysign(1.0, p[0]);
        v[1] = (1.0 - fabs(p[0])) * copysign(1.0, p[1]);
    }
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int d = 0; d < 3; ++d)
        back[d] = v[d] / length;
}

int main(void) {
    static double normals[3 * NORMALS];
    static uint64_t codes[NORMALS];
    aur_directions_options of_normals = {.size = sizeof of_normals};
    aur_directions_options_init(NORMALS, AUR_DOMAIN_SPHERE, &of_normals, NULL);
    aur_directions_options of_codes = {.size = sizeof of_codes};
    aur_directions_options_init(POINTS, AUR_DOMAIN_SPHERE, &of_codes, NULL);
    const aur_fibonacci_set set = {POINTS, AUR_DOMAIN_SPHERE};
    aur_directions *random = NULL, *even = NULL;
    aur_error error;
    if (aur_directions_create("random", &of_normals, &random, &error) != AUR_OK ||
        aur_directions_create("spherical-fibonacci", &of_codes, &even, &error) != AUR_OK ||
        aur_directions_points(random, 0, NORMALS, 3 * NORMALS, normals, NULL, &error) != AUR_OK ||
        aur_fibonacci_nearest(&set, NORMALS, normals, NORMALS, codes, &error) != AUR_OK)
        return 1;
    double largest[2] = {0.0, 0.0}, mean[2] = {0.0, 0.0};
    for (size_t i = 0; i < NORMALS; ++i) {
        double back[2][3];
        if (aur_directions_points(even, codes[i], 1, 3, back[0], NULL, &error) != AUR_OK)
            return 1;
        octahedron(normals + 3 * i, back[1]);
        for (int way = 0; way < 2; ++way) {
            const double off = angle(normals + 3 * i, back[way]);
            largest[way] = fmax(largest[way], off);
            mean[way] += off / NORMALS;
        }
    }
    printf("fibonacci %.4f %.4f octahedron %.4f %.4f\n", largest[0], mean[0], largest[1], mean[1]);
    aur_directions_destroy(random);
    aur_directions_destroy(even);
    return 0;
}
