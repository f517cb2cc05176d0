/* Ambisonics: a sound field is sampled by microphones on a sphere, projected on spherical harmonics to degree
 * 1 (the four channels W, Y, Z, X) and played back by loudspeakers.
 *
 *     cc examples/ambisonics.c -laureole -lm -o ambisonics && ./ambisonics 32
 *
 * A cardioid source from direction s is 1 + s.x; its channels are W = 1 and (X, Y, Z) = s in SN3D
 * normalisation. With equal weights they are means over the microphones of the signal and of 3 x times the
 * signal. Prints the error of the channels from charges at rest and from a spiral, and the angle from s to
 * the loudest loudspeaker of 24. */
#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double source[3] = {0.48, -0.6, 0.64};

static double *directions(const char *set, uint64_t count) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
    double *const xyz = malloc(3 * count * sizeof *xyz);
    aur_directions *created;
    aur_error error;
    if (xyz == NULL || aur_directions_create(set, &options, &created, &error) != AUR_OK ||
        aur_directions_points(created, 0, count, 3 * count, xyz, NULL, &error) != AUR_OK)
        exit(1);
    aur_directions_destroy(created);
    return xyz;
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* W and X, Y, Z of what `count` microphones hear. */
static double project(const char *set, uint64_t count, double channels[4]) {
    double *const microphones = directions(set, count);
    for (size_t c = 0; c < 4; ++c)
        channels[c] = 0.0;
    for (uint64_t i = 0; i < count; ++i) {
        const double *const x = microphones + 3 * i;
        const double signal = (1.0 + dot(source, x)) / (double)count;
        channels[0] += signal;
        for (size_t d = 0; d < 3; ++d)
            channels[1 + d] += 3.0 * x[d] * signal;
    }
    free(microphones);
    double worst = fabs(channels[0] - 1.0);
    for (size_t d = 0; d < 3; ++d)
        worst = fmax(worst, fabs(channels[1 + d] - source[d]));
    return worst;
}

int main(int argc, char **argv) {
    enum { LOUDSPEAKERS = 24 };
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 32;
    double channels[4];
    printf("spiral %.3e\n", project("spherical-fibonacci", count, channels));
    printf("charges %.3e\n", project("electrostatic", count, channels));
    double *const speakers = directions("electrostatic", LOUDSPEAKERS);
    size_t loudest = 0;
    for (size_t i = 0; i < LOUDSPEAKERS; ++i)
        if (dot(channels + 1, speakers + 3 * i) > dot(channels + 1, speakers + 3 * loudest))
            loudest = i;
    printf("loudspeaker %.3f radians\n", acos(fmin(dot(source, speakers + 3 * loudest), 1.0)));
    free(speakers);
    return 0;
}
