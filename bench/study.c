/* Subjects, the images that are their truth, and what other images cost and err. */
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

/* The fastest forms of our path tracer: where chance begins to end paths is best sooner in plain boxes. */
static const char in_boxes[] = "path:interleaved=true,rr_depth=3",
                  in_rooms[] = "path:interleaved=true,rr_depth=4";

/* An error of the references of twice or thrice that of the finest image is enough, as their own noise has
 * no part in the mean of what is told. */
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

/* By our program as a process, which finds no photon maps of earlier runs. Where no integrator is told, to
 * the error. */
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

void bench_study_truth_path(const bench_study *self, size_t k, size_t capacity, char *path) {
    snprintf(path, capacity, "%s/%s-%zux%zu-%g-%zu.pfm", self->folder, self->subject->name, self->width,
             self->height, reference_error(self), k + 1);
}

/* The two references, made where they are not there. Paths that no sample met are not in them: their error
 * is asked of pixels as even as `reference_error` makes them. */
static bool open_truth(bench_study *self) {
    const double asked = reference_error(self);
    for (size_t k = 0; k < 2; ++k) {
        char path[BENCH_STUDY_PATH];
        bench_study_truth_path(self, k, sizeof path, path);
        if (access(path, R_OK) != 0) {
            char part[4500];
            bench_child_cost cost;
            snprintf(part, sizeof part, "%s.part.pfm", path);
            printf("  %s: a reference to %g %% is rendered once\n", self->subject->name, 100.0 * asked);
            if (!render(self, &(bench_request){.integrator = "path", .error = asked}, 1001 + k,
                        self->options->threads, part, &cost))
                return false;
            if (rename(part, path) != 0)
                return bench_fail("%s cannot be written", path);
        }
        self->truth[k] = read_image(path);
        if (self->truth[k] == NULL)
            return false;
    }
    double means[2][4];
    aur_error error;
    for (size_t k = 0; k < 2; ++k)
        if (aur_image_mean(self->truth[k], means[k], &error) != AUR_OK)
            return bench_fail("%s", error.message);
    self->light = 0.5 * (means[0][3] + means[1][3]);
    self->mean = self->subject->relative ? self->light : 1.0;
    return true;
}

typedef struct square_error {
    double mean, uncertain; /* the second is the standard error of the first */
} square_error;

/* The mean of (x - a)(x - b) over channels and means of block x block pixels; what does not fill a block is
 * left out. */
static square_error mean_square_error(const bench_study *self, const aur_image *image, size_t block) {
    const size_t across = self->width / block, down = self->height / block;
    const float *const x = aur_image_data(image);
    const float *const a = aur_image_data(self->truth[0]), *const b = aur_image_data(self->truth[1]);
    const double scale = 1.0 / (3.0 * pow((double)block, 4.0)), count = (double)(across * down);
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < across * down; ++i) {
        double product = 0.0; /* of the channels together, whose noise is alike */
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
    double seconds[MOST_SEEDS], square = 0.0, uncertain = 0.0;
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
        /* The truth is the same for all seeds, so that its noise is: the standard error does not fall. */
        const square_error one = mean_square_error(self, image, block);
        square += one.mean / (double)seeds;
        uncertain += one.uncertain / (double)seeds;
        aur_image_destroy(image);
    }
    qsort(seconds, seeds, sizeof *seconds, ascending);
    const double error = sqrt(fmax(0.0, square));
    /* The root's derivative at the error, or at the least one that is told from none. */
    const double wide = uncertain > 0.0 ? 0.5 * uncertain / fmax(error, sqrt(uncertain)) : 0.0;
    *found = (bench_outcome){seconds[seeds / 2], error / self->mean, wide / self->mean};
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
    /* These are of meshes that scripts/scenes.sh makes. */
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
    return open_truth(self);
}

void bench_study_close(bench_study *self) {
    aur_image_destroy(self->truth[0]);
    aur_image_destroy(self->truth[1]);
}
