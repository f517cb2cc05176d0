/* Spectra with a type. To add one: one line in the table, and a function if no existing one fits. */
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/load/spectrum.h"

typedef struct spectrum_keys {
    double value, scale, temperature, first, last; /* kelvins, nanometres */
    const aur_parameter *wavelengths, *values, *color;
} spectrum_keys;

static const aur_key uniform_keys[] = {
    {AUR_KEY_OF_REAL(spectrum_keys, "value", value, 0.0, INFINITY, "1", "in all channels")}};
static const aur_key d65_keys[] = {
    {AUR_KEY_OF_REAL(spectrum_keys, "scale", scale, 0.0, INFINITY, "1", "white of this value")}};
static const aur_key srgb_keys[] = {
    {AUR_KEY_OF_ITEM(spectrum_keys, "color", color, NULL, "linear; must be given", "r, g, b")}};
static const aur_key blackbody_keys[] = {
    {AUR_KEY_OF_REAL(spectrum_keys, "temperature", temperature, 1.0, 1e9, NULL, "kelvins; must be given")},
    {AUR_KEY_OF_REAL(spectrum_keys, "wavelength_min", first, 1.0, 1e6, "360", "nanometres")},
    {AUR_KEY_OF_REAL(spectrum_keys, "wavelength_max", last, 1.0, 1e6, "830", "nanometres")}};
static const aur_key regular_keys[] = {
    {AUR_KEY_OF_REAL(spectrum_keys, "wavelength_min", first, 1.0, 1e6, "360",
                     "of the first value, nanometres")},
    {AUR_KEY_OF_REAL(spectrum_keys, "wavelength_max", last, 1.0, 1e6, "830",
                     "of the last value, nanometres")},
    {AUR_KEY_OF_ITEM(spectrum_keys, "values", values, NULL, "at equal steps; must be given", "numbers")}};
static const aur_key irregular_keys[] = {
    {AUR_KEY_OF_ITEM(spectrum_keys, "wavelengths", wavelengths, NULL, "nanometres; must be given",
                     "numbers")},
    {AUR_KEY_OF_ITEM(spectrum_keys, "values", values, NULL, "there; must be given", "numbers")}};

typedef struct spectrum_type {
    aur_row row; /* first, so that a row of the table is its type */
    aur_result (*create)(const aur_parameters *parameters, const spectrum_keys *keys, aur_spectrum_use use,
                         double rgb[3], aur_error *error);
} spectrum_type;

static aur_result create_grey(const aur_parameters *parameters, const spectrum_keys *keys,
                              aur_spectrum_use use, double rgb[3], aur_error *error) {
    (void)parameters;
    (void)use;
    (void)error;
    rgb[0] = rgb[1] = rgb[2] = keys->value * keys->scale;
    return AUR_OK;
}

