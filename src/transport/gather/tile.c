/* A tile of final gathering: its sixteen groups, its edges, and the means of its pixels. */
#include "transport/gather/plan.h"

#include <stdlib.h>

/* The groups' lanes that lie in the picture. A crop does not matter: packets must be those of the whole tile,
 * or its pixels would differ in the last bits. */
static uint32_t lanes_of(const aur_group_task *task) {
    size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
    aur_group_pixels(task->group, task->x, task->y, x, y);
    return aur_group_lanes_within(x, y, 0, task->view->width, 0, task->view->height);
}

/* Every stratum's mean radiance by its share of what the pixel sees. */
static void develop(const aur_pixel_strata *pixel, double mean[3]) {
    double seen = 0.0;
    mean[0] = mean[1] = mean[2] = 0.0;
    for (uint32_t i = 0; i < pixel->count; ++i) {
        const aur_stratum *const stratum = &pixel->strata[i];
        if (stratum->shaded == 0.0)
            continue;
        seen += stratum->seen;
        for (size_t c = 0; c < 3; ++c)
            mean[c] += stratum->sum[c] * (stratum->seen / stratum->shaded);
    }
    for (size_t c = 0; c < 3; ++c)
        mean[c] = seen != 0.0 ? mean[c] / seen : 0.0;
}

static bool add_tile(const aur_final_gather *data, aur_tile *tile, aur_group *group,
                     aur_pixel_strata *strata) {
    aur_group_task task = {.data = data,
                           .view = tile->view,
                           .x = tile->x0 / AUR_TILE_SIZE * AUR_TILE_SIZE,
                           .y = tile->y0 / AUR_TILE_SIZE * AUR_TILE_SIZE};
    for (task.group = 0; task.group < AUR_PACKET_SIZE; ++task.group) {
        task.lanes = lanes_of(&task);
        for (uint32_t i = 0; i < tile->count; ++i) {
            task.index = tile->first + i;
            if (task.lanes != 0)
                aur_group_add_sample(group, &task, strata, &tile->counters);
        }
    }
    if (data->edge_samples > 0)
        aur_gather_refine_edges(group, &task, tile->first + tile->count, strata, &tile->counters);
    if (data->shares_irradiance && !aur_gather_share_irradiance(strata))
        return false;
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x) {
            const aur_pixel_strata *const pixel = &strata[(y - task.y) * AUR_TILE_SIZE + (x - task.x)];
            double mean[3];
            develop(pixel, mean);
            if (pixel->samples == 0)
                continue;
            aur_tile_add_mean(tile, x, y, tile->count, mean);
            if (data->adaptive)
                aur_tile_add_extra(tile, x, y, 0, (double)tile->count * (double)pixel->directions);
        }
    return true;
}

aur_result aur_final_gather_tile(const aur_integrator *integrator, aur_tile *tile) {
    aur_group *const group = aur_group_create(integrator->data);
    aur_pixel_strata *const strata = calloc(AUR_TILE_PIXELS, sizeof *strata);
    const bool good = group != NULL && strata != NULL && add_tile(integrator->data, tile, group, strata);
    free(strata);
    aur_group_destroy(group);
    return good ? AUR_OK : AUR_ERROR_MEMORY;
}
