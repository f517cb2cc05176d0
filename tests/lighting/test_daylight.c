/* Sky patches, products with coefficients, and years of weather with known sums. */
#include <aureole-lighting/daylight.h>
#include <stdlib.h>

#include "check.h"
#include "lighting/daylight/hours.h"
#include "lighting/daylight/product.h"
#include "points/base/random.h"
#include "points/base/simd.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "render/scene/lights/sun_position.h"

/* They fill the hemisphere, and the middle of each piece lies in its patch. */
static void test_patches(void **state) {
    (void)state;
    static const size_t counts[] = {145, 577, 1297, 2305, 3601, 5185};
    for (size_t m = 1; m <= 6; ++m) {
        aur_sky_patches patches;
        assert_int_equal(aur_sky_patches_create(m, &patches, NULL), AUR_OK);
        assert_int_equal(patches.count, counts[m - 1] + 1);
        double angle = 0.0, cosine = 0.0;
        for (size_t p = 1; p < patches.count; ++p) {
            angle += aur_sky_patch_angle(&patches, p);
            cosine += aur_sky_patch_cosine(&patches, p);
        }
        /* Thousands of sums of 2^-53 each. */
        assert_relative(angle, 2.0 * AUR_PI, 1e-12);
        assert_relative(cosine, AUR_PI, 1e-12);
        size_t next = 0;
        for (size_t row = 0; row < patches.row_count; ++row) {
            const size_t count = patches.first[row + 1] - patches.first[row];
            const size_t pieces = count > 1 ? patches.around : patches.around_zenith;
            for (size_t i = 0; i < patches.up * count * pieces; ++i, ++next) {
                const size_t patch = patches.first[row] + i % (count * pieces) / pieces;
                assert_int_equal(aur_sky_patches_find(&patches, patches.middles[next]), patch);
            }
        }
        assert_int_equal(aur_sky_patches_find(&patches, (const double[3]){0.6, 0.0, -0.8}), 0);
        assert_int_equal(aur_sky_patches_find(&patches, (const double[3]){0.0, 0.0, 1.0}), patches.count - 1);
        /* A uniform sky of one lux has 1 / pi everywhere. */
        const aur_sky_model uniform = aur_sky_model_uniform();
        double *const radiance = malloc(patches.count * sizeof *radiance);
        assert_true(aur_sky_patches_fill(&patches, &uniform, 1.0, radiance));
        for (size_t p = 1; p < patches.count; ++p)
            assert_relative(radiance[p], 1.0 / AUR_PI, 1e-12);
        free(radiance);
        aur_sky_patches_release(&patches);
    }
}

/* The same bits as the sum that it is, by each instruction set that there is. */
static void test_product(void **state) {
    (void)state;
    enum { HOURS = 8, PATCHES = 37 };
    static double radiance[HOURS * PATCHES], coefficients[PATCHES * AUR_DAYLIGHT_LANES];
    static double values[HOURS * AUR_DAYLIGHT_LANES];
    for (size_t i = 0; i < HOURS * PATCHES; ++i)
        radiance[i] = aur_unit_double(aur_hash2(1, i));
    for (size_t i = 0; i < PATCHES * AUR_DAYLIGHT_LANES; ++i)
        coefficients[i] = aur_unit_double(aur_hash2(2, i));
    aur_daylight_product *products[3] = {aur_daylight_product_portable, NULL, NULL};
#if !defined(AUR_PORTABLE)
    if (aur_isa_check("avx2", NULL) == AUR_OK)
        products[1] = aur_daylight_product_avx2;
    if (aur_isa_check("avx512", NULL) == AUR_OK)
        products[2] = aur_daylight_product_avx512;
#endif
    for (size_t n = 0; n < 3; ++n) {
        if (products[n] == NULL)
            continue;
        products[n](HOURS, PATCHES, radiance, coefficients, values);
        for (size_t h = 0; h < HOURS; ++h)
            for (size_t k = 0; k < AUR_DAYLIGHT_LANES; ++k) {
                double sum = 0.0;
                for (size_t p = 0; p < PATCHES; ++p)
                    sum += radiance[aur_daylight_index(PATCHES, h, p)] *
                           coefficients[p * AUR_DAYLIGHT_LANES + k];
                assert_true(sum == values[h * AUR_DAYLIGHT_LANES + k]);
            }
    }
}

/* Seen from the pole the sun is as high as its declination: 0 at the equinoxes of 2026 (20 March 14:46 and 23
 * September 0:05 UTC), 23.436 degrees, the tilt of the axis, at the solstice (21 June 8:24). The algorithm is
 * good to .01 degrees. */
static void test_sun(void **state) {
    (void)state;
    static const struct {
        unsigned month, day;
        double hours, height;
    } rows[] = {{3, 20, 14 + 46.0 / 60, 0.0}, {9, 23, 5.0 / 60, 0.0}, {6, 21, 8 + 24.0 / 60, 23.436}};
    for (size_t i = 0; i < 3; ++i) {
        double days, sun[3];
        assert_true(aur_days_since_2000(2026, rows[i].month, rows[i].day, &days));
        aur_sun_locate(days + (rows[i].hours - 12.0) / 24.0, rows[i].hours, 90.0, 0.0, sun);
        assert_near(asin(sun[2]) * 180.0 / AUR_PI, rows[i].height, 0.01);
    }
}

