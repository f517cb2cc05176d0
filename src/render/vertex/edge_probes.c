
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/base/random.h"
#include "render/scene/elements.h"
#include "render/trace/packet.h"
#include "render/vertex/visible_emitters.h"

enum { MOST_PROBES = 256, LEAST_PROBES = 4 };

/* --- looking */

/* The first `count` rays through points of the film. */
static void make_rays(const aur_view *view, size_t count, const float *across, const float *down,
                      aur_packet *packet) {
    float lens[AUR_PACKET_SIZE];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        lens[k] = 0.5f;
    aur_camera_lanes rays;
    aur_camera_rays(view->scene, view->width, view->height, across, down, lens, lens, &rays);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_ray ray = {.origin = {rays.origin[0][k], rays.origin[1][k], rays.origin[2][k]},
                             .nearest = rays.nearest[k],
                             .direction = {rays.direction[0][k], rays.direction[1][k], rays.direction[2][k]},
                             .farthest = rays.farthest[k]};
        aur_packet_set(packet, k, &ray);
        packet->valid[k] = k < count ? -1 : 0;
    }
}

/* The camera rays of a pixel by the numbers of its stream from stream->index on. */
static void make_pixel_rays(const aur_view *view, const aur_stream *stream, size_t x, size_t y, size_t count,
                            float (*offsets)[2], aur_packet *packet) {
    float across[AUR_PACKET_SIZE], down[AUR_PACKET_SIZE];
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        float u[2] = {0.5f, 0.5f};
        const aur_stream local = {stream->sampler, stream->pixel, stream->index + (uint32_t)k};
        if (k < count)
            aur_stream_pair(&local, AUR_PAIR_FILTER, u);
        offsets[k][0] = aur_filter_sample(view->filter, u[0]);
        offsets[k][1] = aur_filter_sample(view->filter, u[1]);
        across[k] = (float)x + 0.5f + offsets[k][0];
        down[k] = (float)y + 0.5f + offsets[k][1];
    }
    make_rays(view, count, across, down, packet);
}

static aur_vector emission_at(const aur_scene *scene, const aur_packet *packet, size_t lane, bool hits) {
    const aur_ray ray = aur_packet_ray(packet, lane);
    if (!hits)
        return aur_scene_background(scene, ray.direction);
    const aur_hit hit = aur_packet_hit(scene, packet, lane);
    if (aur_shape_emitter(scene, hit.shape) == AUR_NO_EMITTER)
        return (aur_vector){0};
    aur_surface surface;
    aur_scene_surface(scene, &ray, &hit, &surface);
    return aur_surface_emission(scene, &surface, aur_vector_scale(ray.direction, -1.0f));
}

/* Sums over the `count` camera rays of a pixel. */
typedef struct probe_sums {
    double values[3], squares[3];
    size_t count;
    /* where pixels share samples: the tile to which `part` of each ray's hit is added; else NULL */
    aur_tile *tile;
    uint32_t index;
    float part;
} probe_sums;

static void trace_probes(const aur_view *view, const aur_stream *stream, size_t x, size_t y, size_t count,
                         probe_sums *sums) {
    aur_packet packet;
    aur_packet_clear(&packet);
    for (size_t first = 0; first < count; first += AUR_PACKET_SIZE) {
        const size_t rays = count - first < AUR_PACKET_SIZE ? count - first : AUR_PACKET_SIZE;
        float offsets[AUR_PACKET_SIZE][2];
        const aur_stream block = {stream->sampler, stream->pixel, stream->index + (uint32_t)first};
        make_pixel_rays(view, &block, x, y, rays, offsets, &packet);
        const uint32_t hits = aur_scene_intersect16(view->scene, AUR_EMBREE_COHERENT, &packet);
        for (size_t k = 0; k < rays; ++k) {
            double light[3];
            const aur_vector emission = emission_at(view->scene, &packet, k, (hits >> k & 1u) != 0);
            if (sums->tile != NULL)
                aur_tile_add_light(sums->tile, x, y, sums->index, offsets[k], sums->part, emission);
            aur_vector_to_doubles(emission, light);
            for (size_t c = 0; c < 3; ++c) {
                sums->values[c] += light[c];
                sums->squares[c] += light[c] * light[c];
            }
        }
    }
    sums->count += count;
}

/* After 2^32 points, more than all samples can use, another sequence follows. */
static aur_stream stream_of(const aur_edge_probes *probes, uint64_t pixel, uint64_t first) {
    return (aur_stream){probes->sampler, aur_hash3(UINT64_C(0x6c6f6f6b73), pixel, first >> 32),
                        (uint32_t)first};
}

