/* PNG with antialiasing by coverage, blended in sRGB values. */
#include <aureole-render/image.h>
#include <math.h>
#include <stb_easy_font.h> /* letters made of rectangles, one pixel wide */
#include <stdlib.h>
#include <string.h>

#include "program/report/canvas.h"

static void begin(report_canvas *c) {
    const size_t size = 3 * (size_t)c->width * (size_t)c->height;
    c->pixels = malloc(size * sizeof *c->pixels);
    for (size_t i = 0; i < size && c->pixels != NULL; ++i)
        c->pixels[i] = 1.0f;
}

static void cover(report_canvas *c, size_t x, size_t y, uint32_t rgb, double part) {
    float *const pixel = c->pixels + 3 * (y * (size_t)c->width + x);
    for (size_t i = 0; i < 3; ++i) {
        const double ink = (double)(rgb >> (16 - 8 * i) & 255) / 255.0;
        pixel[i] = (float)((double)pixel[i] * (1.0 - part) + ink * part);
    }
}

/* The pixels of a box: from[2] to to[2], exclusive. */
static void clip(const report_canvas *c, const double low[2], const double high[2], size_t from[2],
                 size_t to[2]) {
    const double size[2] = {c->width, c->height};
    for (size_t i = 0; i < 2; ++i) {
        from[i] = (size_t)fmin(fmax(floor(low[i]), 0.0), size[i]);
        to[i] = (size_t)fmin(fmax(ceil(high[i]), 0.0), size[i]);
    }
}

/* The distance of a point from a line segment. */
static double distance(const double a[2], const double b[2], double x, double y) {
    const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    const double t = square > 0.0 ? fmin(fmax(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0.0), 1.0) : 0.0;
    return hypot(x - a[0] - t * dx, y - a[1] - t * dy);
}

static void stroke(report_canvas *c, const report_pen *pen, const double a[2], const double b[2]) {
    const double reach = 0.5 * pen->width + 0.5;
    const double low[2] = {fmin(a[0], b[0]) - reach, fmin(a[1], b[1]) - reach};
    const double high[2] = {fmax(a[0], b[0]) + reach, fmax(a[1], b[1]) + reach};
    size_t from[2], to[2];
    clip(c, low, high, from, to);
    for (size_t y = from[1]; y < to[1]; ++y)
        for (size_t x = from[0]; x < to[0]; ++x) {
            const double depth = reach - distance(a, b, (double)x + 0.5, (double)y + 0.5);
            if (depth > 0.0)
                cover(c, x, y, pen->rgb, fmin(depth, fmin(1.0, pen->width)));
        }
}

/* Dashes of five in eight pixels; `phase` is the length before the segment. */
static void dash(report_canvas *c, const report_pen *pen, const double a[2], const double b[2],
                 double *phase) {
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    for (double at = -fmod(*phase, 8.0); at < length; at += 8.0) {
        const double s = fmax(at, 0.0) / length, t = fmin(at + 5.0, length) / length;
        const double p[2] = {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
        const double q[2] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
        if (s < t)
            stroke(c, pen, p, q);
    }
    *phase += length;
}

/* Whether a polygon contains a point. */
static bool inside(size_t count, const double *xy, double x, double y) {
    bool in = false;
    for (size_t i = 0, k = count - 1; i < count; k = i++)
        if ((xy[2 * i + 1] > y) != (xy[2 * k + 1] > y) &&
            x < xy[2 * i] + (y - xy[2 * i + 1]) / (xy[2 * k + 1] - xy[2 * i + 1]) * (xy[2 * k] - xy[2 * i]))
            in = !in;
    return in;
}

static void fill(report_canvas *c, const report_pen *pen, size_t count, const double *xy) {
    enum { PARTS = 4 };
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < 2 * count; ++i) {
        low[i % 2] = fmin(low[i % 2], xy[i]);
        high[i % 2] = fmax(high[i % 2], xy[i]);
    }
    size_t from[2], to[2];
    clip(c, low, high, from, to);
    for (size_t y = from[1]; y < to[1]; ++y)
        for (size_t x = from[0]; x < to[0]; ++x) {
            size_t covered = 0;
            for (size_t i = 0; i < PARTS * PARTS; ++i)
                covered += inside(count, xy, (double)x + ((double)(i % PARTS) + 0.5) / PARTS,
                                  (double)y + ((double)(i / PARTS) + 0.5) / PARTS);
            if (covered > 0)
                cover(c, x, y, pen->rgb, (double)covered / (PARTS * PARTS));
        }
}

