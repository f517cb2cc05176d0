#include "short.h"
#include "sphere_check.h"

#include <string.h>

#include "points/sphere/sets/design.h"
#include "points/sphere/sets/reference.h"

/* The largest sum of the weights times a harmonic of mean square 1, P_lm(z) cos(m phi) or sin(m phi): of
 * degrees 1 .. degree, and of degree + 1. */
typedef struct worst {
    double exact, beyond;
} worst;

/* Sums over the points, and the recurrence P_l+1 = scale z P_l - before P_l-1. */
typedef struct order_sums {
    long double cosine, sine, scale, before;
} order_sums;

static void prepare_order(size_t m, size_t top, order_sums *sums) {
    for (size_t l = m; l <= top; ++l) {
        const long double a = (long double)(2 * l + 3) / (long double)((l + 1 - m) * (l + 1 + m));
        const long double b = l == m ? 0.0L : (long double)((l - m) * (l + m)) / (long double)(2 * l - 1);
        sums[l] = (order_sums){.scale = sqrtl(a * (long double)(2 * l + 1)), .before = sqrtl(a * b)};
    }
}

/* Long doubles, so that the rounding of the table is measured. */
static void add_point(size_t m, size_t top, const double point[3], long double start, long double weight,
                      order_sums *sums) {
    long double cosine = weight, sine = 0.0L, here = start, before = 0.0L;
    for (size_t k = 0; k < m; ++k) {
        const long double next = point[0] * cosine - point[1] * sine;
        sine = point[0] * sine + point[1] * cosine;
        cosine = next;
    }
    for (size_t l = m; l <= top; ++l) {
        sums[l].cosine += cosine * here;
        sums[l].sine += sine * here;
        const long double next = sums[l].scale * point[2] * here - sums[l].before * before;
        before = here;
        here = next;
    }
}

/* Harmonics of orders 0, step, 2 step, ... */
static worst worst_harmonic(size_t degree, size_t step, size_t count, const double *xyz,
                            const double *weights) {
    worst found = {0.0, 0.0};
    long double start = 1.0L;
    order_sums *const sums = malloc((degree + 2) * sizeof *sums);
    assert_non_null(sums);
    for (size_t m = 0; m <= degree + 1; ++m) {
        if (m > 0)
            start *= sqrtl((long double)(2 * m + 1) / (long double)(2 * m)) * (m == 1 ? sqrtl(2.0L) : 1.0L);
        if (m % step != 0)
            continue;
        prepare_order(m, degree + 1, sums);
        for (size_t i = 0; i < count; ++i)
            add_point(m, degree + 1, xyz + 3 * i, start, weights[i], sums);
        for (size_t l = m > 0 ? m : 1; l <= degree + 1; ++l) {
            double *const largest = l <= degree ? &found.exact : &found.beyond;
            *largest = fmax(*largest, (double)fmaxl(fabsl(sums[l].cosine), fabsl(sums[l].sine)));
        }
    }
    free(sums);
    return found;
}

static void note_warning(void *user, const char *message) {
    assert_non_null(strstr(message, "negative weights"));
    *(bool *)user = true;
}

/* Points with their weights, to be freed: x, y, z of all, then the weights. */
static double *points_of(const char *set, size_t count, bool *negative) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
    options.warnings = (aur_warnings){note_warning, negative};
    aur_directions *directions;
    assert_int_equal(aur_directions_create(set, &options, &directions, NULL), AUR_OK);
    double *const xyz = malloc(4 * count * sizeof *xyz);
    assert_non_null(xyz);
    assert_int_equal(aur_directions_points(directions, 0, count, 3 * count, xyz, xyz + 3 * count, NULL),
                     AUR_OK);
    /* A part of the set is the same points and weights. */
    double part[6], part_weights[2];
    assert_int_equal(aur_directions_points(directions, count - 2, 2, 6, part, part_weights, NULL), AUR_OK);
    assert_memory_equal(part, xyz + 3 * (count - 2), sizeof part);
    assert_memory_equal(part_weights, xyz + 4 * count - 2, sizeof part_weights);
    aur_directions_destroy(directions);
    return xyz;
}

