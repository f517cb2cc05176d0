/* What `aureole-bench gather` measures inside one process: rays, look-ups, threads and memory. Each adds its
 * figures; false after bench_fail. */
#pragma once

#include "bench.h"
#include "figures.h"

/* The integrator's rays against Embree alone on the same packets, against single rays, and the CPU time of a
 * ray on all threads against one: flat walls, bumpy spheres, 1.5 million triangles. */
bool bench_gather_rays(const bench_options *options, bench_figures *figures);
/* The irradiance look-up, with its texels in cache and out of it. */
bool bench_gather_lookups(const bench_options *options, bench_figures *figures);
/* What a photon costs in memory at the peak. */
bool bench_gather_memory(const bench_options *options, bench_figures *figures);
