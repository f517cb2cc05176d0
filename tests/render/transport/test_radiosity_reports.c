/* Rejected input and reports of radiosity. */
#include "points/base/random.h"
#include "radiosity_room.h"
#include "render/radiosity/scene.h"
#include "render/radiosity/solution.h"

/* --- bad input */

static void expect_refused(const char *body, const aur_radiosity_options *options, aur_result expected,
                           const char *message) {
    aur_scene *const scene = must_load_body(body);
    aur_radiosity *radiosity = NULL;
    aur_error error = {0};
    const aur_result result = aur_radiosity_create(scene, options, &radiosity, &error);
    if (result != expected || strstr(error.message, message) == NULL)
        fail_msg("%d: '%s' does not say '%s'", result, error.message, message);
    assert_null(radiosity);
    aur_scene_destroy(scene);
}

static void scenes_without_an_answer_are_refused(void **state) {
    (void)state;
    expect_refused("<shape type='cube'/>", NULL, AUR_ERROR_UNSUPPORTED, "no light");
    expect_refused("<emitter type='constant'/><shape type='cube'/>", NULL, AUR_ERROR_UNSUPPORTED,
                   "emitter 'constant' is not a surface");
    expect_refused(
        "<shape type='cube'><emitter type='area'><rgb name='radiance' value='0'/></emitter></shape>", NULL,
        AUR_ERROR_UNSUPPORTED, "emit no radiance");
    expect_refused(ROOM "<shape type='sphere'/>", NULL, AUR_ERROR_UNSUPPORTED,
                   "'sphere' is not a mesh of triangles");
    /* Radiance that is no number is refused before, by the loader. */
    aur_scene *scene = NULL;
    aur_error error = {0};
    assert_int_equal(
        load_body("<shape type='cube'><emitter type='area'><rgb name='radiance' value='nan'/></emitter>"
                  "</shape>",
                  NULL, &scene, &error),
        AUR_ERROR_FORMAT);
    assert_int_equal(error.line, 2);
    assert_non_null(strstr(error.message, "radiance"));
    write_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    expect_refused(
        "<shape type='obj'><string name='filename' value='flat.obj'/><emitter type='area'/></shape>", NULL,
        AUR_ERROR_UNSUPPORTED, "no light");
}

static void options_out_of_range_are_refused(void **state) {
    (void)state;
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 0);
    expect_refused(ROOM, &options, AUR_ERROR_ARGUMENT, "bounces must be between 1 and 10000, not 0");
    options.bounces = 10001;
    expect_refused(ROOM, &options, AUR_ERROR_ARGUMENT, "bounces must be between 1 and 10000, not 10001");
    options = options_of(AUR_RADIOSITY_COSINE, 6);
    options.randomizations = 0;
    expect_refused(ROOM, &options, AUR_ERROR_ARGUMENT, "randomizations must be between");
    aur_scene *const scene = must_load_body(ROOM);
    static const struct {
        const char *sequence;
        size_t bounces, randomizations;
        uint64_t paths;
        aur_result result;
        const char *message;
    } cases[] = {
        {"sobol", 6, 1, 0, AUR_ERROR_ARGUMENT, "paths must be at least 1"},
        {"jittered", 6, 1, 100, AUR_ERROR_ARGUMENT, "has 2 dimensions, not 16"},
        {"faure", 3000, 1, 100, AUR_ERROR_ARGUMENT, "dimensions, not 6004"},
        {"lcg", 6, 1, UINT64_C(1) << 40, AUR_ERROR_ARGUMENT, "at most"},
        {"lcg", 6, 1, UINT64_C(1) << 30, AUR_ERROR_ARGUMENT, "has at most 134217727 points"},
        {"sobbol", 6, 1, 100, AUR_ERROR_NAME, "did you mean 'sobol'"},
        {"sobol", 6, 2, 100, AUR_ERROR_UNSUPPORTED, "need a scrambling"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        options = options_of(AUR_RADIOSITY_COSINE, cases[i].bounces);
        options.sequence = cases[i].sequence;
        options.randomizations = cases[i].randomizations;
        aur_radiosity *const radiosity = must_create(scene, &options);
        aur_error error = {0};
        const aur_result result = aur_radiosity_trace(radiosity, cases[i].paths, &error);
        if (result != cases[i].result || strstr(error.message, cases[i].message) == NULL)
            fail_msg("%s: %d: '%s' does not say '%s'", cases[i].sequence, result, error.message,
                     cases[i].message);
        assert_int_equal(describe(radiosity).paths, 0);
        aur_radiosity_destroy(radiosity);
    }
    /* A set whose points depend on their number cannot be continued. */
    options = options_of(AUR_RADIOSITY_COSINE, 6);
    options.sequence = "hammersley";
    aur_radiosity *const radiosity = must_trace(scene, &options, 100);
    aur_error error = {0};
    assert_int_equal(aur_radiosity_trace(radiosity, 200, &error), AUR_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.message, "cannot be continued"));
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

