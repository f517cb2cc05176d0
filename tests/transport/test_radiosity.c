#include "scene/scene_text.h"

#include <aureole/radiosity.h>

/* Walls of [-1,1]^3, seen from inside, that emit 1/4 and reflect half: the radiance is 1/2 everywhere. */
#define WALL_MATERIAL                                                                                        \
    "<bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf>"                                      \
    "<emitter type='area'><rgb name='radiance' value='0.25'/></emitter>"
#define INSIDE "<boolean name='flip_normals' value='true'/>"
#define ROOM "<shape type='cube'>" INSIDE WALL_MATERIAL "</shape>"
/* A wall of it at z = 1 that faces down, and the other five. */
#define LID(material)                                                                                        \
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='180'/><translate z='1'/>"       \
    "</transform>" material "</shape>"
#define FIVE_WALLS                                                                                           \
    "<shape type='rectangle'><transform name='to_world'><translate z='-1'/></transform>" WALL_MATERIAL       \
    "</shape>"                                                                                               \
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='90'/><translate y='1'/>"        \
    "</transform>" WALL_MATERIAL "</shape>"                                                                  \
    "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='-90'/><translate y='-1'/>"      \
    "</transform>" WALL_MATERIAL "</shape>"                                                                  \
    "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='90'/><translate x='-1'/>"       \
    "</transform>" WALL_MATERIAL "</shape>"                                                                  \
    "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='-90'/><translate x='1'/>"       \
    "</transform>" WALL_MATERIAL "</shape>"

enum { MOST_TRIANGLES = 64 };

typedef struct messages {
    size_t count;
    char text[1024];
} messages;

static void keep_message(void *user, const char *message) {
    messages *const kept = user;
    ++kept->count;
    snprintf(kept->text, sizeof kept->text, "%s", message);
}

static aur_radiosity_options options_of(aur_radiosity_directions directions, size_t bounces) {
    aur_radiosity_options options = aur_radiosity_options_default();
    options.directions = directions;
    options.bounces = bounces;
    return options;
}

