#include <aureole/statistics.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/upper_row.h"

enum { BLOCK = 32 };

typedef struct assembly {
    const aur_facets *facets;
    const aur_ray_hits *ray_hits;
    const aur_closed_pairs *closed;
    size_t *starts; /* first of the patches of each row, in `patches` */
    uint32_t *patches;
    aur_upper_row *rows;
    aur_exchange *exchange;
} assembly;

/* Sums for the columns of a row. `slots` maps a column to its index in `met`, counted from 1. */
typedef struct scratch {
    size_t met_count, capacity;
    uint32_t *slots, *met;
    double *closed; /* [met] */
    double *sums;   /* [met][randomizations] */
} scratch;

static bool reserve(scratch *s, size_t width) {
    if (s->met_count < s->capacity)
        return true;
    const size_t capacity = s->capacity == 0 ? 256 : 2 * s->capacity;
    uint32_t *const met = realloc(s->met, capacity * sizeof *met);
    s->met = met != NULL ? met : s->met;
    double *const closed = realloc(s->closed, capacity * sizeof *closed);
    s->closed = closed != NULL ? closed : s->closed;
    double *const sums = realloc(s->sums, capacity * width * sizeof *sums);
    s->sums = sums != NULL ? sums : s->sums;
    if (met == NULL || closed == NULL || sums == NULL)
        return false;
    s->capacity = capacity;
    return true;
}

/* The index of a column in the scratch; SIZE_MAX if out of memory. */
static size_t find_slot(scratch *s, size_t column, size_t width) {
    if (s->slots[column] != 0)
        return s->slots[column] - 1;
    if (!reserve(s, width))
        return SIZE_MAX;
    s->met[s->met_count] = (uint32_t)column;
    s->closed[s->met_count] = 0.0;
    memset(&s->sums[width * s->met_count], 0, width * sizeof *s->sums);
    s->slots[column] = (uint32_t)++s->met_count;
    return s->met_count - 1;
}

static bool any_hit(const uint16_t *hits, size_t width) {
    for (size_t r = 0; hits != NULL && r < width; ++r)
        if (hits[r] > 0)
            return true;
    return false;
}

/* Adds the pairs of one patch: closed forms directly, the others by the rays of both patches, weighted by the
 * inverse of their variance, which is proportional to the inverse area. */
static bool add_patch(const assembly *work, scratch *s, size_t row, size_t i) {
    const aur_facets *const facets = work->facets;
    const aur_ray_hits *const ray_hits = work->ray_hits;
    const size_t width = ray_hits->randomizations;
    const double area = facets->areas[aur_facet_of(facets, i)];
    const aur_closed_row *const closed = &work->closed->rows[i];
    for (size_t c = 0; c < closed->count; ++c) {
        const size_t column = aur_facets_row(facets, closed->patches[c]);
        const size_t slot = find_slot(s, column, width);
        if (slot == SIZE_MAX)
            return false;
        s->closed[slot] += (column == row ? 2.0 : 1.0) * closed->exchanges[c];
    }
    work->rows[row].closed_pairs += closed->count;
    const aur_ray_hits_row *const mine = &ray_hits->rows[i];
    size_t out_index = 0, in_index = ray_hits->starts[i], closed_index = 0;
    while (out_index < mine->count || in_index < ray_hits->starts[i + 1]) {
        const uint32_t a = out_index < mine->count ? mine->patches[out_index] : UINT32_MAX;
        const uint32_t b = in_index < ray_hits->starts[i + 1] ? ray_hits->sources[in_index] : UINT32_MAX;
        const uint32_t k = a < b ? a : b;
        const uint16_t *const out = a == k ? &mine->hits[width * out_index++] : NULL;
        const uint16_t *const in =
            b == k ? &ray_hits->rows[k].hits[width * (size_t)ray_hits->hit_indices[in_index++]] : NULL;
        while (closed_index < closed->count && closed->patches[closed_index] < k)
            ++closed_index;
        if ((closed_index < closed->count && closed->patches[closed_index] == k) ||
            !aur_pair_stands_with(facets, i, k))
            continue;
        if (!any_hit(out, width) && !any_hit(in, width))
            continue; /* already freed */
        const size_t column = aur_facets_row(facets, k);
        const size_t slot = find_slot(s, column, width);
        if (slot == SIZE_MAX)
            return false;
        const double other = facets->areas[aur_facet_of(facets, k)];
        const double weight =
            (column == row ? 2.0 : 1.0) * area * other / ((area + other) * (double)ray_hits->rays);
        for (size_t r = 0; r < width; ++r)
            s->sums[width * slot + r] +=
                weight * ((out != NULL ? (double)out[r] : 0.0) + (in != NULL ? (double)in[r] : 0.0));
        ++work->rows[row].sampled_pairs;
    }
    return true;
}

