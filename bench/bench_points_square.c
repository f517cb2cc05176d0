/* Point sets of the unit square: against a streaming fill of the same bytes, against scalar loops, on all
 * threads. */
#include <aureole/pointset.h>
#include <stdlib.h>

#include "limits.h"
#include "points/base/parallel.h"
#include "points/base/random.h"
#include "points/pointset/net_2d.h"

/* Multithreaded runs are long compared with a time slice, so that waiting for a preempted thread matters
 * little. */
enum { SLICES = 16, ROUNDS = 256 };

typedef struct square_context {
    aur_pointset *set; /* NULL: the direct golden set */
    size_t count;
    size_t threads, rounds;
    double *points;
} square_context;

static bool open_square(const char *text, aur_scramble scramble, square_context *context) {
    const aur_pointset_options options = {
        .size = sizeof options, .count = context->count, .scramble = scramble, .seed = 1};
    context->points = malloc(2 * context->count * sizeof *context->points);
    if (context->points == NULL ||
        (text != NULL && aur_pointset_create(text, &options, &context->set, NULL) != AUR_OK)) {
        free(context->points);
        return bench_fail("%s cannot be made ready", text != NULL ? text : "the golden set");
    }
    return true;
}

static void close_square(square_context *context) {
    aur_pointset_destroy(context->set);
    free(context->points);
}

static void make_points(void *data) {
    const square_context *const context = data;
    aur_pointset_points(context->set, 0, context->count, 2 * context->count, context->points, NULL);
    bench_keep(context->points[2 * context->count - 1]);
}

static void make_golden_set(void *data) {
    const square_context *const context = data;
    const aur_output output = {.capacity = 2 * context->count, .doubles = context->points};
    aur_golden_set_points(0.25, context->count, &output, NULL);
    bench_keep(context->points[2 * context->count - 1]);
}

static bool run_against_fill(const bench_options *options, const char *name, const char *text,
                             aur_scramble scramble, size_t count) {
    square_context context = {.count = count};
    if (!open_square(text, scramble, &context))
        return false;
    const bench_work subject = {text != NULL ? make_points : make_golden_set, &context, 16.0 * (double)count};
    const bench_limit *const limit = count < 4096 ? &bench_limit_fill_cache : &bench_limit_fill_memory_stream;
    const bool done = bench_against(options, name, &subject, limit);
    close_square(&context);
    return done;
}

/* Hash-based Owen scrambling of Sobol' points, one point and 32 digits at a time, as published. */
static void make_points_by_scalars(void *data) {
    const square_context *const context = data;
    const uint32_t key_x = (uint32_t)aur_hash2(1, 0);
    const uint32_t key_y = (uint32_t)aur_hash2(1, 1);
    for (size_t i = 0; i < context->count; ++i) {
        const uint32_t index = (uint32_t)i;
        context->points[2 * i] = 0x1p-32 * aur_owen_scramble(aur_sobol_first(index), key_x);
        context->points[2 * i + 1] = 0x1p-32 * aur_owen_scramble(aur_sobol_second(index), key_y);
        /* A scalar loop that the compiler may not vectorize. */
        __asm__ volatile("" : : : "memory");
    }
    bench_keep(context->points[2 * context->count - 1]);
}

static bool run_against_scalars(const bench_options *options, const char *name, size_t count) {
    square_context context = {.count = count};
    if (!open_square("sobol", AUR_SCRAMBLE_OWEN, &context))
        return false;
    const bench_work fast = {make_points, &context, (double)count};
    const bench_work scalar = {make_points_by_scalars, &context, (double)count};
    const bench_pair pair = bench_compare(options, &fast, &scalar);
    bench_print_pair(name, "scalar hash-Owen", "Mpoint", 1e6, &pair);
    close_square(&context);
    return true;
}

