/* A tabulated phase function: values at equidistant cosines from -1 (backward) to 1, interpolated linearly
 * and normalised. */
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/phase.h"

typedef struct table {
    const char *values;
    size_t count;
    float *densities; /* pdf of the cosine at the nodes: 2 pi times the phase function */
    float *sums;      /* cumulative distribution at the nodes */
} table;

static const aur_key keys[] = {
    {AUR_KEY_READ_APART(AUR_KEY_TEXT, "values", NULL,
                        "two or more numbers at equal steps of the cosine from -1 (backwards) to 1")},
};

static aur_result parse(const aur_parameters *parameters, const aur_parameter *item, table *self,
                        aur_error *error) {
    /* Each number takes at least two characters, with its separator. */
    const size_t most = strlen(item->text) / 2 + 1;
    double *const values = malloc(most * sizeof *values);
    self->densities = malloc(most * sizeof *self->densities);
    self->sums = malloc(most * sizeof *self->sums);
    if (values == NULL || self->densities == NULL || self->sums == NULL) {
        free(values);
        return aur_fail_memory_at(error, item->location);
    }
    self->count = aur_parse_doubles(item->text, values, most);
    bool good = self->count >= 2 && self->count <= most;
    double total = 0.0, largest = 0.0;
    for (size_t i = 0; good && i < self->count; ++i) {
        good = values[i] >= 0.0 && values[i] <= 1e30;
        largest = fmax(largest, values[i]);
    }
    for (size_t i = 1; good && largest > 0.0 && i < self->count; ++i)
        total += (values[i - 1] + values[i]) / largest / (double)(self->count - 1);
    good = good && total > 0.0;
    double sum = 0.0;
    for (size_t i = 0; good && i < self->count; ++i) {
        if (i > 0)
            sum += (values[i - 1] + values[i]) / largest / (double)(self->count - 1);
        self->densities[i] = (float)(values[i] / largest / total);
        self->sums[i] = (float)(sum / total);
    }
    free(values);
    return good ? AUR_OK
                : aur_parameters_fail_value(
                      parameters, item, "two or more numbers that are not negative, and not all 0", error);
}

static aur_result create(aur_parameters *parameters, aur_phase *phase, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, "values");
    if (item == NULL || item->text == NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs 'values'");
    return parse(parameters, item, phase->data, error);
}

static void release(void *data) {
    table *const self = data;
    free(self->densities);
    free(self->sums);
}

static float evaluate(const aur_phase *phase, aur_vector position, float cosine) {
    (void)position;
    const table *const self = phase->data;
    const float at = aur_larger(0.5f * (cosine + 1.0f), 0.0f) * (float)(self->count - 1);
    size_t i = (size_t)at;
    if (i > self->count - 2)
        i = self->count - 2;
    const float rest = aur_smaller(at - (float)i, 1.0f);
    return (self->densities[i] + rest * (self->densities[i + 1] - self->densities[i])) / (2.0f * AUR_PI_F);
}

/* Finds the interval in which the cumulative distribution reaches u, and solves a quadratic there. */
static float draw(const aur_phase *phase, aur_vector position, float u) {
    (void)position;
    const table *const self = phase->data;
    size_t low = 0, high = self->count - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(self->sums[middle] <= u ? &low : &high) = middle;
    }
    const float step = 2.0f / (float)(self->count - 1);
    const float a = self->densities[low], slope = self->densities[low + 1] - a;
    const float target = aur_larger(u - self->sums[low], 0.0f) / step;
    /* Solves a x + slope x^2 / 2 = target in a form without cancellation for small slopes. */
    const float root = sqrtf(aur_larger(a * a + 2.0f * slope * target, 0.0f));
    const float x = a + root > 0.0f ? 2.0f * target / (a + root) : 0.0f;
    return aur_smaller(((float)low + aur_smaller(x, 1.0f)) * step - 1.0f, 1.0f);
}

const aur_phase_descriptor aur_phase_tabphase = {
    .row = {.name = "tabphase",
            .summary = "a table of values, linear in the cosine between them",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(table),
    .create = create,
    .release = release,
    .evaluate = evaluate,
    .draw = draw,
};
