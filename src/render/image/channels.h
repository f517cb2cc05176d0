/* The roles of channels, by the names that OpenEXR and other programs give them, in either case. */
#pragma once

#include "render/image/format.h"

typedef enum aur_channel_role {
    AUR_CHANNEL_RED, /* the order in which channels of a layer are sorted */
    AUR_CHANNEL_GREEN,
    AUR_CHANNEL_BLUE,
    AUR_CHANNEL_X,
    AUR_CHANNEL_Y, /* luminance, or the second of X, Y, Z */
    AUR_CHANNEL_ALPHA,
    AUR_CHANNEL_Z, /* depth, or the third of X, Y, Z */
    AUR_CHANNEL_OTHER,
    AUR_CHANNEL_RY, /* (R - Y) / Y */
    AUR_CHANNEL_BY,
    AUR_CHANNEL_DATA /* known, and no colour */
} aur_channel_role;

/* The length of a name's layer, its dot included; 0 without one. */
size_t aur_channel_layer(const char *name);
aur_channel_role aur_channel_role_of(const char *name);
/* The first channel of a role in the layer that the name `layer` stands in; SIZE_MAX when there is none. */
size_t aur_image_find_role(const aur_image *image, const char *layer, aur_channel_role role);
