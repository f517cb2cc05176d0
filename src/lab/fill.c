/* What an experiment calls: cells, notes, pictures, what is kept. */
#include <aureole/ranks.h>
#include <aureole/statistics.h>
#include <aureole/text.h>
#include <fnmatch.h>
#include <stdarg.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "lab/run.h"
#include "lab/verdict.h"

#ifndef AUR_SCENES_FOLDER
#define AUR_SCENES_FOLDER "scenes"
#endif

enum { SAVE_EVERY = 5 }; /* seconds */

const lab_options *lab_run_options(const lab_run *run) {
    return &run->options;
}

/* --- cells */

static const char *column_name(const lab_run *run, size_t index) {
    return run->experiment->columns[index];
}

/* Ends a row: the verdict, and now and then the table so far as a file. */
static void end_row(lab_run *run) {
    const lab_experiment *const of = run->experiment;
    report_table *const table = run->result->table;
    run->cells = 0;
    if (of->published != NULL) {
        const size_t row = report_rows(table); /* which is not whole before the verdict */
        const char *const names[] = {of->measured, of->low, of->high, of->published};
        double values[4];
        for (size_t i = 0; i < 4; ++i)
            values[i] = report_value(table, row, report_find(table, names[i]));
        const lab_verdict verdict = lab_judge(values[0], values[1], values[2], values[3], of->factor);
        char text[64];
        lab_verdict_text(verdict, of->factor, text);
        if (verdict == LAB_UNPUBLISHED)
            report_text(table, NULL);
        else
            report_number(table, values[3] / values[0], 4);
        report_text(table, text);
        ++run->result->verdicts[verdict];
    }
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    const double now = (double)time.tv_sec;
    if (now - run->saved < SAVE_EVERY || aur_ranks_count() > 1) /* ranks write at the same time */
        return;
    run->saved = now;
    lab_run_save(run, table, NULL, "unfinished: the same command goes on", false, NULL);
}

static void cell_done(lab_run *run) {
    ++run->cells;
    if (column_name(run, run->cells) == NULL)
        end_row(run);
}

void lab_text(lab_run *run, const char *text) {
    report_text(run->result->table, text);
    cell_done(run);
}

void lab_number(lab_run *run, double value) {
    report_number(run->result->table, value, 4);
    cell_done(run);
}

bool lab_wants(const lab_run *run, const char *name) {
    return run->options.rows == NULL || fnmatch(run->options.rows, name, 0) == 0;
}

void lab_note(lab_run *run, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vfprintf(run->notes, format, arguments);
    va_end(arguments);
    fputc('\n', run->notes);
}

report_table *lab_table(lab_run *run, const char *name, const char *const *columns) {
    if (run->further_count == LAB_FURTHER_TABLES)
        return NULL;
    report_table *const table = report_create(0, NULL);
    for (; *columns != NULL; ++columns)
        report_column(table, *columns);
    run->further_names[run->further_count] = name;
    run->further[run->further_count++] = table;
    return table;
}

void lab_time(lab_run *run, const char *what, double seconds) {
    report_text(run->times, what);
    report_number(run->times, seconds, 4);
}

/* --- what is kept */

bool lab_recall(const lab_run *run, const char *key, size_t count, double *values) {
    return lab_kept_find(run->kept, key, count, values);
}

aur_result lab_keep(lab_run *run, const char *key, size_t count, const double *values, aur_error *error) {
    const aur_result result = lab_kept_add(run->kept, key, count, values, lab_run_seconds(run), error);
    const aur_progress progress = run->options.progress;
    if (result == AUR_OK && progress.function != NULL &&
        progress.function(progress.user, run->experiment->name, 0, 1) != 0)
        return aur_fail(error, AUR_ERROR_CANCELLED, "interrupted");
    return result;
}

aur_result lab_forgive(lab_run *run, const char *set, aur_result result, const aur_error *error) {
    const bool added = run->options.set != NULL && strcmp(set, run->options.set) == 0;
    if (result == AUR_OK || result == AUR_ERROR_CANCELLED || result == AUR_ERROR_MEMORY || !added)
        return result;
    while (run->cells > 0)
        lab_text(run, NULL);
    lab_note(run, "%s left out: %s", set, error->message);
    return AUR_OK;
}

/* --- scenes and pictures */

aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, aur_scene **scene, aur_error *error) {
    const char *folder = run->options.scenes;
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
                                       .warnings = run->options.warnings};
    return aur_scene_load(full, &options, scene, error);
}

/* The row of a picture; one that was made before an interruption has it already. */
static void list_picture(lab_run *run, const lab_picture_place *place, const char *path) {
    const char *const file = strrchr(path, '/') + 1;
    for (size_t i = 0; i < report_rows(run->pictures); ++i)
        if (strcmp(report_cell(run->pictures, i, 2), file) == 0)
            return;
    report_text(run->pictures, place->view);
    report_text(run->pictures, place->name);
    report_text(run->pictures, file);
    report_text(run->pictures, place->reference ? "reference" : "");
    report_number(run->pictures, place->exposure, 4);
}

aur_result lab_picture(lab_run *run, const lab_picture_place *place, const aur_image *image,
                       aur_error *error) {
    static const char *const extensions[] = {"exr", "png"};
    char path[AUR_ERROR_FILE_CAPACITY], name[256];
    snprintf(name, sizeof name, "%s%s%s", place->view != NULL ? place->view : "",
             place->view != NULL ? "-" : "", place->name);
    const aur_image_write_options options = {
        .size = sizeof options, .exposure = (float)place->exposure, .half = true};
    for (size_t i = 2; i-- > 0;) {
        lab_run_path(run, name, extensions[i], path, sizeof path);
        const aur_result result = aur_image_write(path, image, &options, error);
        if (result != AUR_OK)
            return result;
    }
    list_picture(run, place, path);
    return lab_run_save(run, run->pictures, "pictures", NULL, false, error);
}

void lab_mean_interval(size_t count, const double *values, double *mean, double *half) {
    aur_moments moments = {0};
    for (size_t i = 0; i < count; ++i)
        aur_moments_add(&moments, values[i]);
    *mean = moments.mean;
    *half = aur_moments_interval(&moments, 0.95);
}
