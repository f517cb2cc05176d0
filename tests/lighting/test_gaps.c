/* Factors across narrow gaps: closed forms from 1e-8 to 1, alone and in rooms, shifted, tilted, far away. */
#include "moved_mesh.h"

/* Parallel rectangles at any position (Ehlert and Smith 1993): the term of two corners. */
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

static void check_gap(double height, double x, double y, bool room, const mesh_pose *pose) {
    mesh_file file;
    mesh_begin(&file, "gap");
    moved_box(&file, pose, "lower", (double[3]){0, 0, 0}, (double[3]){1, 1, 0.5}, false);
    moved_box(&file, pose, "upper", (double[3]){x, y, 0.5 + height}, (double[3]){1 + x, 1 + y, 1 + height},
              false);
    if (room)
        moved_box(&file, pose, "room", (double[3]){-1.5, -2, -1}, (double[3]){2.5, 3, 4}, true);
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = true;
    aur_facets *const facets = mesh_load(&file, &options);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    double width;
    const double measured = factor_at(&m, LOWER, UPPER, &width);
    /* Closed forms err by 1e-11 at most; a corner that moves by a length changes a unit square's factor by
     * not more than twice that, and 0.5 + height is rounded. */
    assert_near(measured, expected(height, x, y), 1e-11 + 16.0 * pose_rounding(pose));
    assert_true(width == 0.0);
    check_physics(&m);
    /* The rest goes to existing surroundings: to the sky, or to the room. */
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
    const mesh_pose here = move_to(0, 0, 0), turned = turned_pose(1.0, 0, 0, 0);
    for (size_t h = 0; h < sizeof heights / sizeof heights[0]; ++h)
        for (int room = 0; room < 2; ++room) {
            check_gap(heights[h], 0.0, 0.0, room, &here);
            check_gap(heights[h], 0.0, 0.0, room, &turned);
            check_gap(heights[h], 0.3, 0.2, room, &turned);
        }
}

/* Gaps that double precision still resolves there. */
static void test_far_away(void **state) {
    (void)state;
    static const double offsets[][3] = {
        {1e5, 1e5, 0}, {2600000, 1200000, 450.25}, {500000.3, 5400000.3, 12.7}, {1e7, 1e7, 1e7}};
    static const double heights[] = {1e-6, 1e-5, 3e-5, 1e-4, 0.1};
    for (size_t i = 0; i < sizeof offsets / sizeof offsets[0]; ++i)
        for (size_t h = i == 3; h < sizeof heights / sizeof heights[0]; ++h)
            for (int room = 0; room < 2; ++room) {
                const double *const o = offsets[i];
                const mesh_pose there = move_to(o[0], o[1], o[2]),
                                turned = turned_pose(0.5 + (double)i, o[0], o[1], o[2]);
                check_gap(heights[h], 0.0, 0.0, room, &there);
                check_gap(heights[h], 0.3, 0.2, room, &turned);
            }
}

/* A third box touches both sides of the gap: it lies on an edge of all light paths across. */
static void check_stood_on(double gap, const mesh_pose *pose) {
    mesh_file file;
    mesh_begin(&file, "stood-on");
    moved_box(&file, pose, "left", (double[3]){0, 0, 0}, (double[3]){1, 1, 1}, false);
    moved_box(&file, pose, "right", (double[3]){1 + gap, 0, 0}, (double[3]){2, 1, 1}, false);
    moved_box(&file, pose, "top", (double[3]){0.5, 0.5, 1}, (double[3]){1.5, 0.8, 2}, false);
    moved_box(&file, pose, "room", (double[3]){-1, -1, -1}, (double[3]){3, 3, 4}, true);
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = true;
    aur_facets *const facets = mesh_load(&file, &options);
    aur_view_factors_matrix m;
    aur_view_factors *const factors = factors_of(facets, NULL, &m);
    const double measured = factor_at(&m, 3, 6, NULL); /* the sides along x that face each other */
    /* The correction may move the small part that leaves at the edges, about 2 gap. */
    assert_near(measured, expected(gap, 0, 0), 1e-11 + gap);
    check_physics(&m);
    aur_view_factors_destroy(factors);
    aur_facets_destroy(facets);
}

static void test_stood_on(void **state) {
    (void)state;
    static const double gaps[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-3};
    const mesh_pose here = move_to(0, 0, 0), turned = turned_pose(0.7, 0, 0, 0);
    for (size_t g = 0; g < sizeof gaps / sizeof gaps[0]; ++g) {
        check_stood_on(gaps[g], &here);
        check_stood_on(gaps[g], &turned);
    }
}

/* A sheet facing down lies on a floor facing up. Rounding leaves no gap between them: the sheet sees what is
 * below the floor. */
