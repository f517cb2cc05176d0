/* What adaptive gathering saves: its rays over those of fixed patterns that reach the same error. */
#pragma once

#include "bench.h"
#include "figures.h"

/* The glossy Cornell box by both criteria. Adds its figures; false after bench_fail. */
bool bench_gather_adaptive(const bench_options *options, bench_figures *figures);
