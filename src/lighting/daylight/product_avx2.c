#define PRODUCT aur_daylight_product_avx2
#include "lighting/daylight/product_body.h"
