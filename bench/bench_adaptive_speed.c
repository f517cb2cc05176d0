/* Cost of images to a target error. */
#include "adaptive_speed.h"

static bool run(const bench_options *options) {
    bench_figures figures = {0};
    const bool good = bench_adaptive_speed(options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_adaptive_speed_alone = {"adaptive-speed",
                                          "what images to a target error cost, next to path tracing", run};
