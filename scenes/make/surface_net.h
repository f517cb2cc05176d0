/* Solids told by signed distance, and their skin as triangles. */
#pragma once

#include "mesh.h"

/* A solid: negative inside, about the distance outside. */
typedef double (*solid)(const void *context, vec p);

typedef struct solid_box {
    vec lower, upper; /* the solid lies within */
    double cell;      /* of the grid that it is sampled on */
    double slack;     /* the solid's function may be wrong by so much about distances */
} solid_box;

/* Surface nets (Gibson 1998): one vertex in each cell that the skin crosses, pulled onto the skin, with the
 * gradient as its normal; two triangles about each crossed edge. */
void mesh_solid(mesh *m, const solid_box *box, solid function, const void *context);

/* --- building blocks */

double solid_ellipsoid(vec p, vec center, vec radii); /* to first order */
double solid_ball(vec p, vec center, double radius);
/* A cone with round ends: radius ra at a, rb at b. */
double solid_limb(vec p, vec a, vec b, double ra, double rb);
/* A box with rounded edges, `half` its half sizes. */
double solid_block(vec p, vec center, vec half, double rounding);
/* The union with a fillet of about the size k; and the same for a cut with `b`. */
double solid_join(double a, double b, double k);
double solid_cut(double a, double b, double k);
