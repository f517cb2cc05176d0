/* Path tracing of sixteen pixels at a time.
 *
 * The pixels are the neighbours of one 4 x 4 block of a tile. Interleaved (Keller and Heidrich 2001) they are
 * those of one group (render/trace/interleave.h), one of each block, and share all random numbers but the
 * camera's: paths on flat walls run in parallel, and their packets remain coherent. */
#include "render/film/clamp.h"
#include "render/path/path_group.h"
#include "render/trace/interleave.h"

/* Traces the probe rays for emitters of those of `lanes` that have any. */
static void trace_probes(aur_path_group *g, aur_tile *tile, const size_t *x, const size_t *y,
                         uint32_t lanes) {
    g->preset = 0;
    for (uint32_t rest = g->data->probes != NULL ? lanes : 0; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        aur_vector emission;
        if (!aur_edge_probe(g->data->probes, tile, x[k], y[k], g->index, &emission))
            continue;
        g->preset |= 1u << k;
        aur_lane_set(&g->lanes.sum, k, emission);
    }
}

/* Starts sample g->index of the pixels of `lanes`, with probe rays in those of `needed`. */
static void begin(aur_path_group *g, aur_tile *tile, const size_t *x, const size_t *y, uint32_t lanes,
                  uint32_t needed, aur_camera_sample *samples) {
    uint32_t indices[AUR_PACKET_SIZE];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        indices[k] = g->index;
    aur_view_samples(tile->view, AUR_PACKET_SIZE, x, y, indices, samples);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        g->pixels[k] = samples[k].stream.pixel;
        aur_packet_set(&g->packet, k, &samples[k].ray);
        aur_lane_set(&g->lanes.throughput, k, (aur_vector){1.0f, 1.0f, 1.0f});
        aur_lane_set(&g->lanes.sum, k, (aur_vector){0});
    }
    trace_probes(g, tile, x, y, needed);
    g->alive = g->sensor.unscattered = lanes;
    g->background = true;
    g->specular = UINT16_MAX; /* light sampling cannot hit the camera either */
}

/* Traces sample g->index of the pixels of `lanes` and adds the samples of `needed`. */
static void add_lanes(aur_path_group *g, aur_tile *tile, const size_t *x, const size_t *y, uint32_t lanes,
                      uint32_t needed) {
    aur_camera_sample samples[AUR_PACKET_SIZE];
    begin(g, tile, x, y, lanes, needed, samples);
    aur_path_group_hit(g, 1);
    const aur_lane_vectors unscattered = g->lanes.sum;
    if (g->data->max_depth > 1 && g->alive != 0) {
        aur_path_group_scatter(g, 1);
        aur_path_group_trace(g, 2);
    }
    tile->counters.stopped |= g->stopped;
    for (uint32_t rest = needed; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        aur_tile_add_clamped(tile, x[k], y[k], g->index, samples[k].offset, aur_lane_vector(&g->lanes.sum, k),
                             aur_lane_vector(&unscattered, k), g->data->clamp);
    }
}

/* The samples of one group or block. All its lanes are traced even if a crop needs few of the pixels: a
 * packet's rays may depend on each other in their last bits. */
static void add_group(aur_path_group *g, uint32_t number, aur_tile *tile) {
    const aur_view *const view = tile->view;
    const size_t x0 = tile->x0 / AUR_TILE_SIZE * AUR_TILE_SIZE, y0 = tile->y0 / AUR_TILE_SIZE * AUR_TILE_SIZE;
    size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
    if (g->data->interleaved)
        aur_group_pixels(aur_group_arrangement(aur_hash3(view->seed, y0, x0)), number, x0, y0, x, y);
    else
        aur_block_pixels(number, x0, y0, x, y);
    const uint32_t lanes = aur_group_lanes_within(x, y, 0, view->width, 0, view->height);
    const uint32_t needed = aur_group_lanes_within(x, y, tile->x0, tile->x1, tile->y0, tile->y1);
    if (needed == 0)
        return;
    for (uint32_t i = 0; i < tile->count; ++i) {
        g->index = tile->first + i;
        g->shared = (aur_stream){view->sampler, aur_hash4(view->seed, y0, x0, UINT64_C(0x696e746c) + number),
                                 g->index};
        const uint32_t traced = aur_group_lanes_needed(tile, x, y, lanes, g->index);
        if (traced != 0)
            add_lanes(g, tile, x, y, traced, needed & traced);
    }
}

/* The samples of a tile whose pixels need different sample indices: packets are filled with any pixels that
 * need the same one. */
static void add_needed(aur_path_group *g, aur_tile *tile) {
    enum { FEW = 4 }; /* faster one by one than in a nearly empty packet */
    for (uint32_t i = 0; i < tile->count; ++i) {
        size_t x[AUR_PACKET_SIZE] = {0}, y[AUR_PACKET_SIZE] = {0}, count = 0;
        g->index = tile->first + i;
        for (size_t row = tile->y0; row < tile->y1; ++row)
            for (size_t column = tile->x0; column < tile->x1; ++column) {
                if (!aur_tile_needs(tile, column, row, g->index))
                    continue;
                x[count] = column;
                y[count++] = row;
                if (count < AUR_PACKET_SIZE)
                    continue;
                add_lanes(g, tile, x, y, UINT16_MAX, UINT16_MAX);
                count = 0;
            }
        const uint32_t rest = (1u << count) - 1;
        if (count > FEW)
            add_lanes(g, tile, x, y, rest, rest);
        for (size_t k = 0; k < count && count <= FEW; ++k)
            aur_path_add_sample(g->data, g->scene, x[k], y[k], g->index, tile);
    }
}

void aur_path_add_tile(const aur_path *data, const aur_scene *scene, aur_tile *tile) {
    aur_path_group g = {0};
    aur_path_group_prepare(data, scene, tile->view->sampler, &g);
    if (tile->begins != NULL && !data->interleaved) {
        add_needed(&g, tile);
        return;
    }
    for (uint32_t number = 0; number < AUR_PACKET_SIZE; ++number)
        add_group(&g, number, tile);
}
