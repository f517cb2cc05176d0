/* What the page of a render that is watched consists of: texts from memory that the caller frees, NULL when
 * there is none left. */
#pragma once

#include "program/report/page/page.h"

extern const report_asset watch_assets[]; /* ends without a name */

/* The page itself, which asks for all else. */
char *watch_page(const char *title, size_t *size);

/* A part of a picture that is seen at once: three channels, or one. */
typedef struct watch_layer {
    char name[AUR_CHANNEL_NAME_CAPACITY]; /* "albedo" */
    size_t channel, channel_count;
} watch_layer;

enum { WATCH_LAYER_LIMIT = 80 };

/* Channels in turn whose names have the same beginning before a dot are one layer where they are three, such
 * as R, G, B. Returns how many layers there are, at most WATCH_LAYER_LIMIT. */
size_t watch_layers(const aur_image *image, watch_layer layers[WATCH_LAYER_LIMIT]);

/* One layer of a picture as `unpack` of src/program/report/page/pictures.js takes it. */
char *watch_picture(const aur_image *image, const watch_layer *layer, size_t *size);
