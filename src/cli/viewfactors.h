/* The parts of the verb viewfactors. */
#pragma once

#include <aureole/view_factors.h>
#include <stdbool.h>

/* Solves B = rho (sky + F B) and writes a line of CSV for each row: area, sky factor, radiosity. Returns the
 * exit status. */
int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, double reflectance, const char *output);
