/* Cost of optimal weights in an image (Marques 2018, section 6: 7m40s against 7m36s). */
#pragma once

#include "bench.h"
#include "figures.h"

/* Final gathering of the glossy Cornell box without preparation, with each kind of weights against equal
 * weights. Adds its results; false after bench_fail. */
bool bench_gather_weights_cost(const bench_options *options, bench_figures *figures);
