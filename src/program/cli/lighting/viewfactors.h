/* The parts of the verb viewfactors. */
#pragma once

#include <aureole-lighting/view_factors.h>
#include <stdbool.h>

#include "program/report/report.h"

/* Writes a line of CSV, or an object of JSON, for each row: area, sky factor, radiosity, and without a matrix
 * half the interval about it. Returns the exit status. */
int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, const aur_facets_light *light, report_format format,
                              const char *output);
