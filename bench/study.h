/* A scene whose true image is known: what images of it cost as whole processes, and how they err.
 *
 * The truth is two path-traced images with independent seeds, a and b, rendered once and kept beside the
 * program. The mean square error of an image x is estimated by the mean of (x - a)(x - b): that has no bias
 * from the noise of a and b, so an error far below their own noise can be told. Their samples are spent pixel
 * by pixel, as those of images to an error are, by what other samples say, so that their mean is that of
 * path tracing. */
#pragma once

#include <aureole-render/image.h>
#include <stdbool.h>
#include <stddef.h>

#include "bench.h"

typedef struct bench_subject {
    const char *name;
    const char *scene;      /* below the source tree; "": the heavy box */
    const char *fallback;   /* where that file is not there; NULL: the subject is skipped */
    const char *definition; /* "name=value" or NULL */
    const char *path;       /* the fastest form of our path tracer there, which others are compared to */
    size_t width, height;
    double reference_error; /* over the mean, of each of the two images */
    bool relative;          /* errors are divided by the mean of the truth */
} bench_subject;

extern const bench_subject bench_subjects[];
extern const size_t bench_subject_count;

/* One subject on its way. */
typedef struct bench_study {
    const bench_options *options;
    const bench_subject *subject;
    char scene[4400], folder[4000];
    size_t width, height;
    aur_image *truth[2];
    double light; /* mean of the truth */
    double mean;  /* the same, or 1: what errors are divided by */
} bench_study;

/* An image: samples of an integrator, or an error over the mean, for which the program chooses. */
typedef struct bench_request {
    const char *integrator; /* NULL: the program's choice */
    size_t samples;         /* a pixel, where no error is asked */
    double error;           /* over the mean of the image; 0: none is asked */
    bool denoised;
} bench_request;

typedef struct bench_outcome {
    double seconds; /* CPU, one thread: median over the seeds */
    double error;   /* root of the mean square error over the seeds */
    /* Standard error of `error`, as the pixels' scatter tells it: rather too large where errors are uneven.
     * The truth's noise is in it, the luck of an image's seed too. */
    double uncertain;
} bench_outcome;

/* Finds or makes the scene and its truth; in a quick bench they are tiny. `skipped` where its meshes are not
 * there, which is said. False after bench_fail. */
bool bench_study_open(bench_study *self, const bench_options *options, const bench_subject *subject,
                      bool *skipped);
void bench_study_close(bench_study *self);

enum { BENCH_STUDY_PATH = 4400 };

/* The file of the truth's first (k = 0) or second image. */
void bench_study_truth_path(const bench_study *self, size_t k, size_t capacity, char *path);

/* Over the seeds 1 .. seeds (at most 8), by one thread, of means of block x block pixels. False after
 * bench_fail. */
bool bench_study_measure(const bench_study *self, const bench_request *request, size_t seeds, size_t block,
                         bench_outcome *found);
