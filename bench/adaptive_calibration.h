/* How often what a picture to an error says of its error holds: small pictures of the bundled scenes and of
 * Veach's, many seeds each, against long path-traced ones. */
#pragma once

#include <stdbool.h>

#include "bench.h"
#include "figures.h"

/* False after bench_fail. */
bool bench_adaptive_calibration(const bench_options *options, bench_figures *figures);
