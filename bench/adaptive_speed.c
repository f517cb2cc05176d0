#define _DEFAULT_SOURCE /* popen */
#include "adaptive_speed.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "quality.h"
#include "study.h"

/* An attempt that is expected to take longer is not made: the law of the last one tells its seconds. What is
 * asked for goes further, as much of what a coarse image takes goes into the choice of the integrator. */
static const double seconds_limit = 60.0, error_limit = 600.0;

enum { QUICK_SUBJECTS = 2, FIRST_SAMPLES = 16, COARSEST = 8, STEP = 4 };

typedef struct speed_row {
    const char *subject;
    double error;
    double by_recipe, by_target; /* at least so many times the best peer's speed is asked */
} speed_row;

/* Those of a subject follow each other, from coarse to fine. The heavy box is beside our own path. */
static const speed_row rows[] = {
    {"cornell-box", 0.01, 40.0, 25.0},   {"cornell-box", 0.005, 80.0, 50.0},
    {"cornell-box", 0.002, 100.0, 65.0}, {"glossy-box", 0.02, 12.0, 8.0},
    {"glossy-box", 0.005, 8.0, 5.0},     {"room", 0.02, 20.0, 10.0},
    {"room", 0.005, 40.0, 20.0},         {"parade", 0.01, 8.0, 5.0},
    {"statue", 0.01, 8.0, 5.0},          {"sphere", 0.01, 8.0, 5.0},
    {"plates", 0.01, 8.0, 5.0},          {"heavy-box", 0.005, 20.0, 12.0},
};

enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

/* The last image on the way to an error, and how its seconds go on: as error^-power. */
typedef struct attempt {
    double asked;            /* error, or samples per pixel */
    double seconds;          /* CPU; 0: none was made */
    double error, uncertain; /* the true one, and its standard error */
} attempt;

typedef struct peer {
    double seconds;
    char name[48];
} peer;

static double brought_to(const attempt *last, double error, double wanted, double power) {
    return last->seconds * pow(error / wanted, power);
}

/* Asks for half the error again and again, until the one that is wanted is near enough or the limit is. */
static bool adaptive(const bench_study *self, double wanted, attempt *last) {
    if (last->seconds == 0.0)
        last->asked = fmin(2.0 * COARSEST * wanted, 0.5);
    while (last->asked > wanted) {
        const bool near = wanted >= 0.5 * last->asked ||
                          (last->seconds > 0.0 && brought_to(last, last->asked, wanted, 2.0) <= error_limit);
        const double next = near ? wanted : 0.5 * last->asked;
        if (last->seconds > 0.0 &&
            (self->options->quick || brought_to(last, last->asked, next, 2.0) > error_limit))
            break;
        bench_outcome found;
        if (!bench_study_measure(self, &(bench_request){.error = next}, 1, 1, &found))
            return false;
        *last = (attempt){next, found.seconds, found.error, found.uncertain};
    }
    return true;
}

/* More samples again and again, until the error is there or the limit. */
static bool trace(const bench_study *self, double wanted, attempt *last) {
    while (last->seconds == 0.0 || last->error > wanted) {
        double factor = 1.0;
        if (last->seconds > 0.0)
            factor = fmin(STEP, 1.1 * bench_samples_for(last->error, wanted));
        if (factor > 1.0 && (self->options->quick || factor * last->seconds > seconds_limit))
            break;
        const double samples = last->seconds > 0.0 ? ceil(factor * last->asked) : FIRST_SAMPLES;
        const bench_request request = {.integrator = self->subject->path, .samples = (size_t)samples};
        bench_outcome found;
        if (!bench_study_measure(self, &request, 1, 1, &found))
            return false;
        *last = (attempt){samples, found.seconds, found.error, found.uncertain};
    }
    return true;
}

static bool follow(const bench_study *self, double wanted, attempt *found) {
    *found = (attempt){.seconds = 0.0};
    for (size_t i = 0; i < bench_recipe_count; ++i) {
        const bench_recipe *const recipe = &bench_recipes[i];
        if (strcmp(recipe->subject, self->subject->name) != 0 || recipe->error != wanted)
            continue;
        const bench_request request = {.integrator = recipe->integrator, .samples = recipe->samples};
        bench_outcome outcome;
        if (!bench_study_measure(self, &request, 1, 1, &outcome))
            return false;
        *found = (attempt){wanted, outcome.seconds, outcome.error, outcome.uncertain};
    }
    return true;
}

/* The fastest of the other renderers to each error, by their own laws. Of those whose image is another one,
 * such as of a light that they were not told, nothing is taken. */
