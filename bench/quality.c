#include "quality.h"

#include <aureole/image.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "child.h"
#include "heavy_box.h"

enum {
    REPEATS = 5,
    SLOW_REPEATS = 2,
    PATH_TRIALS = 3,
    PATH_MOST = 2048,
    PATH_CAPACITY = 8,
    HEAVY_TRIANGLES = 500000,
    WORDS = 26,
    BLOCK = 8
};

static const bench_subject subjects[] = {
    {.name = "cornell-box",
     .scene = "/../shared/scenes/cornell-box/scene.xml",
     .fallback = "/scenes/cornell-box/cornell-box.xml",
     .path = "path:interleaved=true,rr_depth=3",
     .width = 256,
     .height = 256,
     .reference_samples = 512},
    {.name = "heavy-box",
     .scene = "",
     .path = "path:interleaved=true,rr_depth=3",
     .width = 256,
     .height = 256,
     .reference_samples = 256},
    {.name = "glossy-box",
     .scene = "/scenes/cornell-box/figure.xml",
     .definition = "materials=rough",
     .path = "path:interleaved=true,rr_depth=4",
     .width = 256,
     .height = 256,
     .reference_samples = 4096,
     .relative = true},
    {.name = "room",
     .scene = "/scenes/room/room.xml",
     .definition = "materials=rough",
     .path = "path:interleaved=true,rr_depth=4",
     .width = 240,
     .height = 160,
     .reference_samples = 4096,
     .relative = true},
};

enum { SUBJECT_COUNT = sizeof subjects / sizeof subjects[0] };

/* One subject on its way. */
typedef struct study {
    const bench_options *options;
    const bench_subject *subject;
    char scene[4400], folder[4096];
    size_t width, height, reference_samples, repeats;
    aur_image *truth[2];
    double mean; /* of the truth, or 1: what errors are divided by */
} study;

typedef struct outcome {
    double seconds, error;
} outcome;

/* --- pictures */

static bool render(const study *self, const char *integrator, size_t samples, size_t seed, size_t threads,
                   const char *output, bench_child_cost *cost) {
    char numbers[5][32];
    snprintf(numbers[0], sizeof numbers[0], "resx=%zu", self->width);
    snprintf(numbers[1], sizeof numbers[1], "resy=%zu", self->height);
    snprintf(numbers[2], sizeof numbers[2], "%zu", samples);
    snprintf(numbers[3], sizeof numbers[3], "%zu", seed);
    snprintf(numbers[4], sizeof numbers[4], "%zu", threads);
    const char *words[WORDS] = {"render",   self->scene, "-q",       "--integrator", integrator, "--sampler",
                                "sobol",    "--filter",  "box",      "--spp",        numbers[2], "--seed",
                                numbers[3], "-t",        numbers[4], "-D",           numbers[0], "-D",
                                numbers[1], "-o",        output};
    if (self->subject->definition != NULL) {
        words[21] = "-D";
        words[22] = self->subject->definition;
    }
    return bench_run_child(words, cost);
}

static aur_image *read_image(const char *path) {
    aur_image *image = NULL;
    aur_error error;
    if (aur_image_read(path, &image, &error) != AUR_OK)
        bench_fail("%s: %s", path, error.message);
    return image;
}

static bool open_truth(study *self) {
    for (size_t k = 0; k < 2; ++k) {
        char path[4400];
        bench_child_cost cost;
        snprintf(path, sizeof path, "%s/%s-%zux%zu-%zu-%zu.pfm", self->folder, self->subject->name,
                 self->width, self->height, self->reference_samples, k + 1);
        if (access(path, R_OK) != 0) {
            char part[4500];
            snprintf(part, sizeof part, "%s.part.pfm", path);
            printf("  %s: a reference of %zu samples a pixel is rendered once\n", self->subject->name,
                   self->reference_samples);
            if (!render(self, "path", self->reference_samples, 1001 + k, self->options->threads, part, &cost))
                return false;
            if (rename(part, path) != 0)
                return bench_fail("%s cannot be written", path);
        }
        self->truth[k] = read_image(path);
        if (self->truth[k] == NULL)
            return false;
    }
    self->mean = 1.0;
    double means[2][4];
    aur_error error;
    for (size_t k = 0; k < 2 && self->subject->relative; ++k)
        if (aur_image_mean(self->truth[k], means[k], &error) != AUR_OK)
            return bench_fail("%s", error.message);
    if (self->subject->relative)
        self->mean = 0.5 * (means[0][3] + means[1][3]);
    return true;
}

