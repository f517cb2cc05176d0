/* Spherical Fibonacci sets (Marques 2013 eq. 4; Swinbank and Purser 2006).
 *
 * z_j = 1 - 2 (j + offset)/N and phi_j = 2 pi j/Phi for 0 <= j < N; offset 1/2 is the best one for
 * integration (0 adds exactly 1/N^2 to the square of the energy). The hemisphere is the first N points of the
 * set of 2N, a cap of height h the first N of the set of 2N/h. With `epsilon` instead, z_j = 1 - 2 (j +
 * epsilon)/(N - 1 + 2 epsilon) (Roberts 2020): above 1/2 it widens the smallest distance and spoils the
 * energy. Any N up to 2^50; the azimuth is exact to 3e-12 turn at j = 1e9 (the 64 digits of the golden ratio,
 * times j). The cost is that of a square root and two polynomials of degree 8. */
#include "sphere/fibonacci.h"

#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "core/simd.h"
#include "sphere/fibonacci_kernels.h"
#include "sphere/native.h"
#include "sphere/phase.h"

void aur_fibonacci_points_portable(const aur_fibonacci *set, uint64_t first, size_t count, double *xyz) {
    for (size_t i = 0; i < count; ++i) {
        const uint64_t j = first + i;
        const double depth = ((double)j + set->offset) * set->step;
        const double radius = sqrt(depth * (2.0 - depth));
        double sine, cosine;
        aur_phase_sincos(set->phase + j * AUR_GOLDEN_PHASE, &sine, &cosine);
        xyz[3 * i] = radius * cosine;
        xyz[3 * i + 1] = radius * sine;
        xyz[3 * i + 2] = 1.0 - depth;
    }
}

aur_fibonacci_kernel aur_fibonacci_choose_kernel(void) {
    const aur_isa isa = aur_isa_available();
    if (isa == AUR_ISA_AVX512)
        return aur_fibonacci_points_avx512;
    if (isa == AUR_ISA_AVX2)
        return aur_fibonacci_points_avx2;
    return aur_fibonacci_points_portable;
}

typedef struct fibonacci_set {
    aur_fibonacci points;
    aur_fibonacci_kernel kernel;
} fibonacci_set;

static aur_result prepare(aur_parameters *keys, const aur_native_request *request, void **data,
                          aur_error *error) {
    double offset = 0.5;
    double epsilon = -1.0;
    aur_result result = aur_parameters_float(keys, "offset", 0.0, 1.0, &offset, error);
    if (result == AUR_OK)
        result = aur_parameters_float(keys, "epsilon", 0.0, 1e6, &epsilon, error);
    if (result != AUR_OK)
        return result;
    const double whole = 2.0 / request->height * (double)request->count;
    aur_fibonacci set = {.step = 2.0 / whole, .offset = offset};
    if (epsilon >= 0.0) {
        if (aur_parameters_find(keys, "offset") != NULL)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "set 'spherical-fibonacci': 'offset' and 'epsilon' exclude each other");
        if (!(whole - 1.0 + 2.0 * epsilon > 0.0))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "set 'spherical-fibonacci': a single point needs an epsilon above 0");
        set = (aur_fibonacci){.step = 2.0 / (whole - 1.0 + 2.0 * epsilon), .offset = epsilon};
    }
    fibonacci_set *const kept = malloc(sizeof *kept);
    if (kept == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    *kept = (fibonacci_set){set, aur_fibonacci_choose_kernel()};
    *data = kept;
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const fibonacci_set *const set = data;
    set->kernel(&set->points, first, count, xyz);
}

const aur_native_set aur_native_fibonacci = {
    .description = {.name = "spherical-fibonacci",
                    .keys = "offset=0.5,epsilon=none",
                    .summary = "a spiral of golden angles at equal heights; the most uniform there is",
                    .domains = "sphere, hemisphere, cap",
                    .sizes = "1..2^50",
                    .extensible = 0,
                    .source = "Swinbank 2006, Marques 2013"},
    .maximum_size = UINT64_C(1) << 50,
    .prepare = prepare,
    .fill = fill,
};
