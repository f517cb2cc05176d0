/* What the channels of an image are by their names: never guessed by their order. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "render/image/format.h"

size_t aur_channel_layer(const char *name) {
    const char *const dot = strrchr(name, '.');
    return dot != NULL ? (size_t)(dot + 1 - name) : 0;
}

aur_channel_role aur_channel_role_of(const char *name) {
    static const struct {
        const char *name;
        aur_channel_role role;
    } names[] = {{"R", AUR_CHANNEL_RED},       {"red", AUR_CHANNEL_RED},    {"G", AUR_CHANNEL_GREEN},
                 {"green", AUR_CHANNEL_GREEN}, {"B", AUR_CHANNEL_BLUE},     {"blue", AUR_CHANNEL_BLUE},
                 {"X", AUR_CHANNEL_X},         {"Y", AUR_CHANNEL_Y},        {"grey", AUR_CHANNEL_Y},
                 {"gray", AUR_CHANNEL_Y},      {"A", AUR_CHANNEL_ALPHA},    {"alpha", AUR_CHANNEL_ALPHA},
                 {"Z", AUR_CHANNEL_Z},         {"ZBack", AUR_CHANNEL_DATA}, {"RY", AUR_CHANNEL_RY},
                 {"BY", AUR_CHANNEL_BY},       {"AR", AUR_CHANNEL_DATA},    {"AG", AUR_CHANNEL_DATA},
                 {"AB", AUR_CHANNEL_DATA},     {"id", AUR_CHANNEL_DATA}};
    const char *const base = name + aur_channel_layer(name);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        if (strcasecmp(base, names[i].name) == 0)
            return names[i].role;
    return AUR_CHANNEL_OTHER;
}

static bool same_layer(const char *a, const char *b) {
    const size_t length = aur_channel_layer(a);
    return aur_channel_layer(b) == length && strncmp(a, b, length) == 0;
}

size_t aur_image_find_role(const aur_image *image, const char *layer, aur_channel_role role) {
    for (size_t c = 0; c < image->channel_count; ++c)
        if (same_layer(image->channel_names[c], layer) &&
            aur_channel_role_of(image->channel_names[c]) == role)
            return c;
    return SIZE_MAX;
}

size_t aur_image_find_channel(const aur_image *image, const char *name) {
    for (size_t c = 0; c < image->channel_count; ++c)
        if (strcmp(image->channel_names[c], name) == 0)
            return c;
    return SIZE_MAX;
}

/* Red, green and blue of the layer that a name is in; Y for all three where there are neither X and Z nor
 * chroma. */
static bool colors_of_layer(const aur_image *image, const char *name, size_t channels[3]) {
    size_t found = 0;
    for (size_t i = 0; i < 3; ++i) {
        channels[i] = aur_image_find_role(image, name, (aur_channel_role)(AUR_CHANNEL_RED + i));
        found += channels[i] != SIZE_MAX;
    }
    if (found == 3)
        return true;
    channels[0] = channels[1] = channels[2] = aur_image_find_role(image, name, AUR_CHANNEL_Y);
    return channels[0] != SIZE_MAX && aur_image_find_role(image, name, AUR_CHANNEL_X) == SIZE_MAX &&
           aur_image_find_role(image, name, AUR_CHANNEL_RY) == SIZE_MAX;
}

static bool is_first_of_layer(const aur_image *image, size_t channel) {
    for (size_t c = 0; c < channel; ++c)
        if (same_layer(image->channel_names[c], image->channel_names[channel]))
            return false;
    return true;
}

static bool is_combined(const char *name) {
    const size_t length = aur_channel_layer(name);
    return length >= 9 && strncasecmp(name + length - 9, "Combined.", 9) == 0 &&
           (length == 9 || name[length - 10] == '.');
}

/* The colours of the only layer that has any, or the only one called Combined. */
static bool colors_of_layers(const aur_image *image, size_t channels[3]) {
    size_t layers = 0, combined = 0, there[3];
    for (size_t c = 0; c < image->channel_count; ++c) {
        const char *const name = image->channel_names[c];
        if (aur_channel_layer(name) == 0 || !is_first_of_layer(image, c) ||
            !colors_of_layer(image, name, there))
            continue;
        ++layers;
        combined += is_combined(name);
        if (layers == 1 || (combined == 1 && is_combined(name)))
            memcpy(channels, there, sizeof there);
    }
    return layers == 1 || combined == 1;
}

bool aur_image_color_channels(const aur_image *image, size_t channels[3]) {
    if (colors_of_layer(image, "", channels))
        return true;
    const bool single = image->channel_count == 1;
    for (size_t i = 0; i < 3; ++i)
        channels[i] = single ? 0 : i;
    if (image->chosen || (single && aur_channel_role_of(image->channel_names[0]) == AUR_CHANNEL_OTHER))
        return true;
    return colors_of_layers(image, channels);
}

void aur_image_count_odd(const aur_image *image, size_t channel, size_t found[3]) {
    const size_t pixels = channel < image->channel_count ? image->width * image->height : 0;
    for (size_t i = 0; i < pixels; ++i) {
        const float value = image->data[i * image->channel_count + channel];
        found[0] += value == INFINITY;
        found[1] += isnan(value);
        found[2] += value < 0.0f;
    }
}

void aur_image_list_channels(const aur_image *image, size_t capacity, char *text) {
    text[0] = '\0';
    for (size_t c = 0; c < image->channel_count; ++c) {
        const size_t used = strlen(text);
        snprintf(text + used, capacity - used, "%s%s", c > 0 ? ", " : "", image->channel_names[c]);
    }
}

aur_result aur_image_require_color(const char *name, const aur_image *image, size_t channels[3],
                                   aur_error *error) {
    if (aur_image_color_channels(image, channels))
        return AUR_OK;
    char list[400];
    aur_image_list_channels(image, sizeof list, list);
    return aur_fail_at(
        error, (aur_location){.file = name}, AUR_ERROR_ARGUMENT,
        "has no channels R, G, B or Y, by themselves or in a single layer: choose one or three by "
        "'aureole convert --channels' (it has %s)",
        list);
}
