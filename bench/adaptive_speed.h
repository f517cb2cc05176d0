/* Cost of images to a target error: by recipe, by `--error`, by Aureole's path tracer and by other renderers.
 */
#pragma once

#include <stdbool.h>

#include "bench.h"
#include "figures.h"

/* Also runs Mitsuba where AUREOLE_PEERS_PYTHON names a Python that has it (bench/peers/time_to_quality.py),
 * and measures denoised images where AUREOLE_OIDN names Open Image Denoise. False after bench_fail. */
bool bench_adaptive_speed(const bench_options *options, bench_figures *figures);
