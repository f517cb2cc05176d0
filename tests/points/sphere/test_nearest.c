#include "sphere_check.h"

#include <aureole/nearest.h>
#include <string.h>

#include "points/sphere/map.h"

enum { POINTS = 500, QUERIES = 600, WANTED = 7 };

/* The angle between two directions, axes or rotations. */
static double angle(aur_domain domain, const double *a, const double *b) {
    double near = 0.0, far = 0.0;
    const size_t dimension = domain == AUR_DOMAIN_ROTATIONS ? 4 : 3;
    for (size_t d = 0; d < dimension; ++d) {
        near += (a[d] - b[d]) * (a[d] - b[d]);
        far += (a[d] + b[d]) * (a[d] + b[d]);
    }
    const double chord = sqrt(domain == AUR_DOMAIN_SPHERE ? near : fmin(near, far));
    return (domain == AUR_DOMAIN_ROTATIONS ? 4.0 : 2.0) * asin(fmin(0.5 * chord, 1.0));
}

static void the_nearest_are_those_of_a_linear_search(void **state) {
    (void)state;
    static double points[4 * POINTS], queries[4 * QUERIES], distances[WANTED * QUERIES];
    static size_t indices[WANTED * QUERIES], others[WANTED * QUERIES];
    const aur_domain domains[] = {AUR_DOMAIN_SPHERE, AUR_DOMAIN_AXES, AUR_DOMAIN_ROTATIONS};
    for (size_t k = 0; k < 3; ++k) {
        const size_t dimension = domains[k] == AUR_DOMAIN_ROTATIONS ? 4 : 3;
        for (size_t i = 0; i < QUERIES; ++i) {
            double *const query = queries + dimension * i;
            double *const point = points + dimension * (i % POINTS);
            if (dimension == 3) {
                check_random_direction(1, i % POINTS, point);
                check_random_direction(2, i, query);
            } else {
                aur_quaternion_uniform(i % POINTS, point);
                aur_quaternion_uniform(1000 + i, query);
            }
        }
        const aur_points_view view = aur_points_view_of(domains[k], POINTS, dimension, points);
        aur_nearest *nearest;
        aur_nearest_options options = {.size = sizeof options};
        aur_nearest_options_init(&options, NULL);
        options.neighbours = WANTED;
        options.threads = 1;
        assert_int_equal(aur_nearest_create(&view, &nearest, NULL), AUR_OK);
        assert_int_equal(aur_nearest_find(nearest, &options, QUERIES, queries, indices, distances, NULL),
                         AUR_OK);
        options.threads = 3;
        assert_int_equal(aur_nearest_find(nearest, &options, QUERIES, queries, others, NULL, NULL), AUR_OK);
        assert_memory_equal(indices, others, sizeof indices);
        for (size_t q = 0; q < QUERIES; ++q) {
            const double *const query = queries + dimension * q;
            size_t nearer = 0;
            for (size_t n = 0; n < WANTED; ++n) {
                const double *const point = points + dimension * indices[WANTED * q + n];
                assert_near(distances[WANTED * q + n], angle(domains[k], query, point), 1e-14);
            }
            /* Nobody else is nearer than the last one. */
            for (size_t i = 0; i < POINTS; ++i)
                nearer += angle(domains[k], query, points + dimension * i) <
                          distances[WANTED * q + WANTED - 1] - 1e-13;
            assert_true(nearer <= WANTED - 1);
        }
        aur_nearest_destroy(nearest);
    }
}

/* As many neighbours as there are axes: each of them once. */
static void both_ends_are_one_axis(void **state) {
    (void)state;
    const double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, query[3] = {0.1, -0.2, -3.0};
    const aur_points_view view = aur_points_view_of(AUR_DOMAIN_AXES, 3, 3, axes);
    aur_nearest *nearest;
    aur_nearest_options options = {.size = sizeof options};
    aur_nearest_options_init(&options, NULL);
    options.neighbours = 3;
    size_t indices[3];
    assert_int_equal(aur_nearest_create(&view, &nearest, NULL), AUR_OK);
    assert_int_equal(aur_nearest_find(nearest, &options, 1, query, indices, NULL, NULL), AUR_OK);
    assert_int_equal(indices[0], 2);
    assert_int_equal(indices[1], 1);
    assert_int_equal(indices[2], 0);
    aur_nearest_destroy(nearest);
}

static void points_without_a_position_are_refused(void **state) {
    (void)state;
    double points[6] = {1, 0, 0, 0, NAN, 0};
    aur_points_view view = aur_points_view_of(AUR_DOMAIN_SPHERE, 2, 3, points);
    aur_nearest *nearest;
    aur_error error = {0};
    assert_int_equal(aur_nearest_create(&view, &nearest, &error), AUR_ERROR_ARGUMENT);
    assert_null(nearest);
    assert_non_null(strstr(error.message, "point 2"));
    points[4] = 0.0;
    assert_int_equal(aur_nearest_create(&view, &nearest, &error), AUR_ERROR_ARGUMENT);
    points[4] = 1.0;
    assert_int_equal(aur_nearest_create(&view, &nearest, NULL), AUR_OK);
    size_t index;
    assert_int_equal(aur_nearest_find(nearest, NULL, 1, (double[]){0, INFINITY, 0}, &index, NULL, &error),
                     AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "query 1"));
    aur_nearest_destroy(nearest);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_are_those_of_a_linear_search),
        cmocka_unit_test(both_ends_are_one_axis),
        cmocka_unit_test(points_without_a_position_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
