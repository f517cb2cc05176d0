/* Axes in an order with uniform prefixes, and in shells: the energy relative to that of an equilibrium set of
 * as many axes. */
#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { ALL = 60, QUICK = 12 };

static aur_result row(lab_run *run, const lab_points *points, aur_error *error) {
    const size_t count = points->count != 0 ? points->count : points->size;
    const lab_points rest = {.set = "electrostatic", .domain = AUR_DOMAIN_AXES, .size = count};
    const size_t threads = lab_run_options(run)->threads;
    double energy, least;
    aur_result result = lab_figure(points, "riesz:1", threads, &energy, error);
    if (result == AUR_OK)
        result = lab_figure(&rest, "riesz:1", threads, &least, error);
    if (result != AUR_OK)
        return result;
    lab_text(run, points->set);
    lab_number(run, (double)points->size);
    lab_number(run, (double)(points->first + 1));
    lab_number(run, (double)count);
    lab_number(run, 100.0 * (energy / least - 1.0));
    return AUR_OK;
}

static const char *const columns[] = {"set", "of", "first", "axes", "percent_more", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    const size_t all = quick ? QUICK : ALL, third = all / 3;
    const char *const shells = quick ? "electrostatic:shells=4/8" : "electrostatic:shells=20/40";
    const aur_domain axes = AUR_DOMAIN_AXES;
    const lab_points rows[] = {
        {"electrostatic", axes, all, 0, all / 10, AUR_MAP_LAMBERT},
        {"electrostatic", axes, all, 0, all / 4, AUR_MAP_LAMBERT},
        {"electrostatic", axes, all, 0, all / 2, AUR_MAP_LAMBERT},
        {"electrostatic", axes, all, 0, all * 5 / 6, AUR_MAP_LAMBERT},
        {"sobol", axes, all, 0, all / 4, AUR_MAP_LAMBERT},
        {shells, axes, all, 0, 0, AUR_MAP_LAMBERT},
        {shells, axes, all, 0, third, AUR_MAP_LAMBERT},
        {shells, axes, all, third, all - third, AUR_MAP_LAMBERT},
    };
    aur_result result = AUR_OK;
    for (size_t i = quick; i < sizeof rows / sizeof rows[0] && result == AUR_OK;
         ++i) /* one axis has no pair */
        result = row(run, &rows[i], error);
    return result;
}

const lab_experiment lab_domains_axes = {
    .name = "domains-axes",
    .reproduces = "docs/domains.md",
    .summary = "prefixes and shells of 60 axes: energy over that of as many axes at rest",
    .columns = columns,
    .takes_no_set = "the table is of prefixes and shells of axes, which few sets have",
    .seconds = 1,
    .quick_seconds = 0.1,
    .run = run,
};
