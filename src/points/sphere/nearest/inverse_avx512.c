#include "points/sphere/nearest/inverse_body.h"

void aur_sphere_lattice_nearest_avx512(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                       double *indices) {
    nearest_points(lattice, count, xyz, indices);
}
