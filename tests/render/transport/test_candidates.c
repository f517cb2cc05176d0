/* Resampled importance sampling of direct light: its numbers, means as without it, less variance under a sky,
 * the same bits in packets and by single paths, and as it was where there is one candidate. */
#include "render/scene/scene_text.h"

#include <math.h>

#include "points/base/random.h"
#include "render/vertex/candidates.h"
#include "short.h"
#include <aureole-render/render.h>

static const float LARGEST = 0x1.fffffep-1f; /* below 1 */

/* --- numbers */

static void shifted_numbers_stay_below_one(void **state) {
    (void)state;
    static const float numbers[] = {0.0f, 0x1p-149f, 0x1p-25f, 0.25f, 0.5f, 0x1.fffffcp-1f, 0x1.fffffep-1f};
    for (uint32_t count = 1; count <= AUR_CANDIDATES_MOST; ++count)
        for (uint32_t i = 0; i < count; ++i) {
            float shift[3];
            aur_candidate_shift(i, count, shift);
            for (size_t d = 0; d < 3; ++d) {
                assert_true(shift[d] >= 0.0f && shift[d] < 1.0f && (i > 0 || shift[d] == 0.0f));
                for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; ++k) {
                    const float number = aur_candidate_number(numbers[k], shift[d]);
                    assert_true(number >= 0.0f && number < 1.0f && (i > 0 || number == numbers[k]));
                    /* Exact but for two roundings of at most 2^-24, and the step from 1 to 0. */
                    const double exact = fmod((double)numbers[k] + (double)shift[d], 1.0);
                    const double off = fabs((double)number - exact);
                    assert_true(off <= 0x1p-23 || 1.0 - off <= 0x1p-23);
                }
            }
        }
}

/* The remainder of the number is used for the next choice, so it must stay in [0,1), also where differences
 * round to the same number: at a share of 3 * 2^-25 and the largest number they do. */
static void what_is_left_of_a_number_stays_below_one(void **state) {
    (void)state;
    for (uint32_t k = 0; k <= 256; ++k)
        for (uint32_t below = 0; below < 4; ++below) {
            float total = LARGEST, number = LARGEST - (float)below * 0x1p-24f;
            aur_candidate_wins((float)k * 0x1p-25f, &total, &number);
            assert_true(number >= 0.0f && number < 1.0f);
        }
    for (uint64_t k = 0; k < 100000; ++k) {
        uint64_t hash = k;
        float number = aur_draw_unit(&hash), total = 0.0f;
        for (size_t i = 0; i < 8; ++i) {
            aur_candidate_wins(expf(60.0f * aur_draw_unit(&hash) - 30.0f), &total, &number);
            assert_true(number >= 0.0f && number < 1.0f);
        }
    }
}

/* Each candidate is chosen for an interval of the number, whose length is its share of the weights: among
 * equidistant numbers it gets its share within 1, and rounding moves each end by less than one more. */
static void candidates_are_chosen_in_proportion(void **state) {
    (void)state;
    enum { NUMBERS = 65536, COUNT = 7 };
    static const float weights[COUNT] = {0.0f, 1.0f, 0.0f, 3.0f, 2.0f, 0.125f, 0.0f};
    size_t chosen[COUNT] = {0};
    for (size_t n = 0; n < NUMBERS; ++n) {
        float number = ((float)n + 0.5f) / NUMBERS, total = 0.0f;
        size_t last = 0;
        for (size_t i = 0; i < COUNT; ++i)
            if (aur_candidate_wins(weights[i], &total, &number))
                last = i;
        assert_true(total == 6.125f);
        ++chosen[last];
    }
    for (size_t i = 0; i < COUNT; ++i)
        assert_near((double)chosen[i], NUMBERS * (double)weights[i] / 6.125, weights[i] > 0.0f ? 3.0 : 0.0);
    float total = 0.0f, number = 0.0f;
    assert_false(aur_candidate_wins(0.0f, &total, &number));
    assert_true(aur_candidate_weight((aur_vector){NAN, 1.0f, 1.0f}) == 0.0f);
}

/* --- images */

enum { SIDE = 16, PIXELS = SIDE * SIDE, SAMPLES = 16, SEEDS = 64 };

