/* The radiosity random walk against Embree alone on the same rays, with each kind of sample points; and the
 * cost of a second thread. */
#include <aureole-render/radiosity.h>
#include <stdio.h>
#include <stdlib.h>

#include "limits.h"
#include "recorder.h"
#include "render/scene/scene.h"

enum { PATHS = 1 << 15, QUICK_PATHS = 1 << 9, BOUNCES = 6, CAPACITY = PATHS * (BOUNCES + 1) * 2 };

typedef struct walk_context {
    const aur_scene *scene;
    aur_radiosity *radiosity;
    uint64_t paths, each;
    bench_recorder recorder;
    bool failed;
} walk_context;

/* Each run continues where the previous one ended. */
static void walk(void *data) {
    walk_context *const context = data;
    context->paths += context->each;
    if (aur_radiosity_trace(context->radiosity, context->paths, NULL) != AUR_OK)
        context->failed = true;
}

static aur_result replay(void *data, size_t index) {
    (void)index;
    const walk_context *const context = data;
    bench_keep((double)bench_replay(aur_scene_embree(context->scene), &context->recorder));
    return AUR_OK;
}

/* Runs an item on one thread with denormals flushed, like the random walk. */
static void run_replay(void *context) {
    static const aur_parallel_options one_thread = {.threads = 1, .flush_denormals = true};
    aur_parallel_for(&one_thread, 1, replay, context, NULL);
}

static bool start(walk_context *context, const char *set, aur_scramble scramble, size_t threads) {
    aur_radiosity_options options = {.size = sizeof options};
    aur_radiosity_options_init(&options, NULL);
    options.sequence = set;
    options.scramble = scramble;
    options.bounces = BOUNCES;
    options.threads = threads;
    aur_error error;
    context->paths = 0;
    context->failed = false;
    return aur_radiosity_create(context->scene, &options, &context->radiosity, &error) == AUR_OK ||
           bench_fail("%s", error.message);
}

static void end(walk_context *context) {
    aur_radiosity_destroy(context->radiosity);
    context->radiosity = NULL;
}

static bool compare_set(const bench_options *options, walk_context *context, const char *scene,
                        const char *set, aur_scramble scramble) {
    if (!start(context, set, scramble, 1))
        return false;
    context->recorder.count = 0;
    bench_record(&context->recorder);
    walk(context);
    bench_record(NULL);
    const bool recorded = !context->failed && context->recorder.count <= CAPACITY;
    const double rays = (double)context->recorder.count;
    const bench_work subject = {walk, context, rays}, bare = {run_replay, context, rays};
    if (recorded) {
        char label[96];
        snprintf(label, sizeof label, "%s, %s%s%s", scene, set, scramble == AUR_SCRAMBLE_NONE ? "" : " ",
                 scramble == AUR_SCRAMBLE_NONE ? "" : aur_scramble_name(scramble));
        const bench_pair pair = bench_compare(options, &subject, &bare);
        bench_print_pair(label, "Embree, one by one", "Mray", 1e6, &pair);
    }
    end(context);
    return (recorded && !context->failed) || bench_fail("%s, %s: the walk failed", scene, set);
}

/* Rate of paths on two threads over that on one: 1 / (1 + the relative increase of CPU time per path). */
static bool compare_threads(const bench_options *options, const walk_context *context, const char *scene) {
    /* Long runs, because threads that wait for the last one at the end use CPU time. */
    walk_context alone = *context, two;
    walk_context *const one = &alone;
    one->each *= options->quick ? 1 : 8;
    two = *one;
    if (!start(one, "sobol", AUR_SCRAMBLE_NONE, 1) || !start(&two, "sobol", AUR_SCRAMBLE_NONE, 2))
        return false;
    const double paths = (double)one->each;
    const bench_work subject = {walk, &two, paths}, limit = {walk, one, paths};
    const bench_pair pair = bench_compare(options, &subject, &limit);
    char label[96];
    snprintf(label, sizeof label, "%s, two threads", scene);
    bench_print_pair(label, "one thread", "kpath", 1e3, &pair);
    const bool good = !one->failed && !two.failed;
    end(one);
    end(&two);
    return good || bench_fail("%s: the walk failed", scene);
}

static bool run_scene(const bench_options *options, walk_context *context, const char *name) {
    static const struct {
        const char *set;
        aur_scramble scramble;
    } sets[] = {{"sobol", AUR_SCRAMBLE_NONE},        {"sobol", AUR_SCRAMBLE_OWEN},
                {"niederreiter", AUR_SCRAMBLE_NONE}, {"halton", AUR_SCRAMBLE_NONE},
                {"faure", AUR_SCRAMBLE_NONE},        {"faure:scramble=lower-triangular", AUR_SCRAMBLE_NONE},
                {"random", AUR_SCRAMBLE_NONE},       {"lcg", AUR_SCRAMBLE_NONE},
                {"icg", AUR_SCRAMBLE_NONE}};
    aur_scene *scene = NULL;
    aur_error error;
    char path[512];
    snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/keller/%s.xml", name);
    if (aur_scene_load(path, NULL, &scene, &error) != AUR_OK)
        return bench_fail("%s: %s", error.file, error.message);
    context->scene = scene;
    bool good = true;
    for (size_t i = 0; i < sizeof sets / sizeof sets[0] && good; ++i)
        good = compare_set(options, context, name, sets[i].set, sets[i].scramble);
    good = good && compare_threads(options, context, name);
    aur_scene_destroy(scene);
    return good;
}

static bool run(const bench_options *options) {
    walk_context context = {
        .each = options->quick ? QUICK_PATHS : PATHS,
        .recorder = {.capacity = CAPACITY, .rays = malloc(CAPACITY * sizeof(bench_recorded_ray))}};
    const bool good = context.recorder.rays == NULL ? bench_fail("out of memory")
                                                    : run_scene(options, &context, "cube") &&
                                                          run_scene(options, &context, "living-room");
    free(context.recorder.rays);
    return good;
}

const bench bench_radiosity = {"radiosity",
                               "the radiosity walk against Embree alone on the rays that it traced", run};
