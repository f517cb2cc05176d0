/* The inside of a picture. */
#pragma once

#include <aureole-render/image.h>

enum { AUR_NOTES_CAPACITY = 512 };

struct aur_image {
    size_t width, height, channel_count;
    float *data;        /* data[(y * width + x) * channel_count + c]; the top row first */
    bool data_is_owned; /* false: the caller's, see aur_image_wrap */
    char (*channel_names)[AUR_CHANNEL_NAME_CAPACITY];
    bool chosen; /* one or three channels that the caller chose: they are the colour, whatever their names */
    char notes[AUR_NOTES_CAPACITY];
};
