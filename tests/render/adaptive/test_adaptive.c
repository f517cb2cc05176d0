/* Rendering to a target error: stopping criteria, independence of threads, and correct error reports. */
#include "render/prepared.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static int set_up(void **state) {
    static prepared box;
    box = prepare_file(CORNELL_BOX);
    *state = &box;
    return 0;
}

static int tear_down(void **state) {
    release(*(const prepared *)*state);
    return 0;
}

static aur_render_options small(size_t threads) {
    aur_render_options options = image_of_size(40, 24);
    options.sampler = NULL;
    options.threads = threads;
    return options;
}

static aur_adaptive *adaptive(const prepared *f, const aur_render_options *render,
                              const aur_adaptive_options *target) {
    aur_adaptive *created = NULL;
    assert_int_equal(aur_adaptive_create(f->renderer, render, target, &created, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(created, NULL), AUR_OK);
    return created;
}

/* By a renderer that has nothing prepared. */
static aur_adaptive *create_fresh(prepared *fresh, const prepared *f, const aur_render_options *render,
                                  const aur_adaptive_options *target) {
    fresh->scene = f->scene;
    assert_int_equal(aur_renderer_create(f->scene, &fresh->renderer, NULL), AUR_OK);
    return adaptive(fresh, render, target);
}

static aur_adaptive_report report_of(aur_adaptive *rendering) {
    aur_adaptive_report report = {.size = sizeof report};
    assert_int_equal(aur_adaptive_get_report(rendering, &report, NULL), AUR_OK);
    return report;
}

static aur_image *image_of(const aur_adaptive *rendering) {
    aur_image *image = NULL;
    assert_int_equal(aur_adaptive_develop(rendering, true, &image, NULL), AUR_OK);
    return image;
}

static void assert_same_image(const aur_adaptive *a, const aur_adaptive *b) {
    aur_image *const x = image_of(a), *const y = image_of(b);
    assert_int_equal(aur_image_channel_count(x), 6);
    assert_memory_equal(aur_image_data(x), aur_image_data(y),
                        aur_image_width(x) * aur_image_height(x) * 6 * sizeof(float));
    aur_image_destroy(x);
    aur_image_destroy(y);
}

/* The upper end of the interval is below the target, and one thread gives the bits of three. */
static void test_error(void **state) {
    const prepared *const f = *state;
    aur_adaptive_options target = target_of(0.2, AUR_ERROR_MEASURE_RELATIVE);
    aur_render_options one = small(1), three = small(3);
    one.integrator = three.integrator = "path";
    aur_adaptive *const a = adaptive(f, &one, &target), *const b = adaptive(f, &three, &target);
    const aur_adaptive_report report = report_of(a);
    assert_true(report.error_low < report.error && report.error < report.error_high);
    assert_true(report.error_high <= 0.2);
    assert_true(report.rounds > 1 && report.degrees >= 1.0);
    assert_true(report.statistics.samples == (uint64_t)(report.samples_per_pixel * 40 * 24 + 0.5));
    assert_same_image(a, b);
    assert_string_equal(aur_adaptive_integrator(a), "path");
    assert_true(report.bias_high == 0.0);
    aur_adaptive_destroy(a);
    aur_adaptive_destroy(b);
}

/* One round has the same samples whichever measure is asked for, and the same errors by all of them: up to
 * the rounding of what only the one asked for pools. */
static void test_all_measures(void **state) {
    const prepared *const f = *state;
    aur_adaptive_options target = target_of(0.0, AUR_ERROR_MEASURE_RELATIVE);
    target.rounds = 1;
    aur_render_options options = small(1);
    options.integrator = "path";
    aur_adaptive_report reports[AUR_ERROR_MEASURE_COUNT];
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        target.measure = (aur_error_measure)m;
        aur_adaptive *const a = adaptive(f, &options, &target);
        reports[m] = report_of(a);
        aur_adaptive_destroy(a);
    }
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m)
        for (size_t k = 0; k < AUR_ERROR_MEASURE_COUNT; ++k) {
            const aur_error_figures asked = reports[m].errors[m], other = reports[k].errors[m];
            assert_true(asked.error == other.error && asked.error > 0.0);
            assert_near(other.low, asked.low, 1e-9 * asked.error);
            assert_near(other.high, asked.high, 1e-9 * asked.error);
        }
}

