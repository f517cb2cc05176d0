/* Final gathering over a photon map: at every surface seen by the eye one pattern of directions for the
 * diffuse part about the normal and one for each glossy lobe about its axis (Marques 2013, section 5), the
 * radiance at what they meet from precomputed irradiance (Christensen 1999), direct light by shadow rays.
 *
 * The directions of a pattern are shared out among the samples of a pixel: sample s of S takes every S-th. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "transport/direct_light.h"
#include "transport/gather.h"
#include "transport/integrator.h"
#include "transport/irradiance.h"

enum { COMPONENT_ALL, COMPONENT_DIFFUSE, COMPONENT_GLOSSY };
enum { DIRECT_NEE, DIRECT_GATHER, DIRECT_NONE };
enum { INCIDENT_PHOTONS, INCIDENT_EMITTERS };
enum { LONGEST_CHAIN = 16 }; /* specular bounces in a row */

typedef struct gather_data {
    size_t component, direct, incident;
    uint32_t max_depth;
    size_t samples_per_pixel, glossy_samples;
    uint64_t pattern_seed;
    aur_gather_options options;
    aur_gather_rule diffuse;
    size_t glossy_count; /* rules, one for each exponent of the scene's materials */
    aur_gather_rule *glossy;
    const aur_irradiance_map
        *map; /* owned by the cache; NULL when incident light is that of emitters alone */
} gather_data;

static void release(aur_integrator *integrator) {
    gather_data *const data = integrator->data;
    aur_gather_rule_release(&data->diffuse);
    for (size_t i = 0; i < data->glossy_count; ++i)
        aur_gather_rule_release(&data->glossy[i]);
    free(data->glossy);
    free(data);
}

/* --- parameters
 * ------------------------------------------------------------------------------------------------ */

typedef struct gather_parameters {
    int64_t diffuse_samples, glossy_samples, rotations, photons, neighbours, max_depth, pattern_seed;
    double smoothness;
    const char *pattern, *map, *scramble;
    size_t density, component, direct, incident, pixel;
} gather_parameters;

static aur_result read_parameters(aur_parameters *parameters, gather_parameters *p, aur_error *error) {
    static const char *const densities[] = {"same", "optimal"};
    static const char *const components[] = {"all", "diffuse", "glossy"};
    static const char *const directs[] = {"nee", "gather", "none"};
    static const char *const incidents[] = {"photons", "emitters"};
    static const char *const pixels[] = {"filter", "centre"};
    *p = (gather_parameters){.diffuse_samples = 64,
                             .glossy_samples = 64,
                             .rotations = 16,
                             .photons = 500000,
                             .neighbours = 64,
                             .max_depth = -1,
                             .smoothness = 1.5,
                             .pattern = "spherical-fibonacci",
                             .map = "lambert",
                             .density = 1};
    const int64_t most = 1 << 30;
    aur_result r;
    const bool good =
        (r = aur_parameters_integer(parameters, "diffuse_samples", 1, most, &p->diffuse_samples, error)) ==
            AUR_OK &&
        (r = aur_parameters_integer(parameters, "glossy_samples", 1, most, &p->glossy_samples, error)) ==
            AUR_OK &&
        (r = aur_parameters_string(parameters, "pattern", &p->pattern, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "map", &p->map, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "scramble", &p->scramble, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "rotations", 0, 65536, &p->rotations, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "density", 2, densities, &p->density, error)) == AUR_OK &&
        (r = aur_parameters_float(parameters, "smoothness", 1.0, 2.0, &p->smoothness, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "photons", 1, most, &p->photons, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "neighbours", 2, AUR_IRRADIANCE_NEIGHBOURS_MAX,
                                    &p->neighbours, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "max_depth", -1, 1 << 20, &p->max_depth, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "component", 3, components, &p->component, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "direct", 3, directs, &p->direct, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "incident", 2, incidents, &p->incident, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "pixel", 2, pixels, &p->pixel, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "pattern_seed", 0, INT64_MAX, &p->pattern_seed, error)) ==
            AUR_OK;
    return good ? aur_parameters_finish(parameters, error) : r;
}

/* Digits of nets are scrambled, every other pattern is turned about its axis (Marques 2013, section 6.1). */
static aur_scramble default_scramble(const char *pattern) {
    const aur_set_description *const row = aur_set_find(pattern);
    return row != NULL && row->binary_net ? AUR_SCRAMBLE_DIGIT : AUR_SCRAMBLE_ROTATE;
}

