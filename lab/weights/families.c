#include "families.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

const double lab_family_axis[3] = {0.6, 0.0, 0.8};

typedef const lab_family *family;

static double cosine_of(const double *u) {
    return u[0] * lab_family_axis[0] + u[2] * lab_family_axis[2];
}

static double squared_sine(double degrees) {
    return pow(sin(0.5 * degrees / 180.0 * PI), 2.0);
}

/* Solid angle of the domain. */
static double area(family f) {
    return f->domain == AUR_DOMAIN_SPHERE ? 4.0 * PI : 2.0 * PI;
}

/* --- on the sphere and the hemisphere, about the axis: a + exp(b (cos - 1)) b a', ... */

static double gauss(family f, const double *u) {
    return f->a + exp(f->b * (cosine_of(u) - 1.0));
}
static double gauss_integral(family f) {
    return f->a * area(f) + 2.0 * PI * (1.0 - exp(-2.0 * f->b)) / f->b;
}

/* 1 and a peak of height 1000. */
static double raised(family f, const double *u) {
    return 1.0 + f->a * exp(f->b * (cosine_of(u) - 1.0));
}
static double raised_integral(family f) {
    return area(f) + f->a * 2.0 * PI * (1.0 - exp(-2.0 * f->b)) / f->b;
}

static double clipped(family f, const double *u) {
    (void)f;
    return fmax(cosine_of(u), 0.0);
}
static double clipped_integral(family f) {
    return f->domain == AUR_DOMAIN_SPHERE ? PI : 0.5 * PI * (1.0 + lab_family_axis[2]);
}

/* b, plus 1 within a degrees of the axis. */
static double cap(family f, const double *u) {
    return f->b + (1.0 - cosine_of(u) < 2.0 * squared_sine(f->a) ? 1.0 : 0.0);
}
static double cap_integral(family f) {
    return f->b * area(f) + 4.0 * PI * squared_sine(f->a);
}

/* The same about +z, on the boundaries of Sobol's boxes. */
static double cap_z(family f, const double *u) {
    return 1.0 - u[2] < 2.0 * squared_sine(f->a) ? 1.0 : 0.0;
}

/* z from a to b. */
static double band(family f, const double *u) {
    return u[2] >= f->a && u[2] < f->b ? 1.0 : 0.0;
}
static double band_integral(family f) {
    return 2.0 * PI * (f->b - f->a);
}

static double ring(family f, const double *u) {
    return fabs(cosine_of(u)) < f->a ? 1.0 : 0.0;
}
static double ring_integral(family f) {
    return 4.0 * PI * f->a;
}

/* Azimuths from 0 to a. */
static double wedge(family f, const double *u) {
    const double azimuth = atan2(u[1], u[0]);
    return azimuth >= 0.0 && azimuth < f->a ? 1.0 : 0.0;
}
static double wedge_integral(family f) {
    return f->a;
}

static double wave(family f, const double *u) {
    return 1.0 + cos(f->a * u[0]);
}
static double wave_integral(family f) {
    return area(f) * (1.0 + sin(f->a) / f->a);
}

static double root(family f, const double *u) {
    (void)f;
    return sqrt(fabs(u[0]));
}
static double root_integral(family f) {
    return area(f) * 2.0 / 3.0;
}

static double product(family f, const double *u) {
    (void)f;
    return u[0] * u[0] * u[1] * u[1] * u[2] * u[2];
}
static double product_integral(family f) {
    return area(f) / 105.0;
}

static double logarithm(family f, const double *u) {
    (void)f;
    return -log(0.5 * (1.0 - cosine_of(u)));
}
static double logarithm_integral(family f) {
    return area(f);
}

/* (distance from the axis)^-a. */
static double singular(family f, const double *u) {
    double squared = 0.0;
    for (int d = 0; d < 3; ++d)
        squared += pow(u[d] - lab_family_axis[d], 2.0);
    return pow(squared, -0.5 * f->a);
}
static double singular_integral(family f) {
    return 2.0 * PI * pow(2.0, 1.0 - f->a) / (1.0 - 0.5 * f->a);
}