static aur_radiosity *must_create(const aur_scene *scene, const aur_radiosity_options *options) {
    aur_radiosity *radiosity = NULL;
    aur_error error = {0};
    if (aur_radiosity_create(scene, options, &radiosity, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return radiosity;
}

static aur_radiosity *must_trace(const aur_scene *scene, const aur_radiosity_options *options,
                                 uint64_t paths) {
    aur_radiosity *const radiosity = must_create(scene, options);
    aur_error error = {0};
    if (aur_radiosity_trace(radiosity, paths, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return radiosity;
}

static aur_radiosity_description describe(const aur_radiosity *radiosity) {
    aur_radiosity_description description;
    aur_radiosity_describe(radiosity, &description);
    return description;
}

static size_t get_results(const aur_radiosity *radiosity, aur_radiosity_triangle_result *results) {
    const size_t count = describe(radiosity).triangles;
    assert_int_equal(aur_radiosity_results(radiosity, MOST_TRIANGLES, results), AUR_OK);
    return count;
}

/* Of the first channel, over the triangles that reflect. */
static double area_mean(const aur_radiosity *radiosity) {
    aur_radiosity_triangle_result results[MOST_TRIANGLES];
    const size_t count = get_results(radiosity, results);
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < count; ++i) {
        if (results[i].albedo[0] == 0.0)
            continue;
        sum += results[i].radiance[0] * results[i].area;
        area += results[i].area;
    }
    return sum / area;
}

/* --- the walk */

/* With cosine directions every flight of every path carries what it should, so the mean is exact for any
 * points: 1/2 less what the cut after M bounces leaves out. A mirror in the room changes nothing. */
static void mean_is_exact(void **state) {
    (void)state;
    static const char *const sets[] = {"sobol",  "halton", "hammersley", "faure",
                                       "random", "lcg",    "icg",        "niederreiter"};
    static const size_t bounces[] = {1, 6, 29};
    static const char *const bodies[] = {ROOM, FIVE_WALLS LID("<bsdf type='conductor'/>")};
    for (size_t scene_index = 0; scene_index < 2; ++scene_index) {
        aur_scene *const scene = must_load_body(bodies[scene_index]);
        for (size_t s = 0; s < sizeof sets / sizeof sets[0]; ++s) {
            for (size_t m = 0; m < 3; ++m) {
                aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, bounces[m]);
                options.sequence = sets[s];
                aur_radiosity *const radiosity = must_trace(scene, &options, 1003);
                const aur_radiosity_description d = describe(radiosity);
                assert_int_equal(d.lost + d.behind + d.trapped, 0);
                assert_near(area_mean(radiosity), 0.5 - ldexp(1.0, -(int)bounces[m] - 3), 1e-9);
                assert_relative(d.tail, ldexp(1.0, -(int)bounces[m] - 1), 1e-2);
                assert_true(d.rays >= 1003 * (bounces[m] + 1));
                aur_radiosity_destroy(radiosity);
            }
        }
        aur_scene_destroy(scene);
    }
}

/* Triangle by triangle the radiance is 1/2 within the spread of independent paths (Delta_aw sqrt N = 0.167
 * and 0.144: Delta_a = sqrt 12 of it; five times that is allowed for the largest of 12). */
static void radiance_is_one_half(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    for (int directions = 0; directions < 2; ++directions) {
        aur_radiosity_options options = options_of((aur_radiosity_directions)directions, 29);
        options.sequence = "random";
        aur_radiosity *const radiosity = must_trace(scene, &options, 40000);
        aur_radiosity_triangle_result results[MOST_TRIANGLES];
        assert_int_equal(get_results(radiosity, results), 12);
        for (size_t i = 0; i < 12; ++i) {
            assert_relative(results[i].area, 2.0, 1e-6);
            for (size_t c = 0; c < 3; ++c) {
                assert_near(results[i].radiance[c], 0.5, 5.0 * 0.167 * sqrt(12.0 / 40000.0));
                assert_true(isnan(results[i].standard_error[c]));
            }
        }
        aur_radiosity_destroy(radiosity);
    }
    aur_scene_destroy(scene);
}

static void quasi_random_points_are_better(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    double squares[2] = {0};
    for (uint64_t variant = 1; variant <= 12; ++variant) {
        for (size_t s = 0; s < 2; ++s) {
            aur_radiosity_options options = options_of(AUR_RADIOSITY_UNIFORM_ANGLE, 29);
            options.sequence = s == 0 ? "sobol" : "lcg";
            options.variant = variant;
            aur_radiosity *const radiosity = must_trace(scene, &options, 10000);
            aur_radiosity_triangle_result results[MOST_TRIANGLES];
            get_results(radiosity, results);
            for (size_t i = 0; i < 12; ++i)
                squares[s] += (results[i].radiance[0] - 0.5) * (results[i].radiance[0] - 0.5);
            aur_radiosity_destroy(radiosity);
        }
    }
    /* 0.00098 and 0.00163 by an independent prototype: mean squares of 144 numbers of which a quarter is
     * independent, good to a quarter; twice that is allowed. */
    assert_relative(sqrt(squares[0] / 12.0 / 12.0 / 12.0), 0.00098, 0.3);
    assert_relative(sqrt(squares[1] / 12.0 / 12.0 / 12.0), 0.00163, 0.3);
    aur_scene_destroy(scene);
}

/* Independent points: Delta_aw sqrt N = 0.167 by uniform angles and 0.144 by cosines, in any closed scene of
 * the analytic setting. Here 1572 triangles and 12 solutions each, so that the mean squares are good to 2 %;
 * with N = 2000 the figures of a prototype are allowed 10 %. By algebra Delta_a / Delta_aw = sqrt 12 on 12
 * equal triangles. */
static void independent_paths_spread_as_they_must(void **state) {
    (void)state;
    static const double expected[] = {0.144, 0.167};
    aur_scene *teapot = NULL;
    assert_int_equal(
        aur_scene_load(AUR_SOURCE_DIR "/scenes/keller/teapot-box-analytic.xml", NULL, &teapot, NULL), AUR_OK);
    aur_scene *const cube = must_load_body(ROOM);
    for (int scene = 0; scene < 2; ++scene) {
        for (int directions = 0; directions < 2; ++directions) {
            double plain = 0.0, weighted = 0.0;
            for (uint64_t seed = 0; seed < 12; ++seed) {
                aur_radiosity_options options = options_of((aur_radiosity_directions)directions, 29);
                options.sequence = "random";
                options.seed = seed;
                aur_radiosity *const radiosity = must_trace(scene == 0 ? teapot : cube, &options, 2000);
                const aur_radiosity_description d = describe(radiosity);
                aur_radiosity_triangle_result *const results = malloc(d.triangles * sizeof *results);
                assert_int_equal(aur_radiosity_results(radiosity, d.triangles, results), AUR_OK);
                for (size_t i = 0; i < d.triangles; ++i) {
                    const double difference = results[i].radiance[0] - 0.5;
                    plain += difference * difference / (double)d.triangles;
                    weighted += difference * difference * results[i].area / (double)d.triangles / d.area;
                }
                free(results);
                aur_radiosity_destroy(radiosity);
            }
            if (scene == 0)
                assert_relative(sqrt(weighted / 12.0 * 2000.0), expected[directions], 0.1);
            else
                assert_relative(sqrt(plain / weighted), sqrt(12.0), 1e-5);
        }
    }
    aur_scene_destroy(teapot);
    aur_scene_destroy(cube);
}

static void assert_same(const aur_radiosity *a, const aur_radiosity *b) {
    aur_radiosity_triangle_result x[MOST_TRIANGLES], y[MOST_TRIANGLES];
    const size_t count = get_results(a, x);
    assert_int_equal(get_results(b, y), count);
    assert_memory_equal(x, y, count * sizeof x[0]);
    const aur_radiosity_description d = describe(a), e = describe(b);
    assert_int_equal(d.paths, e.paths);
    assert_int_equal(d.rays, e.rays);
    assert_true(d.tail == e.tail && d.lost == e.lost);
}

/* Neither threads nor the way in which paths are divided into calls change a bit. */
static void threads_change_nothing(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    static const char *const sets[] = {"sobol", "halton", "lcg"};
    for (size_t s = 0; s < 3; ++s) {
        aur_radiosity_options options = options_of(AUR_RADIOSITY_UNIFORM_ANGLE, 5);
        options.sequence = sets[s];
        options.scramble = AUR_SCRAMBLE_DIGIT;
        options.randomizations = 3;
        options.threads = 1;
        aur_radiosity *const one = must_trace(scene, &options, 5000);
        for (size_t threads = 2; threads <= 4; ++threads) {
            options.threads = threads;
            aur_radiosity *const many = must_create(scene, &options);
            for (uint64_t paths = 1; paths < 5000; paths = 3 * paths + 17)
                assert_int_equal(aur_radiosity_trace(many, paths, NULL), AUR_OK);
            assert_int_equal(aur_radiosity_trace(many, 5000, NULL), AUR_OK);
            assert_same(one, many);
            aur_radiosity_destroy(many);
        }
        aur_radiosity_destroy(one);
    }
    aur_scene_destroy(scene);
}

/* Every flight brings half of the flight before, wherever it goes: also to the back of a plate. */
static void two_sided_plates_receive_on_both_sides(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        ROOM
        "<shape type='rectangle'><transform name='to_world'><scale value='0.5'/><rotate x='1' angle='20'/>"
        "</transform><bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf>"
        "</bsdf></shape>");
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    aur_radiosity *const radiosity = must_trace(scene, &options, 20000);
    const aur_radiosity_description d = describe(radiosity);
    assert_int_equal(d.triangles, 14);
    assert_int_equal(d.patches, 16);
    assert_int_equal(d.lost + d.behind, 0);
    assert_relative(d.tail, ldexp(1.0, -7), 1e-9);
    /* By symmetry the plate's front receives what its back does, and the walls the rest. */
    aur_radiosity_triangle_result results[MOST_TRIANGLES];
    get_results(radiosity, results);
    double walls = 0.0, front = 0.0;
    for (size_t i = 0; i < 14; ++i)
        *(i < 12 ? &walls : &front) += results[i].power[0];
    const double all = d.emitted / 3.0 * (2.0 - ldexp(1.0, -6));
    assert_relative(walls + 2.0 * front, all, 2e-3);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

#define CHECKERS(name, low, high)                                                                            \
    "<texture type='checkerboard' name='" name "'><rgb name='color0' value='" low                            \
    "'/><rgb name='color1' value='" high                                                                     \
    "'/><transform name='to_uv'><scale x='16' y='16'/></transform></texture>"

/* A texture of one value is that value, to the bit but for the mean's rounding; a fine one acts as its mean.
 */
static void textures_act_as_their_values(void **state) {
    (void)state;
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    aur_scene *const plain = must_load_body(FIVE_WALLS LID(WALL_MATERIAL));
    aur_scene *const constant = must_load_body(FIVE_WALLS LID(
        "<bsdf type='diffuse'>" CHECKERS("reflectance", "0.5", "0.5") "</bsdf><emitter type='area'>" CHECKERS(
            "radiance", "0.25", "0.25") "</emitter>"));
    aur_scene *const varying = must_load_body(FIVE_WALLS LID(
        "<bsdf type='diffuse'>" CHECKERS("reflectance", "0.1", "0.9") "</bsdf><emitter type='area'>" CHECKERS(
            "radiance", "0.0", "0.5") "</emitter>"));
    aur_radiosity *const a = must_trace(plain, &options, 4000), *const b =
                                                                    must_trace(constant, &options, 4000);
    assert_same(a, b);
    aur_radiosity_destroy(a);
    aur_radiosity_destroy(b);
    aur_radiosity *const c = must_trace(varying, &options, 100000);
    aur_radiosity_triangle_result results[MOST_TRIANGLES];
    assert_int_equal(get_results(c, results), 12);
    /* The lid's own mean albedo is found by points. */
    for (size_t i = 0; i < 12; ++i)
        assert_near(results[i].radiance[0], 0.5 - ldexp(1.0, -9), i < 10 ? 0.01 : 0.02);
    aur_radiosity_destroy(c);
    aur_scene_destroy(plain);
    aur_scene_destroy(constant);
    aur_scene_destroy(varying);
}

/* Lights of several colours: the two ways of choosing where paths begin have one expectation. Each triangle
 * within five standard errors of the difference, of 16 randomisations each: a false alarm once in 10,000 runs
 * (Student's t with some 30 degrees of freedom, 36 numbers). */
static void emission_by_power_and_by_area_agree(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        ROOM "<shape type='cube'><transform name='to_world'><scale value='0.3'/><rotate y='1' "
             "angle='30'/></transform><bsdf type='diffuse'><rgb name='reflectance' value='.7 .4 .1'/>"
             "</bsdf><emitter type='area'><rgb name='radiance' value='5, 1, 0.2'/></emitter></shape>");
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    options.scramble = AUR_SCRAMBLE_OWEN;
    options.randomizations = 16;
    aur_radiosity_triangle_result by_power[MOST_TRIANGLES], by_area[MOST_TRIANGLES];
    aur_radiosity *const a = must_trace(scene, &options, 32768);
    get_results(a, by_power);
    options.emission = AUR_RADIOSITY_BY_AREA;
    options.directions = AUR_RADIOSITY_UNIFORM_ANGLE;
    options.seed = 1;
    aur_radiosity *const b = must_trace(scene, &options, 32768);
    const size_t count = get_results(b, by_area);
    assert_int_equal(count, 24);
    for (size_t i = 0; i < count; ++i)
        for (size_t c = 0; c < 3; ++c)
            assert_near(by_power[i].radiance[c] - by_area[i].radiance[c], 0.0,
                        5.0 * hypot(by_power[i].standard_error[c], by_area[i].standard_error[c]));
    aur_radiosity_destroy(a);
    aur_radiosity_destroy(b);
    aur_scene_destroy(scene);
}

/* The error bar tells how far the solution is from the truth: root mean squares over 16 solutions. Their own
 * scatter is about a tenth; three such are allowed. */
static void error_bar_is_honest(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    double told = 0.0, found = 0.0;
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
            told += results[i].standard_error[0] * results[i].standard_error[0];
            for (size_t c = 0; c < 3; ++c) {
                const double power_error = results[i].standard_error[c] * 2.0 * AUR_PI * results[i].area;
                squares += power_error * power_error * results[i].area;
            }
        }
        assert_relative(describe(radiosity).error, sqrt(squares / 24.0) / (sqrt(3.0) * 0.25 * 24.0), 1e-6);
        aur_radiosity_destroy(radiosity);
    }
    assert_relative(sqrt(told), sqrt(found), 0.3);
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
    int converged = 0;
    aur_error error = {0};
    const aur_radiosity_termination rule = {.epsilon = epsilon};
    assert_int_equal(aur_radiosity_terminate(adaptive, &rule, &converged, &error), AUR_OK);
    assert_int_equal(converged, 1);
    assert_int_equal(describe(adaptive).paths, paths);
    assert_relative(describe(adaptive).change, change, 1e-9);
    assert_same(stepwise, adaptive);
    /* A limit ends it before. */
    aur_radiosity *const limited = must_create(scene, &options);
    assert_int_equal(aur_radiosity_terminate(limited,
                                             &(aur_radiosity_termination){.epsilon = 1e-9, .limit = 4500},
                                             &converged, NULL),
                     AUR_OK);
    assert_int_equal(converged, 0);
    assert_int_equal(describe(limited).paths, 4500);
    assert_int_equal(aur_radiosity_terminate(limited, &rule, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "4500 paths are no multiple of the interval of 1000"));
    assert_int_equal(
        aur_radiosity_terminate(adaptive, &(aur_radiosity_termination){.epsilon = 0.0}, NULL, &error),
        AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "epsilon must be above 0"));
    aur_radiosity_destroy(limited);
    aur_radiosity_destroy(stepwise);
    aur_radiosity_destroy(adaptive);
    aur_scene_destroy(scene);
}

