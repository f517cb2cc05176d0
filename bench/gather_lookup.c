/* The irradiance map alone: cost of a look-up, and memory per photon. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "child.h"
#include "gather_rays.h"
#include "render/photons/irradiance.h"

enum { PHOTONS = 500000, QUICK_PHOTONS = 2000, WARM_QUERIES = 4096, CAPACITY = 64 };

typedef struct query {
    uint32_t element;
    float u, v;
    uint32_t behind;
} query;

typedef struct lookups {
    const aur_irradiance_map *map;
    size_t count;
    query *queries;
} lookups;

/* Queries with elements in proportion to their texels, so that all texels are reached equally often. False
 * when out of memory. */
static bool make_queries(const aur_irradiance_map *map, size_t count, query *queries) {
    const aur_texels *const texels = &map->texels;
    const size_t elements = texels->elements.count;
    uint64_t *const up_to = malloc((elements + 1) * sizeof *up_to);
    if (up_to == NULL)
        return false;
    up_to[0] = 0;
    for (size_t i = 0; i < elements; ++i)
        up_to[i + 1] = up_to[i] + (uint64_t)texels->ranges[i].side * texels->ranges[i].side;
    for (size_t i = 0; i < count; ++i) {
        const uint64_t texel = aur_hash2(i, 0) % up_to[elements];
        size_t low = 0, high = elements;
        while (high - low > 1) {
            const size_t middle = low + (high - low) / 2;
            if (up_to[middle] <= texel)
                low = middle;
            else
                high = middle;
        }
        float u = aur_unit_float((uint32_t)aur_hash2(i, 1)), v = aur_unit_float((uint32_t)aur_hash2(i, 2));
        if (u + v > 1.0f) {
            u = 1.0f - u;
            v = 1.0f - v;
        }
        queries[i] = (query){(uint32_t)low, u, v, (uint32_t)(aur_hash2(i, 3) & 1)};
    }
    free(up_to);
    return true;
}

static void look_up(void *data) {
    const lookups *const self = data;
    aur_vector sum = {0};
    for (size_t i = 0; i < self->count; ++i) {
        const query *const q = &self->queries[i];
        const aur_texel_light *const light =
            aur_irradiance_on_triangle(self->map, q->element, q->u, q->v, q->behind != 0);
        sum = aur_vector_add(sum, light->irradiance);
    }
    bench_keep((double)(sum.x + sum.y + sum.z));
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Nanoseconds of a look-up after other memory has replaced the map in all caches. */
static double cold_nanoseconds(const bench_options *options, lookups *work) {
    const size_t size = options->quick ? (size_t)1 << 20 : (size_t)128 << 20;
    char *const other = malloc(size);
    double times[CAPACITY];
    const size_t rounds = options->pairs < CAPACITY ? options->pairs : CAPACITY;
    for (size_t k = 0; k < rounds && other != NULL; ++k) {
        memset(other, (int)k, size);
        bench_keep((double)other[size / 2]);
        const double start = bench_cpu_seconds();
        look_up(work);
        times[k] = 1e9 * (bench_cpu_seconds() - start) / (double)work->count;
    }
    free(other);
    qsort(times, rounds, sizeof *times, ascending);
    return other != NULL ? times[rounds / 2] : (double)NAN;
}

static bool measure(const bench_options *options, const aur_irradiance_map *map, bench_figures *figures) {
    /* Cold: about one look-up per texel, so that cache lines are rarely reused. */
    lookups warm = {.map = map, .count = WARM_QUERIES};
    lookups cold = {.map = map, .count = map->texels.count};
    const size_t most = warm.count > cold.count ? warm.count : cold.count;
    warm.queries = cold.queries = malloc(most * sizeof *warm.queries);
    if (warm.queries == NULL || !make_queries(map, most, warm.queries)) {
        free(warm.queries);
        return bench_fail("out of memory");
    }
    const bench_work work = {look_up, &warm, (double)warm.count};
    const double rate = bench_rate(options, &work);
    bench_print_rate("look-ups, warm", "Mlookup", 1e6, rate);
    bench_figures_add(figures, BENCH_AT_MOST, 8.0, 1e9 / rate, "ns", "2. look-up, warm, %zu photons",
                      map->photons);
    const double nanoseconds = cold_nanoseconds(options, &cold);
    bench_print_rate("look-ups, cold", "Mlookup", 1e6, 1e9 / nanoseconds);
    bench_figures_add(figures, BENCH_AT_MOST, 30.0, nanoseconds, "ns", "2. look-up, cold, %zu texels",
                      map->texels.count);
    free(warm.queries);
    return true;
}

bool bench_gather_lookups(const bench_options *options, bench_figures *figures) {
    aur_error error;
    aur_scene *scene = NULL;
    if (aur_scene_load(AUR_SOURCE_DIR "/scenes/cornell-box/glossy.xml", NULL, &scene, &error) != AUR_OK)
        return bench_fail("%s: %s", error.file, error.message);
    const aur_irradiance_map_options map_options = {
        .photons = {.count = options->quick ? QUICK_PHOTONS : PHOTONS,
                    .max_edges = SIZE_MAX,
                    .seed = 1,
                    .threads = 1},
        .photons_a_texel = 16.0};
    aur_irradiance_map *map = NULL;
    bool good = aur_irradiance_map_create(scene, &map_options, &map, &error) == AUR_OK ||
                bench_fail("%s", error.message);
    good = good && measure(options, map, figures);
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
    return good;
}

/* Peak memory of a whole process, with many photons and with few. */
bool bench_gather_memory(const bench_options *options, bench_figures *figures) {
    const size_t counts[2] = {options->quick ? 20000 : 500000, options->quick ? 100000 : 2500000};
    static const char *const scenes[] = {"cornell-box", "glossy"};
    char folder[4000], image_path[4096];
    if (!bench_data_folder(folder, sizeof folder))
        return false;
    snprintf(image_path, sizeof image_path, "%s/memory-%ld.pfm", folder, (long)getpid());
    for (size_t k = 0; k < 2; ++k) {
        double peaks[2];
        for (size_t i = 0; i < 2; ++i) {
            char scene[4096], integrator[96];
            snprintf(scene, sizeof scene, "%s/scenes/cornell-box/%s.xml", AUR_SOURCE_DIR, scenes[k]);
            snprintf(integrator, sizeof integrator, "finalgather:photons=%zu", counts[i]);
            const char *const words[] = {"render",   scene, "-q", "--integrator", integrator, "--spp",   "1",
                                         "-t",       "1",   "-D", "resx=16",      "-D",       "resy=16", "-o",
                                         image_path, NULL};
            bench_child_cost cost;
            if (!bench_run_child(words, &cost))
                return false;
            unlink(image_path);
            peaks[i] = cost.peak_bytes;
        }
        const double bytes = (peaks[1] - peaks[0]) / (double)(counts[1] - counts[0]);
        printf("  %-36s %9.4g bytes per photon\n", scenes[k], bytes);
        bench_figures_add(figures, BENCH_AT_MOST, 100.0, bytes, "bytes", "8. memory a photon at the peak, %s",
                          scenes[k]);
    }
    return true;
}
