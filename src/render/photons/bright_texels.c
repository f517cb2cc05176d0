#include "render/photons/bright_texels.h"

#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/error.h"

/* A texel is bright from this multiple of the mean radiance of the lit ones. */
static const double BRIGHTNESS = 2.0;

typedef struct patch_search {
    const aur_irradiance_map *map;
    aur_bright_texels *bright;
    double flux, area; /* of what is lit */
    size_t count, patch_capacity, weight_capacity;
    double *weights;
} patch_search;

/* Adds a patch of the area that is brighter than the threshold. */
static bool collect(patch_search *search, const aur_bright_patch *patch, double area, float radiance) {
    aur_bright_texels *const bright = search->bright;
    const float excess = radiance - bright->threshold;
    if (!(excess > 0.0f))
        return true;
    const size_t needed = search->count + 1;
    if (!aur_array_reserve(&bright->patches, &search->patch_capacity, needed, sizeof *bright->patches) ||
        !aur_array_reserve(&search->weights, &search->weight_capacity, needed, sizeof *search->weights))
        return false;
    bright->patches[search->count] = *patch;
    search->weights[search->count++] = area * (double)excess;
    return true;
}

/* Both sides of all texels of a triangle: measures what is lit, or collects what is bright. */
static bool visit_triangle(patch_search *search, aur_bright_patch patch, double triangle_area,
                           const aur_vector albedo_on_pi[2], bool collects) {
    const aur_texel_range range = search->map->texels.ranges[patch.element];
    const double area = triangle_area / ((double)range.side * (double)range.side);
    size_t light = 2 * (size_t)range.first;
    for (uint32_t row = 0; row < range.side; ++row)
        for (uint32_t k = 0; k < 2 * (2 * (range.side - row) - 1); ++k, ++light) {
            patch.row = (uint16_t)row;
            patch.column = (uint16_t)(k / 4);
            patch.upper = k / 2 % 2 == 1;
            patch.behind = k % 2 == 1;
            const aur_vector irradiance = search->map->lights[light].irradiance;
            const float radiance =
                aur_vector_max(aur_vector_multiply(albedo_on_pi[patch.behind], irradiance));
            if (collects && !collect(search, &patch, area, radiance))
                return false;
            if (!collects && radiance > 0.0f) {
                search->flux += area * (double)radiance;
                search->area += area;
            }
        }
    return true;
}

/* All plain triangles. False: out of memory. */
static bool visit_all(patch_search *search, const aur_scene *scene, const aur_shape_class *classes,
                      bool collects) {
    const aur_elements *const elements = &search->map->texels.elements;
    for (size_t i = 0; i < elements->placement_count; ++i) {
        const aur_placement *const placement = &elements->placements[i];
        const aur_shape_class *const class = &classes[placement->shape];
        if (placement->instance != AUR_NO_INSTANCE || !class->plain)
            continue;
        for (uint32_t k = 0; k < placement->count; ++k) {
            const aur_bright_patch patch = {
                .element = placement->first + k, .shape = placement->shape, .primitive = k};
            if (!visit_triangle(search, patch, aur_element_area(scene, placement, k), class->albedo_on_pi,
                                collects))
                return false;
        }
    }
    return true;
}

aur_result aur_bright_texels_create(const aur_scene *scene, const aur_irradiance_map *map,
                                    const aur_shape_class *classes, aur_bright_texels *bright,
                                    aur_error *error) {
    *bright = (aur_bright_texels){0};
    patch_search search = {.map = map, .bright = bright};
    visit_all(&search, scene, classes, false);
    bright->threshold = search.area > 0.0 ? (float)(BRIGHTNESS * search.flux / search.area) : 0.0f;
    const aur_result result =
        visit_all(&search, scene, classes, true)
            ? aur_distribution_create(&bright->distribution, search.count, search.weights, error)
            : aur_fail_memory(error);
    free(search.weights);
    if (result != AUR_OK)
        aur_bright_texels_release(bright);
    else if (bright->distribution.total > 0.0)
        bright->scale = (float)(1.0 / bright->distribution.total);
    return result;
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
                              .primitive = patch->primitive,
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
    point.rounding = aur_triangle_rounding(corner[0], corner[1], corner[2], normal);
    return point;
}
