/* Loading and querying a scene. */
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "render/scene/importers/rad/rad.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/materials/texel_pages.h"
#include "render/scene/overlaps.h"
#include "render/scene/scene_data.h"

static void find_sphere(aur_scene *scene) {
    scene->center = aur_vector_scale(aur_vector_add(scene->lower, scene->upper), 0.5f);
    const float radius = 0.5f * aur_vector_length(aur_vector_subtract(scene->upper, scene->lower));
    scene->radius = radius > 0.0f ? 1.001f * radius : 1.0f;
}

/* The largest world coordinate of a shape, by magnitude. Corners beyond Embree's limit (1.8e18) are ignored:
 * Embree does not intersect triangles with such corners. */
static double reach_of(const aur_shape *shape, const double origin[3]) {
    double reach = 0.0;
    for (size_t k = 0; shape->curved != NULL && k < aur_shape_primitives(shape); ++k) {
        double lower[3], upper[3];
        shape->curved->bounds(shape, k, lower, upper);
        for (size_t i = 0; i < 3; ++i)
            reach = fmax(reach, fmax(fabs(lower[i] + origin[i]), fabs(upper[i] + origin[i])));
    }
    for (size_t i = 0; i < 3 * shape->mesh.vertex_count; ++i) {
        const double size = fabs((double)shape->mesh.positions[i] + origin[i % 3]);
        if (size > reach && size < 1.8e18)
            reach = size;
    }
    return reach;
}

/* Ray offsets are at least 1e-9 (AUR_LEAST_OFFSET), comparable to distances in a tiny scene. */
static void warn_of_tiny(const aur_scene *scene, const aur_warnings *warnings) {
    const double width = 2.0 * (double)scene->radius;
    if (width < 1e-5)
        aur_warn_at(warnings, scene->document.tree.root->location,
                    "the scene is %.2g wide, too small to be exact: scale it to 1e-5 or more", width);
}

/* The largest coordinate of the scene's bounds relative to a point at `origin` from the scene's origin. */
static double bounds_reach(const aur_scene *scene, const double origin[3]) {
    const double sides[6] = {scene->lower.x, scene->lower.y, scene->lower.z,
                             scene->upper.x, scene->upper.y, scene->upper.z};
    double reach = 0.0;
    for (size_t i = 0; i < 6; ++i)
        reach = fmax(reach, fabs(sides[i] + origin[i % 3]));
    return reach;
}

/* Ray origins, transformed to the space of an instance, must be within Embree's limit, with a margin for the
 * scene's surroundings. */
static aur_result check_instance(const aur_instance *instance, double reach, aur_error *error) {
    const double *const m = instance->to_local.m;
    for (size_t i = 0; i < 3; ++i)
        if ((fabs(m[4 * i]) + fabs(m[4 * i + 1]) + fabs(m[4 * i + 2])) * reach + fabs(m[4 * i + 3]) > 1e17)
            return aur_fail_at(error, instance->location, AUR_ERROR_FORMAT,
                               "shape 'instance': 'to_world' shrinks too much for a scene that reaches to %g "
                               "from the origin: seen from the shapes of the group that is more than 1e17",
                               reach);
    return AUR_OK;
}

/* The camera's largest distance from the origin. */
static double sensor_reach(const aur_sensor *sensor) {
    double reach = 0.0;
    for (size_t i = 0; i < 12; ++i)
        reach = fmax(reach, fabs((double)sensor->to_world[i]) * fmax(1.0, sensor->aperture_radius));
    for (size_t i = 0; i < sensor->part_count; ++i)
        reach = fmax(reach, sensor_reach(sensor->parts[i]));
    return reach;
}

