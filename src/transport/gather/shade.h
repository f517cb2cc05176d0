/* The light that leaves sixteen places towards the eye. */
#pragma once

#include "transport/gather/scratch.h"
#include "transport/gather/sums.h"

/* Adds what the places reflect, by all lobes but specular ones, of direct and of gathered light. */
void aur_gather_shade(const aur_gather_plan *plan, const aur_gather_places *places, aur_gather_sums *sums,
                      aur_gather_scratch *scratch);