/* --- files */

static const char *path_of(const char *name) {
    static char path[2][128];
    static int turn;
    turn = 1 - turn;
    snprintf(path[turn], sizeof path[turn], "%s/%s", scene_folder, name);
    return path[turn];
}

static void saved_solutions_go_on(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    options.scramble = AUR_SCRAMBLE_OWEN;
    options.randomizations = 4;
    options.seed = 5;
    aur_radiosity *const whole = must_trace(scene, &options, 7000);
    aur_radiosity *const part = must_trace(scene, &options, 2345);
    aur_error error = {0};
    assert_int_equal(aur_radiosity_save(part, path_of("part"), &error), AUR_OK);
    aur_radiosity *loaded = NULL;
    const aur_radiosity_options two_threads = {.threads = 2};
    assert_int_equal(aur_radiosity_load(scene, path_of("part"), &two_threads, &loaded, &error), AUR_OK);
    assert_same(part, loaded);
    assert_int_equal(aur_radiosity_trace(loaded, 7000, &error), AUR_OK);
    assert_same(whole, loaded);
    assert_int_equal(aur_radiosity_trace(loaded, 6999, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "7000 paths already"));
    aur_radiosity_destroy(whole);
    aur_radiosity_destroy(part);
    aur_radiosity_destroy(loaded);
    aur_scene_destroy(scene);
}