/* The reported processor time is the whole process's, except for a few calls. */
static void test_processor_time(void **state) {
    const prepared *const f = *state;
    aur_adaptive_options target = target_of(0.0, AUR_ERROR_MEASURE_RELATIVE);
    target.rounds = 12;
    target.measure = AUR_ERROR_MEASURE_DISPLAY; /* the one that takes longest */
    aur_render_options options = small(1);
    options.integrator = "depth"; /* the samples take less time than the statistics */
    const clock_t before = clock();
    aur_adaptive *const a = adaptive(f, &options, &target);
    const double seconds = (double)(clock() - before) / CLOCKS_PER_SEC;
    const double reported = report_of(a).statistics.cpu_seconds;
    print_message("%g of %g seconds reported\n", reported, seconds);
    assert_true(reported > 0.95 * seconds && reported < 1.05 * seconds);
    aur_adaptive_destroy(a);
}

static double square_distance(const aur_adaptive *a, const aur_adaptive *b) {
    aur_image *const x = image_of(a), *const y = image_of(b);
    const size_t pixels = aur_image_width(x) * aur_image_height(x);
    double sum = 0.0;
    for (size_t i = 0; i < 6 * pixels; ++i)
        if (i % 6 < 3) {
            const double difference = (double)aur_image_data(x)[i] - (double)aur_image_data(y)[i];
            sum += difference * difference / (double)(3 * pixels);
        }
    aur_image_destroy(x);
    aur_image_destroy(y);
    return sum;
}

/* Without a named integrator, final gathering is selected in this box. Its image differs from path tracing's
 * within the two intervals. Naming it with its bias gives the same bits. */
static void test_choice(void **state) {
    const prepared *const f = *state;
    aur_adaptive_options target = target_of(0.02, AUR_ERROR_MEASURE_MEAN);
    aur_render_options chosen = small(1), named = small(3), paths = small(0);
    chosen.width = named.width = paths.width = 96;
    chosen.height = named.height = paths.height = 72;
    chosen.filter = named.filter = paths.filter = "box"; /* by the wider one paths are as good here */
    chosen.seed = named.seed = 6;
    paths.integrator = "path";
    paths.seed = 7;
    prepared first, second;
    aur_adaptive *const a = create_fresh(&first, f, &chosen, &target);
    aur_adaptive_options again = target;
    again.bias = report_of(a).bias_room;
    named.integrator = aur_adaptive_integrator(a);
    aur_adaptive *const b = create_fresh(&second, f, &named, &again);
    aur_adaptive *const reference = adaptive(f, &paths, &target);
    const aur_adaptive_report report = report_of(a), about_reference = report_of(reference);
    assert_same_image(a, b);
    assert_non_null(strstr(aur_adaptive_integrator(a), "finalgather:"));
    assert_non_null(strstr(aur_adaptive_integrator(a), ",max_depth=-1"));
    /* At least a sixteenth of the square of the error is left to the bias. */
    assert_true(report.bias_room >= 0.25 * target.error && report.bias_room < target.error);
    assert_true(report.bias_high > 0.0 && report.error_high <= target.error);
    /* By every measure the noise is the same, and what bounds the bias is added. */
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        const double high = report_of(b).errors[m].high, noise = high * high - again.bias * again.bias;
        assert_true(report.errors[m].error >= report_of(b).errors[m].error);
        assert_true(report.errors[m].high * report.errors[m].high > noise * (1.0 + 1e-9));
    }
    size_t taken = 0;
    for (size_t i = 0; i < report.race_count; ++i) {
        aur_adaptive_candidate one = {.size = sizeof one};
        assert_int_equal(aur_adaptive_get_candidate(a, i, &one, NULL), AUR_OK);
        assert_true(one.name[0] != '\0' && one.reason[0] != '\0');
        taken += one.taken;
    }
    assert_true(report.race_count > 2 && taken == 1);
    assert_true(report.candidate_rays > 0 && report_of(b).candidate_rays == 0);
    assert_true(report.statistics.rays == report_of(b).statistics.rays + report.candidate_rays);
    assert_true(square_distance(a, reference) <= (report.error_high * report.error_high +
                                                  about_reference.error_high * about_reference.error_high) *
                                                     report.mean * report.mean);
    aur_adaptive_destroy(a);
    aur_adaptive_destroy(b);
    aur_adaptive_destroy(reference);
    aur_renderer_destroy(first.renderer);
    aur_renderer_destroy(second.renderer);
}

