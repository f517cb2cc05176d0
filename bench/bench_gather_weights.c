/* The weights part of the bench `gather` alone. */
#include "gather_weights.h"

static bool run(const bench_options *options) {
    bench_figures figures = {0};
    const bool good = bench_gather_weights_cost(options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_gather_weights = {"gather-weights",
                                    "optimal weights in the final gather against equal ones", run};
