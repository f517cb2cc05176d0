#define PRODUCT aur_daylight_product_avx512
#include "lighting/daylight/product_body.h"
