/* The papers' experiments: each is one file in lab/<author-year>/ and one line in the table of lab.c, made
 * from public API calls only (aureole-lab/lab.h).
 */
#pragma once

#include <aureole-lab/lab.h>

#include "program/report/report.h"

/* Those of the table, and those that lab_add_experiments added. */
size_t lab_experiment_count(void);
const lab_experiment *lab_experiment_at(size_t index); /* NULL beyond the table */

/* Of experiments in one scene, which lab_stage_open replaces by that of --scene. */
extern const lab_parameter lab_scene_parameters[2];

/* How plots and tables of papers look. */
typedef struct lab_paper_style {
    double width, height; /* of plots, in cm */
    double text_size;     /* of PDF, in points */
    bool times;           /* in Times, else Helvetica */
    size_t digits;        /* significant ones of tables */
} lab_paper_style;

/* Writes, of each experiment with results in a folder, NAME.tex (a tabular of LaTeX), NAME.dat (the same
 * between tabs, all digits), NAME-plot-PLOT.pdf, and NAME-plot-PLOT.tex (TikZ) with its NAME-plot-PLOT.dat;
 * the paths go to `written`, a line each. Errors: OPEN when there are no results, FORMAT, WRITE, MEMORY. */
aur_result lab_write_paper(const char *results, const char *folder, const lab_paper_style *style,
                           FILE *written, aur_error *error);

/* Whether its results are in the folder already, made by this version with the same options. */
bool lab_is_finished(const lab_experiment *experiment, const lab_options *options);
