#include "program/cli/render/image_input.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "program/cli/listing.h"

const cli_option cli_image_input_options[] = {
    {CLI_TEXT(cli_image_input, channels, "channels", "NAME", NULL, "channels to use, in this order"),
     .list = true},
    {CLI_INTEGER(cli_image_input, downsample, "downsample", "N", 1, INFINITY, "1",
                 "average blocks of N x N pixels")},
    {CLI_CHOICE(cli_image_input, luminance, "luminance", "WEIGHTS", "none",
                "luminance in cd/m2 instead of colours: 179 lm/W and Radiance's weights of r, g, b; 179 lm/W "
                "and those of Rec. 709; or these and 683 lm/W (photopic)"),
     .key.words = (const char *const[]){"none", "radiance", "rec709", "photopic", NULL}},
    {.key = {0}}};

const char *cli_image_input_format(unsigned index) {
    const aur_table *const formats = cli_find_table("image");
    const aur_row *row;
    for (size_t i = 0; i < formats->count; ++i)
        if (aur_image_find_writer("", formats->rows[i]->name, &row, NULL) == AUR_OK && index-- == 0)
            return row->name;
    return NULL;
}

static aur_result select_channels(const cli_list *channels, aur_image **image, aur_error *error) {
    const char **const names = calloc(channels->count, sizeof *names);
    if (names == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < channels->count; ++i)
        names[i] = cli_list_at(channels, i);
    aur_image *const all = *image;
    const aur_result result = aur_image_select(all, channels->count, names, image, error);
    aur_image_destroy(all);
    free(names);
    return result;
}

static void __attribute__((format(printf, 1, 2))) warn(const char *format, ...) {
    const aur_warnings warnings = cli_warnings(false);
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    warnings.function(warnings.user, text);
}

void cli_warn_of_values(const char *path, const aur_image *image, bool negative, const char *fate) {
    size_t found[3] = {0, 0, 0}, channels[3];
    const bool colors = negative && aur_image_color_channels(image, channels);
    const size_t count = !colors ? aur_image_channel_count(image) : channels[0] == channels[1] ? 1 : 3;
    for (size_t c = 0; c < count; ++c)
        aur_image_count_odd(image, colors ? channels[c] : c, found);
    if (found[0] + found[1] > 0 || (negative && found[2] > 0))
        warn("%s: %zu infinite, %zu NaN and %zu negative values: %s", path, found[0], found[1], found[2],
             fate);
}

int cli_read_image(const char *path, const cli_image_input *options, aur_image **image) {
    aur_error error;
    aur_result result = aur_image_read(path, image, &error);
    if (result == AUR_OK && aur_image_notes(*image)[0] != '\0')
        warn("%s: %s", path, aur_image_notes(*image));
    if (result == AUR_OK && options->channels.count > 0) {
        result = select_channels(&options->channels, image, &error);
        snprintf(error.file, sizeof error.file, "%s", path);
    }
    if (result == AUR_OK && options->downsample > 1) {
        aur_image *const whole = *image;
        *image = NULL;
        result = aur_image_downsample(whole, options->downsample, image, &error);
        aur_image_destroy(whole);
    }
    if (result == AUR_OK && options->luminance != CLI_LUMINANCE_NONE)
        result = cli_image_luminance(options->luminance, image, &error);
    return cli_status(result, &error);
}