static aur_result read_options(const gather_parameters *p, const aur_integrator_context *context,
                               aur_gather_options *options, aur_error *error) {
    *options = (aur_gather_options){.set = p->pattern,
                                    .scramble = default_scramble(p->pattern),
                                    .optimal_density = p->density == 1,
                                    .smoothness = p->smoothness,
                                    .rotations = (size_t)p->rotations,
                                    .seed = aur_hash2(context->seed, (uint64_t)p->pattern_seed),
                                    .warnings = context->warnings};
    aur_result result = aur_map_from_name(p->map, &options->map, error);
    if (result == AUR_OK && p->scramble != NULL)
        result = aur_scramble_from_name(p->scramble, &options->scramble, error);
    if (result == AUR_OK && options->scramble == AUR_SCRAMBLE_ROTATE3D)
        result =
            aur_fail(error, AUR_ERROR_UNSUPPORTED,
                     "finalgather: 'rotate3d' would turn the pattern out of its hemisphere; use 'rotate'");
    return result;
}

/* --- preparation
 * ----------------------------------------------------------------------------------------------- */

/* A pattern is shared out evenly: as many directions as samples at least, and a multiple of them. */
static size_t shared_count(int64_t wanted, size_t samples_per_pixel) {
    const size_t each = ((size_t)wanted + samples_per_pixel - 1) / samples_per_pixel;
    return each * samples_per_pixel;
}

/* The rule that serves a lobe, or NULL. */
static const aur_gather_rule *find_rule(const gather_data *data, const aur_bsdf_lobe *lobe) {
    if (lobe->diffuse)
        return &data->diffuse;
    for (size_t i = 0; i < data->glossy_count; ++i)
        if ((float)data->glossy[i].exponent == lobe->exponent)
            return &data->glossy[i];
    return NULL;
}

/* One rule for each exponent among the glossy lobes of the scene's materials. */
static aur_result prepare_glossy_rules(gather_data *data, const aur_scene *scene, size_t count,
                                       aur_error *error) {
    const size_t materials = aur_scene_bsdf_count(scene);
    aur_gather_options options = data->options;
    options.count = count;
    data->glossy = calloc(2 * materials * AUR_BSDF_LOBE_CAPACITY + 1, sizeof *data->glossy);
    if (data->glossy == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < materials; ++i) {
        const aur_bsdf *const bsdf = aur_scene_bsdf(scene, i);
        aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
        for (int side = 1; side >= -1; side -= 2) {
            const aur_vector view = {0.0f, 0.0f, (float)side};
            const size_t found = bsdf->descriptor->lobes(bsdf, (aur_bsdf_point){0}, view, lobes);
            for (size_t k = 0; k < found; ++k) {
                if (find_rule(data, &lobes[k]) != NULL || lobes[k].shape != AUR_LOBE_SHAPE_COSINE_POWER)
                    continue;
                const aur_result result = aur_gather_rule_create(&options, lobes[k].exponent,
                                                                 &data->glossy[data->glossy_count], error);
                if (result != AUR_OK)
                    return result;
                ++data->glossy_count;
            }
        }
    }
    return AUR_OK;
}

static void destroy_map(void *map) {
    aur_irradiance_map_destroy(map);
}

