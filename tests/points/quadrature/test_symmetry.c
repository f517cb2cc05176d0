/* Point groups: their orders, closure and bad names; rules of one point per orbit: means of functions with
 * the group's symmetry, and the form factor of a box. */
#include <aureole/integrate.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "points/base/vector.h"

enum { MOST = 4000 };

static const struct {
    const char *name;
    size_t order;
} groups[] = {{"C1", 1},  {"Ci", 2},   {"Cs", 2},   {"C2", 2},   {"C7", 7},   {"C3v", 6}, {"C2h", 4},
              {"S2", 2},  {"S4", 4},   {"S6", 6},   {"D2", 4},   {"D6", 12},  {"D2h", 8}, {"D30h", 120},
              {"D2d", 8}, {"D3d", 12}, {"D5d", 20}, {"D6h", 24}, {"C6h", 12}, {"T", 12},  {"Td", 24},
              {"Th", 24}, {"O", 24},   {"Oh", 48},  {"I", 60},   {"Ih", 120}};
enum { GROUPS = sizeof groups / sizeof groups[0] };

static double xyz[3 * MOST], weights[MOST];
static aur_point_group group;

static void test_groups(void **state) {
    (void)state;
    aur_error error;
    for (size_t k = 0; k < GROUPS; ++k) {
        assert_int_equal(aur_point_group_from_name(groups[k].name, &group, &error), AUR_OK);
        if (group.order != groups[k].order)
            print_message("%s has %zu\n", groups[k].name, group.order);
        assert_int_equal(group.order, groups[k].order);
        /* Two vectors of no symmetry have as many images, and images of images are among them. */
        for (size_t i = 0; i < group.order; ++i) {
            double first[3] = {0.3, 0.5, 0.81}, second[3];
            aur_rotation_apply(&group.elements[i], 1, first);
            size_t found = 0;
            aur_rotation_apply(&group.elements[group.order - 1], 1, first);
            for (size_t j = 0; j < group.order; ++j) {
                memcpy(second, (const double[3]){0.3, 0.5, 0.81}, sizeof second);
                aur_rotation_apply(&group.elements[j], 1, second);
                found +=
                    fabs(first[0] - second[0]) + fabs(first[1] - second[1]) + fabs(first[2] - second[2]) <
                    1e-12;
            }
            assert_int_equal(found, 1);
        }
    }
    static const char *const bad[] = {"",   "C",    "C0", "C31", "C2x", "D2v", "Oh2",  "S3", "X4",
                                      "Dh", "C2v ", "T2", "Ov",  "Id",  "c2v", "D2hh", "Ss", "-1"};
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        const aur_result result = aur_point_group_from_name(bad[k], &group, &error);
        if (result != AUR_ERROR_NAME)
            print_message("'%s' is a group\n", bad[k]);
        assert_int_equal(result, AUR_ERROR_NAME);
        assert_non_null(strstr(error.message, "unknown point group"));
    }
}

/* The mean over the group of exp(a.u), whose mean over the sphere is that of exp(a.u): sinh|a|/|a|. */
static double symmetrised(const double *u) {
    double sum = 0.0;
    for (size_t g = 0; g < group.order; ++g) {
        double image[3] = {u[0], u[1], u[2]};
        aur_rotation_apply(&group.elements[g], 1, image);
        sum += exp(1.1 * image[0] - 0.7 * image[1] + 2.0 * image[2]) / (double)group.order;
    }
    return sum;
}

static void test_rules(void **state) {
    (void)state;
    const double length = sqrt(1.1 * 1.1 + 0.7 * 0.7 + 4.0);
    for (size_t k = 0; k < GROUPS; ++k) {
        assert_int_equal(aur_point_group_from_name(groups[k].name, &group, NULL), AUR_OK);
        size_t last = 0;
        for (size_t most = 1; most <= MOST / 4; most = most * 3 / 2 + 1) {
            size_t count = 0;
            const aur_result result = aur_symmetric_rule(&group, most, 3 * MOST, xyz, weights, &count, NULL);
            assert_true(result == AUR_OK || (result == AUR_ERROR_ARGUMENT && most <= 8));
            assert_true(count <= most && count >= last);
            last = count;
            double sum = 0.0, mean = 0.0;
            for (size_t i = 0; i < count; ++i) {
                sum += weights[i];
                mean += weights[i] * symmetrised(xyz + 3 * i);
            }
            if (result != AUR_OK)
                continue;
            assert_relative(sum, 1.0, 1e-13);
            if (most > 600)
                assert_relative(mean, sinh(length) / length, 1e-13);
        }
    }
    size_t count;
    assert_int_equal(aur_symmetric_rule(&group, 100, 299, xyz, weights, &count, NULL), AUR_ERROR_CAPACITY);
    assert_int_equal(aur_symmetric_rule(&group, 0, 0, xyz, weights, &count, NULL), AUR_ERROR_ARGUMENT);
}

