#include "references.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static double length(const double a[3]) {
    return sqrt(dot(a, a));
}

/* --- quadrature */

enum { HALF = 40 };

static void node(int i, double from, double to, double *at, double *weight) {
    const double step = 3.4 / HALF, t = step * (double)i, inner = 0.5 * LAB_PI * sinh(t);
    const double scale = cosh(inner), half = 0.5 * (to - from), gap = half * exp(-fabs(inner)) / scale;
    *at = i < 0 ? from + gap : to - gap;
    *weight = step * half * 0.5 * LAB_PI * cosh(t) / (scale * scale);
}

double lab_integrate(lab_function *function, const void *data, const double x[2], const double y[2]) {
    double sum = 0.0;
    for (int i = -HALF; i <= HALF; ++i) {
        double row = 0.0, at[2], weight[2];
        node(i, x[0], x[1], &at[0], &weight[0]);
        for (int j = -HALF; j <= HALF; ++j) {
            node(j, y[0], y[1], &at[1], &weight[1]);
            row += weight[1] * function(data, at[0], at[1]);
        }
        sum += weight[0] * row;
    }
    return sum;
}

static const double UNIT[2] = {0.0, 1.0};

/* --- patches */

double lab_patch_closed(const lab_receiver *receiver, const lab_patch *patch) {
    double way[4][3], sum = 0.0;
    for (size_t k = 0; k < 4; ++k)
        for (size_t d = 0; d < 3; ++d)
            way[k][d] = patch->corner[d] + (k == 1 || k == 2 ? patch->a[d] : 0.0) +
                        (k >= 2 ? patch->b[d] : 0.0) - receiver->position[d];
    for (size_t k = 0; k < 4; ++k) {
        double across[3];
        cross(way[k], way[(k + 1) % 4], across);
        const double size = length(across);
        if (size > 0.0)
            sum += 0.5 * atan2(size, dot(way[k], way[(k + 1) % 4])) * dot(across, receiver->normal) / size;
    }
    return fabs(sum);
}

typedef struct patch_view {
    const lab_receiver *receiver;
    const lab_patch *patch;
    double normal[3]; /* its length is the patch's area */
    lab_radiance *radiance;
    const void *data;
} patch_view;

static double of_area(const void *data, double s, double t) {
    const patch_view *const view = data;
    double way[3], direction[3];
    for (size_t d = 0; d < 3; ++d)
        way[d] = view->patch->corner[d] + s * view->patch->a[d] + t * view->patch->b[d] -
                 view->receiver->position[d];
    const double distance = length(way);
    for (size_t d = 0; d < 3; ++d)
        direction[d] = way[d] / distance;
    const double radiance = view->radiance != NULL ? view->radiance(view->data, direction) : 1.0;
    return radiance * dot(direction, view->receiver->normal) * fabs(dot(direction, view->normal)) /
           (distance * distance);
}

double lab_patch_smooth(const lab_receiver *receiver, const lab_patch *patch, lab_radiance *radiance,
                        const void *data) {
    patch_view view = {.receiver = receiver, .patch = patch, .radiance = radiance, .data = data};
    cross(patch->a, patch->b, view.normal);
    /* Four parts around the receiver's foot point if it is near: the integrand peaks there. */
    double way[3];
    for (size_t d = 0; d < 3; ++d)
        way[d] = receiver->position[d] - patch->corner[d];
    const double s = fmin(fmax(dot(way, patch->a) / dot(patch->a, patch->a), 0.0), 1.0);
    const double t = fmin(fmax(dot(way, patch->b) / dot(patch->b, patch->b), 0.0), 1.0);
    const double along[3] = {0.0, s, 1.0}, up[3] = {0.0, t, 1.0};
    double sum = 0.0;
    for (size_t i = 0; i < 2; ++i)
        for (size_t j = 0; j < 2; ++j)
            sum += lab_integrate(of_area, &view, along + i, up + j);
    return sum;
}

/* --- disks */

double lab_disk_closed(double radius, double height, double aside) {
    const double r = radius * radius, h = height * height, a = aside * aside;
    return 0.5 * LAB_PI * (1.0 - (a + h - r) / sqrt((a + h + r) * (a + h + r) - 4.0 * a * r));
}

typedef struct disk_view {
    double radius, height, aside;
} disk_view;

static double of_disk(const void *data, double s, double azimuth) {
    const disk_view *const view = data;
    const double r = s * view->radius, x = r * cos(azimuth) - view->aside, y = r * sin(azimuth);
    const double squared = x * x + y * y + view->height * view->height;
    return 2.0 * r * view->radius * view->height * view->height / (squared * squared);
}

double lab_disk_smooth(double radius, double height, double aside) {
    const disk_view view = {radius, height, aside};
    return lab_integrate(of_disk, &view, UNIT, (const double[2]){0.0, LAB_PI});
}

