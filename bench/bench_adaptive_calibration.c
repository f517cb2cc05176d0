/* The second part of the bench `ask`, alone. */
#include "adaptive_calibration.h"

static bool run(const bench_options *options) {
    bench_figures figures = {0};
    const bool good = bench_adaptive_calibration(options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_adaptive_calibration_alone = {"ask-calibration",
                                                "how often what is said of pictures to an error holds", run};
