/* The implementation of a table of OSWA weights, for its builder, its files and renderers that store its rows
 * in another layout. Immutable once built or read. */
#pragma once

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/base/vector.h"
#include "points/quadrature/tables/oswa.h"

/* Blends `count` numbers of two rows: (1 - part) times the first plus `part` times the second. */
typedef void aur_weight_blend(size_t count, const float *below, const float *above, float part,
                              float *target);
AUR_KERNELS(aur_weight_blend, aur_weight_blend);

/* A row has the weights of all lobes at one angle. Each rotation has separate rows for each roughness: a
 * *slot* is one of these pairs, numbered roughness by roughness. If samples can be hidden (`apart`), the
 * intervals between angles are divided where a sample crosses the horizon, so that the same samples are used
 * within a piece and the weights are smooth; the two ends of a piece then have separate rows. Otherwise
 * neighbouring intervals share a row. */
struct aur_weight_table {
    aur_oswa *oswa; /* the patterns */
    size_t angle_count, roughness_count, rotation_count, size;
    bool apart;
    size_t piece_count;
    /* Apart: the first piece of each interval, slot by slot, and one past the last. */
    uint32_t *first;
    float *start;   /* apart: the angle where each piece begins */
    float *weights; /* row, lobe, sample */
    /* Masses of the mirror lobe, at MASS_STEPS steps per interval, since they change rapidly near the
     * horizon. One row for each roughness. */
    float *masses;
    aur_weight_blend *blend; /* for the instruction set of this machine */
};

enum { AUR_WEIGHT_TABLE_MASS_STEPS = 8 };

static inline size_t aur_weight_table_mass_count(const aur_weight_table *table) {
    return (table->angle_count - 1) * AUR_WEIGHT_TABLE_MASS_STEPS + 1;
}

static inline size_t aur_weight_table_slots(const aur_weight_table *table) {
    return table->roughness_count * table->rotation_count;
}

static inline size_t aur_weight_table_intervals(const aur_weight_table *table) {
    return aur_weight_table_slots(table) * (table->angle_count - 1);
}

/* The number of elements of a row. */
static inline size_t aur_weight_table_width(const aur_weight_table *table) {
    return aur_oswa_lobes(table->oswa) * table->size;
}

/* The view at an angle and at a roughness of the table. */
aur_oswa_view aur_weight_table_view(const aur_weight_table *table, size_t roughness, double radians);

static inline double aur_weight_table_angle(const aur_weight_table *table, size_t index) {
    return 0.5 * AUR_PI * (double)index / (double)(table->angle_count - 1);
}

/* aur_weight_table_row, for the builder. */
static inline float *aur_weight_table_mutable_row(const aur_weight_table *table, size_t row) {
    return table->weights + row * aur_weight_table_width(table);
}

/* A table with patterns but neither pieces nor weights yet; `solves` as for aur_oswa_create_for. */
aur_result aur_weight_table_create(const aur_oswa_options *options, const aur_weight_table_grid *grid,
                                   bool solves, aur_weight_table **table, aur_error *error);
/* Checks that the machine has memory for the weights, once piece_count is known, and allocates it. */
aur_result aur_weight_table_check_memory(const aur_weight_table *table, aur_error *error);
aur_result aur_weight_table_allocate(aur_weight_table *table, aur_error *error);

/* Reads a table from the bytes of a file: data[size] is 0; the lines of the header are terminated in place.
 * `name` is for messages. On failure *table is NULL. */
aur_result aur_weight_table_parse(const char *name, size_t size, char *data, const aur_oswa_options *expected,
                                  aur_weight_table **table, aur_error *error);

/* The bytes of the file of a table, from malloc. Errors: as aur_weight_table_save. */
aur_result aur_weight_table_print(const aur_weight_table *table, size_t *size, void **data, aur_error *error);

enum { AUR_WEIGHT_TABLE_KEY_CAPACITY = 4096 };

/* A text of everything that determines a table; all fields of the grid are used. Errors: ARGUMENT. */
aur_result aur_weight_table_key(const aur_oswa_options *options, const aur_weight_table_grid *grid,
                                uint64_t build, char key[AUR_WEIGHT_TABLE_KEY_CAPACITY]);

/* The checksum at the end of a file, of all bytes before it. */
uint64_t aur_weight_table_check_sum(const char *data, size_t size);
