/* Kernels that call every function of aureole_sampling.h. Clang without NVIDIA's headers takes the first
 * lines for them. */
#ifdef WITHOUT_TOOLKIT
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
__device__ double sqrt(double x) {
    return __nvvm_sqrt_rn_d(x);
}
__device__ double floor(double x) {
    return __nvvm_floor_d(x);
}
__device__ double fabs(double x) {
    return __nvvm_fabs_d(x);
}
__device__ double copysign(double x, double y) {
    return (y < 0.0) == (x < 0.0) ? x : -x;
}
__device__ double ldexp(double x, int power) {
    return power < 0 ? ldexp(0.5 * x, power + 1) : x;
}
__device__ double pow(double x, double y) {
    return y < 1.0 ? 1.0 : x * pow(x, y - 1.0);
}
#endif
#include <aureole_sampling.h>

__global__ void every(uint32_t index, double *out, float *pair) {
    aureole_sobol_2d(index, out);
    aureole_sobol_2d_owen(index, 11, out + 2);
    aureole_hammersley_2d(index, 1000, out + 4);
    out[6] = aureole_golden(index);
    aureole_r2_2d(index, out + 7);
    for (int map = 0; map < 4; ++map) {
        aureole_point_to_disk((aureole_map)map, out, out + 9 + 8 * map);
        aureole_point_to_hemisphere((aureole_map)map, out, out + 11 + 8 * map);
        aureole_point_to_sphere((aureole_map)map, out, out + 14 + 8 * map);
    }
    aureole_spherical_fibonacci(1000, 2.0, index, out + 41);
    aureole_grid_point(64, 3, 1, 1.0, index, out + 44);
    out[47] = aureole_unit_double(aureole_hash2(index, 3));
    aureole_sampler sampler = aureole_sampler_begin(7, 3, 4, index);
    aureole_draw_2d(&sampler, pair);
    aureole_sampler branch = aureole_sampler_branch(&sampler, 9);
    pair[2] = aureole_draw_1d(&branch);
}
#ifndef WITHOUT_POW
__global__ void first_shift(uint64_t base, double stretch, size_t *shift) {
    *shift = aureole_grid_first_shift(base, stretch);
}
#endif