/* Shares passed to the progress callback, and the rays at that time. */
typedef struct progress_record {
    aur_adaptive *adaptive;
    size_t count, unknown; /* reports with a share, and without */
    double shares[4096], rays[4096];
} progress_record;

static int record_progress(void *user, const char *what, uint64_t done, uint64_t total) {
    progress_record *const record = user;
    if (record->adaptive == NULL) /* it is being prepared */
        return 0;
    assert_true(total == 0 || strcmp(what, "rendering") == 0 || strcmp(what, "planning") == 0);
    assert_true(total == 0 ? done == 0 : done < total); /* the work is not over */
    record->unknown += total == 0;
    if (total == 0 || record->count == 4096)
        return 0;
    record->shares[record->count] = (double)done / (double)total;
    assert_true(record->count == 0 || record->shares[record->count] >= record->shares[record->count - 1]);
    record->rays[record->count++] = (double)report_of(record->adaptive).statistics.rays;
    return 0;
}

/* Renders, and compares the remaining rays predicted by the rate since the first share with the actual ones,
 * until a fifth of them is left; returns the largest ratio. */
static double largest_factor(const prepared *f, const char *integrator, uint64_t seed, size_t side,
                             const aur_adaptive_options *target, progress_record *record) {
    aur_render_options options = small(1);
    options.width = options.height = side;
    options.integrator = integrator;
    options.seed = seed;
    *record = (progress_record){.count = 0};
    options.progress = (aur_progress){record_progress, record};
    prepared fresh = {.scene = f->scene}; /* a renderer that has no photon maps */
    assert_int_equal(aur_renderer_create(f->scene, &fresh.renderer, NULL), AUR_OK);
    aur_adaptive *created = NULL;
    assert_int_equal(aur_adaptive_create(fresh.renderer, &options, target, &created, NULL), AUR_OK);
    record->adaptive = created;
    assert_int_equal(aur_adaptive_run(created, NULL), AUR_OK);
    const double all = (double)report_of(created).statistics.rays;
    double largest = 1.0;
    for (size_t i = 1; i < record->count; ++i) {
        const double since = record->rays[i] - record->rays[0], left = all - record->rays[i];
        const double rise = record->shares[i] - record->shares[0];
        if (since < 0.05 * (since + left) || left < 0.2 * (since + left))
            continue;
        const double estimate = (1.0 - record->shares[i]) * since / rise;
        largest = fmax(largest, fmax(estimate / left, left / estimate));
    }
    print_message("%s, seed %llu: %zu shares of %zu reports, from %.2f of the rays on, off by up to %.2f\n",
                  aur_adaptive_integrator(created), (unsigned long long)seed, record->count,
                  record->count + record->unknown, record->count > 0 ? record->rays[0] / all : 1.0, largest);
    aur_adaptive_destroy(created);
    aur_renderer_destroy(fresh.renderer);
    return largest;
}

/* A share is reported only if it is known to a factor of two: no number is better than a wrong one. */
static void test_progress(void **state) {
    const prepared *const f = *state;
    static progress_record record;
    aur_adaptive_options target = target_of(0.06, AUR_ERROR_MEASURE_MEAN);
    for (uint64_t seed = 0; seed < 6; ++seed) {
        assert_true(largest_factor(f, "path", seed, 32, &target, &record) < 2.0);
        assert_true(record.count > 10);
    }
    target.error = 0.0;
    target.rounds = 4;
    assert_true(largest_factor(f, "path", 1, 32, &target, &record) < 2.0 && record.count > 10);
    target.rounds = 0;
    target.rays = 600000;
    assert_true(largest_factor(f, "path", 1, 32, &target, &record) < 2.0 && record.count > 10);
}

