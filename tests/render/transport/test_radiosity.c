/* The walk of radiosity. */
#include "radiosity_room.h"

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
    /* 0.00098 and 0.00163 by an independent prototype: mean squares of 144 numbers, a quarter of them
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
                assert_int_equal(
                    aur_radiosity_get_results(radiosity, d.triangles, sizeof *results, results, NULL),
                    AUR_OK);
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

/* Every flight carries half the power of the previous one, wherever it goes: also to the back of a plate. */
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
    /* By symmetry the plate's front receives as much as its back, and the walls the rest. */
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
    /* The lid's mean albedo is found by points. */
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
    };
    return cmocka_run_group_tests_name("radiosity", tests, enter_folder, leave_folder);
}
