/* Experiments: what one measures, beside what is published, with everything that is made of it - CSV files,
 * verdicts, claims, plots, the report, and going on after an interruption. Those of the papers are in the
 * tree's lab/; others are modules that `aureole lab --module FILE` loads (lab_module, below), programs linked
 * with libaureole-lab, or functions of Python (aureole.lab).
 *
 * An experiment says what it measures, and its function fills a table with it row by row, says in notes what
 * it found, and writes images.
 *
 * Experimental: all of this header may change in any version, and a module is of one version alone. */
#ifndef AUREOLE_LAB_LAB_H
#define AUREOLE_LAB_LAB_H

#include <aureole-lab/plot.h>
#include <aureole-render/render.h>
#include <aureole/pointset.h>
#include <aureole/version.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lab_run lab_run;

/* The `factor` of every experiment that measures ratios of errors, counts of samples for the same error,
 * shares or slopes. Values of their own, such as Keller's, have 1.5. */
#define LAB_RATIO_FACTOR 1.1

/* What a run may set, by `-D name=value`. */
typedef struct lab_parameter {
    const char *name;         /* NULL ends a list */
    const char *default_text; /* NULL: none */
    const char *help;
} lab_parameter;

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

    const lab_parameter *parameters; /* NULL: none */
    void *user;                      /* of the experiment's own: lab_run_user */
    const char *takes_no_scene;      /* why --scene is refused where no parameter is named "scene"; NULL: it
                                        renders none */
} lab_experiment;

/* A function whose integral over the domain is estimated, as the mean over uniform points: the experiment
 * aureole-integrand compares sets on it. Several threads may call it. */
typedef struct lab_named_integrand {
    const char *name;
    aur_domain domain; /* SQUARE, CUBE, DISK, HEMISPHERE or SPHERE */
    size_t dimension;  /* of the CUBE; else 0 */
    /* Values at `count` points, whose coordinates lie one after another, into values[count]. */
    aur_result (*evaluate)(void *user, size_t count, size_t dimension, const double *points, double *values,
                           aur_error *error);
    void *user;
    double mean; /* over the domain; NaN: the mean of many Sobol' points stands for it */
} lab_named_integrand;

/* What a module has: a shared library that `aureole lab --module FILE` loads, built by
 * `cc -shared -fPIC mine.c $(pkg-config --cflags aureole-lab) -o mine.so`, with functions of the program.
 * Sets are then callback:NAME of
 * --set, integrands are those of --integrand. */
typedef struct lab_module {
    size_t size;         /* of this struct */
    const char *version; /* LAB_VERSION, which must be that of the program */
    size_t experiment_count;
    const lab_experiment *const *experiments;
    size_t set_count;
    const aur_set_callback *sets;
    size_t integrand_count;
    const lab_named_integrand *integrands;
} lab_module;

/* Defined by the module, which shows it: what it has, which stays. */
const lab_module *aureole_lab_module(void);

#define LAB_TEXT_OF(number) #number
#define LAB_TEXT(number) LAB_TEXT_OF(number)
#define LAB_VERSION                                                                                          \
    LAB_TEXT(AUREOLE_VERSION_MAJOR) "." LAB_TEXT(AUREOLE_VERSION_MINOR) "." LAB_TEXT(AUREOLE_VERSION_PATCH)

/* Adds what a module has for this process; it must outlive all runs. An experiment, set or integrand of the
 * same name is replaced. Errors: UNSUPPORTED for another version, ARGUMENT, MEMORY. */
AUR_EXPERIMENTAL aur_result lab_add(const lab_module *module, aur_error *error);
/* Those of the tree and those that were added; NULL when there is none of this name. */
AUR_EXPERIMENTAL const lab_experiment *lab_find_experiment(const char *name);
AUR_EXPERIMENTAL const lab_named_integrand *lab_find_integrand(const char *name);

