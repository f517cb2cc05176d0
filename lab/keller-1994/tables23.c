/* Tables 2 and 3 of Keller 1994: the deviation of solutions from the analytic one, unweighted and weighted by
 * area. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study.h"

enum { SIZES = KELLER_SIZES };

static const char *const columns[] = {"scene", "N",        "sequence",  "rms",
                                      "least", "greatest", "published", NULL};

/* Mean square deviations of all variants. */
typedef struct deviations {
    size_t variants, size_count;
    double plain[SIZES][KELLER_VARIANTS], weighted[SIZES][KELLER_VARIANTS];
    uint64_t lost; /* paths, over all variants */
} deviations;

typedef struct walk {
    size_t bounces;
    aur_radiosity_directions directions;
} walk;

/* The paper's form. */
static const walk published_walk = {29, AUR_RADIOSITY_UNIFORM_ANGLE};

static aur_result measure_variant(lab_run *run, const aur_scene *scene, const keller_set *set, size_t variant,
                                  const walk *w, deviations *d, aur_error *error) {
    const double answer = 0.5 - exp2(-(double)w->bounces - 3.0);
    aur_radiosity *radiosity = NULL;
    aur_result result = AUR_OK;
    aur_radiosity_description description = {.size = sizeof description};
    for (size_t n = 0; n < d->size_count && result == AUR_OK; ++n) {
        if (radiosity == NULL)
            result =
                keller_start(run, scene, set->name, variant, w->bounces, w->directions, &radiosity, error);
        if (result == AUR_OK)
            result = aur_radiosity_trace(radiosity, keller_sizes[n], error);
        if (result == AUR_OK)
            result =
                keller_deviation(radiosity, answer, &d->plain[n][variant], &d->weighted[n][variant], error);
        if (result == AUR_OK && (n + 1 == d->size_count || !set->extensible)) {
            aur_radiosity_get_description(radiosity, &description, error);
            d->lost += description.lost + description.behind;
            aur_radiosity_destroy(radiosity);
            radiosity = NULL;
        }
    }
    aur_radiosity_destroy(radiosity);
    return result;
}

static aur_result measure(lab_run *run, const char *name, const aur_scene *scene, const keller_set *set,
                          const walk *w, deviations *d, aur_error *error) {
    enum { CELLS = SIZES * KELLER_VARIANTS };
    double values[2 * CELLS + 1];
    char key[160];
    aur_result result = AUR_OK;
    snprintf(key, sizeof key, "%s %.100s %d %zu", name, set->name, (int)w->directions, w->bounces);
    if (!lab_recall(run, key, 2 * CELLS + 1, values)) {
        d->lost = 0;
        for (size_t v = 0; v < d->variants && result == AUR_OK; ++v)
            result = measure_variant(run, scene, set, v, w, d, error);
        memcpy(values, d->plain, sizeof d->plain);
        memcpy(values + CELLS, d->weighted, sizeof d->weighted);
        values[2 * CELLS] = (double)d->lost;
        if (result == AUR_OK)
            result = lab_save(run, key, 2 * CELLS + 1, values, error);
    }
    memcpy(d->plain, values, sizeof d->plain);
    memcpy(d->weighted, values + CELLS, sizeof d->weighted);
    d->lost = (uint64_t)values[2 * CELLS];
    return result;
}

static void add_rows(lab_run *run, bool weighted, size_t scene, size_t set, const char *name,
                     const deviations *d) {
    for (size_t n = 0; n < d->size_count; ++n) {
        double least, greatest;
        const double value =
            keller_rms(d->variants, weighted ? d->weighted[n] : d->plain[n], &least, &greatest);
        const double paper = set >= KELLER_PUBLISHED_SETS ? NAN
                             : weighted                   ? keller_table3(scene, n, set)
                                                          : keller_table2(scene, n, set);
        lab_text(run, keller_scene_at(scene)->name);
        lab_number(run, (double)keller_sizes[n]);
        lab_text(run, name);
        lab_number(run, value);
        lab_number(run, least);
        lab_number(run, greatest);
        keller_published(run, paper);
    }
}

/* Delta_aw sqrt N of independent points, pooled over variants and N. If a path never returns to a triangle,
 * it follows from the random walk: hits in a triangle are then independent, and with q the mean square of the
 * factor on the power per flight (pi^2/8 or 1) it is the root of (1 + q/4 + (q/4)^2 + ...) q/64, M + 1 terms.
 * Paths of two flights cannot return: the others show the contribution of returning paths. */
