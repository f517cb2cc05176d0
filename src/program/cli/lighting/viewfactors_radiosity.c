/* Radiosities of facets under sun and sky, with the matrix or matrix-free. */
#include <aureole/text.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/cli.h"
#include "program/cli/lighting/viewfactors.h"

enum { SKY, RADIOSITY, HALF_WIDTH, INCOMING, INCOMING_HALF_WIDTH, NUMBERS };

/* `numbers` are [NUMBERS][rows]. */
static aur_result write_rows(const aur_facets *facets, const double *numbers, bool net, report_format format,
                             const char *output, aur_error *error) {
    static const char *const columns[] = {"row",        "area",     "sky", "radiosity",
                                          "half_width", "incoming", "net", "incoming_half_width"};
    const size_t rows = aur_facets_rows(facets);
    const double *const areas = aur_facets_areas(facets);
    report_table *const table = report_create(net ? 8 : 5, columns);
    for (size_t i = 0; i < rows; ++i) {
        report_integer(table, i);
        report_number(table, areas[i], 17);
        for (size_t k = 0; k <= HALF_WIDTH; ++k)
            report_number(table, numbers[rows * k + i], 17);
        if (!net)
            continue;
        report_number(table, numbers[rows * INCOMING + i], 17);
        report_number(table, numbers[rows * RADIOSITY + i] - numbers[rows * INCOMING + i], 17);
        report_number(table, numbers[rows * INCOMING_HALF_WIDTH + i], 17);
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

/* uDALES's netsw.inp.NNN: short-wave radiation absorbed by facets. */
static aur_result write_absorbed(const aur_facets *facets, const double *numbers,
                                 const aur_facets_light *light, const char *output, aur_error *error) {
    const size_t rows = aur_facets_rows(facets);
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    if (stream == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    fputs("# net shortwave on facets [W/m2] (including reflections and diffusive)\n", stream);
    for (size_t i = 0; i < rows; ++i) {
        const double reflectance = light->reflectances != NULL ? light->reflectances[i] : light->reflectance;
        aur_print(stream, "%.4f\n", (1.0 - reflectance) * numbers[rows * INCOMING + i]);
    }
    const aur_result result = fclose(stream) == 0 ? aur_file_write(output, size, text, error)
                                                  : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    free(text);
    return result;
}

static bool is_named(const char *path, const char *name) {
    const char *const slash = path != NULL ? strrchr(path, '/') : NULL;
    return path != NULL && strncmp(slash != NULL ? slash + 1 : path, name, strlen(name)) == 0;
}

int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, bool net, const aur_facets_light *light, report_format format,
                              const char *output) {
    aur_error error;
    const size_t rows = aur_facets_rows(facets);
    double *const numbers = calloc(NUMBERS * rows, sizeof *numbers);
    aur_view_factors *factors = NULL;
    aur_result result = numbers != NULL ? AUR_OK : aur_fail(&error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK && !matrix_free)
        result = aur_view_factors_create(facets, options, &factors, &error);
    if (result == AUR_OK) {
        aur_facets_radiosities outputs = {.size = sizeof outputs};
        aur_facets_radiosities_init(&outputs, NULL);
        outputs.sky = numbers + SKY * rows;
        outputs.radiosity = numbers + RADIOSITY * rows;
        outputs.half_widths = numbers + HALF_WIDTH * rows;
        outputs.incoming = numbers + INCOMING * rows;
        outputs.incoming_half_widths = numbers + INCOMING_HALF_WIDTH * rows;
        result = aur_view_factors_solve(facets, factors, options, light, &outputs, &error);
    }
    cli_progress_clear();
    if (result == AUR_OK && is_named(output, "netsw.inp"))
        result = write_absorbed(facets, numbers, light, output, &error);
    else if (result == AUR_OK)
        result =
            write_rows(facets, numbers, net, format == REPORT_TABLE ? REPORT_CSV : format, output, &error);
    aur_view_factors_destroy(factors);
    free(numbers);
    return cli_status(result, &error);
}
