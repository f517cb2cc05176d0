#include "render/film/tile.h"

#include <stdlib.h>
#include <string.h>

#include "render/film/spread.h"

void aur_counters_add(aur_counters *sum, const aur_counters *added) {
    sum->rays += added->rays;
    sum->edge_rays += added->edge_rays;
    sum->samples += added->samples;
    sum->invalid += added->invalid;
    sum->cut += added->cut;
    sum->unsolved += added->unsolved;
    for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
        sum->levels[l] += added->levels[l];
}

void aur_view_sample(const aur_view *view, size_t x, size_t y, uint32_t index, aur_camera_sample *sample) {
    sample->stream = (aur_stream){view->sampler, aur_hash3(view->seed, y, x), index};
    float *const offset = sample->offset;
    offset[0] = offset[1] = 0.0f;
    aur_stream_pairs(&sample->stream, 0, AUR_STREAM_BLOCK, sample->first_pairs);
    if (!view->pixel_centre) {
        offset[0] = aur_filter_sample(view->filter, sample->first_pairs[AUR_PAIR_FILTER][0]);
        offset[1] = aur_filter_sample(view->filter, sample->first_pairs[AUR_PAIR_FILTER][1]);
    }
    aur_camera_ray(view->scene, view->width, view->height, (float)x + 0.5f + offset[0],
                   (float)y + 0.5f + offset[1], sample->first_pairs[AUR_PAIR_LENS], &sample->ray);
}

/* Offsets from the pixels' centres along one axis. */
static void draw_offsets(const aur_filter *filter, const float *u, float *offsets) {
    for (size_t k = 0; k < AUR_TILE_SIZE; ++k)
        offsets[k] = aur_filter_sample(filter, u[k]);
}

void aur_view_samples(const aur_view *view, size_t count, const size_t *x, const size_t *y,
                      const uint32_t *indices, aur_camera_sample *samples) {
    uint64_t pixels[AUR_TILE_SIZE] = {0};
    float u[AUR_TILE_SIZE], v[AUR_TILE_SIZE], s[AUR_TILE_SIZE], t[AUR_TILE_SIZE];
    float across[AUR_TILE_SIZE] = {0}, down[AUR_TILE_SIZE] = {0};
    for (size_t k = 0; k < AUR_TILE_SIZE; ++k)
        u[k] = v[k] = s[k] = t[k] = 0.5f;
    for (size_t k = 0; k < count; ++k)
        pixels[k] = aur_hash3(view->seed, y[k], x[k]);
    if (view->has_lens)
        aur_stream_samples(view->sampler, count, pixels, indices, AUR_PAIR_LENS, s, t);
    if (!view->pixel_centre) {
        aur_stream_samples(view->sampler, count, pixels, indices, AUR_PAIR_FILTER, u, v);
        draw_offsets(view->filter, u, across);
        draw_offsets(view->filter, v, down);
    }
    for (size_t k = 0; k < count; ++k) {
        samples[k].offset[0] = across[k];
        samples[k].offset[1] = down[k];
        across[k] = (float)x[k] + 0.5f + across[k];
        down[k] = (float)y[k] + 0.5f + down[k];
    }
    aur_camera_lanes rays;
    aur_camera_rays(view->scene, view->width, view->height, across, down, s, t, &rays);
    for (size_t k = 0; k < count; ++k) {
        samples[k].stream = (aur_stream){view->sampler, pixels[k], indices[k]};
        samples[k].ray =
            (aur_ray){.origin = {rays.origin[0][k], rays.origin[1][k], rays.origin[2][k]},
                      .nearest = rays.nearest[k],
                      .direction = {rays.direction[0][k], rays.direction[1][k], rays.direction[2][k]},
                      .farthest = rays.farthest[k]};
    }
}

_Static_assert((int)AUR_TILE_SIZE == (int)AUR_CAMERA_LANES, "a row of a tile is one call");