static aur_result note_independent(lab_run *run, const aur_scene *scene, const char *name,
                                   const deviations *like, aur_error *error) {
    static const keller_set independent = {"random", true};
    static const walk walks[] = {{29, AUR_RADIOSITY_UNIFORM_ANGLE},
                                 {29, AUR_RADIOSITY_COSINE},
                                 {1, AUR_RADIOSITY_UNIFORM_ANGLE},
                                 {1, AUR_RADIOSITY_COSINE}};
    double found[4] = {0}, expected[4];
    aur_result result = AUR_OK;
    for (int k = 0; k < 4 && result == AUR_OK; ++k) {
        deviations d = {.variants = like->variants, .size_count = like->size_count > 1 ? 2 : 1};
        result = measure(run, name, scene, &independent, &walks[k], &d, error);
        for (size_t n = 0; n < d.size_count; ++n)
            for (size_t v = 0; v < d.variants; ++v)
                found[k] += d.weighted[n][v] * (double)keller_sizes[n] / (double)(d.variants * d.size_count);
        const double pi = 3.14159265358979323846;
        const double q = walks[k].directions == AUR_RADIOSITY_COSINE ? 1.0 : pi * pi / 8.0;
        expected[k] =
            sqrt(q / 64.0 * (1.0 - pow(0.25 * q, (double)walks[k].bounces + 1.0)) / (1.0 - 0.25 * q));
    }
    lab_note(run,
             "%s: Delta_aw sqrt N of independent points %.4f (uniform angles; %.3f if no path came back to a "
             "triangle), "
             "%.4f (cosine; %.3f); of two flights, which cannot come back, %.4f (%.3f) and %.4f (%.3f)",
             name, sqrt(found[0]), expected[0], sqrt(found[1]), expected[1], sqrt(found[2]), expected[2],
             sqrt(found[3]), expected[3]);
    return result;
}

/* The unweighted deviation relative to the weighted one: sqrt K for equal triangles. */
static aur_result note_ratio(lab_run *run, const char *path, const char *what, aur_error *error) {
    static const keller_set sobol = {"sobol", true};
    aur_scene *scene = NULL;
    aur_result result = lab_load_scene(run, path, 0, NULL, &scene, error);
    deviations d = {.variants = 4, .size_count = 2};
    if (result == AUR_OK)
        result = measure(run, path, scene, &sobol, &published_walk, &d, error);
    double least, greatest;
    if (result == AUR_OK)
        lab_note(run, "Delta_a / Delta_aw of %s: %.4g", what,
                 keller_rms(d.variants, d.plain[1], &least, &greatest) /
                     keller_rms(d.variants, d.weighted[1], &least, &greatest));
    aur_scene_destroy(scene);
    return result;
}

static aur_result run_table(lab_run *run, bool weighted, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    aur_result result = AUR_OK;
    for (size_t s = 0; s < KELLER_SCENES && result == AUR_OK; ++s) {
        deviations d = {.variants = options->quick ? 4 : KELLER_VARIANTS,
                        .size_count = options->quick ? 2 : SIZES};
        uint64_t lost = 0;
        if (options->quick && s != 0 && s != 2)
            continue;
        aur_scene *scene = NULL;
        result = lab_load_scene(run, keller_scene_at(s)->analytic, 0, NULL, &scene, error);
        keller_set set;
        for (size_t k = 0; result == AUR_OK && keller_set_at(run, k, &set); ++k) {
            if (options->quick && k != 0 && k != 2 && k != 4 && k < KELLER_SETS)
                continue;
            const aur_result measured =
                measure(run, keller_scene_at(s)->name, scene, &set, &published_walk, &d, error);
            lost += d.lost;
            if (measured == AUR_OK)
                add_rows(run, weighted, s, k, set.name, &d);
            result = lab_forgive(run, set.name, measured, error);
        }
        if (result == AUR_OK)
            lab_note(run, "%s: %llu paths lost or ended on a back, of all variants and sets",
                     keller_scene_at(s)->name, (unsigned long long)lost);
        if (result == AUR_OK && weighted)
            result = note_independent(run, scene, keller_scene_at(s)->name, &d, error);
        aur_scene_destroy(scene);
    }
    if (result == AUR_OK && !weighted)
        result = note_ratio(run, "keller/cube-analytic.xml",
                            "the cube (sqrt 12 = 3.464; the published tables have 7.9 to 11.0)", error);
    if (result == AUR_OK && !weighted)
        result = note_ratio(run, "keller/corridor-analytic.xml",
                            "a box of 1 x 1 x 26, which fits the published ratios", error);
    lab_note(run, "rms over variants (order of the lights, turns of the frames, seeds of random sets); one "
                  "run scatters by 20 to "
                  "40 %%; uniform angles, 29 bounces");
    return result;
}

static aur_result run_plain(lab_run *run, aur_error *error) {
    return run_table(run, false, error);
}

static aur_result run_weighted(lab_run *run, aur_error *error) {
    return run_table(run, true, error);
}

static const report_plot plots[] = {
    {.name = "deviation",
     .title = "Deviation from the analytic solution against the number of paths",
     .x = "N",
     .y = "rms",
     .low = "least",
     .high = "greatest",
     .series = "sequence",
     .panel = "scene",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_keller_1994_table2 = {
    .name = "keller-1994-table2",
    .reproduces = "Keller 1994, table 2",
    .summary = "mean square deviation from the analytic solution",
    .columns = columns,
    .measured = "rms",
    .low = "least",
    .high = "greatest",
    .published = "published",
    .factor = 1.5,
    .plots = plots,
    .seconds = 170,
    .quick_seconds = 1,
    .run = run_plain,
    .takes_no_scene = "its rows are Keller's scenes",
};

const lab_experiment lab_keller_1994_table3 = {
    .name = "keller-1994-table3",
    .reproduces = "Keller 1994, table 3",
    .summary = "the same weighted by area",
    .columns = columns,
    .measured = "rms",
    .low = "least",
    .high = "greatest",
    .published = "published",
    .factor = 1.5,
    .plots = plots,
    .seconds = 180,
    .quick_seconds = 1,
    .run = run_weighted,
    .takes_no_scene = "its rows are Keller's scenes",
};
