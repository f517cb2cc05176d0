#include "core/simd.h"

#define LANES 2
#define ROWS 4
#include "quadrature/cholesky_body.h"

const aur_cholesky aur_cholesky_portable = {factor, solve};

const aur_cholesky *aur_cholesky_best(void) {
#if defined(__x86_64__)
    const aur_isa isa = aur_isa_available();
    if (isa == AUR_ISA_AVX512)
        return &aur_cholesky_avx512;
    if (isa == AUR_ISA_AVX2)
        return &aur_cholesky_avx2;
#endif
    return &aur_cholesky_portable;
}

size_t aur_cholesky_work(size_t size) {
    /* Strips of the widest tile, NARROW rows, as deep as the widest block of columns. */
    return (size + NARROW) * (size > WIDE ? WIDE : NARROW);
}
