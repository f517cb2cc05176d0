/* The race for the integrator in synthetic rooms: one where path tracing needs least work, one where final
 * gathering does, and scenes with only one choice. */
#include "render/prepared.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/driver/renderer.h"
#include "render/film/film.h"
#include "render/race/race.h"

static const char head[] =
    "<scene version='3.0.0'><integrator type='path'><integer name='max_depth' value='8'/></integrator>"
    "<sensor type='perspective'><float name='fov' value='60'/><transform name='to_world'><lookat "
    "origin='0,-.95,0' target='0,1,-.2' up='0,0,1'/></transform><film type='hdrfilm'><integer name='width' "
    "value='64'/><integer name='height' value='48'/><rfilter type='box'/></film></sensor>";

/* A light source that illuminates the ceiling from below: all visible light is reflected twice. */
static const char indirect[] =
    "<shape type='cube'><bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' "
    "value='.7'/></bsdf>"
    "</bsdf></shape><shape type='rectangle'><transform name='to_world'><scale value='.1'/><translate z='.9'/>"
    "</transform><emitter type='area'><rgb name='radiance' value='50'/></emitter></shape></scene>";

/* A checkerboard finer than pixels under a uniform sky: the variance comes from the position of the camera
 * ray's hit. */
static const char direct[] =
    "<emitter type='constant'/><shape type='rectangle'><transform name='to_world'><scale "
    "value='20'/><translate "
    "z='-.3'/></transform><bsdf type='diffuse'><texture name='reflectance' type='checkerboard'><transform "
    "name='to_uv'><scale value='1500'/></transform></texture></bsdf></shape></scene>";

/* A glossy wall under a clear sky with its sun. */
static const char wall[] =
    "<emitter type='sunsky'/><shape type='rectangle'><transform name='to_world'><rotate x='1' angle='90'/>"
    "<scale value='2'/><translate y='1'/></transform><bsdf type='twosided'><bsdf type='roughplastic'><float "
    "name='alpha' value='.3'/></bsdf></bsdf></shape></scene>";

/* A large room, nearly all of whose mean is a light source in a thirtieth of the image. */
static const char seen[] =
    "<shape type='cube'><transform name='to_world'><scale value='4'/></transform><bsdf type='twosided'><bsdf "
    "type='diffuse'/></bsdf></shape><shape type='rectangle'><transform name='to_world'><scale value='.1'/>"
    "<rotate x='1' angle='90'/><translate y='.2' z='.2'/></transform><emitter type='area'><rgb "
    "name='radiance' value='50'/></emitter></shape></scene>";

static const char black[] = "<shape type='cube'/></scene>";
static const char sky[] = "<emitter type='constant'/></scene>";

typedef struct fixture {
    prepared room;
    aur_race race;
} fixture;

static prepared prepare_room(const char *body) {
    char text[4096];
    aur_scene *scene = NULL;
    snprintf(text, sizeof text, "%s%s", head, body);
    assert_int_equal(aur_scene_load_memory("room.xml", strlen(text), text, NULL, &scene, NULL), AUR_OK);
    return prepare(scene);
}

/* `request`: the target, its time and what pixels may share. */
static void run_request(const char *body, aur_race request, size_t width, size_t height, fixture *f) {
    static atomic_bool cancelled;
    static aur_render_options options;
    options = image_of_size(width, height);
    options.filter = "box";
    f->room = prepare_room(body);
    f->race = (aur_race){.renderer = f->room.renderer,
                         .options = &options,
                         .path = "path:max_depth=8",
                         .width = width,
                         .height = height,
                         .replica_count = 4,
                         .image_replicas = request.image_replicas > 0 ? request.image_replicas : 4,
                         .measure = request.measure,
                         .error = request.error,
                         .seconds = request.seconds,
                         .apart = request.apart,
                         .limits = request.limits,
                         .cancelled = &cancelled};
    assert_int_equal(aur_race_run(&f->race, NULL), AUR_OK);
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        print_message("%s: %.3g rays, %zu blocks, needs %.3g, %s\n", aur_race_rows[i].name,
                      f->race.entries[i].rays, f->race.entries[i].blocks, f->race.entries[i].need,
                      f->race.entries[i].reason);
}

