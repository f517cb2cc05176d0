/* Two lobes and the union of their samples (Marques 2018 sections 5.3 and 6.2), at any angle, clipped or not.
 */
#include "points/quadrature/tables/oswa.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "points/linear/solve.h"
#include "points/quadrature/check.h"
#include "points/sphere/lobe.h"

static bool is_ggx(const aur_oswa *oswa) {
    return oswa->lobe[1].kind == AUR_LOBE_GGX;
}

bool aur_oswa_hides(const aur_oswa *oswa) {
    return oswa->options.clipped || is_ggx(oswa);
}

/* --- creation */

/* The block of K and the z of a pattern within itself; `columns` is scratch memory for its points. */
static aur_result prepare_pattern(aur_oswa *oswa, size_t which, double *columns, aur_error *error) {
    const size_t n = oswa->count[which];
    const double exponent = oswa->lobe[which].exponent;
    const aur_density density = {.size = sizeof density, .exponent = exponent};
    const aur_result result =
        aur_potential_create(&density, oswa->options.smoothness, &oswa->whole[which], error);
    if (result != AUR_OK)
        return result;
    const aur_kernel_rule *const rule = &oswa->whole[which]->rule;
    const double *const pattern = oswa->pattern[which];
    const aur_columns split = aur_columns_split(n, pattern, columns);
    for (size_t i = 0; i < n; ++i) {
        aur_kernel_row(rule, pattern + 3 * i, i, split, oswa->kernel[which] + i * n);
        oswa->kernel[which][i * n + i] = rule->top + oswa->weights.regularization;
    }
    if (oswa->published_z != NULL)
        aur_potential_table_evaluate(oswa->published_z, exponent, n, split.z, oswa->self_z[which]);
    else
        aur_potential_evaluate(oswa->whole[which], n, pattern, oswa->self_z[which]);
    return AUR_OK;
}

static aur_result create_pattern(aur_oswa *oswa, size_t which, bool solves, aur_error *error) {
    const aur_oswa_options *const o = &oswa->options;
    const aur_lobe *const lobe = &oswa->lobe[which];
    const size_t n = oswa->count[which];
    if (n == 0)
        return AUR_OK;
    const bool whole = lobe->kind == AUR_LOBE_COSINE_POWER;
    oswa->sampled[which] = *lobe;
    aur_result result = AUR_OK;
    if (o->optimal_density && whole)
        result = aur_lobe_optimal(lobe, o->smoothness, &oswa->sampled[which], error);
    if (result != AUR_OK)
        return result;
    double *const storage = malloc((10 * n + (solves && whole ? n * n : 0)) * sizeof *storage);
    if (storage == NULL)
        return aur_fail_memory(error);
    oswa->uniform[which] = storage;
    oswa->pattern[which] = storage + 3 * n;
    oswa->self_z[which] = storage + 9 * n;
    oswa->kernel[which] = storage + 10 * n;
    /* The second pattern has a separate seed, different from those of other pairs. */
    const aur_directions_options directions = {
        .size = sizeof directions,
        .count = n,
        .domain = AUR_DOMAIN_HEMISPHERE,
        .map = o->map,
        .scramble = o->scramble,
        .seed = which == 0 ? o->seed : aur_hash2(UINT64_C(0x6d6972726f72), o->seed)};
    result = aur_points_of_set(o->set, &directions, storage, NULL, error);
    if (result != AUR_OK || !whole)
        return result;
    aur_lobe_warp(&oswa->sampled[which], n, storage, oswa->pattern[which]);
    return solves ? prepare_pattern(oswa, which, storage + 6 * n, error) : AUR_OK;
}

static aur_result check(const aur_oswa_options *options, aur_error *error) {
    aur_result result = aur_lobe_check(&options->lobe, error);
    if (result == AUR_OK)
        result = aur_lobe_check(&options->mirror_lobe, error);
    if (result != AUR_OK)
        return result;
    if (options->lobe.kind != AUR_LOBE_COSINE_POWER)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "the lobe about the normal must be uniform, cosine or phong:M");
    const bool ggx = options->mirror_lobe.kind == AUR_LOBE_GGX;
    if ((options->count == 0 && !ggx) || options->mirror_count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "both lobes need at least one sample; only a ggx lobe may be used alone");
    if (options->published_z.angle_count > 0 && (options->clipped || ggx))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "the published table of z holds whole cos^m lobes only");
    return AUR_OK;
}