static bool ask_peers(const bench_study *self, size_t count, const speed_row *wanted, peer *found) {
    const char *const python = getenv("AUREOLE_PEERS_PYTHON");
    for (size_t i = 0; i < count; ++i)
        found[i] = (peer){INFINITY, ""};
    if (python == NULL || self->options->quick || self->subject->scene[0] == '\0')
        return true;
    char command[4096];
    int used = snprintf(command, sizeof command,
                        "'%s' '" AUR_SOURCE_DIR
                        "/bench/peers/time_to_quality.py' aureole --peers %s --size %zux%zu --errors ",
                        python, self->subject->name, self->width, self->height);
    for (size_t i = 0; i < count && used < (int)sizeof command; ++i)
        used += snprintf(command + used, sizeof command - (size_t)used, "%s%.9g", i == 0 ? "" : ",",
                         wanted[i].error * self->mean / self->light);
    FILE *const pipe = used < (int)sizeof command ? popen(command, "r") : NULL;
    if (pipe == NULL)
        return bench_fail("%s cannot be run", python);
    char line[512], name[48];
    double mean;
    for (int read; fgets(line, sizeof line, pipe) != NULL;) {
        if (sscanf(line, "%47[^|]| %lf%n", name, &mean, &read) != 2) {
            printf("    %s", line);
            continue;
        }
        const bool alike = fabs(mean / self->light - 1.0) < 0.05;
        printf("    %s: mean %.4g of %.4g%s\n", name, mean, self->light, alike ? "" : ", another image");
        const char *rest = line + read;
        for (size_t i = 0; i < count && alike; ++i) {
            char *end;
            const double seconds = strtod(rest, &end);
            if (end == rest)
                break;
            rest = end;
            if (seconds < found[i].seconds) {
                found[i].seconds = seconds;
                snprintf(found[i].name, sizeof found[i].name, "%s", name);
            }
        }
    }
    return pclose(pipe) == 0 || bench_fail("%s failed", command);
}

/* Ours reached the error where theirs is a law's: what does not reach it has no speed. */
static void compare(const speed_row *row, const char *what, double asked, double limit, double seconds,
                    bench_figures *figures) {
    bench_figures_add(figures, isfinite(limit) ? BENCH_AT_LEAST : BENCH_NOTED, asked,
                      isfinite(limit) ? limit / seconds : 0.0, "", "%s, error %.4g: %s / %s%s", row->subject,
                      row->error, strcmp(row->subject, "heavy-box") == 0 ? "path" : "best peer", what,
                      isfinite(limit) ? "" : ": no peer is there");
}

static void print_cell(const attempt *found, double wanted, double seconds) {
    if (found->seconds > 0.0)
        printf(" %c%-8.3g %8.5f +-%-7.5f", found->error > 1.05 * wanted ? '~' : ' ', seconds, found->error,
               found->uncertain);
    else
        printf(" %-9s %18s", "none", "");
}

static bool study_row(const bench_study *self, const speed_row *row, attempt *asked, attempt *traced,
                      const peer *best, bench_figures *figures) {
    attempt gathered;
    const double relative = row->error * self->mean / self->light;
    if (!follow(self, row->error, &gathered) || !adaptive(self, relative, asked) ||
        !trace(self, row->error, traced))
        return false;
    const double recipe = brought_to(&gathered, fmax(gathered.error, row->error), row->error, 2.0);
    const double own = brought_to(asked, asked->asked, relative, 2.0);
    const double path = traced->seconds * bench_samples_for(traced->error, row->error);
    printf("  %-12s %-6.4g", row->subject, row->error);
    print_cell(&gathered, row->error, recipe);
    print_cell(asked, row->error, own);
    print_cell(traced, row->error, path);
    if (isfinite(best->seconds))
        printf(" %9.4g %s", best->seconds, best->name);
    printf("\n");
    fflush(stdout);
    const double limit = self->subject->scene[0] == '\0' ? path : best->seconds;
    /* Where no recipe was found that is faster than asking, experts ask too. */
    const bool by_hand = gathered.seconds > 0.0;
    compare(row, by_hand ? "recipe" : "recipe, which is --error", row->by_recipe, limit,
            by_hand ? recipe : own, figures);
    compare(row, "--error", row->by_target, limit, own, figures);
    return true;
}

/* Half the error is asked again and again, until the denoised image has `wanted` over the mean; `least` is
 * of an infinite error before. It ends where the filter's own error is all that is left, or where the next
 * would take too long. */
