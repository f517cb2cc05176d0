/* Checks of a caller's lobe. */
#pragma once

#include <aureole/sphere.h>
#include <stdbool.h>

/* Whether its points are reflections by visible normals. */
static inline bool aur_lobe_reflects(const aur_lobe *lobe) {
    return lobe->kind == AUR_LOBE_GGX || lobe->kind == AUR_LOBE_VISIBLE;
}

/* Errors: ARGUMENT when a member is out of its range. */
aur_result aur_lobe_check(const aur_lobe *lobe, aur_error *error);
