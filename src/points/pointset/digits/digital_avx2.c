#include "points/pointset/digits/digital_body.h"

void aur_digital_run_avx2(aur_digital_run *run, size_t count, bool stream, double *out) {
    run_kernel(run, count, stream, out);
}