/* Structs with an unset size are rejected; larger ones of a later version are filled as far as they are
 * known. */
static void structs_may_grow(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    aur_error error = {0};
    aur_radiosity *radiosity = NULL;
    assert_int_equal(aur_radiosity_create(scene, &(aur_radiosity_options){.bounces = 1}, &radiosity, &error),
                     AUR_ERROR_ARGUMENT);
    struct {
        aur_radiosity_options options;
        uint64_t later;
    } larger = {{.size = sizeof larger}, 0};
    aur_radiosity_options_init(&larger.options, NULL);
    larger.options.bounces = 3;
    assert_int_equal(aur_radiosity_create(scene, &larger.options, &radiosity, &error), AUR_OK);
    assert_int_equal(describe(radiosity).dimension, 10);
    larger.later = 1;
    aur_radiosity *refused = NULL;
    assert_int_equal(aur_radiosity_create(scene, &larger.options, &refused, &error), AUR_ERROR_UNSUPPORTED);
    aur_radiosity_description unset = {.size = 0};
    assert_int_equal(aur_radiosity_get_description(radiosity, &unset, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(
        aur_radiosity_terminate(radiosity, &(aur_radiosity_termination){.epsilon = 1.0}, NULL, &error),
        AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "'size'"));
    struct {
        aur_radiosity_triangle_result row;
        double later;
    } rows[MOST_TRIANGLES];
    aur_radiosity_triangle_result plain[MOST_TRIANGLES];
    assert_int_equal(aur_radiosity_trace(radiosity, 100, &error), AUR_OK);
    const size_t count = get_results(radiosity, plain);
    assert_int_equal(aur_radiosity_get_results(radiosity, count, sizeof rows[0], &rows[0].row, &error),
                     AUR_OK);
    for (size_t i = 0; i < count; ++i) {
        assert_memory_equal(&rows[i].row, &plain[i], sizeof plain[i]);
        assert_true(rows[i].later == 0.0);
    }
    assert_int_equal(aur_radiosity_get_results(radiosity, count - 1, sizeof plain[0], plain, &error),
                     AUR_ERROR_CAPACITY);
    assert_int_equal(aur_radiosity_get_results(radiosity, count, 8, plain, &error), AUR_ERROR_ARGUMENT);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

/* The message's count equals that of the description, over all paths, and so does its percentage. */
static void expect_share(const char *message, uint64_t count, uint64_t paths) {
    char said[96];
    snprintf(said, sizeof said, " %zu of %zu paths (%.3g %%)", (size_t)count, (size_t)paths,
             100.0 * (double)count / (double)paths);
    if (strstr(message, said) == NULL)
        fail_msg("'%s' does not say '%s'", message, said);
}

/* By reciprocity one path in five leaves an open room at once. */
static void open_scenes_are_reported(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(FIVE_WALLS);
    messages received = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 1);
    options.warnings = (aur_warnings){store_message, &received};
    aur_radiosity *const radiosity = must_trace(scene, &options, 10000);
    assert_in_range(describe(radiosity).lost, 2000, 5000);
    assert_int_equal(received.count, 1);
    assert_non_null(strstr(received.text, "left the scene: it is open"));
    expect_share(received.text, describe(radiosity).lost, 10000);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

static void backs_are_reported(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM "<shape type='rectangle'><bsdf type='diffuse'/></shape>");
    messages received = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){store_message, &received};
    aur_radiosity *const radiosity = must_trace(scene, &options, 1000);
    assert_in_range(describe(radiosity).behind, 100, 900);
    assert_int_equal(received.count, 1);
    assert_non_null(strstr(received.text, "back of a one-sided surface"));
    expect_share(received.text, describe(radiosity).behind, 1000);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

static void bright_albedos_are_reported(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body("<shape type='cube'>" INSIDE
                                            "<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>"
                                            "<emitter type='area'/></shape>");
    messages received = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){store_message, &received};
    aur_radiosity *const radiosity = must_trace(scene, &options, 1000);
    assert_true(describe(radiosity).tail == 1.0 && describe(radiosity).largest_albedo == 1.0);
    assert_int_equal(received.count, 1);
    assert_non_null(strstr(received.text, "scene.xml:2"));
    assert_non_null(strstr(received.text, "albedo of 1"));
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

#define BOX(height)                                                                                          \
    ROOM "<shape type='cube'><transform name='to_world'><scale value='0.4'/><translate z='" height "'/>"     \
         "</transform>" WALL_MATERIAL "</shape>"

/* A box that stands exactly on the floor loses the emission of its underside; one just above it nothing. */
static void coincident_surfaces_are_reported(void **state) {
    (void)state;
    messages received = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){store_message, &received};
    aur_scene *const standing = must_load_uncut(BOX("-0.6"));
    aur_radiosity *const lossy = must_create(standing, &options);
    assert_in_range(describe(lossy).coincident, 2, 4);
    assert_int_equal(received.count, 1);
    char said[64];
    snprintf(said, sizeof said, "radiosity: %d pairs of triangles lie on each other",
             (int)describe(lossy).coincident);
    assert_non_null(strstr(received.text, said));
    assert_non_null(strstr(received.text, "lie on each other"));
    assert_int_equal(aur_radiosity_trace(lossy, 10000, NULL), AUR_OK);
    assert_in_range(describe(lossy).lost, 100, 5000);
    aur_radiosity_destroy(lossy);
    aur_scene_destroy(standing);
    aur_scene *const floating = must_load_body(BOX("-0.599"));
    aur_radiosity *const tight = must_trace(floating, &options, 10000);
    assert_int_equal(describe(tight).coincident + describe(tight).lost + describe(tight).behind, 0);
    aur_radiosity_destroy(tight);
    aur_scene_destroy(floating);
}