static void expect_bad_file(const aur_scene *scene, size_t size, const char *data, const char *message) {
    aur_radiosity *loaded = NULL;
    aur_error error = {0};
    const char *const path = write_file("bad", data, size);
    const aur_result result = aur_radiosity_load(scene, path, NULL, &loaded, &error);
    if (result != AUR_ERROR_FORMAT || strstr(error.message, message) == NULL || strcmp(error.file, path) != 0)
        fail_msg("%d, %s: %s", result, error.file, error.message);
    assert_null(loaded);
}

static void damaged_files_are_refused(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM), *const other = must_load_body(FIVE_WALLS);
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    aur_radiosity *const radiosity = must_trace(scene, &options, 100);
    assert_int_equal(aur_radiosity_save(radiosity, path_of("good"), NULL), AUR_OK);
    char data[4096];
    FILE *const file = fopen(path_of("good"), "rb");
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    assert_in_range(size, 500, sizeof data - 1);
    expect_bad_file(scene, 0, data, "does not begin with");
    expect_bad_file(scene, 30, data, "head is cut");
    expect_bad_file(scene, size - 8, data, "cut short");
    expect_bad_file(scene, size + 1, data, "too long");
    expect_bad_file(other, size, data, "made for another scene");
    for (size_t at = 0; at < size; at += 7) {
        data[at] ^= 4;
        aur_radiosity *loaded = NULL;
        assert_int_not_equal(aur_radiosity_load(scene, write_file("bad", data, size), NULL, &loaded, NULL),
                             AUR_OK);
        assert_null(loaded);
        data[at] ^= 4;
    }
    aur_radiosity *loaded = NULL;
    aur_error error = {0};
    assert_int_equal(aur_radiosity_load(scene, path_of("nowhere"), NULL, &loaded, &error), AUR_ERROR_OPEN);
    assert_int_equal(aur_radiosity_save(radiosity, path_of("no-folder/file"), &error), AUR_ERROR_WRITE);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
    aur_scene_destroy(other);
}

