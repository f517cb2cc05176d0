#include "points/quality/split/near_body.h"

const aur_near_kernel aur_near_avx2 = {row};
