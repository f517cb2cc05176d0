/* Time to quality: CPU seconds of whole processes against the error of the images they write. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "bench.h"
#include "figures.h"

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

/* How many times the samples a path traced image needs to go from an error to the one wanted, by Sobol
 * numbers: the root of the mean square error falls as samples^-.62 on the diffuse boxes. */
double bench_samples_for(double error, double wanted);

/* What the recipes say and our own path tracer beside it, for all subjects. False after
 * bench_fail. */
bool bench_quality(const bench_options *options, bench_figures *figures);
