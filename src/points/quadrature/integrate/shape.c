#include "points/quadrature/integrate/shape.h"

#include <math.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "points/sphere/map.h"
#include "points/sphere/rotations/hopf.h"

/* The smallest squared distance of points from a singularity: nearer points would be affected by the rounding
 * of coordinates. The map makes the function nearly constant there. */
static const double NEAREST = 1e-24;

bool aur_shape_is_directions(const aur_integrate_options *options) {
    return options->region == AUR_REGION_DOMAIN &&
           (options->domain == AUR_DOMAIN_SPHERE || options->domain == AUR_DOMAIN_HEMISPHERE ||
            options->domain == AUR_DOMAIN_AXES);
}

static bool is_cube(const aur_integrate_options *options) {
    return options->region == AUR_REGION_DOMAIN &&
           (options->domain == AUR_DOMAIN_CUBE || options->domain == AUR_DOMAIN_SQUARE);
}

double aur_shape_cap_height(const aur_integrate_options *options) {
    if (options->cap_degrees > 0.0)
        return 2.0 * pow(sin(0.5 * options->cap_degrees / 180.0 * AUR_PI), 2.0);
    return options->domain == AUR_DOMAIN_SPHERE ? 2.0 : 1.0;
}

size_t aur_shape_dimension(const aur_integrate_options *options) {
    if (options->region != AUR_REGION_DOMAIN)
        return options->region == AUR_REGION_TRIANGLE ? 2 : 3;
    if (options->domain == AUR_DOMAIN_CUBE)
        return options->dimension;
    return options->domain == AUR_DOMAIN_ROTATIONS ? 3 : 2;
}

size_t aur_integrate_coordinates(const aur_integrate_options *options) {
    if (aur_shape_is_directions(options))
        return 3;
    return options->region == AUR_REGION_DOMAIN && options->domain == AUR_DOMAIN_ROTATIONS
               ? 4
               : aur_shape_dimension(options);
}

double aur_shape_measure(const aur_integrate_options *options) {
    switch (options->region) {
    case AUR_REGION_BALL:
        return 4.0 * AUR_PI / 3.0;
    case AUR_REGION_TRIANGLE:
        return 0.5;
    case AUR_REGION_TETRAHEDRON:
        return 1.0 / 6.0;
    default:
        break;
    }
    if (options->domain == AUR_DOMAIN_DISK)
        return AUR_PI;
    if (!aur_shape_is_directions(options))
        return 1.0;
    return 2.0 * AUR_PI *
           (options->exponent > 0.0 ? 1.0 / (options->exponent + 1.0) : aur_shape_cap_height(options));
}

double aur_shape_share_degrees(const aur_integrate_options *options, double share) {
    if (!aur_shape_is_directions(options))
        return 0.0;
    const double part = fmin(share, 1.0);
    const double height = options->exponent > 0.0 ? -expm1(log1p(-part) / (options->exponent + 1.0))
                                                  : part * aur_shape_cap_height(options);
    return 2.0 * asin(sqrt(0.5 * height)) * 180.0 / AUR_PI;
}

/* The simplex from the cube (Devroye 1986, ch. V.2): one root per dimension, one after another. */
static void to_simplex(size_t dimension, const double *cube, double *point) {
    double rest = 1.0;
    for (size_t d = 0; d < dimension; ++d) {
        const double left = dimension - d == 1   ? 1.0 - cube[d]
                            : dimension - d == 2 ? sqrt(1.0 - cube[d])
                                                 : cbrt(1.0 - cube[d]);
        point[d] = rest * (1.0 - left);
        rest *= left;
    }
}

