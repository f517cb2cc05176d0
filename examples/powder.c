/* A powder average: the magnetic resonance spectrum of a powder, whose crystals lie in all directions.
 *
 *     cc examples/powder.c -laureole -lm -o powder && ./powder 2000
 *
 * A nucleus with the shielding tensor delta (1, 1, -2) and no asymmetry shifts by delta (3 cos^2 - 1) / 2.
 * Directions x and -x shift alike, so that axes are enough. Prints the first two moments of the spectrum,
 * which are 0 and delta^2 / 5, and the moments from as many random axes. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <stdlib.h>

static int average(const char *set, uint64_t count) {
    const double delta = 30.0; /* parts in a million */
    const aur_directions_options options = aur_directions_options_default(count, AUR_DOMAIN_AXES);
    aur_directions *axes = NULL;
    aur_error error;
    double *const xyz = malloc(3 * count * sizeof *xyz);
    aur_result result = xyz != NULL ? aur_directions_create(set, &options, &axes, &error) : AUR_ERROR_MEMORY;
    if (result == AUR_OK)
        result = aur_directions_points(axes, 0, count, 3 * count, xyz, NULL, &error);
    double first = 0.0, second = 0.0;
    for (uint64_t i = 0; i < count && result == AUR_OK; ++i) {
        const double shift = 0.5 * delta * (3.0 * xyz[3 * i + 2] * xyz[3 * i + 2] - 1.0);
        first += shift / (double)count;
        second += shift * shift / (double)count;
    }
    if (result == AUR_OK)
        printf("%-20s mean %12.6f  mean square %12.6f of %g\n", set, first, second, delta * delta / 5.0);
    aur_directions_destroy(axes);
    free(xyz);
    return result == AUR_OK ? 0 : 1;
}

int main(int argc, char **argv) {
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 2000;
    return average("spherical-fibonacci", count) | average("random", count);
}
