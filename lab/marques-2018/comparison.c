/* Compares weights for the same samples: 64 diffuse samples and 32 glossy ones (m = 20) under random lights,
 * smooth ones and ones with hard edges, with views from normal to grazing. The integral is the diffuse plus
 * the glossy part, each with weight 1; no light comes from below the surface. Compared are the weights of
 * Marques 2018 section 6.3 and published methods that also solve a system: optimal multiple importance
 * sampling, a control variate by the two densities (Kondapaneni 2019), and regression on polynomials of
 * degree 2 and 3 in x, y, z, with 9 and 16 functions per lobe (Salaun 2022). The latter use the horizon, as
 * clipped weights do. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "control.h"
#include "samples.h"

enum { DIFFUSE = 64, GLOSSY = 32, ALL = DIFFUSE + GLOSSY, REFERENCE = 16384, ANGLES = 4 };

typedef enum method {
    EQUAL,       /* each lobe from its own samples, 1/N */
    SCALED,      /* the same, over the visible samples, times the visible fraction of the lobe */
    BALANCE,     /* multiple importance sampling */
    POWER,       /* with the power heuristic */
    OPTIMAL_MIS, /* control variate by the densities */
    SQUARES,     /* control variate by polynomials of degree 2 */
    CUBES,       /* control variate by polynomials of degree 3 */
    OSW,         /* optimal weights, each lobe from its own samples */
    PUBLISHED,   /* OSWA as published: z from a table, sigma = 0.5, no constraint */
    WHOLE,       /* OSWA for complete lobes */
    CLIPPED,     /* OSWA for lobes clipped at the horizon */
    TABLE,       /* the same from a table of 128 angles */
    DENSE,       /* the same for points of the optimal density */
    METHODS
} method;

static const char *const names[METHODS] = {"equal",
                                           "equal, scaled by visible part",
                                           "MIS balance",
                                           "MIS power",
                                           "optimal MIS",
                                           "regression of degree 2",
                                           "regression of degree 3",
                                           "OSW",
                                           "OSWA as published",
                                           "OSWA",
                                           "OSWA, clipped",
                                           "OSWA, clipped, table",
                                           "OSWA, clipped, optimal density"};

/* Of cos^20, in steradian. */
static const double whole_mass = 2.0 * 3.14159265358979323846 / 21.0;

static const char *const columns[] = {"set", "light", "degrees", "method", "rmse", "relative_to_equal", NULL};

/* Samples and weights of one method: weights[0] for the diffuse lobe, [1] for the glossy one, whose `visible`
 * part is estimated. */
typedef struct rule {
    double xyz[3 * ALL], weights[2][ALL];
    double visible;
} rule;

typedef struct study {
    lab_run *run;
    const char *set;
    double radians;
    aur_weight_table *table; /* of the set */
    double *reference;       /* 6 * REFERENCE: points of both lobes */
} study;

/* The paper uses strong regularisation, and no constraint on the sum. */
static const aur_weights_options published = {.size = sizeof published, .regularization = 0.5};

static aur_oswa_options pair(const study *s, method m, uint64_t seed) {
    aur_oswa_options options = {.size = sizeof(aur_oswa_options),
                                .set = s->set,
                                .count = DIFFUSE,
                                .mirror_count = GLOSSY,
                                .lobe = {.exponent = 1.0},
                                .mirror_lobe = {.exponent = 20.0},
                                .optimal_density = m == DENSE,
                                .clipped = m == CLIPPED || m == TABLE || m == DENSE || m == SCALED,
                                .scramble = lab_scrambling(s->set),
                                .seed = seed};
    if (m == PUBLISHED) {
        options.weights = &published;
        options.published_z =
            (aur_z_grid){.angle_count = 64, .exponent_count = 32, .largest_exponent = 100.0};
    }
    return options;
}

/* Each light uses another rotation of the table, in turn. */
static aur_result from_table(const study *s, uint64_t seed, rule *r, aur_error *error) {
    const size_t rotation = seed % aur_weight_table_rotations(s->table);
    float weights[ALL];
    aur_result result =
        aur_weight_table_points(s->table, s->radians, 0.0, rotation, false, 3 * ALL, r->xyz, error);
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        result = aur_weight_table_look_up(s->table, k, rotation, s->radians, 0.0, ALL, weights, error);
        for (size_t i = 0; i < ALL && result == AUR_OK; ++i)
            r->weights[k][i] = (double)weights[i];
    }
    r->visible = aur_weight_table_mass(s->table, s->radians, 0.0) / whole_mass;
    return result;
}

