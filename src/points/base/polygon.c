#include "points/base/vector3d.h"

#include <string.h>

double aur_polygon_plane(size_t count, const double (*corners)[3], aur_plane *plane) {
    *plane = (aur_plane){{0.0, 0.0, 0.0}, 0.0};
    double mean[3] = {0.0, 0.0, 0.0};
    for (size_t i = 1; i + 1 < count; ++i) {
        double a[3], b[3], cross[3];
        for (int d = 0; d < 3; ++d) {
            a[d] = corners[i][d] - corners[0][d];
            b[d] = corners[i + 1][d] - corners[0][d];
        }
        aur_cross3(a, b, cross);
        for (int d = 0; d < 3; ++d)
            plane->normal[d] += cross[d];
    }
    for (size_t i = 0; i < count; ++i)
        for (int d = 0; d < 3; ++d)
            mean[d] += corners[i][d] / (double)count;
    const double doubled_area = aur_normalize3(plane->normal);
    plane->offset = aur_dot3(plane->normal, mean);
    return 0.5 * doubled_area;
}

double aur_polygon_width(size_t count, const double (*corners)[3]) {
    double around = 0.0;
    aur_plane plane;
    const double area = aur_polygon_plane(count, corners, &plane);
    for (size_t i = 0; i < count; ++i) {
        double edge[3];
        for (int d = 0; d < 3; ++d)
            edge[d] = corners[(i + 1) % count][d] - corners[i][d];
        around += aur_length3(edge);
    }
    return around > 0.0 ? 2.0 * area / around : 0.0;
}

size_t aur_polygon_clip(size_t count, const double (*corners)[3], const aur_plane *plane, double (*cut)[3]) {
    size_t written = 0;
    double highest = 0.0, largest = fabs(plane->offset);
    double before = count > 0 ? aur_plane_height(plane, corners[count - 1]) : 0.0;
    const double *previous = count > 0 ? corners[count - 1] : NULL;
    for (size_t i = 0; i < count; ++i) {
        const double height = aur_plane_height(plane, corners[i]);
        if ((before < 0.0 && height > 0.0) || (before > 0.0 && height < 0.0)) {
            const double t = before / (before - height);
            for (int d = 0; d < 3; ++d)
                cut[written][d] = previous[d] + t * (corners[i][d] - previous[d]);
            ++written;
        }
        if (height >= 0.0)
            memcpy(cut[written++], corners[i], sizeof cut[0]);
        highest = height > highest ? height : highest;
        for (int d = 0; d < 3; ++d) {
            const double size = fabs(corners[i][d]);
            largest = size > largest ? size : largest;
        }
        before = height;
        previous = corners[i];
    }
    /* Points above the plane by no more than the rounding error of heights are in it. */
    return written >= 3 && highest > 2e-15 * largest ? written : 0;
}
