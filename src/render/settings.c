#include "render/settings.h"

#include "core/error.h"
#include "scene/filter.h"

static aur_result read_filter(const char *name, aur_render_settings *s, aur_error *error) {
    if (name == NULL)
        return AUR_OK;
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of_table(&aur_filter_table), "filter", name,
                                               (aur_location){0}, &index, error);
    if (result == AUR_OK)
        s->filter = aur_filter_find(name);
    return result;
}

static aur_result read_crop(const aur_film_settings *film, const aur_render_options *options,
                            aur_render_settings *s, aur_error *error) {
    s->x0 = options->crop_x0;
    s->x1 = options->crop_x1;
    s->y0 = options->crop_y0;
    s->y1 = options->crop_y1;
    if (s->x0 == 0 && s->x1 == 0 && s->y0 == 0 && s->y1 == 0) {
        /* The film's own part holds for its own size. */
        const bool part = film->crop_x1 > 0 && s->width == film->width && s->height == film->height;
        s->x0 = part ? film->crop_x0 : 0;
        s->x1 = part ? film->crop_x1 : s->width;
        s->y0 = part ? film->crop_y0 : 0;
        s->y1 = part ? film->crop_y1 : s->height;
    }
    if (s->x0 < s->x1 && s->y0 < s->y1 && s->x1 <= s->width && s->y1 <= s->height)
        return AUR_OK;
    return aur_fail(
        error, AUR_ERROR_ARGUMENT,
        "crop %zu,%zu,%zu,%zu is not a part of the picture: 0 <= x0 < x1 <= %zu and 0 <= y0 < y1 <= %zu",
        s->x0, s->x1, s->y0, s->y1, s->width, s->height);
}

aur_result aur_render_settings_read(const aur_scene *scene, const aur_render_options *options,
                                    aur_render_settings *s, aur_error *error) {
    const aur_film_settings *const film = aur_scene_film(scene);
    *s = (aur_render_settings){
        .width = options->width > 0 ? options->width : film->width,
        .height = options->height > 0 ? options->height : film->height,
        .samples_per_pixel =
            options->samples_per_pixel > 0 ? options->samples_per_pixel : aur_scene_samples_per_pixel(scene),
        .filter = film->filter,
        .sampler = options->sampler != NULL ? options->sampler : aur_scene_sampler(scene),
        .seed = options->seed,
        .threads = options->threads,
        .progress = options->progress,
        .warnings = options->warnings};
    const aur_result result = read_filter(options->filter, s, error);
    return result == AUR_OK ? read_crop(film, options, s, error) : result;
}
