/* Memory and arithmetic limits; limits_rays.c has those of Embree. */
#include "limits.h"

#include <math.h>
#include <stdlib.h>

#include "limits_kernels.h"

static const bench_kernels *kernels(void) {
    return &AUR_KERNEL_HERE(bench_kernels);
}

bool bench_limit_open(const bench_limit *limit, const bench_options *options, bench_work *work) {
    return limit->open(limit, options, work);
}

void bench_limit_close(const bench_limit *limit, bench_work *work) {
    limit->close(work);
}

bool bench_against(const bench_options *options, const char *name, const bench_work *subject,
                   const bench_limit *limit) {
    bench_work against;
    if (!bench_limit_open(limit, options, &against))
        return false;
    const bench_pair figures = bench_compare(options, subject, &against);
    bench_print_pair(name, limit->name, limit->unit, limit->scale, &figures);
    bench_limit_close(limit, &against);
    return true;
}

bool bench_limit_compare(const bench_options *options, const bench_limit_pair *pair) {
    bench_work subject;
    if (!bench_limit_open(pair->subject, options, &subject))
        return false;
    const bool measured = bench_against(options, pair->subject->name, &subject, pair->against);
    bench_limit_close(pair->subject, &subject);
    return measured;
}

/* --- memory */

typedef enum memory_form { FILL, FILL_STREAM, COPY, COPY_STREAM, READ } memory_form;
enum { FORM_MASK = 15, IN_CACHE = 16 };

typedef struct memory_context {
    const bench_kernels *kernels;
    memory_form form;
    size_t count; /* doubles */
    double *from, *to;
} memory_context;

static void run_memory(void *data) {
    const memory_context *const context = data;
    switch (context->form) {
    case FILL:
        context->kernels->fill(context->count, context->to);
        break;
    case FILL_STREAM:
        context->kernels->fill_stream(context->count, context->to);
        break;
    case COPY:
        context->kernels->copy(context->count, context->from, context->to);
        break;
    case COPY_STREAM:
        context->kernels->copy_stream(context->count, context->from, context->to);
        break;
    case READ:
        bench_keep(context->kernels->read(context->count, context->from));
        break;
    }
}

static void close_memory(bench_work *work) {
    memory_context *const context = work->context;
    if (context == NULL)
        return;
    free(context->from);
    free(context->to);
    free(context);
    work->context = NULL;
}

/* Touches the pages, so that measurements include no page faults. */
static double *allocate(size_t count) {
    double *const values = aligned_alloc(64, count * sizeof *values);
    for (size_t i = 0; values != NULL && i < count; ++i)
        values[i] = 1.0;
    return values;
}

static bool open_memory(const bench_limit *limit, const bench_options *options, bench_work *work) {
    const size_t memory_bytes = (size_t)(options->quick ? 16 : 256) << 20, cache_bytes = (size_t)16 << 10;
    memory_context *const context = calloc(1, sizeof *context);
    *work = (bench_work){.run = run_memory, .context = context};
    if (context == NULL)
        return bench_fail("out of memory");
    context->kernels = kernels();
    context->form = (memory_form)(limit->form & FORM_MASK);
    context->count = ((limit->form & IN_CACHE) != 0 ? cache_bytes : memory_bytes) / sizeof(double);
    const bool reads = context->form == COPY || context->form == COPY_STREAM || context->form == READ;
    context->from = reads ? allocate(context->count) : NULL;
    context->to = context->form != READ ? allocate(context->count) : NULL;
    work->units = (double)(context->count * sizeof(double));
    if ((reads && context->from == NULL) || (context->form != READ && context->to == NULL)) {
        close_memory(work);
        return bench_fail("out of memory");
    }
    return true;
}

const bench_limit bench_limit_fill_memory = {"fill-memory", "GB", 1e9, open_memory, close_memory, FILL};
const bench_limit bench_limit_fill_memory_stream = {"fill-memory-stream", "GB",         1e9,
                                                    open_memory,          close_memory, FILL_STREAM};
