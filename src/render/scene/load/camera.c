/* The camera with its film, filter and sampler, and the integrator. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "points/sphere/native.h"
#include "render/scene/load/loader.h"

/* Nesting depth of a camera's objects; deeper objects belong to a camera in a batch. */
enum { DEPTH_OF_SENSOR, DEPTH_OF_FILM, DEPTH_OF_FILTER };

/* Whether a film, filter or sampler belongs to a camera in a batch; the batch's own film, filter and sampler
 * replace it. */
static bool is_left_out(const aur_loader *self, const aur_parameters *parameters, size_t depth) {
    if (self->depth <= depth)
        return false;
    aur_warn_at(self->warnings, parameters->location,
                "the %s of a sensor in a batch is left out: the batch has one for all", parameters->kind);
    return true;
}

aur_result aur_build_filter(aur_loader *self, aur_parameters *parameters, void **object) {
    *object = &self->scene->filter;
    if (is_left_out(self, parameters, DEPTH_OF_FILTER))
        return AUR_OK;
    return aur_filter_create(parameters, &self->scene->filter, self->error);
}

/* Parameters read of a film; a crop of -1 is unspecified. */
typedef struct film_keys {
    int64_t width, height, crop_x, crop_y, crop_width, crop_height;
    const aur_parameter *rfilter;
} film_keys;

enum { LARGEST_SIDE = 65536 };

