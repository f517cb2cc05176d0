/* Hypotheses on the "empty cube" of Keller 1994's tables 2 and 3, and on its Faure points: the cube, a box of
 * 1 x 1 x 26 and a flat one of 5 x 4 x .05, each with the paper's sequences and with Faure's sequence in four
 * forms. The text states none of them; all are compared with the same published rows.
 *
 * Settings, fixed before the run: 1 x 1 x 26 has the ratio of the two published tables, 5 x 4 x .05 is a flat
 * room with integer ratios of its sides. Faure's sequence is plain, with random lower-triangular matrices,
 * and plain from the points 67^2 - 1 and 67^3 - 1 on, similar to Bratley and Fox 1986 (who use the fourth
 * power, which takes 20 million points first). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study.h"

enum { BOXES = 3, FORMS = 8, FAURES = 4, PUBLISHED_FAURE = 3, BOUNCES = 29, MOST_TRIANGLES = 12 };

static const struct {
    const char *name, *lengths[3];
} boxes[BOXES] = {
    {"cube", {"1", "1", "1"}}, {"1 x 1 x 26", {"1", "1", "26"}}, {"5 x 4 x .05", {"5", "4", "0.05"}}};

/* The first FAURES are candidates for the published Faure column. */
static const struct {
    const char *name, *set;
    uint64_t skipped; /* initial points omitted, besides point 0 */
    size_t published;
    bool quick;
} forms[FORMS] = {{"faure", "faure", 0, PUBLISHED_FAURE, true},
                  {"faure scrambled", "faure:scramble=lower-triangular", 0, PUBLISHED_FAURE, true},
                  {"faure from 67^2 - 1", "faure", 67 * 67 - 2, PUBLISHED_FAURE, true},
                  {"faure from 67^3 - 1", "faure", 67 * 67 * 67 - 2, PUBLISHED_FAURE, false},
                  {"lcg", "lcg", 0, 0, false},
                  {"icg", "icg", 0, 1, false},
                  {"halton", "halton", 0, 2, true},
                  {"sobol", "sobol", 0, 4, false}};

static const char *const columns[] = {"box",   "sequence", "table",     "N", "rms",
                                      "least", "greatest", "published", NULL};

/* Mean square deviations: [table 2 or 3][N][variant]. */
typedef struct box_deviations {
    double squares[2][KELLER_SIZES][KELLER_VARIANTS];
} box_deviations;

typedef struct box_study {
    lab_run *run;
    const aur_scene *scene;
    const char *box;
    size_t variants, size_count;
    bool within[FORMS][2][KELLER_SIZES]; /* within a factor of 1.5 of the published value */
} box_study;

typedef struct box_solution {
    uint64_t paths;
    double radiance[MOST_TRIANGLES], area[MOST_TRIANGLES], whole;
} box_solution;

static aur_result solve(aur_radiosity *radiosity, uint64_t paths, box_solution *solution, aur_error *error) {
    aur_radiosity_triangle_result found[MOST_TRIANGLES];
    aur_radiosity_description d = {.size = sizeof d};
    aur_result result = aur_radiosity_trace(radiosity, paths, error);
    if (result == AUR_OK)
        result = aur_radiosity_get_description(radiosity, &d, error);
    if (result == AUR_OK)
        result = aur_radiosity_get_results(radiosity, MOST_TRIANGLES, sizeof *found, found, error);
    if (result != AUR_OK)
        return result;
    solution->paths = paths;
    solution->whole = d.area;
    for (size_t i = 0; i < MOST_TRIANGLES; ++i) {
        solution->radiance[i] = found[i].radiance[0];
        solution->area[i] = found[i].area;
    }
    return AUR_OK;
}

/* Delta_a^2 and Delta_aw^2 of the paths after those of `before`: reflected light is a mean over paths. */
static void deviate(const box_solution *before, const box_solution *all, double *plain, double *weighted) {
    const double answer = 0.5 - exp2(-(double)BOUNCES - 3.0), emitted = 0.25;
    const double count = (double)(all->paths - before->paths);
    *plain = *weighted = 0.0;
    for (size_t i = 0; i < MOST_TRIANGLES; ++i) {
        const double early = before->paths == 0 ? 0.0 : before->radiance[i] - emitted;
        const double sum = (double)all->paths * (all->radiance[i] - emitted) - (double)before->paths * early;
        const double off = emitted + sum / count - answer;
        *plain += off * off / MOST_TRIANGLES;
        *weighted += off * off * all->area[i] / (MOST_TRIANGLES * all->whole);
    }
}

static aur_result measure_variant(const box_study *study, size_t form, size_t variant, box_deviations *d,
                                  aur_error *error) {
    aur_radiosity *radiosity = NULL;
    box_solution before = {0}, all;
    aur_result result = keller_start(study->run, study->scene, forms[form].set, variant, BOUNCES,
                                     AUR_RADIOSITY_UNIFORM_ANGLE, &radiosity, error);
    if (result == AUR_OK && forms[form].skipped > 0)
        result = solve(radiosity, forms[form].skipped, &before, error);
    for (size_t n = 0; n < study->size_count && result == AUR_OK; ++n) {
        result = solve(radiosity, before.paths + keller_sizes[n], &all, error);
        if (result == AUR_OK)
            deviate(&before, &all, &d->squares[0][n][variant], &d->squares[1][n][variant]);
    }
    aur_radiosity_destroy(radiosity);
    return result;
}

