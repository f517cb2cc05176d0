#include "samples.h"

#include <math.h>
#include <string.h>

static bool can_make(const char *set, size_t count, aur_scramble scramble) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_HEMISPHERE, &options, NULL);
    options.scramble = scramble;
    aur_directions *directions;
    const aur_result result = aur_directions_create(set, &options, &directions, NULL);
    aur_directions_destroy(directions);
    return result == AUR_OK;
}

aur_scramble lab_scrambling(const char *set) {
    if (strncmp(set, "random", 6) == 0)
        return AUR_SCRAMBLE_NONE;
    /* A file has a fixed number of points, and files of several sizes need not have all requested sizes. */
    static const size_t counts[] = {0, 64, 128, 16, 32, 256, 512, 1024, 2048, 4096, 8, 4};
    size_t i = 0;
    while (i + 1 < sizeof counts / sizeof counts[0] && !can_make(set, counts[i], AUR_SCRAMBLE_NONE))
        ++i;
    return can_make(set, counts[i], AUR_SCRAMBLE_DIGIT)   ? AUR_SCRAMBLE_DIGIT
           : can_make(set, counts[i], AUR_SCRAMBLE_SHIFT) ? AUR_SCRAMBLE_SHIFT
                                                          : AUR_SCRAMBLE_ROTATE;
}

aur_result lab_draw(const lab_samples *requested, double *xyz, double *weights, aur_error *error) {
    aur_directions_options options = {.size = sizeof options,
                                      .count = requested->count,
                                      .domain = AUR_DOMAIN_HEMISPHERE,
                                      .lobe = {.exponent = requested->exponent},
                                      .optimal_density = requested->optimal_density,
                                      .scramble = lab_scrambling(requested->set),
                                      .seed = requested->seed};
    aur_directions *directions;
    aur_result result = aur_directions_create(requested->set, &options, &directions, error);
    if (result != AUR_OK)
        return result;
    result = aur_directions_points(directions, 0, requested->count, 3 * requested->count, xyz, weights, NULL);
    aur_directions_destroy(directions);
    return result;
}

aur_result lab_lobe_potential(double exponent, double smoothness, aur_potential **potential,
                              aur_error *error) {
    const aur_density density = {
        .size = sizeof(aur_density), .kind = AUR_DENSITY_COSINE_POWER, .exponent = exponent};
    return aur_potential_create(&density, smoothness, potential, error);
}

/* A number in [0,1) hashed from its purpose (the finalizer of SplitMix). */
static double hashed(uint64_t seed, uint64_t what) {
    uint64_t x = seed * UINT64_C(0x9e3779b97f4a7c15) + what * UINT64_C(0xd6e8feb86659fd93) + 1;
    x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)((x ^ x >> 31) >> 11) * 0x1p-53;
}

lab_light lab_random_light(uint64_t seed, bool hard) {
    const double pi = 3.14159265358979323846;
    lab_light light = {.hard = hard};
    for (uint64_t i = 0; i < LAB_LIGHT_PARTS; ++i) {
        const double z = 2.0 * hashed(seed, 4 * i) - 1.0, phi = 2.0 * pi * hashed(seed, 4 * i + 1);
        light.axis[i][0] = sqrt(1.0 - z * z) * cos(phi);
        light.axis[i][1] = sqrt(1.0 - z * z) * sin(phi);
        light.axis[i][2] = z;
        light.sharpness[i] = 2.0 * pow(30.0, hashed(seed, 4 * i + 2));
        light.height[i] = hashed(seed, 4 * i + 3);
    }
    return light;
}

double lab_radiance(const lab_light *light, const double direction[3]) {
    if (direction[2] < 0.0)
        return 0.0;
    double sum = 0.3;
    for (int i = 0; i < LAB_LIGHT_PARTS; ++i) {
        const double *const axis = light->axis[i];
        const double depth = 1.0 - direction[0] * axis[0] - direction[1] * axis[1] - direction[2] * axis[2];
        if (light->hard)
            sum += light->sharpness[i] * depth < 1.0 ? light->height[i] : 0.0;
        else
            sum += light->height[i] * exp(-light->sharpness[i] * depth);
    }
    return sum;
}
