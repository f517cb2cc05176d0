/* Adaptive gathering (Marques 2019, section 6.2): adds levels of an extensible grid while the contrast of the
 * samples is above a threshold. */
#pragma once

#include "settings.h"

enum { LAB_LEVEL_CAPACITY = 8 };

extern const aur_gather_method lab_gather_by_levels;
/* Errors: options that exclude adaptive gathering. */
aur_result lab_levels_check(const lab_gather_settings *options, aur_error *error);
/* Warns of parameters that only adaptive gathering uses. */
void lab_levels_warn_unused(const lab_gather_settings *options, aur_warnings warnings);
