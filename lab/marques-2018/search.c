/* Searches settings that Marques 2018 leaves open for the gains of its section 5.3, 19.1 and 24.1 %: the
 * angle between the lobes, the map, unscrambled or scrambled points, and how the errors of two integrals are
 * combined.
 *
 * Settings, fixed before the run: angles of 0 to 75 degrees in steps of 15, Lambert's and the concentric map;
 * errors of normalised lobes added, squared and added, added by the lobes' masses (pi and 2 pi / 21), and the
 * larger of both. The same points and weights are used for all four. A setting matches if both gains are
 * within half a point. */
#include "search.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DIFFUSE = 128, GLOSSY = 64, ALL = DIFFUSE + GLOSSY, COMBINATIONS = 4, METHODS = 3 };

static const double PI = 3.14159265358979323846;

static const char *const combination_names[COMBINATIONS] = {"sum", "root of squares", "sum by mass",
                                                            "larger"};

/* Errors of one lobe each by one method: equal weights, OSW, OSWA. */
static double combine(size_t combination, const double lobes[2]) {
    switch (combination) {
    case 0:
        return lobes[0] + lobes[1];
    case 1:
        return hypot(lobes[0], lobes[1]);
    case 2:
        return PI * lobes[0] + 2.0 * PI / 21.0 * lobes[1];
    default:
        return fmax(lobes[0], lobes[1]);
    }
}

typedef struct search_setting {
    aur_map map;
    bool scrambled;
    double radians;
    const aur_potential *lobes[2];
} search_setting;

static aur_result draw(const search_setting *of, bool glossy, uint64_t seed, double *xyz, aur_error *error) {
    const aur_directions_options options = {.size = sizeof options,
                                            .count = glossy ? GLOSSY : DIFFUSE,
                                            .domain = AUR_DOMAIN_HEMISPHERE,
                                            .lobe = {.exponent = glossy ? 20.0 : 1.0},
                                            .map = of->map,
                                            .scramble =
                                                of->scrambled ? AUR_SCRAMBLE_DIGIT : AUR_SCRAMBLE_NONE,
                                            .seed = 2 * seed + glossy};
    aur_directions *directions;
    aur_result result = aur_directions_create("sobol", &options, &directions, error);
    if (result != AUR_OK)
        return result;
    result = aur_directions_points(directions, 0, options.count, 3 * options.count, xyz, NULL, NULL);
    aur_directions_destroy(directions);
    const double c = cos(of->radians), s = sin(of->radians);
    for (size_t i = 0; i < options.count && glossy; ++i) {
        const double x = xyz[3 * i], z = xyz[3 * i + 2];
        xyz[3 * i] = c * x - s * z;
        xyz[3 * i + 2] = s * x + c * z;
    }
    return result;
}

/* errors[method][lobe]. */
static aur_result measure(const search_setting *of, uint64_t seed, double errors[METHODS][2],
                          aur_error *error) {
    const aur_weights_options options = {.size = sizeof options,
                                         .regularization = AUR_REGULARIZATION_DEFAULT};
    double xyz[3 * ALL], weights[2 * ALL];
    const size_t first[2] = {0, DIFFUSE}, count[2] = {DIFFUSE, GLOSSY};
    aur_result result = AUR_OK;
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        aur_weights_report report = {0};
        result = draw(of, k == 1, seed, xyz + 3 * first[k], error);
        if (result == AUR_OK)
            result = aur_weights_solve(count[k], xyz + 3 * first[k], 1, &of->lobes[k], &options, count[k],
                                       weights, &report, NULL, error);
        errors[0][k] = report.equal_error;
        errors[1][k] = report.optimal_error;
    }
    aur_weights_report all[2] = {{0}};
    if (result == AUR_OK)
        result = aur_weights_solve(ALL, xyz, 2, of->lobes, &options, 2 * ALL, weights, all, NULL, error);
    for (size_t k = 0; k < 2; ++k)
        errors[2][k] = all[k].optimal_error;
    return result;
}

static aur_result try_setting(const search_setting *of, size_t seeds, report_table *table, size_t *found,
                              aur_error *error) {
    double gains[COMBINATIONS][2] = {{0.0}};
    for (uint64_t seed = 0; seed < seeds; ++seed) {
        double errors[METHODS][2];
        const aur_result result = measure(of, seed, errors, error);
        if (result != AUR_OK)
            return result;
        for (size_t c = 0; c < COMBINATIONS; ++c) {
            const double oswa = combine(c, errors[2]);
            gains[c][0] += 100.0 * (1.0 - oswa / combine(c, errors[1])) / (double)seeds;
            gains[c][1] += 100.0 * (1.0 - oswa / combine(c, errors[0])) / (double)seeds;
        }
    }
    for (size_t c = 0; c < COMBINATIONS; ++c) {
        *found += fabs(gains[c][0] - 19.1) < 0.5 && fabs(gains[c][1] - 24.1) < 0.5;
        lab_table_row(table,
                      (const char *const[]){of->map == AUR_MAP_CONCENTRIC ? "concentric" : "Lambert",
                                            of->scrambled ? "scrambled" : "plain", combination_names[c],
                                            NULL},
                      3, (const double[]){of->radians * 180.0 / PI, gains[c][0], gains[c][1]});
    }
    return AUR_OK;
}

aur_result lab_gains_search(lab_run *run, aur_error *error) {
    static const char *const of_search[] = {"map",      "points",     "errors", "degrees",
                                            "over_osw", "over_equal", NULL};
    const bool quick = lab_run_options(run)->quick;
    report_table *const table = lab_table(run, "search", of_search);
    size_t found = 0, tried = 0;
    aur_result result = AUR_OK;
    for (int degrees = 0; degrees <= 75 && result == AUR_OK; degrees += quick ? 45 : 15) {
        search_setting of = {.radians = degrees * PI / 180.0};
        aur_density densities[2] = {{.size = sizeof(aur_density), .exponent = 1.0},
                                    {.size = sizeof(aur_density), .exponent = 20.0}};
        densities[1].axis[0] = -sin(of.radians);
        densities[1].axis[2] = cos(of.radians);
        aur_potential *lobes[2] = {NULL, NULL};
        for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
            result = aur_potential_create(&densities[k], 1.5, &lobes[k], error);
            of.lobes[k] = lobes[k];
        }
        for (size_t map = 0; map < 4 && result == AUR_OK; ++map) {
            of.map = map < 2 ? AUR_MAP_LAMBERT : AUR_MAP_CONCENTRIC;
            of.scrambled = map % 2 == 1;
            result = try_setting(&of, of.scrambled ? (quick ? 4 : 100) : 1, table, &found, error);
            tried += COMBINATIONS;
        }
        for (size_t k = 0; k < 2; ++k)
            aur_potential_destroy(lobes[k]);
    }
    if (result == AUR_OK)
        lab_note(run, "19.1 and 24.1 %% of section 5.3: %zu of %zu settings have both within half a point%s",
                 found, tried, found == 0 ? ", so that they stay open" : "");
    return result;
}
