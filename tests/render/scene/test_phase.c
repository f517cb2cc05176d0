/* Phase functions: each integrates to 1, its samples have its pdf, and its values are those of Mitsuba 3.9.1
 * or of its formula. */
#include "check.h"

#include <string.h>

#include "render/scene/phase.h"

static const aur_location nowhere = {.file = "test", .line = 1};
static const aur_vector origin = {0};

static aur_phase *make(const char *plugin, const char *key, const char *value) {
    aur_parameters parameters;
    aur_error error = {0};
    aur_phase *phase = NULL;
    assert_int_equal(aur_parameters_init(&parameters, "phase", plugin, nowhere, &error), AUR_OK);
    if (key != NULL)
        assert_int_equal(
            aur_parameters_add_text(&parameters, AUR_PARAMETER_TEXT, key, value, nowhere, &error), AUR_OK);
    if (aur_phase_create(&parameters, &phase, &error) != AUR_OK)
        fail_msg("%s", error.message);
    aur_parameters_release(&parameters);
    return phase;
}

static aur_phase *make_blend(const aur_phase *a, const aur_phase *b, const char *weight) {
    aur_parameters parameters;
    aur_phase *phase = NULL;
    assert_int_equal(aur_parameters_init(&parameters, "phase", "blendphase", nowhere, NULL), AUR_OK);
    assert_int_equal(aur_parameters_add_object(&parameters, "phase", "phase", a, nowhere, NULL), AUR_OK);
    assert_int_equal(aur_parameters_add_object(&parameters, "phase2", "phase", b, nowhere, NULL), AUR_OK);
    assert_int_equal(
        aur_parameters_add_text(&parameters, AUR_PARAMETER_TEXT, "weight", weight, nowhere, NULL), AUR_OK);
    assert_int_equal(aur_phase_create(&parameters, &phase, NULL), AUR_OK);
    aur_parameters_release(&parameters);
    return phase;
}

/* Of the cosine, between two of them, by Simpson's rule. */
static double probability(const aur_phase *phase, double from, double to) {
    enum { STEPS = 2000 };
    double sum = 0.0;
    for (size_t i = 0; i <= STEPS; ++i) {
        const double cosine = from + (to - from) * (double)i / STEPS;
        const double weight = i == 0 || i == STEPS ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        sum += weight * (double)aur_phase_evaluate(phase, origin, (float)cosine);
    }
    return 2.0 * (double)AUR_PI_F * sum * (to - from) / STEPS / 3.0;
}

/* Draws of equally spaced numbers fall into bins in proportion to the density: the bin's ends are off by one
 * draw each, and by the rounding of cosines, which near -1 and 1 are 6e-8 apart. */
static void check(const aur_phase *phase, const char *name, double tolerance) {
    enum { BINS = 40, DRAWS = 100000 };
    double whole = 0.0, parts[BINS] = {0};
    for (size_t i = 0; i < DRAWS; ++i) {
        const float cosine = aur_phase_draw(phase, origin, ((float)i + 0.5f) / DRAWS);
        assert_true(cosine >= -1.0f && cosine <= 1.0f);
        const size_t bin = (size_t)((cosine + 1.0f) / 2.0f * BINS);
        parts[bin < BINS ? bin : BINS - 1] += 1.0 / DRAWS;
    }
    for (size_t bin = 0; bin < BINS; ++bin) {
        const double from = 2.0 * (double)bin / BINS - 1.0,
                     expected = probability(phase, from, from + 2.0 / BINS);
        whole += expected;
        if (fabs(parts[bin] - expected) > tolerance + 6.0 / DRAWS)
            fail_msg("%s: bin %zu has %g, not %g", name, bin, parts[bin], expected);
    }
    assert_near(whole, 1.0, tolerance + 1e-5);
}

static void draws_have_the_density(void **state) {
    (void)state;
    static const char *const forms[][3] = {{"isotropic", NULL, NULL},
                                           {"rayleigh", NULL, NULL},
                                           {"hg", NULL, NULL},
                                           {"hg", "g", "0"},
                                           {"hg", "g", "1e-4"},
                                           {"hg", "g", "-0.7"},
                                           {"hg", "g", "0.97"},
                                           {"tabphase", "values", "1, 2, 4"},
                                           {"tabphase", "values", "0 0 1 3 0 0 2"},
                                           {"tabphase", "values", "1e-20 1e-20"}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; ++i) {
        aur_phase *const phase = make(forms[i][0], forms[i][1], forms[i][2]);
        check(phase, forms[i][0], 1e-5);
        aur_phase_destroy(phase);
    }
    aur_phase *const a = make("hg", "g", "0.5"), *const b = make("isotropic", NULL, NULL);
    for (size_t i = 0; i < 3; ++i) {
        static const char *const weights[] = {"0", "0.25", "1"};
        aur_phase *const blend = make_blend(a, b, weights[i]);
        check(blend, "blendphase", 1e-5);
        aur_phase_destroy(blend);
    }
    aur_phase_destroy(a);
    aur_phase_destroy(b);
}

