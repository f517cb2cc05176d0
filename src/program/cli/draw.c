/* A drawing is a list of panels (a square or a circle) and marks (dots), written as SVG or painted into
 * pixels. */
#include "program/cli/draw.h"

#include <aureole/image.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 360, MARGIN = 20, CAPTION = 24, POINT_LIMIT = 1000000 };

static const double far_shade = 0.78; /* grey of points on the far side; near ones are nearly black */
static const double near_shade = 0.05;

/* Three panels at most: what a point's coordinates are there, in [-1,1] and upwards, and its distance to the
 * eye. */
typedef struct panel {
    const char *caption;
    bool round;
    size_t across, up;   /* which coordinates */
    size_t depth;        /* which coordinate points to the eye */
    double depth_sign;   /* 0: there is none */
    double scale, shift; /* coordinate * scale + shift is in [-1,1] */
} panel;

typedef struct drawing {
    size_t panel_count;
    panel panels[2];
    const aur_points_view *points;
    double radius; /* of a dot of mean weight, in pixels */
} drawing;

typedef struct mark {
    double x, y, radius, shade;
} mark;

static drawing compose(const aur_points_view *points) {
    static const panel square = {"", false, 0, 1, 0, 0.0, 2.0, -1.0};
    static const panel disk = {"", true, 0, 1, 0, 0.0, 1.0, 0.0};
    static const panel side = {"side", true, 0, 2, 1, -1.0, 1.0, 0.0};
    static const panel pole = {"pole", true, 0, 1, 2, 1.0, 1.0, 0.0};
    /* The vector part of quaternions, a ball. */
    static const panel turned_side = {"side", true, 1, 3, 2, -1.0, 1.0, 0.0};
    static const panel turned_pole = {"pole", true, 1, 2, 3, 1.0, 1.0, 0.0};
    drawing d = {.panel_count = 1, .points = points};
    if (points->domain == AUR_DOMAIN_ROTATIONS) {
        d.panel_count = 2;
        d.panels[0] = turned_side;
        d.panels[1] = turned_pole;
    } else if (points->domain == AUR_DOMAIN_DISK) {
        d.panels[0] = disk;
    } else if (points->domain >= AUR_DOMAIN_HEMISPHERE) {
        d.panel_count = 2;
        d.panels[0] = side;
        d.panels[1] = pole;
    } else {
        d.panels[0] = square;
        if (points->dimension == 1)
            d.panels[0].up = 0;
    }
    d.radius = fmin(fmax(0.22 * SIDE / sqrt((double)points->count), 0.6), 4.0);
    return d;
}

static double width_of(const drawing *d) {
    return (double)(d->panel_count * (SIDE + MARGIN) + MARGIN);
}

static double height_of(const drawing *d) {
    return (double)(SIDE + 2 * MARGIN + (d->panel_count > 1 ? CAPTION : 0));
}

static double panel_left(size_t p) {
    return (double)(MARGIN + p * (SIDE + MARGIN));
}

/* Where point `i` comes to lie on panel `p`; false when it is on the other side (`near` says which is
 * wanted). */
static bool place(const drawing *d, size_t p, size_t i, bool near, mark *m) {
    const panel *const to = &d->panels[p];
    const double *const at = d->points->coordinates + i * d->points->stride;
    const bool is_near = to->depth_sign == 0.0 || at[to->depth] * to->depth_sign >= 0.0;
    if (is_near != near)
        return false;
    const double across = at[to->across] * to->scale + to->shift;
    const double up = d->points->dimension == 1 ? 0.0 : at[to->up] * to->scale + to->shift;
    const double weight = d->points->weights != NULL ? d->points->weights[i] * (double)d->points->count : 1.0;
    *m = (mark){panel_left(p) + 0.5 * SIDE * (1.0 + across), MARGIN + 0.5 * SIDE * (1.0 - up),
                d->radius * fmin(sqrt(fmax(weight, 0.0)), 6.0), near ? near_shade : far_shade};
    return true;
}

static void write_panel(const drawing *d, size_t p, FILE *to) {
    const double left = panel_left(p);
    if (d->panels[p].round)
        fprintf(to, "<circle class=\"frame\" cx=\"%g\" cy=\"%g\" r=\"%g\"/>\n", left + 0.5 * SIDE,
                MARGIN + 0.5 * SIDE, 0.5 * SIDE);
    else
        fprintf(to, "<rect class=\"frame\" x=\"%g\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n", left, MARGIN,
                SIDE, SIDE);
    if (d->panels[p].caption[0] != '\0')
        fprintf(to, "<text x=\"%g\" y=\"%d\">%s</text>\n", left + 0.5 * SIDE, SIDE + MARGIN + CAPTION,
                d->panels[p].caption);
    for (int near = 0; near < 2; ++near) {
        fprintf(to, "<g class=\"%s\">\n", near != 0 ? "near" : "far");
        mark m;
        for (size_t i = 0; i < d->points->count; ++i)
            if (place(d, p, i, near != 0, &m))
                fprintf(to, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"/>\n", m.x, m.y, m.radius);
        fputs("</g>\n", to);
    }
}

