/* What a table of weights holds. */
#ifndef AUR_QUADRATURE_WEIGHT_TABLE_H
#define AUR_QUADRATURE_WEIGHT_TABLE_H

#include "core/vector.h"
#include "quadrature/oswa.h"

/* A row holds the weights of both lobes at one angle. Where samples can be hidden the two ends of an interval
 * of angles have rows of their own; otherwise neighbouring intervals share one. */
struct aur_weight_table {
    aur_oswa *oswa; /* the patterns */
    size_t angle_count, rotation_count, size;
    bool apart;
    float *weights; /* row, lobe, sample */
    float *masses;  /* of the mirror lobe at each angle */
};

static inline size_t aur_weight_table_row(const aur_weight_table *table, size_t rotation, size_t interval,
                                          size_t end) {
    return table->apart ? (rotation * (table->angle_count - 1) + interval) * 2 + end
                        : rotation * table->angle_count + interval + end;
}

static inline size_t aur_weight_table_rows(const aur_weight_table *table) {
    return table->rotation_count * (table->apart ? 2 * (table->angle_count - 1) : table->angle_count);
}

static inline double aur_weight_table_angle(const aur_weight_table *table, size_t index) {
    return 0.5 * AUR_PI * (double)index / (double)(table->angle_count - 1);
}

/* A table with patterns but no weights yet; `solves` as for aur_oswa_create_for. */
aur_result aur_weight_table_allocate(const aur_oswa_options *options, size_t angle_count,
                                     size_t rotation_count, bool solves, aur_weight_table **table,
                                     aur_error *error);

/* Reads a table from the bytes of a file: data[size] is a zero, and lines of the header are cut there. `name`
 * is for messages. On failure *table is NULL. */
aur_result aur_weight_table_parse(const char *name, size_t size, char *data, const aur_oswa_options *expected,
                                  aur_weight_table **table, aur_error *error);

/* What a file ends with: of all that stands before it. */
uint64_t aur_weight_table_check_sum(const char *data, size_t size);

#endif
