/* The lab's integrator, with the parameters that reproduce Marques 2013, 2018 and 2019. `aureole render`
 * accepts it too. */
#pragma once

#include <aureole-render/gather.h>

extern const aur_gather_integrator lab_finalgather;
/* A table with only this integrator, for help. */
extern const aur_table lab_integrator_table;
