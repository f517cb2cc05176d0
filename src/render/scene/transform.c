#include "render/scene/transform.h"

#include <math.h>
#include <string.h>

#include "points/base/vector3d.h"

aur_transform aur_transform_identity(void) {
    return aur_transform_scale(1.0, 1.0, 1.0);
}

aur_transform aur_transform_multiply(const aur_transform *a, const aur_transform *b) {
    aur_transform product = {{0}};
    for (size_t i = 0; i < 4; ++i)
        for (size_t k = 0; k < 4; ++k)
            for (size_t j = 0; j < 4; ++j)
                product.m[4 * i + j] += a->m[4 * i + k] * b->m[4 * k + j];
    return product;
}

aur_transform aur_transform_translate(double x, double y, double z) {
    return (aur_transform){{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}};
}

aur_transform aur_transform_scale(double x, double y, double z) {
    return (aur_transform){{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}};
}

static bool normalize(double v[3]) {
    const double length = aur_normalize3(v);
    return length > 0.0 && isfinite(length);
}

bool aur_transform_rotate(const double axis[3], double degrees, aur_transform *result) {
    double a[3] = {axis[0], axis[1], axis[2]};
    if (!normalize(a) || !isfinite(degrees))
        return false;
    /* Multiples of 90 degrees are exact, as expected by users who type 90. */
    const double turns = remainder(degrees, 360.0);
    double s = sin(turns * AUR_PI / 180.0);
    double c = cos(turns * AUR_PI / 180.0);
    if (fabs(turns) == 90.0)
        c = 0.0;
    if (fabs(turns) == 180.0)
        s = 0.0;
    *result = aur_transform_identity();
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            result->m[4 * i + j] = a[i] * a[j] * (1.0 - c) + (i == j ? c : 0.0);
    result->m[1] -= a[2] * s;
    result->m[2] += a[1] * s;
    result->m[4] += a[2] * s;
    result->m[6] -= a[0] * s;
    result->m[8] -= a[1] * s;
    result->m[9] += a[0] * s;
    return true;
}

bool aur_transform_look_at(const double origin[3], const double target[3], const double up[3],
                           aur_transform *result) {
    double forward[3], left[3], above[3];
    for (size_t i = 0; i < 3; ++i)
        forward[i] = target[i] - origin[i];
    if (!normalize(forward))
        return false;
    aur_cross3(up, forward, left);
    if (!normalize(left))
        return false;
    aur_cross3(forward, left, above);
    for (size_t i = 0; i < 3; ++i) {
        result->m[4 * i] = left[i];
        result->m[4 * i + 1] = above[i];
        result->m[4 * i + 2] = forward[i];
        result->m[4 * i + 3] = origin[i];
        result->m[12 + i] = 0.0;
    }
    result->m[15] = 1.0;
    return true;
}

bool aur_transform_inverse(const aur_transform *a, aur_transform *inverse) {
    double m[4][8];
    for (size_t i = 0; i < 4; ++i) {
        for (size_t j = 0; j < 4; ++j) {
            m[i][j] = a->m[4 * i + j];
            m[i][j + 4] = i == j;
            if (!isfinite(m[i][j]))
                return false;
        }
    }
    for (size_t column = 0; column < 4; ++column) {
        size_t pivot = column;
        for (size_t i = column + 1; i < 4; ++i)
            if (fabs(m[i][column]) > fabs(m[pivot][column]))
                pivot = i;
        if (m[pivot][column] == 0.0)
            return false;
        double row[8];
        memcpy(row, m[pivot], sizeof row);
        memcpy(m[pivot], m[column], sizeof row);
        for (size_t j = 0; j < 8; ++j)
            m[column][j] = row[j] / row[column];
        for (size_t i = 0; i < 4; ++i) {
            const double factor = m[i][column];
            for (size_t j = 0; i != column && j < 8; ++j)
                m[i][j] -= factor * m[column][j];
        }
    }
    for (size_t i = 0; i < 4; ++i) {
        for (size_t j = 0; j < 4; ++j) {
            inverse->m[4 * i + j] = m[i][j + 4];
            if (!isfinite(m[i][j + 4]))
                return false;
        }
    }
    return true;
}

bool aur_transform_is_affine(const aur_transform *a) {
    return a->m[12] == 0.0 && a->m[13] == 0.0 && a->m[14] == 0.0 && a->m[15] == 1.0;
}

double aur_transform_determinant(const aur_transform *a) {
    const double *const m = a->m;
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
           m[2] * (m[4] * m[9] - m[5] * m[8]);
}

void aur_transform_move(aur_transform *a, const double origin[3]) {
    for (size_t i = 0; i < 3; ++i)
        a->m[4 * i + 3] -= origin[i];
}

void aur_transform_direction(const aur_transform *a, const double direction[3], double result[3]) {
    for (size_t i = 0; i < 3; ++i)
        result[i] =
            a->m[4 * i] * direction[0] + a->m[4 * i + 1] * direction[1] + a->m[4 * i + 2] * direction[2];
}

void aur_transform_point(const aur_transform *a, const double point[3], double result[3]) {
    aur_transform_direction(a, point, result);
    for (size_t i = 0; i < 3; ++i)
        result[i] += a->m[4 * i + 3];
}

void aur_transform_normal(const aur_transform *inverse, const double normal[3], double result[3]) {
    for (size_t i = 0; i < 3; ++i)
        result[i] = inverse->m[i] * normal[0] + inverse->m[4 + i] * normal[1] + inverse->m[8 + i] * normal[2];
}

static aur_vector to_vector(const double v[3]) {
    return (aur_vector){(float)v[0], (float)v[1], (float)v[2]};
}

aur_vector aur_transform_point_f(const aur_transform *a, aur_vector point) {
    double result[3];
    aur_transform_point(a, (double[3]){point.x, point.y, point.z}, result);
    return to_vector(result);
}

aur_vector aur_transform_direction_f(const aur_transform *a, aur_vector direction) {
    double result[3];
    aur_transform_direction(a, (double[3]){direction.x, direction.y, direction.z}, result);
    return to_vector(result);
}

aur_vector aur_transform_normal_f(const aur_transform *inverse, aur_vector normal) {
    double result[3];
    aur_transform_normal(inverse, (double[3]){normal.x, normal.y, normal.z}, result);
    return to_vector(result);
}

static bool is_within_reach(const aur_transform *a, const aur_transform *inverse) {
    for (size_t i = 0; i < 12; ++i)
        if (fabs(a->m[i]) > AUR_REACH || (i % 4 != 3 && fabs(inverse->m[i]) > AUR_REACH))
            return false;
    return true;
}

/* The entries of a map bound its stretching, those of its inverse its shrinking. */
bool aur_transform_is_within_reach(const aur_transform *a) {
    aur_transform inverse;
    return aur_transform_inverse(a, &inverse) && is_within_reach(a, &inverse);
}

aur_result aur_to_world_check(const aur_parameters *parameters, const aur_transform *to_world,
                              aur_transform *to_local, aur_error *error) {
    if (!aur_transform_is_affine(to_world) || !aur_transform_inverse(to_world, to_local))
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "%s '%s': 'to_world' must be affine: its last row is 0 0 0 1", parameters->kind,
                           parameters->plugin);
    if (is_within_reach(to_world, to_local))
        return AUR_OK;
    return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                       "%s '%s': 'to_world' must move by at most %g, and scale by %g to %g", parameters->kind,
                       parameters->plugin, AUR_REACH, 1.0 / AUR_REACH, AUR_REACH);
}
