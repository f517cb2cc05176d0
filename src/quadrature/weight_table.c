/* OSWA weights at many angles and turns, so that rendering needs no solve. */
#include "quadrature/weight_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/vector.h"

aur_result aur_weight_table_allocate(const aur_oswa_options *options, size_t angle_count,
                                     size_t rotation_count, aur_weight_table **table, aur_error *error) {
    *table = NULL;
    if (angle_count < 2 || angle_count > 1 << 16 || rotation_count < 1 || rotation_count > 1 << 16)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a table has 2 to 65536 angles and 1 to 65536 rotations, not %zu and %zu",
                        angle_count, rotation_count);
    aur_weight_table *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    const aur_result result = aur_oswa_create(options, &created->oswa, error);
    if (result != AUR_OK) {
        free(created);
        return result;
    }
    created->angle_count = angle_count;
    created->rotation_count = rotation_count;
    created->size = aur_oswa_size(created->oswa);
    const size_t entries = angle_count * rotation_count; /* at most 2^32 */
    size_t floats;
    if (__builtin_mul_overflow(entries, 2 * created->size, &floats) || floats > SIZE_MAX / sizeof(float))
        floats = SIZE_MAX / sizeof(float);
    created->weights = malloc(floats * sizeof *created->weights);
    created->masses = malloc(angle_count * sizeof *created->masses);
    if (created->weights == NULL || created->masses == NULL) {
        aur_weight_table_destroy(created);
        return aur_fail(error, AUR_ERROR_MEMORY, "a table of %zu angles and %zu rotations takes %.3g GB",
                        angle_count, rotation_count, 1e-9 * (double)floats * sizeof(float));
    }
    *table = created;
    return AUR_OK;
}

void aur_weight_table_destroy(aur_weight_table *table) {
    if (table == NULL)
        return;
    aur_oswa_destroy(table->oswa);
    free(table->weights);
    free(table->masses);
    free(table);
}

void aur_weight_table_turns(const aur_weight_table *table, size_t rotation, double turns[2]) {
    const uint64_t seed = table->oswa->options.seed;
    for (uint64_t which = 0; which < 2; ++which)
        turns[which] = aur_unit_double(aur_hash4(UINT64_C(0x7475726e), seed, rotation, which));
}

/* The weights of one lobe and rotation at one angle: both lobes of a rotation lie side by side for all
 * angles. */
static float *entry(const aur_weight_table *table, size_t lobe, size_t rotation, size_t angle) {
    return table->weights + ((rotation * table->angle_count + angle) * 2 + lobe) * table->size;
}

typedef struct build {
    aur_weight_table *table;
    aur_error *errors; /* one an angle */
} build;

static aur_result build_angle(void *context, size_t index) {
    const build *const work = context;
    aur_weight_table *const table = work->table;
    aur_error *const error = &work->errors[index];
    const double radians = 0.5 * AUR_PI * (double)index / (double)(table->angle_count - 1);
    aur_oswa_angle angle;
    aur_result result = aur_oswa_angle_init(table->oswa, radians, &angle, error);
    double *const scratch = malloc((aur_oswa_scratch(table->oswa) + 2 * table->size) * sizeof *scratch);
    if (result == AUR_OK && scratch == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    table->masses[index] = (float)angle.mass;
    for (size_t rotation = 0; rotation < table->rotation_count && result == AUR_OK; ++rotation) {
        double *const weights = scratch + aur_oswa_scratch(table->oswa);
        double turns[2];
        aur_weight_table_turns(table, rotation, turns);
        result = aur_oswa_solve_at(table->oswa, &angle, turns, scratch, weights, error);
        float *const target = entry(table, 0, rotation, index);
        for (size_t i = 0; i < 2 * table->size && result == AUR_OK; ++i)
            target[i] = (float)weights[i];
    }
    free(scratch);
    aur_oswa_angle_release(&angle);
    return result;
}

aur_result aur_weight_table_build(const aur_oswa_options *options, size_t angle_count, size_t rotation_count,
                                  size_t threads, const aur_progress *progress, aur_weight_table **table,
                                  aur_error *error) {
    aur_result result = aur_weight_table_allocate(options, angle_count, rotation_count, table, error);
    if (result != AUR_OK)
        return result;
    build work = {*table, calloc(angle_count, sizeof(aur_error))};
    if (work.errors == NULL) {
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    } else {
        const aur_parallel_options parallel = {.threads = threads,
                                               .what = "weights",
                                               .progress = progress != NULL ? *progress : (aur_progress){0}};
        result = aur_parallel_for(&parallel, angle_count, build_angle, &work);
    }
    if (result != AUR_OK) {
        aur_fail(error, result, "%s", aur_result_string(result));
        for (size_t i = 0; work.errors != NULL && i < angle_count; ++i) {
            if (work.errors[i].result == result && error != NULL) {
                *error = work.errors[i];
                break;
            }
        }
        aur_weight_table_destroy(*table);
        *table = NULL;
    }
    free(work.errors);
    return result;
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

void aur_weight_table_points(const aur_weight_table *table, double radians, size_t rotation, int mirrored,
                             double *xyz) {
    double turns[2];
    aur_weight_table_turns(table, rotation, turns);
    aur_oswa_points(table->oswa, radians, turns, mirrored, xyz);
}

/* The angle below and the part of the way to the next. */
static size_t interval(const aur_weight_table *table, float radians, float *part) {
    const float last = (float)(table->angle_count - 1);
    float position = radians * (last / (0.5f * AUR_PI_F));
    position = position > 0.0f ? (position < last ? position : last) : 0.0f; /* NaN: 0 */
    size_t index = (size_t)position;
    index -= index + 1 == table->angle_count;
    *part = position - (float)index;
    return index;
}

void aur_weight_table_look_up(const aur_weight_table *table, size_t lobe, size_t rotation, float radians,
                              float *weights) {
    float part;
    const size_t angle = interval(table, radians, &part);
    const float *restrict below = entry(table, lobe, rotation, angle);
    const float *restrict above = below + 2 * table->size;
    float *restrict target = weights;
    for (size_t i = 0; i < table->size; ++i)
        target[i] = below[i] + part * (above[i] - below[i]);
}

float aur_weight_table_mass(const aur_weight_table *table, float radians) {
    float part;
    const size_t angle = interval(table, radians, &part);
    return table->masses[angle] + part * (table->masses[angle + 1] - table->masses[angle]);
}