bool aur_is_radiance(aur_vector radiance) {
    return aur_vector_is_finite(radiance) && radiance.x >= 0.0f && radiance.y >= 0.0f && radiance.z >= 0.0f;
}

/* --- sums */

static size_t pixel_of(const aur_tile *tile, size_t x, size_t y) {
    return (y - tile->y0) * tile->stride + (x - tile->x0);
}

/* A stored sample's floats: its offset, whether it is present, and its channels. */
enum { SLOT_COUNTS = 2, SLOT_VALUES };

static size_t slot_of(const aur_tile *tile, size_t x, size_t y, uint32_t index) {
    return (index - tile->first) * tile->stride * (tile->y1 - tile->y0) + pixel_of(tile, x, y);
}

static void hold(aur_tile *tile, size_t x, size_t y, uint32_t index, const float offset[2],
                 const float *values) {
    float *const slot = &tile->slots.values[slot_of(tile, x, y, index) * (SLOT_VALUES + tile->channel_count)];
    memcpy(slot, offset, 2 * sizeof *slot);
    slot[SLOT_COUNTS] = 1.0f;
    memcpy(slot + SLOT_VALUES, values, tile->channel_count * sizeof *slot);
}

void aur_tile_add_channels(aur_tile *tile, size_t x, size_t y, uint32_t index, const float offset[2],
                           const float *values) {
    bool valid = aur_is_radiance((aur_vector){values[0], values[1], values[2]});
    for (size_t c = 3; c < tile->channel_count; ++c)
        valid = valid && isfinite(values[c]);
    if (!valid) {
        ++tile->counters.invalid;
        return;
    }
    const size_t pixel = pixel_of(tile, x, y);
    ++tile->counts[pixel];
    if (tile->spread != NULL) {
        hold(tile, x, y, index, offset, values);
        return;
    }
    double *const sums = &tile->sums[pixel * tile->channel_count];
    for (size_t c = 0; c < tile->channel_count; ++c)
        sums[c] += (double)values[c];
}

void aur_tile_add(aur_tile *tile, size_t x, size_t y, uint32_t index, const float offset[2],
                  aur_vector radiance) {
    if (!aur_is_radiance(radiance)) {
        ++tile->counters.invalid;
        return;
    }
    radiance = aur_tile_measured(tile, radiance);
    const size_t pixel = pixel_of(tile, x, y);
    ++tile->counts[pixel];
    if (tile->spread != NULL) {
        hold(tile, x, y, index, offset, (const float[3]){radiance.x, radiance.y, radiance.z});
        return;
    }
    double *const sums = &tile->sums[pixel * tile->channel_count];
    sums[0] += (double)radiance.x;
    sums[1] += (double)radiance.y;
    sums[2] += (double)radiance.z;
}

void aur_tile_add_light(aur_tile *tile, size_t x, size_t y, uint32_t index, const float offset[2], float part,
                        aur_vector radiance) {
    aur_tile_slots *const slots = &tile->slots;
    if (!aur_is_radiance(radiance))
        return;
    if (slots->light_count == slots->light_capacity) {
        const size_t capacity = 2 * slots->light_capacity + 64;
        aur_tile_light *const lights = realloc(slots->lights, capacity * sizeof *lights);
        if (lights == NULL) {
            slots->failed = true;
            return;
        }
        slots->lights = lights;
        slots->light_capacity = capacity;
    }
    slots->lights[slots->light_count] = (aur_tile_light){slot_of(tile, x, y, index),
                                                         slots->light_count,
                                                         {offset[0], offset[1]},
                                                         part,
                                                         {radiance.x, radiance.y, radiance.z}};
    ++slots->light_count;
}