static const char floor_of[] =
    "<shape type='rectangle'><transform name='to_world'><scale value='50'/><rotate x='1' angle='-90'/>"
    "<translate y='-1'/></transform>%s</shape>";

/* Glossy bodies, one of them metal, that stand on a glossy floor and throw shadows. None is plain to the
 * vector code, so packets shade them like single paths. */
static const char bodies[] =
    "<shape type='sphere'><point name='center' x='-.8' y='-.2' z='5'/><float name='radius' value='.8'/>"
    "<bsdf type='roughconductor'><float name='alpha' value='.2'/></bsdf></shape>"
    "<shape type='sphere'><point name='center' x='.9' y='-.4' z='4.5'/><float name='radius' value='.6'/>"
    "<bsdf type='plastic'><rgb name='diffuse_reflectance' value='.7,.3,.2'/></bsdf></shape>";
static const char glossy[] = "<bsdf type='roughplastic'><float name='alpha' value='.2'/></bsdf>";
static const char diffuse[] = "<bsdf type='diffuse'/>";
/* A block that the vector code can do. */
static const char block[] = "<shape type='cube'><transform name='to_world'><scale value='.7'/><translate "
                            "x='.3' y='-.3' z='5'/></transform>"
                            "<bsdf type='diffuse'/></shape>";
static const char sky[] = "<emitter type='envmap'><string name='filename' value='sky.pfm'/></emitter>";
/* Emitters of every sampling method, two of which no ray can hit. */
static const char visible[] =
    "<shape type='sphere'><point name='center' x='1' y='2' z='4'/><float name='radius' value='.2'/>"
    "<emitter type='area'><rgb name='radiance' value='30,20,10'/></emitter></shape>"
    "<shape type='rectangle'><transform name='to_world'><scale value='.5'/><rotate x='1' angle='90'/>"
    "<translate x='-1' y='2' z='5'/></transform><emitter type='area'><rgb name='radiance' "
    "value='5,10,15'/></emitter></shape>"
    "<shape type='cube'><transform name='to_world'><scale value='.1'/><translate x='2' y='0' "
    "z='5'/></transform><emitter type='area'><rgb name='radiance' value='20'/></emitter></shape>"
    "<emitter type='point'><point name='position' x='0' y='3' z='3'/><rgb name='intensity' "
    "value='5'/></emitter>"
    "<emitter type='directional'><vector name='direction' x='.5' y='-1' z='.3'/><rgb name='irradiance' "
    "value='.3'/></emitter>";

