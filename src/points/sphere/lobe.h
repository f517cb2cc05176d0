/* What the library checks of a lobe that it is given. */
#pragma once

#include <aureole/sphere.h>

/* Errors: ARGUMENT when a member is out of its range. */
aur_result aur_lobe_check(const aur_lobe *lobe, aur_error *error);
