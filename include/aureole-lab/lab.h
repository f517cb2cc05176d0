/* Experiments: measurements compared with published values, and everything derived from them: CSV files,
 * verdicts, claims, plots, the report, and resuming after an interruption. The papers' experiments are in the
 * source tree's lab/; others are modules that `aureole lab --module FILE` loads (lab_module, below), programs
 * linked with libaureole-lab, or Python functions (aureole.lab).
 *
 * An experiment describes its measurement; its function fills a table row by row, adds notes on the findings,
 * and writes images.
 *
 * Experimental: all of this header may change in any version, and a module works with one version only. */
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

/* The `factor` of every experiment that measures ratios of errors, numbers of samples for equal error, shares
 * or slopes. Absolute values, such as Keller's, use 1.5. */
#define LAB_RATIO_FACTOR 1.1

/* A parameter that `-D name=value` sets. */
typedef struct lab_parameter {
    const char *name;         /* NULL ends a list */
    const char *default_text; /* NULL: none */
    const char *help;
} lab_parameter;

typedef struct lab_experiment {
    const char *name;           /* "marques-2013-gather" */
    const char *reproduces;     /* "Marques 2013, figs 5-6" */
    const char *summary;        /* one line */
    const char *rows;           /* "scene/map": the form of row names; NULL: all rows are always computed */
    const char *const *columns; /* of the table, NULL-terminated */

    /* Columns with the measured value, the bounds of its 95 % interval, and the published value; each may be
     * NULL. If a value is published, the columns published_over_measured and verdict follow automatically: it
     * agrees if it lies in the interval, or is within `factor` (1.5, ...) of the measured value, or differs.
     */
    const char *measured, *low, *high, *published;
    double factor;

    const report_plot *plots; /* NULL: none */
    const char *takes_no_set; /* why --set adds no row; NULL: it does */
    /* Expected processor seconds of the full form, for the estimate before the run: measured, or extrapolated
     * from the quick form. */
    double seconds, quick_seconds;

    /* Uses the functions below; an error that it returns ends the run. */
    aur_result (*run)(lab_run *run, aur_error *error);

    const lab_parameter *parameters; /* NULL: none */
    void *user;                      /* user data: lab_run_user */
    const char *takes_no_scene;      /* why --scene is rejected if no parameter is named "scene"; NULL: it
                                      * renders no scene */
} lab_experiment;

/* A function to integrate over the domain, as the mean over uniform points. The experiment aureole-integrand
 * compares sets on it. Must be thread-safe. */
typedef struct lab_named_integrand {
    const char *name;
    aur_domain domain; /* SQUARE, CUBE, DISK, HEMISPHERE or SPHERE */
    size_t dimension;  /* for CUBE; else 0 */
    /* Writes the values at `count` points, whose coordinates are consecutive, to values[count]. */
    aur_result (*evaluate)(void *user, size_t count, size_t dimension, const double *points, double *values,
                           aur_error *error);
    void *user;
    double mean; /* over the domain; NaN: estimated by many Sobol' points */
} lab_named_integrand;

/* The contents of a module: a shared library that `aureole lab --module FILE` loads, built by `cc -shared
 * -fPIC mine.c $(pkg-config --cflags aureole-lab) -o mine.so`; it uses functions of the program. Its sets are
 * callback:NAME for --set, its integrands are values of --integrand. */
typedef struct lab_module {
    size_t size;         /* of this struct */
    const char *version; /* LAB_VERSION; must equal the program's */
    size_t experiment_count;
    const lab_experiment *const *experiments;
    size_t set_count;
    const aur_set_callback *sets;
    size_t integrand_count;
    const lab_named_integrand *integrands;
} lab_module;

/* Defined and exported by the module; returns its contents, which must stay valid. */
const lab_module *aureole_lab_module(void);

#define LAB_TEXT_OF(number) #number
#define LAB_TEXT(number) LAB_TEXT_OF(number)
#define LAB_VERSION                                                                                          \
    LAB_TEXT(AUREOLE_VERSION_MAJOR) "." LAB_TEXT(AUREOLE_VERSION_MINOR) "." LAB_TEXT(AUREOLE_VERSION_PATCH)

/* Registers a module's contents in this process; they must outlive all runs. An experiment, set or integrand
 * of the same name is replaced. Errors: UNSUPPORTED for another version, ARGUMENT, MEMORY. */
AUR_EXPERIMENTAL aur_result lab_add(const lab_module *module, aur_error *error);
/* Finds built-in and registered experiments by name; NULL if there is none. */
AUR_EXPERIMENTAL const lab_experiment *lab_find_experiment(const char *name);
AUR_EXPERIMENTAL const lab_named_integrand *lab_find_integrand(const char *name);

