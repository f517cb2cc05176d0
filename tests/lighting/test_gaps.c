/* Factors across narrow gaps: closed forms from 1e-8 to 1, alone and in rooms, shifted, tilted, far away. */
#include "moved_mesh.h"

/* Parallel rectangles at any place (Ehlert and Smith 1993): the term of two corners. */
static double term(double u, double v, double z) {
    const double a = sqrt(u * u + z * z), b = sqrt(v * v + z * z);
    return v * a * atan2(v, a) + u * b * atan2(u, b) - 0.5 * z * z * log(u * u + v * v + z * z);
}

/* From the unit square to that which is shifted along both sides. */
static double expected(double height, double x, double y) {
    double sum = 0.0;
    for (int n = 0; n < 16; ++n) {
        const int i = n & 1, j = n >> 1 & 1, k = n >> 2 & 1, l = n >> 3 & 1;
        const double sign = (i + j + k + l) % 2 == 0 ? 1.0 : -1.0;
        sum += sign * term(i - k - x, j - l - y, height);
    }
    return sum / (2.0 * PI);
}

enum { LOWER = 5, UPPER = 8, ROOM = 12 }; /* the sides that see each other, the first of the room */

static void check_gap(double height, double x, double y, bool room, const mesh_place *place) {
    mesh_file file;
    mesh_begin(&file, "gap");
    moved_box(&file, place, "lower", (double[3]){0, 0, 0}, (double[3]){1, 1, 0.5}, false);
    moved_box(&file, place, "upper", (double[3]){x, y, 0.5 + height}, (double[3]){1 + x, 1 + y, 1 + height},
              false);
    if (room)
        moved_box(&file, place, "room", (double[3]){-1.5, -2, -1}, (double[3]){2.5, 3, 4}, true);
    aur_facets_options options = aur_facets_options_default();
    options.group = true;
    aur_facets *const facets = mesh_load(&file, &options);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    double width;
    const double measured = factor_at(&m, LOWER, UPPER, &width);
    /* Closed forms err by 1e-11 at most; a corner that moves by a length changes a unit square's factor by
     * not more than twice that, and 0.5 + height is rounded. */
    assert_near(measured, expected(height, x, y), 1e-11 + 16.0 * place_rounding(place));
    assert_true(width == 0.0);
    check_physics(&m);
    /* What is left goes where there is something: to the sky, or to the room. */
    const double rest = room ? 1.0 - measured : m.sky[LOWER];
    if (x == 0.0)
        assert_near(rest, 1.0 - measured, 1e-12 + 1e-6 * (1.0 - measured));
    if (x == 0.0 && room)
        assert_near(m.sky[LOWER] + m.back[LOWER], 0.0, 1e-12);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

static void test_gaps(void **state) {
    (void)state;
    static const double heights[] = {1e-8, 1e-7, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 1e-3, 0.1, 1.0};
    const mesh_place here = place_at(0, 0, 0), turned = place_turned(1.0, 0, 0, 0);
    for (size_t h = 0; h < sizeof heights / sizeof heights[0]; ++h)
        for (int room = 0; room < 2; ++room) {
            check_gap(heights[h], 0.0, 0.0, room, &here);
            check_gap(heights[h], 0.0, 0.0, room, &turned);
            check_gap(heights[h], 0.3, 0.2, room, &turned);
        }
}

/* Gaps that doubles still know there. */
static void test_far_away(void **state) {
    (void)state;
    static const double offsets[][3] = {
        {1e5, 1e5, 0}, {2600000, 1200000, 450.25}, {500000.3, 5400000.3, 12.7}, {1e7, 1e7, 1e7}};
    static const double heights[] = {1e-6, 1e-5, 3e-5, 1e-4, 0.1};
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; ++i)
        for (size_t h = i == 3; h < sizeof heights / sizeof heights[0]; ++h)
            for (int room = 0; room < 2; ++room) {
                const double *const o = offsets[i];
                const mesh_place there = place_at(o[0], o[1], o[2]),
                                 turned = place_turned(0.5 + (double)i, o[0], o[1], o[2]);
                check_gap(heights[h], 0.0, 0.0, room, &there);
                check_gap(heights[h], 0.3, 0.2, room, &turned);
            }
}

/* A third box stands on both sides of the gap: it lies on an edge of all that goes across. */
static void check_stood_on(double gap, const mesh_place *place) {
    mesh_file file;
    mesh_begin(&file, "stood-on");
    moved_box(&file, place, "left", (double[3]){0, 0, 0}, (double[3]){1, 1, 1}, false);
    moved_box(&file, place, "right", (double[3]){1 + gap, 0, 0}, (double[3]){2, 1, 1}, false);
    moved_box(&file, place, "top", (double[3]){0.5, 0.5, 1}, (double[3]){1.5, 0.8, 2}, false);
    moved_box(&file, place, "room", (double[3]){-1, -1, -1}, (double[3]){3, 3, 4}, true);
    aur_facets_options options = aur_facets_options_default();
    options.group = true;
    aur_facets *const facets = mesh_load(&file, &options);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    const double measured = factor_at(&m, 3, 6, NULL); /* the sides along x that face each other */
    /* The least change may move what little leaves by the edges, which is about 2 gap. */
    assert_near(measured, expected(gap, 0, 0), 1e-11 + gap);
    check_physics(&m);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

static void test_stood_on(void **state) {
    (void)state;
    static const double gaps[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3};
    const mesh_place here = place_at(0, 0, 0), turned = place_turned(0.7, 0, 0, 0);
    for (size_t g = 0; g < sizeof gaps / sizeof gaps[0]; ++g) {
        check_stood_on(gaps[g], &here);
        check_stood_on(gaps[g], &turned);
    }
}

/* A sheet that looks down lies on a floor that looks up. What rounding leaves between them is no gap: the
 * sheet sees what is below the floor. */
static void test_face_down(void **state) {
    (void)state;
    for (int i = 0; i < 8; ++i) {
        const mesh_place place =
            place_turned(0.4 * i, 500123.25 * (i % 4), 5412345.5 * (i % 4), i % 2 == 0 ? 431.125 : -1e7);
        mesh_file file;
        mesh_begin(&file, "face-down");
        moved_box(&file, &place, "room", (double[3]){0, 0, 0}, (double[3]){4, 5, 3}, true);
        mesh_group(&file, "sheet");
        moved_polygon(&file, &place, 4, (const double[4][3]){{1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}});
        aur_facets_options options = aur_facets_options_default();
        options.group = true;
        aur_facets *const facets = mesh_load(&file, &options);
        aur_view_factors_matrix m;
        aur_view_factors *const factors = factors_of(facets, NULL, &m);
        assert_near(m.sky[6], 1.0, 1e-12);
        for (size_t side = 0; side < 6; ++side)
            assert_near(factor_at(&m, 6, side, NULL), 0.0, 1e-12);
        aur_view_factors_destroy(factors);
        aur_facets_destroy(facets);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gaps), cmocka_unit_test(test_far_away),
                                       cmocka_unit_test(test_stood_on), cmocka_unit_test(test_face_down)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
