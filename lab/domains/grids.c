/* Sets of rotations that double and preserve their points, compared with a super-Fibonacci spiral of each
 * size. */
#include "program/lab/lab.h"
#include "program/lab/points.h"

static const char *const columns[] = {"set",           "rotations", "energy", "energy_over", "min_angle_over",
                                      "covering_over", NULL};

static aur_result row(lab_run *run, const char *set, size_t count, aur_error *error) {
    static const char *const metrics[] = {"energy", "min-angle", "covering"};
    const lab_options *const options = lab_run_options(run);
    const lab_points grid = {.set = set, .domain = AUR_DOMAIN_ROTATIONS, .size = count};
    const lab_points spiral = {.set = "super-fibonacci", .domain = AUR_DOMAIN_ROTATIONS, .size = count};
    lab_text(run, set);
    lab_number(run, (double)count);
    for (size_t m = 0; m < 3; ++m) {
        double value = 0.0, other = 1.0;
        aur_result result = lab_figure(&grid, metrics[m], options->threads, &value, error);
        if (result == AUR_OK)
            result = lab_figure(&spiral, metrics[m], options->threads, &other, error);
        if (result != AUR_OK)
            return result;
        if (m == 0)
            lab_number(run, value);
        lab_number(run, value / other);
    }
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const size_t last = lab_run_options(run)->quick ? 500 : 8000;
    const char *const sets[] = {"super-fibonacci-grid:base=125", lab_run_options(run)->set};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < 2 && sets[i] != NULL; ++i)
        for (size_t count = 250; count <= last && result == AUR_OK; count *= 2)
            result = lab_forgive(run, sets[i], row(run, sets[i], count, error), error);
    return result;
}

const lab_experiment lab_domains_grids = {
    .name = "domains-grids",
    .reproduces = "docs/domains.md",
    .summary = "a grid of rotations that doubles, over a super-Fibonacci spiral of each size",
    .columns = columns,
    .seconds = 0.7,
    .quick_seconds = 0.1,
    .run = run,
};
