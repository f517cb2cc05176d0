/* The Utah teapot (Martin Newell 1975). */
#pragma once

#include "vec.h"

enum { TEAPOT_PATCH_COUNT = 32 };

typedef struct teapot_patch {
    vec control[4][4]; /* [u][v]; z up */
} teapot_patch;

void teapot_patches(teapot_patch patches[TEAPOT_PATCH_COUNT]);
/* Position and outward normal (zero at the poles, where the patch has none). */
void teapot_evaluate(const teapot_patch *source, double u, double v, vec *position, vec *normal);