static aur_moments moments_of(const double *values, size_t count) {
    aur_moments moments = {0};
    for (size_t r = 0; r < count; ++r)
        aur_moments_add(&moments, values[r]);
    return moments;
}

static int compare_numbers(const void *left, const void *right) {
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

static bool store_row(const assembly *work, scratch *s, aur_upper_row *row) {
    const size_t width = work->ray_hits->randomizations;
    row->count = s->met_count;
    row->columns = malloc((s->met_count + 1) * sizeof *row->columns);
    row->closed = malloc(3 * (s->met_count + 1) * sizeof *row->closed);
    row->deviations = malloc((s->met_count + 1) * width * sizeof *row->deviations);
    const bool good = row->columns != NULL && row->closed != NULL && row->deviations != NULL;
    if (good && row->count > 0)
        memcpy(row->columns, s->met, row->count * sizeof *row->columns);
    if (good)
        qsort(row->columns, row->count, sizeof *row->columns, compare_numbers);
    for (size_t k = 0; good && k < row->count; ++k) {
        const size_t slot = s->slots[row->columns[k]] - 1;
        const double *const sums = &s->sums[width * slot];
        const aur_moments moments = moments_of(sums, width);
        row->sampled = row->closed + row->count;
        row->half_widths = row->sampled + row->count;
        row->closed[k] = s->closed[slot];
        row->sampled[k] = moments.mean;
        row->half_widths[k] = work->exchange->student * aur_moments_standard_error(&moments);
        for (size_t r = 0; r < width; ++r)
            row->deviations[width * k + r] = (float)(sums[r] - moments.mean);
    }
    for (size_t k = 0; k < s->met_count; ++k)
        s->slots[s->met[k]] = 0;
    s->met_count = 0;
    return good;
}

/* The light that leaves a row for the sky or for backs. */
static void add_losses(const assembly *work, size_t row, const double *counts, double *deviations,
                       double *exchange, double *half_width) {
    const size_t width = work->ray_hits->randomizations;
    for (size_t r = 0; r < width; ++r) {
        double sum = 0.0;
        for (size_t k = work->starts[row]; k < work->starts[row + 1]; ++k) {
            const size_t patch = work->patches[k];
            sum += work->facets->areas[aur_facet_of(work->facets, patch)] * counts[width * patch + r];
        }
        deviations[r] = sum / (double)work->ray_hits->rays;
    }
    const aur_moments moments = moments_of(deviations, width);
    *exchange = moments.mean;
    *half_width = work->exchange->student * aur_moments_standard_error(&moments);
    for (size_t r = 0; r < width; ++r)
        deviations[r] -= moments.mean;
}

static aur_result assemble_block(void *context, size_t index) {
    const assembly *const work = context;
    const size_t rows = work->facets->row_count;
    scratch s = {.slots = calloc(rows, sizeof *s.slots)};
    bool good = s.slots != NULL;
    for (size_t row = BLOCK * index; good && row < rows && row < BLOCK * (index + 1); ++row) {
        for (size_t k = work->starts[row]; good && k < work->starts[row + 1]; ++k)
            good = add_patch(work, &s, row, work->patches[k]);
        if (good)
            good = store_row(work, &s, &work->rows[row]);
        aur_exchange *const to = work->exchange;
        double *const deviations = &to->loss_deviations[to->randomizations * row];
        add_losses(work, row, work->ray_hits->sky, deviations, &to->sky[row], &to->sky_half_widths[row]);
        add_losses(work, row, work->ray_hits->back, deviations + to->randomizations * rows, &to->back[row],
                   &to->back_half_widths[row]);
    }
    free(s.slots);
    free(s.met);
    free(s.closed);
    free(s.sums);
    return good ? AUR_OK : AUR_ERROR_MEMORY;
}

/* The patches of each row. */
static bool list_patches(assembly *work) {
    const aur_facets *const facets = work->facets;
    work->starts = calloc(facets->row_count + 2, sizeof *work->starts);
    work->patches = malloc(facets->patch_count * sizeof *work->patches);
    if (work->starts == NULL || work->patches == NULL)
        return false;
    size_t *const next = work->starts + 1;
    for (size_t i = 0; i < facets->patch_count; ++i)
        ++next[aur_facets_row(facets, i) + 1];
    for (size_t i = 0; i < facets->row_count; ++i)
        next[i + 1] += next[i];
    for (size_t i = 0; i < facets->patch_count; ++i)
        work->patches[next[aur_facets_row(facets, i)]++] = (uint32_t)i;
    return true;
}

static bool allocate(const aur_facets *facets, size_t randomizations, aur_exchange *exchange) {
    const size_t rows = facets->row_count;
    *exchange = (aur_exchange){.rows = rows,
                               .randomizations = randomizations,
                               .loss_deviations =
                                   calloc(2 * rows * randomizations, sizeof *exchange->loss_deviations),
                               .starts = calloc(rows + 1, sizeof *exchange->starts),
                               .areas = malloc(rows * sizeof *exchange->areas),
                               .sky = calloc(rows, sizeof *exchange->sky),
                               .sky_half_widths = calloc(rows, sizeof *exchange->sky_half_widths),
                               .back = calloc(rows, sizeof *exchange->back),
                               .back_half_widths = calloc(rows, sizeof *exchange->back_half_widths)};
    if (exchange->starts == NULL || exchange->areas == NULL || exchange->sky == NULL ||
        exchange->sky_half_widths == NULL || exchange->back == NULL || exchange->back_half_widths == NULL ||
        exchange->loss_deviations == NULL)
        return false;
    memcpy(exchange->areas, facets->row_areas, rows * sizeof *exchange->areas);
    return true;
}

aur_result aur_exchange_assemble(const aur_facets *facets, const aur_ray_hits *ray_hits,
                                 const aur_closed_pairs *closed, double confidence,
                                 const aur_parallel_options *parallel, aur_exchange *exchange,
                                 aur_error *error) {
    assembly work = {.facets = facets,
                     .ray_hits = ray_hits,
                     .closed = closed,
                     .rows = calloc(facets->row_count, sizeof *work.rows),
                     .exchange = exchange};
    aur_result result = AUR_OK;
    if (!allocate(facets, ray_hits->randomizations, exchange) || work.rows == NULL || !list_patches(&work))
        result = aur_fail_memory(error);
    exchange->student = aur_student_quantile(ray_hits->randomizations - 1, 0.5 + 0.5 * confidence);
    aur_parallel_options options = *parallel;
    options.what = "putting rows together";
    if (result == AUR_OK)
        result =
            aur_parallel_for(&options, (facets->row_count + BLOCK - 1) / BLOCK, assemble_block, &work, error);
    if (result == AUR_OK && !aur_exchange_mirror(work.rows, exchange))
        result = aur_fail_memory(error);
    for (size_t i = 0; i < facets->row_count && work.rows != NULL; ++i) {
        free(work.rows[i].columns);
        free(work.rows[i].closed);
        free(work.rows[i].deviations);
    }
    free(work.rows);
    free(work.starts);
    free(work.patches);
    if (result != AUR_OK)
        aur_exchange_release(exchange);
    return result;
}

void aur_exchange_release(aur_exchange *exchange) {
    free(exchange->starts);
    free(exchange->columns);
    free(exchange->values);
    free(exchange->variances);
    free(exchange->half_widths);
    free(exchange->deviations);
    free(exchange->loss_deviations);
    free(exchange->areas);
    free(exchange->sky);
    free(exchange->sky_half_widths);
    free(exchange->back);
    free(exchange->back_half_widths);
    *exchange = (aur_exchange){0};
}
