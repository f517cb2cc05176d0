#include "lighting/viewfactors/closed_pairs.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 64 };

typedef struct tracing {
    const aur_facets *facets;
    const aur_facet_pattern *pattern;
    aur_visits *visits;
} tracing;

/* What a block of patches needs. `slots` says where a patch stands in `met`, counted from 1. */
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
    aur_visits *const visits = work->visits;
    const size_t width = visits->randomizations;
    for (size_t i = 0; i < work->pattern->count; ++i) {
        const uint32_t target = s->targets[i];
        if (target == AUR_TARGET_SKY) {
            ++visits->sky[width * patch + randomization];
        } else if (target == AUR_TARGET_BACK) {
            ++visits->back[width * patch + randomization];
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

/* Keeps what has been met, in order, and makes the scratch ready for the next patch. */
static bool keep_row(const tracing *work, scratch *s, size_t patch) {
    const size_t width = work->visits->randomizations;
    aur_visits_row *const row = &work->visits->rows[patch];
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
    const aur_visits *const visits = work->visits;
    const size_t most = work->pattern->count * visits->randomizations; /* different targets */
    scratch s = {.targets = malloc(work->pattern->count * sizeof *s.targets),
                 .slots = calloc(visits->patch_count, sizeof *s.slots),
                 .met = malloc(most * sizeof *s.met),
                 .hits = malloc(most * visits->randomizations * sizeof *s.hits)};
    bool good = s.targets != NULL && s.slots != NULL && s.met != NULL && s.hits != NULL;
    const size_t end = BLOCK * (index + 1) < visits->patch_count ? BLOCK * (index + 1) : visits->patch_count;
    for (size_t patch = BLOCK * index; good && patch < end; ++patch) {
        if (work->facets->areas[aur_facet_of(work->facets, patch)] > 0.0)
            for (size_t r = 0; r < visits->randomizations; ++r) {
                aur_facet_trace(work->facets, work->pattern, patch, r, NULL, s.targets);
                count_targets(work, &s, patch, r);
            }
        good = keep_row(work, &s, patch);
    }
    free(s.targets);
    free(s.slots);
    free(s.met);
    free(s.hits);
    return good ? AUR_OK : AUR_ERROR_MEMORY;
}

/* The rows that each patch stands in, in ascending order. */
static bool transpose(aur_visits *visits) {
    visits->starts = calloc(visits->patch_count + 2, sizeof *visits->starts);
    if (visits->starts == NULL)
        return false;
    size_t *const next = visits->starts + 1; /* moves on from each start to the next one */
    for (size_t i = 0; i < visits->patch_count; ++i)
        for (size_t k = 0; k < visits->rows[i].count; ++k)
            ++next[visits->rows[i].patches[k] + 1];
    for (size_t i = 0; i < visits->patch_count; ++i)
        next[i + 1] += next[i];
    const size_t total = next[visits->patch_count];
    visits->sources = malloc((total + 1) * sizeof *visits->sources);
    visits->places = malloc((total + 1) * sizeof *visits->places);
    if (visits->sources == NULL || visits->places == NULL)
        return false;
    for (size_t i = 0; i < visits->patch_count; ++i)
        for (size_t k = 0; k < visits->rows[i].count; ++k) {
            const size_t at = next[visits->rows[i].patches[k]]++;
            visits->sources[at] = (uint32_t)i;
            visits->places[at] = (uint32_t)k;
        }
    return true;
}

aur_result aur_visits_trace(const aur_facets *facets, const aur_facet_pattern *pattern, size_t randomizations,
                            const aur_parallel_options *parallel, aur_visits *visits, aur_error *error) {
    const size_t patches = facets->patch_count;
    *visits = (aur_visits){.patch_count = patches, .randomizations = randomizations, .rays = pattern->count};
    visits->rows = calloc(patches, sizeof *visits->rows);
    visits->sky = calloc(patches * randomizations, sizeof *visits->sky);
    visits->back = calloc(patches * randomizations, sizeof *visits->back);
    aur_result result = AUR_OK;
    if (visits->rows == NULL || visits->sky == NULL || visits->back == NULL)
        result = aur_fail_memory(error);
    tracing work = {facets, pattern, visits};
    aur_parallel_options options = *parallel;
    options.what = "tracing rays";
    options.flush_denormals = true;
    if (result == AUR_OK)
        result = aur_parallel_for(&options, (patches + BLOCK - 1) / BLOCK, trace_block, &work, error);
    if (result == AUR_OK && !transpose(visits))
        result = aur_fail_memory(error);
    if (result != AUR_OK)
        aur_visits_release(visits);
    return result;
}

void aur_visits_release(aur_visits *visits) {
    for (size_t i = 0; i < visits->patch_count && visits->rows != NULL; ++i) {
        free(visits->rows[i].patches);
        free(visits->rows[i].hits);
    }
    free(visits->rows);
    free(visits->sky);
    free(visits->back);
    free(visits->starts);
    free(visits->sources);
    free(visits->places);
    *visits = (aur_visits){0};
}
