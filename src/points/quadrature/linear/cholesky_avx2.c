#define LANES 4
#define ROWS 4
#include "points/quadrature/linear/cholesky_body.h"

const aur_cholesky aur_cholesky_avx2 = {factor, solve};
