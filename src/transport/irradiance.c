#include "transport/irradiance.h"

#include <stdlib.h>

#include "core/parallel.h"
#include "transport/kd_tree.h"
#include "transport/shading.h"

enum {
    PHOTONS_A_CELL =
        16, /* on average: a quarter of the photons of an estimate by default, so that discs overlap */
    POINTS_A_CHUNK = 256,
    COVERAGE_RAYS = 16
};

/* Places share light when their normals differ by less than 45 degrees and one lies near the plane of the
 * other: within 20 degrees of it, seen from there. */
static const float LEAST_NORMAL_AGREEMENT = 0.7f;
static const float MOST_ELEVATION_SQUARED = 0.12f;

typedef struct surface_place {
    const aur_photon *photons;
    aur_vector position, normal;
} surface_place;

static bool shares_light(const surface_place *place, aur_vector position, aur_vector normal) {
    if (aur_vector_dot(normal, place->normal) <= LEAST_NORMAL_AGREEMENT)
        return false;
    const aur_vector offset = aur_vector_subtract(position, place->position);
    const float height = aur_vector_dot(offset, place->normal);
    return height * height <= MOST_ELEVATION_SQUARED * aur_vector_dot(offset, offset);
}

static bool accept_photon(const void *context, uint32_t item) {
    const surface_place *const place = context;
    return shares_light(place, place->photons[item].position, place->photons[item].normal);
}

/* The part of the disc about a point that lies on like-turned surface: a disc that hangs over an edge or
 * through a wall has caught photons on less than pi r^2. Short rays from above the disc, spread as a
 * sunflower (Vogel 1979). */
static float disc_coverage(const aur_scene *scene, aur_vector position, aur_vector normal, float radius) {
    const aur_frame frame = aur_frame_about(normal);
    const aur_vector down = aur_vector_scale(normal, -1.0f);
    const float height = 0.5f * radius;
    unsigned covered = 0;
    for (unsigned i = 0; i < COVERAGE_RAYS; ++i) {
        const float r = radius * sqrtf(((float)i + 0.5f) / COVERAGE_RAYS);
        const float angle = (float)i * 2.39996323f; /* the golden angle */
        const aur_vector offset = {r * cosf(angle), r * sinf(angle), height};
        const aur_ray ray = {.origin = aur_vector_add(position, aur_frame_to_world(&frame, offset)),
                             .nearest = 0.0f,
                             .direction = down,
                             .farthest = 2.0f * height};
        aur_hit hit;
        if (!aur_scene_intersect(scene, &ray, &hit))
            continue;
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        if (fabsf(aur_vector_dot(surface.geometric_normal, normal)) > LEAST_NORMAL_AGREEMENT)
            ++covered;
    }
    return (float)(covered < 2 ? 2 : covered) / COVERAGE_RAYS;
}

typedef struct estimate_work {
    const aur_scene *scene;
    const aur_photon *photons;
    const aur_kd_tree *photon_tree;
    const uint32_t *centres; /* the photon of each point */
    const aur_irradiance_options *options;
    aur_irradiance_map *map;
} estimate_work;

static int by_item(const void *a, const void *b) {
    const uint32_t x = ((const aur_kd_neighbour *)a)->item, y = ((const aur_kd_neighbour *)b)->item;
    return (x > y) - (x < y);
}

static void estimate(const estimate_work *work, size_t index) {
    aur_irradiance_map *const map = work->map;
    const aur_photon *const photons = work->photons;
    const aur_photon *const centre = &photons[work->centres[index]];
    aur_irradiance_point *const point = &map->points[index];
    const uint32_t first = point->first;
    aur_kd_neighbour found[AUR_IRRADIANCE_NEIGHBOURS_MAX];
    const surface_place here = {.photons = photons, .position = centre->position, .normal = centre->normal};
    const size_t count = aur_kd_tree_nearest(work->photon_tree, centre->position, INFINITY, accept_photon,
                                             &here, work->options->neighbours, found);
    float radius_squared = 0.0f;
    for (size_t i = 0; i < count; ++i)
        radius_squared = fmaxf(radius_squared, found[i].distance_squared);
    *point = (aur_irradiance_point){.position = centre->position,
                                    .normal = centre->normal,
                                    .radius_squared = radius_squared,
                                    .first = first};
    if (!(radius_squared > 0.0f))
        return;
    /* Summed in the photons' own order, and less the farthest one, whose distance was chosen to end the disc.
     */
    qsort(found, count, sizeof *found, by_item);
    aur_vector power = {0};
    for (size_t i = 0; i < count; ++i) {
        if (found[i].distance_squared >= radius_squared)
            continue;
        const aur_photon *const photon = &photons[found[i].item];
        power = aur_vector_add(power, photon->power);
        if (centre->glossy)
            map->members[first + point->members++] = (aur_incident_photon){photon->direction, photon->power};
    }
    const float coverage =
        disc_coverage(work->scene, centre->position, centre->normal, sqrtf(radius_squared));
    point->area = AUR_PI_F * radius_squared * coverage;
    point->irradiance = aur_vector_scale(power, 1.0f / point->area);
}