/* A PLY file that our own reader takes: the same triangles. */
static void meshes_are_written(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    aur_radiosity *const radiosity = must_trace(scene, &options, 4000);
    assert_int_equal(aur_radiosity_write_ply(radiosity, path_of("room.ply"), 1.0, NULL), AUR_OK);
    aur_scene *const again =
        must_load_body("<shape type='ply'><string name='filename' value='room.ply'/></shape>");
    aur_scene_description a, b;
    aur_scene_describe(scene, &a);
    aur_scene_describe(again, &b);
    assert_int_equal(b.triangles, 12);
    assert_memory_equal(a.lower, b.lower, sizeof a.lower);
    assert_memory_equal(a.upper, b.upper, sizeof a.upper);
    /* Radiance 1/2 at one stop is full white; each vertex tells the radiance of its triangle. */
    char data[4096];
    FILE *const file = fopen(path_of("room.ply"), "rb");
    const size_t size = fread(data, 1, sizeof data - 1, file);
    fclose(file);
    data[size] = '\0';
    const char *const body = strstr(data, "end_header\n") + 11;
    assert_int_equal(size - (size_t)(body - data), 36 * (12 + 3 + 12) + 12 * 13);
    aur_radiosity_triangle_result results[MOST_TRIANGLES];
    get_results(radiosity, results);
    for (size_t v = 0; v < 36; ++v) {
        float radiance[3];
        memcpy(radiance, body + 27 * v + 15, sizeof radiance);
        assert_near(radiance[1], results[v / 3].radiance[1], 1e-6);
        assert_in_range((unsigned char)body[27 * v + 12], 250, 255);
    }
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(again);
    aur_scene_destroy(scene);
}

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
                   "emitter 'constant' is no surface");
    expect_refused(
        "<shape type='cube'><emitter type='area'><rgb name='radiance' value='0'/></emitter></shape>", NULL,
        AUR_ERROR_UNSUPPORTED, "emit no radiance");
    expect_refused(ROOM "<shape type='sphere'/>", NULL, AUR_ERROR_UNSUPPORTED,
                   "'sphere' is no mesh of triangles");
    /* A light of no area, and radiance that is no number, are refused before, by the loader. */
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
    assert_int_equal(
        load_body("<shape type='obj'><string name='filename' value='flat.obj'/><emitter type='area'/>"
                  "</shape>",
                  NULL, &scene, &error),
        AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "no area"));
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
        {"lcg", 6, 1, UINT64_C(1) << 30, AUR_ERROR_ARGUMENT, "no more than"},
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
    /* A set whose points depend on how many there are cannot go on. */
    options = options_of(AUR_RADIOSITY_COSINE, 6);
    options.sequence = "hammersley";
    aur_radiosity *const radiosity = must_trace(scene, &options, 100);
    aur_error error = {0};
    assert_int_equal(aur_radiosity_trace(radiosity, 200, &error), AUR_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.message, "cannot be continued"));
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

