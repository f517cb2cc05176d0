/* The domains of aur_integrate: their maps from a cube, and their measures. */
#pragma once

#include <aureole/integrate.h>

/* The largest number of coordinates of a domain other than the cube. */
enum { AUR_SHAPE_COORDINATES = 4 };

/* Whether points are unit vectors. */
bool aur_shape_is_directions(const aur_integrate_options *options);

/* 1 - cos of the polar angle of the domain or cap. */
double aur_shape_cap_height(const aur_integrate_options *options);

/* The number of coordinates of the cube for a point; the axis, if any, is one more. */
size_t aur_shape_dimension(const aur_integrate_options *options);

/* The measure of the domain without the axis, times the power of the cosine. */
double aur_shape_measure(const aur_integrate_options *options);

/* The radius in degrees of a cap with this share of the weighted domain, with a power of the cosine one about
 * +z; 0 for domains without caps. */
double aur_shape_share_degrees(const aur_integrate_options *options, double share);

/* Maps a uniform point of [0,1)^dimension to one of the domain with the density of the power of the cosine.
 */
void aur_shape_point(const aur_integrate_options *options, const double *cube, double *point);

/* The same into one peak. *factor becomes the factor of the function: the density of uniform points over that
 * of these (and the power of the cosine), or 0 for a point outside the domain. */
void aur_shape_peak_point(const aur_integrate_options *options, const aur_integrate_peak *peak,
                          const double *cube, double *point, double *factor);

/* The measure of the peak. */
double aur_shape_peak_measure(const aur_integrate_options *options, const aur_integrate_peak *peak);

/* Whether the point is in the peak. */
bool aur_shape_peak_holds(const aur_integrate_options *options, const aur_integrate_peak *peak,
                          const double *point);

/* Errors: ARGUMENT, UNSUPPORTED. */
aur_result aur_shape_check(const aur_integrate_options *options, aur_error *error);