static aur_result estimate_chunk(void *context, size_t chunk) {
    const estimate_work *const work = context;
    const size_t first = chunk * POINTS_A_CHUNK;
    size_t last = first + POINTS_A_CHUNK;
    if (last > work->map->count)
        last = work->map->count;
    for (size_t i = first; i < last; ++i)
        estimate(work, i);
    return AUR_OK;
}

/* Every glossy point has room for its photons, one after another. */
static aur_result lay_out_members(aur_irradiance_map *map, const aur_photon *photons, const uint32_t *centres,
                                  size_t neighbours) {
    size_t total = 0;
    for (size_t i = 0; i < map->count; ++i) {
        map->points[i].first = (uint32_t)total;
        total += photons[centres[i]].glossy ? neighbours : 0;
    }
    if (total > UINT32_MAX)
        return AUR_ERROR_ARGUMENT;
    map->members = malloc((total > 0 ? total : 1) * sizeof *map->members);
    return map->members != NULL ? AUR_OK : AUR_ERROR_MEMORY;
}

/* Cells over the photons; *centres is the photon that stands for each. */
static aur_result make_cells(aur_irradiance_map *map, const aur_photon_map *photons, uint32_t **centres) {
    const aur_surface_samples samples = {.count = photons->count,
                                         .stride = sizeof *photons->photons,
                                         .positions = &photons->photons->position,
                                         .normals = &photons->photons->normal};
    const aur_result result =
        aur_surface_cells_build(&map->cells, &samples, samples.count / PHOTONS_A_CELL + 1);
    if (result != AUR_OK)
        return result;
    map->count = map->cells.count;
    map->points = calloc(map->count, sizeof *map->points);
    *centres = malloc(map->count * sizeof **centres);
    if (map->points == NULL || *centres == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t i = 0; i <= map->cells.mask; ++i)
        if (map->cells.slots[i].key != 0)
            (*centres)[map->cells.slots[i].item] = map->cells.slots[i].sample;
    return AUR_OK;
}

static aur_result tree_over(const aur_photon_map *photons, size_t threads, aur_kd_tree *tree) {
    aur_vector *const positions = malloc(photons->count * sizeof *positions);
    if (positions == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t i = 0; i < photons->count; ++i)
        positions[i] = photons->photons[i].position;
    const aur_result result = aur_kd_tree_build(tree, photons->count, positions, threads);
    free(positions);
    return result;
}

/* Places where no photon fell but over which an estimate's disc lies belong to it; elsewhere it is dark. */
static aur_result spread_estimates(aur_irradiance_map *map) {
    aur_surface_disc *const discs = malloc(map->count * sizeof *discs);
    if (discs == NULL)
        return AUR_ERROR_MEMORY;
    for (size_t i = 0; i < map->count; ++i) {
        const aur_irradiance_point *const point = &map->points[i];
        discs[i] = (aur_surface_disc){point->position, point->normal, sqrtf(point->radius_squared)};
    }
    const aur_result result = aur_surface_cells_spread(&map->cells, map->count, discs);
    free(discs);
    return result;
}

static aur_result estimate_all(const aur_scene *scene, const aur_irradiance_options *options,
                               const aur_photon_map *photons, const uint32_t *centres,
                               aur_irradiance_map *map) {
    const size_t threads = options->photons.threads;
    aur_result result = lay_out_members(map, photons->photons, centres, options->neighbours);
    aur_kd_tree tree = {0};
    if (result == AUR_OK)
        result = tree_over(photons, threads, &tree);
    if (result == AUR_OK) {
        estimate_work work = {scene, photons->photons, &tree, centres, options, map};
        const aur_parallel_options parallel = {
            .threads = threads, .what = "irradiance", .progress = options->photons.progress};
        result = aur_parallel_for(&parallel, (map->count + POINTS_A_CHUNK - 1) / POINTS_A_CHUNK,
                                  estimate_chunk, &work);
    }
    aur_kd_tree_release(&tree);
    return result == AUR_OK ? spread_estimates(map) : result;
}

static aur_result fill(const aur_scene *scene, const aur_irradiance_options *options, aur_irradiance_map *map,
                       aur_error *error) {
    aur_photon_map photons;
    aur_result result = aur_photon_map_create(scene, &options->photons, &photons, error);
    if (result != AUR_OK)
        return result;
    uint32_t *centres = NULL;
    result = make_cells(map, &photons, &centres);
    if (result == AUR_OK)
        result = estimate_all(scene, options, &photons, centres, map);
    free(centres);
    map->photons = photons.count;
    map->rays = photons.rays + (uint64_t)map->count * COVERAGE_RAYS;
    aur_photon_map_release(&photons);
    if (result == AUR_ERROR_ARGUMENT)
        return aur_fail(error, result,
                        "photon map: more photons than 32-bit numbers can name; use fewer photons");
    return result == AUR_OK ? AUR_OK : aur_fail(error, result, "photon map: %s", aur_result_string(result));
}

