/* What images to an error cost, by recipe, by `--error`, by our path tracer and by other renderers. */
#pragma once

#include <stdbool.h>

#include "bench.h"
#include "figures.h"

/* Where AUREOLE_PEERS_PYTHON names a Python that has Mitsuba (bench/peers/time_to_quality.py), that is
 * measured too, and where AUREOLE_OIDN names Open Image Denoise, what images err when they are denoised.
 * False after bench_fail. */
bool bench_adaptive_speed(const bench_options *options, bench_figures *figures);
