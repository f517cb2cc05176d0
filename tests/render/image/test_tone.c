/* The curves between radiance and screen. */
#include "render/image/format.h"
#include "test_images.h"

static void test_srgb(void **state) {
    (void)state;
    /* IEC 61966-2-1: the linear part ends at 0.0031308 (0.04045 encoded); 0.5 encodes to 0.735357. */
    assert_near(aur_srgb_encode(0.001), 0.01292, 1e-15);
    assert_near(aur_srgb_encode(0.5), 0.7353569830524495, 1e-15);
    assert_near(aur_srgb_decode(0.7353569830524495), 0.5, 1e-15);
    assert_near(aur_srgb_encode(0.0031308), aur_srgb_encode(0.0031309), 2e-6);
    for (size_t i = 0; i <= 1000; ++i) /* the standard's own constants close to 4e-8 at the joint */
        assert_near(aur_srgb_encode(aur_srgb_decode((double)i / 1000.0)), (double)i / 1000.0, 4e-8);
    static const double beyond[][2] = {{-1, 0}, {2, 1}, {INFINITY, 1}, {-INFINITY, 0}, {NAN, 0}};
    for (size_t i = 0; i < 5; ++i) {
        assert_near(aur_srgb_encode(beyond[i][0]), beyond[i][1], 1e-15);
        assert_true(aur_srgb_decode(beyond[i][0]) == beyond[i][1]);
        assert_true(aur_tone_apply(AUR_TONE_SRGB, beyond[i][0]) == beyond[i][1]);
        if (i != 1) /* radiance 2 is not yet white */
            assert_true(aur_tone_apply(AUR_TONE_FILMIC, beyond[i][0]) == beyond[i][1]);
    }
}

/* Hable's rational curve by hand at x = 2 * 0.18: (0.36 (0.054 + 0.05) + 0.004) / (0.36 (0.054 + 0.5) + 0.06)
 * - 1/15 = 0.0930618..., over the same at 11.2, which is 0.7251318...; white is where 2 x = 11.2. */
static void test_filmic(void **state) {
    (void)state;
    const double grey = (0.36 * 0.104 + 0.004) / (0.36 * 0.554 + 0.06) - 1.0 / 15.0;
    const double white = (11.2 * 1.73 + 0.004) / (11.2 * 2.18 + 0.06) - 1.0 / 15.0;
    assert_near(aur_tone_apply(AUR_TONE_FILMIC, 0.18), grey / white, 1e-15);
    assert_near(aur_tone_apply(AUR_TONE_FILMIC, 5.6), 1.0, 1e-15);
    assert_true(aur_tone_apply(AUR_TONE_FILMIC, 0.0) == 0.0);
    assert_true(aur_tone_apply(AUR_TONE_FILMIC, 1e300) == 1.0);
    double before = 0.0;
    for (size_t i = 1; i <= 560; ++i) {
        const double value = aur_tone_apply(AUR_TONE_FILMIC, (double)i / 100.0);
        assert_true(value > before);
        before = value;
    }
}

static void test_options_are_checked(void **state) {
    (void)state;
    aur_image *image;
    aur_error error;
    assert_success(aur_image_create(1, 1, 3, &image, &error), &error);
    const aur_image_write_options rows[] = {{.size = sizeof *rows, .tone = (aur_tone)77},
                                            {.size = sizeof *rows, .tone = (aur_tone)-1},
                                            {.size = sizeof *rows, .exposure = NAN},
                                            {.size = sizeof *rows, .exposure = INFINITY},
                                            {.size = 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        assert_int_equal(aur_image_write("refused.png", image, &rows[i], &error), AUR_ERROR_ARGUMENT);
        assert_int_equal(access("refused.png", F_OK), -1);
    }
    aur_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_srgb),
        cmocka_unit_test(test_filmic),
        cmocka_unit_test(test_options_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
