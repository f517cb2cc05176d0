/* LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference
 * Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2)). Section numbers are the
 * paper's. */
#include <math.h>
#include <stdlib.h>

#include "render/image/format.h"

/* Pixels per degree in the paper's setting, a screen 0.7 m wide of 3840 pixels seen from 0.7 m (section 4.1).
 */
static const double pixels_per_degree = 0.7 * 3840.0 / 0.7 * 3.14159265358979323846 / 180.0;

/* Linear Rec. 709 to XYZ; the row sums are the white point D65. */
static const double to_xyz[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};

typedef struct flip_color {
    double c[3];
} flip_color;

static flip_color white_point(void) {
    flip_color white;
    for (size_t i = 0; i < 3; ++i)
        white.c[i] = to_xyz[i][0] + to_xyz[i][1] + to_xyz[i][2];
    return white;
}

/* XYZ relative to white. */
static flip_color relative_xyz(flip_color rgb) {
    const flip_color white = white_point();
    flip_color xyz;
    for (size_t i = 0; i < 3; ++i)
        xyz.c[i] = (to_xyz[i][0] * rgb.c[0] + to_xyz[i][1] * rgb.c[1] + to_xyz[i][2] * rgb.c[2]) / white.c[i];
    return xyz;
}

/* The linear opponent space YyCxCz, in which contrast sensitivity is applied (section 4.1). */
static flip_color to_opponent(flip_color rgb) {
    const flip_color xyz = relative_xyz(rgb);
    return (flip_color){
        {116.0 * xyz.c[1] - 16.0, 500.0 * (xyz.c[0] - xyz.c[1]), 200.0 * (xyz.c[1] - xyz.c[2])}};
}

typedef struct flip_matrix {
    double m[3][3];
} flip_matrix;

/* The inverse of to_xyz by cofactors. */
static flip_matrix invert_to_xyz(void) {
    flip_matrix inverse;
    double determinant = 0.0;
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) {
            const size_t r1 = (j + 1) % 3, r2 = (j + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
            inverse.m[i][j] = to_xyz[r1][c1] * to_xyz[r2][c2] - to_xyz[r1][c2] * to_xyz[r2][c1];
        }
    }
    for (size_t i = 0; i < 3; ++i)
        determinant += to_xyz[0][i] * inverse.m[i][0];
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            inverse.m[i][j] /= determinant;
    return inverse;
}

static double clamp_unit(double value) {
    return fmin(fmax(value, 0.0), 1.0);
}

/* Back to linear RGB, clamped to what a screen shows. */
static flip_color from_opponent(flip_color opponent, const flip_matrix *inverse) {
    const flip_color white = white_point();
    const double y = (opponent.c[0] + 16.0) / 116.0;
    const double xyz[3] = {(y + opponent.c[1] / 500.0) * white.c[0], y * white.c[1],
                           (y - opponent.c[2] / 200.0) * white.c[2]};
    flip_color rgb;
    for (size_t i = 0; i < 3; ++i)
        rgb.c[i] =
            clamp_unit(inverse->m[i][0] * xyz[0] + inverse->m[i][1] * xyz[1] + inverse->m[i][2] * xyz[2]);
    return rgb;
}

/* CIELAB with the Hunt effect: colours matter less in the dark (section 4.1). */
static flip_color to_hunt_lab(flip_color rgb) {
    const double delta = 6.0 / 29.0;
    const flip_color xyz = relative_xyz(rgb);
    double f[3];
    for (size_t i = 0; i < 3; ++i)
        f[i] =
            xyz.c[i] > delta * delta * delta ? cbrt(xyz.c[i]) : xyz.c[i] / (3.0 * delta * delta) + 4.0 / 29.0;
    const double lightness = 116.0 * f[1] - 16.0;
    return (flip_color){
        {lightness, 0.01 * lightness * 500.0 * (f[0] - f[1]), 0.01 * lightness * 200.0 * (f[1] - f[2])}};
}

static double hyab_distance(flip_color a, flip_color b) {
    return fabs(a.c[0] - b.c[0]) + hypot(a.c[1] - b.c[1], a.c[2] - b.c[2]);
}

/* The exponent and the two points of the map of colour errors to [0,1] (section 4.1). */
static const double color_exponent = 0.7, color_knee = 0.4, color_knee_value = 0.95;

static double largest_color_error(void) {
    const flip_color green = {{0.0, 1.0, 0.0}}, blue = {{0.0, 0.0, 1.0}};
    return pow(hyab_distance(to_hunt_lab(green), to_hunt_lab(blue)), color_exponent);
}

