/* The rendering step: hit points by Halton's sequence, each with a share of the lights and a hemisphere of
 * gather rays; pixels may share irradiance with their neighbours where these see the same triangle. */
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "render/radiosity/image.h"

enum { ROUND = 4, HALTON_DIMENSIONS = 4 };

/* One hit point. Its radiance towards the camera is rest + throughput * irradiance; the irradiance is
 * separate because pixels may share it. */
typedef struct hit_point {
    aur_vector rest;       /* emitted and directly reflected */
    aur_vector throughput; /* path to the camera, times albedo */
    aur_vector irradiance; /* over pi */
    uint32_t triangle;     /* hit first by the camera ray, with its side in the lowest bit; or AUR_NO_PATCH */
    float offset[2];       /* from the pixel's centre */
} hit_point;

typedef struct pixel_points {
    size_t count;
    hit_point *points;
} pixel_points;

typedef struct workspace {
    const aur_radiosity_image *image;
    const aur_view *view;
    uint32_t *order;                     /* the lights as the pixel's hit points take them */
    uint32_t first;                      /* hit point of the tile */
    double (*halton)[HALTON_DIMENSIONS]; /* of its hit points, before they are shifted */
} workspace;

/* A point of Halton's sequence, shifted for each pixel, so that no pattern repeats over the image. */
static void shift_point(const double point[HALTON_DIMENSIONS], uint64_t pixel, float u[HALTON_DIMENSIONS]) {
    for (uint32_t d = 0; d < HALTON_DIMENSIONS; ++d) {
        const double sum = point[d] + aur_unit_double(aur_hash3(pixel, 0x68616c, d));
        u[d] = fminf((float)(sum - floor(sum)), 0x1.fffffep-1f);
    }
}

static uint64_t pixel_hash(const workspace *work, size_t x, size_t y) {
    return aur_hash3(aur_hash2(work->image->seed, 0x706978656c), y, x);
}

static void camera_ray(const workspace *work, size_t x, size_t y, uint32_t index, float offset[2],
                       aur_ray *ray) {
    const aur_view *const view = work->view;
    if (work->image->oversampling == AUR_RADIOSITY_SAMPLER) {
        aur_camera_sample sample;
        aur_view_sample(view, x, y, index, &sample);
        *ray = sample.ray;
        memcpy(offset, sample.offset, sizeof sample.offset);
        return;
    }
    float u[HALTON_DIMENSIONS];
    shift_point(work->halton[index - work->first], pixel_hash(work, x, y), u);
    offset[0] = aur_filter_sample(view->filter, u[0]);
    offset[1] = aur_filter_sample(view->filter, u[1]);
    aur_camera_ray(view->scene, view->width, view->height, (float)x + 0.5f + offset[0],
                   (float)y + 0.5f + offset[1], &u[2], ray);
}

/* --- light at a hit point */

static aur_vector light_sample(const workspace *work, const aur_radiosity_surface_point *surface_point,
                               uint64_t pixel, size_t light, uint32_t index) {
    const uint32_t triangle = work->image->solution->walk.lights[light];
    if (triangle == surface_point->triangle)
        return (aur_vector){0};
    /* The R2 sequence, shifted for each pixel and light. */
    const uint64_t shift = aur_hash3(pixel, 0x6c69676874, light);
    const float u = aur_unit_float((uint32_t)shift + (index + 1) * 3242174889u);
    const float v = aur_unit_float((uint32_t)(shift >> 32) + (index + 1) * 2447445414u);
    return aur_radiosity_direct(&work->image->solution->scene, surface_point, triangle, u, v);
}

/* Light number p of the round's order is sampled at one hit point only, with weight `points`: over the round
 * every light is used once. The first point is random, because the first ones have one light more if the
 * number is not a multiple, and the last round may not cover the others. */
static aur_vector direct_light(const workspace *work, const aur_radiosity_surface_point *surface_point,
                               uint64_t pixel, uint32_t index, uint32_t points) {
    const bool permuted = work->image->permuted;
    aur_vector sum = {0};
    const uint64_t turn = aur_hash3(pixel, 0x7475726e, index / points) % points;
    for (size_t p = permuted ? (index + turn) % points : 0; p < work->image->solution->walk.light_count;
         p += permuted ? points : 1)
        sum = aur_vector_add(sum,
                             light_sample(work, surface_point, pixel, permuted ? work->order[p] : p, index));
    return permuted ? aur_vector_scale(sum, (float)points) : sum;
}