static bool denoise_own(const bench_study *self, double wanted, attempt *least) {
    double spent = 0.0;
    for (double asked = 0.16; least->error > wanted; asked *= 0.5) {
        bench_outcome found;
        if (!bench_study_measure(self, &(bench_request){.error = asked, .denoised = true}, 1, 1, &found))
            return false;
        const double error = found.error * self->mean / self->light;
        const double uncertain = found.uncertain * self->mean / self->light;
        printf("  %-12s %g %% asked, then denoised: error %.2f +- %.2f %%, %.3g s\n", self->subject->name,
               100.0 * asked, 100.0 * error, 100.0 * uncertain, found.seconds);
        fflush(stdout);
        spent += found.seconds;
        const bool better = error < 0.9 * least->error;
        if (error < least->error)
            *least = (attempt){asked, found.seconds, error, uncertain};
        if (!better || 4.0 * found.seconds + spent > seconds_limit)
            break;
    }
    return true;
}

/* The same of Mitsuba's images, by more and more samples. Without it `least` stays as it is. */
static bool denoise_peer(const bench_study *self, double wanted, attempt *least) {
    const char *const python = getenv("AUREOLE_PEERS_PYTHON");
    if (python == NULL)
        return true;
    char truths[2][BENCH_STUDY_PATH], command[3 * BENCH_STUDY_PATH], line[512];
    for (size_t k = 0; k < 2; ++k)
        bench_study_truth_path(self, k, sizeof truths[k], truths[k]);
    const int used =
        snprintf(command, sizeof command,
                 "'%s' '" AUR_SOURCE_DIR "/bench/peers/denoised.py' %s %zux%zu '%s' '%s' %g %g", python,
                 self->subject->name, self->width, self->height, truths[0], truths[1], wanted, seconds_limit);
    FILE *const pipe = used < (int)sizeof command ? popen(command, "r") : NULL;
    if (pipe == NULL)
        return bench_fail("%s cannot be run", python);
    for (attempt found; fgets(line, sizeof line, pipe) != NULL;) {
        if (sscanf(line, "%lf %lf %lf", &found.asked, &found.seconds, &found.error) != 3)
            continue;
        printf("  %-12s Mitsuba, %g samples, then denoised: error %.2f %%, %.3g s\n", self->subject->name,
               found.asked, 100.0 * found.error, found.seconds);
        if (found.error < least->error)
            *least = found;
    }
    return pclose(pipe) == 0 || bench_fail("%s failed", command);
}

/* Who does not come to the error has no speed: the least error is all that can be said. */
static bool denoise(const bench_study *self, bench_figures *figures) {
    const double wanted = 0.01, times = 4.0;
    attempt own = {.error = INFINITY}, theirs = own;
    if (!denoise_own(self, wanted, &own) || !denoise_peer(self, wanted, &theirs))
        return false;
    const char *const name = self->subject->name;
    bench_figures_add(figures, BENCH_AT_MOST, wanted, own.error, "", "%s, denoised: least RMSE / mean", name);
    if (isfinite(theirs.error))
        bench_figures_add(figures, BENCH_NOTED, 0.0, theirs.error, "",
                          "%s, denoised: least RMSE / mean of Mitsuba", name);
    if (own.error <= wanted && theirs.error <= wanted)
        bench_figures_add(figures, BENCH_AT_LEAST, times, theirs.seconds / own.seconds, "",
                          "%s, denoised, error %g: Mitsuba / --error", name, wanted);
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
    peer best[ROW_COUNT];
    attempt asked = {.seconds = 0.0}, traced = asked;
    bool good = bench_study_open(&self, options, subject, &skipped);
    if (good && !skipped) {
        good = ask_peers(&self, count, rows + first, best);
        for (size_t i = 0; i < (options->quick ? 1 : count) && good; ++i)
            good = study_row(&self, &rows[first + i], &asked, &traced, &best[i], figures);
        if (good && getenv("AUREOLE_OIDN") != NULL && !options->quick && subject->scene[0] != '\0')
            good = denoise(&self, figures);
    }
    bench_study_close(&self);
    return good;
}

bool bench_adaptive_speed(const bench_options *options, bench_figures *figures) {
    printf("  CPU seconds of one thread and the true error; ~: brought to the error by the law of the last "
           "picture, whose error is said, +- the standard error that it is known to\n  %-12s %-6s %-28s "
           "%-28s %-28s %s\n",
           "", "error", " by recipe", " by --error", " path", "best peer");
    const size_t count = options->quick ? QUICK_SUBJECTS : bench_subject_count;
    for (size_t i = 0; i < count; ++i)
        if ((options->only == NULL || strstr(bench_subjects[i].name, options->only) != NULL) &&
            !study_subject(options, &bench_subjects[i], figures))
            return false;
    return true;
}
