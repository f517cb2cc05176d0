/* The one way in which Aureole uses threads. Work items are independent; a result must never depend on which
 * thread ran an item or when (architecture, law 1). */
#ifndef AUR_CORE_PARALLEL_H
#define AUR_CORE_PARALLEL_H

#include <aureole/core.h>

/* Does item `index` of the work. Called from several threads at once, each index once. */
typedef aur_result (*aur_parallel_function)(void *context, size_t index);

typedef struct aur_parallel_options {
    size_t threads;        /* 0: as many as the machine offers */
    const char *what;      /* names the work in progress reports */
    aur_progress progress; /* calls are serialised; done counts finished items */
} aur_parallel_options;

/* Runs items 0..count-1. Every thread flushes denormals to zero while it works (Embree asks for it). When
 * items fail, the result of the failing item with the lowest index that was run is returned and no new item
 * starts. */
aur_result aur_parallel_for(const aur_parallel_options *options, size_t count, aur_parallel_function function,
                            void *context);

/* The number of threads that `threads` (0: all) stands for. */
size_t aur_parallel_threads(size_t threads);

#endif