void aur_shape_point(const aur_integrate_options *options, const double *cube, double *point) {
    const size_t dimension = aur_shape_dimension(options);
    if (aur_shape_is_directions(options)) {
        aur_point_to_cap(AUR_MAP_LAMBERT, aur_shape_cap_height(options), cube, point);
        const aur_lobe lobe = {.exponent = options->exponent};
        if (options->exponent > 0.0)
            aur_lobe_warp(&lobe, 1, point, point);
    } else if (options->region == AUR_REGION_BALL) {
        aur_point_to_cap(AUR_MAP_LAMBERT, 2.0, cube, point);
        const double radius = cbrt(cube[2]);
        for (size_t d = 0; d < 3; ++d)
            point[d] *= radius;
    } else if (options->region != AUR_REGION_DOMAIN) {
        to_simplex(dimension, cube, point);
    } else if (options->domain == AUR_DOMAIN_DISK) {
        aur_point_to_disk(AUR_MAP_CONCENTRIC, cube, point);
    } else if (options->domain == AUR_DOMAIN_ROTATIONS) {
        AUR_KERNEL_HERE(aur_hopf).lift(1, cube, point);
    } else {
        memcpy(point, cube, dimension * sizeof *point);
    }
}

/* --- peaks */

static double peak_height(const aur_integrate_options *options, const aur_integrate_peak *peak) {
    const double most = options->domain == AUR_DOMAIN_AXES ? 90.0 : 180.0;
    const double degrees = peak->radius > 0.0 ? fmin(peak->radius, most) : most;
    return 2.0 * pow(sin(0.5 * degrees / 180.0 * AUR_PI), 2.0);
}

/* The interval of a box along one side of the cube. */
static double peak_side(const aur_integrate_peak *peak, size_t d, double *from) {
    const double half = peak->radius > 0.0 ? peak->radius : 1.0;
    *from = fmax(peak->centre[d] - half, 0.0);
    return fmin(peak->centre[d] + half, 1.0) - *from;
}

double aur_shape_peak_measure(const aur_integrate_options *options, const aur_integrate_peak *peak) {
    if (!is_cube(options))
        return 2.0 * AUR_PI * peak_height(options, peak);
    double volume = 1.0, from;
    for (size_t d = 0; d < aur_shape_dimension(options); ++d)
        volume *= peak_side(peak, d, &from);
    return volume;
}

bool aur_shape_peak_holds(const aur_integrate_options *options, const aur_integrate_peak *peak,
                          const double *point) {
    if (peak->radius == 0.0)
        return true;
    if (!is_cube(options)) {
        const double cosine = aur_dot3(point, peak->centre);
        return 1.0 - (options->domain == AUR_DOMAIN_AXES ? fabs(cosine) : cosine) <=
               peak_height(options, peak);
    }
    for (size_t d = 0; d < aur_shape_dimension(options); ++d)
        if (fabs(point[d] - peak->centre[d]) > peak->radius)
            return false;
    return true;
}

/* Heights t = h s^b with b = 2 / (2 - exponent): the function is proportional to t^(-exponent/2), which dt/ds
 * cancels. */
static void cap_point(const aur_integrate_options *options, const aur_integrate_peak *peak,
                      const double *cube, double *point, double *factor) {
    const double height = peak_height(options, peak), power = 2.0 / (2.0 - peak->exponent);
    double t = height * pow(cube[0], power);
    if (peak->exponent > 0.0)
        t = fmax(t, NEAREST);
    *factor = power * pow(t / height, 1.0 - 1.0 / power);
    double x[3], y[3], local[3];
    aur_frame3(peak->centre, x, y);
    aur_point_to_cap(AUR_MAP_LAMBERT, t > 0.0 ? t : 1.0, (const double[2]){t > 0.0 ? 1.0 : 0.0, cube[1]},
                     local);
    for (size_t d = 0; d < 3; ++d)
        point[d] = local[0] * x[d] + local[1] * y[d] + local[2] * peak->centre[d];
    if (options->domain == AUR_DOMAIN_AXES) {
        for (size_t d = 0; d < 3; ++d)
            point[d] = point[2] < 0.0 ? -point[d] : point[d];
        return;
    }
    if (point[2] < 1.0 - aur_shape_cap_height(options))
        *factor = 0.0;
    else if (options->exponent > 0.0)
        *factor *= pow(fmax(point[2], 0.0), options->exponent);
}

/* Moves coordinates towards the centre by a power that cancels the singularity: the product of the
 * derivatives is proportional to s^(d (b - 1)) and the function to s^(-b exponent), b = d / (d - exponent).
 */
