/* Light in media, against closed forms: Beer-Lambert law, furnaces, single scattering from a point light, and
 * the reflection of a half-space (Chandrasekhar's H). */
#include "render/scene/scene_text.h"
#include "render/scene/vol_file.h"

#include <aureole-render/render.h>
#include <aureole/statistics.h>
#include <string.h>

enum { SIDE = 12, PIXELS = SIDE * SIDE, SEEDS = 24 };

static void render(const aur_scene *scene, const char *integrator, size_t samples, uint64_t seed,
                   size_t threads, float pixels[PIXELS][3]) {
    aur_renderer *renderer;
    assert_int_equal(aur_renderer_create(scene, &renderer, NULL), AUR_OK);
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.integrator = integrator;
    options.sampler = "sobol";
    options.filter = "box";
    options.samples_per_pixel = samples;
    options.seed = seed;
    options.width = options.height = SIDE;
    options.threads = threads;
    aur_image *image;
    aur_error error = {0};
    if (aur_renderer_render(renderer, &options, &image, NULL, &error) != AUR_OK)
        fail_msg("%s", error.message);
    const size_t channels = aur_image_channel_count(image);
    for (size_t i = 0; i < PIXELS; ++i)
        for (size_t k = 0; k < 3; ++k)
            pixels[i][k] = aur_image_data(image)[i * channels + k];
    aur_image_destroy(image);
    aur_renderer_destroy(renderer);
}

static aur_scene *load(const char *text) {
    aur_scene *scene;
    aur_error error = {0};
    if (aur_scene_load(write_text("s.xml", text), NULL, &scene, &error) != AUR_OK)
        fail_msg("%s", error.message);
    return scene;
}

/* The mean over the image of channel k, and its standard error, from SEEDS images. */
static double mean_of(const aur_scene *scene, const char *integrator, size_t samples, size_t channel,
                      double *deviation) {
    static float pixels[PIXELS][3];
    double mean = 0.0, square = 0.0;
    for (size_t s = 0; s < SEEDS; ++s) {
        double sum = 0.0;
        render(scene, integrator, samples, s + 1, 2, pixels);
        for (size_t i = 0; i < PIXELS; ++i)
            sum += (double)pixels[i][channel] / PIXELS;
        mean += sum / SEEDS;
        square += sum * sum / SEEDS;
    }
    *deviation = sqrt(fmax(square - mean * mean, 0.0) / (SEEDS - 1));
    return mean;
}

/* Exceeded by noise once in ten thousand comparisons. */
static void assert_mean(double mean, double deviation, double expected, const char *what) {
    const double most = aur_student_quantile(SEEDS - 1, 1.0 - 0.00005);
    if (!(fabs(mean - expected) <= most * deviation + 1e-6 * expected))
        fail_msg("%s: %g is %g deviations from %g", what, mean, fabs(mean - expected) / deviation, expected);
}

#define SKY "<emitter type='constant'><rgb name='radiance' value='0.5 0.25 1'/></emitter>"
#define CAMERA(more)                                                                                         \
    "<sensor type='perspective'><float name='fov' value='20'/><transform name='to_world'><lookat "           \
    "origin='0.3, 0.2, 4' target='0, 0, 0' up='0, 1, 0'/></transform>" more "</sensor>"
#define FLAT_CAMERA                                                                                          \
    "<sensor type='orthographic'><transform name='to_world'><scale value='0.1'/><lookat origin='0, 0, 4' "   \
    "target='0, 0, 0' up='0, 1, 0'/></transform></sensor>"

/* Pure absorption attenuates by exp(-sigma d) without noise, for camera rays and for light through it: a cube
 * two wide in front of the sky, and one over a floor under a sun. */
