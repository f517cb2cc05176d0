#include <stdlib.h>

#include "render/gather/strata.h"

/* Pixels are pooled if their normals differ by less than 8 degrees from the normal of the first pixel seen of
 * a surface, and they lie near its plane. */
static const float LEAST_AGREEMENT = 0.99f;
static const float MOST_ELEVATION_SQUARED = 0.01f;

enum { SIDE = AUR_TILE_SIZE, REACH = AUR_GROUPS_A_SIDE / 2, WINDOW = AUR_GROUPS_A_SIDE + 1 };
enum { NO_SURFACE = -1 };

/* One surface of the tile. */
typedef struct pooled_surface {
    uint64_t key;
    aur_vector position, normal; /* where it was first hit */
} pooled_surface;

typedef struct pooled_tile {
    aur_pixel_strata *strata;
    bool near; /* pools are of the nearest pixels */
    size_t surface_count;
    pooled_surface surfaces[AUR_TILE_PIXELS * AUR_STRATUM_COUNT];
    int surface_of[AUR_TILE_PIXELS][AUR_STRATUM_COUNT];
} pooled_tile;

static bool lies_on(const pooled_surface *surface, const aur_stratum *stratum) {
    if (surface->key != stratum->key)
        return false;
    const aur_vector sum = stratum->pooled.normal; /* not of unit length */
    const float cosine = aur_vector_dot(sum, surface->normal);
    if (cosine < 0.0f || cosine * cosine < LEAST_AGREEMENT * LEAST_AGREEMENT * aur_vector_dot(sum, sum))
        return false;
    const aur_vector position = aur_vector_scale(stratum->pooled.position, 1.0f / stratum->gathers);
    const aur_vector offset = aur_vector_subtract(position, surface->position);
    const float height = aur_vector_dot(offset, surface->normal);
    return height * height <= MOST_ELEVATION_SQUARED * aur_vector_dot(offset, offset);
}

static int find_surface(pooled_tile *tile, const aur_stratum *stratum) {
    for (size_t i = tile->surface_count; i-- > 0;)
        if (lies_on(&tile->surfaces[i], stratum))
            return (int)i;
    tile->surfaces[tile->surface_count] =
        (pooled_surface){.key = stratum->key,
                         .position = aur_vector_scale(stratum->pooled.position, 1.0f / stratum->gathers),
                         .normal = aur_vector_normalize(stratum->pooled.normal)};
    return (int)tile->surface_count++;
}

static void find_surfaces(pooled_tile *tile) {
    for (size_t pixel = 0; pixel < AUR_TILE_PIXELS; ++pixel)
        for (uint32_t k = 0; k < tile->strata[pixel].count; ++k) {
            const aur_stratum *const stratum = &tile->strata[pixel].strata[k];
            tile->surface_of[pixel][k] = stratum->gathers > 0.0f ? find_surface(tile, stratum) : NO_SURFACE;
        }
}

/* Along one axis: the first pixel of a pixel's window, and the weights of the window's pixels. */
static size_t set_window(size_t at, float weights[WINDOW]) {
    const bool inside = at >= REACH && at + REACH < SIDE;
    for (size_t i = 0; i < WINDOW; ++i)
        weights[i] = i > 0 && i + 1 < WINDOW ? 1.0f : 0.5f;
    if (inside)
        return at - REACH;
    weights[0] = 1.0f;
    weights[WINDOW - 1] = 0.0f;
    return at < REACH ? 0 : SIDE - AUR_GROUPS_A_SIDE;
}

/* The same for a window of three pixels. The neighbours' weight was chosen by measurement. A larger weight
 * lowers the error of single pixels further but not that of means over 8 x 8 pixels, which would exceed that
 * of independent errors by more than 1.5. At the tile's first pixel the window begins at -1, where the weight
 * is 0. */
static size_t set_near_window(size_t at, float weights[WINDOW]) {
    const float neighbour = 0.16f;
    for (size_t i = 0; i < WINDOW; ++i)
        weights[i] = 0.0f;
    weights[0] = at > 0 ? neighbour : 0.0f;
    weights[1] = 1.0f;
    weights[2] = at + 1 < SIDE ? neighbour : 0.0f;
    return at - 1;
}

/* The mean irradiance of a surface over the window of a pixel. */
static aur_vector pooled_irradiance(const pooled_tile *tile, size_t x, size_t y, int surface) {
    float across[WINDOW], down[WINDOW];
    const size_t left = tile->near ? set_near_window(x, across) : set_window(x, across);
    const size_t top = tile->near ? set_near_window(y, down) : set_window(y, down);
    aur_vector sum = {0};
    float gathers = 0.0f;
    for (size_t i = 0; i < WINDOW * WINDOW; ++i) {
        const float weight = across[i % WINDOW] * down[i / WINDOW];
        if (!(weight > 0.0f))
            continue;
        const size_t pixel = (top + i / WINDOW) * SIDE + left + i % WINDOW;
        const aur_pixel_strata *const other = &tile->strata[pixel];
        for (uint32_t k = 0; k < other->count; ++k) {
            if (tile->surface_of[pixel][k] != surface)
                continue;
            sum = aur_vector_add_scaled(sum, weight, other->strata[k].pooled.irradiance);
            gathers += weight * other->strata[k].gathers;
        }
    }
    return aur_vector_scale(sum, 1.0f / gathers);
}

bool aur_gather_pool_irradiance(bool near, aur_pixel_strata *strata) {
    pooled_tile *const tile = malloc(sizeof *tile);
    if (tile == NULL)
        return false;
    tile->strata = strata;
    tile->near = near;
    tile->surface_count = 0;
    find_surfaces(tile);
    for (size_t pixel = 0; pixel < AUR_TILE_PIXELS; ++pixel)
        for (uint32_t k = 0; k < strata[pixel].count; ++k) {
            const int surface = tile->surface_of[pixel][k];
            if (surface == NO_SURFACE)
                continue;
            aur_stratum *const stratum_at = &strata[pixel].strata[k];
            const aur_vector mean = pooled_irradiance(tile, pixel % SIDE, pixel / SIDE, surface);
            const aur_vector light = aur_vector_multiply(stratum_at->pooled.coefficient, mean);
            stratum_at->sum[0] += (double)light.x;
            stratum_at->sum[1] += (double)light.y;
            stratum_at->sum[2] += (double)light.z;
            stratum_at->pool_adds[0] += (double)light.x;
            stratum_at->pool_adds[1] += (double)light.y;
            stratum_at->pool_adds[2] += (double)light.z;
        }
    free(tile);
    return true;
}