bool aur_edge_probe(const aur_edge_probes *probes, aur_tile *tile, size_t x, size_t y, uint32_t index,
                    aur_vector *mean) {
    const aur_view *const view = tile->view;
    const size_t count = probes != NULL ? probes->counts[y * view->width + x] : 0;
    if (count == 0)
        return false;
    const aur_stream stream = stream_of(probes, aur_hash3(view->seed, y, x), (uint64_t)index * count);
    probe_sums sums = {.count = 0, .index = index, .part = 1.0f / (float)count};
    if (tile->spread != NULL)
        sums.tile = tile;
    trace_probes(view, &stream, x, y, count, &sums);
    if (tile->spread != NULL)
        *mean = (aur_vector){0};
    else
        *mean = (aur_vector){(float)(sums.values[0] / (double)count), (float)(sums.values[1] / (double)count),
                             (float)(sums.values[2] / (double)count)};
    return true;
}

/* --- where to send probe rays */

typedef struct survey {
    const aur_view *view;
    const aur_edge_probes *probes;
    const aur_visible_emitters *visible;
    size_t reach;      /* of the filter, and at least the eight neighbours of a pixel */
    bool spreads;      /* the filter reaches beyond its pixel */
    float *centres;    /* emitted radiance seen at the centre of each pixel, sum of R, G and B */
    float *deviations; /* of what they send to a sample of each */
} survey;

void aur_emission_at_centres(const aur_view *view, size_t count, const size_t *x, const size_t *y,
                             float *emission) {
    aur_packet packet;
    float across[AUR_PACKET_SIZE], down[AUR_PACKET_SIZE];
    aur_packet_clear(&packet);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        across[k] = (float)x[k < count ? k : 0] + 0.5f;
        down[k] = (float)y[k < count ? k : 0] + 0.5f;
    }
    make_rays(view, count, across, down, &packet);
    const uint32_t hits = aur_scene_intersect16(view->scene, AUR_EMBREE_COHERENT, &packet);
    for (size_t k = 0; k < count; ++k) {
        const aur_vector light = emission_at(view->scene, &packet, k, (hits >> k & 1u) != 0);
        emission[k] = light.x + light.y + light.z;
    }
}

static aur_result survey_centres(void *context, size_t row) {
    const survey *const s = context;
    for (size_t x0 = 0; x0 < s->view->width; x0 += AUR_PACKET_SIZE) {
        const size_t rest = s->view->width - x0, count = rest < AUR_PACKET_SIZE ? rest : AUR_PACKET_SIZE;
        size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
        for (size_t k = 0; k < count; ++k) {
            x[k] = x0 + k;
            y[k] = row;
        }
        aur_emission_at_centres(s->view, count, x, y, s->centres + row * s->view->width + x0);
    }
    return AUR_OK;
}

/* Whether an edge of an emitter may cross the pixel: its neighbours see more or less of an emitter, or points
 * of emitters lie in it; *variance is the largest of those that the filter may see. Where pixels share
 * samples, all pixels within reach of an edge have its error, because the weights of surrounding samples are
 * random. */
static bool is_near(const survey *s, size_t x, size_t y, double *variance) {
    const float similar = 0.9f;
    const double nearly_whole = 0.9, small = 0.25;
    const size_t width = s->view->width, height = s->view->height;
    float least = INFINITY, most = 0.0f;
    bool near = false;
    *variance = 0.0;
    for (size_t j = y > s->reach ? y - s->reach : 0; j <= y + s->reach && j < height; ++j)
        for (size_t i = x > s->reach ? x - s->reach : 0; i <= x + s->reach && i < width; ++i) {
            const size_t pixel = j * width + i;
            least = fminf(least, s->centres[pixel]);
            most = fmaxf(most, s->centres[pixel]);
            const double share = s->visible->share[pixel];
            near = near || (share > 0.0 && share < nearly_whole);
            /* of emitters so small that a few rays may miss them */
            if ((s->spreads || (i == x && j == y)) && share < small)
                *variance = fmax(*variance, s->visible->variance[pixel]);
        }
    const double part = 0.25, unlike = part * (double)(most - least);
    if (s->view->reach > 0)
        *variance = fmax(*variance, unlike * unlike);
    return near || least < similar * most;
}

static double variance_of(const probe_sums *sums) {
    const double n = (double)sums->count;
    double variance = 0.0;
    for (size_t c = 0; c < 3; ++c)
        variance += fmax(sums->squares[c] - sums->values[c] * sums->values[c] / n, 0.0) / (n - 1.0);
    return variance;
}

static double measured_variance(const survey *s, size_t x, size_t y) {
    enum { RAYS = 16 };
    const aur_stream stream = stream_of(s->probes, aur_hash3(UINT64_C(0x737572766579), y, x), 0);
    probe_sums sums = {.count = 0};
    trace_probes(s->view, &stream, x, y, RAYS, &sums);
    const double variance = variance_of(&sums);
    return isfinite(variance) ? variance : 0.0;
}

