/* Sobol's generator matrices. */
#ifndef AUR_POINTSET_SOBOL_H
#define AUR_POINTSET_SOBOL_H

#include <stddef.h>
#include <stdint.h>

enum { AUR_SOBOL_COLUMNS = 64 };

/* Column k is what bit k of the index contributes to the coordinate. dimension < AUR_SOBOL_DIMENSIONS. */
void aur_sobol_matrix(size_t dimension, uint64_t columns[AUR_SOBOL_COLUMNS]);

#endif
