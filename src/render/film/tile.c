#include "render/film/tile.h"

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

float aur_view_sample(const aur_view *view, size_t x, size_t y, uint32_t index, aur_camera_sample *sample) {
    sample->stream = (aur_stream){view->sampler, aur_hash3(view->seed, y, x), index};
    float offset[2] = {0.0f, 0.0f};
    aur_stream_pairs(&sample->stream, 0, AUR_STREAM_BLOCK, sample->first_pairs);
    if (!view->pixel_centre) {
        offset[0] = aur_filter_sample(view->filter, sample->first_pairs[AUR_PAIR_FILTER][0]);
        offset[1] = aur_filter_sample(view->filter, sample->first_pairs[AUR_PAIR_FILTER][1]);
    }
    aur_camera_ray(view->scene, view->width, view->height, (float)x + 0.5f + offset[0],
                   (float)y + 0.5f + offset[1], sample->first_pairs[AUR_PAIR_LENS], &sample->ray);
    return aur_filter_weight(view->filter, offset[0]) * aur_filter_weight(view->filter, offset[1]);
}

/* Offsets from the pixels' centres along one axis. */
static void draw_offsets(const aur_filter *filter, const float *u, float *offsets) {
    for (size_t k = 0; k < AUR_TILE_SIZE; ++k)
        offsets[k] = aur_filter_sample(filter, u[k]);
}

void aur_view_samples(const aur_view *view, size_t count, const size_t *x, const size_t *y, uint32_t index,
                      aur_camera_sample *samples, float *weights) {
    uint64_t pixels[AUR_TILE_SIZE] = {0};
    float u[AUR_TILE_SIZE], v[AUR_TILE_SIZE], s[AUR_TILE_SIZE], t[AUR_TILE_SIZE];
    float across[AUR_TILE_SIZE] = {0}, down[AUR_TILE_SIZE] = {0};
    for (size_t k = 0; k < AUR_TILE_SIZE; ++k)
        u[k] = v[k] = s[k] = t[k] = 0.5f;
    for (size_t k = 0; k < count; ++k)
        pixels[k] = aur_hash3(view->seed, y[k], x[k]);
    if (view->has_lens)
        aur_stream_pixels(view->sampler, count, pixels, index, AUR_PAIR_LENS, s, t);
    if (!view->pixel_centre) {
        aur_stream_pixels(view->sampler, count, pixels, index, AUR_PAIR_FILTER, u, v);
        draw_offsets(view->filter, u, across);
        draw_offsets(view->filter, v, down);
    }
    for (size_t k = 0; k < count; ++k) {
        weights[k] = aur_filter_weight(view->filter, across[k]) * aur_filter_weight(view->filter, down[k]);
        across[k] = (float)x[k] + 0.5f + across[k];
        down[k] = (float)y[k] + 0.5f + down[k];
    }
    aur_camera_lanes rays;
    aur_camera_rays(view->scene, view->width, view->height, across, down, s, t, &rays);
    for (size_t k = 0; k < count; ++k) {
        samples[k].stream = (aur_stream){view->sampler, pixels[k], index};
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

void aur_tile_add_channels(aur_tile *tile, size_t x, size_t y, float weight, const float *values) {
    bool valid = aur_is_radiance((aur_vector){values[0], values[1], values[2]});
    for (size_t c = 3; c < tile->channel_count; ++c)
        valid = valid && isfinite(values[c]);
    if (!valid) {
        ++tile->counters.invalid;
        return;
    }
    const size_t pixel = (y - tile->y0) * tile->stride + (x - tile->x0);
    double *const sums = &tile->sums[pixel * tile->channel_count];
    for (size_t c = 0; c < tile->channel_count; ++c)
        sums[c] += (double)weight * (double)values[c];
    ++tile->counts[pixel];
}

void aur_tile_add(aur_tile *tile, size_t x, size_t y, float weight, aur_vector radiance) {
    if (!aur_is_radiance(radiance)) {
        ++tile->counters.invalid;
        return;
    }
    const size_t pixel = (y - tile->y0) * tile->stride + (x - tile->x0);
    double *const sums = &tile->sums[pixel * tile->channel_count];
    sums[0] += (double)weight * (double)radiance.x;
    sums[1] += (double)weight * (double)radiance.y;
    sums[2] += (double)weight * (double)radiance.z;
    ++tile->counts[pixel];
}

void aur_tile_add_mean(aur_tile *tile, size_t x, size_t y, uint32_t count, const double mean[3]) {
    const size_t pixel = (y - tile->y0) * tile->stride + (x - tile->x0);
    for (size_t c = 0; c < 3; ++c)
        tile->sums[pixel * tile->channel_count + c] += (double)count * mean[c];
    tile->counts[pixel] += count;
}

void aur_tile_add_extra(aur_tile *tile, size_t x, size_t y, size_t channel, double value) {
    const size_t pixel = (y - tile->y0) * tile->stride + (x - tile->x0);
    tile->sums[pixel * tile->channel_count + 3 + channel] += value;
}
