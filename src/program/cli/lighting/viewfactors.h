/* The parts of the command viewfactors. */
#pragma once

#include <aureole-lighting/view_factors.h>
#include <stdbool.h>

#include "program/report/report.h"

/* Surface properties of the rows, [rows] each; `emittances` owns the memory of all three. */
typedef struct cli_surfaces {
    double *emittances, *reflectances, *emissions;
} cli_surfaces;

/* Reads a CSV table with a header: `name` (of a group, or *) or `row`, `reflectance` or `emittance`, and
 * `emission` or `temperature` (kelvin). Later lines override earlier ones. Returns the exit status; the
 * caller frees the contents of `properties`. */
int cli_surfaces_read(const char *path, const aur_facets *facets, cli_surfaces *properties);

/* Writes a CSV line or JSON object per row: area, sky factor, radiosity and half its interval; with `net`
 * also the irradiance and the net loss. Returns the exit status. */
int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, bool net, const aur_facets_light *light, report_format format,
                              const char *output);
