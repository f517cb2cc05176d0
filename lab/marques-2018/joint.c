/* Joint optimisation of points and weights for a lobe, which Marques 2018 leaves as future work: its eq. 15
 * is the worst-case error with the best weights of given points; here the points also descend its gradient.
 *
 * With the best weights w the derivative of the error by a point is that at constant weights,
 *
 * d(E^2)/du_i = 2 w_i (sum_j w_j dK(u_i, u_j)/du_i - dz(u_i)/du_i),
 *
 * so a step costs one solve. Step lengths follow Barzilai and Borwein 1988, halved until the error falls;
 * points stay on the upper hemisphere. Settings, fixed before the run: s = 1.5, STEPS steps, from spherical
 * Fibonacci points of the optimal density and from random ones (two sets). Descent finds a local minimum,
 * which depends on the start. Errors under random lights are those of samples.h, with the pattern rotated
 * randomly about the axis for each. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "samples.h"

enum { MOST = 64, REFERENCE = 16384, LIGHTS = 400, KINDS = 6 };

static const double SMOOTHNESS = 1.5;

typedef enum joint_kind { EQUAL, WEIGHED, DENSE, MOVED, JOINT, JOINT_RANDOM } joint_kind;

static const char *const names[KINDS] = {"equal weights",
                                         "optimal weights",
                                         "optimal density and weights",
                                         "points for equal weights",
                                         "points and weights",
                                         "points and weights from random"};

static const char *const columns[] = {"exponent",   "N",      "points",     "wce", "over_equal",
                                      "over_dense", "smooth", "hard_edges", NULL};

typedef struct joint_study {
    lab_run *run;
    double exponent;
    size_t count, steps;
    const aur_potential *lobe;
    double reference[3 * REFERENCE]; /* points of the lobe */
} joint_study;

typedef struct joint_rule {
    double xyz[3 * MOST], weights[MOST], wce;
} joint_rule;

/* Weights (the best, or 1/N) and error of the rule's points. */
static aur_result weigh(const joint_study *of, bool optimal, joint_rule *rule, aur_error *error) {
    aur_weights_report report;
    aur_weights_options options = {.size = sizeof options};
    aur_weights_options_init(&options, NULL);
    const aur_result result = aur_weights_solve(of->count, rule->xyz, 1, &of->lobe, &options, of->count,
                                                rule->weights, &report, NULL, error);
    rule->wce = optimal ? report.optimal_error : report.equal_error;
    for (size_t i = 0; i < of->count && !optimal; ++i)
        rule->weights[i] = 1.0 / (double)of->count;
    return result;
}

/* Two orthogonal tangent vectors at u. */
static void frame(const double u[3], double tangent[2][3]) {
    const double *const axis =
        fabs(u[2]) < 0.9 ? (const double[3]){0.0, 0.0, 1.0} : (const double[3]){1.0, 0.0, 0.0};
    double *const a = tangent[0], *const b = tangent[1];
    for (size_t k = 0; k < 3; ++k)
        a[k] = axis[(k + 1) % 3] * u[(k + 2) % 3] - axis[(k + 2) % 3] * u[(k + 1) % 3];
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (size_t k = 0; k < 3; ++k)
        a[k] /= length;
    for (size_t k = 0; k < 3; ++k)
        b[k] = u[(k + 1) % 3] * a[(k + 2) % 3] - u[(k + 2) % 3] * a[(k + 1) % 3];
}

