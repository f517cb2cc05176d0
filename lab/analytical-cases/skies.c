/* The sun, and the CIE general skies on a horizontal plane and on four walls. */
#include <math.h>

#include "cases.h"

static const double ELEVATION = 35.0;

static void general_sky(lab_case *test_case, double type) {
    const lab_sky sky = lab_sky_of((size_t)type, ELEVATION);
    static const double normals[5][3] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    lab_case_put(
        test_case,
        "<emitter type='sky'><string name='model' value='cie'/><integer name='cie_type' value='%.0f'/>"
        "<float name='irradiance' value='1'/><vector name='up' x='0' y='0' z='1'/>"
        "<vector name='sun_direction' x='%.17g' y='0' z='%.17g'/></emitter>",
        type, sky.sun[0], sky.sun[2]);
    lab_case_put(test_case, "<shape type='sphere'><point name='center' z='-9'/><bsdf type='diffuse'>"
                            "<float name='reflectance' value='0'/></bsdf></shape>");
    double level[2] = {1.0, 1.0};
    for (size_t i = 0; i < 5; ++i) {
        const lab_receiver at = {{0.0, 0.0, 1.0}, {normals[i][0], normals[i][1], normals[i][2]}};
        const double closed = lab_sky_about_zenith(&sky, normals[i]);
        const double smooth = lab_sky_about_horizontal(&sky, normals[i]);
        if (i == 0) {
            level[0] = closed;
            level[1] = smooth;
        }
        /* Both in the first derivation's scale, so that the horizontal plane is compared too. */
        lab_case_point(test_case, &at, closed / level[0], smooth / level[0]);
    }
}

typedef struct tilt {
    double rise, sine, cosine;
} tilt;

static double of_sun(const void *data, double t, double azimuth) {
    const tilt *const self = data;
    const double cosine = 1.0 - t * self->rise, sine = sqrt(t * self->rise * (1.0 + cosine));
    return self->rise * (cosine * self->cosine + sine * self->sine * cos(azimuth));
}

/* A small disk of sky: its irradiance on the plane that faces it times the cosine at its centre, for any
 * plane that sees all of it; and the integral over the disk. */
static void sun(lab_case *test_case, double half_angle) {
    lab_case_put(
        test_case,
        "<emitter type='sun'><float name='irradiance' value='1'/><float name='half_angle' "
        "value='%g'/><vector name='sun_direction' x='0.6' y='0' z='0.8'/></emitter>"
        "<shape type='sphere'><point name='center' z='-9'/><bsdf type='diffuse'><float name='reflectance' "
        "value='0'/></bsdf></shape>",
        half_angle);
    const double half = sin(0.5 * half_angle * LAB_PI / 180.0), sine = sin(half_angle * LAB_PI / 180.0);
    const double radiance = 1.0 / (LAB_PI * sine * sine);
    for (size_t i = 0; i < 10; ++i) {
        const double angle = 0.14 * (double)i;
        const double tangent[3] = {0.8, 0.0, -0.6}, center[3] = {0.6, 0.0, 0.8};
        lab_receiver at = {{0.0, 0.0, 1.0}, {0}};
        for (size_t d = 0; d < 3; ++d)
            at.normal[d] = cos(angle) * center[d] + sin(angle) * tangent[d];
        const tilt view = {2.0 * half * half, sin(angle), cos(angle)};
        lab_case_point(
            test_case, &at, cos(angle),
            2.0 * radiance *
                lab_integrate(of_sun, &view, (const double[2]){0.0, 1.0}, (const double[2]){0.0, LAB_PI}));
    }
}

#define GENERAL(type_)                                                                                       \
    { "cie-sky-" #type_, "about the zenith; about an axis", general_sky, type_ }

const lab_case_row lab_sky_cases[] = {
    {"sun", "closed; over the disk", sun, 0.2665},
    {"sun-in-haze", "closed; over the disk", sun, 5.0},
    GENERAL(1),
    GENERAL(2),
    GENERAL(3),
    GENERAL(4),
    GENERAL(5),
    GENERAL(6),
    GENERAL(7),
    GENERAL(8),
    GENERAL(9),
    GENERAL(10),
    GENERAL(11),
    GENERAL(12),
    GENERAL(13),
    GENERAL(14),
    GENERAL(15),
};
const size_t lab_sky_case_count = sizeof lab_sky_cases / sizeof lab_sky_cases[0];