/* The mean of (x - a)(x - b) over channels and means of block x block pixels; what does not fill a block is
 * left out. */
static double mean_square_error(const study *self, const aur_image *image, size_t block) {
    const size_t across = self->width / block, down = self->height / block;
    const float *const x = aur_image_data(image);
    const float *const a = aur_image_data(self->truth[0]), *const b = aur_image_data(self->truth[1]);
    double sum = 0.0;
    for (size_t i = 0; i < across * down * 3; ++i) {
        const size_t x0 = i / 3 % across * block, y0 = i / 3 / across * block;
        double to_a = 0.0, to_b = 0.0;
        for (size_t k = 0; k < block * block; ++k) {
            const size_t at = 3 * ((y0 + k / block) * self->width + x0 + k % block) + i % 3;
            to_a += (double)x[at] - (double)a[at];
            to_b += (double)x[at] - (double)b[at];
        }
        sum += to_a * to_b;
    }
    return sum / (double)(across * down * 3) / pow((double)block, 4.0);
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median of the times and root of the mean square error over the seeds 1 .. repeats, one thread. */
static bool measure(const study *self, const char *integrator, size_t samples, size_t repeats, size_t block,
                    outcome *found) {
    char output[4400];
    double seconds[REPEATS], square = 0.0;
    snprintf(output, sizeof output, "%s/picture-%ld.pfm", self->folder, (long)getpid());
    for (size_t k = 0; k < repeats; ++k) {
        bench_child_cost cost;
        if (!render(self, integrator, samples, 1 + k, 1, output, &cost))
            return false;
        aur_image *const image = read_image(output);
        unlink(output);
        if (image == NULL)
            return false;
        seconds[k] = cost.cpu_seconds;
        square += mean_square_error(self, image, block) / (double)repeats;
        aur_image_destroy(image);
    }
    qsort(seconds, repeats, sizeof *seconds, ascending);
    *found = (outcome){seconds[repeats / 2], sqrt(fmax(0.0, square)) / self->mean};
    return true;
}

/* --- one subject */

static void print(const char *integrator, size_t samples, double wanted, const outcome *found) {
    printf("  %-9.4g error %8.5f   %8.3f CPU seconds   %s --spp %zu\n", wanted, found->error, found->seconds,
           integrator, samples);
    fflush(stdout);
}

/* Sobol numbers: the root of the mean square error falls as samples^-.62 on the diffuse boxes. */
static double samples_for(double error, double wanted) {
    return pow(error / wanted, 1.6);
}

/* Our path tracer to the same error: samples are chosen from the last trial by the law above. What the last
 * trial lacks or has too much is made up by the same law. */
static bool trace_path(const study *self, double wanted, size_t *samples, outcome *found) {
    for (size_t trial = 0; trial < PATH_TRIALS; ++trial) {
        if (!measure(self, self->subject->path, *samples, 1, 1, found))
            return false;
        const double factor = samples_for(found->error, wanted);
        if (factor <= 1.0 && factor > 0.8)
            break;
        if (trial + 1 == PATH_TRIALS || self->options->quick || *samples == PATH_MOST)
            break;
        const size_t next = (size_t)ceil(1.02 * factor * (double)*samples);
        *samples = next == 0 ? 1 : next < PATH_MOST ? next : PATH_MOST;
    }
    print(self->subject->path, *samples, wanted, found);
    if (found->error > wanted)
        found->seconds *= samples_for(found->error, wanted);
    return true;
}

/* What our path tracer is asked for on the diffuse boxes. */
static double path_asked(const char *subject, double wanted) {
    if (strcmp(subject, "cornell-box") != 0)
        return 0.0;
    return wanted >= 0.01 ? 1.0 : wanted >= 0.005 ? 3.5 : 20.0;
}

/* At least so many times the path tracer's speed is asked of final gathering; 0: nothing is. */
static double ratio_asked(const char *subject, double wanted) {
    if (wanted != 0.005)
        return 0.0;
    return strcmp(subject, "cornell-box") == 0 ? 10.0 : strcmp(subject, "heavy-box") == 0 ? 5.0 : 0.0;
}

static void add(bench_figures *figures, bench_relation relation, double asked, double measured,
                const char *unit, const char *name, double wanted, const char *what) {
    bench_figures_add(figures, asked > 0.0 ? relation : BENCH_NOTED, asked, measured, unit,
                      "7. %s, error %.4g: %s", name, wanted, what);
}

static bool follow_recipe(const study *self, const bench_recipe *recipe, size_t *path_samples,
                          bench_figures *figures) {
    const char *const name = self->subject->name;
    outcome gathered, traced;
    if (!measure(self, recipe->integrator, recipe->samples, self->repeats, 1, &gathered))
        return false;
    print(recipe->integrator, recipe->samples, recipe->error, &gathered);
    add(figures, BENCH_AT_MOST, recipe->error, gathered.error, "", name, recipe->error,
        recipe->asked < 0.0 ? "bias floor" : "reached by finalgather");
    add(figures, BENCH_AT_MOST, recipe->asked, gathered.seconds, "CPU s", name, recipe->error, "finalgather");
    if (recipe->asked < 0.0)
        return true;
    if (!trace_path(self, recipe->error, path_samples, &traced))
        return false;
    add(figures, BENCH_AT_MOST, path_asked(name, recipe->error), traced.seconds, "CPU s", name, recipe->error,
        "path");
    add(figures, BENCH_AT_LEAST, ratio_asked(name, recipe->error), traced.seconds / gathered.seconds, "",
        name, recipe->error, "path / finalgather");
    return true;
}

/* What the photon map costs in truth: pictures with so many directions that hardly any other error is left,
 * compared by means of 8 x 8 pixels, by photons and by photons on a texel. */
static bool measure_bias(const study *self, bench_figures *figures) {
    static const size_t photons[] = {20000, 200000, 2000000}, texels[] = {4, 16, 64};
    const size_t many = self->options->quick ? 1 : 3, samples = self->options->quick ? 1 : 32;
    for (size_t i = 0; i < many; ++i)
        for (size_t k = 0; k < many; ++k) {
            char integrator[160];
            outcome found;
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

static bool find_scene(study *self, bool *skipped) {
    const bench_subject *const subject = self->subject;
    *skipped = false;
    if (subject->scene[0] == '\0')
        return bench_heavy_box(self->folder, self->options->quick ? 2000 : HEAVY_TRIANGLES, self->scene,
                               sizeof self->scene);
    snprintf(self->scene, sizeof self->scene, "%s%s", AUR_SOURCE_DIR, subject->scene);
    if (access(self->scene, R_OK) != 0 && subject->fallback != NULL)
        snprintf(self->scene, sizeof self->scene, "%s%s", AUR_SOURCE_DIR, subject->fallback);
    /* These are of meshes that scripts/scenes.sh makes. */
    *skipped = subject->relative && access(AUR_SOURCE_DIR "/scenes/generated/hare.ply", R_OK) != 0;
    return true;
}

static bool study_subject(study *self, bench_figures *figures) {
    bool skipped;
    if (!find_scene(self, &skipped))
        return false;
    if (skipped) {
        printf("  %s: skipped, its meshes are made by scripts/scenes.sh\n", self->subject->name);
        return true;
    }
    const char *const which = strstr(self->scene, "cornell-box.xml") != NULL ? " (ours)" : "";
    printf("  %s%s, %zu x %zu, one thread, %s\n", self->subject->name, which, self->width, self->height,
           self->subject->relative ? "RMSE / mean" : "RMSE");
    bool good = open_truth(self);
    size_t path_samples = self->options->quick ? 1 : 64;
    for (size_t i = 0; i < bench_recipe_count && good; ++i)
        if (strcmp(bench_recipes[i].subject, self->subject->name) == 0 &&
            (!self->options->quick || bench_recipes[i].error >= 0.005))
            good = follow_recipe(self, &bench_recipes[i], &path_samples, figures);
    if (self->subject->scene[0] != 0)
        good = good && measure_bias(self, figures);
    aur_image_destroy(self->truth[0]);
    aur_image_destroy(self->truth[1]);
    return good;
}

bool bench_quality(const bench_options *options, bench_figures *figures) {
    char folder[4000];
    if (!bench_data_folder(folder, sizeof folder))
        return false;
    for (size_t i = 0; i < SUBJECT_COUNT; ++i) {
        study self = {.options = options,
                      .subject = &subjects[i],
                      .width = options->quick ? 16 : subjects[i].width,
                      .height = options->quick ? 16 : subjects[i].height,
                      .reference_samples = options->quick ? 4 : subjects[i].reference_samples,
                      .repeats = options->quick         ? 1
                                 : subjects[i].relative ? SLOW_REPEATS
                                                        : REPEATS};
        snprintf(self.folder, sizeof self.folder, "%s", folder);
        if (!study_subject(&self, figures))
            return false;
        if (options->quick && i == 1) /* the two boxes show all there is to show */
            break;
    }
    return true;
}