/* Of half the squared error, along the sphere. */
static void find_gradient(const joint_study *of, const joint_rule *rule, double gradient[3 * MOST]) {
    static const double STEP = 1e-5; /* for finite differences of z, which is smooth */
    memset(gradient, 0, 3 * of->count * sizeof *gradient);
    for (size_t i = 0; i < of->count; ++i) {
        const double *const u = rule->xyz + 3 * i;
        double tangent[2][3];
        frame(u, tangent);
        for (size_t t = 0; t < 2; ++t) {
            double at[6], z[2], along = 0.0;
            for (size_t k = 0; k < 3; ++k) {
                at[k] = u[k] + STEP * tangent[t][k];
                at[3 + k] = u[k] - STEP * tangent[t][k];
            }
            aur_potential_evaluate(of->lobe, 2, at, z);
            for (size_t j = 0; j < of->count; ++j) {
                const double *const v = rule->xyz + 3 * j;
                const double d[3] = {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
                const double chord = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                if (j != i && chord > 0.0)
                    along -= rule->weights[j] * (2.0 * SMOOTHNESS - 2.0) *
                             pow(chord, 2.0 * SMOOTHNESS - 4.0) *
                             (d[0] * tangent[t][0] + d[1] * tangent[t][1] + d[2] * tangent[t][2]);
            }
            along = rule->weights[i] * (along - (z[0] - z[1]) / (2.0 * STEP));
            for (size_t k = 0; k < 3; ++k)
                gradient[3 * i + k] += along * tangent[t][k];
        }
    }
}

/* Projects back to the upper hemisphere. */
static void put_back(double u[3]) {
    u[2] = fmax(u[2], 1e-6);
    const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (size_t k = 0; k < 3; ++k)
        u[k] /= length;
}

static double dot(size_t count, const double *a, const double *b) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += a[i] * b[i];
    return sum;
}

static aur_result descend(const joint_study *of, bool optimal, joint_rule *rule, aur_error *error) {
    const size_t numbers = 3 * of->count;
    double gradient[3 * MOST], after[3 * MOST], moved[3 * MOST], changed[3 * MOST];
    double step = 1.0;
    aur_result result = weigh(of, optimal, rule, error);
    find_gradient(of, rule, gradient);
    for (size_t n = 0; n < of->steps && result == AUR_OK; ++n) {
        joint_rule candidate = *rule;
        for (size_t halvings = 0; halvings < 30; ++halvings, step *= 0.5) {
            for (size_t i = 0; i < numbers; ++i)
                candidate.xyz[i] = rule->xyz[i] - step * gradient[i];
            for (size_t i = 0; i < of->count; ++i)
                put_back(candidate.xyz + 3 * i);
            result = weigh(of, optimal, &candidate, error);
            if (result != AUR_OK || candidate.wce < rule->wce)
                break;
        }
        if (result != AUR_OK || !(candidate.wce < rule->wce))
            break;
        find_gradient(of, &candidate, after);
        for (size_t i = 0; i < numbers; ++i) {
            moved[i] = candidate.xyz[i] - rule->xyz[i];
            changed[i] = after[i] - gradient[i];
        }
        const double along = dot(numbers, moved, changed);
        step = along > 0.0 ? dot(numbers, moved, moved) / along : 2.0 * step;
        memcpy(gradient, after, sizeof gradient);
        *rule = candidate;
    }
    return result;
}

static aur_result make(const joint_study *of, joint_kind kind, size_t start, joint_rule *rule,
                       aur_error *error) {
    const bool dense = kind == DENSE || kind == JOINT, random = kind == JOINT_RANDOM;
    const lab_samples points = {.set = random ? "random" : "spherical-fibonacci",
                                .count = of->count,
                                .exponent = of->exponent,
                                .optimal_density = dense || random,
                                .seed = start};
    aur_result result = lab_draw(&points, rule->xyz, NULL, error);
    for (size_t i = 0; i < of->count; ++i)
        put_back(rule->xyz + 3 * i);
    if (result == AUR_OK)
        result =
            kind >= MOVED ? descend(of, kind != MOVED, rule, error) : weigh(of, kind != EQUAL, rule, error);
    return result;
}