/* A sky that is brighter at the horizon, with one spot that has some half of its power. */
static void write_sky(void) {
    enum { WIDTH = 32, HEIGHT = 16 };
    char file[64 + sizeof(float[3]) * WIDTH * HEIGHT];
    size_t used = (size_t)snprintf(file, sizeof file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    for (size_t j = 0; j < HEIGHT; ++j) /* from below */
        for (size_t i = 0; i < WIDTH; ++i) {
            const float height = ((float)j + 0.5f) / HEIGHT;
            const float value = i == 5 && j == 12 ? 150.0f : 0.2f + 2.0f * height * (1.0f - height);
            const float rgb[3] = {value, value, 1.2f * value};
            memcpy(file + used, rgb, sizeof rgb);
            used += sizeof rgb;
        }
    write_file("sky.pfm", file, used);
}

/* A scene on a floor of a material. */
typedef struct stage {
    aur_scene *scene;
    aur_renderer *renderer;
} stage;

static stage open_stage(const char *material, const char *rest, const char *lights) {
    char body[8192];
    write_sky();
    int used = snprintf(body, sizeof body, floor_of, material);
    used += snprintf(body + used, sizeof body - (size_t)used, "%s%s", rest, lights);
    assert_true(used < (int)sizeof body);
    stage s = {.scene = must_load_body(body)};
    assert_int_equal(aur_renderer_create(s.scene, &s.renderer, NULL), AUR_OK);
    return s;
}

static void close_stage(stage *s) {
    aur_renderer_destroy(s->renderer);
    aur_scene_destroy(s->scene);
}

/* RGB of all pixels; number of rays. */
static uint64_t render(const stage *s, const char *integrator, size_t seed, float pixels[3 * PIXELS]) {
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = SIDE;
    options.filter = "box";
    options.sampler = "sobol";
    options.integrator = integrator;
    options.samples_per_pixel = SAMPLES;
    options.seed = seed;
    options.threads = 1;
    aur_render_statistics statistics = {.size = sizeof statistics};
    aur_image *image = NULL;
    assert_int_equal(aur_renderer_render(s->renderer, &options, &image, &statistics, NULL), AUR_OK);
    assert_int_equal(aur_image_channel_count(image), 3);
    memcpy(pixels, aur_image_data(image), sizeof(float[3 * PIXELS]));
    aur_image_destroy(image);
    return statistics.rays;
}

static double sum_of(const float pixels[3 * PIXELS]) {
    double sum = 0.0;
    for (size_t i = 0; i < (size_t)3 * PIXELS; ++i)
        sum += (double)pixels[i];
    return sum;
}

/* Whole images with and without candidates, in pairs of one seed: the mean of 64 differences over its
 * standard error is Student's t with 63 degrees of freedom, beyond 4 one time in 5,900. The images determine
 * the mean to half a percent, so a bias of 2 % is found. */
static void assert_same_mean(const stage *s, const char *without, const char *with) {
    double sum = 0.0, squares = 0.0, whole = 0.0;
    for (size_t seed = 0; seed < SEEDS; ++seed) {
        float a[3 * PIXELS], b[3 * PIXELS];
        render(s, without, seed, a);
        render(s, with, seed, b);
        const double off = sum_of(b) - sum_of(a);
        whole += sum_of(a);
        sum += off;
        squares += off * off;
    }
    const double error = sqrt((squares - sum * sum / SEEDS) / (SEEDS - 1) * SEEDS);
    print_message("%s: off by %.3f %% +- %.3f\n", with, 100.0 * sum / whole, 100.0 * error / whole);
    assert_true(fabs(sum) < 4.0 * error);
    assert_true(error < 0.005 * whole);
}

static void means_are_those_of_one_candidate(void **state) {
    (void)state;
    if (check_short())
        skip();
    const char *const stages[][3] = {{glossy, bodies, sky}, {glossy, bodies, visible}, {diffuse, block, sky}};
    for (size_t i = 0; i < 3; ++i) {
        stage s = open_stage(stages[i][0], stages[i][1], stages[i][2]);
        assert_same_mean(&s, "path:max_depth=4", "path:max_depth=4,candidates=4");
        assert_same_mean(&s, "path:max_depth=2,packets=false", "path:max_depth=2,packets=false,candidates=4");
        assert_same_mean(&s, "path:max_depth=3,interleaved=true",
                         "path:max_depth=3,interleaved=true,candidates=3");
        close_stage(&s);
    }
}

/* The mean over the floor's pixels of the variance over seeds. */
static double variance_of(const stage *s, const char *integrator) {
    double sum[PIXELS] = {0}, squares[PIXELS] = {0}, variance = 0.0;
    for (size_t seed = 0; seed < SEEDS; ++seed) {
        float pixels[3 * PIXELS];
        render(s, integrator, seed, pixels);
        for (size_t i = 0; i < PIXELS; ++i) {
            const double value = (double)pixels[3 * i + 1];
            sum[i] += value;
            squares[i] += value * value;
        }
    }
    for (size_t i = PIXELS / 2 + SIDE; i < PIXELS; ++i)
        variance += (squares[i] - sum[i] * sum[i] / SEEDS) / (SEEDS - 1);
    return variance / (PIXELS / 2 - SIDE);
}

/* If nothing hides the sky, candidates include the material and the cosine in the pdf. The ratios of a
 * diffuse floor are .55 for two and .62 from two to four; a mean of 112 variances of 64 values each has an
 * error of some 5 %, so the limit of .8 is far from noise. A glossy material finds most of the sky itself. */
static void variance_falls_under_an_open_sky(void **state) {
    (void)state;
    if (check_short())
        skip();
    const char *const materials[] = {diffuse, glossy};
    const double limits[] = {0.8, 0.95};
    for (size_t i = 0; i < 2; ++i) {
        stage s = open_stage(materials[i], "", sky);
        const double one = variance_of(&s, "path:max_depth=2");
        const double two = variance_of(&s, "path:max_depth=2,candidates=2");
        const double four = variance_of(&s, "path:max_depth=2,candidates=4");
        print_message("%s: variance %.3g, of two %.2f, of four %.2f of it\n", materials[i], one, two / one,
                      four / one);
        assert_true(two < limits[i] * one && four < limits[i] * two);
        close_stage(&s);
    }
}

static void assert_same_bits(const stage *s, const char *one, const char *other) {
    float a[3 * PIXELS], b[3 * PIXELS];
    render(s, one, 1, a); /* which learns where emitters are for the following renders */
    const uint64_t rays = render(s, one, 1, a);
    assert_int_equal(render(s, other, 1, b), rays);
    assert_memory_equal(a, b, sizeof a);
}

static void packets_are_single_paths(void **state) {
    (void)state;
    const char *const lights[] = {sky, visible};
    for (size_t i = 0; i < 2; ++i) {
        stage s = open_stage(glossy, bodies, lights[i]);
        assert_same_bits(&s, "path:candidates=3", "path:candidates=3,packets=false");
        assert_same_bits(&s, "path:candidates=64,rr_depth=1", "path:candidates=64,rr_depth=1,packets=false");
        close_stage(&s);
    }
}

static void one_candidate_is_as_without(void **state) {
    (void)state;
    const char *const lights[] = {sky, visible};
    for (size_t i = 0; i < 2; ++i) {
        stage s = open_stage(i == 0 ? glossy : diffuse, i == 0 ? bodies : block, lights[i]);
        assert_same_bits(&s, "path", "path:candidates=1");
        assert_same_bits(&s, "path:packets=false", "path:packets=false,candidates=1");
        assert_same_bits(&s, "path:interleaved=true", "path:interleaved=true,candidates=1");
        close_stage(&s);
    }
}

/* A surface has one shadow ray at most, however many candidates there are, and none where all are black. */
static void one_shadow_ray_at_a_surface(void **state) {
    (void)state;
    static const uint64_t samples = SAMPLES * PIXELS;
    float pixels[3 * PIXELS];
    stage lit = open_stage(glossy, bodies, visible);
    const uint64_t one = render(&lit, "path:max_depth=2,lamp_rays=0", 1, pixels);
    const uint64_t many = render(&lit, "path:max_depth=2,lamp_rays=0,candidates=16", 1, pixels);
    assert_true(one <= many && many <= 3 * samples);
    close_stage(&lit);
    /* An emitter facing away from the floor. */
    stage dark = open_stage(diffuse, "",
                            "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='-90'/>"
                            "<translate y='9' z='3'/></transform><emitter type='area'/></shape>");
    assert_same_bits(&dark, "path:max_depth=2", "path:max_depth=2,candidates=5");
    assert_same_bits(&dark, "path:max_depth=2,packets=false", "path:max_depth=2,packets=false,candidates=5");
    assert_true(render(&dark, "path:max_depth=2,candidates=5", 1, pixels) <= 2 * samples);
    assert_true(sum_of(pixels) == 0.0);
    close_stage(&dark);
}

static void reports_numbers_out_of_range(void **state) {
    (void)state;
    stage s = open_stage(glossy, "", sky);
    static const char *const wrong[] = {"path:candidates=0", "path:candidates=65", "path:candidates=1.5"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        aur_render_options options = {.size = sizeof options};
        aur_render_options_init(&options, NULL);
        options.integrator = wrong[i];
        aur_image *image = NULL;
        aur_error error = {0};
        assert_int_not_equal(aur_renderer_render(s.renderer, &options, &image, NULL, &error), AUR_OK);
        assert_non_null(strstr(error.message, "candidates"));
    }
    close_stage(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shifted_numbers_stay_below_one),
        cmocka_unit_test(what_is_left_of_a_number_stays_below_one),
        cmocka_unit_test(candidates_are_chosen_in_proportion),
        cmocka_unit_test(means_are_those_of_one_candidate),
        cmocka_unit_test(variance_falls_under_an_open_sky),
        cmocka_unit_test(packets_are_single_paths),
        cmocka_unit_test(one_candidate_is_as_without),
        cmocka_unit_test(one_shadow_ray_at_a_surface),
        cmocka_unit_test(reports_numbers_out_of_range),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
