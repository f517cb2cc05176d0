#define _DEFAULT_SOURCE /* popen */
#include "adaptive_speed.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "quality.h"
#include "study.h"

/* CPU seconds. An attempt that is predicted to exceed the limit is not run; its time is extrapolated from the
 * last one. The limit for target errors is higher, because choosing the integrator dominates coarse images.
 */
static const double seconds_limit = 60.0, error_limit = 600.0;

enum { QUICK_SUBJECTS = 2, FIRST_SAMPLES = 16, COARSEST = 8, STEP = 4 };

typedef struct speed_row {
    const char *subject;
    double error;
    double by_recipe, by_target; /* required speedup over Aureole's path tracer; 0: reported only */
} speed_row;

/* Rows of a subject are consecutive, from coarse to fine. */
static const speed_row rows[] = {
    {"cornell-box", 0.01, 0.0, 0.0}, {"cornell-box", 0.005, 0.0, 0.0}, {"cornell-box", 0.002, 0.0, 0.0},
    {"glossy-box", 0.02, 0.0, 0.0},  {"glossy-box", 0.005, 0.0, 0.0},  {"room", 0.02, 0.0, 0.0},
    {"room", 0.005, 0.0, 0.0},       {"parade", 0.01, 0.0, 0.0},       {"statue", 0.01, 0.0, 0.0},
    {"sphere", 0.01, 0.0, 0.0},      {"plates", 0.01, 0.0, 0.0},       {"heavy-box", 0.005, 20.0, 12.0},
};

enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

/* The last image rendered towards a target error. CPU time is extrapolated as error^-power. */
typedef struct attempt {
    double target;                /* target error, or samples per pixel */
    double seconds;               /* CPU; 0: no image was rendered */
    double error, standard_error; /* the measured error and its standard error */
} attempt;

static double extrapolated(const attempt *last, double error, double requested, double power) {
    return last->seconds * pow(error / requested, power);
}

/* Halves the target error until the requested one is close enough or the time limit is reached. */
static bool adaptive(const bench_study *self, double requested, attempt *last) {
    if (last->seconds == 0.0)
        last->target = fmin(2.0 * COARSEST * requested, 0.5);
    while (last->target > requested) {
        const bool near =
            requested >= 0.5 * last->target ||
            (last->seconds > 0.0 && extrapolated(last, last->target, requested, 2.0) <= error_limit);
        const double next = near ? requested : 0.5 * last->target;
        if (last->seconds > 0.0 &&
            (self->options->quick || extrapolated(last, last->target, next, 2.0) > error_limit))
            break;
        bench_outcome found;
        if (!bench_study_measure(self, &(bench_request){.error = next}, 1, 1, &found))
            return false;
        *last = (attempt){next, found.seconds, found.error, found.standard_error};
    }
    return true;
}

/* Multiplies the samples until the error or the time limit is reached. */
static bool trace(const bench_study *self, double requested, attempt *last) {
    while (last->seconds == 0.0 || last->error > requested) {
        double factor = 1.0;
        if (last->seconds > 0.0)
            factor = fmin(STEP, 1.1 * bench_samples_for(last->error, requested));
        if (factor > 1.0 && (self->options->quick || factor * last->seconds > seconds_limit))
            break;
        const double samples = last->seconds > 0.0 ? ceil(factor * last->target) : FIRST_SAMPLES;
        const bench_request request = {.integrator = self->subject->path, .samples = (size_t)samples};
        bench_outcome found;
        if (!bench_study_measure(self, &request, 1, 1, &found))
            return false;
        *last = (attempt){samples, found.seconds, found.error, found.standard_error};
    }
    return true;
}

static bool follow(const bench_study *self, double requested, attempt *found) {
    *found = (attempt){.seconds = 0.0};
    for (size_t i = 0; i < bench_recipe_count; ++i) {
        const bench_recipe *const recipe = &bench_recipes[i];
        if (strcmp(recipe->subject, self->subject->name) != 0 || recipe->error != requested)
            continue;
        const bench_request request = {.integrator = recipe->integrator, .samples = recipe->samples};
        bench_outcome outcome;
        if (!bench_study_measure(self, &request, 1, 1, &outcome))
            return false;
        *found = (attempt){requested, outcome.seconds, outcome.error, outcome.standard_error};
    }
    return true;
}

static void compare(const speed_row *row, const char *what, double required, double path, double seconds,
                    bench_figures *figures) {
    bench_figures_add(figures, required > 0.0 ? BENCH_AT_LEAST : BENCH_NOTED, required, path / seconds, "",
                      "%s, error %.4g: path / %s", row->subject, row->error, what);
}

static void print_cell(const attempt *found, double requested, double seconds) {
    if (found->seconds > 0.0)
        printf(" %c%-8.3g %8.5f +-%-7.5f", found->error > 1.05 * requested ? '~' : ' ', seconds, found->error,
               found->standard_error);
    else
        printf(" %-9s %18s", "none", "");
}

static bool study_row(const bench_study *self, const speed_row *row, attempt *converged, attempt *traced,
                      bench_figures *figures) {
    attempt gathered;
    const double relative = row->error * self->mean / self->light;
    if (!follow(self, row->error, &gathered) || !adaptive(self, relative, converged) ||
        !trace(self, row->error, traced))
        return false;
    const double recipe = extrapolated(&gathered, fmax(gathered.error, row->error), row->error, 2.0);
    const double automatic = extrapolated(converged, converged->target, relative, 2.0);
    const double path = traced->seconds * bench_samples_for(traced->error, row->error);
    printf("  %-12s %-6.4g", row->subject, row->error);
    print_cell(&gathered, row->error, recipe);
    print_cell(converged, row->error, automatic);
    print_cell(traced, row->error, path);
    printf("\n");
    fflush(stdout);
    /* Without a recipe the row of recipes shows `--error`. */
    const bool by_hand = gathered.seconds > 0.0;
    compare(row, by_hand ? "recipe" : "recipe, which is --error", row->by_recipe, path,
            by_hand ? recipe : automatic, figures);
    compare(row, "--error", row->by_target, path, automatic, figures);
    return true;
}

