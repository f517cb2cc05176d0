/* OSWA weights at many angles and turns, so that rendering needs no solve: tables and look-ups. */
#include "points/quadrature/tables/weight_table.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/quadrature/check.h"

static aur_result check_grid(const aur_weight_table_grid *grid, const aur_oswa *oswa, aur_error *error) {
    enum { MOST = 1 << 16, MOST_ROUGHNESSES = 1 << 8 };
    if (grid->angle_count < 2 || grid->angle_count > MOST || grid->rotation_count < 1 ||
        grid->rotation_count > MOST)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a table has 2 to 65536 angles and 1 to 65536 rotations, not %zu and %zu",
                        grid->angle_count, grid->rotation_count);
    if (grid->roughness_count < 1 || grid->roughness_count > MOST_ROUGHNESSES)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a table has 1 to %d roughnesses, not %zu",
                        MOST_ROUGHNESSES, grid->roughness_count);
    const aur_lobe *const lobe = &oswa->lobe[1];
    if (grid->roughness_count > 1 && (lobe->kind != AUR_LOBE_GGX || !(lobe->alpha < 1.0)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a table of several roughnesses is for a ggx lobe whose alpha, the least of them, is "
                        "below 1");
    return AUR_OK;
}

aur_result aur_weight_table_create(const aur_oswa_options *options, const aur_weight_table_grid *given,
                                   bool solves, aur_weight_table **table, aur_error *error) {
    *table = NULL;
    aur_weight_table_grid grid = {.size = sizeof grid};
    aur_weight_table_grid_init(&grid, NULL);
    aur_result result = aur_options_read(given, sizeof grid, &grid, "aur_weight_table_grid", error);
    if (result != AUR_OK)
        return result;
    aur_weight_table *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    result = aur_oswa_create_for(options, solves, &created->oswa, error);
    if (result == AUR_OK)
        result = check_grid(&grid, created->oswa, error);
    if (result != AUR_OK) {
        aur_weight_table_destroy(created);
        return result;
    }
    created->angle_count = grid.angle_count;
    created->roughness_count = grid.roughness_count;
    created->rotation_count = grid.rotation_count;
    created->size = aur_oswa_size(created->oswa);
    created->apart = aur_oswa_hides(created->oswa);
    created->blend = AUR_KERNEL_HERE(aur_weight_blend);
    *table = created;
    return AUR_OK;
}

aur_result aur_weight_table_check_memory(const aur_weight_table *table, aur_error *error) {
    const double width = (double)aur_weight_table_width(table);
    const double bytes = (double)aur_weight_table_rows(table) * width * sizeof(float);
    if (bytes <= aur_machine_memory())
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_MEMORY,
                    "a table of %zu angles, %zu roughnesses and %zu rotations takes %.3g GB",
                    table->angle_count, table->roughness_count, table->rotation_count, 1e-9 * bytes);
}