static const aur_key film_key_table[] = {
    {AUR_KEY_OF_INTEGER(film_keys, "width", width, 1, LARGEST_SIDE, "768", "size in pixels"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(film_keys, "height", height, 1, LARGEST_SIDE, "576", "size in pixels"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(film_keys, "crop_offset_x", crop_x, 0, LARGEST_SIDE - 1, "0",
                        "left edge of the part to render")},
    {AUR_KEY_OF_INTEGER(film_keys, "crop_offset_y", crop_y, 0, LARGEST_SIDE - 1, "0",
                        "upper edge of the part to render")},
    {AUR_KEY_OF_INTEGER(film_keys, "crop_width", crop_width, 1, LARGEST_SIDE, "width",
                        "size of the part to render"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(film_keys, "crop_height", crop_height, 1, LARGEST_SIDE, "height",
                        "size of the part to render"),
     .computed = true},
    {AUR_KEY_OF_ITEM(film_keys, "rfilter", rfilter, "gaussian",
                     "reconstruction filters: weights of samples around a pixel", "rfilter")},
};

static const aur_row hdrfilm = {
    .name = "hdrfilm", .summary = "the image", .source = "Mitsuba 3", AUR_ROW_KEYS(film_key_table)};
static const aur_row ldrfilm = {
    .name = "ldrfilm", .summary = "read as hdrfilm", .source = "Mitsuba 0.6", AUR_ROW_KEYS(film_key_table)};
static const aur_row *const film_rows[] = {&hdrfilm, &ldrfilm};

const aur_table aur_film_table = {.kind = "film", .summary = "image sizes", AUR_TABLE_ROWS(film_rows)};

/* The crop window of the film. */
static aur_result set_crop(const film_keys *p, const aur_parameters *parameters, aur_film_settings *film,
                           aur_error *error) {
    const int64_t wide = p->crop_width < 0 ? p->width : p->crop_width;
    const int64_t high = p->crop_height < 0 ? p->height : p->crop_height;
    film->width = (size_t)p->width;
    film->height = (size_t)p->height;
    if (p->crop_x + wide > p->width || p->crop_y + high > p->height)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "the crop of %lld x %lld at %lld, %lld is not inside %zu x %zu",
                                   (long long)wide, (long long)high, (long long)p->crop_x,
                                   (long long)p->crop_y, film->width, film->height);
    if (wide == p->width && high == p->height)
        return AUR_OK;
    film->crop_x0 = (size_t)p->crop_x;
    film->crop_x1 = (size_t)(p->crop_x + wide);
    film->crop_y0 = (size_t)p->crop_y;
    film->crop_y1 = (size_t)(p->crop_y + high);
    return AUR_OK;
}

aur_result aur_build_film(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_film_settings *const film = &self->scene->film;
    *object = film;
    if (is_left_out(self, parameters, DEPTH_OF_FILM))
        return AUR_OK;
    const aur_row *row;
    aur_result result = aur_table_find(&aur_film_table, parameters, &row, self->error);
    if (result != AUR_OK)
        return result;
    if (strcmp(row->name, "ldrfilm") == 0)
        aur_warn_at(self->warnings, parameters->location,
                    "film 'ldrfilm' is read as 'hdrfilm': write to a .png file for 8 bits");
    film_keys p = {
        .width = (int64_t)film->width, .height = (int64_t)film->height, .crop_width = -1, .crop_height = -1};
    void *filter = NULL;
    result = aur_keys_read(row->key_count, row->keys, parameters, &p, self->error);
    if (result == AUR_OK)
        result = set_crop(&p, parameters, film, self->error);
    if (result == AUR_OK)
        result = aur_loader_nested(self, parameters, "rfilter", &filter);
    if (result != AUR_OK)
        return result;
    if (filter != NULL)
        film->filter = filter;
    return aur_parameters_finish(parameters, self->error);
}

/* Names of Mitsuba samplers, and the point sets used in their place. */
static const char *set_for_sampler(const char *plugin) {
    static const char *const others[][2] = {{"independent", "random"},
                                            {"stratified", "sobol"},
                                            {"multijitter", "sobol"},
                                            {"orthogonal", "sobol"},
                                            {"ldsampler", "sobol"}};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
        if (strcmp(others[i][0], plugin) == 0)
            return others[i][1];
    return plugin;
}

static const aur_key sampler_keys[] = {
    {AUR_KEY_FIELD(AUR_KEY_INTEGER, aur_scene, "sample_count", samples_per_pixel, "4", "samples per pixel"),
     .minimum = 1.0, .maximum = AUR_SAMPLES_PER_PIXEL_MAX, .computed = true},
};

static const aur_row sampler_common = {
    .name = "sampler", .summary = "what every sampler takes", AUR_ROW_KEYS(sampler_keys)};

const aur_table aur_sampler_table = {.kind = "sampler",
                                     .summary = "samplers of the camera: any set of the square",
                                     AUR_TABLE_ROWS(aur_set_rows),
                                     .common = &sampler_common};

aur_result aur_build_sampler(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    *object = scene;
    if (is_left_out(self, parameters, DEPTH_OF_FILM))
        return AUR_OK;
    aur_result result =
        aur_keys_read(sampler_common.key_count, sampler_common.keys, parameters, scene, self->error);
    if (result != AUR_OK)
        return result;
    /* The remaining parameters are parameters of the point set. */
    char text[1024];
    const char *const set = set_for_sampler(parameters->plugin);
    const aur_row *row;
    if (set == parameters->plugin && strncmp(set, "file:", 5) != 0)
        result = aur_table_find(&aur_sampler_table, parameters, &row, self->error);
    if (result != AUR_OK)
        return result;
    int used = snprintf(text, sizeof text, "%s", set);
    for (size_t i = 0, keys = 0; i < parameters->count && used < (int)sizeof text; ++i) {
        aur_parameter *const item = &parameters->items[i];
        if (item->used || item->text == NULL)
            continue;
        if (set != parameters->plugin) {
            if (strcmp(item->name, "jitter") != 0 && strcmp(item->name, "dimension") != 0 &&
                strcmp(item->name, "strength") != 0)
                break;
            aur_warn_at(self->warnings, item->location, "sampler '%s': '%s' has no effect: it is read as %s",
                        parameters->plugin, item->name, set);
        } else {
            used += snprintf(text + used, sizeof text - (size_t)used, "%c%s=%s", keys++ == 0 ? ':' : ',',
                             item->name, item->text);
        }
        item->used = true;
    }
    result = aur_parameters_finish(parameters, self->error);
    if (result != AUR_OK)
        return result;
    if (used >= (int)sizeof text)
        return aur_parameters_fail(parameters, self->error, AUR_ERROR_FORMAT, "its keys are too long");
    free(scene->sampler);
    scene->sampler = NULL;
    result = aur_xml_find_set(&scene->document, parameters->location, text, &scene->sampler, self->error);
    *object = scene->sampler;
    return result;
}

/* Destination of a new camera: the scene, or the next one of a batch. */
static aur_result place_sensor(aur_loader *self, const aur_parameters *parameters, aur_sensor **sensor) {
    aur_scene *const scene = self->scene;
    *sensor = &scene->sensor;
    if (self->depth == DEPTH_OF_SENSOR)
        return AUR_OK;
    if (strcmp(parameters->plugin, "batch") == 0)
        return aur_parameters_fail(parameters, self->error, AUR_ERROR_UNSUPPORTED,
                                   "it cannot be inside another one");
    const aur_result result =
        aur_loader_reserve(self, &scene->parts, scene->part_count, &scene->part_capacity);
    if (result != AUR_OK)
        return result;
    *sensor = calloc(1, sizeof **sensor);
    if (*sensor == NULL)
        return aur_fail_memory_at(self->error, parameters->location);
    scene->parts[scene->part_count++] = *sensor;
    return AUR_OK;
}

/* Ends a batch. All of its cameras must be in the same medium. */
static aur_result set_parts(aur_loader *self, const aur_parameters *parameters, const aur_medium *medium) {
    aur_scene *const scene = self->scene;
    scene->sensor.part_count = scene->part_count;
    scene->sensor.parts = scene->parts;
    for (size_t i = 0; i < scene->part_count; ++i) {
        const aur_medium *const here = scene->parts[i]->medium != NULL ? scene->parts[i]->medium : medium;
        if (i > 0 && here != scene->sensor.medium)
            return aur_parameters_fail(parameters, self->error, AUR_ERROR_UNSUPPORTED,
                                       "its sensors must be in one medium, not in several");
        if (i > 0 && scene->parts[i]->descriptor->factor != scene->parts[0]->descriptor->factor)
            return aur_parameters_fail(parameters, self->error, AUR_ERROR_UNSUPPORTED,
                                       "irradiance meters cannot be combined with other sensors");
        scene->sensor.medium = here;
    }
    return AUR_OK;
}

aur_result aur_build_sensor(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    aur_sensor *sensor;
    /* Ends a sensor: its nested film and sampler have already set those of the scene. */
    void *inner;
    aur_result result = place_sensor(self, parameters, &sensor);
    *object = sensor;
    if (result == AUR_OK)
        result = aur_loader_nested(self, parameters, "film", &inner);
    if (result == AUR_OK)
        result = aur_loader_nested(self, parameters, "sampler", &inner);
    void *medium = NULL;
    if (result == AUR_OK)
        result = aur_loader_nested(self, parameters, "medium", &medium);
    if (result != AUR_OK)
        return result;
    scene->has_sensor = true;
    result = aur_sensor_create(parameters, sensor, self->error);
    sensor->medium = medium;
    return result == AUR_OK && sensor == &scene->sensor ? set_parts(self, parameters, medium) : result;
}

static aur_result fail_second(aur_loader *self, aur_location location) {
    return aur_fail_at(self->error, location, AUR_ERROR_UNSUPPORTED,
                       "a second <integrator> inside another: one is the most");
}

/* <integrator type="moment">: replaced by its nested integrator. */
static aur_result unwrap_moment(aur_loader *self, aur_parameters *parameters) {
    aur_scene *const scene = self->scene;
    if (aur_parameters_find(parameters, "integrator") == NULL || !scene->has_nested_integrator)
        return aur_parameters_fail(parameters, self->error, AUR_ERROR_FORMAT,
                                   "it needs an <integrator> inside");
    const aur_parameter *const second = aur_parameters_find(parameters, "integrator2");
    if (second != NULL)
        return fail_second(self, second->location);
    aur_warn_at(self->warnings, parameters->location,
                "integrator 'moment' is read as the one inside it, '%s', without second moments",
                scene->nested_integrator.plugin);
    scene->integrator = scene->nested_integrator;
    scene->nested_integrator = (aur_parameters){0};
    scene->has_nested_integrator = false;
    return aur_parameters_finish(parameters, self->error);
}

aur_result aur_build_integrator(aur_loader *self, aur_parameters *parameters, void **object) {
    aur_scene *const scene = self->scene;
    const bool nested = self->node != self->top;
    bool *const has = nested ? &scene->has_nested_integrator : &scene->has_integrator;
    aur_parameters *const built = nested ? &scene->nested_integrator : &scene->integrator;
    *object = built;
    /* Integrators with several nested ones, or with one that is not unwrapped, are rejected when they are
     * created, unless another integrator replaces them. */
    if (*has && nested) {
        if (aur_parameters_find(parameters, "integrator") != NULL)
            self->deep_integrator = parameters->location;
        return AUR_OK;
    }
    if (*has) {
        aur_warn_at(self->warnings, parameters->location, "a second integrator is left out");
        return AUR_OK;
    }
    *has = true;
    if (!nested && self->deep_integrator.file != NULL &&
        aur_parameters_find(parameters, "integrator2") == NULL) {
        const aur_result result = aur_parameters_add_object(parameters, "integrator2", "integrator", built,
                                                            self->deep_integrator, self->error);
        if (result != AUR_OK)
            return result;
    }
    if (!nested && strcmp(parameters->plugin, "moment") == 0)
        return unwrap_moment(self, parameters);
    for (size_t i = 0; i < parameters->count; ++i) {
        aur_parameter *const item = &parameters->items[i];
        char *set;
        if (item->kind != AUR_PARAMETER_STRING)
            continue;
        /* Point sets in files are searched for in the same folders as meshes. */
        const aur_result result =
            aur_xml_find_set(&scene->document, item->location, item->text, &set, self->error);
        if (result != AUR_OK)
            return result;
        free(item->text);
        item->text = set;
    }
    return aur_parameters_copy(parameters, built, self->error);
}
