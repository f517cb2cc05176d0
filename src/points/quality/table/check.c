/* Checks before a measure is computed. */
#include "points/quality/table/check.h"

#include <math.h>
#include <string.h>

#include "points/base/vector.h"

static const double unit_tolerance = 1e-6;

/* Whether `name` is one of the comma-separated words of `list`. */
static bool lists(const char *list, const char *name) {
    const size_t length = strlen(name);
    while (*list != '\0') {
        list += strspn(list, ", ");
        const size_t word = strcspn(list, ", ");
        if (word == length && strncmp(list, name, length) == 0)
            return true;
        list += word;
    }
    return false;
}

/* The location of a point in its file, if known; the caller adds the file. */
static aur_location line_of(const aur_points_view *points, size_t index) {
    return (aur_location){.line = points->lines != NULL ? points->lines[index] : 0};
}

static aur_result check_point(const aur_points_view *points, size_t index, aur_error *error) {
    const aur_location where = line_of(points, index);
    const double *const x = aur_point_at(points, index);
    for (size_t d = 0; d < points->dimension; ++d)
        if (!isfinite(x[d]))
            return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                               "point %zu has a coordinate that is not finite", index + 1);
    if (points->domain == AUR_DOMAIN_SQUARE || points->domain == AUR_DOMAIN_CUBE) {
        for (size_t d = 0; d < points->dimension; ++d)
            if (!(x[d] >= 0.0 && x[d] <= 1.0))
                return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                                   "point %zu: coordinate %.17g is not in [0,1]", index + 1, x[d]);
        return AUR_OK;
    }
    if (points->domain == AUR_DOMAIN_DISK) {
        const double radius = hypot(x[0], x[1]);
        if (radius > 1.0 + unit_tolerance)
            return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                               "point %zu is at radius %.17g, outside the unit disk", index + 1, radius);
        return AUR_OK;
    }
    const double length = sqrt(aur_square_length(points->dimension, x));
    if (!(fabs(length - 1.0) <= unit_tolerance))
        return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                           "point %zu has the length %.9g: directions must be unit vectors within 1e-6",
                           index + 1, length);
    if (points->domain == AUR_DOMAIN_HEMISPHERE && x[2] < -unit_tolerance)
        return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                           "point %zu has z = %.9g, below the hemisphere z >= 0", index + 1, x[2]);
    return AUR_OK;
}

/* Checks that the measure and the domain support caps; a cap that is the whole domain is removed from the
 * options. */
static aur_result check_cap(const aur_measure_row *row, aur_points_view *points, aur_measure_options *options,
                            aur_error *error) {
    const double cap = options->cap_degrees;
    if (cap == 0.0)
        return AUR_OK;
    const bool sphere = points->domain == AUR_DOMAIN_SPHERE;
    if (!sphere && points->domain != AUR_DOMAIN_HEMISPHERE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "caps are of the sphere and the hemisphere, not of the %s",
                        aur_domain_name(points->domain));
    const double most = sphere ? 180.0 : 90.0;
    if (!(cap > 0.0 && cap <= most))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the cap must be above 0 and at most %g degrees, not %g%s",
                        most, cap,
                        cap > 90.0 && cap <= 180.0 ? ": wider ones are for the domain sphere" : "");
    if (!lists(row->description.domains, "caps"))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "measure '%s' is for the %s, not for caps",
                        row->description.row.name, row->description.domains);
    for (size_t i = 0; i < points->count; ++i) {
        const double *const x = aur_point_at(points, i);
        const double angle = atan2(hypot(x[0], x[1]), x[2]) * (180.0 / AUR_PI);
        if (angle > cap * (1.0 + unit_tolerance))
            return aur_fail_at(error, line_of(points, i), AUR_ERROR_ARGUMENT,
                               "point %zu is %.9g degrees from +z, outside the cap of %g degrees", i + 1,
                               angle, cap);
    }
    if (sphere && cap == 90.0)
        points->domain = AUR_DOMAIN_HEMISPHERE;
    if (cap == 90.0 || cap == 180.0)
        options->cap_degrees = 0.0;
    return AUR_OK;
}

static aur_result check_weights(const aur_measure_row *row, const aur_points_view *points, aur_error *error) {
    double sum = 0.0;
    for (size_t i = 0; i < points->count; ++i) {
        const double weight = points->weights[i];
        if (!isfinite(weight))
            return aur_fail_at(error, line_of(points, i), AUR_ERROR_ARGUMENT,
                               "point %zu has a weight that is not finite", i + 1);
        if (row->masses && weight < 0.0)
            return aur_fail_at(error, line_of(points, i), AUR_ERROR_ARGUMENT,
                               "point %zu has the weight %.9g: '%s' needs weights that are not negative",
                               i + 1, weight, row->description.row.name);
        sum += weight;
    }
    if (!(sum > 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the weights add up to %.9g: the sum must be positive",
                        sum);
    return AUR_OK;
}

size_t aur_domain_dimension(aur_domain domain) {
    static const size_t dimensions[] = {
        [AUR_DOMAIN_SQUARE] = 2,     [AUR_DOMAIN_CUBE] = 0,   [AUR_DOMAIN_DISK] = 2,
        [AUR_DOMAIN_HEMISPHERE] = 3, [AUR_DOMAIN_SPHERE] = 3, [AUR_DOMAIN_AXES] = 3,
        [AUR_DOMAIN_ROTATIONS] = 4};
    return dimensions[domain];
}

aur_result aur_measure_check(const aur_measure_row *row, aur_points_view *points,
                             aur_measure_options *options, aur_error *error) {
    const char *const name = row->description.row.name;
    const char *const domain = aur_domain_name(points->domain);
    if (!lists(row->description.domains, domain))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "measure '%s' is for the %s, not for the %s", name,
                        row->description.domains, domain);
    const size_t dimension = aur_domain_dimension(points->domain);
    if (points->dimension == 0 || (dimension != 0 && dimension != points->dimension))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "points of the %s cannot have %zu coordinates", domain,
                        points->dimension);
    const size_t minimum = row->minimum_count > 0 ? row->minimum_count : 1;
    if (points->count < minimum)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "measure '%s' needs at least %zu point%s, not %zu", name,
                        minimum, minimum == 1 ? "" : "s", points->count);
    for (size_t i = 0; i < points->count; ++i) {
        const aur_result result = check_point(points, i, error);
        if (result != AUR_OK)
            return result;
    }
    const aur_result result = check_cap(row, points, options, error);
    return result == AUR_OK && points->weights != NULL ? check_weights(row, points, error) : result;
}
