/* The parts of `aureole-bench gather` that run in one process: rays, look-ups, threads and memory. Each adds
 * its results; false after bench_fail. */
#pragma once

#include "bench.h"
#include "figures.h"

/* The integrator's rays against Embree alone on the same packets and on single rays, and CPU time per ray on
 * all threads against one: flat walls, bumpy spheres, 1.5 million triangles. */
bool bench_gather_rays(const bench_options *options, bench_figures *figures);
/* The irradiance look-up with its texels in cache and not in cache. */
bool bench_gather_lookups(const bench_options *options, bench_figures *figures);
/* Peak memory per photon. */
bool bench_gather_memory(const bench_options *options, bench_figures *figures);
