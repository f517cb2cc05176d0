#include "render/photons/irradiance.h"

#include <stdlib.h>

#include "render/vertex/shading.h"

static uint32_t texel_of(const aur_texels *texels, bool curved, uint32_t element,
                         const float coordinates[2]) {
    const aur_texel_range range = texels->ranges[element];
    return curved ? aur_texel_of_square(range, coordinates[0], coordinates[1])
                  : aur_texel_of_triangle(range, coordinates[0], coordinates[1]);
}

/* Which light every photon adds to. */
static void find_lights(const aur_irradiance_map *map, const aur_photon_map *photons, uint32_t *lights) {
    for (size_t i = 0; i < photons->count; ++i) {
        const aur_photon *const photon = &photons->photons[i];
        const uint32_t texel = texel_of(&map->texels, photon->curved, photon->element, photon->coordinates);
        lights[i] = 2 * texel + (photon->behind ? 1 : 0);
    }
}

/* In the photons' order, whatever the threads. */
static void add_power(aur_irradiance_map *map, const aur_photon_map *photons, const uint32_t *lights) {
    for (size_t i = 0; i < photons->count; ++i) {
        aur_texel_light *const light = &map->lights[lights[i]];
        light->irradiance = aur_vector_add(light->irradiance, photons->photons[i].power);
    }
    for (size_t i = 0; i < 2 * map->texels.count; ++i) {
        aur_texel_light *const light = &map->lights[i];
        light->area = map->texels.areas[i / 2];
        const float scale = light->area > 0.0f ? 1.0f / light->area : 0.0f;
        light->irradiance = aur_vector_scale(light->irradiance, scale);
    }
}

/* Sorts the photons of glossy surfaces by light, in stable order. */
static aur_result collect_members(aur_irradiance_map *map, const aur_photon_map *photons,
                                  const uint32_t *lights) {
    size_t count = 0;
    for (size_t i = 0; i < photons->count; ++i)
        count += photons->photons[i].glossy ? 1 : 0;
    if (count == 0)
        return AUR_OK;
    const size_t light_count = 2 * map->texels.count;
    map->member_first = calloc(light_count + 2, sizeof *map->member_first);
    map->members = malloc(count * sizeof *map->members);
    if (map->member_first == NULL || map->members == NULL)
        return AUR_ERROR_MEMORY;
    /* Counted two positions ahead, so that filling leaves each start at its index. */
    uint32_t *const next = map->member_first + 1;
    for (size_t i = 0; i < photons->count; ++i)
        if (photons->photons[i].glossy)
            ++next[lights[i] + 1];
    for (size_t i = 1; i <= light_count; ++i)
        next[i] += next[i - 1];
    for (size_t i = 0; i < photons->count; ++i) {
        const aur_photon *const photon = &photons->photons[i];
        if (photon->glossy)
            map->members[next[lights[i]]++] = (aur_incident_photon){photon->direction, photon->power};
    }
    return AUR_OK;
}

/* Takes the elements over. */
static aur_result fill(aur_irradiance_map *map, const aur_scene *scene, aur_elements elements,
                       const aur_photon_map *photons, double photons_a_texel) {
    /* Photons of each element, and later the light of each photon. */
    uint32_t *const numbers =
        calloc((elements.count > photons->count ? elements.count : photons->count) + 1, sizeof *numbers);
    if (numbers == NULL) {
        aur_elements_release(&elements);
        return AUR_ERROR_MEMORY;
    }
    for (size_t i = 0; i < photons->count; ++i)
        ++numbers[photons->photons[i].element];
    aur_result result = aur_texels_create(scene, elements, numbers, photons_a_texel, &map->texels);
    if (result == AUR_OK)
        map->lights = calloc(2 * map->texels.count + 1, sizeof *map->lights);
    if (result == AUR_OK && map->lights == NULL)
        result = AUR_ERROR_MEMORY;
    if (result == AUR_OK) {
        find_lights(map, photons, numbers);
        add_power(map, photons, numbers);
        result = collect_members(map, photons, numbers);
    }
    free(numbers);
    return result;
}

