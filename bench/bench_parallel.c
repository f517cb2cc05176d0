/* The overhead of distributing work over threads: the same items on one thread and on all. */
#include "limits.h"
#include "points/base/parallel.h"
#include "points/base/random.h"

enum { ITEMS = 256 };

typedef struct sharing_context {
    size_t threads;
    size_t hashes_per_item;
    double results[ITEMS];
} sharing_context;

static aur_result do_item(void *data, size_t index) {
    sharing_context *const context = data;
    uint64_t sum = 0;
    for (size_t i = 0; i < context->hashes_per_item; ++i)
        sum += aur_hash2(index, i) >> 32;
    context->results[index] = (double)sum;
    return AUR_OK;
}

static void run_items(void *data) {
    sharing_context *const context = data;
    const aur_parallel_options options = {.threads = context->threads};
    aur_parallel_for(&options, ITEMS, do_item, context, NULL);
    bench_keep(context->results[ITEMS - 1]);
}

static bool run(const bench_options *options) {
    /* From tiles that are far too small to the size of image tiles. */
    static const size_t hashes_per_item[] = {100, 1000, 10000, 100000};
    static const char *const names[] = {"100 hashes an item", "1,000 hashes an item", "10,000 hashes an item",
                                        "100,000 hashes an item"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        sharing_context shared = {.threads = options->threads, .hashes_per_item = hashes_per_item[i]};
        sharing_context alone = {.threads = 1, .hashes_per_item = hashes_per_item[i]};
        const double units = (double)ITEMS * (double)hashes_per_item[i];
        const bench_work subject = {run_items, &shared, units};
        const bench_work limit = {run_items, &alone, units};
        const bench_pair pair = bench_compare(options, &subject, &limit);
        bench_print_pair(names[i], "one thread", "Mhash", 1e6, &pair);
    }
    return true;
}

const bench bench_parallel = {"parallel", "CPU time of work on all threads against the same on one", run};
