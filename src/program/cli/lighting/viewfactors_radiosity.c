/* Radiosities of facets under sun and sky, with the matrix or by products without one. */
#include <aureole/text.h>
#include <stdlib.h>

#include "program/cli/cli.h"
#include "program/cli/lighting/viewfactors.h"

/* `numbers` are sky factors, radiosities and half widths: [3][rows]. */
static aur_result write_rows(const aur_facets *facets, const double *numbers, report_format format,
                             const char *output, aur_error *error) {
    const size_t rows = aur_facets_rows(facets);
    const double *const areas = aur_facets_areas(facets);
    report_table *const table =
        report_create(5, (const char *const[]){"row", "area", "sky", "radiosity", "half_width"});
    for (size_t i = 0; i < rows; ++i) {
        report_integer(table, i);
        report_number(table, areas[i], 17);
        for (size_t k = 0; k < 3; ++k)
            report_number(table, numbers[rows * k + i], 17);
    }
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    aur_result result = stream == NULL ? AUR_ERROR_MEMORY : report_write(table, format, stream, error);
    if ((stream != NULL && fclose(stream) != 0) || result == AUR_ERROR_MEMORY)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK)
        result = aur_file_write(output != NULL ? output : "-", size, text, error);
    report_destroy(table);
    free(text);
    return result;
}

int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, const aur_facets_light *light, report_format format,
                              const char *output) {
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
        result = write_rows(facets, numbers, format == REPORT_TABLE ? REPORT_CSV : format, output, &error);
    aur_view_factors_destroy(factors);
    free(numbers);
    return cli_status(result, &error);
}
