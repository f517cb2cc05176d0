/* The uniformity of the first n points of a sequence for every n: the energy times n^(3/4), maximum and mean.
 */
#include <math.h>
#include <stdlib.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { FIRST = 16, LAST = 2048, QUICK = 128 };

/* An upper bound for all prefixes of greedy points. */
static const double promised = 1.12;

typedef struct prefix_figures {
    double worst, mean;
    size_t worst_at;
} prefix_figures;

/* Sums of distances grow with the prefix, so all prefixes together take as long as the last one. */
static prefix_figures measure(const aur_points_view *points) {
    prefix_figures found = {0};
    double pairs = 0.0;
    for (size_t n = 1; n <= points->count; ++n) {
        const double *const x = points->coordinates + points->stride * (n - 1);
        for (size_t i = 0; i + 1 < n; ++i) {
            const double *const y = points->coordinates + points->stride * i;
            pairs += sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) +
                          (x[2] - y[2]) * (x[2] - y[2]));
        }
        if (n < FIRST)
            continue;
        const double count = (double)n;
        const double figure = sqrt(fmax(0.0, 4.0 / 3.0 - 2.0 * pairs / (count * count))) * pow(count, 0.75);
        found.mean += figure / (double)(points->count - FIRST + 1);
        if (figure > found.worst) {
            found.worst = figure;
            found.worst_at = n;
        }
    }
    return found;
}

static aur_result row(lab_run *run, const char *set, bool judged, aur_error *error) {
    const size_t count = lab_run_options(run)->quick ? QUICK : LAST;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    aur_points *points;
    const aur_result result = aur_points_generate(set, &request, &points, error);
    if (result != AUR_OK)
        return result;
    const prefix_figures found = measure(aur_points_get_view(points));
    aur_points_destroy(points);
    lab_text(run, set);
    lab_number(run, FIRST);
    lab_number(run, (double)count);
    lab_number(run, found.worst);
    lab_number(run, (double)found.worst_at);
    lab_number(run, found.mean);
    if (judged)
        lab_note(run, "%s: no prefix above %.2f: %s", set, promised,
                 found.worst <= promised ? "holds" : "does not hold");
    return AUR_OK;
}

static const char *const columns[] = {"set", "from", "to", "worst", "worst_at", "mean", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    const char *const sets[] = {"greedy", "r2", "halton", "sobol", "esfg:base=16", lab_run_options(run)->set};
    aur_result result = AUR_OK;
    for (size_t s = 0; s < sizeof sets / sizeof sets[0] && sets[s] != NULL && result == AUR_OK; ++s)
        result = lab_forgive(run, sets[s], row(run, sets[s], s == 0, error), error);
    return result;
}

const lab_experiment lab_domains_every_number = {
    .name = "domains-every-number",
    .reproduces = "docs/domains.md",
    .summary =
        "the worst and the mean energy of all first n points of sequences of the sphere, times n^(3/4)",
    .columns = columns,
    .seconds = 0.2,
    .quick_seconds = 0.1,
    .run = run,
};
