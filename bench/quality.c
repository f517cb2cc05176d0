#include "quality.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study.h"

enum {
    REPEATS = 5,
    SLOW_REPEATS = 2,
    PATH_ATTEMPTS = 3,
    PATH_SAMPLES_LIMIT = 2048,
    BLOCK = 8,
    GATHERED = 4 /* subjects rendered with final gathering: the boxes and the room */
};

static bool measure(const bench_study *self, const char *integrator, size_t samples, size_t seeds,
                    size_t block, bench_outcome *found) {
    return bench_study_measure(self, &(bench_request){.integrator = integrator, .samples = samples}, seeds,
                               block, found);
}

static void print(const char *integrator, size_t samples, double target, const bench_outcome *found) {
    printf("  %-9.4g error %8.5f   %8.3f CPU seconds   %s --spp %zu\n", target, found->error, found->seconds,
           integrator, samples);
    fflush(stdout);
}

double bench_samples_for(double error, double target) {
    return pow(error / target, 1.6);
}

/* Path tracing to the same error. The sample count follows from the previous attempt by the power law above;
 * the remaining difference is corrected by the same power law. */
static bool trace_path(const bench_study *self, double target, size_t *samples, bench_outcome *found) {
    for (size_t attempt = 0; attempt < PATH_ATTEMPTS; ++attempt) {
        if (!measure(self, self->subject->path, *samples, 1, 1, found))
            return false;
        const double factor = bench_samples_for(found->error, target);
        if (factor <= 1.0 && factor > 0.8)
            break;
        if (attempt + 1 == PATH_ATTEMPTS || self->options->quick || *samples == PATH_SAMPLES_LIMIT)
            break;
        const size_t next = (size_t)ceil(1.02 * factor * (double)*samples);
        *samples = next == 0 ? 1 : next < PATH_SAMPLES_LIMIT ? next : PATH_SAMPLES_LIMIT;
    }
    print(self->subject->path, *samples, target, found);
    if (found->error > target)
        found->seconds *= bench_samples_for(found->error, target);
    return true;
}

/* Target CPU seconds of the path tracer on the diffuse boxes. */
static double path_required(const char *subject, double target) {
    if (strcmp(subject, "cornell-box") != 0)
        return 0.0;
    return target >= 0.01 ? 1.0 : target >= 0.005 ? 3.5 : 20.0;
}

/* Target speedup of final gathering over path tracing; 0: no target. */
static double ratio_required(const char *subject, double target) {
    if (target != 0.005)
        return 0.0;
    return strcmp(subject, "cornell-box") == 0 ? 10.0 : strcmp(subject, "heavy-box") == 0 ? 5.0 : 0.0;
}

static void add(bench_figures *figures, bench_relation relation, double required, double measured,
                const char *unit, const char *name, double target, const char *what) {
    bench_figures_add(figures, required > 0.0 ? relation : BENCH_NOTED, required, measured, unit,
                      "7. %s, error %.4g: %s", name, target, what);
}

static bool follow_recipe(const bench_study *self, const bench_recipe *recipe, size_t *path_samples,
                          bench_figures *figures) {
    const char *const name = self->subject->name;
    bench_outcome gathered, traced;
    const size_t seeds = self->options->quick ? 1 : self->subject->relative ? SLOW_REPEATS : REPEATS;
    if (!measure(self, recipe->integrator, recipe->samples, seeds, 1, &gathered))
        return false;
    print(recipe->integrator, recipe->samples, recipe->error, &gathered);
    add(figures, BENCH_AT_MOST, recipe->error, gathered.error, "", name, recipe->error,
        recipe->required < 0.0 ? "bias floor" : "reached by finalgather");
    add(figures, BENCH_AT_MOST, recipe->required, gathered.seconds, "CPU s", name, recipe->error,
        "finalgather");
    if (recipe->required < 0.0)
        return true;
    if (!trace_path(self, recipe->error, path_samples, &traced))
        return false;
    add(figures, BENCH_AT_MOST, path_required(name, recipe->error), traced.seconds, "CPU s", name,
        recipe->error, "path");
    add(figures, BENCH_AT_LEAST, ratio_required(name, recipe->error), traced.seconds / gathered.seconds, "",
        name, recipe->error, "path / finalgather");
    return true;
}

/* The bias of the photon map: images with so many directions that other errors are negligible, compared by
 * means of 8 x 8 pixels, by the number of photons and of photons per texel. */
static bool measure_bias(const bench_study *self, bench_figures *figures) {
    static const size_t photons[] = {20000, 200000, 2000000}, texels[] = {4, 16, 64};
    const size_t many = self->options->quick ? 1 : 3, samples = self->options->quick ? 1 : 32;
    for (size_t i = 0; i < many; ++i)
        for (size_t k = 0; k < many; ++k) {
            char integrator[160];
            bench_outcome found;
            snprintf(integrator, sizeof integrator,
                     "finalgather:photons=%zu,photons_per_texel=%zu,diffuse_samples=256,glossy_samples=64,"
                     "edges=64",
                     photons[i], texels[k]);
            if (!measure(self, integrator, samples, 1, BLOCK, &found))
                return false;
            bench_figures_add(figures, BENCH_NOTED, 0.0, found.error, "",
                              "bias, %s: %zu photons, %zu a texel, 8 x 8 means", self->subject->name,
                              photons[i], texels[k]);
        }
    return true;
}

static bool study_subject(const bench_options *options, const bench_subject *subject,
                          bench_figures *figures) {
    bench_study self;
    bool skipped;
    bool good = bench_study_open(&self, options, subject, &skipped);
    if (good && !skipped) {
        size_t path_samples = options->quick ? 1 : 64;
        for (size_t i = 0; i < bench_recipe_count && good; ++i)
            if (strcmp(bench_recipes[i].subject, subject->name) == 0 &&
                (!options->quick || bench_recipes[i].error >= 0.005))
                good = follow_recipe(&self, &bench_recipes[i], &path_samples, figures);
        if (subject->scene[0] != 0)
            good = good && measure_bias(&self, figures);
    }
    bench_study_close(&self);
    return good;
}

bool bench_quality(const bench_options *options, bench_figures *figures) {
    const size_t count = options->quick ? 2 : GATHERED; /* a quick bench renders the two boxes only */
    for (size_t i = 0; i < count; ++i)
        if (!study_subject(options, &bench_subjects[i], figures))
            return false;
    return true;
}
