/* OSWA weights at many angles and turns, so that rendering needs no solve: what a table is, and looking it
 * up. */
#include "quadrature/tables/weight_table.h"

#include <stdlib.h>

#include "core/memory.h"
#include "core/simd.h"
#include "quadrature/check.h"
#define BLEND aur_weight_blend_portable
#include "quadrature/tables/blend_body.h"

aur_result aur_weight_table_create(const aur_oswa_options *options, size_t angle_count, size_t rotation_count,
                                   bool solves, aur_weight_table **table, aur_error *error) {
    *table = NULL;
    if (angle_count < 2 || angle_count > 1 << 16 || rotation_count < 1 || rotation_count > 1 << 16)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a table has 2 to 65536 angles and 1 to 65536 rotations, not %zu and %zu",
                        angle_count, rotation_count);
    aur_weight_table *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    const aur_result result = aur_oswa_create_for(options, solves, &created->oswa, error);
    if (result != AUR_OK) {
        free(created);
        return result;
    }
    created->angle_count = angle_count;
    created->rotation_count = rotation_count;
    created->size = aur_oswa_size(created->oswa);
    created->apart = aur_oswa_hides(created->oswa);
    created->blend = AUR_KERNEL_HERE(aur_weight_blend);
    *table = created;
    return AUR_OK;
}

aur_result aur_weight_table_check_memory(const aur_weight_table *table, aur_error *error) {
    const double bytes = 2.0 * (double)aur_weight_table_rows(table) * (double)table->size * sizeof(float);
    if (bytes <= aur_machine_memory())
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_MEMORY, "a table of %zu angles and %zu rotations takes %.3g GB",
                    table->angle_count, table->rotation_count, 1e-9 * bytes);
}

aur_result aur_weight_table_allocate(aur_weight_table *table, aur_error *error) {
    const aur_result result = aur_weight_table_check_memory(table, error);
    if (result != AUR_OK)
        return result;
    table->weights = malloc(2 * aur_weight_table_rows(table) * table->size * sizeof *table->weights);
    table->masses = malloc(aur_weight_table_mass_count(table) * sizeof *table->masses);
    return table->weights != NULL && table->masses != NULL ? AUR_OK : aur_fail_memory(error);
}

void aur_weight_table_destroy(aur_weight_table *table) {
    if (table == NULL)
        return;
    aur_oswa_destroy(table->oswa);
    free(table->first);
    free(table->start);
    free(table->weights);
    free(table->masses);
    free(table);
}

const aur_oswa_options *aur_weight_table_options(const aur_weight_table *table) {
    return &table->oswa->options;
}

size_t aur_weight_table_angles(const aur_weight_table *table) {
    return table->angle_count;
}

size_t aur_weight_table_rotations(const aur_weight_table *table) {
    return table->rotation_count;
}

size_t aur_weight_table_rows(const aur_weight_table *table) {
    return table->apart ? 2 * table->piece_count : table->rotation_count * table->angle_count;
}

static aur_result check_rotation(const aur_weight_table *table, size_t rotation, aur_error *error) {
    return rotation < table->rotation_count
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "the table has rotations 0 to %zu, not %zu",
                          table->rotation_count - 1, rotation);
}

aur_result aur_weight_table_points(const aur_weight_table *table, double radians, size_t rotation,
                                   bool mirrored, size_t capacity, double *xyz, aur_error *error) {
    double turns[2];
    aur_oswa_turns(table->oswa->options.seed, rotation, turns);
    const aur_result result = check_rotation(table, rotation, error);
    return result == AUR_OK ? aur_oswa_points(table->oswa, radians, turns, mirrored, capacity, xyz, error)
                            : result;
}

/* Where an angle lies among `steps` equal parts of [0, pi/2]: the part's number, and how far in it. */
static size_t locate_step(size_t steps, float radians, float *part) {
    const float last = (float)steps;
    float position = radians * (last / (0.5f * AUR_PI_F));
    position = position > 0.0f ? (position < last ? position : last) : 0.0f; /* NaN: 0 */
    size_t index = (size_t)position;
    index -= index == steps;
    *part = position - (float)index;
    return index;
}

size_t aur_weight_table_locate(const aur_weight_table *table, size_t rotation, float radians, float *part) {
    const size_t index = locate_step(table->angle_count - 1, radians, part);
    if (!table->apart)
        return rotation * table->angle_count + index;
    const size_t place = rotation * (table->angle_count - 1) + index;
    const uint32_t *const first = table->first + place;
    size_t piece = first[0];
    while (piece + 1 < first[1] && table->start[piece + 1] <= radians)
        ++piece;
    if (first[1] - first[0] > 1) {
        const float start = table->start[piece];
        const float end =
            piece + 1 < first[1] ? table->start[piece + 1] : (float)aur_weight_table_angle(table, index + 1);
        const float way = (radians - start) / (end - start);
        *part = way > 0.0f ? (way < 1.0f ? way : 1.0f) : 0.0f; /* a piece without width: 0 */
    }
    return 2 * piece;
}

aur_result aur_weight_table_look_up(const aur_weight_table *table, size_t lobe, size_t rotation,
                                    double radians, size_t capacity, float *weights, aur_error *error) {
    if (lobe > 1)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a table has the lobes 0 and 1, not %zu", lobe);
    aur_result result = check_rotation(table, rotation, error);
    if (result == AUR_OK)
        result = aur_check_angle(radians, error);
    if (result == AUR_OK)
        result = aur_check_capacity(table->size, capacity, error);
    if (result != AUR_OK)
        return result;
    float part;
    const size_t row = aur_weight_table_locate(table, rotation, (float)radians, &part);
    const float *const below = aur_weight_table_row(table, row) + lobe * table->size;
    table->blend(table->size, below, below + 2 * table->size, part, weights);
    return AUR_OK;
}

double aur_weight_table_mass(const aur_weight_table *table, double radians) {
    float part;
    const size_t step = locate_step(aur_weight_table_mass_count(table) - 1, (float)radians, &part);
    return (double)(table->masses[step] + part * (table->masses[step + 1] - table->masses[step]));
}
