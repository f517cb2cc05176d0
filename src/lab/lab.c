/* The table of experiments, and what runs them: a new one is one file and one line here. */
#include "lab/lab.h"

#include <aureole/statistics.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef AUR_SCENES_FOLDER
#define AUR_SCENES_FOLDER "scenes"
#endif

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

static const lab_experiment *const experiments[] = {
    &lab_keller_1994_table1,  &lab_keller_1994_table2,       &lab_keller_1994_table3,
    &lab_marques_2013_gather, &lab_marques_2013_table1,      &lab_marques_2018_gains,
    &lab_marques_2018_rivals, &lab_marques_2018_sensitivity, &lab_marques_2018_slopes,
    &lab_marques_2018_table1, &lab_schretter_2012_fig5,
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
    lab_result *result;
    bool out_of_memory;
};

const lab_options *lab_run_options(const lab_run *run) {
    return run->options;
}

/* Makes room for one more element; false, and remembered, when there is no memory. */
static bool grow(lab_run *run, void **elements, size_t size, size_t count, size_t *capacity) {
    if (count < *capacity)
        return true;
    const size_t larger = *capacity == 0 ? 32 : 2 * *capacity;
    void *const moved = realloc(*elements, larger * size);
    if (moved == NULL) {
        run->out_of_memory = true;
        return false;
    }
    *elements = moved;
    *capacity = larger;
    return true;
}

void lab_columns(lab_run *run, size_t count, const char *const *columns) {
    run->result->column_count = count;
    run->result->columns = columns;
}

static void add_cell(lab_run *run, const lab_cell *cell) {
    lab_result *const result = run->result;
    void *cells = result->cells;
    if (grow(run, &cells, sizeof *result->cells, result->cell_count, &result->cell_capacity)) {
        result->cells = cells;
        result->cells[result->cell_count++] = *cell;
    }
}

void lab_text(lab_run *run, const char *text) {
    lab_cell cell = {0};
    snprintf(cell.text, sizeof cell.text, "%s", text);
    add_cell(run, &cell);
}

void lab_number(lab_run *run, double value) {
    lab_cell cell = {.number = value, .is_number = true};
    snprintf(cell.text, sizeof cell.text, "%.4g", value);
    add_cell(run, &cell);
}

static void add_string(lab_run *run, char ***strings, size_t *count, size_t *capacity, const char *text) {
    void *list = *strings;
    if (!grow(run, &list, sizeof **strings, *count, capacity))
        return;
    *strings = list;
    (*strings)[*count] = strdup(text);
    if ((*strings)[*count] != NULL)
        ++*count;
    else
        run->out_of_memory = true;
}

void lab_note(lab_run *run, const char *format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    lab_result *const result = run->result;
    add_string(run, &result->notes, &result->note_count, &result->note_capacity, text);
}

aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, aur_scene **scene, aur_error *error) {
    const char *folder = run->options->scenes;
    if (folder == NULL)
        folder = access("scenes", R_OK) == 0 ? "scenes" : AUR_SCENES_FOLDER;
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
        add_string(run, &run->result->files, &run->result->file_count, &run->result->file_capacity, path);
    return result;
}

/* The table as CSV, with the notes as comments after it. */
static aur_result write_csv(lab_run *run, aur_error *error) {
    const lab_result *const table = run->result;
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    if (stream == NULL) {
        run->out_of_memory = true;
        return AUR_OK;
    }
    for (size_t i = 0; i < table->column_count; ++i)
        fprintf(stream, "%s%c", table->columns[i], i + 1 < table->column_count ? ',' : '\n');
    for (size_t i = 0; i < table->cell_count; ++i) {
        const char end = (i + 1) % table->column_count != 0 ? ',' : '\n';
        if (table->cells[i].is_number)
            fprintf(stream, "%.17g%c", table->cells[i].number, end);
        else
            fprintf(stream, "%s%c", table->cells[i].text, end);
    }
    for (size_t i = 0; i < table->note_count; ++i)
        fprintf(stream, "# %s\n", table->notes[i]);
    aur_result result = AUR_OK;
    if (fclose(stream) != 0) {
        run->out_of_memory = true;
    } else {
        char path[AUR_ERROR_FILE_CAPACITY];
        snprintf(path, sizeof path, "%s/%s.csv", run->options->folder, run->experiment->name);
        result = aur_file_write(path, size, text, error);
        if (result == AUR_OK)
            add_string(run, &run->result->files, &run->result->file_count, &run->result->file_capacity, path);
    }
    free(text);
    return result;
}

aur_result lab_run_experiment(const lab_experiment *experiment, const lab_options *options,
                              lab_result *result, aur_error *error) {
    *result = (lab_result){0};
    lab_run run = {.experiment = experiment, .options = options, .result = result};
    aur_result outcome = experiment->run(&run, error);
    if (outcome == AUR_OK)
        outcome = write_csv(&run, error);
    if (outcome == AUR_OK && run.out_of_memory) {
        outcome = AUR_ERROR_MEMORY;
        if (error != NULL)
            *error = (aur_error){.result = outcome, .message = "out of memory"};
    }
    return outcome;
}

void lab_result_release(lab_result *result) {
    for (size_t i = 0; i < result->note_count; ++i)
        free(result->notes[i]);
    for (size_t i = 0; i < result->file_count; ++i)
        free(result->files[i]);
    free(result->notes);
    free(result->files);
    free(result->cells);
    *result = (lab_result){0};
}

void lab_mean_interval(size_t count, const double *values, double *mean, double *half) {
    aur_moments moments = {0};
    for (size_t i = 0; i < count; ++i)
        aur_moments_add(&moments, values[i]);
    *mean = moments.mean;
    *half = aur_moments_interval(&moments, 0.95);
}
