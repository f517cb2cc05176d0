/* The rows of a table of weights, for renderers that keep them in another layout. The functions are exported
 * by the library for the rooms above, but they are no part of its interface. */
#pragma once

#include <aureole/quadrature.h>

AUR_API size_t aur_weight_table_row_count(const aur_weight_table *table);
/* Row `row` has the weights of the first lobe and, behind them, of the mirror lobe, 2 * (count +
 * mirror_count) in all; it belongs to the table. */
AUR_API const float *aur_weight_table_row(const aur_weight_table *table, size_t row);
/* The row r at the lower end of where an angle (clamped to [0, pi/2]) lies; the weights there are (1 - *part)
 * times row r plus *part times row r + 1. `rotation` must be in the table. */
AUR_API size_t aur_weight_table_locate(const aur_weight_table *table, size_t rotation, float radians,
                                       float *part);
