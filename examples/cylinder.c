/* The form factor of a cylinder in all directions, as small-angle scattering sees it (Guinier and Fournet
 * 1955):
 *
 *     P(q) = mean over axes of (sin(q L u/2) / (q L u/2) * 2 J1(q R v) / (q R v))^2,
 *
 * u the cosine between the axis and q, v the sine.
 *
 *     cc examples/cylinder.c -laureole -lm -o cylinder && ./cylinder 500
 *
 * Prints P for some q from spherical Fibonacci axes, and by Simpson's rule along u, of which it is a
 * function. */
#define _XOPEN_SOURCE 700 /* j1 */
#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static double amplitude(double q, double cosine) {
    const double length = 400.0, radius = 20.0; /* angstroms */
    const double a = 0.5 * q * length * cosine;
    const double b = q * radius * sqrt(fmax(1.0 - cosine * cosine, 0.0));
    return (fabs(a) > 1e-9 ? sin(a) / a : 1.0) * (b > 1e-9 ? 2.0 * j1(b) / b : 1.0);
}

static double reference(double q) {
    enum { STEPS = 20000 };
    double sum = 0.0;
    for (int k = 0; k <= STEPS; ++k) {
        const double f = amplitude(q, (double)k / STEPS);
        sum += (k == 0 || k == STEPS ? 1.0 : k % 2 != 0 ? 4.0 : 2.0) * f * f;
    }
    return sum / (3.0 * STEPS);
}

int main(int argc, char **argv) {
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 500;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_AXES, &options, NULL);
    double *const xyz = malloc(3 * count * sizeof *xyz);
    aur_directions *axes;
    aur_error error;
    if (xyz == NULL || aur_directions_create("spherical-fibonacci", &options, &axes, &error) != AUR_OK ||
        aur_directions_points(axes, 0, count, 3 * count, xyz, NULL, &error) != AUR_OK)
        return 1;
    for (double q = 0.005; q < 0.3; q *= 2.0) {
        double mean = 0.0;
        for (uint64_t i = 0; i < count; ++i) { /* q along x: its axis is nothing special to the set */
            const double f = amplitude(q, xyz[3 * i]);
            mean += f * f / (double)count;
        }
        printf("q %.3f P %.9f reference %.9f\n", q, mean, reference(q));
    }
    aur_directions_destroy(axes);
    free(xyz);
    return 0;
}
