#include <aureole/exact.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/quadrature/check.h"

aur_result aur_weights_nested(size_t count, const double *xyz, size_t level_count, const size_t *counts,
                              const aur_exact_options *options, size_t capacity, double *weights,
                              aur_exact_report *reports, aur_error *error) {
    size_t needed;
    if (!aur_size_product(level_count, count, &needed))
        return aur_fail_memory(error);
    for (size_t k = 0; k < level_count; ++k)
        if (counts[k] <= (k > 0 ? counts[k - 1] : 0) || counts[k] > count)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "level %zu has %zu points: they must ascend, from 1 to all %zu", k, counts[k],
                            count);
    aur_result result = aur_check_capacity(needed, capacity, error);
    for (size_t k = 0; k < level_count && result == AUR_OK; ++k) {
        double *const level = weights + k * count;
        memset(level, 0, count * sizeof *level);
        aur_error reason = {0};
        result = aur_weights_exact(counts[k], xyz, options, count, level,
                                   reports != NULL ? &reports[k] : NULL, &reason);
        if (result != AUR_OK)
            aur_fail(error, result, "level %zu: %s", k, reason.message);
    }
    return result;
}
