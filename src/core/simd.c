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

aur_isa aur_isa_available(void) {
    const aur_isa processor = processor_isa();
    const char *limit = getenv("AUREOLE_ISA");
    if (limit == NULL)
        return processor;
    if (strcmp(limit, "portable") == 0)
        return AUR_ISA_PORTABLE;
    if (strcmp(limit, "avx2") == 0 && processor > AUR_ISA_AVX2)
        return AUR_ISA_AVX2;
    return processor;
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
