/* If final gathering is not possible, or cancelled during its creation, the adaptive render continues or ends
 * in order. */
#include "render/prepared.h"
#include "render/scene/scene_text.h"

#include "render/adaptive/candidate.h"

/* A light source that illuminates only the camera: no photon is stored. */
static const char single_emitter[] =
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='180'/><rotate z='1' "
    "angle='20'/><translate z='4'/></transform><emitter type='area'><rgb name='radiance' "
    "value='5'/></emitter>"
    "</shape><shape type='rectangle'><transform name='to_world'><translate z='6'/></transform></shape>";

static void paths_go_on_where_no_photon_is_stored(void **state) {
    (void)state;
    const prepared lit = prepare(must_load_body(single_emitter));
    aur_render_options options = image_of_size(72, 72);
    options.filter = "box";
    aur_error error = {0};
    options.integrator = "finalgather:photons=1000";
    aur_render *refused = NULL;
    assert_int_equal(aur_render_create(lit.renderer, &options, &refused, &error), AUR_ERROR_UNSUPPORTED);
    options.integrator = NULL;
    /* So small that final gathering is tried. */
    const aur_adaptive_options target = target_of(0.001, AUR_ERROR_MEASURE_RELATIVE);
    aur_adaptive *adaptive = NULL;
    assert_int_equal(aur_adaptive_create(lit.renderer, &options, &target, &adaptive, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(adaptive, &error), AUR_OK);
    assert_int_equal(strncmp(aur_adaptive_integrator(adaptive), "path", 4), 0);
    aur_adaptive_report report = {.size = sizeof report};
    assert_int_equal(aur_adaptive_get_report(adaptive, &report, NULL), AUR_OK);
    assert_true(report.error_high <= target.error);
    aur_adaptive_destroy(adaptive);
    release(lit);
}

/* Calls that are left until it stops. */
static int count_down(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what, (void)done, (void)total;
    size_t *const left = user;
    return *left == 0 || --*left == 0;
}

/* Cancels after each call, until no call is left: what was created is counted, and released. */
static void a_candidate_is_cancelled_during_creation(void **state) {
    (void)state;
    const prepared box = prepare_file(CORNELL_BOX);
    enum { REPLICAS = 4 };
    size_t stopped = 0, calls = 1, left = 0;
    aur_render_options options = image_of_size(16, 16);
    options.progress = (aur_progress){count_down, &left};
    for (aur_result result = AUR_ERROR_CANCELLED; result != AUR_OK; ++calls) {
        aur_candidate candidate = {.integrator = strdup("finalgather:split=1,photons=20000")};
        aur_spent spent = {.budget = 0};
        left = calls;
        result =
            aur_candidate_create(box.renderer, &options, REPLICAS, AUR_ERROR_MEASURE_MEAN, &candidate, NULL);
        assert_true(result == AUR_OK || result == AUR_ERROR_CANCELLED);
        stopped += result == AUR_ERROR_CANCELLED;
        assert_true(candidate.replicas.count <= REPLICAS);
        assert_int_equal(candidate.replicas.count == REPLICAS, result == AUR_OK);
        for (size_t r = 0; r < candidate.replicas.count; ++r)
            assert_non_null(candidate.replicas.renders[r]);
        aur_candidate_add_spent(&candidate, &spent);
        aur_candidate_release(&candidate);
    }
    print_message("stopped after each of %zu calls\n", stopped);
    assert_true(stopped >= REPLICAS); /* each replica's map calls at least once */
    release(box);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(paths_go_on_where_no_photon_is_stored),
                                       cmocka_unit_test(a_candidate_is_cancelled_during_creation)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