static void check_exact(const char *set, const aur_reference *reference, size_t step) {
    const size_t count = reference->count;
    bool said = false;
    double *const xyz = points_of(set, count, &said);
    const double *const weights = xyz + 3 * count;
    long double sum = 0.0L;
    bool negative = false;
    for (size_t i = 0; i < count; ++i) {
        assert_near(check_dot(xyz + 3 * i, xyz + 3 * i), 1.0, 1e-15);
        negative = negative || weights[i] < 0.0;
        sum += weights[i];
    }
    assert_int_equal(said, negative);
    assert_near((double)sum, 1.0, 3e-15);
    const worst found = worst_harmonic(reference->degree, step, count, xyz, weights);
    assert_true(found.exact <= 3e-15);
    assert_true(found.beyond > 1e-4 || step > 1); /* one degree more is not exact */
    if (count < 2000)
        assert_true(check_smallest_distance(count, xyz) > 0.5 / sqrt((double)count));
    free(xyz);
}

static void designs_are_exact(void **state) {
    (void)state;
    for (size_t r = 0; r < AUR_T_DESIGN_COUNT; ++r)
        check_exact("t-design", aur_t_designs + r, 1);
}

/* Sets beyond the table: the solver at a fast degree, and a set generated on request, which the cache returns
 * later. */
static void designs_are_solved_for(void **state) {
    (void)state;
    const size_t half = aur_design_half(25);
    double *const xyz = malloc(8 * half * sizeof *xyz);
    assert_non_null(xyz);
    assert_int_equal(aur_design_solve(25, xyz, NULL), AUR_OK);
    for (size_t i = 0; i < 3 * half; ++i)
        xyz[3 * half + i] = -xyz[i];
    for (size_t i = 0; i < 2 * half; ++i)
        xyz[6 * half + i] = 0.5 / (double)half;
    const worst found = worst_harmonic(25, 1, 2 * half, xyz, xyz + 6 * half);
    assert_true(found.exact <= 1e-14 && found.beyond > 1e-4);
    assert_true(check_smallest_distance(2 * half, xyz) > 1.0 / sqrt((double)half));
    free(xyz);
    if (check_short())
        return;
    const aur_reference reference = {1446, 53, 0, 723};
    check_exact("t-design", &reference, 1);
    bool said = false;
    double *const first = points_of("t-design", 1446, &said), *const again =
                                                                  points_of("t-design", 1446, &said);
    assert_memory_equal(first, again, 4 * 1446 * sizeof *first);
    free(first);
    free(again);
}

/* Turned by a quarter about each axis and mirrored, the large rules are the same nodes: orders that are no
 * multiples of 4 cancel. */
static void lebedev_rules_are_exact(void **state) {
    (void)state;
    for (size_t r = 0; r < AUR_LEBEDEV_COUNT; ++r)
        check_exact("lebedev", aur_lebedev_rules + r, aur_lebedev_rules[r].count < 500 ? 1 : 4);
}

/* Degree 2n - 1 with 2 n^2 points, 2 n (n - 1) + 2 and fewer; one degree more is not exact. */
static void products_are_exact(void **state) {
    (void)state;
    static const struct {
        const char *set;
        size_t count, degree;
    } rules[] = {{"gauss", 2, 1},
                 {"gauss", 200, 19},
                 {"gauss", 882, 41},
                 {"gauss:rings=lobatto", 2, 1},
                 {"gauss:rings=lobatto", 182, 19},
                 {"gauss:rings=lobatto", 842, 41},
                 {"gauss:pruned=true", 5098, 109}}; /* of 6050 */
    for (size_t r = 0; r < sizeof rules / sizeof rules[0]; ++r) {
        bool said = false;
        double *const xyz = points_of(rules[r].set, rules[r].count, &said);
        const worst found = worst_harmonic(rules[r].degree, 1, rules[r].count, xyz, xyz + 3 * rules[r].count);
        assert_true(found.exact <= 1e-14 && found.beyond > 1e-3); /* rounding of Newton's weights */
        free(xyz);
    }
}

/* Leopardi's construction: regions of each collar, and equal areas because caps of whole regions end between
 * the collars. */