typedef struct lab_options {
    bool quick;         /* a form that takes seconds and shows the same thing with wider intervals */
    const char *set;    /* one more set to compare, or NULL */
    const char *rows;   /* a pattern of the shell: the rows to make; NULL: all */
    const char *scenes; /* the folder of the bundled scenes; NULL: ./scenes, then the source tree's */
    const char *folder; /* where each experiment has a folder of its name; it exists */
    size_t parameter_count;
    const aur_definition *parameters; /* of the experiment */
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

/* Runs it, and writes FOLDER/NAME/: NAME.csv, the further tables, images, and timings.csv, which alone
 * differs from run to run. A run that was interrupted goes on, one that was finished starts again. The result
 * is to be released even after an error: what was finished is in it, and in the files. */
AUR_EXPERIMENTAL aur_result lab_run_experiment(const lab_experiment *experiment, const lab_options *options,
                                               lab_result *result, aur_error *error);
AUR_EXPERIMENTAL void lab_result_release(lab_result *result);

/* --- for experiments */

/* The options of the run, whose folder is that of the experiment. */
AUR_EXPERIMENTAL const lab_options *lab_run_options(const lab_run *run);
AUR_EXPERIMENTAL void *lab_run_user(const lab_run *run);
/* The value of a parameter of the experiment, as given or by default: NULL when it has none, or is unknown.
 */
AUR_EXPERIMENTAL const char *lab_parameter_text(const lab_run *run, const char *name);
/* The same as a number; NaN when it is none. */
AUR_EXPERIMENTAL double lab_parameter_number(const lab_run *run, const char *name);
/* The cells of the table, row by row. */
AUR_EXPERIMENTAL void lab_text(lab_run *run,
                               const char *text); /* NULL: empty, as where nothing is published */
AUR_EXPERIMENTAL void lab_number(lab_run *run, double value);
/* A row at once: texts (NULL after the last), and then numbers, of which NaN leaves its cell empty. */
AUR_EXPERIMENTAL void lab_row(lab_run *run, const char *const *texts, size_t count, const double *numbers);
/* The same of a further table. */
AUR_EXPERIMENTAL void lab_table_row(report_table *table, const char *const *texts, size_t count,
                                    const double *numbers);
/* Whether the row of that name was asked for. */
AUR_EXPERIMENTAL bool lab_wants(const lab_run *run, const char *name);
AUR_EXPERIMENTAL void lab_note(lab_run *run, const char *format, ...) AUR_PRINTF(2, 3);

/* A claim that the paper makes in words, in a note that says whether it holds in what was measured. Those
 * that hold are counted. */
AUR_EXPERIMENTAL void lab_claim(lab_run *run, bool holds, const char *format, ...) AUR_PRINTF(3, 4);

/* One more table, to be filled by lab_table_row: NAME-<name>.csv, which a plot may name. NULL
 * when there is no memory, which the run ends with then. `columns` end with NULL. */
AUR_EXPERIMENTAL report_table *lab_table(lab_run *run, const char *name, const char *const *columns);

/* Processor seconds that `what` took. Times are kept out of the tables, which then are the same in every
 * run. */
AUR_EXPERIMENTAL void lab_time(lab_run *run, const char *what, double seconds);

/* What a run that was interrupted had measured. Asked before work that takes more than a second or so:
 *
 *     if (!lab_recall(run, key, 2, values)) {
 *         ... measure values ...
 *         result = lab_keep(run, key, 2, values, error);
 *     }
 *
 * `key` says of what the numbers are, in a line, and is used once. Images that were made before lab_keep
 * stay too. */
AUR_EXPERIMENTAL bool lab_recall(const lab_run *run, const char *key, size_t count, double *values);
/* Errors: WRITE, MEMORY, CANCELLED. */
AUR_EXPERIMENTAL aur_result lab_keep(lab_run *run, const char *key, size_t count, const double *values,
                                     aur_error *error);

/* Lets a measurement of the set of --set fail, as one of a file with too few points does: a note says so, the
 * row that was begun is ended, and AUR_OK is returned. Every other failure is returned as it is. */
AUR_EXPERIMENTAL aur_result lab_forgive(lab_run *run, const char *set, aur_result result,
                                        const aur_error *error);

/* --- images */

/* Loads a bundled scene by its path below the scenes folder. */
AUR_EXPERIMENTAL aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                                           const aur_definition *definitions, aur_scene **scene,
                                           aur_error *error);

