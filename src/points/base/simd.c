#include "points/base/simd.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "points/base/names.h"

/* From the narrowest to the widest. */
static const aur_isa sets[] = {AUR_ISA_PORTABLE, AUR_ISA_AVX2, AUR_ISA_AVX512};
static const char *const names[] = {"portable", "avx2", "avx512"};
enum { SET_COUNT = sizeof sets / sizeof sets[0] };

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

/* An unknown name is no limit. */
static aur_isa limited(aur_isa processor, const char *limit) {
    const size_t found = limit == NULL ? SET_COUNT : aur_names_find(aur_names_of(SET_COUNT, names), limit);
    return found < SET_COUNT && sets[found] < processor ? sets[found] : processor;
}

/* The cached result, or -1 before the first call: the environment is read once, since kernels are chosen
 * often. Threads that call it first at the same time compute the same value. */
static atomic_int cached = -1;

void aur_isa_reset(void) {
    atomic_store(&cached, -1);
}

aur_isa aur_isa_available(void) {
    int isa = atomic_load_explicit(&cached, memory_order_relaxed);
    if (isa < 0) {
        isa = (int)limited(processor_isa(), getenv("AUREOLE_ISA"));
        atomic_store_explicit(&cached, isa, memory_order_relaxed);
    }
    return (aur_isa)isa;
}

aur_isa aur_isa_of_rays(void) {
    const char *const limit = getenv("AUREOLE_EMBREE_ISA");
    return limit == NULL ? aur_isa_available() : limited(processor_isa(), limit);
}

const char *aur_isa_name(aur_isa isa) {
    for (size_t i = 0; i < SET_COUNT; ++i)
        if (sets[i] == isa)
            return names[i];
    return "unknown";
}

aur_result aur_isa_check(const char *name, aur_error *error) {
    size_t found;
    const aur_result result = aur_names_choose(aur_names_of(SET_COUNT, names), "instruction set", name,
                                               (aur_location){0}, &found, error);
    if (result != AUR_OK)
        return result;
    if (sets[found] > processor_isa())
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "this processor has no %s instructions; the widest set that it has is %s", name,
                        aur_isa_name(processor_isa()));
    return AUR_OK;
}