typedef struct lab_options {
    bool quick;         /* takes seconds and shows the same with wider intervals */
    const char *set;    /* additional set to compare, or NULL */
    const char *rows;   /* shell pattern of the rows to compute; NULL: all */
    const char *scenes; /* folder of the bundled scenes; NULL: ./scenes, then the source tree's */
    const char *folder; /* existing folder in which each experiment gets a folder of its name */
    size_t parameter_count;
    const aur_definition *parameters; /* of the experiment */
    size_t threads;
    aur_progress progress;
    aur_warnings warnings;
} lab_options;

typedef enum lab_verdict { LAB_AGREES, LAB_WITHIN, LAB_DIFFERS, LAB_UNPUBLISHED, LAB_VERDICTS } lab_verdict;

/* The result of an experiment. */
typedef struct lab_result {
    report_table *table;
    char *notes;                   /* lines; NULL if there are none */
    char *files;                   /* paths of the written files, one per line; or NULL */
    size_t verdicts[LAB_VERDICTS]; /* number of rows with each verdict */
    size_t claims, claims_held;    /* number of the paper's verbal claims, and of those that hold */
    double seconds;                /* processor seconds, including those before interruptions */
} lab_result;

/* Runs the experiment, and writes FOLDER/NAME/: NAME.csv, the further tables, images, and timings.csv, the
 * only file that differs between runs. An interrupted run is resumed, a finished one starts again. The result
 * must be released even after an error: it and the files hold what was finished. */
AUR_EXPERIMENTAL aur_result lab_run_experiment(const lab_experiment *experiment, const lab_options *options,
                                               lab_result *result, aur_error *error);
AUR_EXPERIMENTAL void lab_result_release(lab_result *result);

/* --- for experiments */

/* The options of the run; their folder is the experiment's. */
AUR_EXPERIMENTAL const lab_options *lab_run_options(const lab_run *run);
AUR_EXPERIMENTAL void *lab_run_user(const lab_run *run);
/* The value of a parameter of the experiment, as given or by default: NULL if it has none, or the parameter
 * does not exist. */
AUR_EXPERIMENTAL const char *lab_parameter_text(const lab_run *run, const char *name);
/* The same as a number; NaN if it is not a number. */
AUR_EXPERIMENTAL double lab_parameter_number(const lab_run *run, const char *name);
/* Fills the cells of the table, row by row. */
AUR_EXPERIMENTAL void lab_text(lab_run *run, const char *text); /* NULL: empty, as if nothing is published */
AUR_EXPERIMENTAL void lab_number(lab_run *run, double value);
/* A whole row: texts (NULL after the last), then numbers; NaN leaves a cell empty. */
AUR_EXPERIMENTAL void lab_row(lab_run *run, const char *const *texts, size_t count, const double *numbers);
/* The same for a further table. */
AUR_EXPERIMENTAL void lab_table_row(report_table *table, const char *const *texts, size_t count,
                                    const double *numbers);
/* Whether the row of that name was requested. */
AUR_EXPERIMENTAL bool lab_row_requested(const lab_run *run, const char *name);
AUR_EXPERIMENTAL void lab_note(lab_run *run, const char *format, ...) AUR_PRINTF(2, 3);

/* A verbal claim of the paper, in a note that states whether the measurement confirms it. Confirmed ones are
 * counted. */
AUR_EXPERIMENTAL void lab_claim(lab_run *run, bool holds, const char *format, ...) AUR_PRINTF(3, 4);

/* Adds a table, to be filled by lab_table_row: NAME-<name>.csv, which a plot may name. NULL if out of memory;
 * the run then ends with that error. `columns` is NULL-terminated. */
AUR_EXPERIMENTAL report_table *lab_table(lab_run *run, const char *name, const char *const *columns);

/* Records the processor seconds that `what` took. Times are separate from the tables, which are then
 * identical in every run. */
AUR_EXPERIMENTAL void lab_time(lab_run *run, const char *what, double seconds);

/* Looks up a measurement of an interrupted run. Call it before work that takes more than a second or so:
 *
 *     if (!lab_recall(run, key, 2, values)) {
 *         ... measure values ...
 *         result = lab_save(run, key, 2, values, error);
 *     }
 *
 * `key` describes the numbers in one line, and is used once. Images written before lab_save are preserved
 * too. */