/* Rounds that a clock would have stopped are repeated without one. */
static void test_rounds_and_rays(void **state) {
    const prepared *const f = *state;
    aur_render_options options = small(0);
    options.integrator = "path:max_depth=-1";
    aur_adaptive_options rounds = {.size = sizeof rounds}, seconds = rounds, rays = rounds;
    seconds.seconds = 0.05;
    aur_adaptive *const by_clock = adaptive(f, &options, &seconds);
    rounds.rounds = report_of(by_clock).rounds;
    aur_adaptive *const by_rounds = adaptive(f, &options, &rounds);
    assert_same_image(by_clock, by_rounds);
    rays.rays = 400000;
    aur_adaptive *const by_rays = adaptive(f, &options, &rays);
    const uint64_t traced = report_of(by_rays).statistics.rays;
    assert_in_range(traced, 400000, 600000); /* a round adds at most a half */
    assert_string_equal(aur_adaptive_integrator(by_rays), "path:max_depth=-1"); /* the scene's default */
    aur_adaptive_destroy(by_clock);
    aur_adaptive_destroy(by_rounds);
    aur_adaptive_destroy(by_rays);
}

/* For the same rays final gathering is selected and given the size: path tracing then has an error of 3.2 %,
 * final gathering at most 2 % with its bias. */
static void test_rays_make_the_pattern(void **state) {
    const prepared *const f = *state;
    aur_render_options chosen = small(0), paths = small(0);
    chosen.width = chosen.height = paths.width = paths.height = 96;
    chosen.filter = paths.filter = "box";
    paths.integrator = "path";
    aur_adaptive_options target = target_of(0.0, AUR_ERROR_MEASURE_MEAN);
    target.rays = 8000000;
    prepared fresh, other;
    aur_adaptive *const a = create_fresh(&fresh, f, &chosen, &target), *const b =
                                                                           adaptive(f, &paths, &target);
    const aur_adaptive_report of_pattern = report_of(a), path = report_of(b);
    print_message("%g to %g by %s; path: %g to %g\n", of_pattern.error_low, of_pattern.error_high,
                  aur_adaptive_integrator(a), path.error_low, path.error_high);
    assert_non_null(strstr(aur_adaptive_integrator(a), "finalgather:"));
    assert_true(of_pattern.error_high < path.error_low);
    /* A twentieth is reserved for corrections, which may use less. */
    assert_in_range(of_pattern.statistics.rays, target.rays * 19 / 20, target.rays * 3 / 2);
    /* Maps that are there already change no decision, and are not traced. */
    aur_adaptive *const again = adaptive(&fresh, &chosen, &target);
    assert_same_image(a, again);
    assert_true(report_of(again).candidate_rays == of_pattern.candidate_rays);
    assert_true(report_of(again).statistics.rays < of_pattern.statistics.rays);
    aur_render_options named = chosen;
    named.integrator = aur_adaptive_integrator(a);
    target.rays -= of_pattern.candidate_rays;
    aur_adaptive *const alone = create_fresh(&other, f, &named, &target);
    assert_same_image(a, alone);
    /* A twentieth is reserved for corrections of the bias. */
    assert_true(fabs((double)report_of(alone).statistics.rays + (double)of_pattern.candidate_rays -
                     (double)of_pattern.statistics.rays) <
                0.05 * (double)(target.rays + of_pattern.candidate_rays));
    aur_adaptive *const rendering[] = {a, b, again, alone};
    for (size_t i = 0; i < sizeof rendering / sizeof rendering[0]; ++i)
        aur_adaptive_destroy(rendering[i]);
    aur_renderer_destroy(fresh.renderer);
    aur_renderer_destroy(other.renderer);
}

static int stop_at_once(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    size_t *const calls = user;
    ++*calls;
    return *calls < 1000 && done > total / 2;
}

