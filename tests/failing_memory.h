/* Simulated out-of-memory conditions. Programs named test_*_memory are linked so that calls of the allocating
 * functions, also from the library, come here first. */
#pragma once

#include <stdatomic.h>
#include <stdlib.h>

/* Allocations until one fails; 0: none does. */
static atomic_size_t allocations_left;

/* Lets allocation number `nth` from now on fail, counted from 1, and no other; 0: none. */
static inline void fail_allocation(size_t nth) {
    atomic_store(&allocations_left, nth);
}

static inline int allocation_fails(void) {
    size_t left = atomic_load(&allocations_left);
    while (left > 0 && !atomic_compare_exchange_weak(&allocations_left, &left, left - 1)) {
    }
    return left == 1;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

void *__wrap_malloc(size_t size) {
    return allocation_fails() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
    return allocation_fails() ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size) {
    return allocation_fails() ? NULL : __real_realloc(memory, size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return allocation_fails() ? NULL : __real_aligned_alloc(alignment, size);
}
