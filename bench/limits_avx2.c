#include "limits_body.h"

const bench_kernels bench_kernels_avx2 = {fill,    fill_stream, copy,      copy_stream, read,
                                          fma_f32, fma_f64,     pairs_f32, pairs_f64,   WIDTH};
