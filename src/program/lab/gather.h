/* The lab's own integrator, with the keys that reproduce Marques 2013, 2018 and 2019. `aureole render` takes
 * it too. */
#pragma once

#include <aureole-render/gather.h>

extern const aur_gather_integrator lab_finalgather;
/* A table of it alone, for help. */
extern const aur_table lab_integrator_table;
