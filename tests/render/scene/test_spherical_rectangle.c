#include "check.h"

#include "render/scene/lights/spherical_rectangle.h"

enum { GRID = 400 };

/* A rectangle of 2 x 1 about `middle`, turned in its plane. */
static aur_rectangle make_rectangle(aur_vector middle) {
    const float c = 0.8f, s = 0.6f;
    const aur_rectangle r = {.x = {c, 0.0f, s}, .y = {-s, 0.0f, c}, .width = 2.0f, .height = 1.0f};
    aur_rectangle result = r;
    result.corner = aur_vector_add_scaled(aur_vector_add_scaled(middle, -1.0f, r.x), -0.5f, r.y);
    return result;
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

/* The pieces sum to the closed form, and the fraction of u, v in a part of the rectangle is that of its solid
 * angle: u cuts strips, v cuts within a strip. */
static void points_are_uniform_by_solid_angle(void **state) {
    (void)state;
    const aur_vector origin = {0};
    for (size_t i = 0; i < MIDDLE_COUNT; ++i) {
        const aur_rectangle r = make_rectangle(middles[i]);
        aur_spherical_rectangle seen;
        assert_true(aur_spherical_rectangle_create(&r, origin, &seen));
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

/* Light from above, aslant, along the rectangle's plane (which then crosses the horizon), from all sides. */
static const aur_vector normals[] = {
    {0.0f, 1.0f, 0.0f}, {0.48f, 0.6f, -0.64f}, {0.6f, 0.0f, 0.8f}, {0.0f, -0.96f, 0.28f}, {0.0f, 0.0f, 0.0f}};
enum { NORMAL_COUNT = sizeof normals / sizeof normals[0] };

enum { STEPS = 150 };

static float step(size_t k) {
    return ((float)k + 0.5f) / STEPS;
}

/* Steradians an area of 1, in parts of width and height, about the point. */
static double solid_angle_about(const aur_rectangle *r, aur_vector p) {
    const double squared = (double)aur_vector_dot(p, p);
    const double height = fabs((double)aur_vector_dot(p, aur_vector_cross(r->x, r->y)));
    return height / (squared * sqrt(squared)) * (double)(r->width * r->height);
}

/* The integral of a pdf over that area. */
static double by_area(const aur_seen_rectangle *seen, double solid_angle, float density) {
    return seen->by_area ? (double)density : (double)density * solid_angle;
}

/* Pdfs integrate to 1 over the rectangle, and sampling returns the pdf of evaluation. The midpoint rule has
 * an error below 4e-3 for points as near as here. */
static void densities_add_up(void **state) {
    (void)state;
    static const float scales[] = {1.0f, 6.0f}; /* by solid angle, by area */
    for (size_t i = 0; i < MIDDLE_COUNT * NORMAL_COUNT * 2; ++i) {
        const aur_rectangle r = make_rectangle(
            aur_vector_scale(middles[i % MIDDLE_COUNT], scales[i / (MIDDLE_COUNT * NORMAL_COUNT)]));
        const aur_light_reference origin = {.normal = normals[i / MIDDLE_COUNT % NORMAL_COUNT]};
        const aur_seen_rectangle seen = aur_rectangle_see(&r, &origin);
        double sum = 0.0;
        for (size_t k = 0; k < STEPS * STEPS; ++k) {
            const float s = step(k % STEPS), t = step(k / STEPS);
            const double solid_angle = solid_angle_about(&r, point_of(&r, (double)s, (double)t));
            sum += by_area(&seen, solid_angle, aur_seen_rectangle_density(&seen, s, t)) / (STEPS * STEPS);
            if (k % 127 != 0)
                continue;
            float x, y;
            const float expected = aur_seen_rectangle_draw(&seen, s, t, &x, &y);
            assert_relative(aur_seen_rectangle_density(&seen, x, y), expected, 2e-3);
        }
        assert_near(sum, 1.0, 4e-3);
    }
}

/* The cosine's integral over the rectangle (Lambert 1760), which is all above the horizon. */
static double closed_irradiance(const aur_rectangle *r, aur_vector normal) {
    static const double corners[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    double sum = 0.0;
    for (size_t i = 0; i < 4; ++i) {
        const aur_vector a = point_of(r, corners[i][0], corners[i][1]);
        const aur_vector b = point_of(r, corners[i + 1][0], corners[i + 1][1]);
        const aur_vector cross = aur_vector_cross(a, b);
        const double size = (double)aur_vector_length(cross);
        sum += atan2(size, (double)aur_vector_dot(a, b)) * (double)aur_vector_dot(normal, cross) / size;
    }
    return 0.5 * fabs(sum);
}

/* The mean of irradiance samples over a grid of u, v; *variance is over the squared mean. */
static double drawn_irradiance(const aur_rectangle *r, aur_vector normal, aur_vector drawn_for,
                               double *variance) {
    const aur_light_reference origin = {.normal = drawn_for};
    const aur_seen_rectangle seen = aur_rectangle_see(r, &origin);
    double sum = 0.0, squares = 0.0;
    for (size_t k = 0; k < STEPS * STEPS; ++k) {
        float s, t;
        const float density = aur_seen_rectangle_draw(&seen, step(k % STEPS), step(k / STEPS), &s, &t);
        const aur_vector p = point_of(r, (double)s, (double)t);
        const double solid_angle = solid_angle_about(r, p);
        const double cosine = (double)aur_vector_dot(normal, p) / (double)aur_vector_length(p);
        const double value = fmax(cosine, 0.0) * solid_angle / by_area(&seen, solid_angle, density);
        sum += value / (STEPS * STEPS);
        squares += value * value / (STEPS * STEPS);
    }
    *variance = squares / (sum * sum) - 1.0;
    return sum;
}

/* Samples for a normal have the mean of those without and never more variance, to the grid's error; if the
 * rectangle is completely above the horizon that is the closed form, with .13 of the variance on average. */
static void cosines_are_drawn(void **state) {
    (void)state;
    static const float scales[] = {1.0f, 2.5f, 6.0f};
    size_t whole = 0, crossing = 0;
    double ratios = 0.0;
    for (size_t i = 0; i < 3 * MIDDLE_COUNT * (NORMAL_COUNT - 1); ++i) {
        const aur_vector normal = normals[i % (NORMAL_COUNT - 1)], none = {0};
        const size_t combination = i / (NORMAL_COUNT - 1);
        const aur_rectangle r = make_rectangle(
            aur_vector_scale(middles[combination % MIDDLE_COUNT], scales[combination / MIDDLE_COUNT]));
        double lowest = 1.0, variance, plain_variance;
        for (size_t c = 0; c < 4; ++c) {
            const aur_vector p = point_of(&r, (double)(c & 1), (double)(c >> 1));
            lowest = fmin(lowest, (double)(aur_vector_dot(normal, p) / aur_vector_length(p)));
        }
        const double mean = drawn_irradiance(&r, normal, normal, &variance);
        const double plain = drawn_irradiance(&r, normal, none, &plain_variance);
        if (mean == 0.0)
            continue;
        assert_relative(mean, plain, 2e-2);
        assert_true(variance <= 1.001 * plain_variance);
        crossing += lowest < 0.0;
        if (lowest < 0.05)
            continue;
        assert_relative(mean, closed_irradiance(&r, normal), 2e-4);
        if (plain_variance < 2e-3)
            continue;
        ratios += variance / plain_variance;
        ++whole;
    }
    assert_true(whole > 15 && crossing > 10);
    assert_true(ratios / (double)whole < 0.14);
}

/* Sixteen samples of a light at once: points and densities of the single ones to the bit, whatever
 * instructions do it, by solid angle near it and by area far from it; none from behind. */
static void lanes_are_the_single_samples(void **state) {
    (void)state;
    const aur_rectangle r = make_rectangle((aur_vector){0.0f, 0.0f, 0.0f});
    const aur_rectangle_light light = {.rectangle = r,
                                       .normal = {0.0f, 1.0f, 0.0f},
                                       .radiance = {3.0f, 2.0f, 1.0f},
                                       .area = 2.0f,
                                       .rounding = 1e-6f};
    aur_lane_vectors position, normal;
    aur_lane_numbers u, v;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float height = k == 3 ? -1.0f : 0.3f + 0.7f * (float)k;
        aur_lane_set(&position, k, (aur_vector){0.1f * (float)(k % 5), height, -0.2f * (float)(k % 3)});
        aur_lane_set(&normal, k, normals[k % NORMAL_COUNT]);
        u[k] = ((float)k + 0.5f) / AUR_PACKET_SIZE;
        v[k] = ((float)(k * 5 % AUR_PACKET_SIZE) + 0.5f) / AUR_PACKET_SIZE;
    }
    aur_light_lanes drawn;
    const aur_light_references references = {&position, &normal};
    AUR_KERNEL_HERE(aur_rectangle_kernels).lanes(&light, &references, u, v, &drawn);
    size_t solid = 0, flat = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_light_reference from = {aur_lane_vector(&position, k), aur_lane_vector(&normal, k)};
        const aur_seen_rectangle seen = aur_rectangle_see(&r, &from);
        float s, t;
        const float density = aur_seen_rectangle_draw(&seen, u[k], v[k], &s, &t);
        const aur_vector same =
            aur_vector_add_scaled(aur_vector_add_scaled(r.corner, s, aur_vector_scale(r.x, r.width)), t,
                                  aur_vector_scale(r.y, r.height));
        const aur_vector expected = aur_lane_vector(&drawn.position, k);
        const aur_vector end = aur_surface_target(from.position, same, light.normal, light.rounding);
        assert_true(end.x == expected.x && end.y == expected.y && end.z == expected.z);
        const aur_vector way = aur_vector_subtract(from.position, same);
        const double squared = (double)aur_vector_dot(way, way);
        const double pdf =
            (double)density * (seen.by_area ? squared * sqrt(squared) / (2.0 * (double)way.y) : 1.0);
        assert_relative(drawn.pdf[k], k == 3 ? 0.0 : pdf, 1e-5);
        assert_true(drawn.radiance.x[k] == 3.0f && drawn.radiance.z[k] == 1.0f && drawn.reachable[k] == 1.0f);
        solid += !seen.by_area && k != 3;
        flat += seen.by_area;
    }
    assert_true(solid > 3 && flat > 3);
}

/* Too far, or seen edge on: they are drawn by area. */
static void small_angles_are_refused(void **state) {
    (void)state;
    aur_spherical_rectangle seen;
    const aur_rectangle far_off = make_rectangle((aur_vector){0.0f, 40.0f, 0.0f});
    const aur_rectangle edge_on = make_rectangle((aur_vector){3.0f, 0.0f, 0.0f});
    assert_false(aur_spherical_rectangle_create(&far_off, (aur_vector){0}, &seen));
    assert_false(aur_spherical_rectangle_create(&edge_on, (aur_vector){0}, &seen));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_uniform_by_solid_angle), cmocka_unit_test(densities_add_up),
        cmocka_unit_test(cosines_are_drawn), cmocka_unit_test(lanes_are_the_single_samples),
        cmocka_unit_test(small_angles_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