/* By reciprocity one path in five leaves an open room at once. */
static void open_scenes_are_reported(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(FIVE_WALLS);
    messages kept = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 1);
    options.warnings = (aur_warnings){keep_message, &kept};
    aur_radiosity *const radiosity = must_trace(scene, &options, 10000);
    assert_in_range(describe(radiosity).lost, 2000, 5000);
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, "left the scene: it is open"));
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

static void backs_are_reported(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM "<shape type='rectangle'><bsdf type='diffuse'/></shape>");
    messages kept = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){keep_message, &kept};
    aur_radiosity *const radiosity = must_trace(scene, &options, 1000);
    assert_in_range(describe(radiosity).behind, 100, 900);
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, "back of a one-sided surface"));
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

static void bright_albedos_are_reported(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body("<shape type='cube'>" INSIDE
                                            "<bsdf type='diffuse'><rgb name='reflectance' value='1'/></bsdf>"
                                            "<emitter type='area'/></shape>");
    messages kept = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){keep_message, &kept};
    aur_radiosity *const radiosity = must_trace(scene, &options, 1000);
    assert_true(describe(radiosity).tail == 1.0 && describe(radiosity).largest_albedo == 1.0);
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, "scene.xml:2"));
    assert_non_null(strstr(kept.text, "albedo of 1"));
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
}