static void test_face_down(void **state) {
    (void)state;
    for (int i = 0; i < 8; ++i) {
        const mesh_pose pose =
            turned_pose(0.4 * i, 500123.25 * (i % 4), 5412345.5 * (i % 4), i % 2 == 0 ? 431.125 : -1e7);
        mesh_file file;
        mesh_begin(&file, "face-down");
        moved_box(&file, &pose, "room", (double[3]){0, 0, 0}, (double[3]){4, 5, 3}, true);
        mesh_group(&file, "sheet");
        moved_polygon(&file, &pose, 4, (const double[4][3]){{1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}});
        aur_facets_options options = {.size = sizeof options};
        aur_facets_options_init(&options, NULL);
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

/* Two-sided rugs over .4 of a tiled floor, on top of each other: each sees all of the next one, the covered
 * floor the lowest, and the uncovered floor the sky. Rows: the floor, the rugs, then their backs. */
static aur_facets *load_rugs(double gap, size_t layers, bool rugs_first, const mesh_pose *pose) {
    mesh_file file;
    mesh_begin(&file, "rugs");
    for (int part = 0; part < 2; ++part) {
        if ((part == 0) != rugs_first) {
            mesh_group(&file, "floor");
            for (int i = 0; i < 9; ++i) {
                const double x = i % 3 / 3.0, y = i / 3 / 3.0, side = 1.0 / 3.0;
                moved_polygon(&file, pose, 4,
                              (const double[4][3]){
                                  {x, y, 0}, {x + side, y, 0}, {x + side, y + side, 0}, {x, y + side, 0}});
            }
            continue;
        }
        for (size_t k = 1; k <= layers; ++k) {
            const double z = (double)k * gap;
            char name[8];
            snprintf(name, sizeof name, "rug%zu", k);
            mesh_group(&file, name);
            moved_polygon(&file, pose, 4,
                          (const double[4][3]){{0.1, 0.1, z}, {0.6, 0.1, z}, {0.6, 0.9, z}, {0.1, 0.9, z}});
        }
    }
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = options.both_sides = true;
    return mesh_load(&file, &options);
}

/* The light past the edges of a gap is below its height times their length, relative to the smaller area. */
static double lost_past_edges(double gap) {
    return 2.6 / 0.4 * gap;
}

/* The exact radiosities if all reflect .5 and emit 1: of the floor and the lowest rug's back; between two
 * rugs 2. */
static void check_radiosities(const double *b, const double *widths, size_t layers, bool rugs_first,
                              double slack) {
    const size_t rows = layers + 1, floor = rugs_first ? layers : 0, first = rugs_first ? 0 : 1;
    for (size_t k = 0; k < 2 * rows; ++k) {
        double expected = 2.0;
        if (k == floor)
            expected = 4.0 / 3.0;
        else if (k == rows + first)
            expected = 5.0 / 3.0;
        else if (k == rows + floor || k == first + layers - 1)
            expected = 1.0;
        assert_near(b[k], expected, 3.0 * widths[k] + slack);
    }
}

static void check_rugs(double gap, size_t layers, bool rugs_first, const mesh_pose *pose) {
    aur_facets *const facets = load_rugs(gap, layers, rugs_first, pose);
    const size_t rows = layers + 1, floor = rugs_first ? layers : 0, first = rugs_first ? 0 : 1;
    const double slack = lost_past_edges(gap) + 1e-6;
    assert_int_equal(aur_facets_rows(facets), 2 * rows);
    aur_facets_light light = {.size = sizeof light};
    aur_facets_light_init(&light, NULL);
    light.reflectance = 0.5;
    light.emission = 1.0;
    light.sky = 0.0;
    for (int mode = 0; mode < 3; ++mode) {
        aur_view_factors_options options = {.size = sizeof options};
        aur_view_factors_options_init(&options, NULL);
        options.rays_only = mode == 1;
        aur_view_factors_matrix m;
        aur_view_factors *const factors = mode < 2 ? factors_of(facets, &options, &m) : NULL;
        double radiosities[8], widths[8];
        assert_int_equal(
            aur_view_factors_radiosity(facets, factors, &options, &light, radiosities, widths, NULL, NULL),
            AUR_OK);
        /* Without a matrix the sum of reflections ends at .02 / sqrt(2048) of it. */
        check_radiosities(radiosities, widths, layers, rugs_first, mode < 2 ? slack : slack + 1e-3);
        if (factors == NULL)
            continue;
        /* Half planes and cells give the floor the error of any open floor. */
        const double lower = factor_at(&m, floor, rows + first, NULL);
        assert_near(lower, 0.4, 0.004);
        assert_near(m.sky[floor], 0.6, 0.004);
        assert_near(factor_at(&m, rows + first, floor, NULL), 1.0, slack);
        assert_near(m.sky[first + layers - 1], 1.0, slack);
        for (size_t k = 0; k + 1 < layers; ++k)
            assert_near(factor_at(&m, first + k, rows + first + k + 1, NULL), 1.0, slack);
        for (size_t k = 0; k < 2 * rows; ++k)
            assert_near(m.back[k], 0.0, 1e-12);
        aur_view_factors_destroy(factors);
    }
    aur_facets_destroy(facets);
}

static void test_rugs(void **state) {
    (void)state;
    static const double gaps[] = {1e-9, 3e-8, 1e-7, 1e-6, 5e-6, 1e-4};
    static const double offsets[][3] = {
        {0, 0, 0}, {1e5, 1e5, 0}, {2600000, 1200000, 450.25}, {500000.3, 5200000.3, 12.7}, {1e7, 1e7, 1e7}};
    for (size_t i = 0; i < 5; ++i)
        for (size_t g = 0; g < sizeof gaps / sizeof gaps[0]; ++g) {
            const double *const o = offsets[i];
            if (i > 0 && gaps[g] < 1e-6 * (i == 4 ? 5.0 : 1.0)) /* less than double precision resolves there
                                                                 */
                continue;
            const mesh_pose there = move_to(o[0], o[1], o[2]),
                            turned = turned_pose(0.5 + (double)(i + g), o[0], o[1], o[2]);
            check_rugs(gaps[g], 1 + g % 3, g % 2 == 0, &there);
            check_rugs(gaps[g], 1 + g % 3, g % 2 == 1, &turned);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gaps), cmocka_unit_test(test_far_away),
                                       cmocka_unit_test(test_stood_on), cmocka_unit_test(test_face_down),
                                       cmocka_unit_test(test_rugs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
