/* The camera with its film, filter and sampler, and the integrator. */
#include <aureole/sphere.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "scene/load/loader.h"

aur_result aur_build_filter(aur_loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    *object = &self->scene->filter;
    return aur_filter_create(parameters, &self->scene->filter, self->error);
}

/* Tells that a parameter is known and has no effect. */
static void warn_unused(aur_loader *self, aur_parameters *parameters, const char *name, const char *why) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item != NULL)
        aur_warn_at(self->warnings, item->location, "%s '%s': '%s' has no effect: %s", parameters->kind,
                    parameters->plugin, name, why);
}

/* The part of the picture that is to be rendered. */
static aur_result read_crop(aur_loader *self, aur_parameters *parameters, aur_film_settings *film) {
    const int64_t width = (int64_t)film->width, height = (int64_t)film->height;
    int64_t x = 0, y = 0, wide = -1, high = -1;
    aur_result result = aur_parameters_integer(parameters, "crop_offset_x", 0, 65535, &x, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "crop_offset_y", 0, 65535, &y, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "crop_width", 1, 65536, &wide, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "crop_height", 1, 65536, &high, self->error);
    if (result != AUR_OK)
        return result;
    wide = wide < 0 ? width : wide;
    high = high < 0 ? height : high;
    if (x + wide > width || y + high > height)
        return aur_fail_at(self->error, parameters->location, AUR_ERROR_FORMAT,
                           "film '%s': the crop of %lld x %lld at %lld, %lld is not inside %lld x %lld",
                           parameters->plugin, (long long)wide, (long long)high, (long long)x, (long long)y,
                           (long long)width, (long long)height);
    if (wide == width && high == height)
        return AUR_OK;
    film->crop_x0 = (size_t)x;
    film->crop_x1 = (size_t)(x + wide);
    film->crop_y0 = (size_t)y;
    film->crop_y1 = (size_t)(y + high);
    return AUR_OK;
}

aur_result aur_build_film(aur_loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    static const char *const films[] = {"hdrfilm", "ldrfilm"};
    aur_film_settings *const film = &self->scene->film;
    *object = film;
    if (strcmp(parameters->plugin, "ldrfilm") == 0)
        aur_warn_at(self->warnings, parameters->location,
                    "film 'ldrfilm' is read as 'hdrfilm': write to a .png file for 8 bits");
    else if (strcmp(parameters->plugin, "hdrfilm") != 0)
        return aur_fail_unknown_plugin(self->error, parameters, 2, films);
    int64_t width = (int64_t)film->width, height = (int64_t)film->height;
    aur_result result = aur_parameters_integer(parameters, "width", 1, 65536, &width, self->error);
    if (result == AUR_OK)
        result = aur_parameters_integer(parameters, "height", 1, 65536, &height, self->error);
    if (result != AUR_OK)
        return result;
    film->width = (size_t)width;
    film->height = (size_t)height;
    result = read_crop(self, parameters, film);
    if (result != AUR_OK)
        return result;
    void *filter;
    result = aur_loader_nested(self, parameters, "rfilter", &filter);
    if (result != AUR_OK)
        return result;
    if (filter != NULL)
        film->filter = filter;
    /* The output file's name says these. */
    aur_parameters_find(parameters, "file_format");
    aur_parameters_find(parameters, "pixel_format");
    aur_parameters_find(parameters, "component_format");
    warn_unused(self, parameters, "banner", "pictures carry none");
    warn_unused(self, parameters, "high_quality_edges", "all edges are");
    warn_unused(self, parameters, "sample_border", "samples are drawn by the filter");
    warn_unused(self, parameters, "compensate", "sums are exact enough");
    warn_unused(self, parameters, "gamma", "pictures are linear, PNG is sRGB");
    return aur_parameters_finish(parameters, self->error);
}

/* Samplers by other names, and the point sets that take their place. */
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

static aur_result check_set(const aur_parameters *parameters, const char *set, aur_error *error) {
    const char *names[128];
    size_t count = 0;
    for (; count < 128 && aur_set_at(count) != NULL; ++count) {
        names[count] = aur_set_at(count)->row.name;
        if (strcmp(names[count], set) == 0)
            return AUR_OK;
    }
    return strncmp(set, "file:", 5) == 0 ? AUR_OK : aur_fail_unknown_plugin(error, parameters, count, names);
}

aur_result aur_build_sampler(aur_loader *self, aur_xml_node *node, aur_parameters *parameters,
                             void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    int64_t samples = (int64_t)scene->samples_per_pixel;
    aur_result result = aur_parameters_integer(parameters, "sample_count", 1, AUR_SAMPLES_PER_PIXEL_MAX,
                                               &samples, self->error);
    if (result != AUR_OK)
        return result;
    scene->samples_per_pixel = (size_t)samples;
    warn_unused(self, parameters, "seed", "give it on the command line");
    /* The rest are the set's own keys. */
    char text[1024];
    const char *const set = set_for_sampler(parameters->plugin);
    result = check_set(parameters, set, self->error);
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
        return aur_fail_at(self->error, parameters->location, AUR_ERROR_FORMAT,
                           "the sampler's keys are too long");
    free(scene->sampler);
    scene->sampler = NULL;
    result = aur_xml_find_set(&scene->document, parameters->location, text, &scene->sampler, self->error);
    *object = scene->sampler;
    return result;
}

aur_result aur_build_sensor(aur_loader *self, aur_xml_node *node, aur_parameters *parameters, void **object) {
    (void)node;
    aur_scene *const scene = self->scene;
    *object = &scene->sensor;
    /* Nested film and sampler have set the scene's own. */
    void *inner;
    aur_result result = aur_loader_nested(self, parameters, "film", &inner);
    if (result == AUR_OK)
        result = aur_loader_nested(self, parameters, "sampler", &inner);
    if (result != AUR_OK)
        return result;
    scene->has_sensor = true;
    warn_unused(self, parameters, "shutter_open", "nothing moves");
    warn_unused(self, parameters, "shutter_close", "nothing moves");
    return aur_sensor_create(parameters, &scene->sensor, self->error);
}

/* Sets that a scene names in files are looked for where its meshes are. */
static aur_result resolve_set(aur_loader *self, aur_parameter *item) {
    char *set;
    const aur_result result =
        aur_xml_find_set(&self->scene->document, item->location, item->text, &set, self->error);
    if (result != AUR_OK)
        return result;
    free(item->text);
    item->text = set;
    return AUR_OK;
}

aur_result aur_build_integrator(aur_loader *self, aur_xml_node *node, aur_parameters *parameters,
                                void **object) {
    aur_scene *const scene = self->scene;
    const bool nested = node != self->top;
    bool *const has = nested ? &scene->has_nested_integrator : &scene->has_integrator;
    aur_parameters *const made = nested ? &scene->nested_integrator : &scene->integrator;
    *object = made;
    if (*has && nested)
        return aur_fail_at(self->error, node->location, AUR_ERROR_UNSUPPORTED,
                           "a second <integrator> inside another: one is the most");
    if (*has) {
        aur_warn_at(self->warnings, node->location, "a second integrator is left out");
        return AUR_OK;
    }
    *has = true;
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_result result = parameters->items[i].kind == AUR_PARAMETER_STRING
                                      ? resolve_set(self, &parameters->items[i])
                                      : AUR_OK;
        if (result != AUR_OK)
            return result;
    }
    return aur_parameters_copy(parameters, made, self->error);
}