aur_result aur_oswa_options_read(const aur_oswa_options *given, aur_oswa_options *copy,
                                 aur_weights_options *weights, aur_error *error) {
    copy->size = sizeof(aur_oswa_options);
    aur_oswa_options_init(0, 0, copy, NULL);
    weights->size = sizeof(aur_weights_options);
    aur_weights_options_init(weights, NULL);
    aur_result result = aur_options_read(given, sizeof *copy, copy, "aur_oswa_options", error);
    if (result == AUR_OK)
        result = aur_weights_options_read(copy->weights, weights, error);
    copy->set = copy->set != NULL ? copy->set : aur_set_default;
    copy->smoothness = copy->smoothness != 0.0 ? copy->smoothness : 1.5;
    copy->weights = weights;
    return result == AUR_OK ? check(copy, error) : result;
}

static aur_result create(aur_oswa *oswa, const aur_oswa_options *given, bool solves, aur_error *error) {
    aur_oswa_options *const options = &oswa->options;
    aur_result result = aur_oswa_options_read(given, options, &oswa->weights, error);
    if (result != AUR_OK)
        return result;
    options->set = oswa->set = strdup(options->set);
    if (options->set == NULL)
        return aur_fail_memory(error);
    oswa->count[0] = options->count;
    oswa->count[1] = options->mirror_count;
    oswa->lobe[0] = options->lobe;
    oswa->lobe[1] = options->mirror_lobe;
    result = aur_check_system_size(solves ? aur_oswa_size(oswa) : 1, error);
    if (result == AUR_OK && solves && options->published_z.angle_count > 0)
        result =
            aur_potential_table_create(&options->published_z, options->smoothness, &oswa->published_z, error);
    for (size_t which = 0; which < 2 && result == AUR_OK; ++which)
        result = create_pattern(oswa, which, solves, error);
    return result;
}

aur_result aur_oswa_create_for(const aur_oswa_options *options, bool solves, aur_oswa **oswa,
                               aur_error *error) {
    *oswa = NULL;
    aur_oswa *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    const aur_result result = create(created, options, solves, error);
    if (result == AUR_OK)
        *oswa = created;
    else
        aur_oswa_destroy(created);
    return result;
}

aur_result aur_oswa_create(const aur_oswa_options *options, aur_oswa **oswa, aur_error *error) {
    return aur_oswa_create_for(options, true, oswa, error);
}

void aur_oswa_destroy(aur_oswa *oswa) {
    if (oswa == NULL)
        return;
    for (size_t which = 0; which < 2; ++which) {
        aur_potential_destroy(oswa->whole[which]);
        free(oswa->uniform[which]);
    }
    aur_potential_table_destroy(oswa->published_z);
    free(oswa->set);
    free(oswa);
}

size_t aur_oswa_size(const aur_oswa *oswa) {
    return oswa->count[0] + oswa->count[1];
}

/* --- positions of samples */

/* Rotates about +z. */
static void turn(double turns, size_t count, const double *from, double *to) {
    const double c = cos(2.0 * AUR_PI * turns), s = sin(2.0 * AUR_PI * turns);
    for (size_t i = 0; i < count; ++i) {
        const double x = from[3 * i], y = from[3 * i + 1];
        to[3 * i] = c * x - s * y;
        to[3 * i + 1] = s * x + c * y;
        to[3 * i + 2] = from[3 * i + 2];
    }
}

/* Rotates +z to the mirror direction (-sin a, 0, cos a). */
static void tilt(double radians, size_t count, double *xyz) {
    const double c = cos(radians), s = sin(radians);
    for (size_t i = 0; i < count; ++i) {
        const double x = xyz[3 * i], z = xyz[3 * i + 2];
        xyz[3 * i] = c * x - s * z;
        xyz[3 * i + 2] = s * x + c * z;
    }
}

aur_oswa_view aur_oswa_view_at(const aur_oswa *oswa, double radians) {
    return (aur_oswa_view){radians, oswa->lobe[1].alpha};
}

static aur_lobe ggx_at(aur_oswa_view view) {
    return (aur_lobe){.kind = AUR_LOBE_GGX,
                      .alpha = view.alpha,
                      .view_degrees = fmin(view.radians * 180.0 / AUR_PI, 89.99)};
}

