#include "check.h"

#include "scene/lights/spherical_rectangle.h"

enum { GRID = 400 };
static const float LEAST = 0.15f; /* steradians */

/* A rectangle of 2 x 1 about `middle`, turned in its plane. */
static aur_rectangle make_rectangle(aur_vector middle) {
    const float c = 0.8f, s = 0.6f;
    const aur_rectangle r = {.x = {c, 0.0f, s}, .y = {-s, 0.0f, c}, .width = 2.0f, .height = 1.0f};
    aur_rectangle placed = r;
    placed.corner = aur_vector_add_scaled(aur_vector_add_scaled(middle, -1.0f, r.x), -0.5f, r.y);
    return placed;
}

static aur_vector point_of(const aur_rectangle *r, double s, double t) {
    const aur_vector along = aur_vector_add_scaled(r->corner, (float)s * r->width, r->x);
    return aur_vector_add_scaled(along, (float)t * r->height, r->y);
}

/* The solid angle under which the part up to (s, t) is seen from the origin, by summing small pieces. */
static double solid_angle_of_part(const aur_rectangle *r, double s, double t) {
    const aur_vector normal = aur_vector_cross(r->x, r->y);
    double sum = 0.0;
    for (size_t i = 0; i < GRID; ++i)
        for (size_t k = 0; k < GRID; ++k) {
            const aur_vector p = point_of(r, s * ((double)i + 0.5) / GRID, t * ((double)k + 0.5) / GRID);
            const double squared = (double)aur_vector_dot(p, p);
            sum += fabs((double)aur_vector_dot(p, normal)) / (squared * sqrt(squared));
        }
    return sum * s * t * (double)(r->width * r->height) / ((double)GRID * GRID);
}

static const aur_vector middles[] = {
    {0.0f, 1.0f, 0.0f}, {0.3f, -0.4f, 0.2f}, {1.2f, 1.0f, -0.6f}, {-0.7f, 0.05f, 0.1f}, {0.5f, 2.5f, 1.0f}};
enum { MIDDLE_COUNT = sizeof middles / sizeof middles[0] };

/* The pieces sum to the closed form, and so many of the points that u, v stand for lie in a part of the
 * rectangle as its solid angle says: u cuts strips, v cuts within a strip. */
static void points_are_uniform_by_solid_angle(void **state) {
    (void)state;
    const aur_vector origin = {0};
    for (size_t i = 0; i < MIDDLE_COUNT; ++i) {
        const aur_rectangle r = make_rectangle(middles[i]);
        aur_spherical_rectangle seen;
        assert_true(aur_spherical_rectangle_create(&r, origin, LEAST, &seen));
        assert_relative(seen.solid_angle, solid_angle_of_part(&r, 1.0, 1.0), 3e-3);
        for (size_t k = 1; k < 8; ++k) {
            float s, t;
            const float u = (float)k / 8.0f;
            aur_spherical_rectangle_sample(&seen, u, 0.5f, &s, &t);
            assert_near(solid_angle_of_part(&r, (double)s, 1.0) / (double)seen.solid_angle, u, 4e-3);
        }
        size_t inside = 0;
        for (size_t k = 0; k < GRID * GRID; ++k) {
            float s, t;
            aur_spherical_rectangle_sample(&seen, ((float)(k % GRID) + 0.5f) / GRID,
                                           ((float)(k / GRID) + 0.5f) / GRID, &s, &t);
            inside += s < 0.6f && t < 0.3f ? 1 : 0;
        }
        assert_near((double)inside / ((double)GRID * GRID),
                    solid_angle_of_part(&r, 0.6, 0.3) / (double)seen.solid_angle, 6e-3);
    }
}

/* Sixteen samples of a light at once: points and densities of the single ones, by solid angle near it (to the
 * bit, whatever instructions do it) and by area far from it; none from behind. */
static void lanes_are_the_single_samples(void **state) {
    (void)state;
    const aur_rectangle r = make_rectangle((aur_vector){0.0f, 0.0f, 0.0f});
    const aur_rectangle_light light = {.rectangle = r,
                                       .normal = {0.0f, 1.0f, 0.0f},
                                       .radiance = {3.0f, 2.0f, 1.0f},
                                       .area = 2.0f,
                                       .probability = 0.25f};
    aur_lane_vectors reference;
    aur_lane_numbers u, v;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float height = k == 3 ? -1.0f : 0.3f + 0.7f * (float)k;
        aur_lane_set(&reference, k, (aur_vector){0.1f * (float)(k % 5), height, -0.2f * (float)(k % 3)});
        u[k] = ((float)k + 0.5f) / AUR_PACKET_SIZE;
        v[k] = ((float)(k * 5 % AUR_PACKET_SIZE) + 0.5f) / AUR_PACKET_SIZE;
    }
    aur_light_lanes drawn;
    aur_rectangle_kernels_here()->lanes(&light, LEAST, &reference, u, v, &drawn);
    size_t by_angle = 0, by_area = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_vector from = aur_lane_vector(&reference, k);
        aur_spherical_rectangle seen;
        float s = u[k], t = v[k];
        double pdf;
        const bool good = aur_spherical_rectangle_create(&r, from, LEAST, &seen);
        if (good)
            aur_spherical_rectangle_sample(&seen, u[k], v[k], &s, &t);
        const aur_vector point = point_of(&r, (double)s, (double)t);
        const aur_vector same =
            aur_vector_add_scaled(aur_vector_add_scaled(r.corner, s, aur_vector_scale(r.x, r.width)), t,
                                  aur_vector_scale(r.y, r.height));
        const aur_vector told = aur_lane_vector(&drawn.position, k);
        assert_true(same.x == told.x && same.y == told.y && same.z == told.z);
        assert_true(!good || k == 3 || drawn.pdf[k] == 0.25f * (1.0f / seen.solid_angle));
        const aur_vector way = aur_vector_subtract(from, point);
        const double squared = (double)aur_vector_dot(way, way);
        pdf = good ? 1.0 / (double)seen.solid_angle : squared * sqrt(squared) / (2.0 * (double)way.y);
        assert_near(aur_vector_length(aur_vector_subtract(aur_lane_vector(&drawn.position, k), point)), 0.0,
                    1e-6);
        assert_relative(drawn.pdf[k], k == 3 ? 0.0 : 0.25 * pdf, 1e-5);
        assert_true(drawn.radiance.x[k] == 3.0f && drawn.radiance.z[k] == 1.0f && drawn.rivals[k] == 1.0f);
        by_angle += good && k != 3;
        by_area += !good;
    }
    assert_true(by_angle > 3 && by_area > 3);
}

/* Too far to be told from a point, or seen edge on: the caller is to draw by area. */
static void small_angles_are_refused(void **state) {
    (void)state;
    aur_spherical_rectangle seen;
    const aur_rectangle far_off = make_rectangle((aur_vector){0.0f, 40.0f, 0.0f});
    const aur_rectangle edge_on = make_rectangle((aur_vector){3.0f, 0.0f, 0.0f});
    assert_true(aur_spherical_rectangle_create(&far_off, (aur_vector){0}, 0.001f, &seen));
    assert_relative(seen.solid_angle, 2.0 / 1600.0, 1e-2);
    assert_false(aur_spherical_rectangle_create(&far_off, (aur_vector){0}, LEAST, &seen));
    assert_false(aur_spherical_rectangle_create(&edge_on, (aur_vector){0}, LEAST, &seen));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_are_uniform_by_solid_angle),
                                       cmocka_unit_test(lanes_are_the_single_samples),
                                       cmocka_unit_test(small_angles_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