static double horizon(family f, const double *u) {
    return pow(u[2], -f->a);
}
static double horizon_integral(family f) {
    return 2.0 * PI / (1.0 - f->a);
}

/* A sun of .2666 degrees and radiance 2e7 over a sky of 1000, uniform or (a = 1) proportional to the cosine.
 */
static double sun(family f, const double *u) {
    return 1000.0 * (f->a > 0.0 ? u[2] : 1.0) + (1.0 - cosine_of(u) < 2.0 * squared_sine(0.2666) ? 2e7 : 0.0);
}
static double sun_integral(family f) {
    const double sine = sin(0.2666 / 180.0 * PI);
    return 1000.0 * (f->a > 0.0 ? 2.0 * PI / 3.0 : PI) + 2e7 * PI * sine * sine * lab_family_axis[2];
}

/* 64 caps of a degrees, uniformly distributed over the sphere. */
static double spikes(family f, const double *u) {
    const double near = cos(f->a / 180.0 * PI);
    for (int k = 0; k < 64; ++k) {
        const double z = (2.0 * k + 1.0) / 64.0 - 1.0;
        if (fabs(z - u[2]) > f->a / 57.0) /* farther than the radius */
            continue;
        const double s = sqrt(1.0 - z * z), phi = 2.399963229728653 * k;
        if (z * u[2] + s * cos(phi) * u[0] + s * sin(phi) * u[1] > near)
            return 1.0;
    }
    return 0.0;
}
static double spikes_integral(family f) {
    return 64.0 * 4.0 * PI * squared_sine(f->a);
}

/* --- on the cube */

static double box(family f, const double *x) {
    for (size_t d = 0; d < f->dimension; ++d)
        if (!(x[d] < f->a))
            return 0.0;
    return 1.0;
}
static double box_integral(family f) {
    return pow(f->a, (double)f->dimension);
}

static double power(family f, const double *x) {
    return pow(x[0], -f->a);
}
static double power_integral(family f) {
    return 1.0 / (1.0 - f->a);
}

static double disk(family f, const double *x) {
    (void)f;
    return x[0] * x[0] + x[1] * x[1] < 1.0 ? 1.0 : 0.0;
}
static double disk_integral(family f) {
    (void)f;
    return 0.25 * PI;
}

/* Genz 1984: product peak, Gaussian, corner peak, oscillating. */
static double product_peak(family f, const double *x) {
    double value = 1.0;
    for (size_t d = 0; d < f->dimension; ++d)
        value /= f->a * f->a + (x[d] - 0.3) * (x[d] - 0.3);
    return value;
}
static double product_peak_integral(family f) {
    return pow((atan(0.7 / f->a) + atan(0.3 / f->a)) / f->a, (double)f->dimension);
}

static double bell(family f, const double *x) {
    double sum = 0.0;
    for (size_t d = 0; d < f->dimension; ++d)
        sum += (x[d] - 0.5) * (x[d] - 0.5);
    return exp(-f->a * sum);
}
static double bell_integral(family f) {
    return pow(sqrt(PI / f->a) * erf(0.5 * sqrt(f->a)), (double)f->dimension);
}

static double corner(family f, const double *x) {
    double sum = 1.0;
    for (size_t d = 0; d < f->dimension; ++d)
        sum += x[d];
    return pow(sum, -(double)f->dimension - 1.0);
}
static double corner_integral(family f) {
    return 1.0 / tgamma((double)f->dimension + 2.0);
}

static double oscillating(family f, const double *x) {
    double sum = 0.6 * PI;
    for (size_t d = 0; d < f->dimension; ++d)
        sum += f->a * x[d];
    return cos(sum);
}
static double oscillating_integral(family f) {
    const double d = (double)f->dimension;
    return cos(0.6 * PI + 0.5 * d * f->a) * pow(2.0 * sin(0.5 * f->a) / f->a, d);
}

static double kinked(family f, const double *x) {
    double value = 1.0;
    for (size_t d = 0; d < f->dimension; ++d)
        value *= (fabs(4.0 * x[d] - 2.0) + f->a * (double)d) / (1.0 + f->a * (double)d);
    return value;
}