/* Samples first .. first + count - 1 of the pattern about the mirror direction. */
static void place_mirror(const aur_oswa *oswa, aur_oswa_view view, double turns, size_t first, size_t count,
                         double *xyz) {
    if (!is_ggx(oswa)) {
        turn(turns, count, oswa->pattern[1] + 3 * first, xyz);
        tilt(view.radians, count, xyz);
        return;
    }
    const aur_lobe lobe = ggx_at(view);
    turn(turns, count, oswa->uniform[1] + 3 * first, xyz);
    aur_lobe_warp(&lobe, count, xyz, xyz);
}

static void place(const aur_oswa *oswa, aur_oswa_view view, const double turns[2], double *xyz) {
    turn(turns[0], oswa->count[0], oswa->pattern[0], xyz);
    place_mirror(oswa, view, turns[1], 0, oswa->count[1], xyz + 3 * oswa->count[0]);
}

void aur_oswa_turns(uint64_t seed, size_t rotation, double turns[2]) {
    for (uint64_t which = 0; which < 2; ++which)
        turns[which] = aur_unit_double(aur_hash4(UINT64_C(0x7475726e), seed, rotation, which));
}

double aur_oswa_height(const aur_oswa *oswa, aur_oswa_view view, double turns, size_t index) {
    double u[3];
    place_mirror(oswa, view, turns, index, 1, u);
    return u[2];
}

void aur_oswa_visible(const aur_oswa *oswa, aur_oswa_view view, const double turns[2], double *xyz,
                      bool *visible) {
    place(oswa, view, turns, xyz);
    for (size_t i = 0; i < aur_oswa_size(oswa); ++i)
        visible[i] = !aur_oswa_hides(oswa) || xyz[3 * i + 2] >= 0.0;
}

aur_result aur_oswa_place(const aur_oswa *oswa, aur_oswa_view view, const double turns[2], bool mirrored,
                          size_t capacity, double *xyz, aur_error *error) {
    aur_result result = aur_check_angle(view.radians, error);
    if (result == AUR_OK)
        result = aur_check_capacity(3 * aur_oswa_size(oswa), capacity, error);
    if (result != AUR_OK)
        return result;
    place(oswa, view, turns, xyz);
    for (size_t i = 0; mirrored && i < aur_oswa_size(oswa); ++i)
        xyz[3 * i + 1] = -xyz[3 * i + 1];
    return AUR_OK;
}

aur_result aur_oswa_points(const aur_oswa *oswa, double radians, const double turns[2], bool mirrored,
                           size_t capacity, double *xyz, aur_error *error) {
    return aur_oswa_place(oswa, aur_oswa_view_at(oswa, radians), turns, mirrored, capacity, xyz, error);
}

/* --- solving */

aur_result aur_oswa_angle_init(const aur_oswa *oswa, aur_oswa_view view, aur_oswa_angle *angle,
                               aur_error *error) {
    *angle = (aur_oswa_angle){.view = view};
    aur_result result = aur_check_angle(view.radians, error);
    if (result != AUR_OK)
        return result;
    if (is_ggx(oswa)) {
        const aur_lobe lobe = ggx_at(view);
        aur_density density = {.size = sizeof density};
        aur_density_init(&density, NULL);
        result = aur_density_from_lobe(&lobe, AUR_DOMAIN_HEMISPHERE, &density, error);
        if (result == AUR_OK)
            result = aur_potential_create(&density, oswa->options.smoothness, &angle->potential, error);
        angle->mass = result == AUR_OK ? aur_potential_mass(angle->potential) : 0.0;
        return result;
    }
    angle->mass = oswa->whole[1]->mass;
    if (oswa->options.clipped) {
        const double axis[3] = {-sin(view.radians), 0.0, fmax(0.0, cos(view.radians))};
        aur_lune_init(&angle->lune, axis, oswa->lobe[1].exponent);
        angle->mass *= 1.0 - angle->lune.fraction;
    }
    return AUR_OK;
}

void aur_oswa_angle_release(aur_oswa_angle *angle) {
    aur_potential_destroy(angle->potential);
    angle->potential = NULL;
}

