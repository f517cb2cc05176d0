#include "program/watch/watch.h"

#include <stdlib.h>
#include <string.h>

char *watch_page(const char *title, size_t *size) {
    char *text = NULL;
    FILE *const page = open_memstream(&text, size);
    if (page == NULL)
        return NULL;
    report_page_begin(page, title);
    fputs("<p id=\"said\" class=\"pale\" role=\"status\">Waiting for the image.</p>\n"
          "<progress id=\"share\" max=\"1\" value=\"0\"></progress>\n"
          "<figure class=\"viewer\" data-live></figure>\n",
          page);
    for (const report_asset *asset = watch_assets; asset->name != NULL; ++asset)
        fprintf(page, "<script>\n%.*s</script>\n", (int)asset->size, (const char *)asset->text);
    const bool good = report_page_end(page, NULL) == AUR_OK;
    if (fclose(page) == 0 && good)
        return text;
    free(text);
    return NULL;
}

/* The length of a channel's name before its last dot. */
static size_t stem_of(const char *name) {
    const char *const dot = strrchr(name, '.');
    return dot != NULL ? (size_t)(dot - name) : 0;
}

static bool same_stem(const aur_image *image, size_t channel, size_t other) {
    const char *const a = aur_image_channel_name(image, channel), *const b =
                                                                      aur_image_channel_name(image, other);
    return b != NULL && stem_of(a) == stem_of(b) && strncmp(a, b, stem_of(a)) == 0;
}

size_t watch_layers(const aur_image *image, watch_layer layers[WATCH_LAYER_LIMIT]) {
    const size_t channels = aur_image_channel_count(image);
    size_t count = 0, next = 0;
    for (size_t channel = 0; channel < channels && count < WATCH_LAYER_LIMIT; channel = next) {
        const char *const name = aur_image_channel_name(image, channel);
        next = channel + 1;
        while (next < channel + 3 && same_stem(image, channel, next))
            ++next;
        const size_t stem = stem_of(name);
        const bool colour = next == channel + 3;
        if (!colour)
            next = channel + 1;
        watch_layer *const layer = &layers[count++];
        *layer = (watch_layer){.channel = channel, .channel_count = next - channel};
        if (colour && stem == 0)
            memcpy(layer->name, "image", sizeof "image");
        else
            memcpy(layer->name, name, colour ? stem : strlen(name));
    }
    return count;
}

char *watch_layer_json(const aur_image *image, const watch_layer *layer, size_t *size) {
    const char *names[3];
    for (size_t c = 0; c < layer->channel_count; ++c)
        names[c] = aur_image_channel_name(image, layer->channel + c);
    aur_image *part = NULL;
    char *text = NULL;
    if (aur_image_select(image, layer->channel_count, names, &part, NULL) != AUR_OK)
        return NULL;
    const report_image image_options = {.name = layer->name, .image = part, .quick = true};
    FILE *const stream = open_memstream(&text, size);
    const bool good = stream != NULL && report_put_image(stream, &image_options, NULL) == AUR_OK;
    aur_image_destroy(part);
    if (stream != NULL && fclose(stream) == 0 && good)
        return text;
    free(text);
    return NULL;
}