/* A cancelled render keeps its samples, and resuming it gives the bits of an uninterrupted run. */
static void test_cancelled_image_is_preserved(void **state) {
    const prepared *const f = *state;
    aur_render_options options = small(1);
    options.integrator = "path";
    size_t calls = 0;
    options.progress = (aur_progress){stop_at_once, &calls};
    aur_adaptive_options target = target_of(0.1, AUR_ERROR_MEASURE_MEAN);
    aur_adaptive *rendering = NULL;
    aur_error error = {0};
    assert_int_equal(aur_adaptive_create(f->renderer, &options, &target, &rendering, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(rendering, &error), AUR_ERROR_CANCELLED);
    assert_true(calls > 0);
    aur_image *const image = image_of(rendering);
    double sum = 0.0;
    for (size_t i = 0; i < aur_image_width(image) * aur_image_height(image) * 6; ++i)
        sum += (double)aur_image_data(image)[i];
    assert_true(sum > 0.0);
    aur_image_destroy(image);
    calls = 1000; /* from here on nothing is stopped */
    assert_int_equal(aur_adaptive_run(rendering, NULL), AUR_OK);
    aur_render_options plain = small(3);
    plain.integrator = "path";
    aur_adaptive *const whole = adaptive(f, &plain, &target);
    assert_same_image(rendering, whole);
    assert_true(report_of(rendering).error == report_of(whole).error);
    aur_adaptive_destroy(whole);
    aur_adaptive_destroy(rendering);
}

/* Stops in a round after the bias was bounded. */
static int stop_with_bias(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    (void)done;
    (void)total;
    aur_adaptive *const *const rendering = user;
    return *rendering != NULL && report_of(*rendering).bias_high > 0.0;
}

static void assert_same_candidates(const aur_adaptive *a, const aur_adaptive *b, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        aur_adaptive_candidate one = {.size = sizeof one}, other = one;
        assert_int_equal(aur_adaptive_get_candidate(a, i, &one, NULL), AUR_OK);
        assert_int_equal(aur_adaptive_get_candidate(b, i, &other, NULL), AUR_OK);
        assert_string_equal(one.reason, other.reason);
        assert_true(one.taken == other.taken && one.pixels == other.pixels && one.rays == other.rays &&
                    one.need == other.need);
    }
}

