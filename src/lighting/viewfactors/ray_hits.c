#include "lighting/viewfactors/closed_pairs.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 64 };

typedef struct tracing {
    const aur_facets *facets;
    const aur_facet_pattern *pattern;
    aur_ray_hits *ray_hits;
} tracing;

/* Buffers for a block of patches. `slots` maps a patch to its index in `met`, counted from 1. */
typedef struct scratch {
    uint32_t *targets, *slots, *met;
    uint16_t *hits;
    size_t met_count;
} scratch;

static int compare_numbers(const void *left, const void *right) {
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

static void count_targets(const tracing *work, scratch *s, size_t patch, size_t randomization) {
    aur_ray_hits *const ray_hits = work->ray_hits;
    const size_t width = ray_hits->randomizations;
    for (size_t i = 0; i < work->pattern->count; ++i) {
        const uint32_t target = s->targets[i];
        if (target == AUR_TARGET_SKY) {
            ++ray_hits->sky[width * patch + randomization];
        } else if (target == AUR_TARGET_BACK) {
            ++ray_hits->back[width * patch + randomization];
        } else {
            if (s->slots[target] == 0) {
                memset(&s->hits[width * s->met_count], 0, width * sizeof *s->hits);
                s->met[s->met_count++] = target;
                s->slots[target] = (uint32_t)s->met_count;
            }
            ++s->hits[width * (s->slots[target] - 1) + randomization];
        }
    }
}

/* Stores the hits in order, and resets the scratch for the next patch. */
static bool store_row(const tracing *work, scratch *s, size_t patch) {
    const size_t width = work->ray_hits->randomizations;
    aur_ray_hits_row *const row = &work->ray_hits->rows[patch];
    row->count = s->met_count;
    row->patches = malloc((s->met_count + 1) * sizeof *row->patches);
    row->hits = malloc((s->met_count + 1) * width * sizeof *row->hits);
    const bool good = row->patches != NULL && row->hits != NULL;
    qsort(s->met, s->met_count, sizeof *s->met, compare_numbers);
    for (size_t i = 0; i < s->met_count; ++i) {
        if (good) {
            row->patches[i] = s->met[i];
            memcpy(&row->hits[width * i], &s->hits[width * (s->slots[s->met[i]] - 1)],
                   width * sizeof *row->hits);
        }
        s->slots[s->met[i]] = 0;
    }
    s->met_count = 0;
    return good;
}

static aur_result trace_block(void *context, size_t index) {
    const tracing *const work = context;
    const aur_ray_hits *const ray_hits = work->ray_hits;
    const size_t most = work->pattern->count * ray_hits->randomizations; /* different targets */
    scratch s = {.targets = malloc(work->pattern->count * sizeof *s.targets),
                 .slots = calloc(ray_hits->patch_count, sizeof *s.slots),
                 .met = malloc(most * sizeof *s.met),
                 .hits = malloc(most * ray_hits->randomizations * sizeof *s.hits)};
    bool good = s.targets != NULL && s.slots != NULL && s.met != NULL && s.hits != NULL;
    const size_t end =
        BLOCK * (index + 1) < ray_hits->patch_count ? BLOCK * (index + 1) : ray_hits->patch_count;
    for (size_t patch = BLOCK * index; good && patch < end; ++patch) {
        if (work->facets->areas[aur_facet_of(work->facets, patch)] > 0.0)
            for (size_t r = 0; r < ray_hits->randomizations; ++r) {
                aur_facet_trace(work->facets, work->pattern, patch, r, NULL, s.targets);
                count_targets(work, &s, patch, r);
            }
        good = store_row(work, &s, patch);
    }
    free(s.targets);
    free(s.slots);
    free(s.met);
    free(s.hits);
    return good ? AUR_OK : AUR_ERROR_MEMORY;
}

/* For each patch, the patches whose rays hit it, in ascending order. */
static bool transpose(aur_ray_hits *ray_hits) {
    ray_hits->starts = calloc(ray_hits->patch_count + 2, sizeof *ray_hits->starts);
    if (ray_hits->starts == NULL)
        return false;
    size_t *const next = ray_hits->starts + 1; /* advances from each start */
    for (size_t i = 0; i < ray_hits->patch_count; ++i)
        for (size_t k = 0; k < ray_hits->rows[i].count; ++k)
            ++next[ray_hits->rows[i].patches[k] + 1];
    for (size_t i = 0; i < ray_hits->patch_count; ++i)
        next[i + 1] += next[i];
    const size_t total = next[ray_hits->patch_count];
    ray_hits->sources = malloc((total + 1) * sizeof *ray_hits->sources);
    ray_hits->hit_indices = malloc((total + 1) * sizeof *ray_hits->hit_indices);
    if (ray_hits->sources == NULL || ray_hits->hit_indices == NULL)
        return false;
    for (size_t i = 0; i < ray_hits->patch_count; ++i)
        for (size_t k = 0; k < ray_hits->rows[i].count; ++k) {
            const size_t at = next[ray_hits->rows[i].patches[k]]++;
            ray_hits->sources[at] = (uint32_t)i;
            ray_hits->hit_indices[at] = (uint32_t)k;
        }
    return true;
}

aur_result aur_ray_hits_trace(const aur_facets *facets, const aur_facet_pattern *pattern,
                              size_t randomizations, const aur_parallel_options *parallel,
                              aur_ray_hits *ray_hits, aur_error *error) {
    const size_t patches = facets->patch_count;
    *ray_hits =
        (aur_ray_hits){.patch_count = patches, .randomizations = randomizations, .rays = pattern->count};
    ray_hits->rows = calloc(patches, sizeof *ray_hits->rows);
    ray_hits->sky = calloc(patches * randomizations, sizeof *ray_hits->sky);
    ray_hits->back = calloc(patches * randomizations, sizeof *ray_hits->back);
    aur_result result = AUR_OK;
    if (ray_hits->rows == NULL || ray_hits->sky == NULL || ray_hits->back == NULL)
        result = aur_fail_memory(error);
    tracing work = {facets, pattern, ray_hits};
    aur_parallel_options options = *parallel;
    options.what = "tracing rays";
    options.flush_denormals = true;
    if (result == AUR_OK)
        result = aur_parallel_for(&options, (patches + BLOCK - 1) / BLOCK, trace_block, &work, error);
    if (result == AUR_OK && !transpose(ray_hits))
        result = aur_fail_memory(error);
    if (result != AUR_OK)
        aur_ray_hits_release(ray_hits);
    return result;
}

void aur_ray_hits_release(aur_ray_hits *ray_hits) {
    for (size_t i = 0; i < ray_hits->patch_count && ray_hits->rows != NULL; ++i) {
        free(ray_hits->rows[i].patches);
        free(ray_hits->rows[i].hits);
    }
    free(ray_hits->rows);
    free(ray_hits->sky);
    free(ray_hits->back);
    free(ray_hits->starts);
    free(ray_hits->sources);
    free(ray_hits->hit_indices);
    *ray_hits = (aur_ray_hits){0};
}
