#define LANES 8
#define ROWS 8
#include "points/quadrature/linear/cholesky_body.h"

const aur_cholesky aur_cholesky_avx512 = {factor, solve};
