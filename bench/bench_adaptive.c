/* Pictures to an error: whether what is said of the error holds, and what they cost. */
#include "adaptive_calibration.h"
#include "adaptive_speed.h"

static bool run(const bench_options *options) {
    bench_figures figures = {0};
    const bool good =
        bench_adaptive_speed(options, &figures) && bench_adaptive_calibration(options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_adaptive = {"ask", "pictures to an error: what is said of it, and what they cost", run};