void aur_tile_add_of(aur_tile *tile, size_t x, size_t y, size_t sample_count, const float offset[2],
                     aur_vector radiance) {
    if (tile->spread == NULL) {
        aur_tile_add(tile, x, y, tile->first, offset, radiance);
        return;
    }
    if (!aur_is_radiance(radiance)) {
        ++tile->counters.invalid;
        return;
    }
    const float values[3] = {radiance.x, radiance.y, radiance.z};
    ++tile->counts[pixel_of(tile, x, y)];
    aur_spread_add(tile->spread, tile->sums, x, y, offset, (double)tile->count / (double)sample_count, values,
                   true);
}

void aur_tile_add_mean(aur_tile *tile, size_t x, size_t y, uint32_t count, const double mean[3]) {
    const size_t pixel = pixel_of(tile, x, y);
    const double factor = (double)aur_tile_measured(tile, (aur_vector){1.0f, 1.0f, 1.0f}).x;
    for (size_t c = 0; c < 3; ++c)
        tile->sums[pixel * tile->channel_count + c] += (double)count * mean[c] * factor;
    tile->counts[pixel] += count;
}

void aur_tile_add_extra(aur_tile *tile, size_t x, size_t y, size_t channel, double value) {
    tile->sums[pixel_of(tile, x, y) * tile->channel_count + 3 + channel] += value;
}

void aur_tile_add_sums(aur_tile *tile, size_t x, size_t y, uint32_t count, const double *sums) {
    const aur_spread *const spread = tile->spread;
    const size_t row = (2 * spread->reach + 1) * spread->channels;
    double *const cell = tile->sums + aur_spread_cell_of(spread, x, y) * spread->cell_values;
    for (size_t j = 0; j < 2 * spread->reach + 1; ++j) {
        double *const to =
            cell + ((y % spread->cell + j) * spread->side + x % spread->cell) * spread->channels;
        for (size_t i = 0; i < row; ++i)
            to[i] += sums[j * row + i];
    }
    tile->counts[pixel_of(tile, x, y)] += count;
}

/* --- samples held back */

bool aur_tile_hold(aur_tile *tile) {
    const size_t count = tile->stride * (tile->y1 - tile->y0) * tile->count;
    free(tile->slots.values);
    tile->slots.values = calloc(count, (SLOT_VALUES + tile->channel_count) * sizeof(float));
    tile->slots.light_count = 0;
    return tile->slots.values != NULL;
}

/* Lights of one sample are ordered as they were hit. */
static int compare_lights(const void *a, const void *b) {
    const aur_tile_light *const x = a, *const y = b;
    if (x->slot != y->slot)
        return x->slot < y->slot ? -1 : 1;
    return x->number < y->number ? -1 : 1;
}

void aur_tile_release(aur_tile *tile) {
    aur_tile_slots *const slots = &tile->slots;
    const size_t pixels = tile->stride * (tile->y1 - tile->y0), values = SLOT_VALUES + tile->channel_count;
    if (slots->light_count > 0)
        qsort(slots->lights, slots->light_count, sizeof *slots->lights, compare_lights);
    float emission[3 + AUR_EXTRA_CHANNELS_MAX] = {0};
    const aur_tile_light *light = slots->lights, *const end = light + slots->light_count;
    for (size_t slot = 0; slot < pixels * tile->count; ++slot) {
        const size_t x = tile->x0 + slot % pixels % tile->stride, y = tile->y0 + slot % pixels / tile->stride;
        const float *const sample = &slots->values[slot * values];
        const bool has_light = light < end && light->slot == slot;
        if (sample[SLOT_COUNTS] > 0.0f)
            aur_spread_add(tile->spread, tile->sums, x, y, sample, 1.0, sample + SLOT_VALUES, !has_light);
        for (; light < end && light->slot == slot; ++light) {
            memcpy(emission, light->radiance, sizeof light->radiance);
            if (sample[SLOT_COUNTS] > 0.0f)
                aur_spread_add(tile->spread, tile->sums, x, y, light->offset, (double)light->part, emission,
                               true);
        }
    }
}

void aur_tile_free_slots(aur_tile *tile) {
    free(tile->slots.values);
    free(tile->slots.lights);
    tile->slots = (aur_tile_slots){0};
}
