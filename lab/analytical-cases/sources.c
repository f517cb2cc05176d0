/* Direct light of sources, light reflected by a surface, and light in closed spaces. */
#include <math.h>

#include "cases.h"

#define BLACK "<bsdf type='twosided'><bsdf type='diffuse'><float name='reflectance' value='0'/></bsdf></bsdf>"

static const double UP[3] = {0.0, 0.0, 1.0};

static lab_receiver up_at(double x, double y, double z) {
    return (lab_receiver){{x, y, z}, {UP[0], UP[1], UP[2]}};
}

/* The solid angle of a square of side s centred on the foot point, from distance `way` (Van Oosterom and
 * Strackee 1983): the power of a point source of intensity 1 through the square. */
static double through_square(const double way[3], double s) {
    const double x[2] = {way[0] - 0.5 * s, way[0] + 0.5 * s}, y[2] = {way[1] - 0.5 * s, way[1] + 0.5 * s};
    double sum = 0.0;
    for (size_t i = 0; i < 2; ++i)
        for (size_t j = 0; j < 2; ++j)
            sum += (i == j ? 1.0 : -1.0) *
                   atan(x[i] * y[j] / (way[2] * sqrt(x[i] * x[i] + y[j] * y[j] + way[2] * way[2])));
    return sum;
}

/* The inverse-square cosine law; and the power through ever smaller squares over their area, extrapolated in
 * s^2 (Richardson 1911). */
static void point_source(lab_case *test_case, double height) {
    lab_case_put(test_case,
                 "<emitter type='point'><float name='intensity' value='100'/><point name='position' x='0' "
                 "y='0' z='%g'/></emitter><shape type='sphere'><point name='center' z='-9'/>%s</shape>",
                 height, BLACK);
    for (int i = 0; i < 10; ++i) {
        const lab_receiver at = up_at(0.5 * i, 0.1 * i * i, 0.0);
        const double way[3] = {at.position[0], at.position[1], height};
        const double squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
        double table[4];
        for (int k = 0; k < 4; ++k) {
            const double s = 0.4 / (1 << k);
            table[k] = through_square(way, s) / (s * s);
        }
        for (int level = 1; level < 4; ++level)
            for (int k = 3; k >= level; --k)
                table[k] += (table[k] - table[k - 1]) / ((1 << 2 * level) - 1);
        lab_case_point(test_case, &at, 100.0 * height / (squared * sqrt(squared)), 100.0 * table[3]);
    }
}

#define EMITTER BLACK "<emitter type='area'><float name='radiance' value='1'/></emitter>"

static void add_patch_points(lab_case *test_case, const lab_patch *patch, size_t count,
                             const lab_receiver *receivers) {
    for (size_t i = 0; i < count; ++i)
        lab_case_point(test_case, &receivers[i], lab_patch_closed(&receivers[i], patch),
                       lab_patch_smooth(&receivers[i], patch, NULL, NULL));
}

static void rectangle_source(lab_case *test_case, double height) {
    const lab_patch emitter = {{-0.5, -1.0, height}, {0.0, 2.0, 0.0}, {1.0, 0.0, 0.0}};
    lab_receiver at[20];
    for (size_t i = 0; i < 20; ++i) {
        at[i] = up_at(0.5 * (double)(i % 5), 0.5 * (double)(i / 5), 0.0);
        if (i % 3 == 2) { /* tilted, with the entire emitter in front */
            at[i].normal[0] = -0.28;
            at[i].normal[2] = 0.96;
        }
    }
    lab_case_patch(test_case, &emitter, EMITTER);
    add_patch_points(test_case, &emitter, 20, at);
}

static void wall_source(lab_case *test_case, double distance) {
    const lab_patch emitter = {{-1.0, distance, 0.2}, {2.0, 0.0, 0.0}, {0.0, 0.0, 1.5}};
    lab_receiver at[20];
    for (size_t i = 0; i < 20; ++i)
        at[i] = up_at(0.5 * (double)(i % 5), 0.5 * (double)(i / 5), 0.0);
    lab_case_patch(test_case, &emitter, EMITTER);
    add_patch_points(test_case, &emitter, 20, at);
}

static void disk_source(lab_case *test_case, double radius) {
    lab_case_put(test_case,
                 "<shape type='disk'><transform name='to_world'><scale value='%g'/><rotate x='1' "
                 "angle='180'/><translate z='2'/></transform>%s</shape>",
                 radius, EMITTER);
    for (int i = 0; i < 12; ++i) {
        const double aside = 0.3 * i;
        const lab_receiver at = up_at(aside * 0.6, aside * 0.8, 0.0);
        lab_case_point(test_case, &at, lab_disk_closed(radius, 2.0, aside),
                       lab_disk_smooth(radius, 2.0, aside));
    }
}