static void run(const char *body, double error, size_t width, size_t height, fixture *f) {
    run_request(body, (aur_race){.error = error}, width, height, f);
}

static void end(fixture *f) {
    aur_race_release(&f->race);
    release(f->room);
}

/* For a target that small all candidates are tried; the winner is the same with other seeds, so it is not
 * decided by noise in the first blocks. */
static void test_gathers_win(void **state) {
    (void)state;
    fixture f;
    run(indirect, 0.002, 64, 48, &f);
    const aur_race *const race = &f.race;
    assert_true(race->order[0] != AUR_RACE_PATH);
    assert_true(race->entries[AUR_RACE_PATH].need > 2.0 * race->entries[race->order[0]].need);
    assert_true(race->entries[AUR_RACE_PATH].reason[0] != 0);
    end(&f);
}

static void test_paths_win(void **state) {
    (void)state;
    fixture f;
    run(direct, 0.002, 64, 48, &f);
    const aur_race *const race = &f.race;
    assert_int_equal(race->order[0], AUR_RACE_PATH);
    assert_true(race->entries[AUR_RACE_MIDDLE].need > 2.0 * race->entries[AUR_RACE_PATH].need);
    end(&f);
}

/* Paths with two points on lights each are tried where there are several lights or a sky. */
static void test_candidates(void **state) {
    (void)state;
    fixture f;
    run(wall, 0.002, 64, 48, &f);
    assert_true(f.race.entries[AUR_RACE_CANDIDATES].blocks > 0);
    assert_true(f.race.entries[AUR_RACE_CANDIDATES].need > 0.0);
    char *const text = aur_race_integrator(AUR_RACE_CANDIDATES, "path:max_depth=8", 0, 0);
    assert_string_equal(text, "path:max_depth=8,candidates=2");
    free(text);
    end(&f);
    run(indirect, 0.002, 64, 48, &f);
    assert_int_equal(f.race.entries[AUR_RACE_CANDIDATES].blocks, 0);
    end(&f);
}

/* A row without short rays has a bias at edges that others lack, which leaves less of a smaller target error
 * to its noise. */
static void test_bias(void **state) {
    (void)state;
    static const double errors[] = {0.04, 0.02};
    double over[2];
    for (size_t i = 0; i < 2; ++i) {
        fixture f;
        run(indirect, errors[i], 64, 48, &f);
        const aur_race_entry *const row = &f.race.entries[AUR_RACE_LONG];
        const aur_race_entry *const middle = &f.race.entries[AUR_RACE_MIDDLE];
        assert_true(row->bias > 0.0 && middle->bias == 0.0);
        over[i] = row->need / middle->need;
        end(&f);
    }
    assert_true(over[1] > 1.1 * over[0]);
}

/* Where the first blocks may cost nothing, only the middle row is rendered. */
static void test_no_race(void **state) {
    (void)state;
    fixture f;
    static const aur_race_limits none = {9, 0.0, 0.0, 0.95};
    run_request(indirect, (aur_race){.error = 0.01, .limits = &none}, 64, 48, &f);
    assert_int_equal(f.race.order[0], AUR_RACE_MIDDLE);
    assert_non_null(strstr(f.race.entries[AUR_RACE_LIGHTS].reason, "not tried"));
    assert_true(f.race.entries[AUR_RACE_LIGHTS].blocks == 0);
    end(&f);
}

/* By a time limit, a pattern in each pixel of a large image takes too long; a small image has hours for more
 * photons than the least. */
static void test_time(void **state) {
    (void)state;
    fixture f;
    run_request(indirect, (aur_race){.seconds = 0.31}, 1024, 768, &f);
    assert_int_equal(f.race.order[0], AUR_RACE_PATH);
    assert_non_null(strstr(f.race.entries[AUR_RACE_MIDDLE].reason, "longer than requested"));
    end(&f);
    run_request(indirect, (aur_race){.seconds = 36000.0}, 64, 48, &f);
    assert_true(f.race.order[0] != AUR_RACE_PATH);
    assert_true(aur_race_photons(f.race.work, 4) > aur_race_photons(0.0, 4));
    end(&f);
}

