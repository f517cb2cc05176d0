#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "render/film/spread.h"
#include "render/gather/estimators.h"
#include "render/gather/strata.h"
#include "render/trace/interleave.h"
#include "render/vertex/shading.h"

/* A stratum's sums in one pixel: weights of all samples that hit it, weights of the shaded ones, and those
 * times their radiance. */
typedef struct spread_cell {
    float seen, shaded, sum[3];
} spread_cell;

/* A sample that waits for a packet: those of surface_points. */
typedef struct waiting_sample {
    uint32_t group, index;
    uint16_t place;
} waiting_sample;

/* One tile, processed by sixteen samples at a time. */
typedef struct gather_tile {
    const aur_view *view;
    size_t x, y;                                            /* of the tile's corner in the image */
    size_t columns[AUR_PACKET_SIZE], rows[AUR_PACKET_SIZE]; /* of the pixels in the image */
    uint64_t arrangement;                                   /* of the tile's pixels in groups */
    bool chosen;   /* columns, rows and places are those of a group under this arrangement */
    bool only_new; /* shade only strata of which a pixel has no radiance yet */
    aur_gather_points surface_points;
    aur_gather_sums sums;
    size_t waiting_count;
    waiting_sample waiting[AUR_PACKET_SIZE];
    aur_camera_sample samples[AUR_PACKET_SIZE]; /* their rays are replaced at each specular bounce */
    spread_cell *cells; /* where pixels share samples: per stratum, for the pixels around; else NULL */
    const aur_spread *spread;
    aur_stratum *stratum[AUR_PACKET_SIZE]; /* that the lanes' samples belong to; NULL: none */
    aur_pixel_strata strata[AUR_TILE_PIXELS];
} gather_tile;

/* NULL when out of memory. */
static gather_tile *create(const aur_gather_plan *plan, const aur_tile *tile) {
    const aur_gather_rules *const rules = &plan->rules;
    /* Of a caller's method: for each direction of the diffuse pattern and of the largest glossy one. */
    size_t glossy = 0;
    for (size_t i = 1; i < rules->count; ++i)
        if (rules->lobes[i].rule.count > glossy)
            glossy = rules->lobes[i].rule.count;
    const size_t numbers =
        rules->method != NULL ? 3 * AUR_PACKET_SIZE * (rules->lobes[0].rule.count + glossy) : 0;
    gather_tile *const work = aligned_alloc(64, (sizeof *work + 63) / 64 * 64);
    if (work == NULL)
        return NULL;
    memset(work, 0, sizeof *work);
    aur_packet_clear(&work->sums.rays.packet);
    work->sums.numbers = calloc(numbers + 1, sizeof *work->sums.numbers);
    work->surface_points.plan = plan;
    work->view = tile->view;
    work->x = tile->x0 / AUR_TILE_SIZE * AUR_TILE_SIZE;
    work->y = tile->y0 / AUR_TILE_SIZE * AUR_TILE_SIZE;
    work->surface_points.tile = aur_hash2(work->y, work->x);
    work->surface_points.sampler = tile->view->sampler;
    work->spread = tile->spread;
    if (work->spread != NULL) {
        const size_t width = 2 * work->spread->reach + 1;
        work->cells = calloc(AUR_TILE_PIXELS * AUR_STRATUM_COUNT, width * width * sizeof *work->cells);
    }
    if (work->sums.numbers != NULL && (work->spread == NULL || work->cells != NULL))
        return work;
    free(work->sums.numbers);
    free(work->cells);
    free(work);
    return NULL;
}

/* --- one sample of sixteen pixels: what the camera sees, also by mirrors and through glass */

static aur_pixel_strata *pixel_of(gather_tile *work, size_t lane) {
    return &work->strata[work->surface_points.place[lane]];
}

static void set_lane(gather_tile *work, size_t lane, uint32_t group, size_t place) {
    work->surface_points.group[lane] = group;
    work->surface_points.place[lane] = (uint16_t)place;
    work->columns[lane] = work->x + place % AUR_TILE_SIZE;
    work->rows[lane] = work->y + place / AUR_TILE_SIZE;
}

