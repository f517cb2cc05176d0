/* Super-Fibonacci spirals (Alexa 2022): the heights u = (i + 1/2)/N paired with azimuths (i + 1/2)/sqrt 2 and
 * (i + 1/2)/psi with psi^4 = psi + 4. Any N up to 2^50; azimuths are exact to 3e-11 turn at i = 1e9. Two
 * sizes share no points: by the paper's erratum there is no refinement (super-fibonacci-grid has one). */
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/sphere/native.h"
#include "points/sphere/rotations/hopf.h"

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)row;
    (void)parameters;
    aur_hopf_line *const line = malloc(sizeof *line);
    if (line == NULL)
        return aur_fail_memory(error);
    *line = (aur_hopf_line){
        .step = 1.0 / (double)request->count, .offset = 0.5, .turns = AUR_SUPER_FIBONACCI_TURNS};
    for (size_t k = 0; k < 2; ++k)
        line->phases[k] = line->turns[k] / 2;
    *data = line;
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *wxyz) {
    AUR_KERNEL_HERE(aur_hopf).line(data, first, count, wxyz);
}

const aur_native_set aur_native_super_fibonacci = {
    .description = {.row = {.name = "super-fibonacci",
                            .summary = "rotations on a double spiral, any number",
                            .source = "Alexa 2022"},
                    .domains = AUR_ON_ROTATIONS,
                    .dimensions = {4, 4},
                    .maximum_size = UINT64_C(1) << 50},
    .prepare = prepare,
    .fill = fill,
};
