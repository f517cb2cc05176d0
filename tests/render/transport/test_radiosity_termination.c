/* The error estimate of radiosity, and its termination. */
#include "radiosity_room.h"

/* The error bar estimates the distance of the solution from the exact one: root mean squares over 16
 * solutions. Their scatter is about a tenth; three such are allowed. */
static void error_bar_is_honest(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    double reported = 0.0, found = 0.0;
    for (uint64_t seed = 0; seed < 16; ++seed) {
        aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 29);
        options.scramble = AUR_SCRAMBLE_OWEN;
        options.randomizations = 16;
        options.seed = seed;
        aur_radiosity *const radiosity = must_trace(scene, &options, 4096);
        aur_radiosity_triangle_result results[MOST_TRIANGLES];
        const size_t count = get_results(radiosity, results);
        double squares = 0.0;
        for (size_t i = 0; i < count; ++i) {
            found += (results[i].radiance[0] - 0.5) * (results[i].radiance[0] - 0.5);
            reported += results[i].standard_error[0] * results[i].standard_error[0];
            for (size_t c = 0; c < 3; ++c) {
                const double power_error = results[i].standard_error[c] * 2.0 * AUR_PI * results[i].area;
                squares += power_error * power_error * results[i].area;
            }
        }
        assert_relative(describe(radiosity).error, sqrt(squares / 24.0) / (sqrt(3.0) * 0.25 * 24.0), 1e-6);
        aur_radiosity_destroy(radiosity);
    }
    assert_relative(sqrt(reported), sqrt(found), 0.3);
    aur_scene_destroy(scene);
}

/* --- termination */

/* The paper's formula by the public results, and its rule step by step. */
static void terminates_as_the_paper_says(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_UNIFORM_ANGLE, 29);
    const double epsilon = 1e-3;
    aur_radiosity *const stepwise = must_create(scene, &options), *const adaptive =
                                                                      must_create(scene, &options);
    double before[12][3] = {{0}}, change = INFINITY;
    unsigned quiet = 0;
    uint64_t paths = 0;
    while (quiet < 2) {
        paths += 1000;
        assert_int_equal(aur_radiosity_trace(stepwise, paths, NULL), AUR_OK);
        aur_radiosity_triangle_result results[MOST_TRIANGLES];
        get_results(stepwise, results);
        double sum = 0.0;
        for (size_t i = 0; i < 12; ++i)
            for (size_t c = 0; c < 3; ++c) {
                sum += (results[i].power[c] - before[i][c]) * (results[i].power[c] - before[i][c]) * 2.0;
                before[i][c] = results[i].power[c];
            }
        change = sqrt(sum / 24.0) / (sqrt(3.0) * 0.25 * 24.0);
        quiet = paths > 1000 && change < epsilon ? quiet + 1 : 0;
    }
    bool converged = false;
    aur_error error = {0};
    const aur_radiosity_termination rule = {.size = sizeof rule, .epsilon = epsilon};
    assert_int_equal(aur_radiosity_terminate(adaptive, &rule, &converged, &error), AUR_OK);
    assert_true(converged);
    assert_int_equal(describe(adaptive).paths, paths);
    assert_relative(describe(adaptive).change, change, 1e-9);
    assert_same(stepwise, adaptive);
    /* A limit ends it before. */
    aur_radiosity *const limited = must_create(scene, &options);
    assert_int_equal(aur_radiosity_terminate(
                         limited,
                         &(aur_radiosity_termination){
                             .size = sizeof(aur_radiosity_termination), .epsilon = 1e-9, .limit = 4500},
                         &converged, NULL),
                     AUR_OK);
    assert_false(converged);
    assert_int_equal(describe(limited).paths, 4500);
    assert_int_equal(aur_radiosity_terminate(limited, &rule, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "4500 paths are not a multiple of the interval of 1000"));
    assert_int_equal(
        aur_radiosity_terminate(
            adaptive, &(aur_radiosity_termination){.size = sizeof(aur_radiosity_termination), .epsilon = 0.0},
            NULL, &error),
        AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "epsilon must be above 0"));
    aur_radiosity_destroy(limited);
    aur_radiosity_destroy(stepwise);
    aur_radiosity_destroy(adaptive);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_bar_is_honest),
        cmocka_unit_test(terminates_as_the_paper_says),
    };
    return cmocka_run_group_tests_name("radiosity termination", tests, enter_folder, leave_folder);
}