static double sinc(double x) {
    return fabs(x) < 1e-6 ? 1.0 - x * x / 6.0 : sin(x) / x;
}

static double form_factor(size_t most, size_t *count) {
    aur_point_group_from_name("D2h", &group, NULL);
    assert_int_equal(aur_symmetric_rule(&group, most, 3 * MOST, xyz, weights, count, NULL), AUR_OK);
    double sum = 0.0;
    for (size_t i = 0; i < *count; ++i) {
        const double *const u = xyz + 3 * i;
        const double amplitude =
            sinc(0.05 * 60.0 * u[0]) * sinc(0.05 * 250.0 * u[1]) * sinc(0.05 * 500.0 * u[2]);
        sum += weights[i] * amplitude * amplitude;
    }
    return sum;
}

/* A prism of 60 x 250 x 500 at q = 0.1: its orientational mean to rounding by 900 evaluations. */
static void test_prism(void **state) {
    (void)state;
    size_t count;
    const double exact = form_factor(MOST, &count);
    const double found = form_factor(900, &count);
    print_message("%zu evaluations: %.15g, relative error %.1e\n", count, found, found / exact - 1.0);
    assert_true(count <= 900);
    assert_relative(found, exact, 2e-14);
}

/* exp(a.u) made symmetric, and 1 as a second value: the integrals are 4 pi sinh|a|/|a| and 4 pi. */
static aur_result symmetric_values(void *user, size_t count, const double *points, const double *along,
                                   double *values, aur_error *failure) {
    (void)along, (void)failure;
    size_t *const evaluations = user;
    *evaluations += count;
    for (size_t i = 0; i < count; ++i) {
        values[2 * i] = symmetrised(points + 3 * i);
        values[2 * i + 1] = 1.0;
    }
    return AUR_OK;
}

static void test_integrals(void **state) {
    (void)state;
    aur_error error;
    assert_int_equal(aur_point_group_from_name("Oh", &group, &error), AUR_OK);
    aur_integrate_options options = {.size = sizeof options};
    aur_integrate_options_init(AUR_DOMAIN_SPHERE, &options, NULL);
    options.group = &group;
    options.relative = 1e-12;
    options.values = 2;
    aur_integral found = {.size = sizeof found};
    aur_estimated results[2];
    size_t evaluations = 0;
    assert_int_equal(aur_integrate_values(symmetric_values, &evaluations, &options, results, &found, &error),
                     AUR_OK);
    const double length = sqrt(1.1 * 1.1 + 0.7 * 0.7 + 2.0 * 2.0), mean = sinh(length) / length;
    assert_near(results[0].value, 4.0 * AUR_PI * mean, 1e-11 * mean);
    assert_near(results[1].value, 4.0 * AUR_PI, 1e-12);
    assert_true(found.reason == AUR_INTEGRATE_TOLERANCE && found.levels == 2 && found.doubts == 0);
    assert_int_equal(found.evaluations, evaluations);
    options.mean = true;
    assert_int_equal(aur_integrate_values(symmetric_values, &evaluations, &options, results, &found, &error),
                     AUR_OK);
    assert_near(found.value, mean, 1e-12 * mean);
    options.separate = true;
    assert_int_equal(aur_integrate_values(symmetric_values, &evaluations, &options, results, &found, &error),
                     AUR_ERROR_UNSUPPORTED);
    options.separate = false;
    options.domain = AUR_DOMAIN_HEMISPHERE;
    assert_int_equal(aur_integrate_values(symmetric_values, &evaluations, &options, results, &found, &error),
                     AUR_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.message, "whole sphere"));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_groups), cmocka_unit_test(test_rules),
                                       cmocka_unit_test(test_prism), cmocka_unit_test(test_integrals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
