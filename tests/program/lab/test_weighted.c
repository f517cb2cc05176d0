/* Optimal weights of one lobe: those of the library for the directions of each copy of a pattern. */
#include <aureole/quadrature.h>

#include "check.h"

#include "lab/gathering/weighted.h"

#define PI 3.14159265358979323846

enum { COUNT = 48, COPIES = 3, TOTAL = COUNT * COPIES };

static void optimal_weights(void **state) {
    (void)state;
    const double m = 20.0, mass = 2.0 * PI / (m + 1.0);
    float x[TOTAL], y[TOTAL], z[TOTAL], weights[TOTAL];
    const aur_gather_directions pattern = {
        .count = COUNT, .copies = COPIES, .exponent = m, .x = x, .y = y, .z = z, .weights = weights};
    /* A spiral whose heights have the density of the lobe; copies are turned. */
    for (size_t i = 0; i < TOTAL; ++i) {
        const double height = pow(((double)(i % COUNT) + 0.5) / COUNT, 1.0 / (m + 1.0));
        const double azimuth = 2.4 * (double)(i % COUNT) + 0.7 * (double)(i / COUNT);
        x[i] = (float)(sqrt(1.0 - height * height) * cos(azimuth));
        y[i] = (float)(sqrt(1.0 - height * height) * sin(azimuth));
        z[i] = (float)height;
        weights[i] = -1.0f;
    }
    const lab_gather_settings settings = {
        .gather = {.smoothness = 1.5}, .weights = LAB_WEIGHTS_OSW, .regularization = 1e-6};
    void *prepared = NULL;
    assert_int_equal(
        lab_gather_weighted.prepare(&settings.gather, NULL, COUNT, &pattern, NULL, &prepared, NULL), AUR_OK);
    aur_potential *potential;
    assert_int_equal(aur_potential_create(&(aur_density){.size = sizeof(aur_density), .exponent = m}, 1.5,
                                          &potential, NULL),
                     AUR_OK);
    const aur_potential *const potentials[] = {potential};
    for (size_t copy = 0; copy < COPIES; ++copy) {
        double xyz[3 * COUNT], expected[COUNT], sum = 0.0;
        for (size_t i = 0; i < COUNT; ++i) {
            const size_t at = copy * COUNT + i;
            const double length = sqrt((double)x[at] * (double)x[at] + (double)y[at] * (double)y[at] +
                                       (double)z[at] * (double)z[at]);
            xyz[3 * i] = (double)x[at] / length;
            xyz[3 * i + 1] = (double)y[at] / length;
            xyz[3 * i + 2] = (double)z[at] / length;
            sum += (double)weights[at] / COUNT;
        }
        assert_relative(sum, mass, 1e-6); /* constants are exact */
        assert_int_equal(
            aur_weights_solve(COUNT, xyz, 1, potentials, NULL, COUNT, expected, NULL, NULL, NULL), AUR_OK);
        for (size_t i = 0; i < COUNT; ++i)
            assert_near((double)weights[copy * COUNT + i] / COUNT, mass * expected[i], 1e-4 * mass / COUNT);
    }
    aur_potential_destroy(potential);
    lab_gather_weighted.release(prepared);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(optimal_weights)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