/* The photon map, shared by all renders that ask for the same one. */
static aur_result prepare_map(gather_data *data, const gather_parameters *p,
                              const aur_integrator_context *context, aur_error *error) {
    const size_t max_edges = data->max_depth == UINT32_MAX ? SIZE_MAX : data->max_depth - 2;
    char key[160];
    snprintf(key, sizeof key, "irradiance photons=%" PRId64 " neighbours=%" PRId64 " edges=%zu seed=%" PRIu64,
             p->photons, p->neighbours, max_edges, context->seed);
    data->map = aur_cache_find(context->cache, key);
    if (data->map != NULL)
        return AUR_OK;
    const aur_irradiance_options options = {.photons = {.count = (size_t)p->photons,
                                                        .max_edges = max_edges,
                                                        .seed = context->seed,
                                                        .threads = context->threads,
                                                        .progress = context->progress},
                                            .neighbours = (size_t)p->neighbours};
    aur_irradiance_map *map;
    const aur_result result = aur_irradiance_map_create(context->scene, &options, &map, error);
    if (result != AUR_OK)
        return result;
    if (aur_cache_store(context->cache, key, map, destroy_map) != AUR_OK)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    data->map = map;
    return AUR_OK;
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    gather_parameters p;
    aur_result result = read_parameters(parameters, &p, error);
    aur_gather_options options;
    if (result == AUR_OK)
        result = read_options(&p, context, &options, error);
    if (result != AUR_OK)
        return result;
    gather_data *const data = calloc(1, sizeof *data);
    if (data == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    integrator->data = data;
    integrator->pixel_centre = p.pixel == 1;
    data->component = p.component;
    data->direct = p.direct;
    data->incident = p.incident;
    data->max_depth = p.max_depth < 0 ? UINT32_MAX : (uint32_t)p.max_depth;
    data->samples_per_pixel = context->samples_per_pixel;
    data->glossy_samples = shared_count(p.glossy_samples, context->samples_per_pixel);
    data->pattern_seed = options.seed;
    data->options = options;
    options.count = shared_count(p.diffuse_samples, context->samples_per_pixel);
    result = aur_gather_rule_create(&options, 1.0, &data->diffuse, error);
    data->options.warnings = (aur_warnings){0};
    if (result == AUR_OK)
        result = prepare_glossy_rules(data, context->scene, data->glossy_samples, error);
    const bool wants_photons = p.incident == INCIDENT_PHOTONS && data->max_depth >= 3;
    if (result == AUR_OK && wants_photons)
        result = prepare_map(data, &p, context, error);
    return result;
}

/* --- radiance
 * -------------------------------------------------------------------------------------------------- */

/* A place where light is gathered, and the numbers of its light path. */
typedef struct gather_place {
    const aur_integrator *integrator;
    const aur_surface *surface;
    const aur_camera_sample *sample;
    float side;     /* 1 where the surface is seen from the side of its normal, else -1 */
    uint32_t chain; /* specular bounces from the camera */
    aur_counters *counters;
} gather_place;

/* Whether gather rays count the lights that they meet; under next-event estimation that would count them
 * twice. */
static bool gathers_emitters(const gather_data *data) {
    return data->direct == DIRECT_GATHER ||
           (data->incident == INCIDENT_EMITTERS && data->direct == DIRECT_NONE);
}

static bool is_specular_only(const aur_surface *surface, aur_vector view) {
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    const aur_vector local = aur_frame_to_local(&surface->frame, view);
    const size_t count = surface->bsdf->descriptor->lobes(surface->bsdf, surface->texture, local, lobes);
    for (size_t i = 0; i < count; ++i)
        if (lobes[i].shape != AUR_LOBE_SHAPE_SPECULAR)
            return false;
    return count > 0;
}

/* Radiance that comes along a gather ray; mirrors and glass in its way are followed. */
static aur_vector incident_radiance(const gather_place *place, aur_ray ray, uint64_t hash) {
    const gather_data *const data = place->integrator->data;
    const aur_scene *const scene = place->integrator->scene;
    const bool sees_emitters = gathers_emitters(data);
    aur_vector throughput = {1.0f, 1.0f, 1.0f};
    for (uint32_t chain = 0; chain <= LONGEST_CHAIN; ++chain) {
        aur_hit hit;
        ++place->counters->rays;
        /* Light that a mirror throws here is not found by shadow rays. */
        const bool counts_emission = sees_emitters || (chain > 0 && data->direct == DIRECT_NEE);
        if (!aur_scene_intersect(scene, &ray, &hit)) {
            if (!counts_emission)
                break;
            return aur_vector_multiply(throughput, aur_scene_environment(scene, ray.direction));
        }
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
        aur_vector radiance = {0};
        if (counts_emission)
            radiance = aur_surface_emission(scene, &surface, view);
        if (!is_specular_only(&surface, view)) {
            if (data->map != NULL)
                radiance = aur_vector_add(radiance, aur_irradiance_radiance(data->map, &surface, view));
            return aur_vector_multiply(throughput, radiance);
        }
        if (!aur_vector_is_zero(radiance))
            return aur_vector_multiply(throughput, radiance);
        const aur_shading shading = aur_shading_at(&surface, view);
        hash = aur_mix64(hash);
        const float u[3] = {aur_unit_float((uint32_t)hash), aur_unit_float((uint32_t)(hash >> 32)),
                            aur_unit_float((uint32_t)aur_mix64(hash + 1))};
        aur_bsdf_sample sample;
        if (!aur_shading_sample(&shading, u, &sample))
            break;
        throughput = aur_vector_multiply(throughput, sample.weight);
        ray = aur_surface_ray(&surface, sample.light);
    }
    return (aur_vector){0};
}

/* The integral over the hemisphere of one lobe times incident radiance, by this sample's share of a rule. */
static aur_vector gather_lobe(const gather_place *place, const aur_gather_rule *rule,
                              const aur_bsdf_lobe *lobe, uint64_t what) {
    const gather_data *const data = place->integrator->data;
    const aur_stream *const stream = &place->sample->stream;
    const aur_surface *const surface = place->surface;
    const size_t shares = data->samples_per_pixel;
    const uint64_t hash = aur_hash4(data->pattern_seed, stream->pixel, place->chain, what);
    const aur_gather_turn turn = aur_gather_rule_turn(rule, hash);
    const aur_frame frame = aur_frame_about(aur_frame_to_world(&surface->frame, lobe->axis));
    aur_vector sum = {0};
    for (size_t i = stream->index % shares; i < rule->count; i += shares) {
        aur_vector local;
        float weight = aur_gather_direction(rule, &turn, i, &local);
        const aur_vector direction = aur_frame_to_world(&frame, local);
        const float cosine = place->side * aur_vector_dot(surface->frame.z, direction);
        if (cosine <= 0.0f || place->side * aur_vector_dot(surface->geometric_normal, direction) <= 0.0f)
            continue; /* below the surface */
        if (lobe->times_cosine)
            weight *= cosine;
        const aur_ray ray = aur_surface_ray(surface, direction);
        sum = aur_vector_add_scaled(sum, weight, incident_radiance(place, ray, aur_hash2(hash, i)));
    }
    const size_t share = rule->count / shares;
    return aur_vector_scale(aur_vector_multiply(sum, lobe->coefficient), 1.0f / (float)share);
}

/* The glossy part of a BSDF that has no formula, by the BSDF's own samples: this sample's share of them. */
static aur_vector gather_sampled(const gather_place *place, const aur_shading *shading, size_t count,
                                 const aur_bsdf_lobe *lobes, uint64_t what) {
    static const aur_sampler sobol = {.kind = AUR_SAMPLER_SOBOL};
    const gather_data *const data = place->integrator->data;
    const aur_surface *const surface = place->surface;
    const aur_stream *const stream = &place->sample->stream;
    const uint64_t hash = aur_hash4(data->pattern_seed, stream->pixel, place->chain, what);
    const size_t share = data->glossy_samples / data->samples_per_pixel;
    aur_vector sum = {0};
    for (size_t i = 0; i < share; ++i) {
        const aur_stream numbers = {&sobol, hash, (uint32_t)(stream->index * share + i)};
        float choice[2], direction[2];
        aur_stream_pair(&numbers, 0, choice);
        aur_stream_pair(&numbers, 1, direction);
        aur_bsdf_sample drawn;
        if (!aur_shading_sample(shading, (const float[3]){choice[0], direction[0], direction[1]}, &drawn) ||
            drawn.specular || !(drawn.pdf > 0.0f))
            continue;
        const aur_vector light = aur_frame_to_local(&surface->frame, drawn.light);
        const aur_vector value =
            aur_glossy_value(surface->bsdf, surface->texture, shading->view, light, count, lobes);
        const aur_vector radiance =
            incident_radiance(place, aur_surface_ray(surface, drawn.light), aur_hash2(hash, i));
        sum = aur_vector_add_scaled(sum, 1.0f / drawn.pdf, aur_vector_multiply(value, radiance));
    }
    return aur_vector_scale(sum, 1.0f / (float)share);
}

static aur_vector gather(const gather_place *place, const aur_shading *shading, size_t count,
                         const aur_bsdf_lobe *lobes) {
    const gather_data *const data = place->integrator->data;
    aur_vector sum = {0};
    for (size_t i = 0; i < count; ++i) {
        const aur_gather_rule *const rule = find_rule(data, &lobes[i]);
        if (lobes[i].shape == AUR_LOBE_SHAPE_SAMPLED && data->component != COMPONENT_DIFFUSE)
            sum = aur_vector_add(sum, gather_sampled(place, shading, count, lobes, i));
        const bool wanted =
            data->component == COMPONENT_ALL || lobes[i].diffuse == (data->component == COMPONENT_DIFFUSE);
        if (lobes[i].shape == AUR_LOBE_SHAPE_COSINE_POWER && wanted && rule != NULL &&
            !aur_vector_is_zero(lobes[i].coefficient))
            sum = aur_vector_add(sum, gather_lobe(place, rule, &lobes[i], i));
    }
    return sum;
}

/* Pairs of one surface along the chain: direct light's, and two for a specular bounce. */
enum { PAIRS_A_SURFACE = AUR_DIRECT_LIGHT_PAIRS + 2 };

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    const gather_data *const data = integrator->data;
    const aur_scene *const scene = integrator->scene;
    const bool gathers = data->map != NULL || (gathers_emitters(data) && data->max_depth >= 2);
    aur_vector sum = {0}, throughput = {1.0f, 1.0f, 1.0f};
    aur_ray ray = sample->ray;
    for (uint32_t chain = 0; chain <= LONGEST_CHAIN; ++chain) {
        aur_hit hit;
        ++counters->rays;
        if (!aur_scene_intersect(scene, &ray, &hit)) {
            if (data->direct != DIRECT_NONE)
                sum = aur_vector_add(
                    sum, aur_vector_multiply(throughput, aur_scene_environment(scene, ray.direction)));
            break;
        }
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        const aur_vector view = aur_vector_scale(ray.direction, -1.0f);
        const uint32_t pair = AUR_PAIR_FIRST + PAIRS_A_SURFACE * chain;
        aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
        const aur_shading shading = aur_shading_at(&surface, view);
        const size_t count =
            surface.bsdf->descriptor->lobes(surface.bsdf, surface.texture, shading.view, lobes);
        bool specular = false;
        for (size_t i = 0; i < count; ++i)
            specular = specular || lobes[i].shape == AUR_LOBE_SHAPE_SPECULAR;

        aur_vector here = {0};
        if (data->direct != DIRECT_NONE)
            here = aur_surface_emission(scene, &surface, view);
        if (data->direct == DIRECT_NEE && data->max_depth >= 2)
            here = aur_vector_add(here, aur_direct_light(scene, &shading, &sample->stream, pair, counters));
        if (gathers) {
            const float side = aur_vector_dot(surface.geometric_normal, view) < 0.0f ? -1.0f : 1.0f;
            const gather_place place = {integrator, &surface, sample, side, chain, counters};
            here = aur_vector_add(here, gather(&place, &shading, count, lobes));
        }
        sum = aur_vector_add(sum, aur_vector_multiply(throughput, here));
        if (!specular)
            break;
        /* A surface with other lobes too has been gathered for them; only its mirror direction goes on. */
        float lobe[2], direction[2];
        aur_stream_pair(&sample->stream, pair + AUR_DIRECT_LIGHT_PAIRS, lobe);
        aur_stream_pair(&sample->stream, pair + AUR_DIRECT_LIGHT_PAIRS + 1, direction);
        aur_bsdf_sample bounce;
        if (!aur_shading_sample(&shading, (const float[3]){lobe[0], direction[0], direction[1]}, &bounce) ||
            !bounce.specular)
            break;
        throughput = aur_vector_multiply(throughput, bounce.weight);
        ray = aur_surface_ray(&surface, bounce.light);
    }
    return sum;
}

const aur_integrator_descriptor aur_integrator_final_gather = {
    .description = {.name = "finalgather",
                    .keys =
                        "diffuse_samples=64, glossy_samples=64, pattern=spherical-fibonacci, map=lambert, "
                        "scramble=rotate (nets: digit), rotations=16, density=optimal, smoothness=1.5, "
                        "photons=500000, neighbours=64, max_depth=-1, component=all, direct=nee, "
                        "incident=photons, pixel=filter, pattern_seed=0",
                    .summary = "final gathering over a photon map, one pattern of directions an image",
                    .source = "Christensen 1999, Marques 2013"},
    .create = create,
    .release = release,
    .radiance = radiance,
};