size_t aur_oswa_scratch(const aur_oswa *oswa) {
    const size_t n = aur_oswa_size(oswa);
    return n * n + 10 * n;
}

/* z of both lobes at the points `xyz` of a pattern: `z` for the first, `mirror_z` for the mirror lobe. */
static void fill_z(const aur_oswa *oswa, const aur_oswa_angle *angle, size_t which, const double *xyz,
                   double *cosines, double *z, double *mirror_z) {
    const size_t n = oswa->count[which];
    const double axis[3] = {-sin(angle->view.radians), 0.0, cos(angle->view.radians)};
    double *const other = which == 0 ? mirror_z : z;
    memcpy(which == 0 ? z : mirror_z, oswa->self_z[which], n * sizeof *z);
    for (size_t i = 0; i < n; ++i)
        cosines[i] = which == 0 ? aur_dot3(xyz + 3 * i, axis) : xyz[3 * i + 2];
    if (oswa->published_z != NULL)
        aur_potential_table_evaluate(oswa->published_z, oswa->lobe[1 - which].exponent, n, cosines, other);
    else
        aur_zonal_evaluate(&oswa->whole[1 - which]->zonal, n, cosines, other);
    if (angle->lune.fraction <= 0.0)
        return;
    const double visible = 1.0 - angle->lune.fraction;
    for (size_t i = 0; i < n; ++i)
        if (xyz[3 * i + 2] >= 0.0)
            mirror_z[i] =
                (mirror_z[i] - aur_lune_potential(&angle->lune, &oswa->whole[1]->rule, xyz + 3 * i)) /
                visible;
}

/* The lower triangle of K with the regulariser, of all samples; the blocks within the patterns are
 * precomputed. */
static void fill_matrix(const aur_oswa *oswa, const double *xyz, double *columns, double *matrix) {
    const size_t first = oswa->count[0], second = oswa->count[1], n = first + second;
    const aur_columns split = aur_columns_split(first, xyz, columns);
    for (size_t i = 0; i < first; ++i)
        memcpy(matrix + i * n, oswa->kernel[0] + i * first, (i + 1) * sizeof *matrix);
    for (size_t i = 0; i < second; ++i) {
        double *const row = matrix + (first + i) * n;
        aur_kernel_row(&oswa->whole[0]->rule, xyz + 3 * (first + i), first, split, row);
        memcpy(row + first, oswa->kernel[1] + i * second, (i + 1) * sizeof *row);
    }
}

/* Removes samples from the system, in place; returns the number remaining. */
static size_t drop(size_t n, const bool *taken, double *matrix, double *right, size_t columns) {
    size_t remaining = 0;
    for (size_t i = 0; i < n; ++i)
        remaining += taken[i];
    for (size_t i = 0, row = 0; i < n && remaining < n; ++i) {
        if (!taken[i])
            continue;
        for (size_t j = 0, column = 0; j <= i; ++j)
            if (taken[j])
                matrix[row * remaining + column++] = matrix[i * n + j];
        ++row;
    }
    for (size_t k = 0; k < columns && remaining < n; ++k)
        for (size_t i = 0, row = 0; i < n; ++i)
            if (taken[i])
                right[k * remaining + row++] = right[k * n + i];
    return remaining;
}

/* The general solver without precomputed blocks: for GGX, and for systems that are positive definite only
 * after merging samples. It leaves out samples below the surface. */
static aur_result solve_plainly(const aur_oswa *oswa, const aur_oswa_angle *angle, const double *xyz,
                                double *weights, aur_error *error) {
    const size_t n = aur_oswa_size(oswa), lobes = aur_oswa_lobes(oswa);
    aur_potential *mirror = angle->potential;
    aur_result result = AUR_OK;
    if (mirror == NULL) {
        const aur_density density = {
            .size = sizeof density,
            .axis = {-sin(angle->view.radians), 0.0, fmax(0.0, cos(angle->view.radians))},
            .exponent = oswa->lobe[1].exponent,
            .clipped = oswa->options.clipped};
        result = aur_potential_create(&density, oswa->options.smoothness, &mirror, error);
    }
    const aur_potential *const potentials[] = {oswa->whole[0], mirror};
    if (result == AUR_OK)
        result = aur_weights_solve(n, xyz, lobes, potentials + 2 - lobes, &oswa->weights, lobes * n, weights,
                                   NULL, NULL, error);
    if (mirror != angle->potential)
        aur_potential_destroy(mirror);
    return result;
}

