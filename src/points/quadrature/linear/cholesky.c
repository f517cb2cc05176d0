#include "points/base/simd.h"

#define LANES 2
#define ROWS 4
#include "points/quadrature/linear/cholesky_body.h"

const aur_cholesky aur_cholesky_portable = {factor, solve};

const aur_cholesky *aur_cholesky_best(void) {
    return &AUR_KERNEL_HERE(aur_cholesky);
}

size_t aur_cholesky_work(size_t size) {
    /* Strips of the widest tile, NARROW rows, as deep as the widest block of columns. */
    return (size + NARROW) * (size > WIDE ? WIDE : NARROW);
}