/* Selects the pixels of a group for sample `index`. Samples that share a pattern use the same pixels. Pixels
 * that split a pattern keep a fixed arrangement. */
static void choose(gather_tile *work, uint32_t group, uint32_t index) {
    aur_gather_points *const surface_points = &work->surface_points;
    const aur_gather_plan *const plan = surface_points->plan;
    uint64_t arrangement = 0;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
        surface_points->index[lane] = index;
    if (plan->policy.share != AUR_SHARE_BLOCKS && plan->policy.decorrelation == AUR_DECORRELATION_BLUE)
        arrangement = aur_group_arrangement(
            aur_hash2(plan->seed, aur_gather_points_hash(surface_points, 0, surface_points->tile)));
    if (work->chosen && group == surface_points->group[0] && arrangement == work->arrangement)
        return;
    work->chosen = surface_points->grouped = true;
    work->arrangement = arrangement;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane)
        set_lane(work, lane, group, aur_group_pixel(arrangement, group, lane));
}

static void begin(gather_tile *work, uint32_t lanes) {
    aur_gather_points *const surface_points = &work->surface_points;
    aur_gather_sums *const sums = &work->sums;
    aur_view_samples(work->view, AUR_PACKET_SIZE, work->columns, work->rows, surface_points->index,
                     work->samples);
    surface_points->lanes = lanes;
    sums->pooled_lanes = 0;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        surface_points->pixels[lane] = work->samples[lane].stream.pixel;
        surface_points->throughput[lane] = (aur_vector){1.0f, 1.0f, 1.0f};
        sums->radiance[lane] = (aur_vector){0};
        sums->directions[lane] = 0;
        work->stratum[lane] = NULL;
    }
}

/* Traces the rays of all lanes; returns those that hit a surface. */
static uint32_t trace(gather_tile *work) {
    aur_packet *const packet = &work->sums.rays.packet;
    aur_packet_empty(packet);
    for (uint32_t rest = work->surface_points.lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_packet_set(packet, lane, &work->samples[lane].ray);
    }
    const aur_embree_order order =
        work->surface_points.bounces == 0 ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
    return aur_gather_intersect(work->surface_points.plan, order, packet);
}

static spread_cell *cells_of(const gather_tile *work, const aur_pixel_strata *pixel,
                             const aur_stratum *stratum) {
    const size_t width = 2 * work->spread->reach + 1;
    const size_t number =
        (size_t)(pixel - work->strata) * AUR_STRATUM_COUNT + (size_t)(stratum - pixel->strata);
    return work->cells + number * width * width;
}

/* Where pixels share samples: adds a lane's sample, which hit the stratum, to the surrounding pixels.
 * `radiance` is NULL if it was not shaded. */
static void weigh(gather_tile *work, size_t lane, const aur_stratum *stratum, const aur_vector *radiance) {
    const aur_spread *const spread = work->spread;
    if (spread == NULL)
        return;
    const size_t width = 2 * spread->reach + 1;
    spread_cell *const cells = cells_of(work, pixel_of(work, lane), stratum);
    float across[AUR_SPREAD_WIDTH_MAX], down[AUR_SPREAD_WIDTH_MAX];
    aur_spread_weights(spread, work->samples[lane].offset[0], across);
    aur_spread_weights(spread, work->samples[lane].offset[1], down);
    for (size_t j = 0; j < width; ++j)
        for (size_t i = 0; i < width; ++i) {
            spread_cell *const cell = &cells[j * width + i];
            const float weight = down[j] * across[i];
            cell->seen += weight;
            if (radiance == NULL)
                continue;
            cell->shaded += weight;
            cell->sum[0] += weight * radiance->x;
            cell->sum[1] += weight * radiance->y;
            cell->sum[2] += weight * radiance->z;
        }
}

