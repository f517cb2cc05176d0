/* Gathering in a renderer that has its own rays: one set of directions with optimal weights, made once, and
 * turned about the normal by another angle for every pixel.
 *
 *     cc examples/gather.c -laureole -lm -o gather && ./gather 64
 *
 * `radiance` stands for the renderer's ray: a smooth sky with a bright side. Irradiance over pi is its mean
 * under the cosine; prints the error over 1000 pixels, each under a sky of its own, of equal and of optimal
 * weights. */
#include <aureole/quadrature.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { PIXELS = 1000 };

static double radiance(const double u[3], double azimuth) {
    return exp(2.0 * (0.6 * (u[0] * cos(azimuth) + u[1] * sin(azimuth)) + 0.8 * u[2]));
}

/* The mean square of the errors; `reference` is the mean of many directions. */
static int gather(size_t count, bool optimal, double reference, double *found) {
    aur_directions_options points = {.size = sizeof points};
    aur_directions_options_init(count, AUR_DOMAIN_HEMISPHERE, &points, NULL);
    points.lobe.exponent = 1.0;
    aur_rule_options options = {.size = sizeof options};
    aur_rule_options_init(&points, &options, NULL);
    options.optimal = optimal;
    aur_error error;
    double *const xyz = malloc(4 * count * sizeof *xyz), *const weights = xyz + 3 * count, square = 0.0;
    if (xyz == NULL || aur_rule_make(&options, 3 * count, xyz, weights, &error) != AUR_OK)
        return 1;
    for (size_t pixel = 0; pixel < PIXELS; ++pixel) {
        aur_rotation turn;
        aur_rotation_axial(pixel, &turn);
        double sum = 0.0;
        for (size_t i = 0; i < count; ++i) {
            double u[3] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
            aur_rotation_apply(&turn, 1, u);
            sum += weights[i] * radiance(u, 0.001 * (double)pixel);
        }
        square += (reference > 0.0 ? (sum / reference - 1.0) * (sum / reference - 1.0) : sum) / PIXELS;
    }
    free(xyz);
    *found = square;
    return 0;
}

int main(int argc, char **argv) {
    const size_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 64;
    double reference, equal, optimal;
    if (gather(8192, false, 0.0, &reference) || gather(count, false, reference, &equal) ||
        gather(count, true, reference, &optimal))
        return 1;
    printf("equal %.3e optimal %.3e\n", sqrt(equal), sqrt(optimal));
    return 0;
}
