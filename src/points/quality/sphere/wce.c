/* The worst-case error of the points as a quadrature rule; points/quadrature computes it. */
#include <aureole/quadrature.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/parameters.h"
#include "points/base/text.h"
#include "points/quality/measure.h"

/* "S[:LOBE]". */
static aur_result parse(const char *text, double *smoothness, aur_lobe *lobe, aur_error *error) {
    const size_t length = strcspn(text, ":");
    char number[32];
    if (length >= sizeof number)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "wce: '%s' begins with no smoothness", text);
    memcpy(number, text, length);
    number[length] = '\0';
    if (!aur_parse_double(number, smoothness) || *smoothness == 0.0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "wce: '%s' is not a smoothness", number);
    *lobe = (aur_lobe){.kind = AUR_LOBE_COSINE_POWER};
    return text[length] == ':' ? aur_lobe_parse(text + length + 1, lobe, error) : AUR_OK;
}

/* Unchanged weights: those of a rule for the density normalised to integral 1. */
static aur_result wce(const aur_measure_request *request, double *value, aur_error *error) {
    const aur_points_view *const points = request->points;
    double smoothness;
    aur_lobe lobe;
    aur_density density = {.size = sizeof density};
    aur_density_init(&density, NULL);
    aur_potential *potential = NULL;
    aur_result result = parse(request->parameter, &smoothness, &lobe, error);
    if (result == AUR_OK)
        result = aur_density_from_lobe(&lobe, points->domain, &density, error);
    if (result == AUR_OK)
        result = aur_potential_create(&density, smoothness, &potential, error);
    const aur_worst_case_options options = {
        .size = sizeof options, .threads = request->options.threads, .progress = request->options.progress};
    if (result == AUR_OK)
        result = aur_worst_case_error(points->count, points->coordinates, points->weights, potential,
                                      &options, value, error);
    aur_potential_destroy(potential);
    return result;
}

const aur_measure_row aur_measure_wce = {
    {.row = {.name = "wce",
             .summary = "worst-case error as a rule for the density LOBE (uniform), smoothness S; weights "
                        "are taken as they are",
             .source = "Marques 2018 eq. 9"},
     .parameter = ":S[:LOBE]",
     .domains = "hemisphere, sphere"},
    .compute = wce};
