/* aureole weights --method exact and voronoi: weights that depend only on the domain and the samples. */
#include <aureole/quality.h>
#include <aureole/text.h>

#include "program/cli/points/weights.h"

aur_result cli_weights_by_degree(const cli_weights_arguments *arguments, cli_weights_result *result,
                                 aur_error *error) {
    const aur_directions_options *const points = &arguments->points.options;
    aur_exact_options options = {.size = sizeof options};
    aur_exact_options_init(result->domain, &options, NULL);
    options.cap_degrees = points->cap_degrees;
    options.lobe = points->lobe;
    options.degree = arguments->degree;
    options.negative = arguments->negative;
    options.tolerance = arguments->tolerance;
    options.near = result->near;
    options.threads = arguments->common.threads;
    options.progress = cli_progress(arguments->common.quiet);
    options.dimension = result->dimension;
    cli_symmetry symmetry;
    const aur_result parsed = cli_parse_symmetry(arguments->symmetry, result->domain, &symmetry, error);
    if (parsed != AUR_OK)
        return parsed;
    options.group = symmetry.given && result->domain == AUR_DOMAIN_SPHERE ? &symmetry.group : NULL;
    options.crystal = symmetry.crystal;
    options.sample = symmetry.sample;
    size_t counts[CLI_LEVEL_LIMIT] = {result->count};
    for (size_t k = 0; k < arguments->levels.count; ++k) {
        const char *const text = cli_list_at(&arguments->levels, k);
        uint64_t number;
        if (!aur_parse_integer(text, SIZE_MAX, &number))
            return aur_fail(error, AUR_ERROR_ARGUMENT, "--levels: must be numbers of samples, not '%s'",
                            text);
        counts[k] = (size_t)number;
    }
    const aur_result status =
        arguments->levels.count == 0
            ? aur_weights_exact(result->count, result->xyz, &options, result->count, result->weights,
                                result->exact, error)
            : aur_weights_nested(result->count, result->xyz, result->lobe_count, counts, &options,
                                 result->lobe_count * result->count, result->weights, result->exact, error);
    cli_progress_clear();
    const aur_warnings warnings = points->warnings;
    const size_t last = result->lobe_count - 1;
    if (status == AUR_OK && result->exact[last].distinct_points < result->exact[last].points &&
        warnings.function != NULL)
        warnings.function(warnings.user, "points lie on each other and share their weights");
    return status;
}

aur_result cli_weights_by_cells(const cli_weights_arguments *arguments, cli_weights_result *result,
                                aur_error *error) {
    const aur_directions_options *const points = &arguments->points.options;
    aur_measure_options options = {.size = sizeof options};
    aur_measure_options_init(&options, NULL);
    options.cap_degrees = points->cap_degrees;
    options.threads = arguments->common.threads;
    options.progress = cli_progress(arguments->common.quiet);
    const aur_result status = aur_weights_voronoi(result->count, result->xyz, result->domain, &points->lobe,
                                                  &options, result->count, result->weights, error);
    cli_progress_clear();
    return status;
}
