/* The state of a run; private to its source files. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

#include "program/lab/lab.h"

/* A run's measurements so far, in a file that survives an interruption. */

typedef struct lab_store lab_store;

/* Opens the file of a run with the same `identity` (one line), or starts a new one. Errors: WRITE, MEMORY. */
aur_result lab_store_open(const char *path, const char *identity, lab_store **store, aur_error *error);
void lab_store_close(lab_store *store); /* NULL is allowed */

/* Whether there are measurements of an earlier run, and the processor seconds that it took. */
bool lab_store_continues(const lab_store *store);
double lab_store_seconds(const lab_store *store);

/* The numbers of a key; false if there are none. */
bool lab_store_find(const lab_store *store, const char *key, size_t count, double *values);
/* `seconds` is the run's total so far. Errors: WRITE. */
aur_result lab_store_add(lab_store *store, const char *key, size_t count, const double *values,
                         double seconds, aur_error *error);

/* Writes the measurements of a store's file as NPZ, an array per key; *written is false if there are none.
 * Errors: WRITE, MEMORY. */
aur_result lab_store_export(const char *store, const char *path, bool *written, aur_error *error);

enum { LAB_FURTHER_TABLES = 8, LAB_IDENTITY = 1024 };

struct lab_run {
    const lab_experiment *experiment;
    lab_options options;
    lab_result *result;
    FILE *notes, *files; /* in memory */
    lab_store *store;
    report_table *images, *times;
    size_t further_count;
    report_table *further[LAB_FURTHER_TABLES];
    const char *further_names[LAB_FURTHER_TABLES];
    size_t cells;        /* of the current row */
    double begin, saved; /* processor and wall clock */
    aur_progress shown;
    char folder[AUR_ERROR_FILE_CAPACITY - 256];
};

/* Registers a module's integrand. Errors: ARGUMENT. */
aur_result lab_add_integrand(const lab_named_integrand *integrand, aur_error *error);

double lab_clock_seconds(clockid_t clock);
/* Processor seconds, including those before interruptions. */
double lab_run_seconds(const lab_run *run);
/* FOLDER/NAME/NAME-<what>.<extension>; `what` may be NULL. */
void lab_run_path(const lab_run *run, const char *what, const char *extension, char *path, size_t capacity);
/* Writes a table there; if `listed`, its path is reported to the user. */
aur_result lab_run_save(lab_run *run, const report_table *table, const char *what, const char *notes,
                        bool listed, aur_error *error);

/* Whether the measured value agrees with the published one. */

/* The numbers of a row; NaN for empty cells. */
lab_verdict lab_judge(double measured, double low, double high, double published, double factor);
/* "agrees", "within a factor of 1.5", "differs", "not published". */
void lab_verdict_text(lab_verdict verdict, double factor, char text[64]);
