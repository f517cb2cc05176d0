#include "cli/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/kinds.h"

const cli_option cli_picture_options[] = {
    {CLI_TEXT(cli_picture, channels, "channels", "NAME", NULL, "only these channels, in this order"),
     .list = true},
    {CLI_INTEGER(cli_picture, downsample, "downsample", "N", 1, INFINITY, "1",
                 "average blocks of N x N pixels")},
    {.key = {0}}};

const char *cli_picture_format(unsigned index) {
    const aur_table *const formats = cli_find_table("picture");
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

int cli_read_picture(const char *path, const cli_picture *options, aur_image **image) {
    aur_error error;
    aur_result result = aur_image_read(path, image, &error);
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
    return cli_status(result, &error);
}
