/* Time to quality: CPU seconds of whole processes against the error of the images they write. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "bench.h"
#include "figures.h"

/* Hand-tuned parameters for one subject and error (recipes.c). */
typedef struct bench_recipe {
    const char *subject;
    double error;    /* target error */
    double required; /* target CPU seconds; 0: no target; below 0: the target is the error, at any time */
    size_t samples;  /* per pixel */
    const char *integrator;
} bench_recipe;

extern const bench_recipe bench_recipes[];
extern const size_t bench_recipe_count;

/* The factor on the samples of a path-traced image to get from `error` to `target` with Sobol' points: the
 * root mean square error falls as samples^-.62 on the diffuse boxes. */
double bench_samples_for(double error, double target);

/* Runs the recipes and, next to them, Aureole's path tracer for all subjects. False after bench_fail. */
bool bench_quality(const bench_options *options, bench_figures *figures);
