#include "render/driver/renderer.h"

#include <math.h>

#include "points/base/error.h"
#include "render/scene/sensor.h"

static aur_result find_filter(const char *name, const aur_filter **filter, aur_error *error) {
    if (name == NULL)
        return AUR_OK;
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of_table(&aur_filter_table), "filter", name,
                                               (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *filter = aur_filter_find(name);
    return result;
}

static aur_result complete_crop(const aur_film_settings *film, aur_render_options *s, aur_error *error) {
    if (s->crop_x0 == 0 && s->crop_x1 == 0 && s->crop_y0 == 0 && s->crop_y1 == 0) {
        /* The film's crop applies only to the film's size. */
        const bool part = film->crop_x1 > 0 && s->width == film->width && s->height == film->height;
        s->crop_x0 = part ? film->crop_x0 : 0;
        s->crop_x1 = part ? film->crop_x1 : s->width;
        s->crop_y0 = part ? film->crop_y0 : 0;
        s->crop_y1 = part ? film->crop_y1 : s->height;
    }
    if (s->crop_x0 < s->crop_x1 && s->crop_y0 < s->crop_y1 && s->crop_x1 <= s->width &&
        s->crop_y1 <= s->height)
        return AUR_OK;
    return aur_fail(
        error, AUR_ERROR_ARGUMENT,
        "crop %zu,%zu,%zu,%zu is not a part of the image: 0 <= x0 < x1 <= %zu and 0 <= y0 < y1 <= %zu",
        s->crop_x0, s->crop_x1, s->crop_y0, s->crop_y1, s->width, s->height);
}

/* A missing side follows from the other one by the scene's aspect ratio. */
static void complete_size(const aur_film_settings *film, aur_render_options *options) {
    const double aspect = (double)film->width / (double)film->height;
    if (options->width == 0)
        options->width =
            options->height == 0 ? film->width : (size_t)fmax(1.0, round((double)options->height * aspect));
    if (options->height == 0)
        options->height = options->width == film->width
                              ? film->height
                              : (size_t)fmax(1.0, round((double)options->width / aspect));
}

aur_result aur_render_options_complete(const aur_scene *scene, aur_render_options *options,
                                       const aur_filter **filter, aur_error *error) {
    const aur_film_settings *const film = aur_scene_film(scene);
    *filter = film->filter;
    complete_size(film, options);
    if (options->samples_per_pixel == 0)
        options->samples_per_pixel = aur_scene_samples_per_pixel(scene);
    if (options->sampler == NULL)
        options->sampler = aur_scene_sampler(scene);
    const aur_result result = find_filter(options->filter, filter, error);
    return result == AUR_OK ? complete_crop(film, options, error) : result;
}