/* Counts the camera rays' hits by stratum, and removes lanes that need no shading. */
static void count_hits(gather_tile *work, uint32_t found) {
    const aur_packet *const packet = &work->sums.rays.packet;
    for (uint32_t rest = work->surface_points.lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const uint64_t key = aur_has_lane(found, lane)
                                 ? aur_gather_surface_key(work->surface_points.plan->classes, packet, lane)
                                 : 0;
        bool exists;
        aur_stratum *const stratum = aur_pixel_strata_find(pixel_of(work, lane), key, &exists);
        stratum->seen += 1.0;
        if (work->only_new && exists && stratum->shaded > 0.0) {
            work->surface_points.lanes &= ~(1u << lane);
            weigh(work, lane, stratum, NULL);
        } else {
            work->stratum[lane] = stratum;
        }
    }
}

/* Adds the environment's radiance to lanes whose ray left the scene. */
static void add_sky(gather_tile *work, uint32_t lanes) {
    const aur_gather_plan *const plan = work->surface_points.plan;
    if (plan->policy.direct == AUR_DIRECT_NONE || !aur_scene_has_background(plan->scene))
        return;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_gather_add(&work->sums, &work->surface_points, lane,
                       aur_scene_background(plan->scene, work->samples[lane].ray.direction));
    }
}

/* Sets up the surfaces that the rays hit, and adds light that is not gathered: caustics and emission. */
static void set_points(gather_tile *work) {
    const aur_gather_plan *const plan = work->surface_points.plan;
    const aur_scene *const scene = plan->scene;
    const aur_irradiance_map *const caustics = plan->light.caustics;
    for (uint32_t rest = work->surface_points.lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        const aur_hit hit = aur_packet_hit(scene, &work->sums.rays.packet, lane);
        const aur_ray *const ray = &work->samples[lane].ray;
        const aur_surface *const surface = &work->surface_points.at[lane].surface;
        aur_gather_point_set(plan, ray, &hit, &work->surface_points.at[lane]);
        if (plan->policy.direct == AUR_DIRECT_NONE)
            continue;
        const aur_vector view = aur_vector_scale(ray->direction, -1.0f);
        if (caustics != NULL)
            aur_gather_add(&work->sums, &work->surface_points, lane,
                           aur_irradiance_view(caustics, scene, &hit, surface, view).radiance);
        if (surface->emitter != AUR_NO_EMITTER)
            aur_gather_add(&work->sums, &work->surface_points, lane,
                           aur_surface_emission(scene, surface, view));
    }
    work->surface_points.order = aur_gather_points_order(&work->surface_points);
}

/* Samples a lane's ray by a specular lobe; false if there is none, or it absorbs the light. */
static bool bounce_lane(gather_tile *work, size_t lane) {
    const aur_gather_point *const surface_point = &work->surface_points.at[lane];
    if ((aur_bsdf_scatters(surface_point->surface.bsdf, surface_point->view.z) & AUR_SCATTERS_SPECULAR) == 0)
        return false;
    const uint32_t pair = aur_gather_first_pair(work->surface_points.bounces);
    const aur_stream *const stream = &work->samples[lane].stream;
    float lobe[2], direction[2];
    aur_stream_pair(stream, pair + AUR_GATHER_PAIR_LOBE, lobe);
    aur_stream_pair(stream, pair + AUR_GATHER_PAIR_BOUNCE, direction);
    const aur_shading shading = {&surface_point->surface, surface_point->view};
    aur_bsdf_sample drawn;
    if (!aur_shading_sample(&shading, (const float[3]){lobe[0], direction[0], direction[1]}, &drawn) ||
        !drawn.specular)
        return false;
    aur_vector *const throughput = &work->surface_points.throughput[lane];
    *throughput = aur_vector_multiply(*throughput, drawn.weight);
    work->samples[lane].ray = aur_surface_ray(&surface_point->surface, drawn.light);
    return true;
}

/* Lanes whose surface has a specular lobe continue by it; the others are done. Other lobes have been gathered
 * already. */
static void bounce(gather_tile *work) {
    for (uint32_t rest = work->surface_points.lanes; rest != 0; rest &= rest - 1)
        if (!bounce_lane(work, aur_first_lane(rest)))
            work->surface_points.lanes &= ~(1u << aur_first_lane(rest));
}