aur_result aur_weight_table_allocate(aur_weight_table *table, aur_error *error) {
    const aur_result result = aur_weight_table_check_memory(table, error);
    if (result != AUR_OK)
        return result;
    table->weights =
        malloc(aur_weight_table_rows(table) * aur_weight_table_width(table) * sizeof *table->weights);
    table->masses =
        malloc(table->roughness_count * aur_weight_table_mass_count(table) * sizeof *table->masses);
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

size_t aur_weight_table_roughnesses(const aur_weight_table *table) {
    return table->roughness_count;
}

size_t aur_weight_table_rotations(const aur_weight_table *table) {
    return table->rotation_count;
}

size_t aur_weight_table_rows(const aur_weight_table *table) {
    return table->apart ? 2 * table->piece_count : aur_weight_table_slots(table) * table->angle_count;
}

/* From the lobe's alpha to 1, evenly in logarithms. */
aur_oswa_view aur_weight_table_view(const aur_weight_table *table, size_t roughness, double radians) {
    const double least = table->oswa->lobe[1].alpha;
    if (roughness == 0)
        return (aur_oswa_view){radians, least};
    const double way = (double)roughness / (double)(table->roughness_count - 1);
    return (aur_oswa_view){radians, roughness + 1 < table->roughness_count ? pow(least, 1.0 - way) : 1.0};
}

/* The roughness of the table below `alpha`, and the fraction to the next one. */
static aur_result locate_roughness(const aur_weight_table *table, double alpha, size_t *roughness,
                                   double *part, aur_error *error) {
    const double least = table->oswa->lobe[1].alpha, steps = (double)(table->roughness_count - 1);
    *roughness = 0;
    *part = 0.0;
    if (table->roughness_count == 1)
        return AUR_OK;
    if (!(alpha >= least && alpha <= 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the table has roughnesses from %g to 1, not %g", least,
                        alpha);
    const double position = fmax(0.0, steps * (1.0 - log(alpha) / log(least)));
    *roughness = (size_t)fmin(position, steps - 1.0);
    *part = position - (double)*roughness;
    return AUR_OK;
}

/* The view of a caller's arguments. */
static aur_oswa_view view_of(const aur_weight_table *table, double radians, double alpha) {
    aur_oswa_view view = aur_oswa_view_at(table->oswa, radians);
    if (table->roughness_count > 1)
        view.alpha = alpha;
    return view;
}

static aur_result check_rotation(const aur_weight_table *table, size_t rotation, aur_error *error) {
    return rotation < table->rotation_count
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "the table has rotations 0 to %zu, not %zu",
                          table->rotation_count - 1, rotation);
}

aur_result aur_weight_table_points(const aur_weight_table *table, double radians, double alpha,
                                   size_t rotation, bool mirrored, size_t capacity, double *xyz,
                                   aur_error *error) {
    double turns[2], part;
    size_t roughness;
    aur_oswa_turns(table->oswa->options.seed, rotation, turns);
    aur_result result = check_rotation(table, rotation, error);
    if (result == AUR_OK)
        result = locate_roughness(table, alpha, &roughness, &part, error);
    return result == AUR_OK ? aur_oswa_place(table->oswa, view_of(table, radians, alpha), turns, mirrored,
                                             capacity, xyz, error)
                            : result;
}

aur_result aur_weight_table_uniform(const aur_weight_table *table, size_t capacity, double *xyz,
                                    aur_error *error) {
    const size_t numbers = 3 * table->oswa->count[1];
    const aur_result result = aur_check_capacity(numbers, capacity, error);
    if (result == AUR_OK)
        memcpy(xyz, table->oswa->uniform[1], numbers * sizeof *xyz);
    return result;
}

/* The part of an angle among `steps` equal parts of [0, pi/2], and the fraction within it. */
static size_t locate_step(size_t steps, float radians, float *part) {
    const float last = (float)steps;
    float position = radians * (last / (0.5f * AUR_PI_F));
    position = position > 0.0f ? (position < last ? position : last) : 0.0f; /* NaN: 0 */
    size_t index = (size_t)position;
    index -= index == steps;
    *part = position - (float)index;
    return index;
}

const float *aur_weight_table_row(const aur_weight_table *table, size_t row) {
    return aur_weight_table_mutable_row(table, row);
}

size_t aur_weight_table_locate(const aur_weight_table *table, size_t slot, float radians, float *part) {
    const size_t index = locate_step(table->angle_count - 1, radians, part);
    if (!table->apart)
        return slot * table->angle_count + index;
    const size_t cell = slot * (table->angle_count - 1) + index;
    const uint32_t *const first = table->first + cell;
    size_t piece = first[0];
    while (piece + 1 < first[1] && table->start[piece + 1] <= radians)
        ++piece;
    if (first[1] - first[0] > 1) {
        const float start = table->start[piece];
        const float end =
            piece + 1 < first[1] ? table->start[piece + 1] : (float)aur_weight_table_angle(table, index + 1);
        const float way = (radians - start) / (end - start);
        *part = way > 0.0f ? (way < 1.0f ? way : 1.0f) : 0.0f; /* a piece of width 0: 0 */
    }
    return 2 * piece;
}

/* Weights of a lobe at a roughness between two of the table. Hidden samples have weight 0; a sample that is
 * hidden in some of the four rows gets its weight from the others. The sum is preserved. */
static void mix_roughnesses(const aur_weight_table *table, size_t lobe, size_t rotation, size_t roughness,
                            double way, aur_oswa_view view, float *weights) {
    const size_t first = table->oswa->count[0];
    const float *rows[4];
    float shares[4], sum = 0.0f;
    double turns[2];
    aur_oswa_turns(table->oswa->options.seed, rotation, turns);
    for (size_t k = 0; k < 2; ++k) {
        const size_t slot = (roughness + k) * table->rotation_count + rotation;
        float part;
        rows[2 * k] =
            aur_weight_table_row(table, aur_weight_table_locate(table, slot, (float)view.radians, &part)) +
            lobe * table->size;
        rows[2 * k + 1] = rows[2 * k] + aur_weight_table_width(table);
        const float share = (float)(k == 0 ? 1.0 - way : way);
        shares[2 * k] = share * (1.0f - part);
        shares[2 * k + 1] = share * part;
    }
    for (size_t i = 0; i < table->size; ++i) {
        float weight = 0.0f, shown = 0.0f;
        const bool visible = i < first || aur_oswa_height(table->oswa, view, turns[1], i - first) >= 0.0;
        for (size_t k = 0; k < 4 && visible; ++k) {
            weight += shares[k] * rows[k][i];
            shown += rows[k][i] != 0.0f ? shares[k] : 0.0f;
        }
        weights[i] = shown > 0.0f ? weight / shown : 0.0f;
        sum += weights[i];
    }
    for (size_t i = 0; i < table->size && sum > 0.0f; ++i)
        weights[i] /= sum;
}

aur_result aur_weight_table_look_up(const aur_weight_table *table, size_t lobe, size_t rotation,
                                    double radians, double alpha, size_t capacity, float *weights,
                                    aur_error *error) {
    const size_t lobes = aur_oswa_lobes(table->oswa);
    if (lobe > 1 || lobe + lobes < 2)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        lobes == 2 ? "a table has the lobes 0 and 1, not %zu"
                                   : "the table has lobe 1 alone, not %zu",
                        lobe);
    size_t roughness;
    double way;
    aur_result result = check_rotation(table, rotation, error);
    if (result == AUR_OK)
        result = locate_roughness(table, alpha, &roughness, &way, error);
    if (result == AUR_OK)
        result = aur_check_angle(radians, error);
    if (result == AUR_OK)
        result = aur_check_capacity(table->size, capacity, error);
    if (result != AUR_OK)
        return result;
    lobe -= 2 - lobes;
    if (table->roughness_count > 1) {
        mix_roughnesses(table, lobe, rotation, roughness, way, view_of(table, radians, alpha), weights);
        return AUR_OK;
    }
    float part;
    const size_t row = aur_weight_table_locate(table, rotation, (float)radians, &part);
    const float *const below = aur_weight_table_row(table, row) + lobe * table->size;
    table->blend(table->size, below, below + aur_weight_table_width(table), part, weights);
    return AUR_OK;
}

static float mass_at(const aur_weight_table *table, size_t roughness, double radians) {
    float part;
    const size_t count = aur_weight_table_mass_count(table);
    const size_t step = locate_step(count - 1, (float)radians, &part);
    const float *const masses = table->masses + roughness * count + step;
    return masses[0] + part * (masses[1] - masses[0]);
}

double aur_weight_table_mass(const aur_weight_table *table, double radians, double alpha) {
    size_t roughness;
    double way;
    const double least = table->oswa->lobe[1].alpha;
    locate_roughness(table, fmin(fmax(alpha, least), 1.0), &roughness, &way, NULL);
    const double mass = (double)mass_at(table, roughness, radians);
    return way > 0.0 ? mass + way * ((double)mass_at(table, roughness + 1, radians) - mass) : mass;
}

aur_result aur_weight_table_grid_init(aur_weight_table_grid *grid, aur_error *error) {
    static const aur_weight_table_grid defaults = {
        .size = sizeof defaults, .angle_count = 64, .roughness_count = 1, .rotation_count = 16};
    return aur_description_write(&defaults, sizeof defaults, grid, "aur_weight_table_grid", error);
}
