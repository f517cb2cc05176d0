#include "points/base/simd.h"
#define PRODUCT aur_daylight_product_portable
#include "lighting/daylight/product_body.h"

aur_daylight_product *aur_daylight_product_here(void) {
    return &AUR_KERNEL_HERE(aur_daylight_product);
}