aur_result aur_irradiance_map_create(const aur_scene *scene, const aur_irradiance_map_options *options,
                                     aur_irradiance_map **out, aur_error *error) {
    *out = NULL;
    aur_elements elements;
    aur_photon_map photons;
    aur_result result = aur_elements_create(scene, &elements);
    if (result != AUR_OK)
        return aur_fail(error, result, "photon map: %s", aur_result_string(result));
    result = aur_photon_map_create(scene, &elements, &options->photons, &photons, error);
    if (result != AUR_OK) {
        aur_elements_release(&elements);
        return result;
    }
    aur_irradiance_map *const map = calloc(1, sizeof *map);
    if (map == NULL) {
        aur_elements_release(&elements);
        result = AUR_ERROR_MEMORY;
    } else {
        *map = (aur_irradiance_map){
            .photons = photons.count, .paths = photons.paths, .rays = photons.rays, .cut = photons.cut};
        result = fill(map, scene, elements, &photons, options->photons_a_texel);
    }
    aur_photon_map_release(&photons);
    if (result == AUR_OK) {
        *out = map;
        return AUR_OK;
    }
    aur_irradiance_map_destroy(map);
    return aur_fail(error, result, "photon map: %s",
                    result == AUR_ERROR_ARGUMENT
                        ? "more texels than 32-bit numbers can name; use fewer photons"
                        : aur_result_string(result));
}

void aur_irradiance_map_destroy(aur_irradiance_map *map) {
    if (map == NULL)
        return;
    aur_texels_release(&map->texels);
    free(map->lights);
    free(map->member_first);
    free(map->members);
    free(map);
}

/* The glossy lobes with a formula, and the cosines about their axes under which cos^exponent is less than
 * 1e-6. */
typedef struct glossy_lobes {
    size_t count;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    float least[AUR_BSDF_LOBE_CAPACITY];
} glossy_lobes;

static void glossy_lobes_at(const aur_surface *surface, aur_vector view, glossy_lobes *all) {
    const size_t count = aur_bsdf_lobes(surface->bsdf, surface->texture, view, all->lobes);
    all->count = 0;
    for (size_t i = 0; i < count; ++i) {
        const aur_bsdf_lobe *const lobe = &all->lobes[i];
        if (lobe->diffuse || lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER ||
            aur_vector_is_zero(lobe->coefficient))
            continue;
        all->least[all->count] = expf(-13.8155f / fmaxf(lobe->exponent, 1e-3f));
        all->lobes[all->count++] = *lobe;
    }
}

static aur_vector glossy_value(const glossy_lobes *all, aur_vector light) {
    aur_vector sum = {0};
    for (size_t i = 0; i < all->count; ++i)
        if (aur_vector_dot(all->lobes[i].axis, light) > all->least[i])
            sum = aur_vector_add(sum, aur_lobe_value(&all->lobes[i], light));
    return sum;
}

/* The glossy lobes' share: a density estimate over the texel's photons. */
static aur_vector glossy_radiance(const aur_irradiance_map *map, size_t light_index,
                                  const aur_surface *surface, const glossy_lobes *lobes) {
    aur_vector sum = {0};
    for (uint32_t i = map->member_first[light_index]; i < map->member_first[light_index + 1]; ++i) {
        const aur_incident_photon *const photon = &map->members[i];
        const aur_vector light = aur_frame_to_local(&surface->frame, photon->direction);
        const aur_vector value = glossy_value(lobes, light);
        if (aur_vector_is_zero(value))
            continue;
        /* The value includes the cosine, and a photon's power includes it already. */
        const float cosine = fmaxf(fabsf(light.z), 0.05f);
        sum = aur_vector_add_scaled(sum, 1.0f / cosine, aur_vector_multiply(value, photon->power));
    }
    return aur_vector_scale(sum, 1.0f / map->lights[light_index].area);
}

aur_texel_view aur_irradiance_view(const aur_irradiance_map *map, const aur_scene *scene, const aur_hit *hit,
                                   const aur_surface *surface, aur_vector view) {
    const bool behind = aur_vector_dot(surface->geometric_normal, view) < 0.0f;
    if (behind && !surface->bsdf->scatters_from_behind)
        return (aur_texel_view){0};
    float coordinates[2];
    aur_element_coordinates(scene, hit, surface, coordinates);
    const uint32_t texel = texel_of(&map->texels, aur_shape_is_curved(scene, hit->shape),
                                    aur_element_of(&map->texels.elements, hit), coordinates);
    const size_t light_index = 2 * (size_t)texel + (behind ? 1 : 0);
    const aur_texel_light *const light = &map->lights[light_index];
    const aur_vector local_view = aur_frame_to_local(&surface->frame, view);
    const aur_vector albedo = aur_bsdf_diffuse_albedo(surface->bsdf, surface->texture, local_view.z);
    const aur_vector diffuse =
        aur_vector_scale(aur_vector_multiply(albedo, light->irradiance), 1.0f / AUR_PI_F);
    if (map->member_first == NULL || map->member_first[light_index] == map->member_first[light_index + 1])
        return (aur_texel_view){diffuse, light->area};
    glossy_lobes lobes;
    glossy_lobes_at(surface, local_view, &lobes);
    return (aur_texel_view){aur_vector_add(diffuse, glossy_radiance(map, light_index, surface, &lobes)),
                            light->area};
}