/* The smallest pattern is tried where one sample per pixel and replica reaches the target, and only there. */
static void test_coarse(void **state) {
    (void)state;
    fixture f;
    run(indirect, 0.6, 96, 96, &f);
    assert_true(f.race.entries[AUR_RACE_FOUR].blocks > 0);
    assert_true(f.race.entries[AUR_RACE_FOUR].need < f.race.entries[AUR_RACE_SHARED].need);
    end(&f);
    run(indirect, 0.02, 96, 96, &f);
    assert_true(f.race.entries[AUR_RACE_SHARED].blocks > 0 && f.race.entries[AUR_RACE_FOUR].blocks == 0);
    end(&f);
}

/* Pixels whose image is denoised share no directions. */
static void test_apart(void **state) {
    (void)state;
    fixture f;
    run_request(indirect, (aur_race){.error = 0.002, .apart = true}, 64, 48, &f);
    assert_int_equal(f.race.entries[AUR_RACE_SHARED].blocks, 0);
    end(&f);
    run(indirect, 0.002, 64, 48, &f);
    assert_true(f.race.entries[AUR_RACE_SHARED].blocks > 0);
    end(&f);
}

/* What the camera sees of emitters is part of the image's mean, whether the first blocks have any of it or
 * not: twelve blocks predict what gathering needs within a factor of three of all 192. By their own mean they
 * would be wrong by the square of the ratio of the means. */
static void test_seen_emitters(void **state) {
    (void)state;
    static const aur_race_limits limits[] = {
        {.first_blocks = 12, .first_part = 1.0, .part = 0.0, .confidence = 0.95},
        {.first_blocks = 192, .first_part = 1.0, .part = 0.0, .confidence = 0.95}};
    double needs[2];
    for (size_t k = 0; k < 2; ++k) {
        fixture f;
        run_request(seen, (aur_race){.error = 0.002, .measure = AUR_ERROR_MEASURE_MEAN, .limits = &limits[k]},
                    64, 48, &f);
        aur_render_options options = image_of_size(64, 48);
        options.filter = "box";
        options.integrator = "path:max_depth=1";
        options.samples_per_pixel = 64;
        aur_image *image;
        double mean = 0.0;
        assert_int_equal(aur_renderer_render(f.room.renderer, &options, &image, NULL, NULL), AUR_OK);
        for (size_t i = 0; i < 64 * 48 * 3; ++i)
            mean += (double)aur_image_data(image)[i] / (64 * 48);
        aur_image_destroy(image);
        assert_near(f.race.emitted, mean, 0.1 * mean); /* by pixels' centres */
        needs[k] = f.race.entries[AUR_RACE_MIDDLE].need;
        end(&f);
    }
    assert_true(needs[0] < 3.0 * needs[1] && needs[1] < 3.0 * needs[0]);
}

/* Nothing to see, nothing that scatters, one pixel. */
static void test_no_choice(void **state) {
    (void)state;
    fixture f;
    run(black, 0.01, 64, 48, &f);
    assert_true(f.race.order_count == 1 && f.race.order[0] == AUR_RACE_PATH);
    end(&f);
    run(sky, 0.01, 64, 48, &f);
    assert_int_equal(f.race.order[0], AUR_RACE_PATH); /* without any noise */
    end(&f);
    run(indirect, 0.01, 1, 1, &f);
    assert_true(f.race.order_count >= 1 && f.race.entries[AUR_RACE_MIDDLE].blocks == 1);
    end(&f);
}

/* Candidates share pixels by blocks of 4 x 4 alone, so that a small image to a coarse error has a race. */
static void test_small_race(void **state) {
    (void)state;
    fixture f;
    run(indirect, 0.3, 96, 96, &f);
    double rays = 0.0;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        rays += f.race.entries[i].rays;
    assert_true(f.race.entries[AUR_RACE_SHARED].blocks > 0 && f.race.entries[AUR_RACE_PATH].blocks > 0);
    assert_true(rays < 0.2 * f.race.entries[f.race.order[0]].need);
    assert_true(f.race.entries[AUR_RACE_SHARED].rays < 2.0 * f.race.entries[AUR_RACE_MIDDLE].rays);
    end(&f);
}

/* Neighbours that share render some pixels of a tile alone, with the values of whole tiles where the pixels
 * around are rendered too. */
