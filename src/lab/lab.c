/* The table of experiments, and what runs them: a new one is one file and one line here. */
#include "lab/lab.h"

#include <aureole/ranks.h>
#include <aureole/statistics.h>
#include <fnmatch.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#ifndef AUR_SCENES_FOLDER
#define AUR_SCENES_FOLDER "scenes"
#endif

extern const lab_experiment lab_domains_axes;
extern const lab_experiment lab_domains_grids;
extern const lab_experiment lab_domains_prefixes;
extern const lab_experiment lab_analytical_cases;
extern const lab_experiment lab_integrate_coverage;
extern const lab_experiment lab_irradiance_coverage;
extern const lab_experiment lab_factors_coverage;
extern const lab_experiment lab_picture_coverage;
extern const lab_experiment lab_keller_1994_table1;
extern const lab_experiment lab_keller_1994_table2;
extern const lab_experiment lab_keller_1994_table3;
extern const lab_experiment lab_marques_2013_gather;
extern const lab_experiment lab_marques_2013_table1;
extern const lab_experiment lab_marques_2018_gains;
extern const lab_experiment lab_marques_2018_rivals;
extern const lab_experiment lab_marques_2018_sensitivity;
extern const lab_experiment lab_marques_2018_slopes;
extern const lab_experiment lab_marques_2018_table1;
extern const lab_experiment lab_schretter_2012_fig5;
extern const lab_experiment lab_weights_choosing;

static const lab_experiment *const experiments[] = {
    &lab_domains_axes,        &lab_domains_grids,
    &lab_domains_prefixes,    &lab_analytical_cases,
    &lab_integrate_coverage,  &lab_irradiance_coverage,
    &lab_factors_coverage,    &lab_picture_coverage,
    &lab_keller_1994_table1,  &lab_keller_1994_table2,
    &lab_keller_1994_table3,  &lab_marques_2013_gather,
    &lab_marques_2013_table1, &lab_marques_2018_gains,
    &lab_marques_2018_rivals, &lab_marques_2018_sensitivity,
    &lab_marques_2018_slopes, &lab_marques_2018_table1,
    &lab_schretter_2012_fig5, &lab_weights_choosing,
};

size_t lab_experiment_count(void) {
    return sizeof experiments / sizeof experiments[0];
}

const lab_experiment *lab_experiment_at(size_t index) {
    return index < lab_experiment_count() ? experiments[index] : NULL;
}

struct lab_run {
    const lab_experiment *experiment;
    const lab_options *options;
    report_table *table;
    FILE *notes, *files; /* in memory */
};

const lab_options *lab_run_options(const lab_run *run) {
    return run->options;
}

void lab_columns(lab_run *run, size_t count, const char *const *columns) {
    for (size_t i = 0; i < count; ++i)
        report_column(run->table, columns[i]);
}

void lab_text(lab_run *run, const char *text) {
    report_text(run->table, text);
}

void lab_number(lab_run *run, double value) {
    report_number(run->table, value, 4);
}

bool lab_wants(const lab_run *run, const char *name) {
    return run->options->rows == NULL || fnmatch(run->options->rows, name, 0) == 0;
}

void lab_note(lab_run *run, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vfprintf(run->notes, format, arguments);
    va_end(arguments);
    fputc('\n', run->notes);
}

aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, aur_scene **scene, aur_error *error) {
    const char *folder = run->options->scenes;
    if (folder == NULL) {
        bool here = access("scenes", R_OK) == 0;
        aur_ranks_agree(sizeof here, &here);
        folder = here ? "scenes" : AUR_SCENES_FOLDER;
    }
    char full[AUR_ERROR_FILE_CAPACITY];
    snprintf(full, sizeof full, "%s/%s", folder, path);
    const aur_scene_options options = {.size = sizeof options,
                                       .definition_count = definition_count,
                                       .definitions = definitions,
                                       .warnings = run->options->warnings};
    return aur_scene_load(full, &options, scene, error);
}

aur_result lab_picture(lab_run *run, const char *name, const aur_image *image, float exposure,
                       aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY];
    snprintf(path, sizeof path, "%s/%s-%s.png", run->options->folder, run->experiment->name, name);
    const aur_image_write_options options = {.size = sizeof options, .exposure = exposure};
    const aur_result result = aur_image_write(path, image, &options, error);
    if (result == AUR_OK)
        fprintf(run->files, "%s\n", path);
    return result;
}

/* The table as CSV, with the notes as comments after it. */
static aur_result write_csv(lab_run *run, const char *notes, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY];
    snprintf(path, sizeof path, "%s/%s.csv", run->options->folder, run->experiment->name);
    const aur_result result = report_save(run->table, notes, path, error);
    if (result == AUR_OK)
        fprintf(run->files, "%s\n", path);
    return result;
}

/* Ends a text that was written to memory; false when there was not enough. */
static bool finish(FILE *stream) {
    return stream != NULL && fclose(stream) == 0;
}

aur_result lab_run_experiment(const lab_experiment *experiment, const lab_options *options,
                              lab_result *result, aur_error *error) {
    *result = (lab_result){.table = report_create(0, NULL)};
    size_t note_size, file_size;
    lab_run run = {.experiment = experiment,
                   .options = options,
                   .table = result->table,
                   .notes = open_memstream(&result->notes, &note_size),
                   .files = open_memstream(&result->files, &file_size)};
    aur_result outcome = AUR_OK;
    const bool ready = run.notes != NULL && run.files != NULL;
    if (ready)
        outcome = experiment->run(&run, error);
    const bool noted = finish(run.notes);
    if (outcome == AUR_OK && ready && noted)
        outcome = write_csv(&run, result->notes, error);
    const bool listed = finish(run.files);
    if (outcome == AUR_OK && !(ready && noted && listed))
        outcome = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    return outcome;
}

void lab_result_release(lab_result *result) {
    report_destroy(result->table);
    free(result->notes);
    free(result->files);
    *result = (lab_result){0};
}

void lab_mean_interval(size_t count, const double *values, double *mean, double *half) {
    aur_moments moments = {0};
    for (size_t i = 0; i < count; ++i)
        aur_moments_add(&moments, values[i]);
    *mean = moments.mean;
    *half = aur_moments_interval(&moments, 0.95);
}
