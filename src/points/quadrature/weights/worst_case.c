#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/quadrature/check.h"
#include "points/quadrature/potential/potential.h"

enum { BLOCK = 64 };

typedef struct pair_sum {
    const aur_kernel_rule *rule;
    size_t count;
    aur_columns columns;
    const double *weights;
    double *blocks; /* one sum per block of rows */
} pair_sum;

/* Rows first .. first+BLOCK-1 of the lower triangle, twice, and the diagonal. */
static aur_result add_block(void *context, size_t index) {
    const pair_sum *const sum = context;
    double total = 0.0;
    for (size_t i = index * BLOCK; i < sum->count && i < (index + 1) * BLOCK; ++i) {
        const double point[3] = {sum->columns.x[i], sum->columns.y[i], sum->columns.z[i]};
        const double below = aur_kernel_sum(sum->rule, point, i, sum->columns, sum->weights);
        total += sum->weights[i] * (2.0 * below + sum->weights[i] * sum->rule->top);
    }
    sum->blocks[index] = total;
    return AUR_OK;
}

aur_result aur_worst_case_error(size_t count, const double *xyz, const double *weights,
                                const aur_potential *potential, const aur_worst_case_options *given,
                                double *value, aur_error *error) {
    if (count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a worst-case error needs at least one point");
    aur_worst_case_options copy = {.size = sizeof copy};
    aur_worst_case_options_init(&copy, NULL);
    aur_result result = aur_options_read(given, sizeof copy, &copy, "aur_worst_case_options", error);
    if (result == AUR_OK)
        result = aur_check_directions(count, xyz, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; weights != NULL && i < count; ++i)
        if (!isfinite(weights[i]))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "weight %zu is not finite", i + 1);
    const size_t block_count = (count + BLOCK - 1) / BLOCK;
    double *const storage = malloc((5 * count + block_count) * sizeof *storage);
    if (storage == NULL)
        return aur_fail_memory(error);
    double *const used = storage + 3 * count;
    double *const z = storage + 4 * count;
    for (size_t i = 0; i < count; ++i)
        used[i] = weights != NULL ? weights[i] : 1.0 / (double)count;
    pair_sum sum = {&potential->rule, count, aur_columns_split(count, xyz, storage), used,
                    storage + 5 * count};
    const aur_parallel_share share = {
        .slices = {{sum.blocks, sizeof *sum.blocks, block_count * sizeof *sum.blocks}}};
    const aur_parallel_options options = {.threads = copy.threads,
                                          .share = &share,
                                          .what = "worst-case error",
                                          .progress = copy.progress,
                                          .triangular = true};
    result = aur_parallel_for(&options, block_count, add_block, &sum, error);
    if (result == AUR_OK) {
        aur_potential_evaluate(potential, count, xyz, z);
        double pairs = 0.0, linear = 0.0;
        for (size_t i = 0; i < block_count; ++i)
            pairs += sum.blocks[i];
        for (size_t i = 0; i < count; ++i)
            linear += used[i] * z[i];
        *value = sqrt(fmax(0.0, pairs - 2.0 * linear + aur_potential_self_energy(potential)));
    }
    free(storage);
    return result;
}

aur_result aur_worst_case_options_init(aur_worst_case_options *options, aur_error *error) {
    static const aur_worst_case_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_worst_case_options", error);
}