/* Rejects scenes so large or distant that Embree would abort the process. */
static aur_result check_reach(const aur_scene *scene, aur_error *error) {
    double reach = bounds_reach(scene, scene->origin);
    const double most = 1.00001 * AUR_REACH; /* bounds are slightly larger than shapes */
    for (size_t i = 0; reach > most && i < scene->shape_count; ++i) {
        const aur_shape *const shape = scene->shapes[i];
        if (!shape->grouped && reach_of(shape, scene->origin) > most)
            return aur_fail_at(error, shape->location, AUR_ERROR_FORMAT,
                               "shape '%s' reaches to %g from the origin; %g is the most",
                               shape->descriptor->row.name, reach_of(shape, scene->origin), AUR_REACH);
    }
    if (reach > most)
        return aur_fail_at(error, scene->document.tree.root->location, AUR_ERROR_FORMAT,
                           "instances reach to %g from the origin; %g is the most", reach, AUR_REACH);
    reach = fmax(bounds_reach(scene, (const double[3]){0.0}), sensor_reach(&scene->sensor));
    for (size_t i = 0; i < scene->instance_count; ++i) {
        const aur_result result = check_instance(scene->instances[i], reach, error);
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

/* Only one environment that does not add to others is allowed. */
static aur_result add_environment(aur_scene *scene, const aur_emitter *emitter, aur_error *error) {
    for (size_t i = 0; i < scene->environment_count && !emitter->descriptor->adds; ++i) {
        const aur_emitter *const first = scene->environments[i];
        if (!first->descriptor->adds)
            return aur_fail_at(error, emitter->location, AUR_ERROR_FORMAT,
                               "a second environment: the first is at %s:%zu:%zu", first->location.file,
                               first->location.line, first->location.column);
    }
    if (!aur_array_reserve(&scene->environments, &scene->environment_capacity, scene->environment_count + 1,
                           sizeof(aur_emitter *)))
        return aur_fail_memory(error);
    scene->environments[scene->environment_count++] = emitter;
    return AUR_OK;
}

/* Lights on degenerate meshes emit nothing: they are ignored with a warning, like degenerate faces. */
static void leave_out_dark_lights(aur_scene *scene, const aur_warnings *warnings) {
    size_t emitting = 0, count = 0;
    aur_location first = {0};
    for (size_t i = 0; i < scene->emitter_count; ++i) {
        aur_emitter *const emitter = scene->emitters[i];
        aur_shape *const shape = emitter->shape < scene->shape_count ? scene->shapes[emitter->shape] : NULL;
        if (shape != NULL && shape->curved == NULL && !(shape->area > 0.0)) {
            first = count++ == 0 ? emitter->location : first;
            shape->emitter = AUR_NO_EMITTER;
            aur_emitter_destroy(emitter);
            continue;
        }
        if (shape != NULL)
            shape->emitter = (uint32_t)emitting;
        emitter->index = (uint32_t)emitting;
        scene->emitters[emitting++] = emitter;
    }
    scene->emitter_count = emitting;
    if (count == 1)
        aur_warn_at(warnings, first, "this light has no area and gives no light");
    else if (count > 1)
        aur_warn_at(warnings, first, "%zu lights have no area and give no light (the first is here)", count);
}

static aur_result prepare_lights(aur_scene *scene, aur_error *error) {
    double *const powers = malloc((scene->emitter_count + 1) * sizeof *powers);
    if (powers == NULL)
        return aur_fail_memory(error);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < scene->emitter_count && result == AUR_OK; ++i) {
        aur_emitter *const emitter = scene->emitters[i];
        emitter->scene = scene;
        emitter->part_count = 1;
        emitter->brightness = (double)aur_luminance(aur_color_mean(&emitter->radiance));
        if (emitter->descriptor->prepare != NULL)
            result = emitter->descriptor->prepare(emitter, error);
        emitter->power = emitter->extent;
        if (emitter->descriptor->is_far)
            emitter->power = emitter->power * (double)scene->radius * (double)scene->radius;
        powers[i] = emitter->power *= emitter->brightness;
        if (emitter->descriptor->radiance_from == NULL)
            continue;
        if (result == AUR_OK)
            result = add_environment(scene, emitter, error);
    }
    if (result == AUR_OK)
        result = aur_distribution_create(&scene->lights, scene->emitter_count, powers, error);
    free(powers);
    return result == AUR_OK ? aur_light_choice_create(scene, error) : result;
}

/* Reads the file at `path`, or `data` if not NULL. */
static aur_result load(const char *path, size_t bytes, const char *data, const aur_scene_options *given,
                       bool with_points, aur_overlap_rule rule, aur_scene **scene, aur_error *error) {
    *scene = NULL;
    aur_scene_options options = {.size = sizeof options};
    aur_scene_options_init(&options, NULL);
    aur_result result = aur_options_read(given, sizeof options, &options, "aur_scene_options", error);
    if (result != AUR_OK)
        return result;
    aur_scene *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    created->stores_points = with_points;
    created->overlap_rule = rule;
    created->definitions = aur_definitions_text(&options);
    if (options.texture_memory > 0)
        created->texel_pages = aur_texel_pages_create(options.texture_memory);
    const bool has_memory =
        created->definitions != NULL && (options.texture_memory == 0 || created->texel_pages != NULL);
    result = has_memory ? aur_xml_read(path, bytes, data, &options, &created->document, error)
                        : aur_fail_memory(error);
    if (result == AUR_OK)
        result = aur_scene_build(created, &options, error);
    if (result == AUR_OK)
        result = aur_scene_cut_overlaps(created, options.threads, error);
    if (result == AUR_OK && !with_points)
        aur_scene_warn_of_overlaps(created, &options.warnings);
    if (result == AUR_OK)
        result = aur_scene_recenter(created, &options.warnings, error);
    if (result == AUR_OK)
        result = aur_scene_build_accel(created, options.threads, error);
    if (result == AUR_OK)
        result = check_reach(created, error);
    if (result == AUR_OK) {
        find_sphere(created);
        warn_of_tiny(created, &options.warnings);
        aur_scene_warn_of_faces(created, &options.warnings);
        leave_out_dark_lights(created, &options.warnings);
        result = prepare_lights(created, error);
    }
    if (result != AUR_OK) {
        aur_scene_destroy(created);
        return result;
    }
    *scene = created;
    return AUR_OK;
}

bool aur_scene_is_name(const char *path) {
    return aur_rad_is_name(path) || aur_model_is_name(path);
}

aur_result aur_scene_load(const char *path, const aur_scene_options *options, aur_scene **scene,
                          aur_error *error) {
    return load(path, 0, NULL, options, false, AUR_OVERLAPS_CUT, scene, error);
}

aur_result aur_scene_load_memory(const char *name, size_t bytes, const void *data,
                                 const aur_scene_options *options, aur_scene **scene, aur_error *error) {
    return load(name, bytes, data, options, false, AUR_OVERLAPS_CUT, scene, error);
}

aur_result aur_scene_load_with_points(const char *path, size_t bytes, const char *data, aur_overlap_rule rule,
                                      const aur_scene_options *options, aur_scene **scene, aur_error *error) {
    return load(path, bytes, data, options, true, rule, scene, error);
}

void aur_scene_destroy(aur_scene *scene) {
    if (scene == NULL)
        return;
    aur_scene_release_accel(scene);
    for (size_t i = 0; i < scene->shape_count; ++i)
        aur_shape_destroy(scene->shapes[i]);
    for (size_t i = 0; i < scene->emitter_count; ++i)
        aur_emitter_destroy(scene->emitters[i]);
    for (size_t i = 0; i < scene->bsdf_count; ++i)
        aur_bsdf_destroy(scene->bsdfs[i]);
    for (size_t i = 0; i < scene->texture_count; ++i)
        aur_texture_destroy(scene->textures[i]);
    aur_texel_pages_destroy(scene->texel_pages);
    for (size_t i = 0; i < scene->medium_count; ++i)
        aur_medium_destroy(scene->media[i]);
    for (size_t i = 0; i < scene->phase_count; ++i)
        aur_phase_destroy(scene->phases[i]);
    for (size_t i = 0; i < scene->volume_count; ++i)
        aur_volume_destroy(scene->volumes[i]);
    for (size_t i = 0; i < scene->group_count; ++i) {
        free(scene->groups[i]->shapes);
        free(scene->groups[i]);
    }
    for (size_t i = 0; i < scene->instance_count; ++i)
        free(scene->instances[i]);
    free(scene->groups);
    free(scene->instances);
    aur_sensor_release(&scene->sensor);
    for (size_t i = 0; i < scene->part_count; ++i) {
        aur_sensor_release(scene->parts[i]);
        free(scene->parts[i]);
    }
    free(scene->parts);
    free(scene->shapes);
    free(scene->emitters);
    free(scene->environments);
    free(scene->bsdfs);
    free(scene->textures);
    free(scene->media);
    free(scene->phases);
    free(scene->volumes);
    free(scene->sampler);
    aur_distribution_release(&scene->lights);
    aur_light_choice_release(&scene->choice);
    aur_parameters_release(&scene->integrator);
    aur_parameters_release(&scene->nested_integrator);
    free(scene->definitions);
    aur_xml_release(&scene->document);
    free(scene);
}

aur_result aur_scene_get_description(const aur_scene *scene, aur_scene_description *description,
                                     aur_error *error) {
    aur_scene_description described = {
        .size = sizeof described,

        .shapes = scene->shape_count,
        .emitters = scene->emitter_count,
        .materials = scene->bsdf_count,
        .width = scene->film.width,
        .height = scene->film.height,
        .samples_per_pixel = scene->samples_per_pixel,
        .integrator = scene->integrator.plugin,
        .sampler = scene->sampler,
        .filter = aur_filter_name(scene->film.filter),
    };
    aur_vector_to_doubles(scene->lower, described.lower);
    aur_vector_to_doubles(scene->upper, described.upper);
    for (size_t i = 0; i < 3; ++i) {
        described.lower[i] += scene->origin[i];
        described.upper[i] += scene->origin[i];
    }
    for (size_t i = 0; i < scene->shape_count; ++i)
        described.triangles += scene->shapes[i]->mesh.triangle_count;
    return aur_description_write(&described, sizeof described, description, "aur_scene_description", error);
}

aur_result aur_scene_check_camera(const aur_scene *scene, aur_error *error) {
    return scene->has_sensor
               ? AUR_OK
               : aur_xml_fail(scene->document.tree.root, error,
                              "the scene has no <sensor>: add one, or choose a view (--camera)");
}

const aur_film_settings *aur_scene_film(const aur_scene *scene) {
    return &scene->film;
}

size_t aur_scene_samples_per_pixel(const aur_scene *scene) {
    return scene->samples_per_pixel;
}

const char *aur_scene_sampler(const aur_scene *scene) {
    return scene->sampler;
}

const char *aur_scene_integrator_key(const aur_scene *scene, const char *key) {
    for (size_t i = 0; i < scene->integrator.count; ++i)
        if (strcmp(scene->integrator.items[i].name, key) == 0)
            return scene->integrator.items[i].text;
    return NULL;
}

bool aur_scene_is_model(const aur_scene *scene) {
    return scene->document.stage.alone;
}

const aur_parameters *aur_scene_integrator(const aur_scene *scene) {
    return &scene->integrator;
}

struct RTCSceneTy *aur_scene_embree(const aur_scene *scene) {
    return scene->accel;
}

const double *aur_scene_origin(const aur_scene *scene) {
    return scene->origin;
}

void aur_scene_bounds(const aur_scene *scene, aur_vector *lower, aur_vector *upper) {
    *lower = scene->lower;
    *upper = scene->upper;
}

aur_result aur_scene_options_init(aur_scene_options *options, aur_error *error) {
    static const aur_scene_options defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_scene_options", error);
}
