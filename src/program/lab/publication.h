/* The report page of a folder of results; private to its source files. */
#pragma once

#include <stdio.h>

#include "program/lab/lab.h"

typedef struct publication {
    const char *results, *folder;
    FILE *page;
    bool small;
} publication;

/* A table of an experiment: the main one if what == NULL. */
void publication_path(const publication *p, const lab_experiment *of, const char *what, char *path,
                      size_t capacity);
bool publication_has(const publication *p, const lab_experiment *of);
void publication_text(FILE *page, const char *begin, const char *text, const char *end);
/* The plot of an experiment's table; with `print`, links to the formats for print too. */
aur_result publication_plot(const publication *p, const lab_experiment *of, const report_plot *plot,
                            bool print, aur_error *error);

/* Counts of verdicts, from the table and its notes. */
typedef struct publication_tally {
    size_t rows, verdicts[LAB_VERDICTS], claims, hold;
} publication_tally;
aur_result publication_count(const publication *p, const lab_experiment *of, publication_tally *tally,
                             aur_error *error);

/* The first part of the page: for each paper a sentence, a figure and its verdicts; then experiments that
 * belong to no paper. */
aur_result publication_put_overview(const publication *p, aur_error *error);