AUR_EXPERIMENTAL bool lab_recall(const lab_run *run, const char *key, size_t count, double *values);
/* Errors: WRITE, MEMORY, CANCELLED. */
AUR_EXPERIMENTAL aur_result lab_save(lab_run *run, const char *key, size_t count, const double *values,
                                     aur_error *error);

/* Lets a measurement of the set of --set fail, for example a file with too few points: adds a note, ends the
 * current row, and returns AUR_OK. Other failures are returned unchanged. */
AUR_EXPERIMENTAL aur_result lab_forgive(lab_run *run, const char *set, aur_result result,
                                        const aur_error *error);

/* --- images */

/* Loads a bundled scene by its path below the scenes folder. */
AUR_EXPERIMENTAL aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                                           const aur_definition *definitions, aur_scene **scene,
                                           aur_error *error);

typedef struct lab_stage {
    aur_scene *scene;
    aur_renderer *renderer; /* NULL: the scene's meshes have not been generated */
} lab_stage;

/* A scene that can be rendered: that of the parameter "scene" if the experiment has one and it is given,
 * without the definitions; published values are then not compared. A scene whose meshes have not been
 * generated leaves no renderer and a note, and returns AUR_OK. The stage must be closed, also after an error.
 */
AUR_EXPERIMENTAL aur_result lab_stage_open(lab_run *run, const char *path, size_t definition_count,
                                           const aur_definition *definitions, lab_stage *stage,
                                           aur_error *error);
AUR_EXPERIMENTAL void lab_stage_close(lab_stage *stage);

typedef struct lab_rendering {
    aur_renderer *renderer;
    const char *integrator; /* NAME:KEYS */
    size_t width, height;
    size_t crop[4]; /* only the pixels of [x0, x1) x [y0, y1); all 0: the whole image */
    size_t samples; /* per pixel; 0: 1 */
    uint64_t seed;
} lab_rendering;

/* Renders with Sobol samples and the box filter. */
AUR_EXPERIMENTAL aur_result lab_render(const lab_run *run, const lab_rendering *how, aur_image **image,
                                       aur_error *error);

/* The mean of (x - a)(x - b) over pixels and channels of images of one size. It is the mean square error of x
 * if a and b are two references with independent errors, which cancel. */
AUR_EXPERIMENTAL double lab_mean_product(const aur_image *x, const aur_image *a, const aur_image *b);

/* An image of the report. Images of one view share a viewer, and are compared with its reference. */
typedef struct lab_image_position {
    const char *view; /* "diffuse"; NULL: a separate view */
    const char *name; /* "sobol" */
    bool reference;
    double exposure; /* initial value, in stops */
} lab_image_position;

/* Writes NAME-<view>-<name>.exr, and a tone-mapped .png. */
AUR_EXPERIMENTAL aur_result lab_image(lab_run *run, const lab_image_position *position,
                                      const aur_image *image, aur_error *error);

/* --- statistics of repeated measurements, with 95 % intervals */

/* The mean of `values` and the half width of its 95 % interval (Student's t); half is 0 for one value. */
AUR_EXPERIMENTAL void lab_mean_interval(size_t count, const double *values, double *mean, double *half);

typedef struct lab_interval {
    double value, low, high;
} lab_interval;

/* The root mean of `squares`, such as mean square errors of independent randomisations. */
AUR_EXPERIMENTAL lab_interval lab_root_mean(size_t count, const double *squares);
/* The root of the ratio of two independent means; the interval includes both errors. 1 without an interval if
 * the base is compared with itself. */
AUR_EXPERIMENTAL lab_interval lab_root_ratio(size_t count, const double *squares, size_t base_count,
                                             const double *base);
/* The same for paired samples of the same `count` randomisations: the interval is that of the linearised
 * ratio. */
AUR_EXPERIMENTAL lab_interval lab_root_ratio_paired(size_t count, const double *squares, const double *base);
/* The slope of log y against log x by least squares; the interval is from the scatter about the line
 * (Student's t), and infinite for fewer than three points. */
AUR_EXPERIMENTAL lab_interval lab_slope(size_t count, const double *x, const double *y);

/* --- the report of results */

/* Writes the page of all results in a folder to `folder`/index.html, and this path to `path`. Print versions
 * of its plots (PDF, SVG and TikZ) are in the same folder, unless it is small; a small page shows large
 * images as means of 2 x 2 pixels, within .8 %. Errors: OPEN if there are no results, FORMAT, WRITE, MEMORY.
 */
AUR_EXPERIMENTAL aur_result lab_publish(const char *results, const char *folder, bool small,
                                        char path[AUR_ERROR_FILE_CAPACITY], aur_error *error);

#ifdef __cplusplus
}
#endif

#endif
