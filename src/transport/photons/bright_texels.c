#include "transport/photons/bright_texels.h"

#include <stdlib.h>

#include "core/array.h"

/* A texel is bright from so many times the mean radiance of the lit ones on. */
static const double BRIGHTNESS = 2.0;

typedef struct patch_visit {
    aur_bright_patch patch;
    double area;
    float radiance;
} patch_visit;

typedef struct patch_search {
    const aur_scene *scene;
    const aur_irradiance_map *map;
    const aur_shape_class *classes;
    double flux, area; /* of what is lit */
    size_t count, patch_capacity, weight_capacity;
    double *weights;
    aur_bright_texels *bright;
} patch_search;

static aur_result measure(patch_search *search, const patch_visit *at) {
    if (!(at->radiance > 0.0f))
        return AUR_OK;
    search->flux += at->area * (double)at->radiance;
    search->area += at->area;
    return AUR_OK;
}

static aur_result collect(patch_search *search, const patch_visit *at) {
    const float excess = at->radiance - search->bright->threshold;
    if (!(excess > 0.0f))
        return AUR_OK;
    const size_t wanted = search->count + 1;
    if (!aur_array_reserve(&search->bright->patches, &search->patch_capacity, wanted,
                           sizeof *search->bright->patches) ||
        !aur_array_reserve(&search->weights, &search->weight_capacity, wanted, sizeof *search->weights))
        return AUR_ERROR_MEMORY;
    search->bright->patches[search->count] = at->patch;
    search->weights[search->count++] = at->area * (double)excess;
    return AUR_OK;
}

static aur_result visit_triangle(patch_search *search, patch_visit *at, double triangle_area,
                                 const aur_vector albedo_on_pi[2],
                                 aur_result (*visit)(patch_search *, const patch_visit *)) {
    const aur_texel_range range = search->map->texels.ranges[at->patch.element];
    at->area = triangle_area / ((double)range.side * (double)range.side);
    uint32_t texel = range.first;
    for (uint32_t row = 0; row < range.side; ++row)
        for (uint32_t k = 0; k < 2 * (range.side - row) - 1; ++k, ++texel) {
            at->patch.row = (uint16_t)row;
            at->patch.column = (uint16_t)(k / 2);
            at->patch.upper = k % 2 == 1;
            for (size_t side = 0; side < 2; ++side) {
                const aur_texel_light *const light = &search->map->lights[2 * (size_t)texel + side];
                at->patch.behind = side == 1;
                at->radiance = aur_vector_max(aur_vector_multiply(albedo_on_pi[side], light->irradiance));
                const aur_result result = visit(search, at);
                if (result != AUR_OK)
                    return result;
            }
        }
    return AUR_OK;
}

/* Calls `visit` for every side of every texel of plain triangles. */
static aur_result visit_all(patch_search *search, aur_result (*visit)(patch_search *, const patch_visit *)) {
    const aur_elements *const elements = &search->map->texels.elements;
    for (size_t i = 0; i < elements->placement_count; ++i) {
        const aur_placement *const placement = &elements->placements[i];
        const aur_shape_class *const class = &search->classes[placement->shape];
        if (placement->instance != AUR_NO_INSTANCE || !class->plain)
            continue;
        for (uint32_t k = 0; k < placement->count; ++k) {
            patch_visit at = {
                .patch = {.element = placement->first + k, .shape = placement->shape, .primitive = k}};
            const aur_result result = visit_triangle(
                search, &at, aur_element_area(search->scene, placement, k), class->albedo_on_pi, visit);
            if (result != AUR_OK)
                return result;
        }
    }
    return AUR_OK;
}

aur_result aur_bright_texels_create(const aur_scene *scene, const aur_irradiance_map *map,
                                    const aur_shape_class *classes, aur_bright_texels *bright,
                                    aur_error *error) {
    *bright = (aur_bright_texels){0};
    patch_search search = {.scene = scene, .map = map, .classes = classes, .bright = bright};
    visit_all(&search, measure);
    bright->threshold = search.area > 0.0 ? (float)(BRIGHTNESS * search.flux / search.area) : 0.0f;
    aur_result result = visit_all(&search, collect);
    if (result == AUR_OK)
        result = aur_distribution_create(&bright->distribution, search.count, search.weights, error);
    else
        aur_fail(error, result, "bright texels: %s", aur_result_string(result));
    free(search.weights);
    if (result != AUR_OK) {
        aur_bright_texels_release(bright);
        return result;
    }
    if (bright->distribution.total > 0.0)
        bright->scale = (float)(1.0 / bright->distribution.total);
    return AUR_OK;
}

void aur_bright_texels_release(aur_bright_texels *bright) {
    aur_distribution_release(&bright->distribution);
    free(bright->patches);
    *bright = (aur_bright_texels){0};
}

aur_bright_point aur_bright_texels_sample(const aur_bright_texels *bright, const aur_scene *scene,
                                          const aur_irradiance_map *map, double choice,
                                          const float position[2]) {
    const size_t index = aur_distribution_choose_double(&bright->distribution, &choice);
    const aur_bright_patch *const patch = &bright->patches[index];
    float a = position[0], b = position[1];
    if (a + b > 1.0f) {
        a = 1.0f - a;
        b = 1.0f - b;
    }
    if (patch->upper) {
        a = 1.0f - a;
        b = 1.0f - b;
    }
    const float side = (float)map->texels.ranges[patch->element].side;
    aur_bright_point point = {.element = patch->element,
                              .shape = patch->shape,
                              .u = ((float)patch->row + a) / side,
                              .v = ((float)patch->column + b) / side,
                              .behind = patch->behind};
    aur_vector corner[3];
    aur_shape_corners(scene, patch->shape, patch->primitive, corner);
    const aur_vector across = aur_vector_subtract(corner[1], corner[0]);
    const aur_vector along = aur_vector_subtract(corner[2], corner[0]);
    point.position = aur_vector_add_scaled(aur_vector_add_scaled(corner[0], point.u, across), point.v, along);
    const aur_vector normal = aur_vector_normalize(aur_vector_cross(across, along));
    point.normal = patch->behind ? aur_vector_scale(normal, -1.0f) : normal;
    return point;
}
