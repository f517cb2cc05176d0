/* What optimal weights cost in an image (Marques 2018, section 6: 7m40s against 7m36s). */
#pragma once

#include "bench.h"
#include "figures.h"

/* The final gather of the glossy Cornell box, all preparation apart, by each kind of weights against equal
 * ones. Adds its figures; false after bench_fail. */
bool bench_gather_weights_cost(const bench_options *options, bench_figures *figures);
