#include "render/vertex/visible_emitters.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/random.h"

/* Expected hits of an emitter from which the variance between replicas is trusted: with eight, a count varies
 * by a third. */
enum { ENOUGH = 8 };

static float number(uint64_t seed, size_t point, uint64_t dimension) {
    return (float)(aur_hash3(seed, point, dimension) >> 40) * 0x1p-24f;
}

/* A point of an emitter that the camera sees, and its position in the image. */
typedef struct visible_point {
    aur_light_sample light;
    aur_film_point film;
} visible_point;

static bool draw(const aur_scene *scene, const aur_film_layout *layout, uint64_t seed, size_t i, float choice,
                 visible_point *point) {
    const float u[3] = {choice, number(seed, i, 1), number(seed, i, 2)};
    const aur_vector camera = aur_camera_position(scene);
    const aur_light_reference reference = {.position = camera};
    aur_light_sample *const light = &point->light;
    if (!aur_light_sample_direct(scene, &reference, u, light) || light->delta ||
        aur_vector_is_zero(light->radiance) ||
        !aur_camera_see(scene, layout->width, layout->height, light->direction, &point->film))
        return false;
    const float x = point->film.x, y = point->film.y;
    if (!(x >= (float)layout->x0 && x < (float)layout->x1 && y >= (float)layout->y0 && y < (float)layout->y1))
        return false;
    const aur_ray ray = aur_ray_between(camera, light->position);
    return !aur_scene_occluded(scene, &ray);
}

size_t aur_emitter_points(size_t pixels) {
    const size_t eighth = pixels / 8, most = (size_t)1 << 16;
    return eighth < AUR_EMITTER_POINTS ? AUR_EMITTER_POINTS : eighth < most ? eighth : most;
}

/* Sums over the points that lie in a pixel, of weights that are parts of it. */
typedef struct pixel_sums {
    double radiance[3];
    double squares;          /* of the radiance, R, G and B together */
    double weighted_squares; /* with the weight once more */
} pixel_sums;

static double square_mean_of(const pixel_sums *sums) {
    double sum = 0.0;
    for (size_t c = 0; c < 3; ++c)
        sum += sums->radiance[c] * sums->radiance[c];
    return sum;
}

/* Whether values differ much within the pixel, by emitters sampled densely enough to be sure. */
static bool has_edge(const pixel_sums *sums, double variance) {
    const double finest = 1.0 / 64, least_contrast = 0.1; /* of an emitter that covers .9 of the pixel */
    return variance > least_contrast * square_mean_of(sums) &&
           sums->weighted_squares <= finest * sums->squares;
}

static void add_point(const visible_point *point, double weight, pixel_sums *sums) {
    double radiance[3];
    aur_vector_to_doubles(point->light.radiance, radiance);
    for (size_t c = 0; c < 3; ++c) {
        sums->radiance[c] += weight * radiance[c];
        sums->squares += weight * radiance[c] * radiance[c];
        sums->weighted_squares += weight * weight * radiance[c] * radiance[c];
    }
}

bool aur_visible_emitters_can_be_found(const aur_view *view) {
    const size_t most_pixels = (size_t)1 << 24;
    return !view->pixel_centre && aur_camera_is_pinhole(view->scene) &&
           aur_scene_emitter_count(view->scene) > 0 && view->height <= most_pixels / view->width;
}

aur_result aur_visible_emitters_find(const aur_scene *scene, const aur_film_layout *layout, size_t points,
                                     uint64_t seed, aur_visible_emitters *visible, aur_error *error) {
    const size_t width = layout->x1 - layout->x0, pixels = width * (layout->y1 - layout->y0);
    *visible = (aur_visible_emitters){0};
    if (!aur_camera_is_pinhole(scene))
        return AUR_OK;
    pixel_sums *const sums = calloc(pixels, sizeof *sums);
    visible->share = calloc(pixels, sizeof *visible->share);
    visible->variance = calloc(pixels, sizeof *visible->variance);
    visible->edges = calloc(pixels, sizeof *visible->edges);
    if (sums == NULL || visible->share == NULL || visible->variance == NULL || visible->edges == NULL) {
        free(sums);
        return aur_fail_memory(error);
    }
    const uint64_t stream_seed = aur_hash2(UINT64_C(0x6c616d7073), seed);
    for (size_t i = 0; i < points; ++i) {
        visible_point point;
        const float choice = ((float)i + number(stream_seed, i, 0)) / (float)points;
        if (!draw(scene, layout, stream_seed, i, aur_smaller(choice, 1.0f - 0x1p-24f), &point))
            continue;
        const size_t pixel = ((size_t)point.film.y - layout->y0) * width + (size_t)point.film.x - layout->x0;
        const double weight =
            1.0 / ((double)point.light.pdf * (double)point.film.solid_angle * (double)points);
        add_point(&point, weight, &sums[pixel]);
    }
    for (size_t i = 0; i < pixels; ++i) {
        const double square_mean = square_mean_of(&sums[i]), variance = sums[i].squares - square_mean;
        visible->share[i] = sums[i].squares > 0.0 ? square_mean / sums[i].squares : 0.0;
        visible->variance[i] = fmax(variance, 0.0);
        visible->edges[i] = has_edge(&sums[i], variance);
    }
    free(sums);
    return AUR_OK;
}

/* The largest fraction of one of the eight neighbouring pixels that sees emitters. */
static double neighbour_share(const aur_visible_emitters *visible, size_t width, size_t height,
                              size_t pixel) {
    const size_t x = pixel % width, y = pixel / width;
    double most = 0.0;
    for (size_t j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; ++j)
        for (size_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; ++i)
            if (j * width + i != pixel)
                most = fmax(most, visible->share[j * width + i]);
    return most;
}

void aur_visible_emitters_leave_edges(const aur_film_layout *layout, aur_visible_emitters *visible) {
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    if (visible->share == NULL)
        return;
    for (size_t i = 0; i < width * height; ++i)
        if (neighbour_share(visible, width, height, i) >= 0.5)
            visible->variance[i] = 0.0;
}

void aur_visible_emitters_take_probes(const aur_film_layout *layout, const uint16_t *probes,
                                      aur_visible_emitters *visible) {
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    if (visible->share == NULL || probes == NULL)
        return;
    for (size_t i = 0; i < width * height; ++i) {
        const size_t x = layout->x0 + i % width, y = layout->y0 + i / width;
        const double count = fmax(probes[y * layout->width + x], 1.0);
        visible->share[i] *= count;
        visible->variance[i] /= count;
    }
}

void aur_visible_emitters_release(aur_visible_emitters *visible) {
    free(visible->share);
    free(visible->variance);
    free(visible->edges);
    *visible = (aur_visible_emitters){0};
}

double aur_visible_emitters_variance(const aur_visible_emitters *visible, size_t pixel, uint32_t samples) {
    if (visible->share == NULL || !(visible->share[pixel] * samples < ENOUGH))
        return 0.0;
    return visible->variance[pixel] / samples;
}