/* Weights that need no merged solve. */
static aur_result separate(const study *s, method m, rule *r, aur_error *error) {
    const double axis[3] = {-sin(s->radians), 0.0, cos(s->radians)};
    aur_density densities[2] = {{.size = sizeof(aur_density)}, {.size = sizeof(aur_density)}};
    densities[0].exponent = 1.0;
    densities[1].exponent = 20.0;
    aur_strategy strategies[2] = {{.count = DIFFUSE, .sampled = {.exponent = 1.0}},
                                  {.count = GLOSSY, .sampled = {.exponent = 20.0}}};
    memcpy(densities[1].axis, axis, sizeof axis);
    memcpy(strategies[1].axis, axis, sizeof axis);
    const size_t first[2] = {0, DIFFUSE}, count[2] = {DIFFUSE, GLOSSY};
    aur_result result = AUR_OK;
    memset(r->weights, 0, sizeof r->weights);
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        aur_potential *potential;
        result = aur_potential_create(&densities[k], 1.5, &potential, error);
        if (result != AUR_OK)
            break;
        const aur_potential *const one = potential;
        double *const lobe_weights = r->weights[k] + first[k];
        size_t seen = 0;
        for (size_t i = first[k]; i < first[k] + count[k]; ++i)
            seen += m != SCALED || r->xyz[3 * i + 2] >= 0.0;
        if (m == OSW)
            result = aur_weights_solve(count[k], r->xyz + 3 * first[k], 1, &one, NULL, count[k], lobe_weights,
                                       NULL, NULL, error);
        else if (m == OPTIMAL_MIS || m == SQUARES || m == CUBES)
            result = lab_control_weights(
                &(lab_control){.basis = m == OPTIMAL_MIS ? LAB_CONTROL_DENSITIES : LAB_CONTROL_POLYNOMIALS,
                               .degree = m == CUBES ? 3 : 2,
                               .count = ALL,
                               .xyz = r->xyz,
                               .strategies = {strategies[0], strategies[1]},
                               .lobe = k,
                               .node_count = REFERENCE,
                               .nodes = s->reference},
                r->weights[k], error);
        else if (m == BALANCE || m == POWER)
            result = aur_mis_weights(m == POWER ? AUR_MIS_POWER : AUR_MIS_BALANCE, 2, strategies, potential,
                                     DIFFUSE + GLOSSY, r->xyz, r->weights[k], error);
        else
            for (size_t i = 0; i < count[k]; ++i)
                lobe_weights[i] = 1.0 / (double)seen;
        aur_potential_destroy(potential);
    }
    return result;
}

static aur_result make_rule(const study *s, method m, uint64_t seed, rule *r, aur_error *error) {
    const aur_oswa_options options = pair(s, m, seed);
    if (m == TABLE)
        return from_table(s, seed, r, error);
    aur_oswa *oswa;
    aur_result result = aur_oswa_create(&options, &oswa, error);
    if (result != AUR_OK)
        return result;
    const double turns[2] = {0.0, 0.0};
    double weights[2 * ALL], mass;
    result = aur_oswa_points(oswa, s->radians, turns, false, 3 * ALL, r->xyz, error);
    if (result == AUR_OK)
        result = aur_oswa_solve(oswa, s->radians, turns, 2 * ALL, weights, &mass, error);
    aur_oswa_destroy(oswa);
    if (result != AUR_OK)
        return result;
    r->visible = mass / whole_mass;
    if (m < PUBLISHED)
        return separate(s, m, r, error);
    memcpy(r->weights, weights, sizeof r->weights);
    return AUR_OK;
}

static double estimate(const rule *r, const lab_light *light) {
    double sum = 0.0;
    for (size_t i = 0; i < ALL; ++i)
        sum += (r->weights[0][i] + r->visible * r->weights[1][i]) * lab_radiance(light, r->xyz + 3 * i);
    return sum;
}

static double exact(const study *s, const lab_light *light) {
    double sum = 0.0;
    for (size_t i = 0; i < 2 * REFERENCE; ++i)
        sum += lab_radiance(light, s->reference + 3 * i) / REFERENCE;
    return sum;
}

/* If the light is in regression's function space, only rounding errors remain. */
static aur_result claim_exact(const study *s, aur_error *error) {
    rule r;
    double found[2] = {0.0}, expected[2] = {0.0}, off = 0.0;
    const aur_result result = make_rule(s, SQUARES, 1, &r, error);
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        for (size_t i = 0; i < ALL; ++i)
            found[k] += r.weights[k][i] * (r.xyz[3 * i] * r.xyz[3 * i + 2] + 0.5);
        for (size_t i = k * REFERENCE; i < (k + 1) * REFERENCE; ++i)
            if (s->reference[3 * i + 2] >= 0.0)
                expected[k] += (s->reference[3 * i] * s->reference[3 * i + 2] + 0.5) / REFERENCE;
        off = fmax(off, fabs(found[k] / expected[k] - 1.0));
    }
    if (result == AUR_OK)
        lab_claim(s->run, off < 1e-7, "%s: regression of degree 2 is exact for light x z + 1/2 (off by %.0e)",
                  s->set, off);
    return result;
}

