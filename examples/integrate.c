/* An integral over directions and energies to a tolerance: the power that a beam brings to a small absorber,
 *
 *     P = integral over the sphere and 0.1..10 MeV of radiance(u, E) absorptance(E) E,
 *
 * with a radiance of exp(8 (u.b - 1)) exp(-E) about the direction b and an absorptance of 1 - exp(-1/E).
 *
 *     cc examples/integrate.c -laureole -lm -o integrate && ./integrate 1e-4
 *
 * Prints the power, its error and how the work ended. The direction has the closed form pi/4 (1 - e^-16), so
 * that the program can say how far off it is in truth. */
#include <aureole/integrate.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct beam {
    double direction[3], sharpness;
} beam;

static double absorbed(double energy) {
    return energy * exp(-energy) * (1.0 - exp(-1.0 / energy));
}

/* Called with many points at a time: directions x,y,z, x,y,z, ... and an energy for each. */
static aur_result radiance(void *user, size_t count, const double *directions, const double *energies,
                           double *values, aur_error *error) {
    const beam *const b = user;
    (void)error; /* aur_fail(error, ...) here ends the integration */
    for (size_t i = 0; i < count; ++i) {
        const double *const u = directions + 3 * i;
        const double cosine = u[0] * b->direction[0] + u[1] * b->direction[1] + u[2] * b->direction[2];
        values[i] = exp(b->sharpness * (cosine - 1.0)) * absorbed(energies[i]);
    }
    return AUR_OK;
}

/* The same by Simpson's rule along the energies and the closed form over the sphere. */
static double exact(const beam *b, double from, double to) {
    enum { STEPS = 10000 };
    const double width = (to - from) / STEPS;
    double sum = absorbed(from) + absorbed(to);
    for (int k = 1; k < STEPS; ++k)
        sum += (k % 2 != 0 ? 4.0 : 2.0) * absorbed(from + k * width);
    const double pi = 3.14159265358979323846;
    return 2.0 * pi * (1.0 - exp(-2.0 * b->sharpness)) / b->sharpness * sum * width / 3.0;
}

int main(int argc, char **argv) {
    beam b = {{0.6, 0.0, 0.8}, 8.0};
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.has_axis = true;
    options.axis_from = 0.1;
    options.axis_to = 10.0;
    options.relative = argc > 1 ? atof(argv[1]) : 1e-3;
    aur_integral integral = {.size = sizeof integral};
    aur_error error;
    if (aur_integrate(radiance, &b, &options, &integral, &error) != AUR_OK) {
        fprintf(stderr, "integrate: %s\n", error.message);
        return 2;
    }
    printf("power       %.8g\n", integral.value);
    printf("interval    %.2g (95 %%)\n", integral.interval);
    printf("evaluations %llu on %zu levels\n", (unsigned long long)integral.evaluations, integral.levels);
    printf("ended by    %s\n",
           integral.reason == AUR_INTEGRATE_TOLERANCE ? "the tolerance" : "the evaluations allowed");
    printf("off by      %.2g\n", fabs(integral.value - exact(&b, options.axis_from, options.axis_to)));
    return 0;
}