static double linear_product(family f, const double *x) {
    double value = 1.0;
    for (size_t d = 0; d < f->dimension; ++d)
        value *= 1.0 + (x[d] - 0.5) * f->a / (double)(d + 1);
    return value;
}
static double one(family f) {
    (void)f;
    return 1.0;
}

/* Whether the sum of the coordinates is below half their number. */
static double step(family f, const double *x) {
    double sum = 0.0;
    for (size_t d = 0; d < f->dimension; ++d)
        sum += x[d];
    return sum < 0.5 * (double)f->dimension ? 1.0 : 0.0;
}
static double half(family f) {
    (void)f;
    return 0.5;
}

#define SPHERE .domain = AUR_DOMAIN_SPHERE
#define HEMISPHERE .domain = AUR_DOMAIN_HEMISPHERE
#define CUBE(d) .domain = (d) == 2 ? AUR_DOMAIN_SQUARE : AUR_DOMAIN_CUBE, .dimension = d
#define OF(function) .value = function, .integral = function##_integral

static const lab_family families[] = {
    {"gauss 29 degrees", SPHERE, OF(gauss), .b = 4.0, .tolerance = 0.01},
    {"gauss 3 degrees", SPHERE, OF(gauss), .b = 400.0, .tolerance = 0.01},
    {"gauss 0.6 degrees", SPHERE, OF(gauss), .b = 1e4, .tolerance = 0.1},
    {"1 + gauss 0.6 degrees 5 %", SPHERE, OF(raised), .a = 1000.0, .b = 1e4, .tolerance = 0.01},
    {"clipped cosine", SPHERE, OF(clipped), .tolerance = 0.01},
    {"cap 0.2 degrees", SPHERE, OF(cap), .a = 0.2, .tolerance = 0.1},
    {"cap 1 degree", SPHERE, OF(cap), .a = 1.0, .tolerance = 0.1},
    {"cap 3 degrees", SPHERE, OF(cap), .a = 3.0, .tolerance = 0.1},
    {"cap 20 degrees", SPHERE, OF(cap), .a = 20.0, .tolerance = 0.01},
    {"cap 60 degrees", SPHERE, OF(cap), .a = 60.0, .tolerance = 0.01},
    {"half", SPHERE, OF(cap), .a = 90.0, .tolerance = 0.01},
    {"ring 0.002", SPHERE, OF(ring), .a = 0.001, .tolerance = 0.1},
    {"64 caps of 0.5 degrees", SPHERE, OF(spikes), .a = 0.5, .tolerance = 0.1},
    {"1 + cos 40 x", SPHERE, OF(wave), .a = 40.0, .tolerance = 0.01},
    {"1 + cos 400 x", SPHERE, OF(wave), .a = 400.0, .tolerance = 0.01},
    {"1 + cos 4000 x", SPHERE, OF(wave), .a = 4000.0, .tolerance = 0.01},
    {"sqrt |x|", SPHERE, OF(root), .tolerance = 0.01},
    {"x^2 y^2 z^2", SPHERE, OF(product), .tolerance = 0.01},
    {"logarithm", SPHERE, OF(logarithm), .tolerance = 0.01},
    {"r^-0.5", SPHERE, OF(singular), .a = 0.5, .tolerance = 0.01},
    {"r^-1", SPHERE, OF(singular), .a = 1.0, .tolerance = 0.01, .infinite = true},
    {"r^-1 declared", SPHERE, OF(singular), .a = 1.0, .tolerance = 0.01, .peak = -1.0},
    {"r^-1.5", SPHERE, OF(singular), .a = 1.5, .tolerance = 0.01, .infinite = true},
    {"r^-1.5 declared", SPHERE, OF(singular), .a = 1.5, .tolerance = 0.01, .peak = -1.5},
    {"clipped cosine tilted", HEMISPHERE, OF(clipped), .tolerance = 0.01},
    {"cap 2 degrees", HEMISPHERE, OF(cap), .a = 2.0, .tolerance = 0.1},
    {"cap 5 degrees", HEMISPHERE, OF(cap), .a = 5.0, .tolerance = 0.1},
    {"cap 5 degrees about z", HEMISPHERE, .value = cap_z, .integral = cap_integral, .a = 5.0,
     .tolerance = 0.01},
    {"1 + cap 20 degrees", HEMISPHERE, OF(cap), .a = 20.0, .b = 1.0, .tolerance = 0.01},
    {"z < 0.05", HEMISPHERE, OF(band), .b = 0.05, .tolerance = 0.01},
    {"z < 0.3", HEMISPHERE, OF(band), .b = 0.3, .tolerance = 0.01},
    {"z in 0.5 to 0.504", HEMISPHERE, OF(band), .a = 0.5, .b = 0.504, .tolerance = 0.1},
    {"wedge", HEMISPHERE, OF(wedge), .a = 0.3, .tolerance = 0.01},
    {"sun over a flat sky", HEMISPHERE, OF(sun), .exponent = 1.0, .tolerance = 0.01},
    {"sun over a flat sky declared", HEMISPHERE, OF(sun), .exponent = 1.0, .tolerance = 0.01, .peak = 0.3},
    {"sun over a cosine sky", HEMISPHERE, OF(sun), .a = 1.0, .exponent = 1.0, .tolerance = 0.01},
    {"sun over a cosine sky declared", HEMISPHERE, OF(sun), .a = 1.0, .exponent = 1.0, .tolerance = 0.01,
     .peak = 0.3},
    {"z^-0.5", HEMISPHERE, OF(horizon), .a = 0.5, .tolerance = 0.01, .infinite = true},
    {"z^-0.8", HEMISPHERE, OF(horizon), .a = 0.8, .tolerance = 0.01, .infinite = true},
    {"x < 0.3", CUBE(1), OF(box), .a = 0.3, .tolerance = 0.01},
    {"x < 0.001", CUBE(1), OF(box), .a = 0.001, .tolerance = 0.1},
    {"x < 0.00001", CUBE(1), OF(box), .a = 1e-5, .tolerance = 0.1},
    {"x^-0.3", CUBE(1), OF(power), .a = 0.3, .tolerance = 0.01},
    {"x^-0.9", CUBE(1), OF(power), .a = 0.9, .tolerance = 0.01, .infinite = true},
    {"x^-0.9 declared", CUBE(1), OF(power), .a = 0.9, .tolerance = 0.01, .peak = -0.9},
    {"quarter disk", CUBE(2), OF(disk), .tolerance = 0.01},
    {"corner of 0.1 d = 3", CUBE(3), OF(box), .a = 0.1, .tolerance = 0.1},
    {"product peak d = 4", CUBE(4), OF(product_peak), .a = 0.2, .tolerance = 0.01},
    {"Gaussian d = 6", CUBE(6), OF(bell), .a = 9.0, .tolerance = 0.01},
    {"corner peak d = 6", CUBE(6), OF(corner), .tolerance = 0.01},
    {"oscillating d = 8", CUBE(8), OF(oscillating), .a = 1.0, .tolerance = 0.01},
    {"step d = 8", CUBE(8), .value = step, .integral = half, .tolerance = 0.01},
    {"kinked product d = 8", CUBE(8), .value = kinked, .integral = one, .a = 1.0, .tolerance = 0.01},
    {"product d = 64", CUBE(64), .value = linear_product, .integral = one, .a = 1.0, .tolerance = 0.01},
};

size_t lab_family_count(void) {
    return sizeof families / sizeof families[0];
}

const lab_family *lab_family_at(size_t index) {
    return index < lab_family_count() ? &families[index] : NULL;
}

aur_result lab_family_evaluate(void *user, size_t count, const double *points, const double *along,
                               double *values, aur_error *error) {
    const lab_family *const f = user;
    const size_t coordinates = f->domain == AUR_DOMAIN_CUBE ? f->dimension : f->dimension == 2 ? 2 : 3;
    (void)along;
    (void)error;
    for (size_t i = 0; i < count; ++i)
        values[i] = f->value(f, points + coordinates * i);
    return AUR_OK;
}
