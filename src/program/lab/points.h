/* Points of a set, for experiments that measure or draw them. */
#pragma once

#include <aureole-render/image.h>
#include <aureole/quality.h>

typedef struct lab_points {
    const char *set;
    aur_domain domain;
    size_t size;         /* of the set */
    size_t first, count; /* range of points; count 0: all from `first` on */
    aur_map map;         /* from the square to other domains */
} lab_points;

/* Creates *made; free it with aur_points_destroy. */
aur_result lab_points_make(const lab_points *points, aur_points **generated, aur_error *error);
/* An image of the points. */
aur_result lab_figure(const lab_points *points, const char *metric, size_t threads, double *value,
                      aur_error *error);

/* Colours of points, linear R, G, B: blue, red, green, orange and black, then the first again. */
const float *lab_colour(size_t index);
/* A white image. */
aur_result lab_canvas(size_t width, size_t height, aur_image **image, aur_error *error);
/* Draws an antialiased disk about x, y in pixels from the upper left corner. */
void lab_dot(aur_image *image, double x, double y, double radius, const float colour[3]);
