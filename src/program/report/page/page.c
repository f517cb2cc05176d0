#include "program/report/page/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/report/canvas.h"

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length >= end_length && strcmp(text + length - end_length, end) == 0;
}

/* Writes every asset of a kind, sorted by name. */
static void put_assets(FILE *page, const char *extension) {
    for (const report_asset *asset = report_assets; asset->name != NULL; ++asset)
        if (ends_with(asset->name, extension))
            fwrite(asset->text, 1, asset->size, page);
}

void report_page_begin(FILE *page, const char *title) {
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
          page);
    report_escape(page, title);
    fputs("</title>\n<style>\n", page);
    put_assets(page, ".css");
    fputs("</style>\n</head>\n<body>\n<header class=\"bar\"><h1>", page);
    report_escape(page, title);
    fputs("</h1> <button type=\"button\" class=\"theme\">Dark / light</button></header>\n", page);
}

aur_result report_false_color(size_t count, uint32_t *colors, aur_error *error) {
    aur_image *ramp = NULL, *colored = NULL;
    aur_result result = aur_image_create(count, 1, 1, &ramp, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        aur_image_data(ramp)[i] = (float)i;
    if (result == AUR_OK)
        result = aur_image_false_color(ramp, (double)(count - 1), &colored, error);
    for (size_t i = 0; i < 3 * count && result == AUR_OK; ++i) {
        const double v = (double)aur_image_data(colored)[i];
        const double shown = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055;
        colors[i / 3] = colors[i / 3] << 8 | (uint32_t)lround(255.0 * fmin(fmax(shown, 0.0), 1.0));
    }
    aur_image_destroy(ramp);
    aur_image_destroy(colored);
    return result;
}

aur_result report_page_end(FILE *page, aur_error *error) {
    uint32_t colors[256] = {0};
    const aur_result result = report_false_color(256, colors, error);
    fputs("<script id=\"palette\" type=\"text/plain\">", page);
    for (size_t i = 0; i < 256; ++i)
        fprintf(page, "%06x", (unsigned)colors[i] & 0xffffff);
    fputs("</script>\n<script>\n", page);
    put_assets(page, ".js");
    fputs("</script>\n</body>\n</html>\n", page);
    return result;
}