#define LIGHT_FROM(file)                                                                                     \
    "<shape type='obj'><string name='filename' value='" file "'/><emitter type='area'/></shape>"

static void write_triangle(FILE *file, double x, double y, double z, double width, double height) {
    fprintf(file, "v %.9g %.9g %.9g\nv %.9g %.9g %.9g\nv %.9g %.9g %.9g\nf -3 -2 -1\n", x, y, z, x + width, y,
            z, x, y + height, z);
}

/* Triangles at random positions in separate planes, each given twice: every pair is found, and no other. */
static void every_coincidence_is_found(void **state) {
    (void)state;
    enum { COUNT = 1000 };
    FILE *const file = fopen(path_of("twice.obj"), "w");
    for (size_t i = 0; i < 2 * COUNT; ++i) {
        const size_t which = i % COUNT;
        write_triangle(file, aur_unit_double(aur_hash2(which, 0)), aur_unit_double(aur_hash2(which, 1)),
                       0.001 * (double)which, 0.1, aur_unit_double(aur_hash2(which, 2)) + 0.01);
    }
    fclose(file);
    aur_scene *const scene = must_load_uncut(LIGHT_FROM("twice.obj"));
    aur_radiosity *const radiosity = must_create(scene, NULL);
    assert_int_equal(describe(radiosity).coincident, COUNT);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

/* How many comparisons a tree of `count` boxes may take where few of them meet. */
static double few(double count) {
    return 8.0 * count * log2(count);
}

/* 100,000 strips side by side that are all as long as the scene, and 3000 copies of one triangle: neither
 * takes the square of their number. */
static void coincidences_take_few_comparisons(void **state) {
    (void)state;
    FILE *file = fopen(path_of("strips.obj"), "w");
    for (size_t i = 0; i < 100000; ++i)
        write_triangle(file, 0.0, 2e-3 * (double)i, 0.0, 1000.0, 1e-3);
    fclose(file);
    file = fopen(path_of("copies.obj"), "w");
    for (size_t i = 0; i < 3000; ++i)
        write_triangle(file, 0.0, 0.0, 0.0, 1.0, 1.0);
    fclose(file);
    aur_scene *const strips = must_load_uncut(LIGHT_FROM("strips.obj"));
    aur_scene *const copies = must_load_uncut(LIGHT_FROM("copies.obj"));
    aur_radiosity *const apart = must_create(strips, NULL), *const together = must_create(copies, NULL);
    aur_radiosity_coincidence found;
    assert_int_equal(aur_radiosity_find_coincidences(&apart->scene, &found, NULL), AUR_OK);
    assert_int_equal(found.pairs, 0);
    assert_true((double)found.compared < few(100000.0));
    assert_int_equal(aur_radiosity_find_coincidences(&together->scene, &found, NULL), AUR_OK);
    assert_int_equal(describe(together).coincident, found.pairs);
    assert_in_range(found.pairs, AUR_RADIOSITY_MOST_COINCIDENCES, 3000 * 2999 / 2 - 1);
    assert_true((double)found.compared < 2.0 * AUR_RADIOSITY_MOST_COINCIDENCES);
    aur_radiosity_destroy(apart);
    aur_radiosity_destroy(together);
    aur_scene_destroy(strips);
    aur_scene_destroy(copies);
}

/* A light 10^18 times darker than another vanishes in the sum of their powers: it is omitted, and the other
 * one's light is the same as alone. */
static void vanishing_lights_are_left_out(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        "<shape type='cube'>" INSIDE "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>"
        "<emitter type='area'><rgb name='radiance' value='1e12'/></emitter></shape>"
        "<shape type='rectangle'><transform name='to_world'><translate z='5'/></transform>"
        "<emitter type='area'><rgb name='radiance' value='1e-6'/></emitter></shape>");
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 1);
    aur_radiosity *const radiosity = must_trace(scene, &options, 1000);
    assert_int_equal(describe(radiosity).lights, 14);
    aur_radiosity_triangle_result results[MOST_TRIANGLES];
    double received = 0.0;
    for (size_t i = 0, count = get_results(radiosity, results); i < count; ++i)
        received += results[i].power[0];
    assert_relative(received, 24.0 * AUR_PI * (double)1e12f, 1e-9);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