static void partitions_are_leopardis(void **state) {
    (void)state;
    static const size_t collars[] = {1, 4, 4, 1};
    bool said = false;
    double *xyz = points_of("eqsp", 10, &said);
    for (size_t c = 0, at = 0; c < 4; at += collars[c++])
        for (size_t k = 1; k < collars[c]; ++k)
            assert_near(xyz[3 * (at + k) + 2], xyz[3 * at + 2], 1e-15);
    assert_true(xyz[2] == 1.0 && xyz[3 * 9 + 2] == -1.0);
    free(xyz);
    for (size_t count = 1; count < 300; count = count * 3 / 2 + 1) {
        xyz = points_of("eqsp", count > 2 ? count : 2, &said);
        size_t begin = 0;
        for (size_t i = 1; i <= count && count > 2; ++i) {
            if (i < count && fabs(xyz[3 * i + 2] - xyz[3 * begin + 2]) < 1e-13)
                continue;
            /* The centre's angle is midway between the caps of `begin` and of i regions. */
            const double top = acos(1.0 - 2.0 * (double)begin / (double)count);
            const double bottom = acos(1.0 - 2.0 * (double)i / (double)count);
            if (begin > 0 && i < count)
                assert_near(acos(xyz[3 * begin + 2]), 0.5 * (top + bottom), 1e-12);
            begin = i;
        }
        free(xyz);
    }
}

/* The corners are a design of degree 5; all points have five turns about the axis and their opposites, and
 * lie as far apart as neighbours of a hexagonal pattern do within a fifth. */
static void geodesic_grids_have_the_icosahedrons_symmetry(void **state) {
    (void)state;
    static const size_t parts[] = {1, 2, 3, 7};
    for (size_t k = 0; k < 4; ++k) {
        const size_t f = parts[k], count = 10 * f * f + 2;
        bool said = false;
        double *const xyz = points_of("icosahedral", count, &said);
        if (f == 1)
            assert_true(worst_harmonic(5, 1, count, xyz, xyz + 3 * count).exact < 3e-15);
        for (size_t i = 0; i < count; ++i) {
            const double *const x = xyz + 3 * i, c = cos(0.4 * AUR_PI), s = sin(0.4 * AUR_PI);
            const double images[2][3] = {{-x[0], -x[1], -x[2]},
                                         {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]}};
            double nearest[2] = {INFINITY, INFINITY};
            for (size_t j = 0; j < count; ++j)
                for (size_t m = 0; m < 2; ++m)
                    nearest[m] = fmin(nearest[m], check_distance(images[m], xyz + 3 * j));
            assert_true(nearest[0] < 1e-14 && nearest[1] < 1e-14);
        }
        const double hexagonal = sqrt(8.0 * AUR_PI / (sqrt(3.0) * (double)count));
        assert_true(check_smallest_distance(count, xyz) > 0.8 * hexagonal);
        free(xyz);
    }
}

/* Weights of the rule with 14 points: 1/15 on the axes and 3/40 on the diagonals of the cube. */
static void fourteen_points_have_published_weights(void **state) {
    (void)state;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(14, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_directions *directions;
    assert_int_equal(aur_directions_create("lebedev", &options, &directions, NULL), AUR_OK);
    double xyz[42], weights[14];
    assert_int_equal(aur_directions_points(directions, 0, 14, 42, xyz, weights, NULL), AUR_OK);
    for (size_t i = 0; i < 14; ++i) {
        const bool on_axis = fabs(xyz[3 * i]) + fabs(xyz[3 * i + 1]) + fabs(xyz[3 * i + 2]) < 1.1;
        assert_near(weights[i], on_axis ? 1.0 / 15.0 : 3.0 / 40.0, 1e-15);
    }
    aur_directions_destroy(directions);
}

static void other_sizes_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *set;
        uint64_t count;
        const char *nearest;
    } wrong[] = {{"lebedev", 100, "86 or 110"}, {"lebedev", 5, "from 6"},
                 {"gauss", 9, "8 or 18"},       {"gauss:pruned=true", 5000, "4924 or 5098"},
                 {"icosahedral", 40, "42, 92"}, {"t-design", 17, "8 or 18"},
                 {"t-design", 1, "from 4"},     {"t-design", 1400, "1338 or 1446"}};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        aur_directions_options options = {.size = sizeof options};
        aur_directions_options_init(wrong[k].count, AUR_DOMAIN_SPHERE, &options, NULL);
        aur_directions *directions;
        aur_error error = {0};
        assert_int_equal(aur_directions_create(wrong[k].set, &options, &directions, &error),
                         AUR_ERROR_ARGUMENT);
        assert_non_null(strstr(error.message, wrong[k].nearest));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(designs_are_exact),
        cmocka_unit_test(designs_are_solved_for),
        cmocka_unit_test(lebedev_rules_are_exact),
        cmocka_unit_test(products_are_exact),
        cmocka_unit_test(partitions_are_leopardis),
        cmocka_unit_test(geodesic_grids_have_the_icosahedrons_symmetry),
        cmocka_unit_test(fourteen_points_have_published_weights),
        cmocka_unit_test(other_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
