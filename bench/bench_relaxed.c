/* CPU seconds of point sets that are computed by iteration: blue noise, and axes that repel each other. */
#include <aureole/sphere.h>
#include <stdlib.h>

#include "bench.h"

typedef struct relaxed_context {
    const char *set;
    aur_domain domain;
    size_t count;
    bool failed;
} relaxed_context;

static void relax(void *data) {
    relaxed_context *const context = data;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(context->count, context->domain, &options, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    request.dimension = context->domain == AUR_DOMAIN_SQUARE ? 2 : 0;
    aur_points *points = NULL;
    if (aur_points_generate(context->set, &request, &points, NULL) == AUR_OK) {
        bench_keep(aur_points_get_view(points)->coordinates[0]);
        aur_points_destroy(points);
    } else
        context->failed = true;
}

static bool run_row(const bench_options *options, const char *names[2], relaxed_context context,
                    const size_t counts[2]) {
    for (size_t i = 0; i < 2; ++i) {
        context.count = options->quick ? (size_t)16 << i : counts[i];
        const bench_work work = {relax, &context, 1.0};
        bench_print_seconds(options, names[i], &work);
    }
    return !context.failed || bench_fail("%s cannot be made", context.set);
}

static bool run(const bench_options *options) {
    if (setenv("AUREOLE_CACHE", "", 1) != 0) /* otherwise the second run reads them from the cache */
        return bench_fail("out of memory");
    const size_t square[] = {4096, 65536}, axes[] = {60, 256};
    return run_row(options, (const char *[]){"blue-noise, 4096", "blue-noise, 65536"},
                   (relaxed_context){"blue-noise", AUR_DOMAIN_SQUARE, 0, false}, square) &&
           run_row(options, (const char *[]){"bnot, 4096", "bnot, 65536"},
                   (relaxed_context){"bnot", AUR_DOMAIN_SQUARE, 0, false}, square) &&
           run_row(options, (const char *[]){"electrostatic axes, 60", "electrostatic axes, 256"},
                   (relaxed_context){"electrostatic", AUR_DOMAIN_AXES, 0, false}, axes);
}

const bench bench_relaxed = {"relaxed", "CPU seconds of blue noise and of axes that repel each other", run};
