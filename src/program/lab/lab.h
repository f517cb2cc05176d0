/* The papers' experiments: each is one file in program/lab/<author-year>/ and one line in the table of lab.c,
 * made from public API calls only. An experiment says what it measures, and its function fills a table with
 * it row by row, says in notes what it found, and writes pictures. Everything else is made of this: CSV
 * files, verdicts on published figures, plots, the report, and going on after an interruption.
 */
#pragma once

#include <aureole-render/render.h>
#include <stdbool.h>

#include "program/report/report.h"

typedef struct lab_run lab_run;

/* The `factor` of every experiment that measures ratios of errors, counts of samples for the same error,
 * shares or slopes. Values of their own, such as Keller's, have 1.5. */
#define LAB_RATIO_FACTOR 1.1

typedef struct lab_experiment {
    const char *name;           /* "marques-2013-gather" */
    const char *reproduces;     /* "Marques 2013, figs 5-6" */
    const char *summary;        /* one line */
    const char *rows;           /* "scene/map": what its rows are named by; NULL: all are made always */
    const char *const *columns; /* of the table, NULL at the end */

    /* The columns with what was measured, the ends of its interval of 95 %, and what is published; each may
     * be NULL. Where something is published the columns published_over_measured and verdict follow by
     * themselves: it agrees when it lies in the interval, or is within `factor` (1.5, ...) of it, or
     * differs. */
    const char *measured, *low, *high, *published;
    double factor;

    const report_plot *plots; /* NULL: none */
    const char *takes_no_set; /* why --set adds no row; NULL: it does */
    /* Processor seconds, as measured or as those of the quick form and the counts let one expect: for the
     * estimate before it starts. */
    double seconds, quick_seconds;

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
    const char *folder; /* where each experiment has a folder of its name; it exists */
    size_t threads;
    aur_progress progress;
    aur_warnings warnings;
} lab_options;

typedef enum lab_verdict { LAB_AGREES, LAB_WITHIN, LAB_DIFFERS, LAB_UNPUBLISHED, LAB_VERDICTS } lab_verdict;

/* What an experiment found. */
typedef struct lab_result {
    report_table *table;
    char *notes;                   /* lines; NULL when there are none */
    char *files;                   /* the paths of what was written, a line each; or NULL */
    size_t verdicts[LAB_VERDICTS]; /* rows of each */
    size_t claims, claims_held;    /* of those that a paper makes in words */
    double seconds;                /* of the processors, with those before interruptions */
} lab_result;

/* Whether its results are in the folder already, made by this version with the same options. */
bool lab_is_finished(const lab_experiment *experiment, const lab_options *options);
/* Runs it, and writes FOLDER/NAME/: NAME.csv, the further tables, pictures, and timings.csv, which alone
 * differs from run to run. A run that was interrupted goes on, one that was finished begins anew. The result
 * is to be released even after an error: what was finished is in it, and in the files. */
aur_result lab_run_experiment(const lab_experiment *experiment, const lab_options *options,
                              lab_result *result, aur_error *error);
void lab_result_release(lab_result *result);

/* --- for experiments */

