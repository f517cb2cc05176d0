/* What replicas say of their pixels. */
#include "check.h"

#include "ask/replicas.h"

enum { WIDTH = 16, HEIGHT = 12, REPLICAS = 4, PIXELS = WIDTH * HEIGHT };

/* The variances by which a replica's samples are shared out come from the others: another sample of its own
 * changes none of them but by rounding, and all of the others'. */
static void test_own_values_do_not_count(void **state) {
    (void)state;
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &scene, NULL),
                     AUR_OK);
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    aur_render_options options = aur_render_options_default();
    options.integrator = "path";
    options.width = WIDTH;
    options.height = HEIGHT;
    options.samples_per_pixel = 8;
    aur_replicas replicas;
    assert_int_equal(aur_replicas_create(renderer, &options, REPLICAS, &replicas, NULL), AUR_OK);
    for (size_t r = 0; r < REPLICAS; ++r)
        assert_int_equal(aur_render_step(replicas.renders[r], 1, NULL), AUR_OK);
    static double before[REPLICAS * PIXELS], after[REPLICAS * PIXELS];
    aur_replica_measure measure;
    aur_replicas_measure(&replicas, &measure, before);
    assert_int_equal(aur_render_step(replicas.renders[0], 1, NULL), AUR_OK);
    aur_replicas_measure(&replicas, &measure, after);
    double sums[2] = {0.0, 0.0};
    for (size_t i = 0; i < PIXELS; ++i) {
        assert_near(after[i], before[i], 1e-9 * (1.0 + before[i]));
        sums[0] += before[PIXELS + i];
        sums[1] += after[PIXELS + i];
    }
    assert_true(sums[0] > 0.0 && sums[0] != sums[1]);
    aur_replicas_release(&replicas);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_own_values_do_not_count)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
