#include "pointset/digits/digital_body.h"

size_t aur_digital_run_avx2(const aur_digital_run *run) {
    return run_kernel(run);
}
