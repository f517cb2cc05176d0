/* The parts of the command viewfactors. */
#pragma once

#include <aureole-lighting/view_factors.h>
#include <stdbool.h>

#include "program/report/report.h"

/* What the rows are made of, [rows] each; `emittances` owns all three. */
typedef struct cli_surfaces {
    double *emittances, *reflectances, *emissions;
} cli_surfaces;

/* Reads a table of CSV with a header: `name` (of a group, or *) or `row`, `reflectance` or `emittance`, and
 * `emission` or `temperature` (kelvin). Later lines replace what earlier ones say of a row. Returns the exit
 * status; what is in `made` is the caller's to free. */
int cli_surfaces_read(const char *path, const aur_facets *facets, cli_surfaces *made);

/* Writes a line of CSV, or an object of JSON, for each row: area, sky factor, radiosity and half its
 * interval; with `net` what arrives and what the row loses too. Returns the exit status. */
int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, bool net, const aur_facets_light *light, report_format format,
                              const char *output);
