/* The ray comparison of `gather` alone. */
#include "gather_rays.h"

enum { MOST_PAIRS = 7 }; /* a pair takes about a second */

static bool run(const bench_options *given) {
    bench_options options = *given;
    options.pairs = options.pairs < MOST_PAIRS ? options.pairs : MOST_PAIRS;
    bench_figures figures = {0};
    const bool good = bench_gather_rays(&options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_gather_rays_alone = {"gather-rays",
                                       "final gathering: rays against bare Embree and single rays", run};
