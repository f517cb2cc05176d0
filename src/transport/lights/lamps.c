#include "transport/lights/lamps.h"

#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "core/random.h"

/* Times that a lamp is to be met before what replicas say of a pixel is believed: at eight a count varies by
 * a third. */
enum { ENOUGH = 8 };

static float number(uint64_t seed, size_t point, uint64_t dimension) {
    return (float)(aur_hash3(seed, point, dimension) >> 40) * 0x1p-24f;
}

/* A point of a lamp that the camera sees, and where in the picture. */
typedef struct seen_point {
    aur_light_sample light;
    aur_film_point film;
} seen_point;

static bool draw(const aur_scene *scene, const aur_film_layout *layout, uint64_t seed, size_t i, float choice,
                 seen_point *point) {
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
    const aur_ray ray = {camera, 0.0f, light->direction, light->distance * (1.0f - 1e-4f)};
    return !aur_scene_occluded(scene, &ray);
}

aur_result aur_lamps_find(const aur_scene *scene, const aur_film_layout *layout, size_t points, uint64_t seed,
                          aur_lamps *lamps, aur_error *error) {
    const size_t width = layout->x1 - layout->x0, pixels = width * (layout->y1 - layout->y0);
    *lamps = (aur_lamps){0};
    if (!aur_camera_is_pinhole(scene))
        return AUR_OK;
    double(*const means)[3] = calloc(pixels, sizeof *means);
    lamps->share = calloc(pixels, sizeof *lamps->share);
    lamps->variance = calloc(pixels, sizeof *lamps->variance);
    if (means == NULL || lamps->share == NULL || lamps->variance == NULL) {
        free(means);
        return aur_fail_memory(error);
    }
    const uint64_t own = aur_hash2(UINT64_C(0x6c616d7073), seed);
    for (size_t i = 0; i < points; ++i) {
        seen_point point;
        const float choice = ((float)i + number(own, i, 0)) / (float)points;
        if (!draw(scene, layout, own, i, aur_smaller(choice, 1.0f - 0x1p-24f), &point))
            continue;
        const size_t pixel = ((size_t)point.film.y - layout->y0) * width + (size_t)point.film.x - layout->x0;
        const double weight =
            1.0 / ((double)point.light.pdf * (double)point.film.solid_angle * (double)points);
        double radiance[3];
        aur_vector_to_doubles(point.light.radiance, radiance);
        lamps->share[pixel] += weight;
        for (size_t c = 0; c < 3; ++c) {
            means[pixel][c] += weight * radiance[c];
            lamps->variance[pixel] += weight * radiance[c] * radiance[c];
        }
    }
    for (size_t i = 0; i < pixels; ++i) {
        for (size_t c = 0; c < 3; ++c)
            lamps->variance[i] -= means[i][c] * means[i][c];
        lamps->variance[i] = fmax(lamps->variance[i], 0.0);
    }
    free(means);
    return AUR_OK;
}

/* The part of the eight pixels about one that sees lamps, where it is largest. */
static double share_beside(const aur_lamps *lamps, size_t width, size_t height, size_t pixel) {
    const size_t x = pixel % width, y = pixel / width;
    double most = 0.0;
    for (size_t j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; ++j)
        for (size_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; ++i)
            if (j * width + i != pixel)
                most = fmax(most, lamps->share[j * width + i]);
    return most;
}

void aur_lamps_leave_edges(const aur_film_layout *layout, aur_lamps *lamps) {
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    if (lamps->share == NULL)
        return;
    for (size_t i = 0; i < width * height; ++i)
        if (share_beside(lamps, width, height, i) >= 0.5)
            lamps->variance[i] = 0.0;
}

void aur_lamps_take_looks(const aur_film_layout *layout, const uint16_t *looks, aur_lamps *lamps) {
    const size_t width = layout->x1 - layout->x0, height = layout->y1 - layout->y0;
    if (lamps->share == NULL || looks == NULL)
        return;
    for (size_t i = 0; i < width * height; ++i) {
        const size_t x = layout->x0 + i % width, y = layout->y0 + i / width;
        const double count = fmax(looks[y * layout->width + x], 1.0);
        lamps->share[i] *= count;
        lamps->variance[i] /= count;
    }
}

void aur_lamps_release(aur_lamps *lamps) {
    free(lamps->share);
    free(lamps->variance);
    *lamps = (aur_lamps){0};
}

double aur_lamps_variance(const aur_lamps *lamps, size_t pixel, uint32_t samples) {
    if (lamps->share == NULL || !(lamps->share[pixel] * samples < ENOUGH))
        return 0.0;
    return lamps->variance[pixel] / samples;
}
