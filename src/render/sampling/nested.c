#include "render/sampling/rule.h"

#include <math.h>

#include "points/base/vector.h"

/* The azimuth of a point relative to the previous one, in turns. */
static double golden_turn(void) {
    return 0.5 * (sqrt(5.0) - 1.0);
}

/* Lattice neighbours are F points apart, F a Fibonacci number. Their azimuths differ by F golden turns modulo
 * 1, which is small, and their heights by F / count, downwards. */
typedef struct lattice_step {
    double azimuth, height;
} lattice_step;

static lattice_step step_of(double fibonacci, size_t count) {
    const double turns = fibonacci * golden_turn();
    return (lattice_step){turns - round(turns), -fibonacci / (double)count};
}

/* At half height, where a turn is 2 pi sin(theta) long and a height 1 / sin(theta). */
static double square_length(lattice_step step) {
    const double sine_squared = 0.75;
    return 4.0 * AUR_PI * AUR_PI * sine_squared * step.azimuth * step.azimuth +
           step.height * step.height / sine_squared;
}

void aur_nested_shift(size_t count, size_t number, double point[2]) {
    double one = 1.0, two = 2.0;
    while (square_length(step_of(one + two, count)) < square_length(step_of(one, count))) {
        const double three = one + two;
        one = two;
        two = three;
    }
    const lattice_step steps[2] = {step_of(one, count), step_of(two, count)};
    point[1] += 0.5 / ((double)(1 << AUR_NESTED_LEVELS) * (double)count);
    for (size_t level = 0; level < AUR_NESTED_LEVELS; ++level) {
        const size_t bits = number >> 2 * (AUR_NESTED_LEVELS - 1 - level) & 3u;
        for (size_t k = 0; k < 2; ++k) {
            const double part = (bits >> k & 1u) != 0 ? 1.0 / (double)(2u << level) : 0.0;
            point[0] += part * steps[k].azimuth;
            point[1] += part * steps[k].height;
        }
    }
    const double beyond = floor(point[1]);
    point[0] += beyond * (double)count * golden_turn();
    point[1] -= beyond;
}
