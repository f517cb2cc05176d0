/* Final gathering: its rays against Embree alone, its look-ups, threads and memory, what weights cost, what
 * adaptivity saves, and the CPU seconds of whole processes to a given error. Ends with one table: what is
 * asked, what was measured. */
#include "gather_adaptive.h"
#include "gather_rays.h"
#include "gather_weights.h"
#include "quality.h"

enum { MOST_PAIRS = 7 }; /* a pair takes most of a second here */

static bool run(const bench_options *given) {
    bench_options chosen = *given;
    chosen.pairs = chosen.pairs < MOST_PAIRS ? chosen.pairs : MOST_PAIRS;
    const bench_options *const options = &chosen;
    bench_figures figures = {0};
    /* Memory first: a child's peak is never below this process's own. */
    const bool good = bench_gather_memory(options, &figures) && bench_gather_lookups(options, &figures) &&
                      bench_gather_rays(options, &figures) && bench_gather_weights_cost(given, &figures) &&
                      bench_gather_adaptive(options, &figures) && bench_quality(options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_gather = {"gather", "final gathering: rays, look-ups, memory, time to quality", run};