/* Before its first round a resumed image reports what the saved one did: errors, bias, the race. */
static void test_resumed_report(void **state) {
    const prepared *const f = *state;
    aur_adaptive *saved = NULL, *resumed = NULL, *stopped = NULL;
    aur_render_options options = small(2);
    options.width = 96;
    options.height = 72;
    options.filter = "box";
    options.resumable = true;
    options.progress = (aur_progress){stop_with_bias, &stopped};
    aur_adaptive_options target = target_of(0.01, AUR_ERROR_MEASURE_MEAN);
    assert_int_equal(aur_adaptive_create(f->renderer, &options, &target, &saved, NULL), AUR_OK);
    stopped = saved;
    assert_int_equal(aur_adaptive_run(saved, NULL), AUR_ERROR_CANCELLED);
    assert_int_equal(aur_adaptive_save(saved, "resumed_report.part", NULL), AUR_OK);
    aur_adaptive_report before = report_of(saved);
    stopped = NULL;
    assert_int_equal(aur_adaptive_create(f->renderer, &options, &target, &resumed, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_resume(resumed, "resumed_report.part", NULL), AUR_OK);
    aur_adaptive_report after = report_of(resumed);
    assert_true(before.race_count > 0 && before.bias_high > 0.0 && before.error_high < 1.0);
    after.statistics = before.statistics; /* times, and maps that were created again */
    assert_memory_equal(&before, &after, sizeof before);
    assert_same_candidates(saved, resumed, before.race_count);
    assert_int_equal(aur_adaptive_run(saved, NULL), AUR_OK);
    assert_int_equal(aur_adaptive_run(resumed, NULL), AUR_OK);
    before = report_of(saved);
    after = report_of(resumed);
    after.statistics = before.statistics;
    assert_memory_equal(&before, &after, sizeof before);
    assert_same_candidates(saved, resumed, before.race_count);
    assert_same_image(saved, resumed);
    remove("resumed_report.part");
    aur_adaptive_destroy(saved);
    aur_adaptive_destroy(resumed);
}

/* A single replica is the image of the same seed with as many samples in every pixel, also after an
 * interruption. */
static void test_single(void **state) {
    const prepared *const f = *state;
    aur_render_options options = small(2);
    options.integrator = "path:lamp_rays=0";
    options.sampler = "sobol";
    options.filter = "box";
    options.seed = 7;
    aur_render *render = NULL;
    aur_image *whole = NULL;
    aur_adaptive *parts[2] = {NULL, NULL};
    for (size_t k = 0; k < 2; ++k) {
        aur_adaptive_options target = {.size = sizeof target};
        aur_adaptive_options_init(&target, NULL);
        target.replicas = 1;
        target.rounds = 4;
        options.resumable = true;
        assert_int_equal(aur_adaptive_create(f->renderer, &options, &target, &parts[k], NULL), AUR_OK);
        if (k == 1)
            assert_int_equal(aur_adaptive_resume(parts[k], "single.part", NULL), AUR_OK);
        assert_int_equal(aur_adaptive_run(parts[k], NULL), AUR_OK);
        assert_int_equal(aur_adaptive_save(parts[k], "single.part", NULL), AUR_OK);
        const aur_adaptive_report report = report_of(parts[k]);
        assert_true(isinf(report.error) && isinf(report.error_high) && report.mean > 0.0);
        assert_true(report.samples_per_pixel > 4.0 && report.replicas == 1);
        options.resumable = false;
        options.samples_per_pixel = (size_t)report.samples_per_pixel;
        aur_image *const image = image_of(parts[k]);
        assert_int_equal(aur_image_channel_count(image), 3);
        if (k == 0) {
            assert_int_equal(aur_render_create(f->renderer, &options, &render, NULL), AUR_OK);
            assert_int_equal(aur_render_step(render, options.samples_per_pixel, NULL), AUR_OK);
            assert_int_equal(aur_film_develop(aur_render_film(render), &whole, NULL), AUR_OK);
        }
        options.samples_per_pixel = 0;
        assert_memory_equal(aur_image_data(image), aur_image_data(whole), 40 * 24 * 3 * sizeof(float));
        aur_image_destroy(image);
    }
    remove("single.part");
    aur_image_destroy(whole);
    aur_render_destroy(render);
    aur_adaptive_destroy(parts[0]);
    aur_adaptive_destroy(parts[1]);
}

static void test_bad_wishes(void **state) {
    const prepared *const f = *state;
    static const aur_adaptive_options bad[] = {
        {.size = sizeof bad[0], .error = -0.1},
        {.size = sizeof bad[0], .error = 1.5},
        {.size = sizeof bad[0], .error = 1e-9},
        {.size = sizeof bad[0], .error = 0.1, .measure = (aur_error_measure)9},
        {.size = sizeof bad[0], .seconds = -1.0},
        {.size = sizeof bad[0], .confidence = 1.0},
        {.size = sizeof bad[0], .error = 0.1, .bias = 0.05}, /* nobody names the integrator */
        {.size = sizeof bad[0], .error = 0.1, .bias = 0.1},
        {.size = sizeof bad[0], .replicas = 2},
        {.size = sizeof bad[0], .error = 0.1, .replicas = 1},
        {.size = sizeof bad[0], .replicas = 1}, /* to the default target error */
        {.size = sizeof bad[0], .replicas = 17},
        {.size = 0},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        aur_adaptive *rendering = NULL;
        aur_error error = {0};
        assert_int_equal(aur_adaptive_create(f->renderer, NULL, &bad[i], &rendering, &error),
                         AUR_ERROR_ARGUMENT);
        assert_null(rendering);
        assert_true(error.message[0] != '\0');
    }
    aur_render_options options = small(1);
    options.integrator = "finalgahter";
    aur_adaptive *rendering = NULL;
    assert_int_equal(aur_adaptive_create(f->renderer, &options, NULL, &rendering, NULL), AUR_ERROR_NAME);
    assert_null(rendering);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_error),
                                       cmocka_unit_test(test_all_measures),
                                       cmocka_unit_test(test_processor_time),
                                       cmocka_unit_test(test_choice),
                                       cmocka_unit_test(test_progress),
                                       cmocka_unit_test(test_rounds_and_rays),
                                       cmocka_unit_test(test_rays_make_the_pattern),
                                       cmocka_unit_test(test_cancelled_image_is_preserved),
                                       cmocka_unit_test(test_resumed_report),
                                       cmocka_unit_test(test_single),
                                       cmocka_unit_test(test_bad_wishes)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
