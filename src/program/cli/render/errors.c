#include "program/cli/render/render_result.h"

#include <stdio.h>
#include <stdlib.h>

#include "program/cli/cli.h"

struct cli_errors {
    const char *path; /* of the reference */
    aur_image *reference;
    report_table *table;
};

cli_errors *cli_errors_create(const char *reference) {
    static const char *const columns[] = {"spp", "samples", "rays", "cpu_seconds", "rmse", "relative_rmse"};
    cli_errors *const errors = calloc(1, sizeof *errors);
    aur_error error = {.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    if (errors == NULL || aur_image_read(reference, &errors->reference, &error) != AUR_OK) {
        cli_fail(&error);
        free(errors);
        return NULL;
    }
    errors->path = reference;
    errors->table = report_create(sizeof columns / sizeof columns[0], columns);
    return errors;
}

void cli_errors_destroy(cli_errors *errors) {
    if (errors == NULL)
        return;
    aur_image_destroy(errors->reference);
    report_destroy(errors->table);
    free(errors);
}

static aur_result note_image(cli_errors *errors, const aur_image *image,
                             const aur_render_statistics *statistics, aur_error *error) {
    double rmse[4], mean[4];
    aur_result result = aur_image_compare(errors->reference, image, AUR_IMAGE_RMSE, rmse, error);
    if (result == AUR_OK)
        result = aur_image_mean(errors->reference, mean, error);
    if (result != AUR_OK) {
        snprintf(error->file, sizeof error->file, "%s", errors->path);
        return result;
    }
    const uint64_t pixels = (uint64_t)aur_image_width(image) * aur_image_height(image);
    report_integer(errors->table, statistics->samples / pixels);
    report_integer(errors->table, statistics->samples);
    report_integer(errors->table, statistics->rays);
    report_number(errors->table, statistics->cpu_seconds, 6);
    report_number(errors->table, rmse[3], 6);
    report_number(errors->table, rmse[3] / mean[3], 6);
    return AUR_OK;
}

aur_result cli_errors_note(cli_errors *errors, const aur_render *render, aur_error *error) {
    aur_image *image = NULL;
    aur_render_statistics statistics = {.size = sizeof statistics};
    aur_render_get_statistics(render, &statistics, NULL);
    aur_result result = aur_film_develop(aur_render_film(render), &image, error);
    if (result == AUR_OK)
        result = note_image(errors, image, &statistics, error);
    aur_image_destroy(image);
    return result;
}

aur_result cli_errors_write(const cli_errors *errors, const char *path, aur_error *error) {
    return report_save(errors->table, NULL, path, error);
}
