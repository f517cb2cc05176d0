/* Radiosities of facets under sun and sky, with the matrix or by products without one. */
#include <aureole/text.h>
#include <stdlib.h>

#include "cli/cli.h"
#include "cli/viewfactors.h"

/* `numbers` are sky factors, radiosities and half widths: [3][rows]. */
static aur_result write_rows(const aur_facets *facets, const double *numbers, const char *output,
                             aur_error *error) {
    const size_t rows = aur_facets_rows(facets);
    const double *const areas = aur_facets_areas(facets);
    const size_t capacity = 64 + 160 * rows;
    char *const text = malloc(capacity);
    if (text == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    size_t used = (size_t)aur_format(text, capacity, "row,area,sky,radiosity,half_width\n");
    for (size_t i = 0; i < rows; ++i)
        used += (size_t)aur_format(text + used, capacity - used, "%zu,%.17g,%.17g,%.17g,%.17g\n", i, areas[i],
                                   numbers[i], numbers[rows + i], numbers[2 * rows + i]);
    const aur_result result = aur_file_write(output != NULL ? output : "-", used, text, error);
    free(text);
    return result;
}

int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, const aur_facets_light *light, const char *output) {
    aur_error error;
    const size_t rows = aur_facets_rows(facets);
    double *const numbers = calloc(3 * rows, sizeof *numbers);
    aur_view_factors *factors = NULL;
    aur_result result = numbers != NULL ? AUR_OK : aur_fail(&error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK && !matrix_free)
        result = aur_view_factors_create(facets, options, &factors, &error);
    if (result == AUR_OK)
        result = aur_view_factors_radiosity(facets, factors, options, light, numbers + rows,
                                            numbers + 2 * rows, numbers, &error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = write_rows(facets, numbers, output, &error);
    aur_view_factors_destroy(factors);
    free(numbers);
    return cli_status(result, &error);
}