typedef struct lab_stage {
    aur_scene *scene;
    aur_renderer *renderer; /* NULL: there are no meshes for the scene */
} lab_stage;

/* A scene that can be rendered: that of the parameter "scene" where the experiment has one and it is given,
 * without the definitions; published values are then not compared. One whose meshes were not made leaves no
 * renderer and a note, and AUR_OK is returned. The stage is to be closed, also after an error. */
AUR_EXPERIMENTAL aur_result lab_stage_open(lab_run *run, const char *path, size_t definition_count,
                                           const aur_definition *definitions, lab_stage *stage,
                                           aur_error *error);
AUR_EXPERIMENTAL void lab_stage_close(lab_stage *stage);

typedef struct lab_rendering {
    aur_renderer *renderer;
    const char *integrator; /* NAME:KEYS */
    size_t width, height;
    size_t crop[4]; /* only the pixels of [x0, x1) x [y0, y1); all 0: the whole image */
    size_t samples; /* a pixel; 0: 1 */
    uint64_t seed;
} lab_rendering;

/* Renders with Sobol samples and the box filter. */
AUR_EXPERIMENTAL aur_result lab_render(const lab_run *run, const lab_rendering *how, aur_image **image,
                                       aur_error *error);

/* The mean of (x - a)(x - b) over pixels and channels of images of one size: the mean square error of x,
 * where a and b are two references whose own errors are independent and so drop out. */
AUR_EXPERIMENTAL double lab_mean_product(const aur_image *x, const aur_image *a, const aur_image *b);

/* An image of the report. Those of one view are seen in one viewer, and compared with its reference. */
typedef struct lab_image_position {
    const char *view; /* "diffuse"; NULL: a view of its own */
    const char *name; /* "sobol" */
    bool reference;
    double exposure; /* stops, to begin with */
} lab_image_position;

/* Writes NAME-<view>-<name>.exr and, as people look at it, .png. */
AUR_EXPERIMENTAL aur_result lab_picture(lab_run *run, const lab_image_position *place, const aur_image *image,
                                        aur_error *error);

/* --- figures of repeated measurements, with intervals of 95 % */

/* The mean of `values` and the half width of its 95 % interval (Student's t); half is 0 for one value. */
AUR_EXPERIMENTAL void lab_mean_interval(size_t count, const double *values, double *mean, double *half);

typedef struct lab_interval {
    double value, low, high;
} lab_interval;

/* The root of the mean of `squares`, such as mean square errors of independent randomisations. */
AUR_EXPERIMENTAL lab_interval lab_root_mean(size_t count, const double *squares);
/* The root of that mean over another one's, which are independent; the interval follows from both. 1 without
 * an interval for a base over itself. */
AUR_EXPERIMENTAL lab_interval lab_root_ratio(size_t count, const double *squares, size_t base_count,
                                             const double *base);
/* The same where both are of the same `count` randomisations: the interval is that of the linear form. */
AUR_EXPERIMENTAL lab_interval lab_root_ratio_paired(size_t count, const double *squares, const double *base);
/* The slope of log y against log x by least squares; the interval is of the scatter about the line
 * (Student's t), and as wide as can be for fewer than three points. */
AUR_EXPERIMENTAL lab_interval lab_slope(size_t count, const double *x, const double *y);

/* --- the report of what was run */

/* Writes the page of all results in a folder to `folder`/index.html, which `path` gets. Beside it stand its
 * plots for print, as PDF, SVG and TikZ, unless it is small; a small page shows large images as means of 2
 * x 2 pixels, within .8 %. Errors: OPEN when there are no results, FORMAT, WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result lab_publish(const char *results, const char *folder, bool small,
                                        char path[AUR_ERROR_FILE_CAPACITY], aur_error *error);

#ifdef __cplusplus
}
#endif

#endif
