/* y = F x by rays, without a matrix. */
#include <stdlib.h>

#include "lighting/viewfactors/facet_rays.h"
#include "lighting/viewfactors/view_factors.h"

enum { BLOCK = 64 };

typedef struct product {
    const aur_facets *facets;
    const aur_facet_pattern *pattern;
    size_t first, randomizations;
    const double *sun, *x;
    double *y, *sky; /* per patch */
} product;

/* The irradiance of a patch by parallel light: the fraction of its ray origins that see the source. */
static double sunlight(const product *work, size_t patch, uint32_t *targets) {
    const aur_plane plane = aur_patch_plane(work->facets, patch);
    const double facing = aur_dot3(plane.normal, work->sun);
    double along[3] = {work->sun[0], work->sun[1], work->sun[2]};
    aur_normalize3(along);
    size_t lit = 0;
    for (size_t r = 0; facing > 0.0 && r < work->randomizations; ++r) {
        aur_facet_trace(work->facets, work->pattern, patch, work->first + r, along, targets);
        for (size_t k = 0; k < work->pattern->count; ++k)
            lit += targets[k] == AUR_TARGET_SKY;
    }
    return facing * (double)lit / (double)(work->pattern->count * work->randomizations);
}

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
        const bool empty = facets->areas[aur_facet_of(facets, i)] == 0.0;
        for (size_t r = 0; r < work->randomizations && !empty && work->sun == NULL; ++r) {
            aur_facet_trace(facets, work->pattern, i, work->first + r, NULL, targets);
            for (size_t k = 0; k < count; ++k) {
                sky += targets[k] == AUR_TARGET_SKY;
                if (targets[k] < facets->patch_count)
                    sum += work->x[aur_facets_row(facets, targets[k])];
            }
        }
        const double rays = (double)(count * work->randomizations);
        work->y[i] = work->sun != NULL && !empty ? sunlight(work, i, targets) : sum / rays;
        work->sky[i] = (double)sky / rays;
    }
    free(targets);
    return AUR_OK;
}

/* The area-weighted mean over the patches of each row. */
static void gather_rows(const aur_facets *facets, const double *patches, double *rows) {
    for (size_t a = 0; a < facets->row_count; ++a)
        rows[a] = 0.0;
    for (size_t i = 0; i < facets->patch_count; ++i) {
        const size_t row = aur_facets_row(facets, i);
        if (facets->row_areas[row] > 0.0)
            rows[row] += facets->areas[aur_facet_of(facets, i)] / facets->row_areas[row] * patches[i];
    }
}

aur_result aur_facet_product(const aur_facets *facets, const aur_facet_pattern *pattern, size_t first,
                             size_t count, const aur_parallel_options *parallel, const double *sun,
                             const double *x, double *y, double *sky, aur_error *error) {
    double *const patches = malloc(2 * facets->patch_count * sizeof *patches);
    if (patches == NULL)
        return aur_fail_memory(error);
    product work = {facets, pattern, first, count, sun, x, patches, patches + facets->patch_count};
    aur_parallel_options options = *parallel;
    options.what = "tracing rays";
    options.flush_denormals = true;
    const aur_result result =
        aur_parallel_for(&options, (facets->patch_count + BLOCK - 1) / BLOCK, multiply_block, &work, error);
    if (result == AUR_OK) {
        gather_rows(facets, patches, y);
        if (sky != NULL)
            gather_rows(facets, patches + facets->patch_count, sky);
    }
    free(patches);
    return result;
}
