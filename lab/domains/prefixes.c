/* The uniformity of the first n points of a set: their energy times n^(3/4), compared with that of an
 * equilibrium set and of a spiral of that size. */
#include <math.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { LENGTHS = 7, SIZE = 1024 };

static const size_t lengths[LENGTHS] = {100, 150, 200, 300, 400, 600, 1000};

/* A row over all lengths: of the first points of SIZE, or of sets of each length. */
static aur_result row(lab_run *run, const char *set, bool prefix, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const size_t count = options->quick ? 2 : LENGTHS;
    lab_text(run, set);
    lab_text(run, prefix ? "the first n" : "n alone");
    for (size_t k = 0; k < LENGTHS; ++k) {
        if (k >= count) {
            lab_text(run, NULL);
            continue;
        }
        const size_t size = options->quick ? SIZE / 4 : SIZE;
        const lab_points points = {
            .set = set, .domain = AUR_DOMAIN_SPHERE, .size = prefix ? size : lengths[k], .count = lengths[k]};
        double energy;
        const aur_result result = lab_figure(&points, "energy", options->threads, &energy, error);
        if (result != AUR_OK)
            return result;
        lab_number(run, energy * pow((double)lengths[k], 0.75));
    }
    return AUR_OK;
}

static const char *const columns[] = {"set", "points", "100", "150",  "200",
                                      "300", "400",    "600", "1000", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    const char *const sets[] = {"electrostatic", "r2",           "halton",
                                "sobol",         "esfg:base=16", lab_run_options(run)->set};
    aur_result result = row(run, "electrostatic", false, error);
    if (result == AUR_OK)
        result = row(run, "spherical-fibonacci", false, error);
    for (size_t s = 0; s < sizeof sets / sizeof sets[0] && sets[s] != NULL && result == AUR_OK; ++s)
        result = lab_forgive(run, sets[s], row(run, sets[s], true, error), error);
    return result;
}

const lab_experiment lab_domains_prefixes = {
    .name = "domains-prefixes",
    .reproduces = "docs/domains.md",
    .summary = "the energy of the first n of 1024 points of the sphere, times n^(3/4)",
    .columns = columns,
    .seconds = 29,
    .quick_seconds = 6,
    .run = run,
};
