/* What pictures to an error cost, by recipe, by `--error`, by our path tracer and by other renderers. */
#pragma once

#include <stdbool.h>

#include "bench.h"
#include "figures.h"

/* Mitsuba is measured too where AUREOLE_PEERS_PYTHON names a Python that has it
 * (bench/peers/time_to_quality.py). False after bench_fail. */
bool bench_ask_speed(const bench_options *options, bench_figures *figures);
