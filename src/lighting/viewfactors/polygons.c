/* The view factor of two polygons given by the caller. */
#include <aureole-lighting/view_factors.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/closed_pairs.h"
#include "points/base/error.h"
#include "points/base/vector3d.h"

enum { MOST_CORNERS = 1 << 16 };

/* A polygon, scaled by the larger one's size, with room for the corners that clipping adds. */
typedef struct polygon {
    size_t count;
    double (*corners)[3];
    aur_plane plane;
    double area;
} polygon;

static bool is_convex(const polygon *p) {
    for (size_t i = 0; i < p->count; ++i) {
        const double *const a = p->corners[i], *const b = p->corners[(i + 1) % p->count],
                            *const c = p->corners[(i + 2) % p->count];
        double u[3], v[3], cross[3];
        for (int d = 0; d < 3; ++d) {
            u[d] = b[d] - a[d];
            v[d] = c[d] - b[d];
        }
        aur_cross3(u, v, cross);
        if (aur_dot3(cross, p->plane.normal) < -1e-9 * aur_length3(u) * aur_length3(v))
            return false;
    }
    return true;
}

static double size_of(const polygon *p) {
    double size = 0.0;
    for (size_t i = 1; i < p->count; ++i)
        for (int d = 0; d < 3; ++d)
            size = fmax(size, fabs(p->corners[i][d] - p->corners[0][d]));
    return size;
}

static aur_result read_polygon(const char *which, size_t count, const double *corners, polygon *p,
                               aur_error *error) {
    if (count < 3 || count > MOST_CORNERS)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the polygon `%s` has %zu corners: 3 to %d are right",
                        which, count, MOST_CORNERS);
    for (size_t i = 0; i < 3 * count; ++i)
        if (!(fabs(corners[i]) <= 1e30))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "corner %zu of the polygon `%s` is not finite, or beyond 1e30", i / 3, which);
    p->count = count;
    p->corners = malloc((count + 1) * sizeof *p->corners);
    if (p->corners == NULL)
        return aur_fail_memory(error);
    memcpy(p->corners, corners, 3 * count * sizeof *corners);
    p->area = aur_polygon_plane(count, (const double(*)[3])p->corners, &p->plane);
    const double size = size_of(p);
    if (!(p->area > 1e-14 * size * size))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the polygon `%s` has no area", which);
    for (size_t i = 0; i < count; ++i)
        if (fabs(aur_plane_height(&p->plane, p->corners[i])) > 1e-6 * size)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "corner %zu of the polygon `%s` is not in its plane",
                            i, which);
    if (!is_convex(p))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the polygon `%s` is not convex", which);
    return AUR_OK;
}

/* Clips the part behind the plane. */
static aur_result cut(polygon *p, const aur_plane *plane, aur_error *error) {
    double(*const clipped)[3] = malloc((p->count + 2) * sizeof *clipped);
    if (clipped == NULL)
        return aur_fail_memory(error);
    p->count = aur_polygon_clip(p->count, (const double(*)[3])p->corners, plane, clipped);
    free(p->corners);
    p->corners = clipped;
    return AUR_OK;
}

aur_result aur_view_factor_polygons(size_t from_count, const double *from, size_t to_count, const double *to,
                                    double *factor, aur_error *error) {
    polygon a = {0}, b = {0};
    aur_result result = read_polygon("from", from_count, from, &a, error);
    if (result == AUR_OK)
        result = read_polygon("to", to_count, to, &b, error);
    if (result == AUR_OK)
        result = cut(&b, &a.plane, error);
    if (result == AUR_OK)
        result = cut(&a, &b.plane, error);
    if (result == AUR_OK)
        *factor = a.count == 0 || b.count == 0
                      ? 0.0
                      : aur_contour_exchange(a.count, (const double(*)[3])a.corners, b.count,
                                             (const double(*)[3])b.corners) /
                            a.area;
    free(a.corners);
    free(b.corners);
    return result;
}