static aur_result measure(const box_study *study, size_t form, box_deviations *d, aur_error *error) {
    enum { CELLS = sizeof *d / sizeof(double) };
    char key[120];
    double values[CELLS] = {0.0};
    snprintf(key, sizeof key, "%s %s", study->box, forms[form].name);
    aur_result result = AUR_OK;
    if (!lab_recall(study->run, key, CELLS, values)) {
        *d = (box_deviations){0};
        for (size_t v = 0; v < study->variants && result == AUR_OK; ++v)
            result = measure_variant(study, form, v, d, error);
        memcpy(values, d, sizeof *d);
        if (result == AUR_OK)
            result = lab_save(study->run, key, CELLS, values, error);
    }
    memcpy(d, values, sizeof *d);
    return result;
}

static void add_rows(box_study *study, size_t form, const box_deviations *d) {
    for (size_t table = 0; table < 2; ++table)
        for (size_t n = 0; n < study->size_count; ++n) {
            double least, greatest;
            const double rms = keller_rms(study->variants, d->squares[table][n], &least, &greatest);
            const double published =
                (table == 0 ? keller_table2 : keller_table3)(0, n, forms[form].published);
            study->within[form][table][n] = fmax(published / rms, rms / published) <= 1.5;
            lab_row(study->run, (const char *const[]){study->box, forms[form].name, NULL}, 6,
                    (const double[]){(double)(table + 2), (double)keller_sizes[n], rms, least, greatest,
                                     published});
        }
}

/* The number of published values of each table that a box and a form of Faure's sequence match within a
 * factor of 1.5. */
static void count_fits(const box_study *study, report_table *fits) {
    const bool quick = lab_run_options(study->run)->quick;
    for (size_t faure = 0; faure < FAURES; ++faure) {
        double counts[3] = {0.0};
        for (size_t f = 0; f < FORMS; ++f)
            for (size_t n = 0; n < study->size_count && (f == faure || f >= FAURES); ++n) {
                counts[0] += study->within[f][0][n];
                counts[1] += study->within[f][1][n];
                counts[2] += !quick || forms[f].quick;
            }
        if (quick && !forms[faure].quick)
            continue;
        lab_table_row(fits, (const char *const[]){study->box, forms[faure].name, NULL}, 3, counts);
        lab_note(study->run, "%s, %s: table 2 %.0f and table 3 %.0f of %.0f within a factor of 1.5",
                 study->box, forms[faure].name, counts[0], counts[1], counts[2]);
    }
}

static aur_result study_box(box_study *study, size_t box, report_table *fits, aur_error *error) {
    const bool quick = lab_run_options(study->run)->quick;
    const aur_definition lengths[] = {
        {"x", boxes[box].lengths[0]}, {"y", boxes[box].lengths[1]}, {"z", boxes[box].lengths[2]}};
    aur_scene *scene = NULL;
    aur_result result = lab_load_scene(study->run, "keller/box-analytic.xml", 3, lengths, &scene, error);
    study->scene = scene;
    study->box = boxes[box].name;
    memset(study->within, 0, sizeof study->within);
    for (size_t f = 0; f < FORMS && result == AUR_OK; ++f) {
        box_deviations d;
        if (quick && !forms[f].quick)
            continue;
        result = measure(study, f, &d, error);
        if (result == AUR_OK)
            add_rows(study, f, &d);
    }
    if (result == AUR_OK)
        count_fits(study, fits);
    aur_scene_destroy(scene);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    static const char *const of_fits[] = {"box", "faure", "table_2", "table_3", "of", NULL};
    const bool quick = lab_run_options(run)->quick;
    box_study study = {
        .run = run, .variants = quick ? 2 : KELLER_VARIANTS, .size_count = quick ? 2 : KELLER_SIZES};
    report_table *const fits = lab_table(run, "fits", of_fits);
    aur_result result = AUR_OK;
    for (size_t b = 0; b < BOXES && result == AUR_OK; ++b)
        result = study_box(&study, b, fits, error);
    return result;
}

static const report_plot plots[] = {
    {.name = "deviation",
     .title = "Deviation from the analytic solution in three boxes, and as published for the empty cube",
     .x = "N",
     .y = "rms",
     .low = "least",
     .high = "greatest",
     .series = "sequence",
     .panel = "box,table",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_keller_1994_boxes = {
    .name = "keller-1994-boxes",
    .reproduces = "Keller 1994, the empty cube of tables 2 and 3",
    .summary =
        "a cube, a long box and a flat one with four forms of Faure's sequence next to the published cube",
    .columns = columns,
    .measured = "rms",
    .low = "least",
    .high = "greatest",
    .published = "published",
    .factor = 1.5,
    .plots = plots,
    .takes_no_set = "its rows are hypotheses on published ones; keller-1994-table2 takes sets",
    .seconds = 120,
    .quick_seconds = 0.8,
    .run = run,
    .takes_no_scene = "its answer is known for closed boxes only",
};
