#include "points/quadrature/exact/transform_body.h"

const aur_transform_kernel aur_transform_kernel_avx2 = {analyse, synthesise, analyse_order, synthesise_order,
                                                        dots};
