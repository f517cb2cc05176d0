/* A scene with a reference image: cost of images as whole processes, and their error.
 *
 * The reference is two path-traced images a and b with independent seeds, rendered once and stored next to
 * the program. The mean square error of an image x is estimated by the mean of (x - a)(x - b), which the
 * noise of a and b does not bias: errors far below that noise can be measured. The references are rendered
 * adaptively; each round distributes samples by the variance of earlier ones, so that their mean is unbiased.
 */
#pragma once

#include <aureole-render/image.h>
#include <stdbool.h>
#include <stddef.h>

#include "bench.h"

typedef struct bench_subject {
    const char *name;
    const char *scene;      /* relative to the source tree; "": the heavy box */
    const char *fallback;   /* used if that file is missing; NULL: the subject is skipped */
    const char *definition; /* "name=value" or NULL */
    const char *path;       /* the fastest path tracer settings for this scene, the baseline of comparisons */
    size_t width, height;
    double reference_error; /* relative to the mean, of each of the two images */
    bool relative;          /* errors are divided by the mean of the reference */
} bench_subject;

extern const bench_subject bench_subjects[];
extern const size_t bench_subject_count;

/* The state of one subject. */
typedef struct bench_study {
    const bench_options *options;
    const bench_subject *subject;
    char scene[4400], folder[4000];
    size_t width, height;
    aur_image *references[2];
    double light; /* mean of the reference */
    double mean;  /* the same, or 1: the divisor of errors */
} bench_study;

/* A fixed number of samples with an integrator, or a target error with an automatic choice. */
typedef struct bench_request {
    const char *integrator; /* NULL: the program's choice */
    size_t samples;         /* per pixel, without a target error */
    double error;           /* target, relative to the mean of the image; 0: none */
    bool denoised;
} bench_request;

typedef struct bench_outcome {
    double seconds; /* CPU, one thread: median over the seeds */
    double error;   /* root of the mean square error over the seeds */
    /* Standard error of `error`, from the variation over pixels: rather too large where the error varies
     * within the image. Includes the noise of the reference and the variation over seeds. */
    double standard_error;
} bench_outcome;

/* Finds or generates the scene and its reference, which are tiny in a quick bench. Sets `skipped`, with a
 * message, if its meshes are missing. False after bench_fail. */
bool bench_study_open(bench_study *self, const bench_options *options, const bench_subject *subject,
                      bool *skipped);
void bench_study_close(bench_study *self);

enum { BENCH_STUDY_PATH = 4400 };

/* The file of the reference's first (k = 0) or second image. */
void bench_study_reference_path(const bench_study *self, size_t k, size_t capacity, char *path);

/* Measures seeds 1 .. seeds (at most 8) on one thread, by means of block x block pixels. False after
 * bench_fail. */
bool bench_study_measure(const bench_study *self, const bench_request *request, size_t seeds, size_t block,
                         bench_outcome *found);
