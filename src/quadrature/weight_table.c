/* OSWA weights at many angles and turns, so that rendering needs no solve. */
#include "quadrature/weight_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/vector.h"

aur_result aur_weight_table_allocate(const aur_oswa_options *options, size_t angle_count,
                                     size_t rotation_count, bool solves, aur_weight_table **table,
                                     aur_error *error) {
    *table = NULL;
    if (angle_count < 2 || angle_count > 1 << 16 || rotation_count < 1 || rotation_count > 1 << 16)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a table has 2 to 65536 angles and 1 to 65536 rotations, not %zu and %zu",
                        angle_count, rotation_count);
    aur_weight_table *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    const aur_result result = aur_oswa_create_for(options, solves, &created->oswa, error);
    if (result != AUR_OK) {
        free(created);
        return result;
    }
    created->angle_count = angle_count;
    created->rotation_count = rotation_count;
    created->size = aur_oswa_size(created->oswa);
    created->apart = created->oswa->options.clipped || created->oswa->lobe[1].kind == AUR_LOBE_GGX;
    size_t floats;
    if (__builtin_mul_overflow(aur_weight_table_rows(created), 2 * created->size, &floats) ||
        floats > SIZE_MAX / sizeof(float))
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

/* The two rows, one a lobe, at the lower or the upper end of an interval of angles. */
static float *rows(const aur_weight_table *table, size_t rotation, size_t interval, size_t end) {
    return table->weights + aur_weight_table_row(table, rotation, interval, end) * 2 * table->size;
}

typedef struct build {
    aur_weight_table *table;
    aur_error *errors; /* one an angle */
} build;

/* What one angle needs of memory. */
typedef struct angle_work {
    double *scratch, *weights;
    bool *here, *neighbour, *taken, *solved;
} angle_work;

static aur_result solve_end(const aur_weight_table *table, const aur_oswa_angle *angle, const double turns[2],
                            const angle_work *work, float *target, aur_error *error) {
    const aur_result result =
        aur_oswa_solve_at(table->oswa, angle, turns, work->taken, work->scratch, work->weights, error);
    for (size_t i = 0; i < 2 * table->size && result == AUR_OK; ++i)
        target[i] = (float)work->weights[i];
    return result;
}

/* The rows that stand at one angle: the upper end of the interval before it and the lower end of that after
 * it. Both ends of an interval take the samples that are visible at both, so that between them no sample
 * appears or vanishes. */
static aur_result build_rotation(const aur_weight_table *table, size_t index, size_t rotation,
                                 const aur_oswa_angle *angle, const angle_work *work, aur_error *error) {
    const size_t intervals = table->angle_count - 1;
    double turns[2];
    aur_weight_table_turns(table, rotation, turns);
    aur_oswa_visible(table->oswa, angle->radians, turns, work->scratch, work->here);
    const float *done = NULL;
    for (size_t end = 2; end-- > 0;) {
        if (index < end || index - end >= intervals)
            continue;
        const size_t neighbour = end == 1 ? index - 1 : index + 1;
        float *const target = rows(table, rotation, index - end, end);
        aur_oswa_visible(table->oswa, aur_weight_table_angle(table, neighbour), turns, work->scratch,
                         work->neighbour);
        for (size_t i = 0; i < table->size; ++i)
            work->taken[i] = work->here[i] && work->neighbour[i];
        if (done != NULL && memcmp(work->taken, work->solved, table->size * sizeof *work->taken) == 0) {
            if (done != target)
                memcpy(target, done, 2 * table->size * sizeof *target);
            continue;
        }
        const aur_result result = solve_end(table, angle, turns, work, target, error);
        if (result != AUR_OK)
            return result;
        memcpy(work->solved, work->taken, table->size * sizeof *work->taken);
        done = target;
    }
    return AUR_OK;
}

static aur_result build_angle(void *context, size_t index) {
    const build *const work = context;
    aur_weight_table *const table = work->table;
    aur_error *const error = &work->errors[index];
    const size_t doubles = aur_oswa_scratch(table->oswa);
    double *const scratch = malloc((doubles + 2 * table->size) * sizeof *scratch);
    bool *const flags = malloc(4 * table->size * sizeof *flags);
    aur_oswa_angle angle;
    aur_result result = aur_oswa_angle_init(table->oswa, aur_weight_table_angle(table, index), &angle, error);
    if (result == AUR_OK && (scratch == NULL || flags == NULL))
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (result == AUR_OK) {
        const angle_work parts = {scratch,
                                  scratch + doubles,
                                  flags,
                                  flags + table->size,
                                  flags + 2 * table->size,
                                  flags + 3 * table->size};
        table->masses[index] = (float)angle.mass;
        for (size_t rotation = 0; rotation < table->rotation_count && result == AUR_OK; ++rotation)
            result = build_rotation(table, index, rotation, &angle, &parts, error);
    }
    free(scratch);
    free(flags);
    aur_oswa_angle_release(&angle);
    return result;
}

aur_result aur_weight_table_build(const aur_oswa_options *options, size_t angle_count, size_t rotation_count,
                                  size_t threads, const aur_progress *progress, aur_weight_table **table,
                                  aur_error *error) {
    aur_result result = aur_weight_table_allocate(options, angle_count, rotation_count, true, table, error);
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
    const float *restrict below = rows(table, rotation, angle, 0) + lobe * table->size;
    const float *restrict above = rows(table, rotation, angle, 1) + lobe * table->size;
    float *restrict target = weights;
    for (size_t i = 0; i < table->size; ++i)
        target[i] = below[i] + part * (above[i] - below[i]);
}

float aur_weight_table_mass(const aur_weight_table *table, float radians) {
    float part;
    const size_t angle = interval(table, radians, &part);
    return table->masses[angle] + part * (table->masses[angle + 1] - table->masses[angle]);
}
