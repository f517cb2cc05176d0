#include "check.h"

#include <stdlib.h>

#include "core/random.h"
#include "transport/kd_tree.h"

enum { COUNT = 3000, K = 17 };

static float number(uint64_t what, uint64_t index) {
    return aur_unit_float((uint32_t)(aur_hash2(what, index) >> 32));
}

/* Random points, many of them equal or on a grid so that ties occur. */
static void make_points(aur_vector points[COUNT], uint64_t seed) {
    for (uint64_t i = 0; i < COUNT; ++i) {
        const float grid = i % 3 == 0 ? 4.0f : 1048576.0f;
        points[i] = (aur_vector){floorf(number(seed, 3 * i) * grid) / grid,
                                 floorf(number(seed, 3 * i + 1) * grid) / grid,
                                 floorf(number(seed, 3 * i + 2) * grid) / grid};
    }
}

static bool is_even(const void *context, uint32_t item) {
    (void)context;
    return item % 2 == 0;
}

static int compare_neighbours(const void *a, const void *b) {
    const aur_kd_neighbour *const x = a, *const y = b;
    if (x->distance_squared != y->distance_squared)
        return x->distance_squared < y->distance_squared ? -1 : 1;
    return (x->item > y->item) - (x->item < y->item);
}

static size_t brute_force(const aur_vector *points, aur_vector at, float radius, bool even,
                          aur_kd_neighbour *all) {
    size_t found = 0;
    for (uint32_t i = 0; i < COUNT; ++i) {
        const aur_vector offset = aur_vector_subtract(at, points[i]);
        const float distance_squared = aur_vector_dot(offset, offset);
        if (distance_squared <= radius * radius && (!even || i % 2 == 0))
            all[found++] = (aur_kd_neighbour){distance_squared, i};
    }
    qsort(all, found, sizeof *all, compare_neighbours);
    return found < K ? found : K;
}

static void agrees_with_brute_force(void **state) {
    (void)state;
    static aur_vector points[COUNT];
    static aur_kd_neighbour expected[COUNT];
    make_points(points, 1);
    aur_kd_tree tree;
    assert_int_equal(aur_kd_tree_build(&tree, COUNT, points, 2), AUR_OK);
    for (uint64_t q = 0; q < 500; ++q) {
        const aur_vector at = {number(2, 3 * q), number(2, 3 * q + 1), number(2, 3 * q + 2)};
        const float radius = q % 2 == 0 ? INFINITY : 0.15f;
        const bool even = q % 5 == 0;
        aur_kd_neighbour found[K];
        const size_t count = aur_kd_tree_nearest(&tree, at, radius, even ? is_even : NULL, NULL, K, found);
        assert_int_equal(count, brute_force(points, at, radius, even, expected));
        qsort(found, count, sizeof *found, compare_neighbours);
        for (size_t i = 0; i < count; ++i) {
            assert_int_equal(found[i].item, expected[i].item);
            assert_near(found[i].distance_squared, expected[i].distance_squared, 0);
        }
    }
    aur_kd_tree_release(&tree);
}

static void does_not_depend_on_threads(void **state) {
    (void)state;
    static aur_vector points[COUNT];
    make_points(points, 3);
    aur_kd_tree one, four;
    assert_int_equal(aur_kd_tree_build(&one, COUNT, points, 1), AUR_OK);
    assert_int_equal(aur_kd_tree_build(&four, COUNT, points, 4), AUR_OK);
    assert_memory_equal(one.nodes, four.nodes, COUNT * sizeof *one.nodes);
    aur_kd_tree_release(&one);
    aur_kd_tree_release(&four);
}

static void takes_the_smallest_trees(void **state) {
    (void)state;
    const aur_vector points[3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    for (size_t count = 0; count <= 3; ++count) {
        aur_kd_tree tree;
        aur_kd_neighbour found[5];
        assert_int_equal(aur_kd_tree_build(&tree, count, points, 1), AUR_OK);
        assert_int_equal(aur_kd_tree_nearest(&tree, points[0], INFINITY, NULL, NULL, 5, found), count);
        aur_kd_tree_release(&tree);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_brute_force),
        cmocka_unit_test(does_not_depend_on_threads),
        cmocka_unit_test(takes_the_smallest_trees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
