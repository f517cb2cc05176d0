/* What a table of weights holds. */
#ifndef AUR_QUADRATURE_WEIGHT_TABLE_H
#define AUR_QUADRATURE_WEIGHT_TABLE_H

#include "quadrature/oswa.h"

struct aur_weight_table {
    aur_oswa *oswa; /* the patterns */
    size_t angle_count, rotation_count, size;
    float *weights; /* rotation, angle, lobe, sample */
    float *masses;  /* of the mirror lobe at each angle */
};

/* A table with patterns but no weights yet. */
aur_result aur_weight_table_allocate(const aur_oswa_options *options, size_t angle_count,
                                     size_t rotation_count, aur_weight_table **table, aur_error *error);

#endif