double lab_disk_sideways_closed(double radius, double height) {
    const double ratio = radius / height;
    return atan(ratio) - ratio / (1.0 + ratio * ratio);
}

static double of_disk_sideways(const void *data, double s, double azimuth) {
    const disk_view *const view = data;
    const double r = s * view->radius, squared = r * r + view->height * view->height;
    return 2.0 * r * view->radius * r * cos(azimuth) * view->height / (squared * squared);
}

double lab_disk_sideways_smooth(double radius, double height) {
    const disk_view view = {radius, height, 0.0};
    return lab_integrate(of_disk_sideways, &view, UNIT, (const double[2]){0.0, 0.5 * LAB_PI});
}

/* --- openings */

/* At azimuth alpha from the opening's normal, its edge at height h has an elevation with tangent h cos(alpha)
 * / d. Uniform radiance integrates to half the azimuth integral of the edge's sin^2; radiance equal to the
 * sine of the elevation integrates to a third of that of sin^3. With u = asin(h sin(alpha) / sqrt(d^2 + h^2))
 * the integral of sin^3 is u - d^2 tan(u) / (d^2 + h^2). */
static double below_edge(double distance, double w, double h) {
    const double squared = distance * distance + h * h, alpha = atan2(w, distance);
    const double shrink = distance / sqrt(squared);
    const double uniform = 0.5 * (alpha - shrink * atan(shrink * w / distance));
    const double u = asin(h * sin(alpha) / sqrt(squared));
    const double graded = (u - distance * distance / squared * tan(u)) / 3.0;
    return (uniform + 2.0 * graded) / 3.0;
}

double lab_opening_overcast(double distance, const double w[2], const double h[2]) {
    return below_edge(distance, w[1], h[1]) - below_edge(distance, w[0], h[1]) -
           below_edge(distance, w[1], h[0]) + below_edge(distance, w[0], h[0]);
}

typedef struct opening_view {
    double distance;
    const double *h;
    lab_radiance *radiance;
    const void *data;
} opening_view;

static double of_angles(const void *data, double azimuth, double t) {
    const opening_view *const view = data;
    const double low = atan(view->h[0] * cos(azimuth) / view->distance);
    const double high = atan(view->h[1] * cos(azimuth) / view->distance);
    const double elevation = low + t * (high - low);
    const double direction[3] = {cos(elevation) * sin(azimuth), -cos(elevation) * cos(azimuth),
                                 sin(elevation)};
    return (high - low) * view->radiance(view->data, direction) * sin(elevation) * cos(elevation);
}

double lab_opening_by_angles(double distance, const double w[2], const double h[2], lab_radiance *radiance,
                             const void *data) {
    const opening_view view = {distance, h, radiance, data};
    const double azimuths[2] = {atan2(w[0], distance), atan2(w[1], distance)};
    return lab_integrate(of_angles, &view, azimuths, UNIT);
}

/* --- panes */

/* The reflectance of one interface for both polarisations, perpendicular and parallel to the plane of
 * incidence. */
static void fresnel(double index, double cosine, double r[2], double *inside) {
    *inside = sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    const double across = (cosine - index * *inside) / (cosine + index * *inside);
    const double along = (index * cosine - *inside) / (index * cosine + *inside);
    r[0] = across * across;
    r[1] = along * along;
}

double lab_pane_closed(double index, double transmissivity, double cosine) {
    double r[2], inside, sum = 0.0;
    fresnel(index, cosine, r, &inside);
    const double left = pow(transmissivity, 1.0 / inside);
    for (size_t k = 0; k < 2; ++k)
        sum += 0.5 * (1.0 - r[k]) * (1.0 - r[k]) * left / (1.0 - r[k] * r[k] * left * left);
    return sum;
}

/* The same by Snell's angle and Fresnel's sines and tangents instead of cosines. */
double lab_pane_series(double index, double transmissivity, double cosine) {
    const double angle = fmax(acos(fmin(cosine, 1.0)), 1e-6), refracted = asin(sin(angle) / index);
    const double across = sin(angle - refracted) / sin(angle + refracted);
    const double along = tan(angle - refracted) / tan(angle + refracted);
    const double r[2] = {across * across, along * along};
    const double left = pow(transmissivity, 1.0 / cos(refracted));
    double sum = 0.0;
    for (size_t k = 0; k < 2; ++k) {
        double power = 0.5 * (1.0 - r[k]) * left;
        for (size_t bounce = 0; bounce < 2000 && power > 1e-18; ++bounce, power *= r[k] * left)
            if (bounce % 2 == 0)
                sum += (1.0 - r[k]) * power;
    }
    return sum;
}

/* --- skies */

