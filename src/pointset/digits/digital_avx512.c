#include "pointset/digits/digital_body.h"

void aur_digital_run_avx512(const aur_digital_run *run) {
    run_kernel(run);
}