/* Halves the target error until the denoised image has a relative error of `requested`; stores the smallest
 * error in `least`, which starts at infinity. Ends when only the denoiser's error is left or the next image
 * would take too long. */
static bool denoise_ours(const bench_study *self, double requested, attempt *least) {
    double spent = 0.0;
    for (double target = 0.16; least->error > requested; target *= 0.5) {
        bench_outcome found;
        if (!bench_study_measure(self, &(bench_request){.error = target, .denoised = true}, 1, 1, &found))
            return false;
        const double error = found.error * self->mean / self->light;
        const double standard_error = found.standard_error * self->mean / self->light;
        printf("  %-12s %g %% target, then denoised: error %.2f +- %.2f %%, %.3g s\n", self->subject->name,
               100.0 * target, 100.0 * error, 100.0 * standard_error, found.seconds);
        fflush(stdout);
        spent += found.seconds;
        const bool better = error < 0.9 * least->error;
        if (error < least->error)
            *least = (attempt){target, found.seconds, error, standard_error};
        if (!better || 4.0 * found.seconds + spent > seconds_limit)
            break;
    }
    return true;
}

/* The same for Mitsuba, with increasing sample counts. Without Mitsuba `least` is unchanged. */
static bool denoise_peer(const bench_study *self, double requested, attempt *least) {
    const char *const python = getenv("AUREOLE_PEERS_PYTHON");
    if (python == NULL)
        return true;
    char references[2][BENCH_STUDY_PATH], command[3 * BENCH_STUDY_PATH], line[512];
    for (size_t k = 0; k < 2; ++k)
        bench_study_reference_path(self, k, sizeof references[k], references[k]);
    const int used = snprintf(command, sizeof command,
                              "'%s' '" AUR_SOURCE_DIR "/bench/peers/denoised.py' %s %zux%zu '%s' '%s' %g %g",
                              python, self->subject->name, self->width, self->height, references[0],
                              references[1], requested, seconds_limit);
    FILE *const pipe = used < (int)sizeof command ? popen(command, "r") : NULL;
    if (pipe == NULL)
        return bench_fail("%s cannot be run", python);
    for (attempt found; fgets(line, sizeof line, pipe) != NULL;) {
        if (sscanf(line, "%lf %lf %lf", &found.target, &found.seconds, &found.error) != 3)
            continue;
        printf("  %-12s Mitsuba, %g samples, then denoised: error %.2f %%, %.3g s\n", self->subject->name,
               found.target, 100.0 * found.error, found.seconds);
        if (found.error < least->error)
            *least = found;
    }
    return pclose(pipe) == 0 || bench_fail("%s failed", command);
}

/* The speedup is reported only when both reach the error; otherwise only the smallest errors are. */
static bool denoise(const bench_study *self, bench_figures *figures) {
    const double requested = 0.01, times = 4.0;
    attempt ours = {.error = INFINITY}, theirs = ours;
    if (!denoise_ours(self, requested, &ours) || !denoise_peer(self, requested, &theirs))
        return false;
    const char *const name = self->subject->name;
    bench_figures_add(figures, BENCH_AT_MOST, requested, ours.error, "", "%s, denoised: least RMSE / mean",
                      name);
    if (isfinite(theirs.error))
        bench_figures_add(figures, BENCH_NOTED, 0.0, theirs.error, "",
                          "%s, denoised: least RMSE / mean of Mitsuba", name);
    if (ours.error <= requested && theirs.error <= requested)
        bench_figures_add(figures, BENCH_AT_LEAST, times, theirs.seconds / ours.seconds, "",
                          "%s, denoised, error %g: Mitsuba / --error", name, requested);
    return true;
}

static bool study_subject(const bench_options *options, const bench_subject *subject,
                          bench_figures *figures) {
    bench_study self;
    bool skipped;
    size_t first = 0, count = 0;
    while (first < ROW_COUNT && strcmp(rows[first].subject, subject->name) != 0)
        ++first;
    while (first + count < ROW_COUNT && strcmp(rows[first + count].subject, subject->name) == 0)
        ++count;
    attempt converged = {.seconds = 0.0}, traced = converged;
    bool good = bench_study_open(&self, options, subject, &skipped);
    if (good && !skipped) {
        for (size_t i = 0; i < (options->quick ? 1 : count) && good; ++i)
            good = study_row(&self, &rows[first + i], &converged, &traced, figures);
        if (good && getenv("AUREOLE_OIDN") != NULL && !options->quick && subject->scene[0] != '\0')
            good = denoise(&self, figures);
    }
    bench_study_close(&self);
    return good;
}

bool bench_adaptive_speed(const bench_options *options, bench_figures *figures) {
    printf("  CPU seconds of one thread and the measured error +- its standard error; ~: extrapolated by the "
           "power law from the last image, whose error is printed\n  %-12s %-6s %-28s "
           "%-28s %-28s\n",
           "", "error", " by recipe", " by --error", " path");
    const size_t count = options->quick ? QUICK_SUBJECTS : bench_subject_count;
    for (size_t i = 0; i < count; ++i)
        if ((options->only == NULL || strstr(bench_subjects[i].name, options->only) != NULL) &&
            !study_subject(options, &bench_subjects[i], figures))
            return false;
    return true;
}