/* Overflows of sums are counted, and a NaN creates no solution. */
static void powers_beyond_the_sums_are_reported(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    messages received = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){store_message, &received};
    aur_radiosity *const radiosity = must_trace(scene, &options, 100), *const whole =
                                                                           must_trace(scene, &options, 100);
    double *const start = radiosity->walk.start[0];
    const double good = start[0];
    start[0] = NAN;
    aur_error error = {0};
    assert_int_equal(aur_radiosity_trace(radiosity, 200, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "not finite"));
    assert_same(whole, radiosity);
    start[0] = good;
    assert_int_equal(aur_radiosity_trace(radiosity, 200, &error), AUR_OK);
    assert_int_equal(aur_radiosity_trace(whole, 200, &error), AUR_OK);
    assert_same(whole, radiosity);
    assert_int_equal(received.count, 0);
    start[0] = 0x1p63;
    assert_int_equal(aur_radiosity_trace(radiosity, 300, &error), AUR_OK);
    assert_int_equal(received.count, 1);
    assert_non_null(strstr(received.text, "is cut off"));
    aur_radiosity_destroy(radiosity);
    aur_radiosity_destroy(whole);
    aur_scene_destroy(scene);
}

static void other_materials_are_reported(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body(ROOM "<shape type='cube'><transform name='to_world'><scale value='0.2'/>"
                            "</transform><bsdf type='plastic'/></shape>");
    messages received = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){store_message, &received};
    aur_radiosity_destroy(must_create(scene, &options));
    assert_int_equal(received.count, 1);
    assert_non_null(strstr(received.text, "only the diffuse part of the material 'plastic'"));
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_without_an_answer_are_refused),
        cmocka_unit_test(options_out_of_range_are_refused),
        cmocka_unit_test(structs_may_grow),
        cmocka_unit_test(open_scenes_are_reported),
        cmocka_unit_test(backs_are_reported),
        cmocka_unit_test(bright_albedos_are_reported),
        cmocka_unit_test(coincident_surfaces_are_reported),
        cmocka_unit_test(every_coincidence_is_found),
        cmocka_unit_test(coincidences_take_few_comparisons),
        cmocka_unit_test(vanishing_lights_are_left_out),
        cmocka_unit_test(powers_beyond_the_sums_are_reported),
        cmocka_unit_test(other_materials_are_reported),
    };
    return cmocka_run_group_tests_name("radiosity reports", tests, enter_folder, leave_folder);
}
