/* Building tables of OSWA weights: where samples cross the horizon, and the solves at both sides. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/memory.h"
#include "core/parallel.h"
#include "quadrature/linear/solve.h"
#include "quadrature/tables/weight_table.h"

typedef struct build {
    aur_weight_table *table;
    aur_error *errors; /* one an angle */
} build;

/* --- pieces: the angles at which samples cross the horizon ------------------------------------------------
 */

/* Where, between two angles, a sample passes from one side of the horizon to the other. */
static double crossing(const aur_weight_table *table, double turns, size_t sample, double below,
                       double above) {
    const bool starts = aur_oswa_height(table->oswa, below, turns, sample) >= 0.0;
    while (above - below > 1e-9) {
        const double middle = 0.5 * (below + above);
        if ((aur_oswa_height(table->oswa, middle, turns, sample) >= 0.0) == starts)
            below = middle;
        else
            above = middle;
    }
    return 0.5 * (below + above);
}

static int ascending(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* A growing list of the angles where pieces begin. */
typedef struct piece_list {
    size_t count, capacity;
    float *start;
} piece_list;

static bool append(piece_list *list, float start) {
    if (list->count == list->capacity) {
        const size_t capacity = 2 * list->capacity + 256;
        float *const grown = realloc(list->start, capacity * sizeof *grown);
        if (grown == NULL)
            return false;
        list->start = grown;
        list->capacity = capacity;
    }
    list->start[list->count++] = start;
    return true;
}

/* The pieces of one rotation. Samples of the first pattern never cross; one of the second that is on one side
 * of the horizon at both ends of an interval is taken not to cross within. */
static bool cut_rotation(const aur_weight_table *table, size_t rotation, bool *sides, uint32_t *first,
                         piece_list *list) {
    const size_t count = table->oswa->count[1];
    double turns[2];
    aur_oswa_turns(table->oswa->options.seed, rotation, turns);
    for (size_t k = 0; k < count; ++k)
        sides[k] = aur_oswa_height(table->oswa, 0.0, turns[1], k) >= 0.0;
    for (size_t i = 0; i + 1 < table->angle_count; ++i) {
        const double below = aur_weight_table_angle(table, i), above = aur_weight_table_angle(table, i + 1);
        first[i] = (uint32_t)list->count;
        if (!append(list, (float)below))
            return false;
        for (size_t k = 0; k < count; ++k) {
            const bool side = aur_oswa_height(table->oswa, above, turns[1], k) >= 0.0;
            if (side != sides[k] && !append(list, (float)crossing(table, turns[1], k, below, above)))
                return false;
            sides[k] = side;
        }
        qsort(list->start + first[i] + 1, list->count - first[i] - 1, sizeof *list->start, ascending);
    }
    return true;
}

static aur_result cut(aur_weight_table *table, aur_error *error) {
    const size_t intervals = aur_weight_table_intervals(table);
    const double bytes = 4.0 * (double)intervals * (double)table->size * sizeof(float);
    if (bytes > aur_machine_memory())
        return aur_fail(error, AUR_ERROR_MEMORY, "a table of %zu angles and %zu rotations takes %.3g GB",
                        table->angle_count, table->rotation_count, 1e-9 * bytes);
    bool *const sides = malloc(table->oswa->count[1] * sizeof *sides);
    piece_list list = {0};
    table->first = malloc((intervals + 1) * sizeof *table->first);
    bool good = sides != NULL && table->first != NULL;
    for (size_t k = 0; k < table->rotation_count && good; ++k)
        good = cut_rotation(table, k, sides, table->first + k * (table->angle_count - 1), &list) &&
               list.count <= UINT32_MAX;
    if (good)
        table->first[intervals] = (uint32_t)list.count;
    free(sides);
    table->start = list.start;
    table->piece_count = list.count;
    return good ? AUR_OK
                : aur_fail(error, AUR_ERROR_MEMORY,
                           "out of memory for the pieces of %zu angles and %zu rotations", table->angle_count,
                           table->rotation_count);
}

/* --- solves -----------------------------------------------------------------------------------------------
 */

/* What one angle needs of memory. */
typedef struct angle_work {
    double *scratch, *weights;
    bool *taken, *solved;
} angle_work;

static float *row_at(const aur_weight_table *table, size_t row) {
    return table->weights + row * 2 * table->size;
}

/* Solves with the samples that work->taken says. */
static aur_result solve_row(const aur_weight_table *table, const aur_oswa_angle *angle, const double turns[2],
                            const angle_work *work, size_t row, aur_error *error) {
    const aur_result result =
        aur_oswa_solve_at(table->oswa, angle, turns, work->taken, work->scratch, work->weights, error);
    float *const target = row_at(table, row);
    for (size_t i = 0; i < 2 * table->size && result == AUR_OK; ++i)
        target[i] = (float)work->weights[i];
    return result;
}

/* The samples that take part in a piece: those above the horizon in its middle. */
static void take(const aur_weight_table *table, size_t index, size_t piece, size_t end, const double turns[2],
                 const angle_work *work) {
    const double start = (double)table->start[piece];
    const double stop =
        piece + 1 < end ? (double)table->start[piece + 1] : aur_weight_table_angle(table, index + 1);
    aur_oswa_visible(table->oswa, 0.5 * (start + stop), turns, work->scratch, work->taken);
}

/* The rows at an angle of the table: at the end of the last piece before it and at the start of the first
 * after it, which are the same where nothing crosses near. */
static aur_result build_at_angle(const aur_weight_table *table, size_t index, size_t rotation,
                                 const aur_oswa_angle *angle, const double turns[2], const angle_work *work,
                                 aur_error *error) {
    const uint32_t *const first = table->first + rotation * (table->angle_count - 1);
    const bool before = index > 0, after = index + 1 < table->angle_count;
    aur_result result = AUR_OK;
    if (before) {
        take(table, index - 1, first[index] - 1, first[index], turns, work);
        result = solve_row(table, angle, turns, work, 2 * (size_t)(first[index] - 1) + 1, error);
        memcpy(work->solved, work->taken, table->size * sizeof *work->taken);
    }
    if (!after || result != AUR_OK)
        return result;
    const size_t row = 2 * (size_t)first[index];
    take(table, index, first[index], first[index + 1], turns, work);
    if (!before || memcmp(work->taken, work->solved, table->size * sizeof *work->taken) != 0)
        return solve_row(table, angle, turns, work, row, error);
    memcpy(row_at(table, row), row_at(table, 2 * (size_t)(first[index] - 1) + 1),
           2 * table->size * sizeof *table->weights);
    return AUR_OK;
}

/* The rows at both sides of every crossing between an angle of the table and the next. */
static aur_result build_crossings(const aur_weight_table *table, size_t index, size_t rotation,
                                  const double turns[2], const angle_work *work, aur_error *error) {
    const uint32_t *const first = table->first + rotation * (table->angle_count - 1) + index;
    aur_result result = AUR_OK;
    for (size_t piece = first[0] + 1; piece < first[1] && result == AUR_OK; ++piece) {
        aur_oswa_angle angle;
        result = aur_oswa_angle_init(table->oswa, (double)table->start[piece], &angle, error);
        for (size_t side = 0; side < 2 && result == AUR_OK; ++side) {
            take(table, index, piece - 1 + side, first[1], turns, work);
            result = solve_row(table, &angle, turns, work, 2 * piece - 1 + side, error);
        }
        aur_oswa_angle_release(&angle);
    }
    return result;
}

static aur_result build_rotation(const aur_weight_table *table, size_t index, size_t rotation,
                                 const aur_oswa_angle *angle, const angle_work *work, aur_error *error) {
    double turns[2];
    aur_oswa_turns(table->oswa->options.seed, rotation, turns);
    if (!table->apart) {
        for (size_t i = 0; i < table->size; ++i)
            work->taken[i] = true;
        return solve_row(table, angle, turns, work, rotation * table->angle_count + index, error);
    }
    const aur_result result = build_at_angle(table, index, rotation, angle, turns, work, error);
    if (result != AUR_OK || index + 1 == table->angle_count)
        return result;
    return build_crossings(table, index, rotation, turns, work, error);
}

/* The mass of the mirror lobe between an angle of the table and the next. */
static aur_result build_masses(const aur_weight_table *table, size_t index, aur_error *error) {
    enum { STEPS = AUR_WEIGHT_TABLE_MASS_STEPS };
    aur_result result = AUR_OK;
    for (size_t step = 1; step < STEPS && index + 1 < table->angle_count && result == AUR_OK; ++step) {
        const double from = aur_weight_table_angle(table, index),
                     to = aur_weight_table_angle(table, index + 1);
        aur_oswa_angle angle;
        result = aur_oswa_angle_init(table->oswa, from + (to - from) * (double)step / STEPS, &angle, error);
        table->masses[index * STEPS + step] = (float)angle.mass;
        aur_oswa_angle_release(&angle);
    }
    return result;
}

static aur_result build_angle(void *context, size_t index) {
    const build *const work = context;
    aur_weight_table *const table = work->table;
    aur_error *const error = &work->errors[index];
    const size_t doubles = aur_oswa_scratch(table->oswa);
    double *const scratch = malloc((doubles + 2 * table->size) * sizeof *scratch);
    bool *const flags = malloc(2 * table->size * sizeof *flags);
    aur_oswa_angle angle;
    aur_result result = aur_oswa_angle_init(table->oswa, aur_weight_table_angle(table, index), &angle, error);
    if (result == AUR_OK && (scratch == NULL || flags == NULL))
        result = aur_fail_memory(error);
    if (result == AUR_OK) {
        const angle_work parts = {scratch, scratch + doubles, flags, flags + table->size};
        table->masses[index * AUR_WEIGHT_TABLE_MASS_STEPS] = (float)angle.mass;
        result = build_masses(table, index, error);
        for (size_t rotation = 0; rotation < table->rotation_count && result == AUR_OK; ++rotation)
            result = build_rotation(table, index, rotation, &angle, &parts, error);
    }
    free(scratch);
    free(flags);
    aur_oswa_angle_release(&angle);
    return result;
}

static aur_result solve_all(aur_weight_table *table, size_t threads, const aur_progress *progress,
                            aur_error *error) {
    build work = {table, calloc(table->angle_count, sizeof(aur_error))};
    if (work.errors == NULL)
        return aur_fail_memory(error);
    const aur_parallel_options parallel = {
        .threads = threads, .what = "weights", .progress = progress != NULL ? *progress : (aur_progress){0}};
    const aur_result result = aur_parallel_for(&parallel, table->angle_count, build_angle, &work, error);
    if (result != AUR_OK) {
        for (size_t i = 0; i < table->angle_count; ++i) {
            if (work.errors[i].result == result && error != NULL) {
                *error = work.errors[i];
                break;
            }
        }
    }
    free(work.errors);
    return result;
}

aur_result aur_weight_table_build(const aur_oswa_options *options, size_t angle_count, size_t rotation_count,
                                  size_t threads, const aur_progress *progress, aur_weight_table **table,
                                  aur_error *error) {
    aur_result result = aur_weight_table_create(options, angle_count, rotation_count, true, table, error);
    if (result == AUR_OK && (*table)->apart)
        result = cut(*table, error);
    if (result == AUR_OK)
        result = aur_weight_table_allocate(*table, error);
    if (result == AUR_OK)
        result = solve_all(*table, threads, progress, error);
    if (result != AUR_OK) {
        aur_weight_table_destroy(*table);
        *table = NULL;
    }
    return result;
}