/* A vertical surface lit by parallel light from the front and above: its reflected light. */
static void reflection(lab_case *test_case, double albedo) {
    const lab_patch wall = {{-1.0, 2.0, 0.1}, {2.0, 0.0, 0.0}, {0.0, 0.0, 1.5}};
    char inside[256];
    lab_case head = {.count = 0};
    lab_case_put(&head, "<bsdf type='diffuse'><float name='reflectance' value='%g'/></bsdf>", albedo);
    for (size_t i = 0; i < sizeof inside; ++i)
        inside[i] = head.scene[i];
    lab_case_put(test_case, "<emitter type='directional'><vector name='direction' x='0' y='1' z='-1'/><float "
                            "name='irradiance' value='1'/></emitter>");
    lab_case_patch(test_case, &wall, inside);
    const double slanted = sqrt(0.5), factor = albedo * slanted / LAB_PI;
    for (size_t i = 0; i < 20; ++i) {
        const lab_receiver at = up_at(0.5 * (double)(i % 5), 0.45 * (double)(i / 5), 0.0);
        lab_case_point(test_case, &at, slanted + factor * lab_patch_closed(&at, &wall),
                       cos(0.25 * LAB_PI) + factor * lab_patch_smooth(&at, &wall, NULL, NULL));
    }
}

/* A closed emitting space of constant albedo has the same radiosity everywhere: pi / (1 - albedo); and the
 * sum over numbers of reflections. */
static double by_reflections(double first, double albedo) {
    double sum = 0.0;
    for (double left = first; left > 1e-17 * first; left *= albedo)
        sum += left;
    return sum;
}

#define INSIDE(albedo_)                                                                                      \
    "<boolean name='flip_normals' value='true'/><bsdf type='diffuse'><float name='reflectance' value='%g'/>" \
    "</bsdf>",                                                                                               \
        albedo_

static void glowing_room(lab_case *test_case, const char *shape, double albedo, double reach) {
    lab_case_put(test_case, "<shape type='%s'>", shape);
    lab_case_put(test_case, INSIDE(albedo));
    lab_case_put(test_case, "<emitter type='area'><float name='radiance' value='1'/></emitter></shape>");
    for (size_t i = 0; i < 6; ++i) {
        const lab_receiver at = up_at(0.15 * (double)i, 0.1 * (double)i, reach);
        lab_case_point(test_case, &at, LAB_PI / (1.0 - albedo), by_reflections(LAB_PI, albedo));
    }
}

static void glowing_sphere(lab_case *test_case, double albedo) {
    glowing_room(test_case, "sphere", albedo, -0.3);
}

static void glowing_cube(lab_case *test_case, double albedo) {
    glowing_room(test_case, "cube", albedo, -0.999);
}

/* A point light at the centre of a sphere: 1/r^2, then uniform reflected light, by power balance or by the
 * sum over reflections. Receivers are on the wall. */
static void integrating_sphere(lab_case *test_case, double albedo) {
    lab_case_put(test_case,
                 "<emitter type='point'><float name='intensity' value='1'/></emitter><shape type='sphere'>"
                 "<float name='radius' value='2'/>");
    lab_case_put(test_case, INSIDE(albedo));
    lab_case_put(test_case, "</shape>");
    for (size_t i = 0; i < 6; ++i) {
        const double angle = 0.5 * (double)i, inward[3] = {sin(angle), 0.0, cos(angle)};
        lab_receiver at = {{0}, {0}};
        for (size_t d = 0; d < 3; ++d) {
            at.position[d] = -1.9999 * inward[d];
            at.normal[d] = inward[d];
        }
        /* includes the receiver's small distance to the wall */
        const double direct = 1.0 / (1.9999 * 1.9999), wall = 4.0 * LAB_PI / (16.0 * LAB_PI);
        lab_case_point(test_case, &at, direct + wall * albedo / (1.0 - albedo),
                       direct + by_reflections(wall * albedo, albedo));
    }
}

const lab_case_row lab_source_cases[] = {
    {"point-source", "inverse square; solid angles of squares", point_source, 2.0},
    {"rectangle-above", "along edges; over the area", rectangle_source, 2.0},
    {"rectangle-on-wall", "along edges; over the area", wall_source, 2.5},
    {"disk-above", "closed; over the area", disk_source, 1.0},
    {"reflection-off-wall", "along edges; over the area", reflection, 0.6},
    {"sphere-that-glows", "closed; by reflections", glowing_sphere, 0.5},
    {"cube-that-glows", "closed; by reflections", glowing_cube, 0.5},
    {"integrating-sphere", "by power; by reflections", integrating_sphere, 0.6},
};
const size_t lab_source_case_count = sizeof lab_source_cases / sizeof lab_source_cases[0];