/* Adds one sample of the selected pixels to their strata. */
static void add_samples(gather_tile *work, uint32_t lanes) {
    aur_gather_points *const surface_points = &work->surface_points;
    if (lanes == 0)
        return;
    begin(work, lanes);
    for (surface_points->bounces = 0;
         surface_points->bounces <= AUR_LONGEST_CHAIN && surface_points->lanes != 0;
         ++surface_points->bounces) {
        const uint32_t found = trace(work);
        if (surface_points->bounces == 0)
            count_hits(work, found);
        add_sky(work, surface_points->lanes & ~found);
        surface_points->lanes &= found;
        if (surface_points->lanes == 0)
            break;
        set_points(work);
        aur_gather_shade(surface_points, &work->sums);
        bounce(work);
    }
    work->sums.counters->cut += aur_lane_count(surface_points->lanes);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        aur_stratum *const stratum = work->stratum[lane];
        if (stratum != NULL && aur_pixel_strata_add(pixel_of(work, lane), stratum, &work->sums, lane))
            weigh(work, lane, stratum, &work->sums.radiance[lane]);
    }
}

/* --- packets of samples of several groups or indices, where a group has few at a time */

/* Fewer samples of a group at a time wait for others. */
enum { SPARSE = 8 };

/* Adds the waiting samples. */
static void add_waiting(gather_tile *work) {
    aur_gather_points *const surface_points = &work->surface_points;
    work->chosen = surface_points->grouped = false;
    for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
        const waiting_sample *const sample = &work->waiting[lane < work->waiting_count ? lane : 0];
        surface_points->index[lane] = sample->index;
        set_lane(work, lane, sample->group, sample->place);
    }
    add_samples(work, (1u << work->waiting_count) - 1);
    work->waiting_count = 0;
}

/* Lets samples of the chosen pixels wait until there are sixteen. */
static void queue_samples(gather_tile *work, uint32_t lanes) {
    const aur_gather_points *const surface_points = &work->surface_points;
    const uint32_t group = surface_points->group[0], index = surface_points->index[0];
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t lane = aur_first_lane(rest);
        work->waiting[work->waiting_count++] = (waiting_sample){group, index, surface_points->place[lane]};
        if (work->waiting_count < AUR_PACKET_SIZE)
            continue;
        add_waiting(work);
        choose(work, group, index);
    }
}

/* Adds samples of the chosen pixels; a pixel's samples that wait come first. */
static void add_group(gather_tile *work, uint32_t lanes) {
    const aur_gather_points *const surface_points = &work->surface_points;
    const uint32_t group = surface_points->group[0], index = surface_points->index[0];
    bool waits = false;
    for (size_t i = 0; i < work->waiting_count; ++i)
        for (uint32_t rest = lanes; rest != 0; rest &= rest - 1)
            waits = waits || surface_points->place[aur_first_lane(rest)] == work->waiting[i].place;
    if (waits) {
        add_waiting(work);
        choose(work, group, index);
    }
    add_samples(work, lanes);
}

/* --- the tile */

/* The rays at a light's edge for the first `samples` samples of a pixel. The variance of what a sequence of n
 * rays measures falls as n^(-3/2) (Owen 1997), the rest of the pixel's as one over its samples: it stays in
 * proportion. */
static double rays_at_edge(const aur_gather_plan *plan, uint32_t samples) {
    const double patterns = (double)samples / (double)plan->samples_per_pattern;
    return (double)plan->policy.edge_samples * cbrt(patterns * patterns);
}

/* The rays of a pixel at an edge that come with its samples of this step, as numbers in its sequence. Edges
 * that do not involve a light get a small part of them. */
typedef struct edge_rays {
    uint32_t begin, end;
} edge_rays;

