/* Cost of images to a target error: by recipe, by `--error`, and by Aureole's path tracer. */
#pragma once

#include <stdbool.h>

#include "bench.h"
#include "figures.h"

/* Also measures denoised images where AUREOLE_OIDN names Open Image Denoise, and Mitsuba's where
 * AUREOLE_PEERS_PYTHON names a Python that has it (bench/peers/denoised.py). False after bench_fail. */
bool bench_adaptive_speed(const bench_options *options, bench_figures *figures);
