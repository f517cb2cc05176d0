#include "points/sphere/sets/fibonacci_body.h"

void aur_fibonacci_points_avx2(const aur_fibonacci *set, uint64_t first, size_t count, bool stream,
                               double *xyz) {
    fill_points(set, first, count, stream, xyz);
}