static aur_result write_svg(const char *path, const drawing *d, aur_error *error) {
    char *text = NULL;
    size_t size = 0;
    FILE *const to = open_memstream(&text, &size);
    if (to == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    fprintf(to,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\">\n"
            "<style>.frame{fill:none;stroke:#999}.near{fill:#0d0d0d}.far{fill:#c7c7c7}"
            "text{font:14px sans-serif;text-anchor:middle}</style>\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
            width_of(d), height_of(d), width_of(d), height_of(d));
    for (size_t p = 0; p < d->panel_count; ++p)
        write_panel(d, p, to);
    fputs("</svg>\n", to);
    const bool failed = fclose(to) != 0;
    const aur_result result = failed ? aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the picture")
                                     : aur_file_write(path, size, text, error);
    free(text);
    return result;
}

/* Darkens a pixel towards a shade (as the eye counts it) by `coverage`. */
static void paint(aur_image *image, size_t x, size_t y, double shade, double coverage) {
    float *const pixel = aur_image_data(image) + y * aur_image_width(image) + x;
    const double linear = pow(shade, 2.2);
    *pixel = (float)((double)*pixel * (1.0 - coverage) + linear * coverage);
}

/* A disk, or a ring one pixel wide, with edges smoothed over a pixel. */
static void paint_circle(aur_image *image, const mark *m, bool ring) {
    const double reach = m->radius + 1.5;
    const size_t right = (size_t)fmin(m->x + reach, (double)aur_image_width(image) - 1.0);
    const size_t bottom = (size_t)fmin(m->y + reach, (double)aur_image_height(image) - 1.0);
    for (size_t y = (size_t)fmax(m->y - reach, 0.0); y <= bottom; ++y) {
        for (size_t x = (size_t)fmax(m->x - reach, 0.0); x <= right; ++x) {
            const double distance = hypot((double)x + 0.5 - m->x, (double)y + 0.5 - m->y);
            const double depth = ring ? 1.0 - fabs(distance - m->radius) : m->radius + 0.5 - distance;
            if (depth > 0.0)
                paint(image, x, y, m->shade, fmin(depth, 1.0));
        }
    }
}

static void paint_panel(const drawing *d, size_t p, aur_image *image) {
    const double left = panel_left(p);
    const double frame_shade = 0.6;
    if (d->panels[p].round) {
        const mark frame = {left + 0.5 * SIDE, MARGIN + 0.5 * SIDE, 0.5 * SIDE, frame_shade};
        paint_circle(image, &frame, true);
    }
    for (size_t i = 0; i <= SIDE && !d->panels[p].round; ++i) {
        paint(image, (size_t)left + i, MARGIN, frame_shade, 1.0);
        paint(image, (size_t)left + i, MARGIN + SIDE, frame_shade, 1.0);
        paint(image, (size_t)left, MARGIN + i, frame_shade, 1.0);
        paint(image, (size_t)left + SIDE, MARGIN + i, frame_shade, 1.0);
    }
    mark m;
    for (int near = 0; near < 2; ++near)
        for (size_t i = 0; i < d->points->count; ++i)
            if (place(d, p, i, near != 0, &m))
                paint_circle(image, &m, false);
}

static aur_result write_png(const char *path, const drawing *d, aur_error *error) {
    aur_image *image;
    aur_result result = aur_image_create((size_t)width_of(d), (size_t)height_of(d), 1, &image, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < aur_image_width(image) * aur_image_height(image); ++i)
        aur_image_data(image)[i] = 1.0f;
    for (size_t p = 0; p < d->panel_count; ++p)
        paint_panel(d, p, image);
    const aur_image_write_options options = {.size = sizeof options, .format = "png"};
    result = aur_image_write(path, image, &options, error);
    aur_image_destroy(image);
    return result;
}

aur_result cli_draw_points(const char *path, bool png, const aur_points_view *points, aur_error *error) {
    if (points->count > POINT_LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a picture shows at most %d points, not %zu: use --count",
                        POINT_LIMIT, points->count);
    const drawing d = compose(points);
    return png ? write_png(path, &d, error) : write_svg(path, &d, error);
}
