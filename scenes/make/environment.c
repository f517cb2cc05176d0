/* Light from afar, in latitude and longitude as <emitter type="envmap"> reads it: the row is the angle from
 * +y, and column u looks along (sin phi, ., -cos phi) with phi = 2 pi u. */
#include <stdint.h>

#include "noise.h"
#include "product.h"

enum { WIDTH = 1024, HEIGHT = 512 };

typedef struct color {
    double r, g, b;
} color;

static color times(color c, double s) {
    return (color){c.r * s, c.g * s, c.b * s};
}

static color plus(color a, color b) {
    return (color){a.r + b.r, a.g + b.g, a.b + b.b};
}

static aur_result paint(color (*radiance)(vec direction), aur_image **image, aur_error *error) {
    const aur_result result = aur_image_create(WIDTH, HEIGHT, 3, image, error);
    for (size_t y = 0; y < HEIGHT && result == AUR_OK; ++y)
        for (size_t x = 0; x < WIDTH; ++x) {
            color sum = {0.0, 0.0, 0.0};
            for (size_t k = 0; k < 16; ++k) { /* means over 4 x 4 places of the pixel */
                const double theta = PI * ((double)y + ((double)(k / 4) + 0.5) / 4.0) / HEIGHT;
                const double phi = 2.0 * PI * ((double)x + ((double)(k % 4) + 0.5) / 4.0) / WIDTH;
                sum = plus(sum, radiance((vec){sin(theta) * sin(phi), cos(theta), -sin(theta) * cos(phi)}));
            }
            float *const pixel = aur_image_data(*image) + 3 * (y * WIDTH + x);
            pixel[0] = (float)(sum.r / 16.0);
            pixel[1] = (float)(sum.g / 16.0);
            pixel[2] = (float)(sum.b / 16.0);
        }
    return result;
}

/* --- the sky of Preetham, Shirley and Smits 1999 */

enum { TURBIDITY = 3 };

/* Perez' distribution with its five coefficients. */
static double perez(const double c[5], double cos_theta, double gamma) {
    const double cg = cos(gamma);
    return (1.0 + c[0] * exp(c[1] / fmax(cos_theta, 0.01))) *
           (1.0 + c[2] * exp(c[3] * gamma) + c[4] * cg * cg);
}

static double ratio(const double c[5], double zenith, double cos_theta, double gamma, double sun) {
    return zenith * perez(c, cos_theta, gamma) / perez(c, 1.0, sun);
}

/* The paper's fits of the coefficients (appendix A.2) and of the zenith's chromaticity, at turbidity T. */
static color preetham(vec direction, vec sun_direction) {
    const double t = TURBIDITY, sun = acos(sun_direction.y);
    const double gamma = acos(clamp(dot(direction, sun_direction), -1.0, 1.0));
    const double luminance[5] = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                                 0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
    const double xs[5] = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
                          -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
    const double ys[5] = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
                          -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
    const double s2 = sun * sun, s3 = s2 * sun;
    const double chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * sun);
    const double zenith = (4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192; /* kcd / m^2 */
    const double zenith_x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * sun) +
                            t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * sun + 0.00394) +
                            (0.11693 * s3 - 0.21196 * s2 + 0.06052 * sun + 0.25886);
    const double zenith_y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * sun) +
                            t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * sun + 0.00516) +
                            (0.15346 * s3 - 0.26756 * s2 + 0.06670 * sun + 0.26688);
    const double up = fmax(direction.y, 0.0);
    const double y = ratio(luminance, zenith, up, gamma, sun);
    const double cx = ratio(xs, zenith_x, up, gamma, sun), cy = ratio(ys, zenith_y, up, gamma, sun);
    const double x = cx / cy * y, z = (1.0 - cx - cy) / cy * y;
    return (color){fmax(0.0, 3.2406 * x - 1.5372 * y - 0.4986 * z),
                   fmax(0.0, -0.9689 * x + 1.8758 * y + 0.0415 * z),
                   fmax(0.0, 0.0557 * x - 0.2040 * y + 1.0570 * z)};
}

