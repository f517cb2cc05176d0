#include "core/simd.h"

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

aur_isa aur_isa_available(void) {
    return limited(processor_isa(), getenv("AUREOLE_ISA"));
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
