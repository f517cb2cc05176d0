/* Rotations that double and keep their points, beside a super-Fibonacci spiral of each size. */
#include "figures.h"
#include "lab/lab.h"

static const char *const columns[] = {"rotations", "energy", "energy_over", "min_angle_over",
                                      "covering_over"};

static aur_result row(lab_run *run, size_t count, aur_error *error) {
    static const char *const metrics[] = {"energy", "min-angle", "covering"};
    const lab_options *const options = lab_run_options(run);
    const char *const set = options->set != NULL ? options->set : "super-fibonacci-grid:base=125";
    const lab_points grid = {.set = set, .domain = AUR_DOMAIN_ROTATIONS, .size = count};
    const lab_points spiral = {.set = "super-fibonacci", .domain = AUR_DOMAIN_ROTATIONS, .size = count};
    lab_number(run, (double)count);
    for (size_t m = 0; m < 3; ++m) {
        double own = 0.0, other = 1.0;
        aur_result result = lab_figure(&grid, metrics[m], options->threads, &own, error);
        if (result == AUR_OK)
            result = lab_figure(&spiral, metrics[m], options->threads, &other, error);
        if (result != AUR_OK)
            return result;
        if (m == 0)
            lab_number(run, own);
        lab_number(run, own / other);
    }
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    lab_columns(run, sizeof columns / sizeof columns[0], columns);
    const size_t last = lab_run_options(run)->quick ? 500 : 8000;
    aur_result result = AUR_OK;
    for (size_t count = 250; count <= last && result == AUR_OK; count *= 2)
        result = row(run, count, error);
    return result;
}

const lab_experiment lab_domains_grids = {
    .name = "domains-grids",
    .reproduces = "docs/domains.md",
    .summary = "a grid of rotations that doubles, over a super-Fibonacci spiral of each size",
    .run = run,
};
