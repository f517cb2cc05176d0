/* Loaded before Embree (LD_PRELOAD), counts the rays that it is given to trace, one by one and in packets,
 * and writes their number to the file that RAY_COUNTER names. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

static atomic_ullong rays;

/* Embree 3 and 4 have other arguments, all of them pointers: three, or four after the lanes of a packet. */
#define SINGLE(name)                                                                                         \
    void name(void *a, void *b, void *c);                                                                    \
    void name(void *a, void *b, void *c) {                                                                   \
        void (*next)(void *, void *, void *);                                                                \
        *(void **)&next = dlsym(RTLD_NEXT, #name);                                                           \
        atomic_fetch_add(&rays, 1);                                                                          \
        next(a, b, c);                                                                                       \
    }
#define PACKET(name, size)                                                                                   \
    void name(const int *valid, void *a, void *b, void *c);                                                  \
    void name(const int *valid, void *a, void *b, void *c) {                                                 \
        void (*next)(const int *, void *, void *, void *);                                                   \
        *(void **)&next = dlsym(RTLD_NEXT, #name);                                                           \
        for (int k = 0; k < size; ++k)                                                                       \
            atomic_fetch_add(&rays, valid[k] != 0);                                                          \
        next(valid, a, b, c);                                                                                \
    }

SINGLE(rtcIntersect1)
SINGLE(rtcOccluded1)
PACKET(rtcIntersect4, 4)
PACKET(rtcOccluded4, 4)
PACKET(rtcIntersect8, 8)
PACKET(rtcOccluded8, 8)
PACKET(rtcIntersect16, 16)
PACKET(rtcOccluded16, 16)

__attribute__((destructor)) static void report(void) {
    const char *const path = getenv("RAY_COUNTER");
    FILE *const file = path != NULL ? fopen(path, "w") : NULL;
    if (file == NULL)
        return;
    fprintf(file, "%llu\n", (unsigned long long)atomic_load(&rays));
    fclose(file);
}
