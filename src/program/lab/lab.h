/* The papers' experiments: each is one file in lab/<author-year>/ and one line in the table of lab.c, and
 * uses public API only (aureole-lab/lab.h). */
#pragma once

#include <aureole-lab/lab.h>

#include "program/report/report.h"

/* Built-in experiments, then those added by lab_add_experiments. */
size_t lab_experiment_count(void);
const lab_experiment *lab_experiment_at(size_t index); /* NULL past the end */

/* The parameter of experiments with one scene, which --scene replaces in lab_stage_open. */
extern const lab_parameter lab_scene_parameters[2];

/* Style of plots and tables for papers. */
typedef struct lab_paper_style {
    double width, height; /* of plots, in cm */
    double text_size;     /* in PDF, in points */
    bool times;           /* Times, else Helvetica */
    size_t digits;        /* significant digits in tables */
} lab_paper_style;

/* For each experiment with results in a folder, writes NAME.tex (a LaTeX tabular), NAME.dat (the same,
 * tab-separated, all digits), NAME-plot-PLOT.pdf, and NAME-plot-PLOT.tex (TikZ) with its NAME-plot-PLOT.dat.
 * The paths are written to `written`, one per line. Errors: OPEN if there are no results, FORMAT, WRITE,
 * MEMORY. */
aur_result lab_write_paper(const char *results, const char *folder, const lab_paper_style *style,
                           FILE *written, aur_error *error);

/* Whether the folder has its results, computed by this version with the same options. */
bool lab_is_finished(const lab_experiment *experiment, const lab_options *options);
