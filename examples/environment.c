/* The irradiance that an environment brings to a surface, to a tolerance: the CIE overcast sky on level
 * ground, 7 pi/9 of the luminance of its zenith.
 *
 *     cc examples/environment.c -laureole -lm -o environment && ./environment 1e-4
 *
 * Prints the irradiance, its error and the closed form. Any function of a direction may take the sky's place:
 * an image of the surroundings, a sky model, rays of a renderer. */
#include <aureole/integrate.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static aur_result sky(void *user, size_t count, const double *directions, const double *along, double *values,
                      aur_error *error) {
    (void)along;
    (void)error;
    const double zenith = *(const double *)user;
    for (size_t i = 0; i < count; ++i)
        values[i] = zenith * (1.0 + 2.0 * directions[3 * i + 2]) / 3.0;
    return AUR_OK;
}

int main(int argc, char **argv) {
    double zenith = 1000.0; /* candela a square metre */
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_HEMISPHERE, &options, NULL);
    options.relative = argc > 1 ? atof(argv[1]) : 1e-4;
    options.exponent = 1.0; /* times the cosine, which directions follow */
    aur_integral lux = {.size = sizeof lux};
    aur_error error;
    if (aur_integrate(sky, &zenith, &options, &lux, &error) != AUR_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("irradiance %.4f lux, error %.4f, of %.4f\n", lux.value, lux.error,
           7.0 * acos(-1.0) / 9.0 * zenith);
    return 0;
}