static bool includes_component(const workspace *work, aur_radiosity_component component) {
    return work->image->component == AUR_RADIOSITY_ALL || work->image->component == component;
}

/* Hit point `index`, one of `points` that divide the lights among them. */
static hit_point make_point(const workspace *work, size_t x, size_t y, uint32_t index, uint32_t points) {
    const uint64_t pixel = pixel_hash(work, x, y), hash = aur_hash2(pixel, index);
    const aur_radiosity_scene *const scene = &work->image->solution->scene;
    aur_ray ray;
    hit_point point = {.triangle = AUR_NO_PATCH};
    camera_ray(work, x, y, index, point.offset, &ray);
    aur_hit hit;
    aur_radiosity_surface_point surface_point;
    aur_vector path;
    if (!aur_scene_intersect(scene->scene, &ray, &hit) ||
        !aur_radiosity_see(scene, hash, ray, hit, &surface_point, &path))
        return point;
    point.triangle = surface_point.triangle << 1 | (surface_point.patch == surface_point.triangle);
    point.throughput = aur_vector_multiply(path, surface_point.albedo);
    if (includes_component(work, AUR_RADIOSITY_EMISSION))
        point.rest = aur_vector_multiply(path, surface_point.emission);
    if (aur_vector_is_zero(surface_point.albedo))
        return point;
    if (includes_component(work, AUR_RADIOSITY_DIRECT))
        point.rest = aur_vector_add(
            point.rest, aur_vector_multiply(path, direct_light(work, &surface_point, pixel, index, points)));
    if (includes_component(work, AUR_RADIOSITY_INDIRECT))
        point.irradiance = aur_radiosity_gather(work->image, &surface_point, aur_mix64(hash + 1));
    return point;
}

static aur_vector radiance_of(const hit_point *point, aur_vector irradiance) {
    return aur_vector_add(point->rest, aur_vector_multiply(point->throughput, irradiance));
}

/* --- pixels */

static bool is_steady(const pixel_points *p, float threshold) {
    float sums[2] = {0.0f, 0.0f};
    for (size_t i = 0; i < p->count; ++i) {
        const aur_vector l = radiance_of(&p->points[i], p->points[i].irradiance);
        sums[i + ROUND >= p->count] += l.x + l.y + l.z;
    }
    const float before = sums[0] / (float)(p->count - ROUND), now = (sums[0] + sums[1]) / (float)p->count;
    return fabsf(now - before) <= threshold * now;
}

/* Hit points first .. first + count - 1 of a pixel. They come in rounds that share out all lights, so that
 * more hit points see more of each. */
static void make_pixel(const workspace *work, size_t x, size_t y, uint32_t first, uint32_t count,
                       pixel_points *found) {
    const bool adaptive = work->image->oversampling == AUR_RADIOSITY_ADAPTIVE;
    const size_t samples = work->image->samples_per_pixel;
    const uint32_t points = samples < ROUND ? (uint32_t)samples : ROUND;
    found->count = 0;
    uint32_t round = UINT32_MAX;
    for (uint32_t i = first; i < first + count; ++i) {
        if (adaptive && i % ROUND == 0 && found->count >= 2 * ROUND &&
            is_steady(found, work->image->threshold))
            return;
        if (work->image->permuted && i / points != round) {
            round = i / points;
            for (uint32_t k = 0; k < work->image->solution->walk.light_count; ++k)
                work->order[k] = k;
            aur_shuffle(work->image->solution->walk.light_count, work->order,
                        aur_hash2(pixel_hash(work, x, y), round));
        }
        found->points[found->count++] = make_point(work, x, y, i, points);
    }
}

/* The pixels to compute: those of the tile, and a ring around them within the image if pixels share
 * irradiance. */
typedef struct area {
    size_t x0, y0, columns, rows;
    pixel_points *pixels;
} area;

