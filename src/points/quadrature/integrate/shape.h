/* What aur_integrate knows of a domain: how its points come from those of a cube, and its measure. */
#pragma once

#include <aureole/integrate.h>

/* The largest number of coordinates of a domain other than the cube. */
enum { AUR_SHAPE_COORDINATES = 4 };

/* Whether points are unit vectors. */
bool aur_shape_is_directions(const aur_integrate_options *options);

/* 1 - cos of the polar angle of the domain or cap. */
double aur_shape_cap_height(const aur_integrate_options *options);

/* Coordinates of the cube that a point is made of; the axis, if any, is one more. */
size_t aur_shape_dimension(const aur_integrate_options *options);

/* The measure of the domain without the axis, times the power of the cosine. */
double aur_shape_measure(const aur_integrate_options *options);

/* A uniform point of [0,1)^dimension to one of the domain that follows the power of the cosine. */
void aur_shape_point(const aur_integrate_options *options, const double *cube, double *point);

/* The same into one peak. *factor becomes the function's: the density of uniform points over that of these
 * (and the power of the cosine), or 0 for a point outside of the domain. */
void aur_shape_peak_point(const aur_integrate_options *options, const aur_integrate_peak *peak,
                          const double *cube, double *point, double *factor);

/* The measure of the peak alone. */
double aur_shape_peak_measure(const aur_integrate_options *options, const aur_integrate_peak *peak);

/* Whether the point lies in the peak. */
bool aur_shape_peak_holds(const aur_integrate_options *options, const aur_integrate_peak *peak,
                          const double *point);

/* Errors: ARGUMENT, UNSUPPORTED. */
aur_result aur_shape_check(const aur_integrate_options *options, aur_error *error);
