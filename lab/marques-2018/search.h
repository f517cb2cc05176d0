/* Search for settings that reproduce the gains of section 5.3, which its text leaves open. */
#pragma once

#include "samples.h"

/* Fills the table "search" and a note. */
aur_result lab_gains_search(lab_run *run, aur_error *error);