static double color_error(flip_color reference, flip_color test, double largest) {
    const double error = pow(hyab_distance(to_hunt_lab(reference), to_hunt_lab(test)), color_exponent);
    const double knee = color_knee * largest;
    if (error < knee)
        return color_knee_value / knee * error;
    return color_knee_value + (error - knee) / (largest - knee) * (1.0 - color_knee_value);
}

enum { RADIUS_CAPACITY = 12 };

/* weights[radius + i] belongs to the offset i. */
typedef struct flip_kernel {
    int radius;
    double weights[2 * RADIUS_CAPACITY + 1];
} flip_kernel;

/* exp(-(i / spread)^2), with its sum. */
static flip_kernel gaussian(int radius, double spread, double *sum) {
    flip_kernel kernel = {.radius = radius};
    *sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        const double x = (double)i / spread;
        kernel.weights[radius + i] = exp(-x * x);
        *sum += kernel.weights[radius + i];
    }
    return kernel;
}

static flip_kernel scaled(flip_kernel kernel, double factor) {
    for (int i = 0; i <= 2 * kernel.radius; ++i)
        kernel.weights[i] *= factor;
    return kernel;
}

/* Normalises positive weights to a sum of 1 and negative ones to -1 (section 4.2). */
static flip_kernel balanced(flip_kernel kernel) {
    double positive = 0.0, negative = 0.0;
    for (int i = 0; i <= 2 * kernel.radius; ++i) {
        positive += fmax(kernel.weights[i], 0.0);
        negative -= fmin(kernel.weights[i], 0.0);
    }
    for (int i = 0; i <= 2 * kernel.radius; ++i)
        kernel.weights[i] /= kernel.weights[i] > 0.0 ? positive : negative > 0.0 ? negative : 1.0;
    return kernel;
}

/* Planes of one image, width x height each, and working memory for a convolution. */
typedef struct flip_planes {
    size_t width, height;
    float *opponent[3];
    float *filtered[3];
    float *edge[2], *point[2]; /* derivatives along x and y */
    float *scratch;
    float *memory;
} flip_planes;

enum { PLANE_COUNT = 11 };

static size_t clamped(size_t at, int offset, size_t count) {
    const ptrdiff_t index = (ptrdiff_t)at + offset;
    return index < 0 ? 0 : (size_t)index < count ? (size_t)index : count - 1;
}

/* out += in convolved with `across` (x) and `along` (y); the border is extended by its pixels. */
static void add_convolution(const flip_planes *planes, const float *in, const flip_kernel *across,
                            const flip_kernel *along, float *out) {
    const size_t width = planes->width, height = planes->height;
    for (size_t y = 0; y < height; ++y) {
        const float *const row = in + y * width;
        float *const to = planes->scratch + y * width;
        for (size_t x = 0; x < width; ++x) {
            double sum = 0.0;
            for (int i = -across->radius; i <= across->radius; ++i)
                sum += across->weights[across->radius + i] * (double)row[clamped(x, i, width)];
            to[x] = (float)sum;
        }
    }
    for (size_t y = 0; y < height; ++y) {
        float *const to = out + y * width;
        for (int i = -along->radius; i <= along->radius; ++i) {
            const float *const row = planes->scratch + clamped(y, i, height) * width;
            const float weight = (float)along->weights[along->radius + i];
            for (size_t x = 0; x < width; ++x)
                to[x] += weight * row[x];
        }
    }
}

/* A contrast sensitivity is a sum of two Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b) with x in degrees (table
 * 1). */
typedef struct flip_sensitivity {
    double a[2], b[2];
} flip_sensitivity;

static const flip_sensitivity sensitivities[3] = {
    {{1.0, 0.0}, {0.0047, 1e-5}}, {{1.0, 0.0}, {0.0053, 1e-5}}, {{34.1, 13.5}, {0.04, 0.025}}};

static void filter_contrast(const flip_planes *planes) {
    const double pi = 3.14159265358979323846, largest_b = 0.04;
    const int radius = (int)ceil(3.0 * sqrt(largest_b / (2.0 * pi * pi)) * pixels_per_degree);
    for (size_t c = 0; c < 3; ++c) {
        flip_kernel kernels[2];
        double factors[2], total = 0.0;
        for (size_t i = 0; i < 2; ++i) {
            double sum;
            kernels[i] = gaussian(radius, sqrt(sensitivities[c].b[i]) / pi * pixels_per_degree, &sum);
            factors[i] = sensitivities[c].a[i] * sqrt(pi / sensitivities[c].b[i]);
            total += factors[i] * sum * sum;
        }
        for (size_t i = 0; i < 2; ++i) {
            if (factors[i] == 0.0)
                continue;
            const flip_kernel along = scaled(kernels[i], factors[i] / total);
            add_convolution(planes, planes->opponent[c], &kernels[i], &along, planes->filtered[c]);
        }
    }
}