const bench_limit bench_limit_fill_cache = {"fill-cache", "GB",         1e9,
                                            open_memory,  close_memory, FILL | IN_CACHE};
const bench_limit bench_limit_copy_memory = {"copy-memory", "GB", 1e9, open_memory, close_memory, COPY};
const bench_limit bench_limit_copy_memory_stream = {"copy-memory-stream", "GB",         1e9,
                                                    open_memory,          close_memory, COPY_STREAM};
const bench_limit bench_limit_read_memory = {"read-memory", "GB", 1e9, open_memory, close_memory, READ};
const bench_limit bench_limit_read_cache = {"read-cache", "GB",         1e9,
                                            open_memory,  close_memory, READ | IN_CACHE};

/* --- arithmetic */

enum { FMA_ROUNDS = 1 << 14, PAIR_POINTS = 256 };

typedef enum arithmetic_form { FMA_F32, FMA_F64, PAIRS_F32, PAIRS_F64 } arithmetic_form;

typedef struct arithmetic_context {
    const bench_kernels *kernels;
    arithmetic_form form;
    _Alignas(64) double xyz[3 * PAIR_POINTS];
    _Alignas(64) float xyz_f32[3 * PAIR_POINTS];
} arithmetic_context;

static void run_arithmetic(void *data) {
    const arithmetic_context *const context = data;
    switch (context->form) {
    case FMA_F32:
        bench_keep(context->kernels->fma_f32(FMA_ROUNDS));
        break;
    case FMA_F64:
        bench_keep(context->kernels->fma_f64(FMA_ROUNDS));
        break;
    case PAIRS_F32:
        bench_keep(context->kernels->pairs_f32(PAIR_POINTS, context->xyz_f32));
        break;
    case PAIRS_F64:
        bench_keep(context->kernels->pairs_f64(PAIR_POINTS, context->xyz));
        break;
    }
}

static double units_of(const arithmetic_context *context) {
    const double chains = 2.0 * FMA_ROUNDS * BENCH_FMA_ACCUMULATORS * (double)context->kernels->bytes;
    switch (context->form) {
    case FMA_F32:
        return chains / sizeof(float);
    case FMA_F64:
        return chains / sizeof(double);
    default:
        return (double)PAIR_POINTS * PAIR_POINTS;
    }
}

static void close_arithmetic(bench_work *work) {
    free(work->context);
    work->context = NULL;
}

static bool open_arithmetic(const bench_limit *limit, const bench_options *options, bench_work *work) {
    (void)options;
    arithmetic_context *const context = aligned_alloc(64, sizeof *context);
    *work = (bench_work){.run = run_arithmetic, .context = context};
    if (context == NULL)
        return bench_fail("out of memory");
    context->kernels = kernels();
    context->form = (arithmetic_form)limit->form;
    for (size_t i = 0; i < PAIR_POINTS; ++i) {
        const double z = 1.0 - (2.0 * (double)i + 1.0) / PAIR_POINTS, r = sqrt(1.0 - z * z);
        const double phi = 2.4 * (double)i;
        context->xyz[i] = r * cos(phi);
        context->xyz[PAIR_POINTS + i] = r * sin(phi);
        context->xyz[2 * PAIR_POINTS + i] = z;
    }
    for (size_t i = 0; i < 3 * PAIR_POINTS; ++i)
        context->xyz_f32[i] = (float)context->xyz[i];
    work->units = units_of(context);
    return true;
}

const bench_limit bench_limit_fma_f32 = {"fma-f32", "Gflop", 1e9, open_arithmetic, close_arithmetic, FMA_F32};
const bench_limit bench_limit_fma_f64 = {"fma-f64", "Gflop", 1e9, open_arithmetic, close_arithmetic, FMA_F64};
const bench_limit bench_limit_pairs_f32 = {"pairs-f32",     "Gpair",          1e9,
                                           open_arithmetic, close_arithmetic, PAIRS_F32};
const bench_limit bench_limit_pairs_f64 = {"pairs-f64",     "Gpair",          1e9,
                                           open_arithmetic, close_arithmetic, PAIRS_F64};