lab_sky lab_sky_of(size_t type, double elevation_degrees) {
    /* Table 1 of ISO 15469, by type. */
    static const double table[15][5] = {
        {4, -.7, 0, -1, 0},       {4, -.7, 2, -1.5, .15},  {1.1, -.8, 0, -1, 0},     {1.1, -.8, 2, -1.5, .15},
        {0, -1, 0, -1, 0},        {0, -1, 2, -1.5, .15},   {0, -1, 5, -2.5, .3},     {0, -1, 10, -3, .45},
        {-1, -.55, 2, -1.5, .15}, {-1, -.55, 5, -2.5, .3}, {-1, -.55, 10, -3, .45},  {-1, -.32, 10, -3, .45},
        {-1, -.32, 16, -3, .3},   {-1, -.15, 16, -3, .3},  {-1, -.15, 24, -2.8, .15}};
    const double *const row = table[type - 1], elevation = elevation_degrees * LAB_PI / 180.0;
    return (lab_sky){row[0], row[1], row[2], row[3], row[4], {cos(elevation), 0.0, sin(elevation)}};
}

static double sky_radiance(const lab_sky *sky, const double direction[3]) {
    const double height = fmax(direction[2], 1e-12);
    /* Half the chord is the sine of half the angle. */
    const double chord[3] = {direction[0] - sky->sun[0], direction[1] - sky->sun[1],
                             direction[2] - sky->sun[2]};
    const double angle = 2.0 * asin(fmin(0.5 * length(chord), 1.0)), along = cos(angle);
    return (1.0 + sky->a * exp(sky->b / height)) *
           (1.0 + sky->c * (exp(sky->d * angle) - exp(sky->d * 0.5 * LAB_PI)) + sky->e * along * along);
}

typedef struct sky_view {
    const lab_sky *sky;
    const double *normal;
} sky_view;

static double by_zenith(const void *data, double zenith, double azimuth) {
    const sky_view *const view = data;
    const double direction[3] = {sin(zenith) * cos(azimuth), sin(zenith) * sin(azimuth), cos(zenith)};
    return sin(zenith) * fmax(dot(direction, view->normal), 0.0) * sky_radiance(view->sky, direction);
}

/* Splits the angles into rectangles with the sun and the horizon of the receiver's plane at their corners. */
double lab_sky_about_zenith(const lab_sky *sky, const double normal[3]) {
    const sky_view view = {sky, normal};
    const double zenith = acos(sky->sun[2]), polar[3] = {0.0, zenith, 0.5 * LAB_PI};
    const bool level = normal[2] == 0.0;
    const double middle = atan2(normal[1], normal[0]);
    double turns[4] = {-LAB_PI, 0.0, LAB_PI, LAB_PI};
    if (level) { /* half a turn; the sun may be at azimuth 0 */
        turns[0] = middle - 0.5 * LAB_PI;
        turns[2] = turns[3] = middle + 0.5 * LAB_PI;
        turns[1] = fmin(fmax(middle > 0.75 * LAB_PI ? turns[0] : 0.0, turns[0]), turns[2]);
    }
    double sum = 0.0;
    for (size_t i = 0; i < 2; ++i)
        for (size_t j = 0; j < 2; ++j)
            sum += lab_integrate(by_zenith, &view, polar + i, turns + j);
    return sum;
}

static double by_axis(const void *data, double polar, double turn) {
    const sky_view *const view = data;
    /* The axis is the receiver's normal, or +y for a horizontal receiver; the rotation begins at the horizon.
     */
    const double up[3] = {0.0, 0.0, 1.0}, y[3] = {0.0, 1.0, 0.0};
    const double *const axis = view->normal[2] == 0.0 ? view->normal : y;
    double side[3], direction[3];
    cross(axis, up, side);
    for (size_t d = 0; d < 3; ++d)
        direction[d] = cos(polar) * axis[d] + sin(polar) * (cos(turn) * side[d] + sin(turn) * up[d]);
    return sin(polar) * dot(direction, view->normal) * sky_radiance(view->sky, direction);
}

double lab_sky_about_horizontal(const lab_sky *sky, const double normal[3]) {
    const sky_view view = {sky, normal};
    const bool level = normal[2] == 0.0;
    const double up[3] = {0.0, 0.0, 1.0}, y[3] = {0.0, 1.0, 0.0}, end = level ? 0.5 * LAB_PI : LAB_PI;
    double side[3];
    cross(level ? normal : y, up, side);
    const double polar = acos(dot(sky->sun, level ? normal : y));
    const double turn = atan2(sky->sun[2], dot(sky->sun, side));
    const double polars[3] = {0.0, fmin(polar, end), end}, turns[3] = {0.0, turn, LAB_PI};
    double sum = 0.0;
    for (size_t i = 0; i < 2; ++i)
        for (size_t j = 0; j < 2; ++j)
            sum += lab_integrate(by_axis, &view, polars + i, turns + j);
    return sum;
}
