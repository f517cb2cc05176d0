#include "sphere_check.h"

#include <string.h>

#include "points/sphere/phase.h"

static const aur_map maps[] = {AUR_MAP_LAMBERT, AUR_MAP_CONCENTRIC, AUR_MAP_AZIMUTHAL, AUR_MAP_POLAR};

/* Corners, edges, diagonals and a grid of the square. */
static size_t squares(double points[][2]) {
    static const double coordinates[] = {0.0, 1e-12, 0.125, 0.25, 0.3, 0.5, 0.61, 0.75, 0.999, 1.0 - 1e-12};
    size_t count = 0;
    for (size_t i = 0; i < 10; ++i) {
        for (size_t k = 0; k < 10; ++k) {
            points[count][0] = coordinates[i];
            points[count++][1] = coordinates[k];
        }
    }
    return count;
}

static void names_round_trip(void **state) {
    (void)state;
    for (size_t m = 0; m < 4; ++m) {
        aur_map map;
        assert_int_equal(aur_map_from_name(aur_map_name(maps[m]), &map, NULL), AUR_OK);
        assert_int_equal(map, maps[m]);
    }
    aur_map map;
    aur_error error = {0};
    assert_int_equal(aur_map_from_name("mercator", &map, &error), AUR_ERROR_NAME);
    assert_non_null(strstr(error.message, "concentric"));
    assert_null(aur_map_name((aur_map)99));
}

/* Closed forms of mathematics: z = 1 - u and 1 - 2u at the azimuth 2 pi v; r = sqrt u; r = u. */
static void lambert_and_polar_are_what_they_say(void **state) {
    (void)state;
    double points[100][2], direction[3], disk[2];
    const size_t count = squares(points);
    for (size_t i = 0; i < count; ++i) {
        const double u = points[i][0];
        const double phi = 2.0 * AUR_PI * points[i][1];
        aur_map_to_cap(AUR_MAP_LAMBERT, AUR_CAP_SPHERE, 1, points[i], direction, NULL);
        assert_near(direction[2], 1.0 - 2.0 * u, 1e-15);
        assert_near(direction[0], sqrt(4.0 * u * (1.0 - u)) * cos(phi), 1e-15);
        assert_near(direction[1], sqrt(4.0 * u * (1.0 - u)) * sin(phi), 1e-15);
        aur_map_to_cap(AUR_MAP_LAMBERT, AUR_CAP_HEMISPHERE, 1, points[i], direction, NULL);
        assert_near(direction[2], 1.0 - u, 1e-15);
        aur_map_to_disk(AUR_MAP_AZIMUTHAL, 1, points[i], disk, NULL);
        assert_near(disk[0], sqrt(u) * cos(phi), 1e-15);
        aur_map_to_disk(AUR_MAP_POLAR, 1, points[i], disk, NULL);
        assert_near(disk[1], u * sin(phi), 1e-15);
        assert_near(aur_map_weight(AUR_MAP_POLAR, points[i]), 2.0 * u, 0);
    }
}

/* Shirley and Chiu 1997: the square about the centre of half side r becomes the circle of radius r, and the
 * azimuth runs linearly along each eighth of it. */
static void concentric_is_shirley_and_chiu(void **state) {
    (void)state;
    double points[100][2], disk[2];
    const size_t count = squares(points);
    for (size_t i = 0; i < count; ++i) {
        const double a = 2.0 * points[i][0] - 1.0;
        const double b = 2.0 * points[i][1] - 1.0;
        double radius, phi;
        if (a > -b && a > b) {
            radius = a;
            phi = AUR_PI / 4.0 * (b / a);
        } else if (a > -b) {
            radius = b;
            phi = AUR_PI / 4.0 * (2.0 - a / b);
        } else if (a < b) {
            radius = -a;
            phi = AUR_PI / 4.0 * (4.0 + b / a);
        } else {
            radius = -b;
            phi = b != 0.0 ? AUR_PI / 4.0 * (6.0 - a / b) : 0.0;
        }
        aur_map_to_disk(AUR_MAP_CONCENTRIC, 1, points[i], disk, NULL);
        assert_near(disk[0], radius * cos(phi), 1e-15);
        assert_near(disk[1], radius * sin(phi), 1e-15);
    }
}

/* Distances on the domain after going back and forth; on the square away from the pole, where the azimuth is
 * none. */