/* Parses numbers; the caller frees them. */
static aur_result read_list(const aur_parameters *parameters, const aur_parameter *item, const char *name,
                            size_t *count, double **numbers, aur_error *error) {
    if (item == NULL || item->text == NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs '%s'", name);
    const size_t most = strlen(item->text) / 2 + 1;
    *numbers = malloc(most * sizeof **numbers);
    if (*numbers == NULL)
        return aur_fail_memory_at(error, item->location);
    *count = aur_parse_doubles(item->text, *numbers, most);
    return *count != SIZE_MAX ? AUR_OK : aur_parameters_fail_value(parameters, item, "numbers", error);
}

static aur_result create_srgb(const aur_parameters *parameters, const spectrum_keys *keys,
                              aur_spectrum_use use, double rgb[3], aur_error *error) {
    (void)use;
    if (keys->color == NULL || keys->color->text == NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs 'color'");
    const size_t count = aur_parse_doubles(keys->color->text, rgb, 3);
    if (count == 1)
        rgb[1] = rgb[2] = rgb[0];
    return count == 1 || count == 3
               ? AUR_OK
               : aur_parameters_fail_value(parameters, keys->color, "one or three numbers", error);
}

/* Planck's law in W / (m2 sr nm). Mitsuba's RGB mode has no blackbody; this one is integrated like any
 * spectrum. */
static double planck(double nanometres, double kelvins) {
    static const double h = 6.62607015e-34, c = 299792458.0, k = 1.380649e-23;
    const double metres = 1e-9 * nanometres;
    return 1e-9 * 2.0 * h * c * c / (pow(metres, 5.0) * expm1(h * c / (metres * k * kelvins)));
}

/* The i-th of `count` equidistant wavelengths. */
static double wavelength_at(const spectrum_keys *keys, size_t i, size_t count) {
    return keys->first + (keys->last - keys->first) * (double)i / (double)(count > 1 ? count - 1 : 1);
}

static aur_result check_span(const aur_parameters *parameters, const spectrum_keys *keys, aur_error *error) {
    return keys->first < keys->last
               ? AUR_OK
               : aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                     "'wavelength_min' (%g) must be less than 'wavelength_max' (%g)",
                                     keys->first, keys->last);
}

static aur_result create_blackbody(const aur_parameters *parameters, const spectrum_keys *keys,
                                   aur_spectrum_use use, double rgb[3], aur_error *error) {
    enum { SAMPLES = 471 }; /* one nanometre apart, from 360 to 830 */
    double wavelengths[SAMPLES], values[SAMPLES];
    const aur_result result = check_span(parameters, keys, error);
    if (result != AUR_OK)
        return result;
    if (keys->temperature == 0.0)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs 'temperature'");
    for (size_t i = 0; i < SAMPLES; ++i) {
        wavelengths[i] = wavelength_at(keys, i, SAMPLES);
        values[i] = planck(wavelengths[i], keys->temperature);
    }
    return aur_spectrum_to_rgb(SAMPLES, wavelengths, values, parameters->location, use, rgb, error);
}

static aur_result create_sampled(const aur_parameters *parameters, const spectrum_keys *keys,
                                 aur_spectrum_use use, double rgb[3], aur_error *error) {
    size_t count = 0, value_count = 0;
    double *values = NULL, *wavelengths = NULL;
    const bool regular = strcmp(parameters->plugin, "regular") == 0;
    aur_result result = read_list(parameters, keys->values, "values", &count, &values, error);
    if (result == AUR_OK && regular) {
        result = check_span(parameters, keys, error);
        wavelengths = malloc((count + 1) * sizeof *wavelengths);
        if (result == AUR_OK && wavelengths == NULL)
            result = aur_fail_memory_at(error, parameters->location);
        for (size_t i = 0; i < count && result == AUR_OK; ++i)
            wavelengths[i] = wavelength_at(keys, i, count);
        value_count = count;
    } else if (result == AUR_OK) {
        result = read_list(parameters, keys->wavelengths, "wavelengths", &value_count, &wavelengths, error);
    }
    if (result == AUR_OK && value_count != count)
        result = aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                     "it has %zu wavelengths and %zu values", value_count, count);
    if (result == AUR_OK)
        result = aur_spectrum_to_rgb(count, wavelengths, values, parameters->location, use, rgb, error);
    free(values);
    free(wavelengths);
    return result;
}

#define TYPE(create_, ...) &(const spectrum_type){{__VA_ARGS__}, create_}.row
static const aur_row *const rows[] = {
    TYPE(create_grey, .name = "uniform", .summary = "the same in all channels", AUR_ROW_KEYS(uniform_keys)),
    TYPE(create_grey, .name = "rawconstant", .summary = "read as uniform", AUR_ROW_KEYS(uniform_keys)),
    TYPE(create_grey, .name = "d65", .summary = "daylight: white", AUR_ROW_KEYS(d65_keys)),
    TYPE(create_srgb, .name = "srgb", .summary = "a colour", AUR_ROW_KEYS(srgb_keys)),
    TYPE(create_blackbody, .name = "blackbody", .summary = "black body radiation", .source = "Planck 1900",
         AUR_ROW_KEYS(blackbody_keys)),
    TYPE(create_sampled, .name = "regular", .summary = "linear between values at equal steps",
         AUR_ROW_KEYS(regular_keys)),
    TYPE(create_sampled, .name = "irregular", .summary = "linear between values at any wavelengths",
         AUR_ROW_KEYS(irregular_keys)),
};

const aur_table aur_spectrum_table = {
    .kind = "spectrum", .summary = "colours by wavelength", AUR_TABLE_ROWS(rows)};

aur_result aur_spectrum_create(aur_parameters *parameters, aur_spectrum_use use, double rgb[3],
                               aur_error *error) {
    const aur_row *row;
    spectrum_keys keys = {.value = 1.0, .scale = 1.0};
    aur_result result = aur_table_find(&aur_spectrum_table, parameters, &row, error);
    if (result == AUR_OK)
        result = aur_row_read(row, parameters, &keys, error);
    return result != AUR_OK ? result
                            : ((const spectrum_type *)row)->create(parameters, &keys, use, rgb, error);
}
