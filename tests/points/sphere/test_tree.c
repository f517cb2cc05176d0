#include "sphere_check.h"

#include "points/sphere/nearest/inverse.h"

static int nearest_first(const void *a, const void *b) {
    const aur_found *const p = a, *const q = b;
    if (p->square != q->square)
        return p->square < q->square ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

/* Against all distances, sorted: points of any number, on a coarse grid too, where most distances are equal.
 */
static void the_tree_finds_what_sorting_finds(void **state) {
    (void)state;
    enum { MOST = 700, WANTED = 12, QUERIES = 40 };
    static double points[4 * MOST];
    static aur_found all[MOST], found[WANTED];
    const size_t counts[] = {1, 2, 7, 8, 9, 17, 64, 65, 700};
    for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c)
        for (size_t dimension = 1; dimension <= 4; ++dimension)
            for (int coarse = 0; coarse < 2; ++coarse) {
                const size_t count = counts[c];
                for (size_t i = 0; i < dimension * count; ++i) {
                    points[i] = aur_unit_double(aur_hash3(1, dimension, i));
                    points[i] = coarse ? floor(points[i] * 4.0) : points[i];
                }
                aur_tree *tree;
                assert_int_equal(aur_tree_create(dimension, count, dimension, points, &tree, NULL), AUR_OK);
                for (size_t q = 0; q < QUERIES; ++q) {
                    double query[4];
                    for (size_t d = 0; d < dimension; ++d) {
                        query[d] = 1.2 * aur_unit_double(aur_hash3(q, d, 7)) - 0.1;
                        query[d] = coarse ? floor(query[d] * 4.0) : query[d];
                    }
                    for (size_t i = 0; i < count; ++i) {
                        double square = 0.0;
                        for (size_t d = 0; d < dimension; ++d)
                            square += (points[dimension * i + d] - query[d]) *
                                      (points[dimension * i + d] - query[d]);
                        all[i] = (aur_found){square, i};
                    }
                    qsort(all, count, sizeof *all, nearest_first);
                    const size_t got = aur_tree_find(tree, query, WANTED, found);
                    assert_int_equal(got, count < WANTED ? count : WANTED);
                    for (size_t k = 0; k < got; ++k) {
                        assert_int_equal(found[k].index, all[k].index);
                        assert_true(found[k].square == all[k].square);
                    }
                }
                aur_tree_destroy(tree);
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tree_finds_what_sorting_finds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