static aur_result compare(study *s, double degrees, bool hard, aur_error *error) {
    const uint64_t lights = lab_run_options(s->run)->quick ? 16 : 120;
    s->radians = degrees * 3.14159265358979323846 / 180.0;
    aur_result result =
        lab_draw(&(lab_samples){"spherical-fibonacci", REFERENCE, 1.0, 0, 0}, s->reference, NULL, error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){"spherical-fibonacci", REFERENCE, 20.0, 0, 0},
                          s->reference + 3 * REFERENCE, NULL, error);
    for (size_t i = REFERENCE; i < 2 * REFERENCE; ++i) {
        const double x = s->reference[3 * i], z = s->reference[3 * i + 2];
        s->reference[3 * i] = cos(s->radians) * x - sin(s->radians) * z;
        s->reference[3 * i + 2] = sin(s->radians) * x + cos(s->radians) * z;
    }
    double squares[METHODS] = {0};
    for (uint64_t seed = 0; seed < lights && result == AUR_OK; ++seed) {
        const lab_light light = lab_random_light(seed, hard);
        const double expected = exact(s, &light);
        for (int m = 0; m < METHODS && result == AUR_OK; ++m) {
            rule r;
            result = make_rule(s, (method)m, seed, &r, error);
            if (result == AUR_OK)
                squares[m] += pow(estimate(&r, &light) - expected, 2) / (double)lights;
        }
    }
    for (int m = 0; m < METHODS && result == AUR_OK; ++m) {
        lab_text(s->run, s->set);
        lab_text(s->run, hard ? "hard edges" : "smooth");
        lab_number(s->run, degrees);
        lab_text(s->run, names[m]);
        lab_number(s->run, sqrt(squares[m]));
        lab_number(s->run, sqrt(squares[m] / squares[EQUAL]));
    }
    if (result == AUR_OK)
        lab_note(s->run,
                 "%s, %s light, %g degrees: error over that of equal weights: OSWA %.2f, clipped %.2f, MIS "
                 "%.2f, optimal "
                 "MIS %.2f, regression %.2f and %.2f",
                 s->set, hard ? "hard-edged" : "smooth", degrees, sqrt(squares[WHOLE] / squares[EQUAL]),
                 sqrt(squares[CLIPPED] / squares[EQUAL]), sqrt(squares[BALANCE] / squares[EQUAL]),
                 sqrt(squares[OPTIMAL_MIS] / squares[EQUAL]), sqrt(squares[SQUARES] / squares[EQUAL]),
                 sqrt(squares[CUBES] / squares[EQUAL]));
    return result;
}

static aur_result study_set(study *s, aur_error *error) {
    static const double degrees[ANGLES] = {60.0, 75.0, 0.0, 30.0};
    const lab_options *const options = lab_run_options(s->run);
    const aur_oswa_options tabulated = pair(s, TABLE, 0);
    const aur_weight_table_grid grid = {.size = sizeof grid,
                                        .angle_count = 128,
                                        .roughness_count = 1,
                                        .rotation_count = options->quick ? 4 : 16};
    aur_result result =
        aur_weight_table_build(&tabulated, &grid, options->threads, &options->progress, &s->table, error);
    for (size_t d = 0; d < (options->quick ? 2 : ANGLES) && result == AUR_OK; ++d) {
        result = compare(s, degrees[d], false, error);
        if (result == AUR_OK)
            result = compare(s, degrees[d], true, error);
    }
    aur_weight_table_destroy(s->table);
    s->table = NULL;
    return result == AUR_OK ? claim_exact(s, error) : result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    study s = {.run = run, .reference = malloc(6 * REFERENCE * sizeof *s.reference)};
    if (s.reference == NULL)
        return AUR_ERROR_MEMORY;
    aur_result result = AUR_OK;
    const bool whole = !options->quick;
    const char *const sets[] = {"sobol",
                                "spherical-fibonacci",
                                whole ? "random" : NULL,
                                whole ? "pmj02" : NULL,
                                whole ? "sliced" : NULL,
                                options->set};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0] && result == AUR_OK; ++i) {
        s.set = sets[i];
        if (s.set != NULL)
            result = lab_forgive(run, s.set, study_set(&s, error), error);
    }
    free(s.reference);
    return result;
}

const lab_experiment lab_marques_2018_rivals = {
    .name = "marques-2018-rivals",
    .reproduces = "none: lights of known truth for 6.3's weights",
    .summary = "equal weights, MIS, optimal MIS, regression, OSW and OSWA under random lights",
    .columns = columns,
    .seconds = 170,
    .quick_seconds = 5,
    .run = run,
};
