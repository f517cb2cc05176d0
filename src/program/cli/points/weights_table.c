/* aureole weights --table: builds a table of optimal weights, or looks up weights in one. */
#include <stdlib.h>

#include "program/cli/points/weights.h"

static const double degree = 3.14159265358979323846 / 180.0;

int cli_weights_table(const cli_weights_arguments *arguments) {
    const aur_oswa_options options = cli_weights_oswa(arguments);
    const aur_progress progress = cli_progress(arguments->common.quiet);
    aur_error error = {0};
    const aur_weight_table_grid grid = {.size = sizeof grid,
                                        .angle_count = arguments->angles,
                                        .roughness_count = arguments->roughnesses,
                                        .rotation_count = arguments->rotations};
    aur_weight_table *table;
    aur_result result =
        aur_weight_table_build(&options, &grid, arguments->common.threads, &progress, &table, &error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = aur_weight_table_save(table, arguments->table, &error);
    aur_weight_table_destroy(table);
    return cli_status(result, &error);
}

static aur_result write_entry(const cli_weights_arguments *arguments, const aur_weight_table *table,
                              aur_error *error) {
    const aur_oswa_options *const options = aur_weight_table_options(table);
    const size_t size = options->count + options->mirror_count, lobes = options->count > 0 ? 2 : 1;
    double *const xyz = malloc(5 * size * sizeof *xyz);
    float *const found = malloc(size * sizeof *found);
    aur_result result = AUR_ERROR_MEMORY;
    if (xyz == NULL || found == NULL) {
        aur_fail(error, result, "out of memory");
    } else {
        const double radians = arguments->look_up_degrees * degree;
        const double alpha =
            arguments->look_up_alpha > 0.0 ? arguments->look_up_alpha : options->mirror_lobe.alpha;
        double *const weights = xyz + 3 * size;
        result = aur_weight_table_points(table, radians, alpha, arguments->rotation, arguments->mirrored,
                                         3 * size, xyz, error);
        for (size_t lobe = 0; lobe < lobes && result == AUR_OK; ++lobe) {
            result = aur_weight_table_look_up(table, lobe + 2 - lobes, arguments->rotation, radians, alpha,
                                              size, found, error);
            for (size_t i = 0; i < size && result == AUR_OK; ++i)
                weights[lobe * size + i] = (double)found[i];
        }
        const char *const path = arguments->path != NULL ? arguments->path : "-";
        if (result == AUR_OK)
            result = aur_weights_write(path, AUR_DOMAIN_HEMISPHERE, size, xyz, lobes, weights, error);
    }
    free(xyz);
    free(found);
    return result;
}

int cli_weights_look_up(const cli_weights_arguments *arguments) {
    const aur_oswa_options options = cli_weights_oswa(arguments);
    aur_error error = {0};
    aur_weight_table *table;
    const aur_oswa_options *const expected = arguments->source != NULL ? &options : NULL;
    aur_result result = aur_weight_table_load(arguments->table, expected, &table, &error);
    if (result != AUR_OK)
        return cli_fail(&error);
    const size_t rotations = aur_weight_table_rotations(table);
    int status = CLI_SUCCESS;
    if (arguments->rotation >= rotations)
        status = cli_bad_usage("--rotation: the table has rotations 0 to %zu, not %zu", rotations - 1,
                               arguments->rotation);
    else if (arguments->look_up_alpha > 0.0 && aur_weight_table_roughnesses(table) == 1)
        status = cli_bad_usage("--roughness: the table has one only, or none");
    else if (write_entry(arguments, table, &error) != AUR_OK)
        status = cli_fail(&error);
    aur_weight_table_destroy(table);
    return status;
}
