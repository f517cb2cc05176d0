/* The papers' experiments: each is one file in lab/<author-year>/ and one line in the table of lab.c, made
 * from public API calls only. An experiment fills a table, says what it found in notes, and writes pictures.
 */
#pragma once

#include <aureole/render.h>
#include <stdbool.h>

#include "report/report.h"

typedef struct lab_run lab_run;

typedef struct lab_experiment {
    const char *name;       /* "marques-2013-gather" */
    const char *reproduces; /* "Marques 2013, figs 5-6" */
    const char *summary;    /* one line */
    const char *rows;       /* "scene/map": what its rows are named by; NULL: all are made always */
    /* Uses the functions below; what it returns ends the run. */
    aur_result (*run)(lab_run *run, aur_error *error);
} lab_experiment;

size_t lab_experiment_count(void);
const lab_experiment *lab_experiment_at(size_t index); /* NULL beyond the table */

typedef struct lab_options {
    bool quick;         /* a form that takes seconds and shows the same thing with wider intervals */
    const char *set;    /* one more set to compare, or NULL */
    const char *rows;   /* a pattern of the shell: the rows to make; NULL: all */
    const char *scenes; /* the folder of the bundled scenes; NULL: ./scenes, then the source tree's */
    const char *folder; /* where files are written; it exists */
    size_t threads;
    aur_progress progress;
    aur_warnings warnings;
} lab_options;

/* What an experiment found. */
typedef struct lab_result {
    report_table *table;
    char *notes; /* lines; NULL when there are none */
    char *files; /* the paths of what was written, a line each; or NULL */
} lab_result;

/* Runs it, and writes NAME.csv beside its pictures. The result is to be released even after an error: what
 * was finished is in it. */
aur_result lab_run_experiment(const lab_experiment *experiment, const lab_options *options,
                              lab_result *result, aur_error *error);
void lab_result_release(lab_result *result);

/* --- for experiments */

const lab_options *lab_run_options(const lab_run *run);
/* Before any cell. */
void lab_columns(lab_run *run, size_t count, const char *const *columns);
void lab_text(lab_run *run, const char *text);
void lab_number(lab_run *run, double value);
/* Whether the row of that name was asked for. */
bool lab_wants(const lab_run *run, const char *name);
void lab_note(lab_run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Loads a bundled scene by its path below the scenes folder. */
aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, aur_scene **scene, aur_error *error);
/* Writes EXPERIMENT-NAME.png at the given exposure (stops). */
aur_result lab_picture(lab_run *run, const char *name, const aur_image *image, float exposure,
                       aur_error *error);

/* The mean of `values` and the half width of its 95 % interval (Student's t); half is 0 for one value. */
void lab_mean_interval(size_t count, const double *values, double *mean, double *half);
