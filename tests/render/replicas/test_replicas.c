/* Statistics of pixels from replicas. */
#include "render/prepared.h"

#include "render/film/film.h"
#include "render/replicas/replicas.h"

enum { WIDTH = 16, HEIGHT = 12, REPLICAS = 4, PIXELS = WIDTH * HEIGHT };

typedef struct fixture {
    prepared box;
    aur_replicas replicas;
} fixture;

/* Replicas of the Cornell box, with so many samples per pixel rendered. */
static void begin(fixture *f, size_t samples) {
    const aur_render_options options = image_of_size(WIDTH, HEIGHT);
    f->box = prepare_file(CORNELL_BOX);
    assert_int_equal(aur_replicas_create(f->box.renderer, &options, "path", REPLICAS, &f->replicas, NULL),
                     AUR_OK);
    for (size_t r = 0; r < REPLICAS; ++r)
        assert_int_equal(aur_render_step(f->replicas.renders[r], samples, NULL), AUR_OK);
}

static void end(fixture *f) {
    aur_replicas_release(&f->replicas);
    release(f->box);
}

/* The variances that distribute a replica's samples come from the other replicas: an additional sample
 * changes its own only by rounding, and those of all others. */
static void test_values_of_the_replica_do_not_count(void **state) {
    (void)state;
    fixture f;
    begin(&f, 1);
    static double before[REPLICAS * PIXELS], after[REPLICAS * PIXELS];
    static double light[REPLICAS * PIXELS][3], means[PIXELS][3];
    aur_replica_measure measure;
    aur_replicas_mean(&f.replicas, light, means);
    aur_replicas_measure(&f.replicas, (const double(*)[3])light,
                         (aur_weighing){.measure = AUR_ERROR_MEASURE_MEAN}, &measure, before);
    assert_int_equal(aur_render_step(f.replicas.renders[0], 1, NULL), AUR_OK);
    aur_replicas_mean(&f.replicas, light, means);
    aur_replicas_measure(&f.replicas, (const double(*)[3])light,
                         (aur_weighing){.measure = AUR_ERROR_MEASURE_MEAN}, &measure, after);
    double sums[2] = {0.0, 0.0};
    for (size_t i = 0; i < PIXELS; ++i) {
        assert_near(after[i], before[i], 1e-9 * (1.0 + before[i]));
        sums[0] += before[PIXELS + i];
        sums[1] += after[PIXELS + i];
    }
    assert_true(sums[0] > 0.0 && sums[0] != sums[1]);
    end(&f);
}

/* A crop of 40 x 24 pixels that begins within a tile: each value is the mean of its tile's. */
static void test_tiles_have_their_means(void **state) {
    (void)state;
    enum { X0 = 10, Y0 = 5, X1 = 50, Y1 = 29, COUNT = (X1 - X0) * (Y1 - Y0), TILE = 16 };
    const prepared box = prepare_file(CORNELL_BOX);
    aur_render_options options = image_of_size(64, 64);
    aur_replicas replicas;
    options.crop_x0 = X0;
    options.crop_y0 = Y0;
    options.crop_x1 = X1;
    options.crop_y1 = Y1;
    assert_int_equal(aur_replicas_create(box.renderer, &options, "path", 3, &replicas, NULL), AUR_OK);
    static double values[3 * COUNT], means[3 * COUNT];
    for (size_t i = 0; i < sizeof values / sizeof values[0]; ++i)
        means[i] = values[i] = (double)(i * i % 101); /* whole numbers: sums are exact */
    aur_replicas_average(&replicas, AUR_TILE_SIZE, means);
    for (size_t i = 0; i < sizeof values / sizeof values[0]; ++i) {
        const size_t replica = i / COUNT, x = X0 + i % COUNT % (X1 - X0), y = Y0 + i % COUNT / (X1 - X0);
        double sum = 0.0, count = 0.0;
        for (size_t j = Y0; j < Y1; ++j)
            for (size_t k = X0; k < X1; ++k)
                if (j / TILE == y / TILE && k / TILE == x / TILE) {
                    sum += values[replica * COUNT + (j - Y0) * (X1 - X0) + k - X0];
                    count += 1.0;
                }
        assert_true(means[i] == sum / count);
    }
    aur_replicas_release(&replicas);
    release(box);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_values_of_the_replica_do_not_count),
                                       cmocka_unit_test(test_tiles_have_their_means)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
