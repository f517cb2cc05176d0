#include "core/simd.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static aur_isa processor_isa(void) {
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return AUR_ISA_AVX512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return AUR_ISA_AVX2;
#endif
    return AUR_ISA_PORTABLE;
}

static aur_isa limited(aur_isa processor, const char *limit) {
    if (limit == NULL)
        return processor;
    if (strcmp(limit, "portable") == 0)
        return AUR_ISA_PORTABLE;
    if (strcmp(limit, "avx2") == 0 && processor > AUR_ISA_AVX2)
        return AUR_ISA_AVX2;
    return processor;
}

/* The answer, or -1 while nobody has asked: the environment is read once, since kernels are chosen often. Two
 * threads that ask first at once find out the same. */
static atomic_int known = -1;

void aur_isa_ask_again(void) {
    atomic_store(&known, -1);
}

aur_isa aur_isa_available(void) {
    int isa = atomic_load_explicit(&known, memory_order_relaxed);
    if (isa < 0) {
        isa = (int)limited(processor_isa(), getenv("AUREOLE_ISA"));
        atomic_store_explicit(&known, isa, memory_order_relaxed);
    }
    return (aur_isa)isa;
}

aur_isa aur_isa_of_rays(void) {
    const char *const limit = getenv("AUREOLE_EMBREE_ISA");
    return limit == NULL ? aur_isa_available() : limited(processor_isa(), limit);
}

const char *aur_isa_name(aur_isa isa) {
    switch (isa) {
    case AUR_ISA_PORTABLE:
        return "portable";
    case AUR_ISA_AVX2:
        return "avx2";
    case AUR_ISA_AVX512:
        return "avx512";
    }
    return "unknown";
}
