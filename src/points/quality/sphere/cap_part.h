/* The part of a Voronoi cell that lies within a cap about +z. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef struct aur_rim {
    double cosine, sine; /* of the cap's polar angle */
    double height;       /* 1 - cosine, without cancellation */
} aur_rim;

/* Degrees above 0 and below 180. */
aur_rim aur_rim_at(double degrees);

typedef struct aur_cap_part {
    double area;   /* steradians */
    double radius; /* the largest angle from the point to a place of the part */
    size_t sides;  /* of great circles and arcs of the rim */
} aur_cap_part;

/* `corners`, unit vectors, of a convex polygon of three or more, counter-clockwise as seen from outside,
 * about the unit vector `point`, which lies within the cap. */
aur_cap_part aur_cap_part_of(const aur_rim *rim, const double point[3], size_t count,
                             const double (*corners)[3]);