static void absorbs_by_beer_and_lambert(void **state) {
    (void)state;
    static const char medium[] = "<shape type='cube'><bsdf type='null'/><medium name='interior' "
                                 "type='homogeneous'><float name='albedo' value='0'/><rgb name='sigma_t' "
                                 "value='0.5 1 2'/><float name='scale' value='0.5'/></medium></shape>";
    char text[4096];
    float pixels[PIXELS][3], bare[PIXELS][3];
    snprintf(text, sizeof text, "<scene version='3.0.0'>" FLAT_CAMERA SKY "%s</scene>", medium);
    aur_scene *scene = load(text);
    render(scene, "volpath", 4, 1, 1, pixels);
    aur_scene_destroy(scene);
    static const double sky[] = {0.5, 0.25, 1.0}, depths[] = {0.5, 1.0, 2.0};
    for (size_t i = 0; i < PIXELS; ++i)
        for (size_t k = 0; k < 3; ++k)
            assert_relative((double)pixels[i][k], sky[k] * exp(-depths[k]), 2e-6);
    /* The sun shines through the cube, and the camera looks along below it. */
    static const char sun[] =
        "<emitter type='directional'><vector name='direction' x='0' y='-1' z='0'/><rgb name='irradiance' "
        "value='1'/></emitter><sensor type='perspective'><float name='fov' value='1'/><transform "
        "name='to_world'><lookat origin='0, -1.5, 4' target='0, -2, 0' up='0, 1, "
        "0'/></transform></sensor><shape type='rectangle'><transform name='to_world'><rotate x='1' "
        "angle='-90'/><translate y='-2'/></transform></shape>";
    snprintf(text, sizeof text, "<scene version='3.0.0'>%s%s</scene>", sun, medium);
    scene = load(text);
    render(scene, "volpath", 4, 1, 1, pixels);
    aur_scene_destroy(scene);
    snprintf(text, sizeof text, "<scene version='3.0.0'>%s</scene>", sun);
    scene = load(text);
    render(scene, "volpath", 4, 1, 1, bare);
    aur_scene_destroy(scene);
    for (size_t i = 0; i < PIXELS; ++i)
        for (size_t k = 0; k < 3; ++k) {
            assert_true(bare[i][k] > 0.1f);
            assert_relative((double)pixels[i][k], (double)bare[i][k] * exp(-depths[k]), 2e-6);
        }
}

#define BLEND                                                                                                \
    "<phase type='blendphase'><float name='weight' value='0.3'/><phase type='hg'/><phase type='rayleigh'/>"  \
    "</phase>"

static const char *const phases[] = {
    "<phase type='isotropic'/>", "<phase type='hg'><float name='g' value='0.7'/></phase>",
    "<phase type='rayleigh'/>", "<phase type='tabphase'><string name='values' value='1 0 2'/></phase>",
    BLEND};

/* Where nothing is absorbed and the sky is the same all round, every path without roulette brings the sky's
 * radiance: exactly, where extinction has no colour and points on lights are not drawn. Through glass the
 * roundings of the squared index come in. */
static void furnaces_are_exact(void **state) {
    (void)state;
    static const char *const boundaries[] = {"null", "dielectric"};
    static const double tolerances[] = {0.0, 1e-6};
    float pixels[PIXELS][3];
    for (size_t p = 0; p < sizeof phases / sizeof phases[0]; ++p)
        for (size_t b = 0; b < 2; ++b) {
            char text[4096];
            snprintf(
                text, sizeof text,
                "<scene version='3.0.0'>" CAMERA("") SKY
                "<shape type='sphere'><bsdf type='%s'/><medium name='interior' type='homogeneous'><float "
                "name='albedo' value='1'/><float name='sigma_t' value='2'/><boolean "
                "name='sample_emitters' value='false'/>%s</medium></shape></scene>",
                boundaries[b], phases[p]);
            aur_scene *const scene = load(text);
            render(scene, "volpath:rr_depth=100000", 4, 1, 1, pixels);
            aur_scene_destroy(scene);
            for (size_t i = 0; i < PIXELS; ++i)
                assert_relative((double)pixels[i][2], 1.0, tolerances[b]);
        }
}

/* With coloured extinction, roulette and points on lights the mean is the sky's. */
static void furnaces_are_right_in_the_mean(void **state) {
    (void)state;
    static const char *const extinctions[] = {"2", "0.5 1 3"};
    for (size_t p = 0; p < sizeof phases / sizeof phases[0]; ++p) {
        char text[4096];
        snprintf(text, sizeof text,
                 "<scene version='3.0.0'>" CAMERA("") SKY
                 "<shape type='sphere'><bsdf type='%s'/><medium name='interior' type='homogeneous'><float "
                 "name='albedo' value='1'/><rgb name='sigma_t' value='%s'/>%s</medium></shape></scene>",
                 p == 3 ? "dielectric" : "null", extinctions[p % 2], phases[p]);
        aur_scene *const scene = load(text);
        double deviation;
        const double mean = mean_of(scene, "volpath:rr_depth=4", 8, 2, &deviation);
        aur_scene_destroy(scene);
        assert_mean(mean, deviation, 1.0, phases[p]);
    }
}

