#include "scene/spherical_rectangle_body.h"

void aur_rectangle_points_avx512(const aur_rectangle *rectangle, float least, size_t count,
                                 aur_rectangle_points in, aur_rectangle_samples out) {
    rectangle_points(rectangle, least, count, in, out);
}