/* Golden sets of 4M points and of 64 times fewer: a ratio of 1 means linear time in N. */
static bool run_golden_growth(const bench_options *options, size_t count) {
    square_context large = {.count = count};
    square_context small = {.count = count / 64};
    if (!open_square(NULL, AUR_SCRAMBLE_NONE, &large))
        return false;
    if (!open_square(NULL, AUR_SCRAMBLE_NONE, &small)) {
        close_square(&large);
        return false;
    }
    const bench_work subject = {make_golden_set, &large, (double)large.count};
    const bench_work limit = {make_golden_set, &small, (double)small.count};
    const bench_pair pair = bench_compare(options, &subject, &limit);
    bench_print_pair("golden-set, N = 4M", "N = 64k", "Mpoint", 1e6, &pair);
    close_square(&large);
    close_square(&small);
    return true;
}

static aur_result make_slice(void *data, size_t index) {
    const square_context *const context = data;
    const size_t part = context->count / SLICES;
    aur_result result = AUR_OK;
    for (size_t round = 0; round < context->rounds && result == AUR_OK; ++round)
        result = aur_pointset_points(context->set, index * part, part, 2 * part,
                                     context->points + 2 * index * part, NULL);
    return result;
}

static void make_points_shared(void *data) {
    const square_context *const context = data;
    const aur_parallel_options options = {.threads = context->threads};
    aur_parallel_for(&options, SLICES, make_slice, data, NULL);
    bench_keep(context->points[2 * context->count - 1]);
}

/* Slices stay in the thread's cache, because memory bandwidth is shared. */
static bool run_on_threads(const bench_options *options, const char *name, aur_scramble scramble) {
    square_context alone = {.count = SLICES << 14, .threads = 1, .rounds = options->quick ? 1 : ROUNDS};
    if (!open_square("sobol", scramble, &alone))
        return false;
    square_context shared = alone;
    shared.threads = options->threads;
    const double units = (double)alone.rounds * (double)alone.count;
    const bench_work one = {make_points_shared, &alone, units};
    const bench_work all = {make_points_shared, &shared, units};
    const bench_pair pair = bench_compare(options, &all, &one);
    bench_print_pair(name, "one thread", "Mpoint", 1e6, &pair);
    close_square(&alone);
    return true;
}

static bool run(const bench_options *options) {
    const size_t count = options->quick ? (size_t)1 << 16 : (size_t)1 << 22;
    static const struct {
        const char *name, *text;
        aur_scramble scramble;
    } rows[] = {
        {"sobol, 4M", "sobol", AUR_SCRAMBLE_NONE},
        {"sobol digit-scrambled, 4M", "sobol", AUR_SCRAMBLE_DIGIT},
        {"sobol Owen-scrambled, 4M", "sobol", AUR_SCRAMBLE_OWEN},
        {"golden-set (direct), 4M", NULL, AUR_SCRAMBLE_NONE},
        {"larcher-pillichshammer, 4M", "larcher-pillichshammer", AUR_SCRAMBLE_NONE},
        {"r2, 4M", "r2", AUR_SCRAMBLE_NONE},
        {"rank1, 4M", "rank1", AUR_SCRAMBLE_NONE},
        {"random, 4M", "random", AUR_SCRAMBLE_NONE},
        {"halton, 4M", "halton", AUR_SCRAMBLE_NONE},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k)
        if (!run_against_fill(options, rows[k].name, rows[k].text, rows[k].scramble, count))
            return false;
    return run_against_fill(options, "sobol, 1k", "sobol", AUR_SCRAMBLE_NONE, 1000) &&
           run_against_fill(options, "sobol Owen-scrambled, 1k", "sobol", AUR_SCRAMBLE_OWEN, 1000) &&
           run_against_scalars(options, "sobol Owen-scrambled, 4M", count) &&
           run_against_scalars(options, "sobol Owen-scrambled, 1k", 1000) &&
           run_golden_growth(options, count) &&
           run_on_threads(options, "sobol, all threads", AUR_SCRAMBLE_NONE) &&
           run_on_threads(options, "sobol Owen-scrambled, all threads", AUR_SCRAMBLE_OWEN);
}

const bench bench_points_square = {"points-square", "points of the square against fills and scalar loops",
                                   run};
