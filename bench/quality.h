/* Time to quality: CPU seconds of whole processes against the error of the pictures they write.
 *
 * The truth is two path-traced pictures with independent seeds, a and b, rendered once and kept beside the
 * program. The mean square error of a picture x is estimated by the mean of (x - a)(x - b): that has no bias
 * from the noise of a and b, so an error far below their own noise can be told. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "bench.h"
#include "figures.h"

typedef struct bench_subject {
    const char *name;
    const char *scene;      /* below the source tree; "": the heavy box */
    const char *fallback;   /* where that file is not there; NULL: the subject is skipped */
    const char *definition; /* "name=value" or NULL */
    const char *path;       /* the fastest form of our path tracer there, which gathering is compared to */
    size_t width, height;
    size_t reference_samples; /* a pixel, of each of the two pictures */
    bool relative;            /* errors are divided by the mean of the truth */
} bench_subject;

/* Parameters found by hand for one subject and error (recipes.c). */
typedef struct bench_recipe {
    const char *subject;
    double error;   /* that it is to reach */
    double asked;   /* CPU seconds; 0: only noted; below 0: the error itself is asked, whatever the time */
    size_t samples; /* a pixel */
    const char *integrator;
} bench_recipe;

extern const bench_recipe bench_recipes[];
extern const size_t bench_recipe_count;

/* Final gathering by the recipes and our own path tracer beside it, for all subjects. False after
 * bench_fail. */
bool bench_quality(const bench_options *options, bench_figures *figures);