static void box_point(const aur_integrate_options *options, const aur_integrate_peak *peak,
                      const double *cube, double *point, double *factor) {
    const size_t dimension = aur_shape_dimension(options);
    const double power = (double)dimension / ((double)dimension - peak->exponent);
    *factor = 1.0;
    for (size_t d = 0; d < dimension; ++d) {
        double from;
        const double side = peak_side(peak, d, &from);
        point[d] = from + side * cube[d];
        if (peak->exponent == 0.0)
            continue;
        const double away = point[d] - peak->centre[d];
        const double reach = away < 0.0 ? peak->centre[d] - from : from + side - peak->centre[d];
        const double nearest = pow(sqrt(NEAREST) / reach, 1.0 / power);
        const double s = fmax(fabs(away) / reach, nearest);
        *factor *= power * pow(s, power - 1.0);
        point[d] = peak->centre[d] + copysign(reach * pow(s, power), away);
    }
}

void aur_shape_peak_point(const aur_integrate_options *options, const aur_integrate_peak *peak,
                          const double *cube, double *point, double *factor) {
    (is_cube(options) ? box_point : cap_point)(options, peak, cube, point, factor);
}

/* --- checks of options */

static aur_result check_peak(const aur_integrate_options *o, const aur_integrate_peak *peak,
                             aur_error *error) {
    const size_t dimension = aur_shape_dimension(o);
    const double order = is_cube(o) ? (double)dimension : 2.0;
    if (peak->centre == NULL || !(peak->radius >= 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a peak must have a centre and a radius of 0 or more, not %g", peak->radius);
    if (!(peak->exponent >= 0.0 && peak->exponent < order))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the exponent of a peak must be 0 or more and below %g, not %g", order,
                        peak->exponent);
    if (!is_cube(o) && !aur_is_unit(peak->centre))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the centre of a peak must be a unit vector");
    for (size_t d = 0; d < dimension && is_cube(o); ++d)
        if (!(peak->centre[d] >= 0.0 && peak->centre[d] <= 1.0))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "the centre of a peak must be in [0,1], not %g (coordinate %zu)", peak->centre[d],
                            d);
    return AUR_OK;
}

static aur_result check_directions(const aur_integrate_options *o, aur_error *error) {
    const double most = o->domain == AUR_DOMAIN_SPHERE ? 180.0 : 90.0;
    if (!(o->cap_degrees >= 0.0 && o->cap_degrees <= most))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the cap must be between 0 and %g degrees, not %g", most,
                        o->cap_degrees);
    if (!(o->exponent >= 0.0 && o->exponent <= 1e9))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the exponent must be between 0 and 1e9, not %g",
                        o->exponent);
    const bool whole_hemisphere =
        aur_shape_is_directions(o) && o->domain == AUR_DOMAIN_HEMISPHERE && o->cap_degrees == 0.0;
    if (o->exponent > 0.0 && !whole_hemisphere)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "powers of the cosine are for the whole hemisphere");
    if (o->cap_degrees > 0.0 && (!aur_shape_is_directions(o) || o->domain == AUR_DOMAIN_AXES))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "caps are parts of the sphere or the hemisphere");
    return AUR_OK;
}

aur_result aur_shape_check(const aur_integrate_options *o, aur_error *error) {
    if ((size_t)o->region > AUR_REGION_TETRAHEDRON || aur_domain_name(o->domain) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown domain or region: %d, %d", (int)o->domain,
                        (int)o->region);
    const size_t dimension = aur_shape_dimension(o);
    if (dimension < 1 || dimension > AUR_INTEGRATE_DIMENSION_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the cube must have 1 to %d dimensions, not %zu",
                        AUR_INTEGRATE_DIMENSION_MAX, dimension);
    aur_result result = check_directions(o, error);
    if (result == AUR_OK && o->peak_count > 0 && !aur_shape_is_directions(o) && !is_cube(o))
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED,
                          "peaks are for the sphere, the hemisphere, axes, the square and the cube");
    if (result == AUR_OK && o->peak_count > 0 && o->peaks == NULL)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "peaks are missing");
    for (size_t p = 0; p < o->peak_count && result == AUR_OK; ++p)
        result = check_peak(o, o->peaks + p, error);
    return result;
}