/* Detects edges by the first and points by the second derivative of a Gaussian of the visual system's feature
 * width (section 4.2). */
static void detect_features(const flip_planes *planes) {
    const double feature_width = 0.082; /* degrees */
    const double deviation = 0.5 * feature_width * pixels_per_degree;
    const int radius = (int)ceil(3.0 * deviation);
    double sum;
    const flip_kernel bell = gaussian(radius, sqrt(2.0) * deviation, &sum);
    flip_kernel edge = bell, point = bell;
    for (int i = -radius; i <= radius; ++i) {
        edge.weights[radius + i] *= -(double)i;
        point.weights[radius + i] *= (double)i * (double)i / (deviation * deviation) - 1.0;
    }
    /* The opponent lightness is 116 times the luminance, less 16, which derivatives do not see. */
    const flip_kernel smooth = scaled(bell, 1.0 / sum / 116.0);
    edge = balanced(edge);
    point = balanced(point);
    add_convolution(planes, planes->opponent[0], &edge, &smooth, planes->edge[0]);
    add_convolution(planes, planes->opponent[0], &smooth, &edge, planes->edge[1]);
    add_convolution(planes, planes->opponent[0], &point, &smooth, planes->point[0]);
    add_convolution(planes, planes->opponent[0], &smooth, &point, planes->point[1]);
}

static aur_result analyse(const aur_image *image, const size_t channels[3], flip_planes *planes,
                          aur_error *error) {
    const size_t pixels = image->width * image->height;
    *planes = (flip_planes){.width = image->width, .height = image->height};
    planes->memory = calloc(pixels, PLANE_COUNT * sizeof *planes->memory);
    if (planes->memory == NULL)
        return aur_fail_memory(error);
    float **const all[PLANE_COUNT] = {&planes->opponent[0], &planes->opponent[1], &planes->opponent[2],
                                      &planes->filtered[0], &planes->filtered[1], &planes->filtered[2],
                                      &planes->edge[0],     &planes->edge[1],     &planes->point[0],
                                      &planes->point[1],    &planes->scratch};
    for (size_t i = 0; i < PLANE_COUNT; ++i)
        *all[i] = planes->memory + i * pixels;
    for (size_t i = 0; i < pixels; ++i) {
        flip_color rgb;
        for (size_t c = 0; c < 3; ++c)
            rgb.c[c] = clamp_unit((double)image->data[i * image->channel_count + channels[c]]);
        const flip_color opponent = to_opponent(rgb);
        for (size_t c = 0; c < 3; ++c)
            planes->opponent[c][i] = (float)opponent.c[c];
    }
    filter_contrast(planes);
    detect_features(planes);
    return AUR_OK;
}

static double feature_strength(float *const derivatives[2], size_t pixel) {
    return hypot((double)derivatives[0][pixel], (double)derivatives[1][pixel]);
}

static flip_color filtered_color(const flip_planes *planes, size_t pixel, const flip_matrix *inverse) {
    const flip_color opponent = {{(double)planes->filtered[0][pixel], (double)planes->filtered[1][pixel],
                                  (double)planes->filtered[2][pixel]}};
    return from_opponent(opponent, inverse);
}

static void combine(const flip_planes *reference, const flip_planes *test, float *map) {
    const flip_matrix inverse = invert_to_xyz();
    const double largest = largest_color_error();
    for (size_t i = 0; i < reference->width * reference->height; ++i) {
        const double color =
            color_error(filtered_color(reference, i, &inverse), filtered_color(test, i, &inverse), largest);
        const double edges = fabs(feature_strength(reference->edge, i) - feature_strength(test->edge, i));
        const double points = fabs(feature_strength(reference->point, i) - feature_strength(test->point, i));
        const double feature = sqrt(fmax(edges, points) / sqrt(2.0));
        map[i] = (float)pow(color, 1.0 - fmin(feature, 1.0));
    }
}

aur_result aur_image_flip(const aur_image *reference, const aur_image *image, aur_image **map,
                          aur_error *error) {
    *map = NULL;
    aur_color_pair pair;
    aur_result result = aur_image_check_pair(reference, image, &pair, error);
    if (result != AUR_OK)
        return result;
    flip_planes planes[2] = {{0}};
    result = analyse(reference, pair.reference, &planes[0], error);
    if (result == AUR_OK)
        result = analyse(image, pair.image, &planes[1], error);
    if (result == AUR_OK)
        result = aur_image_create(image->width, image->height, 1, map, error);
    if (result == AUR_OK)
        combine(&planes[0], &planes[1], (*map)->data);
    for (size_t i = 0; i < 2; ++i)
        free(planes[i].memory);
    return result;
}
