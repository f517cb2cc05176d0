/* The effect of samples that contribute to all pixels within the filter's support: the standard deviation of
 * images over that with the box filter, which shares no samples, and the cost. */
#include <aureole-render/render.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"

enum { RUNS_MOST = 8, SIDE = 64 };

typedef struct film_runs {
    double deviation; /* root mean square over pixels and channels */
    double seconds;   /* CPU seconds */
} film_runs;

static bool render_runs(aur_renderer *renderer, const char *integrator, const char *filter, size_t runs,
                        film_runs *found) {
    static double sums[3 * SIDE * SIDE], squares[3 * SIDE * SIDE];
    for (size_t i = 0; i < 3 * SIDE * SIDE; ++i)
        sums[i] = squares[i] = 0.0;
    const double start = bench_cpu_seconds();
    for (size_t run = 0; run < runs; ++run) {
        const aur_render_options options = {.size = sizeof options,
                                            .integrator = integrator,
                                            .filter = filter,
                                            .samples_per_pixel = 16,
                                            .width = SIDE,
                                            .height = SIDE,
                                            .seed = 100 + run,
                                            .threads = 1};
        aur_image *image = NULL;
        aur_error error = {0};
        if (aur_renderer_render(renderer, &options, &image, NULL, &error) != AUR_OK)
            return bench_fail("%s", error.message);
        const float *const data = aur_image_data(image);
        for (size_t i = 0; i < 3 * SIDE * SIDE; ++i) {
            sums[i] += (double)data[i];
            squares[i] += (double)data[i] * (double)data[i];
        }
        aur_image_destroy(image);
    }
    const double n = (double)runs;
    double variance = 0.0;
    for (size_t i = 0; i < 3 * SIDE * SIDE; ++i)
        variance += fmax(squares[i] - sums[i] * sums[i] / n, 0.0) / fmax(n - 1.0, 1.0) / (3.0 * SIDE * SIDE);
    *found = (film_runs){sqrt(variance), bench_cpu_seconds() - start};
    return true;
}

static bool run(const bench_options *options) {
    static const char *const integrators[] = {"path", "finalgather"};
    static const char *const filters[] = {"box", "gaussian", "tent", "mitchell", "catmullrom", "lanczos"};
    const size_t runs = options->quick ? 2 : RUNS_MOST;
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    aur_error error = {0};
    bool good = aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml", NULL, &scene, &error) ==
                    AUR_OK &&
                aur_renderer_create(scene, &renderer, &error) == AUR_OK;
    if (!good)
        bench_fail("%s", error.message);
    for (size_t i = 0; good && i < sizeof integrators / sizeof integrators[0]; ++i) {
        film_runs box = {0};
        for (size_t f = 0; good && f < sizeof filters / sizeof filters[0]; ++f) {
            film_runs filtered = {0};
            if (f == 0) /* data that renders share, such as a seed's photons, is computed before the timing */
                good = render_runs(renderer, integrators[i], filters[f], runs, &filtered);
            good = good && render_runs(renderer, integrators[i], filters[f], runs, &filtered);
            if (f == 0)
                box = filtered;
            if (good)
                printf("  %-12s %-11s deviation %.5f, over box %.3f; CPU s over box %.2f\n", integrators[i],
                       filters[f], filtered.deviation, filtered.deviation / box.deviation,
                       filtered.seconds / box.seconds);
        }
    }
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    return good;
}

const bench bench_film = {.name = "film",
                          .summary = "noise by reconstruction filters at equal samples, over that of box",
                          .run = run};
