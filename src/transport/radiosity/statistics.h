/* What the sums of a solution say: powers, their errors and their change. Each works in time proportional to
 * the number of randomisations for one patch. */
#pragma once

#include "transport/radiosity/solution.h"

/* The power that a patch receives, RGB watts, over all randomisations. */
void aur_radiosity_power(const aur_radiosity *radiosity, size_t patch, double power[3]);
/* The standard error of that; NaN with one randomisation. */
void aur_radiosity_power_error(const aur_radiosity *radiosity, size_t patch, double error[3]);
/* Over all patches, in the unit of epsilon. */
double aur_radiosity_standard_error(const aur_radiosity *radiosity);

/* The change (see aur_radiosity_termination) from the powers `before`, one a patch, to those of now, which
 * take their place. */
double aur_radiosity_measure_change(const aur_radiosity *radiosity, double (*before)[3]);

/* What aur_radiosity_describe tells. */
void aur_radiosity_summarize(const aur_radiosity *radiosity, aur_radiosity_description *description);

/* One triangle's row of aur_radiosity_results. */
void aur_radiosity_result(const aur_radiosity *radiosity, size_t triangle,
                          aur_radiosity_triangle_result *out);