/* The RMSE of the integral under random lights. */
static double judge(const joint_study *of, const joint_rule *rule, bool hard) {
    double square = 0.0;
    for (uint64_t seed = 0; seed < LIGHTS; ++seed) {
        const lab_light light = lab_random_light(seed, hard);
        const double turn = 2.399963229728653 * (double)seed, c = cos(turn), s = sin(turn);
        double exact = 0.0, found = 0.0;
        for (size_t i = 0; i < REFERENCE; ++i)
            exact += lab_radiance(&light, of->reference + 3 * i) / REFERENCE;
        for (size_t i = 0; i < of->count; ++i) {
            const double *const u = rule->xyz + 3 * i;
            found += rule->weights[i] *
                     lab_radiance(&light, (const double[]){c * u[0] - s * u[1], s * u[0] + c * u[1], u[2]});
        }
        square += (found - exact) * (found - exact) / LIGHTS;
    }
    return sqrt(square);
}

static aur_result study_size(joint_study *of, aur_error *error) {
    double base[3] = {0}, dense = 0.0, joint = 0.0;
    for (size_t kind = 0; kind < KINDS; ++kind) {
        const size_t starts = kind == JOINT_RANDOM ? 2 : 1;
        double values[3] = {INFINITY, 0.0, 0.0};
        char key[100];
        snprintf(key, sizeof key, "m %g, N %zu, %s", of->exponent, of->count, names[kind]);
        if (!lab_recall(of->run, key, 3, values)) {
            for (size_t start = 0; start < starts; ++start) {
                joint_rule rule;
                const aur_result result = make(of, (joint_kind)kind, start, &rule, error);
                if (result != AUR_OK)
                    return result;
                if (rule.wce < values[0]) {
                    values[0] = rule.wce;
                    values[1] = judge(of, &rule, false);
                    values[2] = judge(of, &rule, true);
                }
            }
            const aur_result result = lab_save(of->run, key, 3, values, error);
            if (result != AUR_OK)
                return result;
        }
        if (kind == EQUAL)
            memcpy(base, values, sizeof base);
        dense = kind == DENSE ? values[0] : dense;
        joint = kind == JOINT ? values[0] : joint;
        char exponent[16], count[16];
        snprintf(exponent, sizeof exponent, "%g", of->exponent);
        snprintf(count, sizeof count, "%zu", of->count);
        lab_row(of->run, (const char *const[]){exponent, count, names[kind], NULL}, 5,
                (const double[]){values[0], values[0] / base[0], kind < DENSE ? NAN : values[0] / dense,
                                 values[1] / base[1], values[2] / base[2]});
    }
    lab_note(of->run,
             "exponent %g, N = %zu: points and weights together leave %.4f of the error of the optimal "
             "density and weights",
             of->exponent, of->count, joint / dense);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    static const double exponents[] = {1.0, 20.0};
    static const size_t counts[] = {16, 32, 64};
    const bool quick = lab_run_options(run)->quick;
    static joint_study of;
    of = (joint_study){.run = run, .steps = quick ? 40 : 400};
    aur_result result = AUR_OK;
    for (size_t m = quick ? 1 : 0; m < 2 && result == AUR_OK; ++m) {
        aur_potential *lobe = NULL;
        of.exponent = exponents[m];
        result = lab_lobe_potential(of.exponent, SMOOTHNESS, &lobe, error);
        of.lobe = lobe;
        if (result == AUR_OK)
            result = lab_draw(&(lab_samples){"spherical-fibonacci", REFERENCE, of.exponent, 0, 0},
                              of.reference, NULL, error);
        for (size_t n = 0; n < (quick ? 1 : 3) && result == AUR_OK; ++n) {
            of.count = counts[n];
            result = study_size(&of, error);
        }
        aur_potential_destroy(lobe);
    }
    return result;
}

const lab_experiment lab_marques_2018_joint = {
    .name = "marques-2018-joint",
    .reproduces = "Marques 2018, section 7: points by eq. 15",
    .summary = "points and weights of a lobe optimised together, compared with weights of given points",
    .columns = columns,
    .takes_no_set = "it moves its points",
    .seconds = 7,
    .quick_seconds = 1,
    .run = run,
};