/* At a crossing rounding may put a sample on the wrong side of the horizon. The position of a left-out sample
 * is irrelevant. */
static void put_on_side(bool taken, double *direction) {
    if (!taken) {
        direction[0] = direction[1] = 0.0;
        direction[2] = -1.0;
    } else if (direction[2] < 0.0) {
        direction[2] = 0.0;
        aur_normalize3(direction);
    }
}

aur_result aur_oswa_solve_at(const aur_oswa *oswa, const aur_oswa_angle *angle, const double turns[2],
                             const bool *taken, double *scratch, double *weights, aur_error *error) {
    const size_t n = aur_oswa_size(oswa);
    double *const matrix = scratch;
    double *const xyz = matrix + n * n;
    double *const columns = xyz + 3 * n;
    double *const right = columns + 3 * n;
    double *const cosines = right + 3 * n;
    place(oswa, angle->view, turns, xyz);
    for (size_t i = 0; i < n && aur_oswa_hides(oswa); ++i)
        put_on_side(taken[i], xyz + 3 * i);
    if (is_ggx(oswa))
        return solve_plainly(oswa, angle, xyz, weights, error);
    const size_t first = oswa->count[0];
    fill_matrix(oswa, xyz, columns, matrix);
    fill_z(oswa, angle, 0, xyz, cosines, right, right + n);
    fill_z(oswa, angle, 1, xyz + 3 * first, cosines, right + first, right + n + first);
    const bool constrained = oswa->weights.sum_constraint;
    for (size_t i = 0; i < n; ++i)
        right[2 * n + i] = 1.0;
    const size_t remaining = drop(n, taken, matrix, right, 3);
    if (aur_solve_positive(remaining, matrix, constrained ? 3 : 2, right, NULL, NULL) != AUR_OK)
        return solve_plainly(oswa, angle, xyz, weights, error);
    for (size_t k = 0; k < 2; ++k) {
        double *const solution = right + k * remaining;
        if (constrained)
            aur_constrain_sum(remaining, solution, right + 2 * remaining);
        size_t at = 0;
        for (size_t i = 0; i < n; ++i) {
            weights[k * n + i] = taken[i] ? solution[at] : 0.0;
            at += taken[i];
        }
    }
    return AUR_OK;
}

aur_result aur_oswa_solve(const aur_oswa *oswa, double radians, const double turns[2], size_t capacity,
                          double *weights, double *mass, aur_error *error) {
    const size_t n = aur_oswa_size(oswa), doubles = aur_oswa_scratch(oswa);
    const aur_oswa_view view = aur_oswa_view_at(oswa, radians);
    aur_oswa_angle angle;
    aur_result result = aur_check_capacity(aur_oswa_lobes(oswa) * n, capacity, error);
    if (result == AUR_OK)
        result = aur_oswa_angle_init(oswa, view, &angle, error);
    if (result != AUR_OK)
        return result;
    double *const scratch = malloc(doubles * sizeof *scratch + n * sizeof(bool));
    if (scratch != NULL) {
        bool *const visible = (bool *)(scratch + doubles);
        aur_oswa_visible(oswa, view, turns, scratch, visible);
        result = aur_oswa_solve_at(oswa, &angle, turns, visible, scratch, weights, error);
    } else {
        result = aur_fail_memory(error);
    }
    if (result == AUR_OK && mass != NULL)
        *mass = angle.mass;
    free(scratch);
    aur_oswa_angle_release(&angle);
    return result;
}

uint64_t aur_oswa_hash(const aur_oswa *oswa) {
    uint64_t hash = 0;
    for (size_t which = 0; which < 2; ++which) {
        for (size_t i = 0; i < 3 * oswa->count[which]; ++i)
            hash = aur_hash2(hash, (uint64_t)(int64_t)llround(oswa->uniform[which][i] * 0x1p40));
    }
    return hash;
}

aur_result aur_oswa_options_init(size_t count, size_t mirror_count, aur_oswa_options *options,
                                 aur_error *error) {
    static const aur_oswa_options defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_oswa_options", error);
    if (result == AUR_OK) {
        options->count = count;
        options->mirror_count = mirror_count;
    }
    return result;
}