enum { HOURS = 8760 };

static aur_weather_view year_of(aur_weather_hour hours[HOURS]) {
    size_t hour = 0;
    for (unsigned month = 1; month <= 12; ++month)
        for (unsigned day = 1; day <= aur_days_of_month(2001, month); ++day)
            for (int clock = 1; clock <= 24; ++clock, ++hour)
                hours[hour] =
                    (aur_weather_hour){2001, (int)month, (int)day, clock, hour + 9, 600.0, 100.0, NAN, NAN};
    return (aur_weather_view){.size = sizeof(aur_weather_view),
                              .latitude = 48.0,
                              .longitude = 11.0,
                              .timezone = 1.0,
                              .first_weekday = 1,
                              .count = HOURS,
                              .hours = hours};
}

static void test_hours(void **state) {
    (void)state;
    static aur_weather_hour hours[HOURS];
    const aur_weather_view weather = year_of(hours);
    /* Two determine the third: direct normal irradiance from global and diffuse, by the sun's height. */
    hours[12].diffuse_horizontal = NAN;
    hours[12].global_horizontal = 350.0;
    hours[36].direct_normal = NAN;
    hours[36].global_horizontal = 300.0;
    hours[60].direct_normal = NAN;      /* an hour by day with too little data */
    hours[48].diffuse_horizontal = NAN; /* and one by night, which is dark */
    /* The model of Perez has no light anywhere for a sun through thick clouds at noon in July. */
    hours[4596].direct_normal = 60.0;
    hours[4596].diffuse_horizontal = 20.0;
    aur_sky_patches patches;
    aur_lit_hours lit;
    assert_int_equal(aur_sky_patches_create(1, &patches, NULL), AUR_OK);
    aur_daylight_options options = {.size = sizeof options};
    aur_daylight_options_init(&options, NULL);
    options.from = 8;
    options.to = 18;
    options.efficacy = AUR_EFFICACY_CONSTANT;
    options.ground_albedo = 0.5;
    assert_int_equal(aur_lit_hours_create(&weather, &options, &patches, &lit, NULL), AUR_OK);
    assert_int_equal(lit.counted, 3649);
    assert_int_equal(lit.unknown, 1);
    assert_int_equal(lit.first_unknown, 60);
    assert_true(lit.is_unknown[60] && !lit.is_unknown[48]);
    assert_int_equal(lit.other_skies, 1);
    assert_int_equal(lit.first_other, 4596);
    for (size_t i = 0; i < lit.count; ++i) {
        const aur_lit_hour *const hour = &lit.hours[i];
        const aur_weather_hour *const at = &hours[hour->hour];
        double diffuse = 0.0;
        for (size_t p = 1; p < patches.count; ++p)
            diffuse +=
                lit.radiance[aur_daylight_index(patches.count, i, p)] * aur_sky_patch_cosine(&patches, p);
        const double height = hour->sun[2], horizontal = hour->direct * height;
        assert_true(aur_is_unit(hour->sun)); /* below the horizon it is put on it */
        assert_true((hour->direct > 0.0) == (height > 0.0));
        /* Sums over 145 patches; .5 / pi of the horizontal irradiance is the ground's radiance. */
        const double ground = lit.radiance[aur_daylight_index(patches.count, i, 0)];
        assert_relative(ground, 0.5 / AUR_PI * (diffuse + horizontal), 1e-12);
        if (hour->hour == 12)
            assert_relative(diffuse, 179.0 * fmax(350.0 - 600.0 * height, 0.0), 1e-12);
        else if (hour->hour == 36)
            assert_relative(horizontal, 179.0 * (300.0 - 100.0), 1e-12);
        else
            assert_relative(diffuse, 179.0 * at->diffuse_horizontal, 1e-12);
    }
    aur_lit_hours_release(&lit);
    options.weekdays = true;
    assert_int_equal(aur_lit_hours_create(&weather, &options, &patches, &lit, NULL), AUR_OK);
    assert_int_equal(lit.counted, 261 * 10 - 1); /* a year that begins on a Monday has 261 working days */
    aur_lit_hours_release(&lit);
    hours[100].diffuse_horizontal = -1.0;
    aur_error error;
    assert_int_equal(aur_lit_hours_create(&weather, &options, &patches, &lit, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(error.line, 109);
    aur_sky_patches_release(&patches);
}

/* The half of a day with the most diffuse irradiance, whose order is a permutation. At noon the file has the
 * global irradiance only: 900 - 600 sin(height) of the sky is more than any other hour has. */
static void test_daylight_hours(void **state) {
    (void)state;
    enum { DAY = 24, NOON = 11 };
    static aur_weather_hour hours[HOURS];
    aur_weather_view weather = year_of(hours);
    weather.count = DAY;
    for (size_t i = 0; i < DAY; ++i)
        hours[i].diffuse_horizontal = 10.0 * (double)(1 + 7 * i % DAY);
    hours[NOON].diffuse_horizontal = NAN;
    hours[NOON].global_horizontal = 900.0;
    aur_sky_patches patches;
    aur_lit_hours lit;
    assert_int_equal(aur_sky_patches_create(1, &patches, NULL), AUR_OK);
    aur_daylight_options options = {.size = sizeof options, .daylight_hours = true};
    assert_int_equal(aur_lit_hours_create(&weather, &options, &patches, &lit, NULL), AUR_OK);
    assert_int_equal(lit.counted, DAY / 2);
    assert_int_equal(lit.count, DAY);
    for (size_t i = 0; i < DAY; ++i) {
        size_t above = i == NOON ? 0 : 1;
        for (size_t j = 0; j < DAY; ++j)
            above += j != NOON && hours[j].diffuse_horizontal > hours[i].diffuse_horizontal;
        assert_true(lit.hours[i].counts == (above < DAY / 2));
    }
    aur_lit_hours_release(&lit);
    static const bool all[DAY] = {true};
    options.schedule = all;
    options.schedule_count = DAY;
    assert_int_equal(aur_lit_hours_create(&weather, &options, &patches, &lit, NULL), AUR_ERROR_ARGUMENT);
    aur_sky_patches_release(&patches);
}

/* Rotations about a tilted axis, to 1e-9 degrees. Without backtracking no other rotation has a smaller angle
 * of incidence; with it, the shadow of a row ends at the next one: width times cos(incidence in the plane
 * across the axes) is the distance times the cosine of the sun's angle to the vertical in it. */
static void test_trackers(void **state) {
    (void)state;
    static const char text[] = "<scene version=\"3.0.0\"><shape type=\"sphere\"/></scene>";
    static const double up[3] = {0.0, 0.0, 1.0}, north[3] = {0.0, 1.0, 0.0};
    static aur_weather_hour hours[HOURS];
    static double rotations[HOURS], normals[3 * HOURS];
    aur_weather_view weather = year_of(hours);
    aur_scene *scene = NULL;
    aur_scene_options load = {.size = sizeof load};
    assert_int_equal(aur_scene_load_memory("sphere", sizeof text - 1, text, &load, &scene, NULL), AUR_OK);
    aur_tracker_options tracker = {.size = sizeof tracker};
    assert_int_equal(aur_tracker_options_init(&tracker, NULL), AUR_OK);
    size_t turned_back = 0;
    for (size_t c = 0; c < 2; ++c) {
        tracker = (aur_tracker_options){sizeof tracker, 20.0, 150.0, 80.0, c == 0 ? 0.0 : 0.45, 1e-9};
        assert_int_equal(aur_tracker_normals(scene, &weather, &tracker, up, north, rotations, normals, NULL),
                         AUR_OK);
        for (size_t i = 0; i < HOURS; i += 7) {
            double sun[3], distance, axis[3], across[3], top[3];
            bool is_up;
            assert_int_equal(aur_weather_sun(&weather, i, sun, &distance, &is_up, NULL), AUR_OK);
            assert_true(is_up == !isnan(rotations[i]));
            const double *const n = normals + 3 * i, t = 20.0 * AUR_PI / 180.0, a = 150.0 * AUR_PI / 180.0;
            if (!is_up)
                continue;
            /* The axis descends to the azimuth. */
            axis[0] = sin(a) * cos(t), axis[1] = cos(a) * cos(t), axis[2] = -sin(t);
            across[0] = cos(a), across[1] = -sin(a), across[2] = 0.0;
            aur_cross3(across, axis, top);
            assert_near(aur_dot3(n, axis), 0.0, 1e-9);
            assert_near(aur_dot3(n, n), 1.0, 1e-9);
            const double x = aur_dot3(sun, across), z = aur_dot3(sun, top), theta = atan2(x, z);
            const double turn = atan2(aur_dot3(n, across), aur_dot3(n, top));
            assert_near(turn, rotations[i] * AUR_PI / 180.0, 1e-9);
            const bool at_limit = fabs(rotations[i]) > 80.0 - 1e-6;
            const bool shades = c == 1 && cos(theta) < 0.45;
            turned_back += shades && !at_limit;
            if (shades && !at_limit)
                assert_near(0.45 * cos(theta - turn), fabs(cos(theta)), 1e-9);
            else if (!at_limit)
                assert_near(turn, theta, 1e-9);
            assert_true(turn * theta >= 0.0 || fabs(theta) > 0.5 * AUR_PI);
        }
    }
    assert_true(turned_back > 50);
    tracker.limit = 0.0;
    assert_int_equal(aur_tracker_normals(scene, &weather, &tracker, up, north, NULL, normals, NULL),
                     AUR_ERROR_ARGUMENT);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_patches),
        cmocka_unit_test(test_product),
        cmocka_unit_test(test_sun),
        cmocka_unit_test(test_hours),
        cmocka_unit_test(test_daylight_hours),
        cmocka_unit_test(test_trackers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