static edge_rays find_edge_rays(const gather_tile *work, const aur_tile *tile, size_t pixel,
                                aur_gather_edge edge) {
    const double part = edge == AUR_LIGHT_EDGE ? 1.0 : 1.0 / 64, most = 0x1p30;
    const size_t x = work->x + pixel % AUR_TILE_SIZE, y = work->y + pixel / AUR_TILE_SIZE;
    edge_rays rays = {tile->first, tile->first + tile->count};
    if (edge == AUR_NO_EDGE)
        return (edge_rays){0, 0};
    if (tile->begins != NULL) {
        const size_t at = (y - tile->y0) * tile->stride + (x - tile->x0);
        rays.begin = tile->begins[at] > rays.begin ? tile->begins[at] : rays.begin;
        rays.end = tile->ends[at] < rays.end ? tile->ends[at] : rays.end;
    }
    const aur_gather_plan *const plan = work->surface_points.plan;
    rays.begin = (uint32_t)fmin(floor(part * nearbyint(rays_at_edge(plan, rays.begin))), most);
    rays.end = (uint32_t)fmin(floor(part * nearbyint(rays_at_edge(plan, rays.end))), most);
    return rays;
}

/* Samples that measure how much pixels see of the surfaces at an edge. Rounds continue a separate sequence of
 * them, so that none repeats what an earlier one measured; the first continues its samples' sequence. */
static aur_result refine_edges(gather_tile *work, aur_tile *tile, bool regroups) {
    const uint32_t origin = tile->begins != NULL || tile->first > 0 ? UINT32_C(1) << 31 : tile->count;
    aur_counters *const counters = work->sums.counters;
    const uint64_t before = aur_rays_traced;
    aur_gather_edge edges[AUR_TILE_PIXELS];
    edge_rays rays[AUR_TILE_PIXELS], all = {UINT32_MAX, 0};
    aur_gather_find_edges(work->surface_points.plan, work->view, work->x, work->y, work->strata,
                          tile->begins == NULL, edges);
    for (size_t pixel = 0; pixel < AUR_TILE_PIXELS; ++pixel) {
        rays[pixel] = find_edge_rays(work, tile, pixel, edges[pixel]);
        if (rays[pixel].begin >= rays[pixel].end)
            continue;
        all.begin = rays[pixel].begin < all.begin ? rays[pixel].begin : all.begin;
        all.end = rays[pixel].end > all.end ? rays[pixel].end : all.end;
    }
    work->only_new = true;
    for (uint32_t group = 0; group < AUR_GROUP_COUNT; ++group)
        for (uint32_t i = all.begin; i < all.end; ++i) {
            if (aur_tile_stops(tile))
                return AUR_ERROR_CANCELLED;
            choose(work, group, origin + i);
            uint32_t lanes = 0;
            for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
                const edge_rays *const own = &rays[work->surface_points.place[lane]];
                lanes |= (uint32_t)(i >= own->begin && i < own->end) << lane;
            }
            if (regroups)
                queue_samples(work, lanes);
            else
                add_samples(work, lanes);
        }
    add_waiting(work);
    counters->edge_rays += aur_rays_traced - before;
    return AUR_OK;
}

/* Packets cover the whole tile within the image, even if it is cropped: otherwise pixels would differ in the
 * last bits. */
static aur_result shade_tile(gather_tile *work, aur_tile *tile) {
    const aur_view *const view = work->view;
    const bool regroups = tile->begins != NULL && work->surface_points.plan->rules.method == NULL;
    for (uint32_t group = 0; group < AUR_GROUP_COUNT; ++group)
        for (uint32_t i = 0; i < tile->count; ++i) {
            if (aur_tile_stops(tile))
                return AUR_ERROR_CANCELLED;
            choose(work, group, tile->first + i);
            const uint32_t all =
                aur_group_lanes_within(work->columns, work->rows, 0, view->width, 0, view->height);
            const uint32_t lanes =
                aur_group_lanes_needed(tile, work->columns, work->rows, all, tile->first + i);
            if (regroups && aur_lane_count(lanes) < SPARSE)
                queue_samples(work, lanes);
            else
                add_group(work, lanes);
        }
    add_waiting(work);
    return work->surface_points.plan->policy.edge_samples > 0 ? refine_edges(work, tile, regroups) : AUR_OK;
}

/* A stratum's contribution to the pixels around, per sample of its pixel. Each shaded sample counts at its
 * position; those that were not shaded count by the mean of the others, which pooling may have changed. */
