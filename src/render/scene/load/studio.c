/* The environment "studio": soft light boxes in a dim room, as in product photography. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "points/base/vector3d.h"
#include "render/scene/load/stage.h"

enum { WIDTH = 256, HEIGHT = 128, SIDE = 64 };

typedef struct light_box {
    double azimuth, elevation; /* centre, in degrees to the right of the camera, and elevation */
    double width, height;      /* half extents, as tangents */
    double radiance;           /* radiance before scaling to AUR_STUDIO_WHITE */
} light_box;

/* Key light, strip on the opposite side, rim light behind, and the ceiling. */
static const light_box boxes[] = {
    {-48, 42, 0.55, 0.45, 9.0}, {75, 18, 0.22, 0.7, 3.5}, {168, 38, 0.7, 0.3, 5.0}, {0, 90, 0.6, 0.6, 3.5}};

/* Smooth step from 0 at `start` to 1 at `end`. */
static double smooth_step(double start, double end, double x) {
    const double t = fmin(fmax((x - start) / (end - start), 0.0), 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/* Coverage of a box in a direction: 1 inside, with soft edges. */
static double box_at(const light_box *box, const double direction[3]) {
    const double a = box->azimuth * AUR_PI / 180.0, e = box->elevation * AUR_PI / 180.0;
    const double middle[3] = {cos(e) * sin(a), sin(e), cos(e) * cos(a)};
    const double across[3] = {cos(a), 0.0, -sin(a)};
    double along[3];
    aur_cross3(middle, across, along);
    const double depth = aur_dot3(direction, middle);
    if (!(depth > 0.0))
        return 0.0;
    const double x = fabs(aur_dot3(direction, across)) / depth / box->width;
    const double y = fabs(aur_dot3(direction, along)) / depth / box->height;
    return smooth_step(1.12, 0.88, x) * smooth_step(1.12, 0.88, y);
}

/* Radiance of the room, slightly brighter above, and of the boxes: x to the right, y up, z to the camera. */
static double light_at(const double direction[3]) {
    double sum = 0.35 + 0.35 * smooth_step(0.0, 1.0, direction[1]);
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0]; ++i)
        sum += boxes[i].radiance * box_at(&boxes[i], direction);
    return sum;
}

/* Allocates a single-channel PFM with its header; returns where values start. Rows are from bottom to top. */
static char *begin_file(size_t width, size_t height, size_t *size, float **values) {
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    char head[64];
    int length = aur_format(head, sizeof head, "Pf\n%zu %zu\n%d\n", width, height, first == 1 ? -1 : 1);
    *size = (size_t)length + width * height * sizeof **values;
    char *const file = malloc(*size);
    *values = malloc(width * height * sizeof **values);
    if (file != NULL && *values != NULL) {
        memcpy(file, head, (size_t)length);
        return file;
    }
    free(file);
    free(*values);
    return NULL;
}

static char *end_file(char *file, size_t size, size_t count, float *values) {
    memcpy(file + size - count * sizeof *values, values, count * sizeof *values);
    free(values);
    return file;
}

/* As in `envmap`: the first column is -z, and the column a quarter further is +x. */
static double direction_at(size_t column, size_t row, double direction[3]) {
    const double azimuth = 2.0 * AUR_PI * (double)column / WIDTH;
    const double polar = AUR_PI * (double)(HEIGHT - 1 - row) / (HEIGHT - 1);
    direction[0] = sin(polar) * sin(azimuth);
    direction[1] = cos(polar);
    direction[2] = -sin(polar) * cos(azimuth);
    return sin(polar) * (2.0 * AUR_PI / WIDTH) * (AUR_PI / (HEIGHT - 1));
}

char *aur_studio_lights(size_t *size) {
    float *values;
    char *const file = begin_file(WIDTH, HEIGHT, size, &values);
    double irradiance = 0.0;
    if (file == NULL)
        return NULL;
    for (size_t row = 0; row < HEIGHT; ++row)
        for (size_t column = 0; column < WIDTH; ++column) {
            double direction[3];
            const double angle = direction_at(column, row, direction);
            const double light = direction[1] > 0.0 ? light_at(direction) : 0.0;
            irradiance += light * fmax(direction[1], 0.0) * angle;
            values[row * WIDTH + column] = (float)light;
        }
    /* Below the horizon is an unbounded floor. */
    const double scale = AUR_STUDIO_WHITE / (AUR_STUDIO_FLOOR * irradiance / AUR_PI);
    for (size_t i = 0; i < WIDTH * HEIGHT; ++i)
        values[i] = i < WIDTH * HEIGHT / 2 ? (float)AUR_STUDIO_WHITE : (float)(scale * (double)values[i]);
    return end_file(file, *size, WIDTH * HEIGHT, values);
}

char *aur_studio_fade(size_t *size) {
    float *values;
    char *const file = begin_file(SIDE, SIDE, size, &values);
    if (file == NULL)
        return NULL;
    for (size_t i = 0; i < SIDE * SIDE; ++i) {
        const double x = 2.0 * ((double)(i % SIDE) + 0.5) / SIDE - 1.0;
        const double y = 2.0 * ((double)(i / SIDE) + 0.5) / SIDE - 1.0;
        values[i] = (float)smooth_step(0.96, 0.4, sqrt(x * x + y * y));
    }
    return end_file(file, *size, SIDE * SIDE, values);
}
