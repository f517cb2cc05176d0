/* Subjects, their reference images, and cost and error of other images. */
#include "study.h"

#include <aureole-render/image.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "child.h"
#include "heavy_box.h"

enum { HEAVY_TRIANGLES = 500000, WORDS = 28, MOST_SEEDS = 8, QUICK_SIDE = 16 };

/* The fastest settings of the path tracer: Russian roulette is best started earlier in plain boxes. */
static const char in_boxes[] = "path:interleaved=true,rr_depth=3",
                  in_rooms[] = "path:interleaved=true,rr_depth=4";

/* References with two to three times the error of the finest image are enough: their noise does not bias the
 * estimated error. */
/* clang-format off */
const bench_subject bench_subjects[] = {
    {"cornell-box", "/../shared/scenes/cornell-box/scene.xml", "/scenes/cornell-box/cornell-box.xml", NULL,
                                                                               in_boxes, 256, 256, 0.02,  false},
    {"heavy-box",   "",                               NULL, NULL,              in_boxes, 256, 256, 0.03,  false},
    {"glossy-box",  "/scenes/cornell-box/figure.xml", NULL, "materials=rough", in_rooms, 256, 256, 0.012, true},
    {"room",        "/scenes/room/room.xml",          NULL, "materials=rough", in_rooms, 240, 160, 0.04,  true},
    {"parade",      "/scenes/parade/parade.xml",      NULL, "materials=rough", in_rooms, 120,  80, 0.03,  true},
    {"statue",      "/scenes/statue/statue.xml",      NULL, "materials=rough", in_rooms, 120,  80, 0.03,  true},
    {"sphere",      "/scenes/sphere/sphere.xml",      NULL, "materials=rough", in_rooms, 120,  80, 0.03,  true},
    {"plates",      "/scenes/plates/plates.xml",      NULL, "materials=rough", in_rooms, 120,  80, 0.03,  true},
};
/* clang-format on */

const size_t bench_subject_count = sizeof bench_subjects / sizeof bench_subjects[0];

/* --- images */

/* Runs the program in a process without a cache of photon maps. Without an integrator it renders to the
 * target error. */
static bool render(const bench_study *self, const bench_request *request, size_t seed, size_t threads,
                   const char *output, bench_child_cost *cost) {
    char numbers[6][32];
    snprintf(numbers[0], sizeof numbers[0], "resx=%zu", self->width);
    snprintf(numbers[1], sizeof numbers[1], "resy=%zu", self->height);
    snprintf(numbers[2], sizeof numbers[2], "%zu", request->samples);
    snprintf(numbers[3], sizeof numbers[3], "%zu", seed);
    snprintf(numbers[4], sizeof numbers[4], "%zu", threads);
    snprintf(numbers[5], sizeof numbers[5], "%.9g", request->error);
    const char *words[WORDS] = {"render", self->scene, "-q", "--no-cache", "--filter", "box",
                                "--seed", numbers[3],  "-t", numbers[4],   "-D",       numbers[0],
                                "-D",     numbers[1],  "-o", output};
    size_t count = 16;
    if (self->subject->definition != NULL) {
        words[count++] = "-D";
        words[count++] = self->subject->definition;
    }
    if (request->integrator != NULL) {
        words[count++] = "--integrator";
        words[count++] = request->integrator;
    }
    if (request->error > 0.0) {
        words[count++] = "--error";
        words[count++] = numbers[5];
    } else {
        words[count++] = "--sampler";
        words[count++] = "sobol";
        words[count++] = "--spp";
        words[count++] = numbers[2];
    }
    if (request->denoised)
        words[count++] = "--denoise";
    return bench_run_child(words, cost);
}

static aur_image *read_image(const char *path) {
    aur_image *image = NULL;
    aur_error error;
    if (aur_image_read(path, &image, &error) != AUR_OK)
        bench_fail("%s: %s", path, error.message);
    return image;
}

static double reference_error(const bench_study *self) {
    return self->options->quick ? 0.5 : self->subject->reference_error;
}

void bench_study_reference_path(const bench_study *self, size_t k, size_t capacity, char *path) {
    snprintf(path, capacity, "%s/%s-%zux%zu-%g-%zu.pfm", self->folder, self->subject->name, self->width,
             self->height, reference_error(self), k + 1);
}

/* The two references, rendered if missing. They lack paths that no sample found: `reference_error` is the
 * target for images with similar error in all pixels. */
static bool open_references(bench_study *self) {
    const double target = reference_error(self);
    for (size_t k = 0; k < 2; ++k) {
        char path[BENCH_STUDY_PATH];
        bench_study_reference_path(self, k, sizeof path, path);
        if (access(path, R_OK) != 0) {
            char part[4500];
            bench_child_cost cost;
            snprintf(part, sizeof part, "%s.part.pfm", path);
            printf("  %s: a reference to %g %% is rendered once\n", self->subject->name, 100.0 * target);
            if (!render(self, &(bench_request){.integrator = "path", .error = target}, 1001 + k,
                        self->options->threads, part, &cost))
                return false;
            if (rename(part, path) != 0)
                return bench_fail("%s cannot be written", path);
        }
        self->references[k] = read_image(path);
        if (self->references[k] == NULL)
            return false;
    }
    double means[2][4];
    aur_error error;
    for (size_t k = 0; k < 2; ++k)
        if (aur_image_mean(self->references[k], means[k], &error) != AUR_OK)
            return bench_fail("%s", error.message);
    self->light = 0.5 * (means[0][3] + means[1][3]);
    self->mean = self->subject->relative ? self->light : 1.0;
    return true;
}

