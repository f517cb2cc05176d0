#include "render/scene/load/spectrum.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/file.h"
#include "points/base/text.h"

/* --- integrals with the observer's colour matching functions */

enum { CIE_FIRST = 360, CIE_LAST = 830, CIE_STEP = 5, CIE_COUNT = 95 }; /* nanometres */

/* The standard observer's x, y, z, and illuminant D65. */
static const double cie[CIE_COUNT][4] = {
#include "data/cie.inc"
};

static double mix(double a, double b, double t) {
    return a + t * (b - a);
}

/* The observer's x, y, z at a wavelength, times D65 for reflection spectra. */
static void observer_at(double wavelength, bool daylight, double xyz[3]) {
    /* Mitsuba's constants: the integral of y, and D65's mean weighted by it. */
    static const double y_integral = 106.7502593994140625, d65_mean = 98.99741751876255;
    const double row = (wavelength - CIE_FIRST) / CIE_STEP;
    const size_t i = row < CIE_COUNT - 2 ? (size_t)row : CIE_COUNT - 2;
    const double *const a = cie[i], *const b = cie[i + 1];
    const double t = row - (double)i;
    const double light = daylight ? mix(a[3], b[3], t) / d65_mean : 1.0;
    for (size_t k = 0; k < 3; ++k)
        xyz[k] = mix(a[k], b[k], t) * light / y_integral;
}

static aur_result check(size_t count, const double *wavelengths, const double *values, aur_location location,
                        aur_error *error) {
    if (count < 2)
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "<spectrum>: it needs at least two wavelengths, not %zu", count);
    for (size_t i = 0; i < count; ++i) {
        if (values[i] < 0.0)
            return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                               "<spectrum>: the value at %g nm must not be negative", wavelengths[i]);
        if (i > 0 && !(wavelengths[i] > wavelengths[i - 1]))
            return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                               "<spectrum>: wavelengths must increase, but %g nm comes after %g nm",
                               wavelengths[i], wavelengths[i - 1]);
    }
    return AUR_OK;
}

static void to_srgb(const double xyz[3], double rgb[3]) {
    static const double matrix[3][3] = {
        {3.240479, -1.537150, -0.498535}, {-0.969256, 1.875991, 0.041556}, {0.055648, -0.204043, 1.057311}};
    for (size_t k = 0; k < 3; ++k)
        rgb[k] = matrix[k][0] * xyz[0] + matrix[k][1] * xyz[1] + matrix[k][2] * xyz[2];
}

void aur_spectrum_equal_energy(double value, double rgb[3]) {
    to_srgb((const double[3]){value, value, value}, rgb);
}

aur_result aur_spectrum_to_rgb(size_t count, const double *wavelengths, const double *values,
                               aur_location location, aur_spectrum_use use, double rgb[3], aur_error *error) {
    enum { STEPS = 1000 }; /* Mitsuba's sum, including both ends */
    const double span = CIE_LAST - CIE_FIRST;
    double sum[3] = {0.0};
    const aur_result result = check(count, wavelengths, values, location, error);
    if (result != AUR_OK)
        return result;
    for (size_t step = 0, i = 0; step < STEPS; ++step) {
        const double w = CIE_FIRST + (double)step / (STEPS - 1) * span;
        if (w < wavelengths[0] || w > wavelengths[count - 1])
            continue;
        while (i + 2 < count && wavelengths[i + 1] <= w)
            ++i;
        const double t = (w - wavelengths[i]) / (wavelengths[i + 1] - wavelengths[i]);
        double xyz[3];
        observer_at(w, use != AUR_SPECTRUM_EMITS, xyz);
        for (size_t k = 0; k < 3; ++k)
            sum[k] += mix(values[i], values[i + 1], t) * xyz[k] * span / STEPS;
    }
    to_srgb(sum, rgb);
    return AUR_OK;
}

