/* Functions for experiments: cells, notes, stored measurements. */

#include <aureole/ranks.h>
#include <aureole/text.h>
#include <fnmatch.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>
#include <time.h>

#include "program/lab/run.h"

lab_verdict lab_judge(double measured, double low, double high, double published, double factor) {
    if (isnan(published))
        return LAB_UNPUBLISHED;
    if (published == measured || (published >= low && published <= high))
        return LAB_AGREES;
    const double ratio = published / measured;
    return ratio <= factor && ratio >= 1.0 / factor ? LAB_WITHIN : LAB_DIFFERS;
}

void lab_verdict_text(lab_verdict verdict, double factor, char text[64]) {
    static const char *const names[LAB_VERDICTS] = {"agrees", "within a factor of %g", "differs",
                                                    "not published"};
    aur_format(text, 64, names[verdict], factor);
}

enum { SAVE_EVERY = 5 }; /* seconds */

const lab_options *lab_run_options(const lab_run *run) {
    return &run->options;
}

void *lab_run_user(const lab_run *run) {
    return run->experiment->user;
}

const char *lab_parameter_text(const lab_run *run, const char *name) {
    for (size_t i = run->options.parameter_count; i-- > 0;) /* the last definition wins */
        if (strcmp(run->options.parameters[i].name, name) == 0)
            return run->options.parameters[i].value;
    for (const lab_parameter *p = run->experiment->parameters; p != NULL && p->name != NULL; ++p)
        if (strcmp(p->name, name) == 0)
            return p->default_text;
    return NULL;
}

double lab_parameter_number(const lab_run *run, const char *name) {
    const char *const text = lab_parameter_text(run, name);
    double value;
    return text != NULL && aur_parse_double(text, &value) ? value : NAN;
}

/* --- cells */

static const char *column_name(const lab_run *run, size_t index) {
    return run->experiment->columns[index];
}

/* Ends a row: adds the verdict, and saves the partial table from time to time. */
static void end_row(lab_run *run) {
    const lab_experiment *const of = run->experiment;
    report_table *const table = run->result->table;
    run->cells = 0;
    if (of->published != NULL) {
        const size_t row = report_rows(table); /* the row is incomplete before the verdict */
        const char *const names[] = {of->measured, of->low, of->high, of->published};
        double values[4];
        for (size_t i = 0; i < 4; ++i)
            values[i] = report_value(table, row, report_find(table, names[i]));
        if (lab_parameter_text(run, "scene") != NULL) /* not the published scene */
            values[3] = NAN;
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
    if (now - run->saved < SAVE_EVERY || aur_ranks_count() > 1) /* ranks would write concurrently */
        return;
    run->saved = now;
    lab_run_save(run, table, NULL, "unfinished: the same command continues", false, NULL);
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

void lab_row(lab_run *run, const char *const *texts, size_t count, const double *numbers) {
    for (; *texts != NULL; ++texts)
        lab_text(run, *texts);
    for (size_t i = 0; i < count; ++i)
        if (isnan(numbers[i]))
            lab_text(run, NULL);
        else
            lab_number(run, numbers[i]);
}

void lab_table_row(report_table *table, const char *const *texts, size_t count, const double *numbers) {
    for (; *texts != NULL; ++texts)
        report_text(table, *texts);
    for (size_t i = 0; i < count; ++i)
        if (isnan(numbers[i]))
            report_text(table, NULL);
        else
            report_number(table, numbers[i], 4);
}

bool lab_row_requested(const lab_run *run, const char *name) {
    return run->options.rows == NULL || fnmatch(run->options.rows, name, 0) == 0;
}

void lab_note(lab_run *run, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vfprintf(run->notes, format, arguments);
    va_end(arguments);
    fputc('\n', run->notes);
}

void lab_claim(lab_run *run, bool holds, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("claim: ", run->notes);
    vfprintf(run->notes, format, arguments);
    va_end(arguments);
    fputs(holds ? ": holds\n" : ": does not hold\n", run->notes);
    ++run->result->claims;
    run->result->claims_held += holds;
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

/* --- stored measurements */

bool lab_recall(const lab_run *run, const char *key, size_t count, double *values) {
    return lab_store_find(run->store, key, count, values);
}

aur_result lab_save(lab_run *run, const char *key, size_t count, const double *values, aur_error *error) {
    const aur_result result = lab_store_add(run->store, key, count, values, lab_run_seconds(run), error);
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
    lab_note(run, "%s left out: %s%s%s", set, error->file, error->file[0] != '\0' ? ": " : "",
             error->message);
    return AUR_OK;
}
