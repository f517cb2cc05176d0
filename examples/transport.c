/* Solid angles of neutron transport: the flux at depth d in front of a slab that emits evenly and
 * isotropically, attenuated along each direction, and the nearest of a code's fixed directions to those of a
 * particle.
 *
 *     cc examples/transport.c -laureole -lm -o transport && ./transport 1000
 *
 * The flux is 2 pi times the integral of exp(-t/m) over the cosine m, 2 pi E2(t), t the optical depth. Prints
 * it from N directions of the hemisphere and in closed form (by Simpson's rule), and how far a particle is
 * turned by being moved to the nearest of 64 directions (at most their covering radius). */
#include <aureole/nearest.h>
#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static double *directions(const char *set, uint64_t count, aur_domain domain) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    double *const xyz = malloc(3 * count * sizeof *xyz);
    aur_directions *created;
    aur_error error;
    if (xyz == NULL || aur_directions_create(set, &options, &created, &error) != AUR_OK ||
        aur_directions_points(created, 0, count, 3 * count, xyz, NULL, &error) != AUR_OK)
        exit(1);
    aur_directions_destroy(created);
    return xyz;
}

int main(int argc, char **argv) {
    enum { FIXED = 64, STEPS = 20000 };
    const double turn = 6.283185307179586, depth = 0.5;
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000;
    double *const xyz = directions("spherical-fibonacci", count, AUR_DOMAIN_HEMISPHERE);
    double flux = 0.0, exact = exp(-depth);
    for (uint64_t i = 0; i < count; ++i)
        flux += turn / (double)count * exp(-depth / xyz[3 * i + 2]);
    for (int k = 1; k < STEPS; ++k)
        exact += (k % 2 != 0 ? 4.0 : 2.0) * exp(-depth * STEPS / k);
    exact *= turn / (3.0 * STEPS);
    printf("flux %.9f exact %.9f\n", flux, exact);

    double *const fixed = directions("electrostatic", FIXED, AUR_DOMAIN_SPHERE);
    const aur_points_view view = aur_points_view_of(AUR_DOMAIN_SPHERE, FIXED, 3, fixed);
    size_t *const indices = malloc(count * sizeof *indices);
    double *const angles = malloc(count * sizeof *angles);
    aur_nearest *nearest;
    aur_error error;
    if (indices == NULL || angles == NULL || aur_nearest_create(&view, &nearest, &error) != AUR_OK ||
        aur_nearest_find(nearest, NULL, count, xyz, indices, angles, &error) != AUR_OK)
        return 1;
    double widest = 0.0, mean = 0.0;
    for (uint64_t i = 0; i < count; ++i) {
        widest = fmax(widest, angles[i]);
        mean += angles[i] / (double)count;
    }
    printf("turned %.6f mean %.6f radians\n", widest, mean);
    aur_nearest_destroy(nearest);
    free(xyz);
    free(fixed);
    free(indices);
    free(angles);
    return 0;
}