static aur_result survey_row(void *context, size_t y) {
    const survey *const s = context;
    for (size_t x = 0; x < s->view->width; ++x) {
        double expected;
        if (is_near(s, x, y, &expected))
            s->deviations[y * s->view->width + x] = (float)sqrt(fmax(expected, measured_variance(s, x, y)));
    }
    return AUR_OK;
}

/* Counts in proportion to deviations^4/5, to the next powers of two. Returns whether there are any. */
static bool share_out(size_t pixels, double rays, const float *deviations, uint16_t *counts) {
    double sum = 0.0;
    bool any = false;
    for (size_t i = 0; i < pixels; ++i)
        sum += pow((double)deviations[i], 0.8);
    for (size_t i = 0; i < pixels && sum > 0.0; ++i) {
        const double target = rays * (double)pixels * pow((double)deviations[i], 0.8) / sum;
        size_t count = LEAST_PROBES;
        while ((double)count * sqrt(2.0) < target && count < MOST_PROBES)
            count *= 2;
        counts[i] = target * sqrt(2.0) < (double)LEAST_PROBES ? 0 : (uint16_t)count;
        any = any || counts[i] > 0;
    }
    return any;
}

static void destroy(void *data) {
    aur_edge_probes *const probes = data;
    if (probes == NULL)
        return;
    aur_sampler_destroy(probes->sampler);
    free(probes->counts);
    free(probes);
}

static aur_result survey_image(const survey *s, const aur_integrator_context *context, aur_error *error) {
    const aur_parallel_options options = {
        .threads = context->threads, .what = "searching light edges", .flush_denormals = true};
    survey local = *s;
    aur_result result = aur_parallel_for(&options, s->view->height, survey_centres, &local, error);
    if (result == AUR_OK)
        result = aur_parallel_for(&options, s->view->height, survey_row, &local, error);
    return result;
}

static aur_result find(const aur_view *view, double rays, const aur_integrator_context *context,
                       aur_edge_probes *probes, aur_error *error) {
    const size_t pixels = view->width * view->height;
    const aur_film_layout layout = {
        .width = view->width, .height = view->height, .x1 = view->width, .y1 = view->height};
    aur_visible_emitters visible = {0};
    float *const deviations = calloc(pixels, sizeof *deviations), *const centres =
                                                                      calloc(pixels, sizeof *centres);
    aur_result result = deviations != NULL && centres != NULL
                            ? aur_sampler_create("sobol", 1, NULL, &probes->sampler, error)
                            : aur_fail_memory(error);
    if (result == AUR_OK)
        result =
            aur_visible_emitters_find(view->scene, &layout, aur_emitter_points(pixels), 0, &visible, error);
    if (result == AUR_OK && visible.share != NULL) {
        const float radius = -aur_filter_sample(view->filter, 0.0f);
        const size_t beyond = (size_t)ceilf(aur_larger(radius - 0.5f, 0.0f));
        const size_t about = view->reach > 0 ? view->reach + 1 : beyond > 0 ? beyond : 1;
        const survey all = {view,    probes,    &visible, about, beyond > 0 || view->reach > 0,
                            centres, deviations};
        result = survey_image(&all, context, error);
        probes->counts = calloc(pixels, sizeof *probes->counts);
        if (result == AUR_OK && probes->counts == NULL)
            result = aur_fail_memory(error);
        if (result == AUR_OK && !share_out(pixels, rays, deviations, probes->counts)) {
            free(probes->counts);
            probes->counts = NULL;
        }
    }
    aur_visible_emitters_release(&visible);
    free(deviations);
    free(centres);
    return result;
}

aur_result aur_edge_probes_find(const aur_view *view, double rays, const aur_integrator_context *context,
                                const aur_edge_probes **out, aur_error *error) {
    *out = NULL;
    if (!aur_visible_emitters_can_be_found(view))
        return AUR_OK;
    char key[160];
    snprintf(key, sizeof key, "looks %zu %zu %s %.9g %zu %.9g", view->width, view->height,
             aur_filter_name(view->filter), (double)aur_filter_sample(view->filter, 0.0f), view->reach, rays);
    aur_edge_probes *probes = aur_cache_find(context->cache, key);
    if (probes == NULL) {
        probes = calloc(1, sizeof *probes);
        if (probes == NULL)
            return aur_fail_memory(error);
        const uint64_t before = aur_rays_traced;
        aur_result result = find(view, rays, context, probes, error);
        if (result != AUR_OK) {
            destroy(probes);
            return result;
        }
        result = aur_cache_store(context->cache, key, probes, aur_rays_traced - before, destroy);
        if (result != AUR_OK)
            return result;
    }
    *out = probes->counts != NULL ? probes : NULL;
    return AUR_OK;
}