typedef struct square_error {
    double mean, standard_error; /* standard_error: of the mean */
} square_error;

/* The mean of (x - a)(x - b) over channels and means of block x block pixels. Incomplete blocks are left out.
 */
static square_error mean_square_error(const bench_study *self, const aur_image *image, size_t block) {
    const size_t across = self->width / block, down = self->height / block;
    const float *const x = aur_image_data(image);
    const float *const a = aur_image_data(self->references[0]);
    const float *const b = aur_image_data(self->references[1]);
    const double scale = 1.0 / (3.0 * pow((double)block, 4.0)), count = (double)(across * down);
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < across * down; ++i) {
        double product = 0.0; /* sum over the channels, whose noise is correlated */
        for (size_t channel = 0; channel < 3; ++channel) {
            const size_t x0 = i % across * block, y0 = i / across * block;
            double to_a = 0.0, to_b = 0.0;
            for (size_t k = 0; k < block * block; ++k) {
                const size_t at = 3 * ((y0 + k / block) * self->width + x0 + k % block) + channel;
                to_a += (double)x[at] - (double)a[at];
                to_b += (double)x[at] - (double)b[at];
            }
            product += scale * to_a * to_b;
        }
        sum += product;
        squares += product * product;
    }
    return (square_error){sum / count, sqrt(fmax(squares - sum * sum / count, 0.0)) / count};
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bool bench_study_measure(const bench_study *self, const bench_request *request, size_t seeds, size_t block,
                         bench_outcome *found) {
    char output[4400];
    double seconds[MOST_SEEDS], square = 0.0, standard_error = 0.0;
    snprintf(output, sizeof output, "%s/picture-%ld.pfm", self->folder, (long)getpid());
    for (size_t k = 0; k < seeds; ++k) {
        bench_child_cost cost;
        if (!render(self, request, 1 + k, 1, output, &cost))
            return false;
        aur_image *const image = read_image(output);
        unlink(output);
        if (image == NULL)
            return false;
        seconds[k] = cost.cpu_seconds;
        /* All seeds share the reference and its noise: the standard error does not decrease with the seeds.
         */
        const square_error one = mean_square_error(self, image, block);
        square += one.mean / (double)seeds;
        standard_error += one.standard_error / (double)seeds;
        aur_image_destroy(image);
    }
    qsort(seconds, seeds, sizeof *seconds, ascending);
    const double error = sqrt(fmax(0.0, square));
    /* The derivative of the square root at the error, or at the smallest error that differs from 0. */
    const double root_error =
        standard_error > 0.0 ? 0.5 * standard_error / fmax(error, sqrt(standard_error)) : 0.0;
    *found = (bench_outcome){seconds[seeds / 2], error / self->mean, root_error / self->mean};
    return true;
}

/* --- scenes */

static bool find_scene(bench_study *self, bool *skipped) {
    const bench_subject *const subject = self->subject;
    *skipped = false;
    if (subject->scene[0] == '\0')
        return bench_heavy_box(self->folder, self->options->quick ? 2000 : HEAVY_TRIANGLES, self->scene,
                               sizeof self->scene);
    snprintf(self->scene, sizeof self->scene, "%s%s", AUR_SOURCE_DIR, subject->scene);
    if (access(self->scene, R_OK) != 0 && subject->fallback != NULL)
        snprintf(self->scene, sizeof self->scene, "%s%s", AUR_SOURCE_DIR, subject->fallback);
    /* These scenes use meshes that scripts/scenes.sh generates. */
    *skipped = subject->relative && access(AUR_SOURCE_DIR "/scenes/generated/hare.ply", R_OK) != 0;
    return true;
}

bool bench_study_open(bench_study *self, const bench_options *options, const bench_subject *subject,
                      bool *skipped) {
    *self = (bench_study){.options = options,
                          .subject = subject,
                          .width = options->quick ? QUICK_SIDE : subject->width,
                          .height = options->quick ? QUICK_SIDE : subject->height};
    if (!bench_data_folder(self->folder, sizeof self->folder) || !find_scene(self, skipped))
        return false;
    if (*skipped) {
        printf("  %s: skipped, its meshes are made by scripts/scenes.sh\n", subject->name);
        return true;
    }
    const char *const which = strstr(self->scene, "cornell-box.xml") != NULL ? " (ours)" : "";
    printf("  %s%s, %zu x %zu, one thread, %s\n", subject->name, which, self->width, self->height,
           subject->relative ? "RMSE / mean" : "RMSE");
    return open_references(self);
}

void bench_study_close(bench_study *self) {
    aur_image_destroy(self->references[0]);
    aur_image_destroy(self->references[1]);
}
