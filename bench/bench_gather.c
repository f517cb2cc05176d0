/* Final gathering: rays against Embree alone, look-ups, threads, memory, the cost of weights, the gain of
 * adaptivity, and CPU seconds of whole processes to a given error. Prints a table of targets and
 * measurements. */
#include "gather_adaptive.h"
#include "gather_rays.h"
#include "gather_weights.h"
#include "quality.h"

enum { MOST_PAIRS = 7 }; /* a pair takes about a second */

static bool run(const bench_options *given) {
    bench_options chosen = *given;
    chosen.pairs = chosen.pairs < MOST_PAIRS ? chosen.pairs : MOST_PAIRS;
    const bench_options *const options = &chosen;
    bench_figures figures = {0};
    /* Memory first: a child process reports at least the peak memory of this process. */
    const bool good = bench_gather_memory(options, &figures) && bench_gather_lookups(options, &figures) &&
                      bench_gather_rays(options, &figures) && bench_gather_weights_cost(given, &figures) &&
                      bench_gather_adaptive(options, &figures) && bench_quality(options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_gather = {"gather", "final gathering: rays, look-ups, memory, time to quality", run};