bool aur_spectrum_clamp(aur_spectrum_use use, double rgb[3]) {
    const double most = use == AUR_SPECTRUM_REFLECTS ? 1.0 : (double)INFINITY;
    bool changed = false;
    for (size_t k = 0; k < 3; ++k) {
        const double inside = fmin(fmax(rgb[k], 0.0), most);
        changed = changed || inside != rgb[k];
        rgb[k] = inside;
    }
    return changed;
}

/* --- parsing */

typedef struct samples {
    size_t count, wavelength_capacity, value_capacity;
    double *wavelengths, *values;
} samples;

static aur_result append(samples *self, double wavelength, double value, aur_error *error) {
    if (!aur_array_reserve(&self->wavelengths, &self->wavelength_capacity, self->count + 1, sizeof(double)) ||
        !aur_array_reserve(&self->values, &self->value_capacity, self->count + 1, sizeof(double)))
        return aur_fail_memory(error);
    self->wavelengths[self->count] = wavelength;
    self->values[self->count++] = value;
    return AUR_OK;
}

/* The colour of the samples; frees them. */
static aur_result finish(samples *self, aur_location location, aur_spectrum_use use, aur_result result,
                         double rgb[3], aur_error *error) {
    if (result == AUR_OK)
        result = aur_spectrum_to_rgb(self->count, self->wavelengths, self->values, location, use, rgb, error);
    free(self->wavelengths);
    free(self->values);
    return result;
}

/* Parses a number, following blanks and an optional separator. NULL if there is no number. */
static const char *read_number(const char *text, char separator, double *value) {
    const char *const end = aur_read_double(aur_skip_spaces(text), AUR_NUMBER_FINITE, value);
    if (end == NULL)
        return NULL;
    const char *const next = aur_skip_spaces(end);
    return *next == separator ? aur_skip_spaces(next + 1) : next;
}

aur_result aur_spectrum_parse(const char *text, aur_location location, aur_spectrum_use use, double rgb[3],
                              aur_error *error) {
    samples self = {0};
    aur_result result = AUR_OK;
    for (const char *c = aur_skip_spaces(text); result == AUR_OK && *c != '\0';) {
        double wavelength, value;
        const char *const colon = aur_read_double(c, AUR_NUMBER_FINITE, &wavelength);
        const char *const end = colon != NULL && *colon == ':' ? read_number(colon + 1, ',', &value) : NULL;
        if (end == NULL)
            result =
                aur_fail_at(error, location, AUR_ERROR_FORMAT,
                            "<spectrum>: it must be wavelength:value pairs such as 400:0.1, not '%.40s'", c);
        else
            result = append(&self, wavelength, value, error);
        c = end;
    }
    return finish(&self, location, use, result, rgb, error);
}

aur_result aur_spectrum_read(const char *path, aur_location location, aur_spectrum_use use, double rgb[3],
                             aur_error *error) {
    enum { LARGEST_FILE = 1 << 24 };
    char *data;
    size_t size;
    aur_result result = aur_file_read(path, LARGEST_FILE, &data, &size, error);
    if (result != AUR_OK)
        return result;
    samples self = {0};
    size_t number = 1;
    for (char *line = data; line != NULL && result == AUR_OK; ++number) {
        char *const end = strchr(line, '\n');
        line[strcspn(line, "#\n")] = '\0';
        double wavelength, value;
        const char *c = aur_skip_spaces(line);
        if (*c != '\0') {
            c = read_number(c, ',', &wavelength);
            c = c != NULL ? read_number(c, ',', &value) : NULL;
            result = c != NULL && *c == '\0'
                         ? append(&self, wavelength, value, error)
                         : aur_fail_at(error, location, AUR_ERROR_FORMAT,
                                       "%s:%zu: a line must be a wavelength and a value", path, number);
        }
        line = end != NULL ? end + 1 : NULL;
    }
    free(data);
    return finish(&self, location, use, result, rgb, error);
}
