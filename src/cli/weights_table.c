/* aureole weights --table: builds a table of OSWA weights. */
#include "cli/weights.h"

int cli_weights_table(const cli_weights_arguments *arguments) {
    const aur_oswa_options options = cli_weights_oswa(arguments);
    const aur_progress progress = cli_progress(arguments->quiet);
    aur_error error = {0};
    aur_weight_table *table;
    aur_result result = aur_weight_table_build(&options, arguments->angles, arguments->rotations,
                                               arguments->threads, &progress, &table, &error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = aur_weight_table_save(table, arguments->table, &error);
    aur_weight_table_destroy(table);
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(&error);
}
