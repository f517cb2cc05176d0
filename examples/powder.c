/* A powder average: the magnetic resonance spectrum of a powder, whose crystals lie in all directions.
 *
 *     cc examples/powder.c -laureole -lm -o powder && ./powder 2000
 *
 * A nucleus with the shielding tensor delta (1, 1, -2) and no asymmetry shifts by delta (3 cos^2 - 1) / 2.
 * Directions x and -x shift alike, so that axes are enough. Prints the first two moments of the spectrum,
 * which are 0 and delta^2 / 5, and the moments from as many random axes. Behind them is the error of the
 * second: what it differs by when the set is turned at random, 16 times. */
#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { TURNS = 16 };

/* The first two moments of the shifts. */
static void moments(uint64_t count, const double *xyz, double delta, double found[2]) {
    found[0] = found[1] = 0.0;
    for (uint64_t i = 0; i < count; ++i) {
        const double shift = 0.5 * delta * (3.0 * xyz[3 * i + 2] * xyz[3 * i + 2] - 1.0);
        found[0] += shift / (double)count;
        found[1] += shift * shift / (double)count;
    }
}

static int average(const char *set, uint64_t count) {
    const double delta = 30.0; /* parts in a million */
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_AXES, &options, NULL);
    aur_directions *axes = NULL;
    aur_error error;
    double *const xyz = malloc(3 * count * sizeof *xyz);
    aur_result result = xyz != NULL ? aur_directions_create(set, &options, &axes, &error) : AUR_ERROR_MEMORY;
    if (result == AUR_OK)
        result = aur_directions_points(axes, 0, count, 3 * count, xyz, NULL, &error);
    if (result == AUR_OK) {
        double found[2], turned[2], square = 0.0;
        moments(count, xyz, delta, found);
        for (uint64_t seed = 0; seed < TURNS; ++seed) {
            aur_rotation turn;
            aur_rotation_uniform(seed, &turn);
            aur_rotation_apply(&turn, count, xyz);
            moments(count, xyz, delta, turned);
            square += (turned[1] - found[1]) * (turned[1] - found[1]) / TURNS;
        }
        printf("%-20s mean %12.6f  mean square %12.6f +- %.6f of %g\n", set, found[0], found[1], sqrt(square),
               delta * delta / 5.0);
    }
    aur_directions_destroy(axes);
    free(xyz);
    return result == AUR_OK ? 0 : 1;
}

int main(int argc, char **argv) {
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 2000;
    return average("spherical-fibonacci", count) | average("random", count);
}
