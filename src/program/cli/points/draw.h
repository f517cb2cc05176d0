/* Pictures of points: the square, the disk, and the sphere from the side and from the pole. */
#pragma once

#include <aureole/pointset.h>
#include <aureole/sphere.h>

/* Draws points in a format of report/figure.h to `path` ("-": standard output), whole or not at all. A
 * point's area goes with its weight. The square has v upwards; a point set on the cube shows its first two
 * coordinates. The sphere is seen from the side (x to the right, z up) and from the pole (x to the right, y
 * up); points on the far side are pale. */
aur_result cli_draw_points(const char *path, const char *format, const aur_points_view *points,
                           aur_error *error);

/* The density that a picture's brightness (Rec. 709 luminance) makes; returns the exit status. */
int cli_read_density(const char *path, aur_density_image **density);
