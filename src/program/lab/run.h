/* The state of a run, for the files that make it. */
#pragma once

#include <time.h>

#include <stdio.h>

#include "program/lab/kept.h"
#include "program/lab/lab.h"

enum { LAB_FURTHER_TABLES = 8 };

struct lab_run {
    const lab_experiment *experiment;
    lab_options options;
    lab_result *result;
    FILE *notes, *files; /* in memory */
    lab_kept *kept;
    report_table *pictures, *times;
    size_t further_count;
    report_table *further[LAB_FURTHER_TABLES];
    const char *further_names[LAB_FURTHER_TABLES];
    size_t cells;        /* of the row that is being filled */
    double begin, saved; /* processor and wall clock */
    aur_progress shown;
    char folder[AUR_ERROR_FILE_CAPACITY - 256];
};

double lab_clock_seconds(clockid_t clock);
/* Processor seconds, with those before interruptions. */
double lab_run_seconds(const lab_run *run);
/* FOLDER/NAME/NAME-<what>.<extension>; `what` may be NULL. */
void lab_run_path(const lab_run *run, const char *what, const char *extension, char *path, size_t capacity);
/* Writes a table there; `listed` among the files that the user is told of. */
aur_result lab_run_save(lab_run *run, const report_table *table, const char *what, const char *notes,
                        bool listed, aur_error *error);
