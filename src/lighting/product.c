/* y = F x by rays alone. */
#include <stdlib.h>

#include "core/parallel.h"
#include "lighting/facet_rays.h"
#include "lighting/view_factors.h"

enum { BLOCK = 64 };

typedef struct product {
    const aur_facets *facets;
    const aur_facet_pattern *pattern;
    size_t randomizations;
    const double *x;
    double *y, *sky; /* of patches */
} product;

static aur_result multiply_block(void *context, size_t index) {
    const product *const work = context;
    const aur_facets *const facets = work->facets;
    const size_t count = work->pattern->count;
    uint32_t *const targets = malloc(count * sizeof *targets);
    if (targets == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t i = BLOCK * index; i < facets->patch_count && i < BLOCK * (index + 1); ++i) {
        double sum = 0.0;
        size_t sky = 0;
        for (size_t r = 0; r < work->randomizations && facets->areas[aur_facet_of(facets, i)] > 0.0; ++r) {
            aur_facet_trace(facets, work->pattern, i, r, targets);
            for (size_t k = 0; k < count; ++k) {
                sky += targets[k] == AUR_TARGET_SKY;
                if (targets[k] < facets->patch_count)
                    sum += work->x[aur_facets_row(facets, targets[k])];
            }
        }
        const double rays = (double)(count * work->randomizations);
        work->y[i] = sum / rays;
        work->sky[i] = (double)sky / rays;
    }
    free(targets);
    return AUR_OK;
}

/* The mean over the patches of each row, by area. */
static void gather_rows(const aur_facets *facets, const double *patches, double *rows) {
    for (size_t a = 0; a < facets->row_count; ++a)
        rows[a] = 0.0;
    for (size_t i = 0; i < facets->patch_count; ++i) {
        const size_t row = aur_facets_row(facets, i);
        if (facets->row_areas[row] > 0.0)
            rows[row] += facets->areas[aur_facet_of(facets, i)] / facets->row_areas[row] * patches[i];
    }
}

aur_result aur_view_factors_product(const aur_facets *facets, const aur_view_factors_options *given,
                                    const double *x, double *y, double *sky, aur_error *error) {
    aur_view_factors_options options;
    aur_result result = aur_view_factors_read_options(given, &options, error);
    if (result != AUR_OK)
        return result;
    aur_facet_pattern pattern = {0};
    double *const patches = malloc(2 * facets->patch_count * sizeof *patches);
    result = patches != NULL ? aur_facet_pattern_create(options.set, options.rays / options.randomizations,
                                                        options.seed, &pattern, error)
                             : aur_fail_memory(error);
    if (result == AUR_OK) {
        product work = {facets, &pattern, options.randomizations, x, patches, patches + facets->patch_count};
        const aur_parallel_options parallel = {.threads = options.threads,
                                               .what = "tracing rays",
                                               .progress = options.progress,
                                               .flush_denormals = true};
        result = aur_parallel_for(&parallel, (facets->patch_count + BLOCK - 1) / BLOCK, multiply_block, &work,
                                  error);
    }
    if (result == AUR_OK) {
        gather_rows(facets, patches, y);
        if (sky != NULL)
            gather_rows(facets, patches + facets->patch_count, sky);
    }
    aur_facet_pattern_release(&pattern);
    free(patches);
    return result;
}