/* A clear afternoon. The sun is drawn 1.2 degrees in radius, with the light of a hazy one, so that its
 * shadows are a little softer than true; thin clouds; a warm ground that goes on to the horizon. 20 kcd/m^2
 * are a radiance of 1. */
static color sky(vec direction) {
    const vec sun = normalize((vec){0.62, 0.60, 0.50});
    const double unit = 1.0 / 20.0;
    const color ground = {0.115, 0.095, 0.075};
    if (direction.y < 0.0) {
        const color far = times(preetham((vec){direction.x, 0.0, direction.z}, sun), unit);
        const double t = exp(direction.y / 0.035);
        return plus(times(ground, 1.0 - t), times(far, 0.8 * t));
    }
    color light = times(preetham(direction, sun), unit);
    const double level = 1.0 / (direction.y + 0.18);
    const vec on_layer = {direction.x * level * 1.1, 0.3, direction.z * level * 2.2};
    const double veil = fractal_noise(
        add_scaled(on_layer, 0.35, (vec){noise(on_layer), 0.0, noise(scale(on_layer, 1.7))}), 5);
    const double cloud = smoothstep(0.02, 0.75, veil) * smoothstep(0.02, 0.25, direction.y);
    light = plus(times(light, 1.0 - 0.75 * cloud), times((color){1.0, 0.97, 0.93}, 0.75 * cloud));
    const double angle = acos(clamp(dot(direction, sun), -1.0, 1.0)) * 180.0 / PI;
    const double disk = 1.0 - smoothstep(1.0, 1.4, angle);
    return plus(light, times((color){1.0, 0.86, 0.66}, 1900.0 * disk));
}

/* --- a studio */

/* A lamp behind a sheet of cloth: brightest at its middle, with a soft edge. `half` is in tangents of angles.
 */
static double soft_box(vec direction, vec toward, vec up, double half_width, double half_height) {
    const vec axis = normalize(toward), side = normalize(cross(up, axis)), top = cross(axis, side);
    const double ahead = dot(direction, axis);
    if (ahead <= 0.0)
        return 0.0;
    const double x = fabs(dot(direction, side)) / ahead / half_width,
                 y = fabs(dot(direction, top)) / ahead / half_height;
    const double edge = (1.0 - smoothstep(0.92, 1.0, x)) * (1.0 - smoothstep(0.92, 1.0, y));
    return edge * (1.0 - 0.35 * (x * x + y * y) / 2.0);
}

/* A key light on the left, a cool strip on the right, a wide fill above, a small warm lamp behind; grey
 * walls. */
static color studio(vec direction) {
    const vec up = {0.0, 1.0, 0.0};
    const double height = 0.5 + 0.5 * direction.y;
    color light =
        plus(times((color){0.045, 0.050, 0.060}, 1.0 - height), times((color){0.10, 0.11, 0.13}, height));
    light = plus(light, times((color){1.0, 0.93, 0.84},
                              14.0 * soft_box(direction, (vec){-1.0, 0.75, 0.55}, up, 0.42, 0.55)));
    light = plus(light, times((color){0.72, 0.86, 1.0},
                              9.0 * soft_box(direction, (vec){1.0, 0.25, 0.30}, up, 0.12, 0.75)));
    light = plus(light, times((color){1.0, 0.98, 0.95}, 3.0 * soft_box(direction, (vec){0.1, 1.0, -0.1},
                                                                       (vec){0.0, 0.0, 1.0}, 0.6, 0.32)));
    return plus(light, times((color){1.0, 0.72, 0.42},
                             12.0 * soft_box(direction, (vec){0.45, 0.35, -1.0}, up, 0.16, 0.16)));
}

static aur_result paint_sky(aur_image **image, aur_error *error) {
    return paint(sky, image, error);
}

static aur_result paint_studio(aur_image **image, aur_error *error) {
    return paint(studio, image, error);
}

const product product_sky = {
    .file = "sky.exr", .summary = "a clear sky with the sun and thin clouds", .paint = paint_sky};
const product product_studio = {
    .file = "studio.exr", .summary = "a studio with four soft boxes", .paint = paint_studio};
