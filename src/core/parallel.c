#include "core/parallel.h"

#include <omp.h>
#include <stdatomic.h>
#include <stdbool.h>

#if defined(__x86_64__)
#include <immintrin.h>

static unsigned enter_fast_denormals(void) {
    const unsigned saved = _mm_getcsr();
    _mm_setcsr(saved | 0x8040u); /* flush to zero, denormals are zero */
    return saved;
}

static void leave_fast_denormals(unsigned saved) {
    _mm_setcsr(saved);
}
#else
static unsigned enter_fast_denormals(void) {
    return 0;
}

static void leave_fast_denormals(unsigned saved) {
    (void)saved;
}
#endif

size_t aur_parallel_threads(size_t threads) {
    if (threads > 0)
        return threads;
    const int offered = omp_get_max_threads();
    return offered > 0 ? (size_t)offered : 1;
}

typedef struct shared_state {
    atomic_bool stop;
    size_t failed_index;
    aur_result result;
    uint64_t done;
} shared_state;

static void record(shared_state *state, const aur_parallel_options *options, size_t count, size_t index,
                   aur_result result) {
#pragma omp critical(aur_parallel_record)
    {
        if (result != AUR_OK && index < state->failed_index) {
            state->failed_index = index;
            state->result = result;
            atomic_store(&state->stop, true);
        }
        ++state->done;
        if (result == AUR_OK && !atomic_load(&state->stop) && options->progress.function != NULL &&
            options->progress.function(options->progress.user, options->what, state->done, count) != 0) {
            state->result = AUR_ERROR_CANCELLED;
            atomic_store(&state->stop, true);
        }
    }
}

aur_result aur_parallel_for(const aur_parallel_options *options, size_t count, aur_parallel_function function,
                            void *context) {
    static const aur_parallel_options defaults = {0};
    if (options == NULL)
        options = &defaults;
    if (count == 0)
        return AUR_OK;
    size_t threads = aur_parallel_threads(options->threads);
    if (threads > count)
        threads = count;
    shared_state state = {.failed_index = count, .result = AUR_OK};
    atomic_init(&state.stop, false);

#pragma omp parallel num_threads((int)threads)
    {
        const unsigned saved = enter_fast_denormals();
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < count; ++i) {
            if (atomic_load_explicit(&state.stop, memory_order_relaxed))
                continue;
            record(&state, options, count, i, function(context, i));
        }
        leave_fast_denormals(saved);
    }
    return state.result;
}
