#include "program/cli/render/denoise.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const cli_option cli_denoise_options[] = {
    {CLI_FLAG(
        cli_denoise, enabled, "denoise",
        "denoise with Open Image Denoise (library from AUREOLE_OIDN or the system), by the filter box unless "
        "--filter names one; the noisy image is written to the channels noisy.R, noisy.G, noisy.B")},
    {.key = {0}}};

aur_result cli_denoise_begin(cli_denoise *denoise, aur_error *error) {
    return denoise->enabled ? cli_oidn_open(&denoise->library, error) : AUR_OK;
}

void cli_denoise_end(cli_denoise *denoise) {
    cli_oidn_close(denoise->library);
    denoise->library = NULL;
}

/* Half of the image's samples per pixel, of one ray each. Fewer show in the denoised image, many more do not.
 */
static size_t feature_samples(aur_adaptive *adaptive) {
    const double part = 0.5, least = 8.0, most = 64.0;
    enum { UNKNOWN_SAMPLES = 16 };
    aur_adaptive_report report = {.size = sizeof report};
    if (adaptive == NULL)
        return UNKNOWN_SAMPLES;
    aur_adaptive_get_report(adaptive, &report, NULL);
    return (size_t)fmin(fmax(part * report.samples_per_pixel, least), most);
}

/* Renders albedo, normals and directly visible light. */
static aur_result render_features(aur_renderer *renderer, const aur_render_options *options, size_t samples,
                                  aur_image **features, aur_error *error) {
    aur_render_options aov_options = *options;
    aov_options.integrator = "aov:aovs=(albedo:reflectance,normal:sh_normal),integrator=none";
    aov_options.sampler = "sobol";
    aov_options.samples_per_pixel = samples;
    aov_options.resumable = false;
    aov_options.warnings = (aur_warnings){0};
    return aur_renderer_render(renderer, &aov_options, features, NULL, error);
}

/* Copies channels to the next free channels of an image, with a prefix that makes the names unique. */
static aur_result add_channels(aur_image *to, size_t *count, const aur_image *from, size_t first, size_t end,
                               const char *prefix, aur_error *error) {
    const size_t pixels = aur_image_width(to) * aur_image_height(to);
    const size_t into = aur_image_channel_count(to), stride = aur_image_channel_count(from);
    aur_result result = AUR_OK;
    for (size_t c = first; c < end && result == AUR_OK; ++c) {
        char name[AUR_CHANNEL_NAME_CAPACITY + 8];
        snprintf(name, sizeof name, "%s%s", prefix, aur_image_channel_name(from, c));
        result = aur_image_name_channel(to, *count, name, error);
        for (size_t i = 0; i < pixels; ++i)
            aur_image_data(to)[i * into + *count] = aur_image_data(from)[i * stride + c];
        ++*count;
    }
    return result;
}

/* The channels of the image, then the additional ones. */
static aur_result put_together(const aur_image *image, const aur_image *features, aur_image **whole,
                               aur_error *error) {
    const size_t image_channels = aur_image_channel_count(image), all = aur_image_channel_count(features);
    const bool has_features = aur_image_find_channel(image, "albedo.R") != SIZE_MAX ||
                              aur_image_find_channel(image, "normal.X") != SIZE_MAX;
    size_t count = 0;
    aur_result result = aur_image_create(aur_image_width(image), aur_image_height(image),
                                         image_channels + 3 + (has_features ? 0 : all - 3), whole, error);
    if (result == AUR_OK)
        result = add_channels(*whole, &count, image, 0, image_channels, "", error);
    if (result == AUR_OK)
        result = add_channels(*whole, &count, image, 0, 3, "noisy.", error);
    if (result == AUR_OK && !has_features)
        result = add_channels(*whole, &count, features, 3, all, "", error);
    return result;
}

/* Writes to the first channels of `out`. */
static aur_result denoise(const cli_denoise *denoise, const aur_image *image, aur_image *features,
                          aur_image *out, aur_error *error) {
    aur_image *rest = NULL;
    aur_result result = cli_direct_light_subtract(image, features, &rest, error);
    if (result == AUR_OK)
        result = cli_oidn_run(denoise->library, rest, features, out, error);
    if (result == AUR_OK)
        result = cli_direct_light_restore(image, features, out, error);
    aur_image_destroy(rest);
    return result;
}

/* The error of the denoised halves of the samples. */
static aur_result denoise_halves(const cli_denoise *denoiser, const aur_adaptive *adaptive,
                                 aur_image *features, aur_error_figures *figures, aur_error *error) {
    aur_image *denoised[2] = {NULL, NULL};
    aur_result result = AUR_OK;
    for (size_t h = 0; h < 2 && result == AUR_OK; ++h) {
        aur_image *half = NULL;
        result = aur_adaptive_develop_half(adaptive, h, &half, error);
        if (result == AUR_OK)
            result = aur_image_create(aur_image_width(half), aur_image_height(half), 3, &denoised[h], error);
        if (result == AUR_OK)
            result = denoise(denoiser, half, features, denoised[h], error);
        aur_image_destroy(half);
    }
    if (result == AUR_OK)
        result = aur_adaptive_compare_halves(adaptive, (const aur_image *const[2]){denoised[0], denoised[1]},
                                             figures, error);
    aur_image_destroy(denoised[0]);
    aur_image_destroy(denoised[1]);
    return result;
}

aur_result cli_denoise_image(const cli_denoise *denoiser, aur_renderer *renderer,
                             const aur_render_options *options, aur_adaptive *adaptive, bool bounds,
                             aur_image **image, aur_error_figures *figures, aur_error *error) {
    *figures = (aur_error_figures){.error = 0.0};
    if (!denoiser->enabled)
        return AUR_OK;
    aur_image *features = NULL, *whole = NULL;
    aur_result result = render_features(renderer, options, feature_samples(adaptive), &features, error);
    if (result == AUR_OK)
        result = put_together(*image, features, &whole, error);
    if (result == AUR_OK)
        result = denoise(denoiser, *image, features, whole, error);
    if (result == AUR_OK && adaptive != NULL && bounds)
        result = denoise_halves(denoiser, adaptive, features, figures, error);
    aur_image_destroy(features);
    if (result != AUR_OK) {
        aur_image_destroy(whole);
        return result;
    }
    aur_image_destroy(*image);
    *image = whole;
    return AUR_OK;
}

aur_result cli_denoise_write_noisy(const cli_denoise *denoise, const char *output, const aur_image *image,
                                   aur_error *error) {
    const aur_row *format = NULL;
    if (!denoise->enabled || aur_image_find_writer(output, NULL, &format, error) != AUR_OK ||
        strcmp(format->name, "exr") == 0)
        return AUR_OK;
    char path[PATH_MAX];
    const char *const slash = strrchr(output, '/'), *const dot = strrchr(slash != NULL ? slash : output, '.');
    snprintf(path, sizeof path, "%.*s.noisy.exr", dot != NULL ? (int)(dot - output) : (int)strlen(output),
             output);
    aur_image *noisy = NULL;
    aur_result result =
        aur_image_select(image, 3, (const char *const[]){"noisy.R", "noisy.G", "noisy.B"}, &noisy, error);
    for (size_t c = 0; c < 3 && result == AUR_OK; ++c)
        result = aur_image_name_channel(noisy, c, (const char *const[]){"R", "G", "B"}[c], error);
    if (result == AUR_OK)
        result = aur_image_write(path, noisy, NULL, error);
    aur_image_destroy(noisy);
    return result;
}