static void test_shared_block(void **state) {
    (void)state;
    enum { WIDTH = 64, HEIGHT = 48, X0 = 7, Y0 = 9, SIDE = 6 };
    const prepared room = prepare_room(indirect);
    aur_render_options options = image_of_size(WIDTH, HEIGHT);
    options.filter = "box";
    options.samples_per_pixel = AUR_SAMPLES_PER_PIXEL_MAX;
    options.integrator = "finalgather:split=1,diffuse_samples=8,photons=5000,edges=0,share=near";
    static uint32_t targets[2][WIDTH * HEIGHT];
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i) {
        const size_t x = i % WIDTH, y = i / WIDTH;
        targets[0][i] = 2;
        targets[1][i] = x >= X0 && x < X0 + SIDE && y >= Y0 && y < Y0 + SIDE ? 2 : 0;
    }
    aur_render *renders[2];
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(aur_render_create(room.renderer, &options, &renders[k], NULL), AUR_OK);
        assert_int_equal(aur_render_step_pixels(renders[k], WIDTH * HEIGHT, targets[k], NULL), AUR_OK);
    }
    const aur_film *const whole = aur_render_film(renders[0]), *const block = aur_render_film(renders[1]);
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i) {
        const size_t x = i % WIDTH, y = i / WIDTH;
        assert_int_equal(block->given[i], targets[1][i]);
        if (x > X0 && x + 1 < X0 + SIDE && y > Y0 && y + 1 < Y0 + SIDE)
            for (size_t c = 0; c < 3; ++c)
                assert_true(aur_film_mean(block, i, c) == aur_film_mean(whole, i, c));
    }
    assert_true(aur_film_counted(block).rays * 20 < aur_film_counted(whole).rays);
    aur_render_destroy(renders[0]);
    aur_render_destroy(renders[1]);
    release(room);
}

/* A candidate that takes far more than was predicted is overtaken by path tracing, whose prediction misses
 * less of the same, before gathers that need less by prediction; and by none if less is left. */
static void wrong_predictions_are_shared(void **state) {
    (void)state;
    aur_race race = {.order = {AUR_RACE_MIDDLE, AUR_RACE_SHARED, AUR_RACE_PATH}, .order_count = 3};
    race.entries[AUR_RACE_MIDDLE].need = 1.0;
    race.entries[AUR_RACE_SHARED].need = 1.1;
    race.entries[AUR_RACE_PATH].need = 2.0;
    assert_false(aur_race_overtake(&race, 0, 1.0, 9.0, 1.0));
    assert_false(aur_race_overtake(&race, 0, 1.0, 1.0, 9.0));
    assert_true(aur_race_overtake(&race, 0, 1.0, 9.0, 1.2));
    assert_int_equal(race.order[1], AUR_RACE_SHARED);
    assert_false(aur_race_overtake(&race, 0, 100.0, 9.0, 20.0));
    assert_true(aur_race_overtake(&race, 0, 100.0, 9.0, 90.0));
    assert_int_equal(race.order[0], AUR_RACE_MIDDLE);
    assert_int_equal(race.order[1], AUR_RACE_PATH);
    assert_int_equal(race.order[2], AUR_RACE_SHARED);
    assert_false(aur_race_overtake(&race, 2, 1.0, 9.0, 90.0));
    /* A gather behind path tracing that is rejected, too, is not taken again. */
    assert_int_equal(aur_race_next(&race, 1), 2);
    assert_int_equal(race.order[2], AUR_RACE_SHARED);
    assert_int_equal(aur_race_next(&race, 2), 2);
    assert_int_equal(race.order[2], AUR_RACE_PATH);
    assert_int_equal(race.order[1], AUR_RACE_SHARED);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gathers_win),
                                       cmocka_unit_test(test_paths_win),
                                       cmocka_unit_test(test_candidates),
                                       cmocka_unit_test(test_bias),
                                       cmocka_unit_test(test_no_race),
                                       cmocka_unit_test(test_no_choice),
                                       cmocka_unit_test(test_small_race),
                                       cmocka_unit_test(test_shared_block),
                                       cmocka_unit_test(test_coarse),
                                       cmocka_unit_test(test_time),
                                       cmocka_unit_test(test_apart),
                                       cmocka_unit_test(test_seen_emitters),
                                       cmocka_unit_test(wrong_predictions_are_shared)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
