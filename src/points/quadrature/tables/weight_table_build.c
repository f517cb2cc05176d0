/* Building tables of OSWA weights: the angles where samples cross the horizon, and the solves on both sides.
 */

#include <inttypes.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/bytes.h"
#include "points/base/file.h"
#include "points/base/parallel.h"
#include "points/quadrature/tables/weight_table.h"

/* --- pieces: the angles at which samples cross the horizon */

/* The angle, between two angles, where a sample crosses the horizon. */
static double crossing(const aur_oswa *oswa, double alpha, double turns, size_t sample, double below,
                       double above) {
    const bool starts = aur_oswa_height(oswa, (aur_oswa_view){below, alpha}, turns, sample) >= 0.0;
    while (above - below > 1e-9) {
        const double middle = 0.5 * (below + above);
        if ((aur_oswa_height(oswa, (aur_oswa_view){middle, alpha}, turns, sample) >= 0.0) == starts)
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

/* Appends the pieces of one slot. Samples of the first pattern never cross; a sample of the second on the
 * same side of the horizon at both ends of a step is assumed not to cross within it. Samples of a GGX lobe
 * may be below for a short interval, so smaller steps are used. */
static bool cut_slot(aur_weight_table *table, size_t slot, size_t *capacity, bool *sides) {
    const aur_oswa *const oswa = table->oswa;
    const size_t count = oswa->count[1], steps = oswa->lobe[1].kind == AUR_LOBE_GGX ? 4 : 1;
    const aur_oswa_view start = aur_weight_table_view(table, slot / table->rotation_count, 0.0);
    double turns[2];
    aur_oswa_turns(oswa->options.seed, slot % table->rotation_count, turns);
    for (size_t k = 0; k < count; ++k)
        sides[k] = aur_oswa_height(oswa, start, turns[1], k) >= 0.0;
    for (size_t i = 0; i + 1 < table->angle_count; ++i) {
        const double first_angle = aur_weight_table_angle(table, i),
                     width = (aur_weight_table_angle(table, i + 1) - first_angle) / (double)steps;
        const size_t first = table->piece_count, most = first + 1 + steps * count;
        if (most > UINT32_MAX || !aur_array_reserve(&table->start, capacity, most, sizeof *table->start))
            return false;
        table->first[slot * (table->angle_count - 1) + i] = (uint32_t)first;
        table->start[table->piece_count++] = (float)first_angle;
        for (size_t step = 0; step < steps; ++step) {
            const double below = first_angle + (double)step * width;
            const double above = step + 1 < steps ? below + width : aur_weight_table_angle(table, i + 1);
            for (size_t k = 0; k < count; ++k) {
                const aur_oswa_view end = {above, start.alpha};
                const bool side = aur_oswa_height(oswa, end, turns[1], k) >= 0.0;
                if (side != sides[k])
                    table->start[table->piece_count++] =
                        (float)crossing(oswa, start.alpha, turns[1], k, below, above);
                sides[k] = side;
            }
        }
        qsort(table->start + first + 1, table->piece_count - first - 1, sizeof *table->start, ascending);
    }
    return true;
}

static aur_result cut(aur_weight_table *table, aur_error *error) {
    const size_t intervals = aur_weight_table_intervals(table);
    table->piece_count = intervals; /* at least */
    const aur_result result = aur_weight_table_check_memory(table, error);
    if (result != AUR_OK)
        return result;
    table->piece_count = 0;
    bool *const sides = malloc(table->oswa->count[1] * sizeof *sides);
    table->first = malloc((intervals + 1) * sizeof *table->first);
    bool good = sides != NULL && table->first != NULL;
    size_t capacity = 0;
    for (size_t k = 0; k < aur_weight_table_slots(table) && good; ++k)
        good = cut_slot(table, k, &capacity, sides);
    if (good)
        table->first[intervals] = (uint32_t)table->piece_count;
    free(sides);
    return good ? AUR_OK
                : aur_fail(error, AUR_ERROR_MEMORY,
                           "out of memory for the pieces of %zu angles and %zu rotations", table->angle_count,
                           table->rotation_count);
}

/* --- solves */

/* Scratch data for the rows of one angle and roughness, rotation after rotation. */
typedef struct angle_work {
    const aur_weight_table *table;
    aur_oswa_angle angle;
    double turns[2];
    double *scratch, *weights;
    bool *taken, *before; /* the samples used in a piece, and in the previous one */
} angle_work;

/* Solves with the samples work->taken. */
static aur_result solve_row(const angle_work *work, const aur_oswa_angle *angle, size_t row,
                            aur_error *error) {
    const aur_weight_table *const table = work->table;
    float *const target = aur_weight_table_mutable_row(table, row);
    const size_t width = aur_weight_table_width(table);
    if (memchr(work->taken, true, table->size) == NULL) { /* with few samples all may be hidden */
        memset(target, 0, width * sizeof *target);
        return AUR_OK;
    }
    const aur_result result =
        aur_oswa_solve_at(table->oswa, angle, work->turns, work->taken, work->scratch, work->weights, error);
    for (size_t i = 0; i < width && result == AUR_OK; ++i)
        target[i] = (float)work->weights[i];
    return result;
}

/* The samples used in a piece are those above the horizon at its middle. */
static void take(const angle_work *work, size_t interval, size_t piece) {
    const aur_weight_table *const table = work->table;
    const double stop = piece + 1 < table->first[interval + 1]
                            ? (double)table->start[piece + 1]
                            : aur_weight_table_angle(table, interval % (table->angle_count - 1) + 1);
    const aur_oswa_view view = {0.5 * ((double)table->start[piece] + stop), work->angle.view.alpha};
    aur_oswa_visible(table->oswa, view, work->turns, work->scratch, work->taken);
}

/* The rows at both sides of the angle where `piece` begins: at the end of the previous piece and at the start
 * of `piece`, which are equal if the same samples are used. At the ends of the table one of them is missing.
 */
static aur_result build_sides(const angle_work *work, const aur_oswa_angle *angle, size_t interval_before,
                              size_t interval, size_t piece, aur_error *error) {
    const aur_weight_table *const table = work->table;
    const size_t row = 2 * piece;
    const bool has_before = interval_before != SIZE_MAX;
    aur_result result = AUR_OK;
    if (has_before) {
        take(work, interval_before, piece - 1);
        result = solve_row(work, angle, row - 1, error);
        memcpy(work->before, work->taken, table->size * sizeof *work->taken);
    }
    if (interval == SIZE_MAX || result != AUR_OK)
        return result;
    take(work, interval, piece);
    if (!has_before || memcmp(work->taken, work->before, table->size * sizeof *work->taken) != 0)
        return solve_row(work, angle, row, error);
    memcpy(aur_weight_table_mutable_row(table, row), aur_weight_table_mutable_row(table, row - 1),
           aur_weight_table_width(table) * sizeof *table->weights);
    return AUR_OK;
}

/* The rows at an angle of the table, and at the crossings between it and the next. */
static aur_result build_slot(const angle_work *work, size_t index, size_t slot, aur_error *error) {
    const aur_weight_table *const table = work->table;
    if (!table->apart) {
        memset(work->taken, true, table->size * sizeof *work->taken);
        return solve_row(work, &work->angle, slot * table->angle_count + index, error);
    }
    const size_t interval = slot * (table->angle_count - 1) + index;
    const bool last = index + 1 == table->angle_count;
    size_t piece = table->first[interval];
    aur_result result = build_sides(work, &work->angle, index > 0 ? interval - 1 : SIZE_MAX,
                                    last ? SIZE_MAX : interval, piece, error);
    while (result == AUR_OK && !last && ++piece < table->first[interval + 1]) {
        const aur_oswa_view view = {(double)table->start[piece], work->angle.view.alpha};
        aur_oswa_angle angle;
        result = aur_oswa_angle_init(table->oswa, view, &angle, error);
        if (result == AUR_OK)
            result = build_sides(work, &angle, interval, interval, piece, error);
        aur_oswa_angle_release(&angle);
    }
    return result;
}

/* The mass of the mirror lobe between an angle of the table and the next. */
static aur_result build_masses(const aur_weight_table *table, size_t roughness, size_t index,
                               aur_error *error) {
    enum { STEPS = AUR_WEIGHT_TABLE_MASS_STEPS };
    const double from = aur_weight_table_angle(table, index), to = aur_weight_table_angle(table, index + 1);
    float *const masses = table->masses + roughness * aur_weight_table_mass_count(table) + index * STEPS;
    aur_result result = AUR_OK;
    for (size_t step = 1; step < STEPS && index + 1 < table->angle_count && result == AUR_OK; ++step) {
        aur_oswa_angle angle;
        const aur_oswa_view view =
            aur_weight_table_view(table, roughness, from + (to - from) * (double)step / STEPS);
        result = aur_oswa_angle_init(table->oswa, view, &angle, error);
        masses[step] = (float)angle.mass;
        aur_oswa_angle_release(&angle);
    }
    return result;
}

/* The rows at angle number `place % angle_count` of one roughness. */
static aur_result build_angle(const aur_weight_table *table, size_t item, aur_error *error) {
    const size_t index = item % table->angle_count, roughness = item / table->angle_count;
    const size_t doubles = aur_oswa_scratch(table->oswa);
    double *const scratch = malloc((doubles + 2 * table->size) * sizeof *scratch + 2 * table->size);
    if (scratch == NULL)
        return aur_fail_memory(error);
    bool *const flags = (bool *)(scratch + doubles + 2 * table->size);
    angle_work work = {.table = table,
                       .scratch = scratch,
                       .weights = scratch + doubles,
                       .taken = flags,
                       .before = flags + table->size};
    const aur_oswa_view view = aur_weight_table_view(table, roughness, aur_weight_table_angle(table, index));
    aur_result result = aur_oswa_angle_init(table->oswa, view, &work.angle, error);
    table->masses[roughness * aur_weight_table_mass_count(table) + index * AUR_WEIGHT_TABLE_MASS_STEPS] =
        (float)work.angle.mass;
    if (result == AUR_OK)
        result = build_masses(table, roughness, index, error);
    for (size_t rotation = 0; rotation < table->rotation_count && result == AUR_OK; ++rotation) {
        aur_oswa_turns(table->oswa->options.seed, rotation, work.turns);
        result = build_slot(&work, index, roughness * table->rotation_count + rotation, error);
    }
    free(scratch);
    aur_oswa_angle_release(&work.angle);
    return result;
}

typedef struct build {
    const aur_weight_table *table;
    atomic_size_t failed; /* the lowest angle that could not be built */
} build;

static aur_result build_one(void *context, size_t index) {
    build *const work = context;
    const aur_result result = build_angle(work->table, index, NULL);
    size_t lowest = atomic_load(&work->failed);
    while (result != AUR_OK && index < lowest && !atomic_compare_exchange_weak(&work->failed, &lowest, index))
        continue;
    return result;
}

/* The results of an angle of one roughness, piece by piece: its masses, and its rows of each rotation. */
static void each_piece(const aur_weight_table *table, size_t item,
                       void (*move)(void *bytes, size_t size, void *data), void *bytes) {
    const size_t index = item % table->angle_count, roughness = item / table->angle_count;
    const bool last = index + 1 == table->angle_count;
    move(bytes, (last ? 1 : AUR_WEIGHT_TABLE_MASS_STEPS) * sizeof *table->masses,
         table->masses + roughness * aur_weight_table_mass_count(table) +
             index * AUR_WEIGHT_TABLE_MASS_STEPS);
    for (size_t rotation = 0; rotation < table->rotation_count; ++rotation) {
        const size_t slot = roughness * table->rotation_count + rotation;
        size_t first = slot * table->angle_count + index, end = first + 1;
        if (table->apart) {
            const size_t interval = slot * (table->angle_count - 1) + index;
            first = 2 * (size_t)table->first[interval] - (index > 0);
            end = last ? 2 * (size_t)table->first[interval] : 2 * (size_t)table->first[interval + 1] - 1;
        }
        move(bytes, (end - first) * aur_weight_table_width(table) * sizeof *table->weights,
             aur_weight_table_mutable_row(table, first));
    }
}

static void put(void *bytes, size_t size, void *data) {
    aur_bytes_put(bytes, size, data);
}

static void get(void *bytes, size_t size, void *data) {
    aur_bytes_get(bytes, size, data);
}

static bool pack_angle(void *context, size_t item, aur_bytes *bytes) {
    each_piece(((const build *)context)->table, item, put, bytes);
    return true;
}

static aur_result unpack_angle(void *context, size_t item, aur_bytes_reader *bytes) {
    each_piece(((const build *)context)->table, item, get, bytes);
    return bytes->failed ? AUR_ERROR_INTERNAL : AUR_OK;
}

static aur_result solve_all(const aur_weight_table *table, size_t threads, const aur_progress *progress,
                            aur_error *error) {
    build work = {table, SIZE_MAX};
    const aur_parallel_share share = {.pack = pack_angle, .unpack = unpack_angle};
    const aur_parallel_options parallel = {.threads = threads,
                                           .what = "weights",
                                           .progress = progress != NULL ? *progress : (aur_progress){0},
                                           .share = &share};
    const aur_result result =
        aur_parallel_for(&parallel, table->roughness_count * table->angle_count, build_one, &work, error);
    /* Repeated for its error message: threads have no separate errors. */
    if (result != AUR_OK && work.failed != SIZE_MAX)
        build_angle(table, work.failed, error);
    return result;
}

aur_result aur_weight_table_build(const aur_oswa_options *options, const aur_weight_table_grid *grid,
                                  size_t threads, const aur_progress *progress, aur_weight_table **table,
                                  aur_error *error) {
    aur_result result = aur_weight_table_create(options, grid, true, table, error);
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

static const char cache_kind[] = "weights";

aur_result aur_weight_table_find(const aur_oswa_options *options, const aur_weight_table_grid *grid,
                                 size_t threads, const aur_progress *progress, aur_weight_table **table,
                                 aur_error *error) {
    char key[AUR_WEIGHT_TABLE_KEY_CAPACITY];
    const uint64_t identity = aur_build_identity();
    const bool caches = identity != 0 && aur_weight_table_key(options, grid, identity, key) == AUR_OK;
    size_t size = 0;
    void *data = caches ? aur_cache_file_read(cache_kind, key, &size) : NULL;
    const bool found =
        data != NULL && aur_weight_table_parse("cache", size, data, options, table, NULL) == AUR_OK;
    free(data);
    if (found)
        return AUR_OK;
    const aur_result result = aur_weight_table_build(options, grid, threads, progress, table, error);
    if (result == AUR_OK && caches && aur_weight_table_print(*table, &size, &data, NULL) == AUR_OK) {
        aur_cache_file_write(cache_kind, key, size, data);
        free(data);
    }
    return result;
}
