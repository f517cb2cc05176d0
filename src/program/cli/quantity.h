/* Numbers with units on the command line. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

typedef struct cli_unit {
    const char *name;
    double factor;
} cli_unit;

/* A positive number, with one of the units' names after it or none. */
bool cli_parse_quantity(const char *text, size_t unit_count, const cli_unit *units, double *value);

/* 30s, 5min or 1h; a number alone is seconds. */
aur_result cli_parse_seconds(const char *option, const char *text, double *seconds, aur_error *error);
