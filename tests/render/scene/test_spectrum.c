/* Spectra against the colours that Mitsuba 3.9.1 (scalar_rgb) has for them. */
#include "scene_text.h"

#include "render/scene/load/spectrum.h"

typedef struct golden {
    const char *text;
    double reflects[3], emits[3];
} golden;

static const golden goldens[] = {
    {"400:.1, 500:.5, 700:.9", {0.7754048, 0.5935085, 0.27703336}, {0.9179225, 0.56548786, 0.24160519}},
    {"550:.1 560:.5", {0.00559538, 0.04046516, 0.0}, {0.00550141, 0.03943831, 0.0}},
    {"400:3,500:2,700:4", {1.0, 1.0, 1.0}, {4.08231, 2.235688, 2.2209883}},
    {"400:.1, 430:.2, 700:.9", {0.74696225, 0.49289274, 0.22652227}, {0.87782717, 0.46985886, 0.19788375}},
    {"300:1, 900:1", {0.9989853, 0.9988737, 0.9988016}, {1.2048837, 0.9482282, 0.9092668}},
};

/* Mitsuba adds a thousand terms in single precision, and each sum rounds by 2^-24 of at most the whole;
 * sRGB's matrix has factors up to 3.3 of them. */
static const double rounding = 1000 * 3.3 / (1 << 24);

static void agrees_with_mitsuba(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof goldens / sizeof goldens[0]; ++i) {
        double rgb[3];
        for (size_t emits = 0; emits < 2; ++emits) {
            const aur_spectrum_use use = emits == 1 ? AUR_SPECTRUM_EMITS : AUR_SPECTRUM_REFLECTS;
            assert_int_equal(aur_spectrum_parse(goldens[i].text, (aur_location){0}, use, rgb, NULL), AUR_OK);
            aur_spectrum_clamp(use, rgb);
            for (size_t k = 0; k < 3; ++k)
                assert_near(rgb[k], emits == 1 ? goldens[i].emits[k] : goldens[i].reflects[k],
                            rounding * fmax(1.0, goldens[i].emits[0]));
        }
    }
}

/* The radiance that a scene's environment has by this <spectrum>. */
static aur_vector environment(const char *spectrum) {
    char body[512];
    snprintf(body, sizeof body, "<emitter type='constant'>%s</emitter>", spectrum);
    aur_scene *const scene = must_load_body(body);
    const aur_ray ray = {{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, INFINITY};
    const aur_vector radiance = aur_scene_environment(scene, ray.direction);
    aur_scene_destroy(scene);
    return radiance;
}

static void makes_colours_by_type(void **state) {
    (void)state;
    static const char pairs[] = "<spectrum name='radiance' value='400:1, 550:2, 700:3'/>";
    static const char *const same[] = {
        "<spectrum name='radiance' type='regular'><float name='wavelength_min' value='400'/><float "
        "name='wavelength_max' value='700'/><string name='values' value='1,2,3'/></spectrum>",
        "<spectrum name='radiance' type='irregular'><string name='wavelengths' value='400 550 700'/><string "
        "name='values' value='1, 2, 3'/></spectrum>",
        "<spectrum name='radiance' filename='s.spd'/>"};
    write_text("s.spd", "# a lamp\n400 1\n550, 2 # middle\n\n700 3");
    const aur_vector expected = environment(pairs);
    assert_true(expected.x > expected.y && expected.y > expected.z && expected.z > 0.0f);
    for (size_t i = 0; i < sizeof same / sizeof same[0]; ++i) {
        const aur_vector got = environment(same[i]);
        assert_memory_equal(&got, &expected, sizeof got);
    }
    const aur_vector grey =
        environment("<spectrum name='radiance' type='d65'><float name='scale' value='2'/></spectrum>");
    assert_true(grey.x == 2.0f && grey.y == 2.0f && grey.z == 2.0f);
    const aur_vector srgb =
        environment("<spectrum name='radiance' type='srgb'><rgb name='color' value='1 2 3'/></spectrum>");
    assert_true(srgb.x == 1.0f && srgb.y == 2.0f && srgb.z == 3.0f);
    /* One number for a light is the illuminant E: sRGB's matrix times (1, 1, 1). */
    const aur_vector equal = environment("<spectrum name='radiance' value='1'/>");
    assert_near(equal.x, 3.240479 - 1.537150 - 0.498535, 1e-6);
    assert_near(equal.z, 0.055648 - 0.204043 + 1.057311, 1e-6);
}

/* Mitsuba 3.9.1 in its spectral mode, 64 x 64 pixels of 64 samples each: the means, and 4.5 standard errors.
 * Sums of 1,000 terms over 999 steps are .1 % below. */
static void glows_by_temperature(void **state) {
    (void)state;
    static const struct {
        const char *kelvins;
        double rgb[3], error[3];
    } rows[] = {{"3000", {733.881, 349.913, 112.798}, {0.264, 0.0456, 0.138}},
                {"5000", {15278.7, 12094.7, 9599.75}, {4.81, 0.469, 10.7}}};
    for (size_t i = 0; i < 2; ++i) {
        char text[256];
        snprintf(
            text, sizeof text,
            "<spectrum name='radiance' type='blackbody'><float name='temperature' value='%s'/></spectrum>",
            rows[i].kelvins);
        const aur_vector got = environment(text);
        const double channels[3] = {got.x, got.y, got.z};
        for (size_t k = 0; k < 3; ++k)
            assert_near(channels[k] / 0.999, rows[i].rgb[k], 4.5 * rows[i].error[k]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_mitsuba),
        cmocka_unit_test(makes_colours_by_type),
        cmocka_unit_test(glows_by_temperature),
    };
    return cmocka_run_group_tests_name("scene/spectrum", tests, enter_folder, leave_folder);
}
