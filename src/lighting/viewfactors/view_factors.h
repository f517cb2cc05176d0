/* What a result is made of. */
#pragma once

#include <aureole-lighting/view_factors.h>

struct aur_view_factors {
    size_t rows;
    uint64_t *starts;
    uint32_t *columns;
    double *values, *half_widths;
    double *areas, *sky, *sky_half_widths, *back;
    /* What each randomisation is off the mean, of exchanges from the diagonal on and of those with the sky.
     */
    size_t randomizations;
    float *deviations;      /* [upper entries][randomizations] */
    double *sky_deviations; /* [rows][randomizations] */
    size_t name_width;      /* names[rows][name_width], ended by zeros; 0 when rows have no names */
    char *names;
    aur_view_factors_description description;
};

/* The caller's options with defaults filled in. Errors: ARGUMENT, UNSUPPORTED. */
aur_result aur_view_factors_read_options(const aur_view_factors_options *given,
                                         aur_view_factors_options *options, aur_error *error);