static void path(report_canvas *c, const report_pen *pen, bool closed, size_t count, const double *xy) {
    double phase = 0.0;
    if (c->pixels == NULL)
        return;
    if (pen->width <= 0.0)
        fill(c, pen, count, xy);
    for (size_t i = 1; i < count + closed && pen->width > 0.0; ++i)
        if (pen->dashed)
            dash(c, pen, xy + 2 * (i - 1), xy + 2 * (i % count), &phase);
        else
            stroke(c, pen, xy + 2 * (i - 1), xy + 2 * (i % count));
}

static void circle(report_canvas *c, const report_pen *pen, double x, double y, double radius) {
    const double reach = radius + 0.5 * pen->width + 0.5;
    const double low[2] = {x - reach, y - reach}, high[2] = {x + reach, y + reach};
    size_t from[2], to[2];
    clip(c, low, high, from, to);
    for (size_t py = from[1]; py < to[1] && c->pixels != NULL; ++py)
        for (size_t px = from[0]; px < to[0]; ++px) {
            const double r = hypot((double)px + 0.5 - x, (double)py + 0.5 - y);
            const double depth = pen->width > 0.0 ? 0.5 * pen->width + 0.5 - fabs(r - radius) : reach - r;
            if (depth > 0.0)
                cover(c, px, py, pen->rgb, fmin(depth, 1.0));
        }
}

static void text(report_canvas *c, double x, double y, double anchor, bool turned, const char *words) {
    enum { LETTERS = 256, BASELINE = 8 };
    char ascii[LETTERS];
    size_t count = 0;
    for (uint32_t letter; count + 1 < LETTERS && (letter = report_next_letter(&words)) != 0;)
        ascii[count++] = letter >= ' ' && letter < 127 ? (char)letter : '?';
    ascii[count] = '\0';
    struct {
        float at[3];
        unsigned char color[4];
    } *const corners = malloc(4 * 64 * LETTERS * sizeof *corners);
    if (corners == NULL || c->pixels == NULL) {
        free(corners);
        return;
    }
    const int bytes = (int)(4 * 64 * LETTERS * sizeof *corners);
    const size_t quads = (size_t)stb_easy_font_print(0, 0, ascii, NULL, corners, bytes);
    const double shift = round(anchor * stb_easy_font_width(ascii));
    const report_pen pen = report_pen_of(REPORT_INK_TEXT, 0.0);
    for (size_t q = 0; q < quads; ++q) {
        double xy[8];
        for (size_t i = 0; i < 4; ++i) {
            const double right = (double)corners[4 * q + i].at[0] - shift;
            const double down = (double)corners[4 * q + i].at[1] - BASELINE;
            xy[2 * i] = round(x) + (turned ? down : right);
            xy[2 * i + 1] = round(y) + (turned ? -right : down);
        }
        fill(c, &pen, 4, xy);
    }
    free(corners);
}

static void end(report_canvas *c) {
    for (size_t i = 0; i < 3 * (size_t)c->width * (size_t)c->height && c->pixels != NULL; ++i) {
        const double v = (double)c->pixels[i]; /* linear light, as images store */
        c->pixels[i] = (float)(v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
}

static aur_result save_image(const char *path, report_canvas *c, aur_error *error) {
    const aur_image_write_options options = {.size = sizeof options, .format = "png"};
    const size_t width = (size_t)c->width, height = (size_t)c->height;
    aur_image *image = NULL;
    if (c->pixels == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the image");
    aur_result result = aur_image_create(width, height, 3, &image, error);
    if (result == AUR_OK) {
        memcpy(aur_image_data(image), c->pixels, 3 * width * height * sizeof *c->pixels);
        result = aur_image_write(path, image, &options, error);
    }
    aur_image_destroy(image);
    return result;
}

const report_canvas_format report_canvas_png = {"png", begin, path, circle, text, end, save_image};
