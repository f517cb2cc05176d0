/* Radiosity with out-of-memory failures of every allocation in turn. */
#include "failing_memory.h"
#include "radiosity_room.h"

/* Two walls lie on each other, so that there is something to report. */
#define WITH_COINCIDENCE                                                                                     \
    ROOM "<shape type='rectangle'><transform name='to_world'><translate z='-1'/></transform></shape>"

static aur_radiosity_options scrambled(void) {
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 3);
    options.scramble = AUR_SCRAMBLE_OWEN;
    options.randomizations = 2;
    options.threads = 2;
    return options;
}

/* No solution is created with less than complete statistics. */
static void making_fails_as_a_whole(void **state) {
    (void)state;
    aur_scene *const scene = must_load_uncut(WITH_COINCIDENCE);
    const aur_radiosity_options options = scrambled();
    size_t nth = 0;
    aur_radiosity *radiosity = NULL;
    while (radiosity == NULL) {
        aur_error error = {0};
        fail_allocation(++nth);
        const aur_result result = aur_radiosity_create(scene, &options, &radiosity, &error);
        fail_allocation(0);
        assert_int_equal(result, radiosity != NULL ? AUR_OK : AUR_ERROR_MEMORY);
        if (radiosity == NULL)
            assert_non_null(strstr(error.message, "out of memory"));
    }
    assert_true(nth > 8);
    assert_int_equal(describe(radiosity).coincident, 2);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

/* A failed request can be repeated, and gives the same result as without a failure. */
static void tracing_can_be_tried_again(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    const aur_radiosity_options options = scrambled();
    aur_radiosity *const whole = must_trace(scene, &options, 3000);
    size_t failures = 0;
    for (bool failed = true; failed;) {
        aur_radiosity *const radiosity = must_create(scene, &options);
        fail_allocation(failures + 1);
        const aur_result result = aur_radiosity_trace(radiosity, 3000, NULL);
        fail_allocation(0);
        failed = result != AUR_OK;
        if (failed) {
            assert_int_equal(result, AUR_ERROR_MEMORY);
            assert_int_equal(aur_radiosity_trace(radiosity, 3000, NULL), AUR_OK);
            ++failures;
        }
        assert_same(whole, radiosity);
        aur_radiosity_destroy(radiosity);
    }
    assert_true(failures > 5);
    aur_radiosity_destroy(whole);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(making_fails_as_a_whole),
        cmocka_unit_test(tracing_can_be_tried_again),
    };
    return cmocka_run_group_tests_name("radiosity without memory", tests, enter_folder, leave_folder);
}
