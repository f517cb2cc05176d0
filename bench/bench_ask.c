/* Pictures to an error: whether what is said of the error holds, and what they cost. */
#include "ask_calibration.h"
#include "ask_speed.h"

static bool run(const bench_options *options) {
    bench_figures figures = {0};
    const bool good = bench_ask_speed(options, &figures) && bench_ask_calibration(options, &figures);
    if (good)
        bench_figures_print(&figures);
    return good;
}

const bench bench_ask = {"ask", "pictures to an error: what is said of it, and what they cost", run};