static void inverses_round_trip(void **state) {
    (void)state;
    static const double heights[] = {1e-3, 0.4, 1.0, 1.7, 2.0};
    double points[100][2];
    const size_t count = squares(points);
    for (size_t m = 0; m < 4; ++m) {
        for (size_t i = 0; i < count; ++i) {
            double disk[2], square[2], again[3], direction[3];
            aur_map_to_disk(maps[m], 1, points[i], disk, NULL);
            aur_map_from_disk(maps[m], 1, disk, square, NULL);
            assert_true(square[0] >= 0.0 && square[0] < 1.0 && square[1] >= 0.0 && square[1] < 1.0);
            aur_map_to_disk(maps[m], 1, square, again, NULL);
            assert_near(hypot(again[0] - disk[0], again[1] - disk[1]), 0.0, 2e-15);
            if (points[i][0] >= 0.1 && points[i][0] != 0.5 && points[i][1] > 0.0) {
                assert_near(square[0], points[i][0], 2e-15);
                assert_near(square[1], points[i][1], 2e-15);
            }
            for (size_t h = 0; h < 5; ++h) {
                aur_map_to_cap(maps[m], heights[h], 1, points[i], direction, NULL);
                assert_near(check_dot(direction, direction), 1.0, 1e-15);
                assert_true(direction[2] >= 1.0 - heights[h] - 1e-15);
                aur_map_from_cap(maps[m], heights[h], 1, direction, square, NULL);
                assert_true(square[0] >= 0.0 && square[0] < 1.0 && square[1] >= 0.0 && square[1] < 1.0);
                aur_map_to_cap(maps[m], heights[h], 1, square, again, NULL);
                assert_near(check_distance(again, direction), 0.0, 1e-7 * sqrt(heights[h] / 2.0));
                if (points[i][0] > 0.1 && points[i][0] < 0.9 && points[i][1] > 0.1 && points[i][1] < 0.9)
                    assert_near(check_distance(again, direction), 0.0, 4e-15);
            }
        }
    }
}

/* Area is preserved: the share of a fine grid that falls into a random cap is the share of the area, to the
 * grid's accuracy. A map that does not preserve area is off by several percent. */
static void area_is_preserved(void **state) {
    (void)state;
    enum { SIDE = 256 };
    for (size_t m = 0; m < 4; ++m) {
        for (uint64_t attempt = 0; attempt < 4; ++attempt) {
            double axis[3];
            check_random_direction(7, attempt, axis);
            double inside = 0.0;
            for (size_t i = 0; i < SIDE * SIDE; ++i) {
                const double square[2] = {((double)(i % SIDE) + 0.5) / SIDE,
                                          ((double)(i / SIDE) + 0.5) / SIDE};
                double direction[3];
                aur_map_to_cap(maps[m], AUR_CAP_SPHERE, 1, square, direction, NULL);
                if (check_dot(axis, direction) > 0.4)
                    inside += aur_map_weight(maps[m], square);
            }
            assert_near(inside / (SIDE * SIDE), 0.3, 0.002);
        }
    }
}

static void phases_turn_as_they_should(void **state) {
    (void)state;
    for (uint64_t i = 0; i < 4096; ++i) {
        const uint64_t phase = i < 64 ? i << 58 : aur_mix64(i);
        double sine, cosine;
        aur_phase_sincos(phase, &sine, &cosine);
        const long double angle = 2.0L * acosl(-1.0L) * ((long double)(int64_t)phase * 0x1p-64L);
        assert_near(sine, (double)sinl(angle), 3e-16);
        assert_near(cosine, (double)cosl(angle), 3e-16);
        assert_near(sine * sine + cosine * cosine, 1.0, 5e-16);
    }
    double sine, cosine;
    aur_phase_sincos(UINT64_C(3) << 62, &sine, &cosine);
    assert_true(sine == -1.0 && fabs(cosine) == 0.0);
    assert_true(aur_phase_from_turns(-0.25) == UINT64_C(3) << 62);
    assert_true(aur_phase_from_turns(-1e-20) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_round_trip),
        cmocka_unit_test(lambert_and_polar_are_what_they_say),
        cmocka_unit_test(concentric_is_shirley_and_chiu),
        cmocka_unit_test(inverses_round_trip),
        cmocka_unit_test(area_is_preserved),
        cmocka_unit_test(phases_turn_as_they_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
