#include "render/image/format.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/names.h"

static double clamp_unit(double value) {
    if (!(value > 0.0))
        return 0.0;
    return value < 1.0 ? value : 1.0;
}

double aur_srgb_encode(double linear) {
    const double x = clamp_unit(linear);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

double aur_srgb_decode(double encoded) {
    const double x = clamp_unit(encoded);
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

/* Hable 2010, "Filmic Tonemapping Operators": shoulder A, linear strength B and angle C, toe D, E, F. */
static double hable(double x) {
    const double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
    return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

static double filmic(double radiance) {
    const double exposure_bias = 2.0, white = 11.2;
    if (exposure_bias * radiance >= white)
        return 1.0;
    return clamp_unit(hable(exposure_bias * radiance) / hable(white));
}

double aur_tone_apply(aur_tone tone, double radiance) {
    if (!(radiance > 0.0))
        return 0.0;
    return tone == AUR_TONE_FILMIC ? filmic(radiance) : clamp_unit(radiance);
}

static const char *const tone_names[] = {"srgb", "filmic"};
enum { TONE_NAMES = sizeof tone_names / sizeof tone_names[0] };

aur_result aur_tone_from_name(const char *name, aur_tone *tone, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of(TONE_NAMES, tone_names), "tone", name,
                                               (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *tone = (aur_tone)index;
    return result;
}

const char *aur_tone_name(aur_tone tone) {
    return (size_t)tone < TONE_NAMES ? tone_names[tone] : NULL;
}

unsigned char *aur_image_display(const aur_image_target *target, const aur_image *image,
                                 size_t *channel_count) {
    const size_t *const channels = target->channels;
    const size_t count = channels[0] == channels[1] ? 1 : 3;
    const size_t pixels = image->width * image->height;
    unsigned char *const bytes = malloc(pixels * count);
    const double factor = exp2((double)target->options.exposure);
    *channel_count = count;
    for (size_t i = 0; bytes != NULL && i < pixels; ++i)
        for (size_t c = 0; c < count; ++c) {
            const double radiance = factor * (double)image->data[i * image->channel_count + channels[c]];
            const double shown = aur_srgb_encode(aur_tone_apply(target->options.tone, radiance));
            bytes[i * count + c] = (unsigned char)(shown * 255.0 + 0.5);
        }
    return bytes;
}

const aur_key aur_display_keys[AUR_DISPLAY_KEY_COUNT] = {
    {AUR_KEY_OF_REAL(aur_image_write_options, "exposure", exposure, -INFINITY, INFINITY, "0",
                     "radiance is multiplied by 2 to this power")},
    {AUR_KEY_OF_CHOICE(aur_image_write_options, "tone", tone, "srgb",
                       "the tone curve; with srgb radiance 1 is white", "srgb", "filmic")},
};