#define BOX(height)                                                                                          \
    ROOM "<shape type='cube'><transform name='to_world'><scale value='0.4'/><translate z='" height "'/>"     \
         "</transform>" WALL_MATERIAL "</shape>"

/* A box that stands exactly on the floor loses what its underside emits; one just above it nothing. */
static void coincident_surfaces_are_reported(void **state) {
    (void)state;
    messages kept = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){keep_message, &kept};
    aur_scene *const standing = must_load_body(BOX("-0.6"));
    aur_radiosity *const lossy = must_create(standing, &options);
    assert_in_range(describe(lossy).coincident, 2, 4);
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, "lie on each other"));
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

static void other_materials_are_reported(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body(ROOM "<shape type='cube'><transform name='to_world'><scale value='0.2'/>"
                            "</transform><bsdf type='plastic'/></shape>");
    messages kept = {0};
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 2);
    options.warnings = (aur_warnings){keep_message, &kept};
    aur_radiosity_destroy(must_create(scene, &options));
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, "only the diffuse part of the material 'plastic'"));
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mean_is_exact),
        cmocka_unit_test(radiance_is_one_half),
        cmocka_unit_test(quasi_random_points_are_better),
        cmocka_unit_test(independent_paths_spread_as_they_must),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(two_sided_plates_receive_on_both_sides),
        cmocka_unit_test(textures_act_as_their_values),
        cmocka_unit_test(emission_by_power_and_by_area_agree),
        cmocka_unit_test(error_bar_is_honest),
        cmocka_unit_test(terminates_as_the_paper_says),
        cmocka_unit_test(saved_solutions_go_on),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(meshes_are_written),
        cmocka_unit_test(scenes_without_an_answer_are_refused),
        cmocka_unit_test(options_out_of_range_are_refused),
        cmocka_unit_test(open_scenes_are_reported),
        cmocka_unit_test(backs_are_reported),
        cmocka_unit_test(bright_albedos_are_reported),
        cmocka_unit_test(coincident_surfaces_are_reported),
        cmocka_unit_test(other_materials_are_reported),
    };
    return cmocka_run_group_tests_name("radiosity", tests, enter_folder, leave_folder);
}
