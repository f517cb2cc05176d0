#include "transport/gather/tile.h"

#include <stdlib.h>

#include "transport/gather/edges.h"
#include "transport/gather/pooling.h"
#include "transport/gather/sample.h"

/* Edges that are none of a light's get so small a part of the samples. */
enum { PLAIN_EDGE_PART = 16 };

/* The group's lanes that lie in the picture. A crop does not matter: packets must be those of the whole tile,
 * or its pixels would differ in the last bits. */
static uint32_t lanes_of(const aur_gather_task *task) {
    size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
    aur_group_pixels(task->group, task->x, task->y, x, y);
    return aur_group_lanes_within(x, y, 0, task->view->width, 0, task->view->height);
}

/* Samples that tell how much pixels see of what is around an edge. */
static void refine_edges(aur_gather_group *group, aur_gather_task task, uint32_t first_index,
                         aur_pixel_strata *strata, aur_counters *counters) {
    const uint32_t count = task.plan->policy.edge_samples;
    aur_gather_edges edges;
    aur_gather_find_edges(task.plan, task.view, task.x, task.y, strata, &edges, counters);
    task.only_new = true;
    for (task.group = 0; task.group < AUR_GROUP_COUNT; ++task.group)
        for (uint32_t i = 0; i < count; ++i) {
            task.index = first_index + i;
            task.lanes = i < count / PLAIN_EDGE_PART ? edges.any[task.group] : edges.lights[task.group];
            if (task.lanes != 0)
                aur_gather_add_samples(group, &task, strata, counters);
        }
}

static bool add_tile(const aur_gather_plan *plan, aur_tile *tile, aur_gather_group *group,
                     aur_pixel_strata *strata) {
    aur_gather_task task = {.plan = plan,
                            .view = tile->view,
                            .x = tile->x0 / AUR_TILE_SIZE * AUR_TILE_SIZE,
                            .y = tile->y0 / AUR_TILE_SIZE * AUR_TILE_SIZE};
    for (task.group = 0; task.group < AUR_GROUP_COUNT; ++task.group) {
        task.lanes = lanes_of(&task);
        for (uint32_t i = 0; i < tile->count; ++i) {
            task.index = tile->first + i;
            if (task.lanes != 0)
                aur_gather_add_samples(group, &task, strata, &tile->counters);
        }
    }
    if (plan->policy.edge_samples > 0)
        refine_edges(group, task, tile->first + tile->count, strata, &tile->counters);
    if (plan->policy.pools && !aur_gather_pool_irradiance(strata))
        return false;
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x) {
            const aur_pixel_strata *const pixel = &strata[(y - task.y) * AUR_TILE_SIZE + (x - task.x)];
            if (pixel->samples == 0)
                continue;
            double mean[3];
            aur_pixel_strata_mean(pixel, mean);
            aur_tile_add_mean(tile, x, y, tile->count, mean);
            if (plan->policy.adaptive)
                aur_tile_add_extra(tile, x, y, 0, (double)tile->count * (double)pixel->directions);
        }
    return true;
}

aur_result aur_gather_tile(const aur_gather_plan *plan, aur_tile *tile) {
    aur_gather_group *const group = aur_gather_group_create(plan);
    aur_pixel_strata *const strata = calloc(AUR_TILE_PIXELS, sizeof *strata);
    const bool good = group != NULL && strata != NULL && add_tile(plan, tile, group, strata);
    free(strata);
    aur_gather_group_destroy(group);
    return good ? AUR_OK : AUR_ERROR_MEMORY;
}