static area area_of(const aur_tile *tile, bool shared) {
    const size_t rim = shared ? 1 : 0;
    const size_t x0 = tile->x0 > 0 ? tile->x0 - rim : 0, y0 = tile->y0 > 0 ? tile->y0 - rim : 0;
    const size_t x1 = tile->x1 < tile->view->width ? tile->x1 + rim : tile->x1;
    const size_t y1 = tile->y1 < tile->view->height ? tile->y1 + rim : tile->y1;
    return (area){x0, y0, x1 - x0, y1 - y0, NULL};
}

/* The mean irradiance of all hit points on one triangle in a pixel and its neighbours. */
static aur_vector pooled(const area *a, size_t column, size_t row, uint32_t triangle) {
    aur_vector sum = {0};
    size_t count = 0;
    for (size_t r = row > 0 ? row - 1 : 0; r < a->rows && r <= row + 1; ++r)
        for (size_t c = column > 0 ? column - 1 : 0; c < a->columns && c <= column + 1; ++c) {
            const pixel_points *const pixel = &a->pixels[r * a->columns + c];
            for (size_t i = 0; i < pixel->count; ++i)
                if (pixel->points[i].triangle == triangle) {
                    sum = aur_vector_add(sum, pixel->points[i].irradiance);
                    ++count;
                }
        }
    return aur_vector_scale(sum, 1.0f / (float)count);
}

static void add_pixel(aur_tile *tile, size_t x, size_t y, const area *a, bool shared) {
    const size_t column = x - a->x0, row = y - a->y0;
    const pixel_points *const pixel = &a->pixels[row * a->columns + column];
    uint32_t last = AUR_NO_PATCH;
    aur_vector irradiance = {0};
    for (size_t i = 0; i < pixel->count; ++i) {
        const hit_point *const point = &pixel->points[i];
        if (!shared)
            irradiance = point->irradiance;
        else if (point->triangle != AUR_NO_PATCH && point->triangle != last)
            irradiance = pooled(a, column, row, last = point->triangle);
        aur_tile_add_of(tile, x, y, pixel->count, point->offset, radiance_of(point, irradiance));
    }
}

static aur_result make_halton(uint64_t first, size_t count, double (*points)[HALTON_DIMENSIONS]) {
    const aur_pointset_options options = {
        .size = sizeof options, .count = first + count, .dimension = HALTON_DIMENSIONS};
    aur_pointset *set = NULL;
    aur_result result = aur_pointset_create("halton", &options, &set, NULL);
    if (result == AUR_OK)
        result = aur_pointset_points(set, first, count, HALTON_DIMENSIONS * count, points[0], NULL);
    aur_pointset_destroy(set);
    return result;
}

aur_result aur_radiosity_tile(const aur_integrator *integrator, aur_tile *tile) {
    const aur_radiosity_image *const image = integrator->data;
    const bool shared = image->share_neighbours;
    area a = area_of(tile, shared);
    const size_t pixel_count = a.columns * a.rows;
    a.pixels = malloc(pixel_count * sizeof *a.pixels);
    hit_point *const points = malloc(pixel_count * tile->count * sizeof *points + 1);
    uint32_t *const order = malloc((image->solution->walk.light_count + 1) * sizeof *order);
    double(*const halton)[HALTON_DIMENSIONS] = malloc(tile->count * sizeof *halton + 1);
    aur_result result =
        a.pixels != NULL && points != NULL && order != NULL && halton != NULL ? AUR_OK : AUR_ERROR_MEMORY;
    if (result == AUR_OK)
        result = make_halton(tile->first, tile->count, halton);
    if (result == AUR_OK) {
        const workspace work = {image, tile->view, order, tile->first, halton};
        for (size_t i = 0; i < pixel_count && result == AUR_OK; ++i) {
            a.pixels[i].points = points + i * tile->count;
            make_pixel(&work, a.x0 + i % a.columns, a.y0 + i / a.columns, tile->first, tile->count,
                       &a.pixels[i]);
            if (aur_tile_stops(tile))
                result = AUR_ERROR_CANCELLED;
        }
        for (size_t y = tile->y0; y < tile->y1 && result == AUR_OK; ++y)
            for (size_t x = tile->x0; x < tile->x1; ++x)
                add_pixel(tile, x, y, &a, shared);
    }
    free(a.pixels);
    free(points);
    free(order);
    free(halton);
    return result;
}