/* Mitsuba 3.9.1, eval_pdf at cosines 1, 1/2, 0, -1/2, -1, scalar_rgb. */
static void has_the_values_of_mitsuba(void **state) {
    (void)state;
    static const float hg[] = {0.477464795f, 0.0918881446f, 0.0427057482f, 0.0257806778f, 0.0176838804f};
    static const float rayleigh[] = {0.119366199f, 0.0746038705f, 0.0596830919f, 0.0746038705f, 0.119366199f};
    static const float table[] = {0.141471058f, 0.106103294f, 0.0707355291f, 0.0530516468f, 0.0353677645f};
    static const float blend[] = {0.377992958f, 0.0888104811f, 0.0519236773f, 0.0392298773f, 0.0331572778f};
    aur_phase *const phases[] = {make("hg", "g", "0.5"), make("rayleigh", NULL, NULL),
                                 make("tabphase", "values", "1, 2, 4"), make("isotropic", NULL, NULL)};
    aur_phase *const both = make_blend(phases[0], phases[3], "0.25");
    for (size_t i = 0; i < 5; ++i) {
        const float cosine = 1.0f - 0.5f * (float)i;
        assert_relative((double)aur_phase_evaluate(phases[0], origin, cosine), (double)hg[i], 1e-6);
        assert_relative((double)aur_phase_evaluate(phases[1], origin, cosine), (double)rayleigh[i], 1e-6);
        assert_relative((double)aur_phase_evaluate(phases[2], origin, cosine), (double)table[i], 1e-6);
        assert_relative((double)aur_phase_evaluate(both, origin, cosine), (double)blend[i], 1e-6);
    }
    aur_phase_destroy(both);
    for (size_t i = 0; i < 4; ++i)
        aur_phase_destroy(phases[i]);
}

/* The mean cosine of Henyey and Greenstein is g, also where float formulas are near their end. */
static void narrow_ones_preserve_their_mean(void **state) {
    (void)state;
    static const char *const texts[] = {"0.5", "-0.9", "0.999", "0.99999999", "-0.99999999"};
    static const double means[] = {0.5, -0.9, 0.999, 1.0, -1.0};
    for (size_t i = 0; i < 5; ++i) {
        aur_phase *const phase = make("hg", "g", texts[i]);
        double sum = 0.0;
        enum { DRAWS = 1 << 16 };
        for (size_t k = 0; k < DRAWS; ++k) {
            const float cosine = aur_phase_draw(phase, origin, ((float)k + 0.5f) / DRAWS);
            const float value = aur_phase_evaluate(phase, origin, cosine);
            assert_true(value > 0.0f && isfinite(value));
            sum += (double)cosine / DRAWS;
        }
        assert_near(sum, means[i], 1e-4);
        aur_phase_destroy(phase);
    }
}

static void refuses(const char *plugin, const char *key, const char *value, const char *message) {
    aur_parameters parameters;
    aur_error error = {0};
    aur_phase *phase;
    assert_int_equal(aur_parameters_init(&parameters, "phase", plugin, nowhere, &error), AUR_OK);
    if (key != NULL)
        assert_int_equal(
            aur_parameters_add_text(&parameters, AUR_PARAMETER_TEXT, key, value, nowhere, &error), AUR_OK);
    assert_int_not_equal(aur_phase_create(&parameters, &phase, &error), AUR_OK);
    assert_null(phase);
    if (strstr(error.message, message) == NULL)
        fail_msg("'%s' does not have '%s'", error.message, message);
    aur_parameters_release(&parameters);
}

static void refuses_what_is_no_density(void **state) {
    (void)state;
    refuses("hg", "g", "1", "'g' must be between -1 and 1, both exclusive, not '1'");
    refuses("tabphase", NULL, NULL, "it needs 'values'");
    refuses("tabphase", "values", "1", "two or more numbers");
    refuses("tabphase", "values", "", "two or more numbers");
    refuses("tabphase", "values", "0 0", "not all 0");
    refuses("tabphase", "values", "1 -1", "not negative");
    refuses("tabphase", "values", "1 inf", "two or more numbers");
    refuses("tabphase", "values", "1 x", "two or more numbers");
    refuses("blendphase", "weight", "0.5", "it needs two <phase>");
    refuses("higashi", NULL, NULL, "there are");
    refuses("sggx", NULL, NULL, "sggx");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draws_have_the_density),
        cmocka_unit_test(has_the_values_of_mitsuba),
        cmocka_unit_test(narrow_ones_preserve_their_mean),
        cmocka_unit_test(refuses_what_is_no_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