aur_result aur_irradiance_map_create(const aur_scene *scene, const aur_irradiance_options *options,
                                     aur_irradiance_map **out, aur_error *error) {
    *out = NULL;
    aur_irradiance_map *const map = calloc(1, sizeof *map);
    if (map == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "photon map: out of memory");
    const aur_result result = fill(scene, options, map, error);
    if (result != AUR_OK) {
        aur_irradiance_map_destroy(map);
        return result;
    }
    *out = map;
    return AUR_OK;
}

void aur_irradiance_map_destroy(aur_irradiance_map *map) {
    if (map == NULL)
        return;
    aur_surface_cells_release(&map->cells);
    free(map->points);
    free(map->members);
    free(map);
}

/* What the glossy lobes have towards `light`, BSDF * |cos|, and nothing from powers too small to matter. */
typedef struct glossy_lobes {
    bool sampled; /* one of them has no formula */
    size_t count;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    float
        least[AUR_BSDF_LOBE_CAPACITY]; /* cosine about the axis under which cos^exponent is less than 1e-6 */
} glossy_lobes;

static glossy_lobes lobes_at(const aur_surface *surface, aur_vector view) {
    glossy_lobes all = {0};
    all.count = surface->bsdf->descriptor->lobes(surface->bsdf, surface->texture, view, all.lobes);
    for (size_t i = 0; i < all.count; ++i) {
        all.sampled = all.sampled || all.lobes[i].shape == AUR_LOBE_SHAPE_SAMPLED;
        all.least[i] = expf(-13.8155f / fmaxf(all.lobes[i].exponent, 1e-3f));
    }
    return all;
}

static aur_vector glossy_value(const glossy_lobes *all, const aur_surface *surface, aur_vector view,
                               aur_vector light) {
    if (all->sampled)
        return aur_glossy_value(surface->bsdf, surface->texture, view, light, all->count, all->lobes);
    aur_vector sum = {0};
    for (size_t i = 0; i < all->count; ++i)
        if (!all->lobes[i].diffuse && aur_vector_dot(all->lobes[i].axis, light) > all->least[i])
            sum = aur_vector_add(sum, aur_lobe_value(&all->lobes[i], light));
    return sum;
}

/* The glossy lobes' share: a density estimate over the point's photons. */
static aur_vector glossy_radiance(const aur_irradiance_map *map, const aur_irradiance_point *point,
                                  const aur_surface *surface, aur_vector view) {
    const glossy_lobes lobes = lobes_at(surface, view);
    aur_vector sum = {0};
    for (uint32_t i = 0; i < point->members; ++i) {
        const aur_incident_photon *const photon = &map->members[point->first + i];
        const aur_vector light = aur_frame_to_local(&surface->frame, photon->direction);
        const aur_vector value = glossy_value(&lobes, surface, view, light);
        if (aur_vector_is_zero(value))
            continue;
        /* The value is of BSDF * cos, and a photon's power has its cosine already. */
        const float cosine = fmaxf(fabsf(light.z), 0.05f);
        sum = aur_vector_add_scaled(sum, 1.0f / cosine, aur_vector_multiply(value, photon->power));
    }
    return aur_vector_scale(sum, 1.0f / point->area);
}

aur_vector aur_irradiance_radiance(const aur_irradiance_map *map, const aur_surface *surface,
                                   aur_vector view) {
    const aur_vector black = {0};
    const float side = aur_vector_dot(surface->geometric_normal, view);
    if (side < 0.0f && !surface->bsdf->scatters_from_behind)
        return black;
    const aur_vector normal = aur_vector_scale(surface->geometric_normal, side < 0.0f ? -1.0f : 1.0f);
    const uint32_t cell = aur_surface_cells_find(&map->cells, surface->position, normal);
    if (cell == AUR_NO_CELL)
        return black;
    const aur_irradiance_point *const point = &map->points[cell];
    const aur_bsdf_descriptor *const descriptor = surface->bsdf->descriptor;
    const aur_vector local_view = aur_frame_to_local(&surface->frame, view);
    const aur_vector albedo = descriptor->diffuse_albedo(surface->bsdf, surface->texture, local_view.z);
    const aur_vector diffuse =
        aur_vector_scale(aur_vector_multiply(albedo, point->irradiance), 1.0f / AUR_PI_F);
    if (point->members == 0)
        return diffuse;
    return aur_vector_add(diffuse, glossy_radiance(map, point, surface, local_view));
}
