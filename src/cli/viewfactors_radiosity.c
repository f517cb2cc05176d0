/* Radiosities of facets under a uniform sky, with the matrix or by products without one. */
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>

#include "cli/cli.h"
#include "cli/viewfactors.h"

/* The sum over reflections ends when the next one changes no row by more. */
static const double SMALLEST_CHANGE = 1e-7;
enum { MOST_REFLECTIONS = 200 };

static void multiply(const aur_view_factors_matrix *m, const double *x, double *y) {
    for (size_t i = 0; i < m->rows; ++i) {
        double sum = 0.0;
        for (uint64_t e = m->starts[i]; e < m->starts[i + 1]; ++e)
            sum += m->values[e] * x[m->columns[e]];
        y[i] = sum;
    }
}

/* Adds one reflection after another. `light` has the reflected sky at first, and is used up. */
static aur_result reflect(const aur_facets *facets, const aur_view_factors_options *options,
                          const aur_view_factors_matrix *matrix, double reflectance, double *light,
                          double *next, double *radiosity, aur_error *error) {
    const size_t rows = aur_facets_rows(facets);
    for (size_t k = 0; k < MOST_REFLECTIONS; ++k) {
        double largest = 0.0;
        for (size_t i = 0; i < rows; ++i) {
            radiosity[i] += light[i];
            largest = fmax(largest, light[i]);
        }
        if (largest <= SMALLEST_CHANGE)
            return AUR_OK;
        aur_result result = AUR_OK;
        if (matrix != NULL)
            multiply(matrix, light, next);
        else
            result = aur_view_factors_product(facets, options, light, next, NULL, error);
        if (result != AUR_OK)
            return result;
        for (size_t i = 0; i < rows; ++i)
            light[i] = reflectance * next[i];
    }
    return aur_fail(
        error, AUR_ERROR_ARGUMENT,
        "after %d reflections there is still light: a closed scene that absorbs (almost) nothing has "
        "no radiosities",
        MOST_REFLECTIONS);
}

static aur_result write_rows(const aur_facets *facets, const double *sky, const double *radiosity,
                             const char *output, aur_error *error) {
    const size_t rows = aur_facets_rows(facets);
    const double *const areas = aur_facets_areas(facets);
    const size_t capacity = 64 + 128 * rows;
    char *const text = malloc(capacity);
    if (text == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    size_t used = (size_t)aur_format(text, capacity, "row,area,sky,radiosity\n");
    for (size_t i = 0; i < rows; ++i)
        used += (size_t)aur_format(text + used, capacity - used, "%zu,%.17g,%.17g,%.17g\n", i, areas[i],
                                   sky[i], radiosity[i]);
    const aur_result result = aur_file_write(output != NULL ? output : "-", used, text, error);
    free(text);
    return result;
}

static aur_result solve(const aur_facets *facets, const aur_view_factors_options *options, bool matrix_free,
                        double reflectance, double *numbers, const char *output, aur_error *error) {
    const size_t rows = aur_facets_rows(facets);
    double *const light = numbers, *const next = light + rows, *const sky = next + rows,
                  *const radiosity = sky + rows;
    aur_view_factors *factors = NULL;
    aur_view_factors_matrix matrix = {.size = sizeof matrix};
    aur_result result = matrix_free ? aur_view_factors_product(facets, options, radiosity, next, sky, error)
                                    : aur_view_factors_create(facets, options, &factors, error);
    if (result == AUR_OK && !matrix_free)
        result = aur_view_factors_get_matrix(factors, &matrix, error);
    double most = 0.0;
    for (size_t i = 0; i < rows && result == AUR_OK; ++i) {
        if (!matrix_free)
            sky[i] = matrix.sky[i];
        light[i] = reflectance * sky[i];
        most = sky[i] > most ? sky[i] : most;
    }
    if (result == AUR_OK && most == 0.0)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "no row sees the sky: there is no light");
    if (result == AUR_OK)
        result = reflect(facets, options, matrix_free ? NULL : &matrix, reflectance, light, next, radiosity,
                         error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = write_rows(facets, sky, radiosity, output, error);
    aur_view_factors_destroy(factors);
    return result;
}

int cli_viewfactors_radiosity(const aur_facets *facets, const aur_view_factors_options *options,
                              bool matrix_free, double reflectance, const char *output) {
    aur_error error;
    double *const numbers = calloc(4 * aur_facets_rows(facets), sizeof *numbers);
    const aur_result result = numbers != NULL
                                  ? solve(facets, options, matrix_free, reflectance, numbers, output, &error)
                                  : aur_fail(&error, AUR_ERROR_MEMORY, "out of memory");
    free(numbers);
    return cli_status(result, &error);
}