static void spread_stratum(const gather_tile *work, const aur_pixel_strata *pixel, const aur_stratum *stratum,
                           double *sums) {
    const aur_spread *const spread = work->spread;
    const bool near = work->surface_points.plan->policy.share == AUR_SHARE_NEAR;
    const size_t width = 2 * spread->reach + 1, channels = spread->channels;
    const spread_cell *const cells = cells_of(work, pixel, stratum);
    for (size_t k = 0; k < width * width; ++k) {
        const double seen = (double)cells[k].seen, shaded = (double)cells[k].shaded;
        double *const to = sums + k * channels;
        for (size_t c = 0; c < 3; ++c) {
            const double mean = stratum->sum[c] / stratum->shaded;
            const double single = stratum->single[c] / stratum->shaded;
            to[c] += (double)cells[k].sum[c] - shaded * single + seen * mean;
            if (near)
                to[3 + c] += seen * stratum->pool_adds[c] / stratum->shaded;
        }
        if (work->surface_points.plan->rules.whole)
            to[3] += seen * (double)pixel->directions;
        to[channels - 1] += seen;
    }
}

static void spread_pixel(const gather_tile *work, aur_tile *tile, size_t x, size_t y,
                         const aur_pixel_strata *pixel, double *sums) {
    const size_t width = 2 * work->spread->reach + 1, numbers = width * width * work->spread->channels;
    const uint32_t count = aur_tile_needed(tile, x, y);
    double seen = 0.0;
    memset(sums, 0, numbers * sizeof *sums);
    for (uint32_t i = 0; i < pixel->count; ++i) {
        if (pixel->strata[i].shaded == 0.0)
            continue;
        seen += pixel->strata[i].seen;
        spread_stratum(work, pixel, &pixel->strata[i], sums);
    }
    for (size_t k = 0; k < numbers && seen > 0.0; ++k)
        sums[k] *= (double)count / seen;
    if (seen > 0.0)
        aur_tile_add_sums(tile, x, y, count, sums);
}

static aur_result spread_means(const gather_tile *work, aur_tile *tile) {
    const size_t width = 2 * work->spread->reach + 1;
    double *const sums = malloc(width * width * work->spread->channels * sizeof *sums);
    if (sums == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x)
            spread_pixel(work, tile, x, y, &work->strata[(y - work->y) * AUR_TILE_SIZE + (x - work->x)],
                         sums);
    free(sums);
    return AUR_OK;
}

static void add_means(const gather_tile *work, aur_tile *tile) {
    const aur_gather_settings *const policy = &work->surface_points.plan->policy;
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x) {
            const aur_pixel_strata *const pixel =
                &work->strata[(y - work->y) * AUR_TILE_SIZE + (x - work->x)];
            if (pixel->samples == 0)
                continue;
            double mean[3];
            aur_pixel_strata_mean(pixel, mean);
            const uint32_t count = aur_tile_needed(tile, x, y);
            aur_tile_add_mean(tile, x, y, count, mean);
            if (policy->share == AUR_SHARE_NEAR) {
                double added[3];
                aur_pixel_strata_added(pixel, added);
                for (size_t c = 0; c < 3; ++c)
                    aur_tile_add_extra(tile, x, y, c, (double)count * added[c]);
            }
            if (work->surface_points.plan->rules.whole)
                aur_tile_add_extra(tile, x, y, 0, (double)count * (double)pixel->directions);
        }
}

aur_result aur_gather_tile(const aur_gather_plan *plan, aur_tile *tile) {
    gather_tile *const work = create(plan, tile);
    if (work == NULL)
        return AUR_ERROR_MEMORY;
    work->sums.counters = &tile->counters;
    work->sums.corrected = plan->continuation.share > 0.0f;
    aur_result result = shade_tile(work, tile);
    if (result == AUR_OK && plan->policy.share != AUR_SHARE_NONE &&
        !aur_gather_pool_irradiance(plan->policy.share == AUR_SHARE_NEAR, work->strata))
        result = AUR_ERROR_MEMORY;
    if (result == AUR_OK && work->spread != NULL)
        result = spread_means(work, tile);
    else if (result == AUR_OK)
        add_means(work, tile);
    free(work->cells);
    free(work->sums.numbers);
    free(work);
    return result;
}
