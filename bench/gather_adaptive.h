/* Gain of adaptive gathering: its rays over those of fixed patterns with the same error. */
#pragma once

#include "bench.h"
#include "figures.h"

/* The glossy Cornell box with both criteria. Adds its results; false after bench_fail. */
bool bench_gather_adaptive(const bench_options *options, bench_figures *figures);