/* A point light of intensity I near a ray: the single-scattered radiance along the ray from 0 to `length` is
 * the integral of albedo sigma p(cos) I exp(-sigma (t + r)) / r^2, here by Simpson's rule. */
static double single_scattering(double sigma, double albedo, double g, double along, double lateral,
                                double length) {
    enum { STEPS = 20000 };
    double sum = 0.0;
    for (size_t i = 0; i <= STEPS; ++i) {
        const double t = length * (double)i / STEPS, r = hypot(along - t, lateral);
        /* Light goes from the point to the ray, and on against the ray's direction. */
        const double cosine = (along - t) / r;
        const double phase =
            (1.0 - g * g) / (4.0 * 3.14159265358979323846 * pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
        const double weight = i == 0 || i == STEPS ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        sum += weight * albedo * sigma * phase * exp(-sigma * (t + r)) / (r * r);
    }
    return sum * length / STEPS / 3.0;
}

/* The camera looks along a narrow beam at a black wall 5 away; the light is 1.5 off the beam, 2 along. */
static void scatters_once_as_the_integral_says(void **state) {
    (void)state;
    static const double g = 0.4, albedo = 0.8, sigmas[] = {0.2, 0.3, 0.6};
    aur_scene *const scene = load(
        "<scene version='3.0.0'><medium type='homogeneous' id='fog'><float name='albedo' value='0.8'/><rgb "
        "name='sigma_t' value='0.2 0.3 0.6'/><phase type='hg'><float name='g' value='0.4'/></phase></medium>"
        "<sensor type='orthographic'><float name='near_clip' value='0'/><transform name='to_world'><scale "
        "x='1e-4' y='1e-4'/><lookat origin='0, 0, 0' target='0, 0, 1' up='0, 1, 0'/></transform><ref "
        "id='fog'/></sensor><emitter type='point'><point name='position' x='0' y='1.5' z='2'/><rgb "
        "name='intensity' value='1'/></emitter><shape type='rectangle'><transform name='to_world'><rotate "
        "y='1' angle='180'/><translate z='5'/></transform><bsdf type='diffuse'><float name='reflectance' "
        "value='0'/></bsdf></shape></scene>");
    for (size_t k = 0; k < 3; ++k) {
        double deviation;
        const double mean = mean_of(scene, "volpath:max_depth=2", 16, k, &deviation);
        assert_mean(mean, deviation, single_scattering(sigmas[k], albedo, g, 2.0, 1.5, 5.0),
                    "one scattering");
        assert_true(deviation < 0.01 * mean);
    }
    aur_scene_destroy(scene);
}

/* Chandrasekhar's H for isotropic scattering (Radiative Transfer 1950, chapter V), at `mu`: the iteration 1 /
 * H = sqrt(1 - a) + a / 2 * integral of m H(m) / (mu + m), by the midpoint rule. */
static double chandrasekhar(double albedo, double mu) {
    enum { NODES = 400 };
    static double h[NODES];
    double last = 1.0;
    for (size_t i = 0; i < NODES; ++i)
        h[i] = 1.0;
    for (size_t round = 0; round < 200; ++round)
        for (size_t i = 0; i <= NODES; ++i) {
            const double at = i < NODES ? ((double)i + 0.5) / NODES : mu;
            double sum = 0.0;
            for (size_t k = 0; k < NODES; ++k) {
                const double m = ((double)k + 0.5) / NODES;
                sum += m * h[k] / (at + m) / NODES;
            }
            *(i < NODES ? &h[i] : &last) = 1.0 / (sqrt(1.0 - albedo) + 0.5 * albedo * sum);
        }
    return last;
}

/* Under an even sky a half-space shows 1 - sqrt(1 - a) H(mu) of it, by reciprocity with its plane albedo. */
static void half_space_reflects_by_h(void **state) {
    (void)state;
    static const double albedos[] = {0.5, 0.9};
    static const double mus[] = {1.0, 0.4472135954999579};
    static const char *const origins[] = {"0, 0.0001, 5", "0, 8, 4"};
    for (size_t a = 0; a < 2; ++a)
        for (size_t m = 0; m < 2; ++m) {
            char text[4096];
            snprintf(
                text, sizeof text,
                "<scene version='3.0.0'><emitter type='constant'/><sensor type='orthographic'><transform "
                "name='to_world'><scale value='0.1'/><lookat origin='%s' target='0, 0, 0' up='0, 1, "
                "0'/></transform></sensor><shape type='rectangle'><transform name='to_world'><scale "
                "value='1000'/></transform><bsdf type='null'/><medium name='interior' "
                "type='homogeneous'><float name='albedo' value='%g'/></medium></shape></scene>",
                origins[m], albedos[a]);
            aur_scene *const scene = load(text);
            double deviation;
            const double mean = mean_of(scene, "volpath", 8, 0, &deviation);
            aur_scene_destroy(scene);
            const double expected = 1.0 - sqrt(1.0 - albedos[a]) * chandrasekhar(albedos[a], mus[m]);
            assert_mean(mean, deviation, expected, "half-space");
            assert_true(deviation < 0.01 * expected);
        }
}

/* Writes grid.vol: extinction that grows along x, 0, 1, ..., 7 in a row of voxels, and is `others` times that
 * in the second and third channel. */
static void write_ramp(float second, float third) {
    float values[8][3];
    for (size_t i = 0; i < 8; ++i) {
        values[i][0] = (float)i;
        values[i][1] = second * (float)i;
        values[i][2] = third * (float)i;
    }
    size_t size;
    char *const bytes = vol_bytes(8, 1, 1, 3, &values[0][0], &size);
    write_file("grid.vol", bytes, size);
    free(bytes);
}

#define GRID_BOX(more)                                                                                       \
    "<shape type='cube'><bsdf type='null'/><medium name='interior' type='heterogeneous'><volume "            \
    "name='sigma_t' type='gridvolume'><string name='filename' value='grid.vol'/><transform "                 \
    "name='to_world'><scale value='2'/><translate x='-1' y='-1' z='-1'/></transform></volume><float "        \
    "name='scale' value='0.3'/>" more "</medium></shape>"

/* Along x, the cube of width 2 has the mean of its voxels, 3.5, preserved by interpolation with clamped ends;
 * pure absorption is estimated by ratio tracking. */
static void grids_absorb_by_their_integral(void **state) {
    (void)state;
    write_ramp(0.5f, 0.2f);
    aur_scene *const scene =
        load("<scene version='3.0.0'><emitter type='constant'/><sensor "
             "type='orthographic'><transform name='to_world'><scale value='0.5'/><lookat "
             "origin='4, 0, 0' target='0, 0, 0' up='0, 1, 0'/></transform></sensor>" GRID_BOX(
                 "<float name='albedo' value='0'/>") "</scene>");
    static const double factors[] = {1.0, 0.5, 0.2};
    for (size_t k = 0; k < 3; ++k) {
        double deviation;
        const double mean = mean_of(scene, "volpath", 16, k, &deviation);
        assert_mean(mean, deviation, exp(-0.3 * 3.5 * 2.0 * factors[k]), "a ramp of extinction");
        assert_true(deviation < 0.02 * mean);
    }
    aur_scene_destroy(scene);
}

/* Furnaces of a grid: without colour to the bit, with colour and lights that are drawn in the mean. */
static void grids_are_furnaces(void **state) {
    (void)state;
    float pixels[PIXELS][3];
    write_ramp(1.0f, 1.0f);
    aur_scene *scene = load("<scene version='3.0.0'>" CAMERA("") SKY GRID_BOX(
        "<float name='albedo' value='1'/><boolean name='sample_emitters' value='false'/>") "</scene>");
    render(scene, "volpath:rr_depth=100000", 4, 1, 1, pixels);
    aur_scene_destroy(scene);
    for (size_t i = 0; i < PIXELS; ++i)
        assert_true(pixels[i][0] == 0.5f && pixels[i][1] == 0.25f && pixels[i][2] == 1.0f);
    write_ramp(0.6f, 0.3f);
    scene = load("<scene version='3.0.0'>" CAMERA("")
                     SKY GRID_BOX("<float name='albedo' value='1'/>") "</scene>");
    static const double sky[] = {0.5, 0.25, 1.0};
    for (size_t k = 0; k < 3; ++k) {
        double deviation;
        const double mean = mean_of(scene, "volpath:rr_depth=4", 8, k, &deviation);
        assert_mean(mean, deviation, sky[k], "a furnace of a grid");
    }
    aur_scene_destroy(scene);
}

/* A grid of equal voxels is a homogeneous medium, tracked as such: a light source in the sky over a floor,
 * seen and lit through it. */
static void even_grids_are_homogeneous(void **state) {
    (void)state;
    static const float values[8] = {1.5f, 1.5f, 1.5f, 1.5f, 1.5f, 1.5f, 1.5f, 1.5f};
    static const char stage[] =
        "<emitter type='directional'><vector name='direction' x='0.4' y='-1' z='0.1'/></emitter><shape "
        "type='rectangle'><transform name='to_world'><scale value='3'/><rotate x='1' angle='-90'/><translate "
        "y='-1.1'/></transform></shape><shape type='sphere'><transform name='to_world'><scale "
        "value='0.3'/><translate y='1.6'/></transform><emitter type='area'/></shape>";
    size_t size;
    char *const bytes = vol_bytes(2, 2, 2, 1, values, &size);
    write_file("grid.vol", bytes, size);
    free(bytes);
    aur_scene *grid, *even;
    char text[4096];
    snprintf(text, sizeof text, "<scene version='3.0.0'>" CAMERA("") "%s" GRID_BOX("") "</scene>", stage);
    grid = load(text);
    snprintf(text, sizeof text,
             "<scene version='3.0.0'>" CAMERA("") "%s<shape type='cube'><bsdf type='null'/><medium "
                                                  "name='interior' type='homogeneous'><float name='sigma_t' "
                                                  "value='0.45'/></medium></shape></scene>",
             stage);
    even = load(text);
    double a, b;
    const double mean = mean_of(grid, "volpath", 16, 1, &a), expected = mean_of(even, "volpath", 16, 1, &b);
    assert_mean(mean, hypot(a, b), expected, "an even grid");
    static float one[PIXELS][3], three[PIXELS][3];
    render(grid, "volpath", 4, 5, 1, one);
    render(grid, "volpath", 4, 5, 3, three);
    assert_memory_equal(one, three, sizeof one);
    aur_scene_destroy(grid);
    aur_scene_destroy(even);
}

/* Without media, volpath has the light of path, through masks too, which its shadow rays pass. */
static void without_media_it_is_path(void **state) {
    (void)state;
    aur_scene *const scene =
        load("<scene version='3.0.0'>" CAMERA("") SKY
             "<shape type='sphere'><transform name='to_world'><scale value='0.5'/></transform><bsdf "
             "type='plastic'/></shape><shape type='cube'><bsdf type='mask'><float name='opacity' "
             "value='0.4'/><bsdf type='twosided'><bsdf type='diffuse'/></bsdf></bsdf></shape><shape "
             "type='sphere'><transform name='to_world'><scale value='0.2'/><translate x='0.2' y='0.4' "
             "z='0.9'/></transform><emitter type='area'><rgb name='radiance' "
             "value='3'/></emitter></shape></scene>");
    double a, b;
    const double mean = mean_of(scene, "volpath", 32, 1, &a), expected = mean_of(scene, "path", 32, 1, &b);
    assert_mean(mean, hypot(a, b), expected, "volpath against path");
    aur_scene_destroy(scene);
}

/* The same bits on any number of threads. */
static void threads_change_nothing(void **state) {
    (void)state;
    aur_scene *const scene =
        load("<scene version='3.0.0'>" CAMERA("") SKY
             "<shape type='sphere'><bsdf type='null'/><medium name='interior' "
             "type='homogeneous'><rgb name='sigma_t' value='1 2 3'/></medium></shape></scene>");
    static float one[PIXELS][3], three[PIXELS][3];
    render(scene, "volpath", 4, 5, 1, one);
    render(scene, "volpath", 4, 5, 3, three);
    assert_memory_equal(one, three, sizeof one);
    render(scene, "volpathmis", 4, 5, 3, three);
    assert_memory_equal(one, three, sizeof one);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(absorbs_by_beer_and_lambert),
        cmocka_unit_test(furnaces_are_exact),
        cmocka_unit_test(furnaces_are_right_in_the_mean),
        cmocka_unit_test(scatters_once_as_the_integral_says),
        cmocka_unit_test(half_space_reflects_by_h),
        cmocka_unit_test(grids_absorb_by_their_integral),
        cmocka_unit_test(grids_are_furnaces),
        cmocka_unit_test(even_grids_are_homogeneous),
        cmocka_unit_test(without_media_it_is_path),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