/* The options of the run, whose folder is that of the experiment. */
const lab_options *lab_run_options(const lab_run *run);
/* The cells of the table, row by row. */
void lab_text(lab_run *run, const char *text); /* NULL: empty, as where nothing is published */
void lab_number(lab_run *run, double value);
/* A row at once: texts (NULL after the last), and then numbers, of which NaN leaves its cell empty. */
void lab_row(lab_run *run, const char *const *texts, size_t count, const double *numbers);
/* The same of a further table. */
void lab_table_row(report_table *table, const char *const *texts, size_t count, const double *numbers);
/* Whether the row of that name was asked for. */
bool lab_wants(const lab_run *run, const char *name);
void lab_note(lab_run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A claim that the paper makes in words, in a note that says whether it holds in what was measured. Those
 * that hold are counted. */
void lab_claim(lab_run *run, bool holds, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* One more table, to be filled by lab_table_row: NAME-<name>.csv, which a plot may name. NULL
 * when there is no memory, which the run ends with then. `columns` end with NULL. */
report_table *lab_table(lab_run *run, const char *name, const char *const *columns);

/* Processor seconds that `what` took. Times are kept out of the tables, which then are the same in every
 * run. */
void lab_time(lab_run *run, const char *what, double seconds);

/* What a run that was interrupted had measured. Asked before work that takes more than a second or so:
 *
 *     if (!lab_recall(run, key, 2, values)) {
 *         ... measure values ...
 *         result = lab_keep(run, key, 2, values, error);
 *     }
 *
 * `key` says of what the numbers are, in a line, and is used once. Pictures that were made before lab_keep
 * stay too. */
bool lab_recall(const lab_run *run, const char *key, size_t count, double *values);
/* Errors: WRITE, MEMORY, CANCELLED. */
aur_result lab_keep(lab_run *run, const char *key, size_t count, const double *values, aur_error *error);

/* Lets a measurement of the set of --set fail, as one of a file with too few points does: a note says so, the
 * row that was begun is ended, and AUR_OK is returned. Every other failure is returned as it is. */
aur_result lab_forgive(lab_run *run, const char *set, aur_result result, const aur_error *error);

/* --- pictures */

/* Loads a bundled scene by its path below the scenes folder. */
aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, aur_scene **scene, aur_error *error);

typedef struct lab_stage {
    aur_scene *scene;
    aur_renderer *renderer; /* NULL: there are no meshes for the scene */
} lab_stage;

/* A scene that can be rendered. One whose meshes were not made leaves no renderer and a note, and AUR_OK is
 * returned. The stage is to be closed, also after an error. */
aur_result lab_stage_open(lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, lab_stage *stage, aur_error *error);
void lab_stage_close(lab_stage *stage);

typedef struct lab_rendering {
    aur_renderer *renderer;
    const char *integrator; /* NAME:KEYS */
    size_t width, height;
    size_t crop[4]; /* only the pixels of [x0, x1) x [y0, y1); all 0: the whole picture */
    size_t samples; /* a pixel; 0: 1 */
    uint64_t seed;
} lab_rendering;

/* Renders with Sobol samples and the box filter. */
aur_result lab_render(const lab_run *run, const lab_rendering *how, aur_image **image, aur_error *error);

/* The mean of (x - a)(x - b) over pixels and channels of pictures of one size: the mean square error of x,
 * where a and b are two references whose own errors are independent and so drop out. */
double lab_mean_product(const aur_image *x, const aur_image *a, const aur_image *b);

/* A picture of the report. Those of one view are seen in one viewer, and compared with its reference. */
typedef struct lab_image_position {
    const char *view; /* "diffuse"; NULL: a view of its own */
    const char *name; /* "sobol" */
    bool reference;
    double exposure; /* stops, to begin with */
} lab_image_position;

/* Writes NAME-<view>-<name>.exr and, as people look at it, .png. */
aur_result lab_picture(lab_run *run, const lab_image_position *place, const aur_image *image,
                       aur_error *error);

/* --- figures of repeated measurements, with intervals of 95 % */

/* The mean of `values` and the half width of its 95 % interval (Student's t); half is 0 for one value. */
void lab_mean_interval(size_t count, const double *values, double *mean, double *half);

typedef struct lab_interval {
    double value, low, high;
} lab_interval;

/* The root of the mean of `squares`, such as mean square errors of independent randomisations. */
lab_interval lab_root_mean(size_t count, const double *squares);
/* The root of that mean over another one's, which are independent; the interval follows from both. 1 without
 * an interval for a base over itself. */
lab_interval lab_root_ratio(size_t count, const double *squares, size_t base_count, const double *base);
/* The same where both are of the same `count` randomisations: the interval is that of the linear form. */
lab_interval lab_root_ratio_paired(size_t count, const double *squares, const double *base);
/* The slope of log y against log x by least squares; the interval is of the scatter about the line
 * (Student's t), and as wide as can be for fewer than three points. */
lab_interval lab_slope(size_t count, const double *x, const double *y);

/* The report of what was run. */

/* Writes the page of all results in a folder to `folder`/index.html, which `path` gets. Beside it stand its
 * plots for print, as PDF, SVG and TikZ, unless it is small; a small page shows large pictures as means of 2
 * x 2 pixels, within .8 %. Errors: OPEN when there are no results, FORMAT, WRITE, MEMORY. */
aur_result lab_publish(const char *results, const char *folder, bool small,
                       char path[AUR_ERROR_FILE_CAPACITY], aur_error *error);
