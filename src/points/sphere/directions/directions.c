/* Directions from any set: points of the square are lifted by a map, native directions are used unchanged;
 * then lobe, rotation and weights are applied. Also the table of all sets. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <aureole/sphere.h>

#include "points/base/error.h"
#include "points/base/text.h"
#include "points/base/vector.h"
#include "points/pointset/points.h"
#include "points/pointset/set.h"
#include "points/sphere/lobe.h"
#include "points/sphere/map.h"
#include "points/sphere/native.h"

enum { CHUNK = 128 };

struct aur_directions {
    uint64_t size;
    const aur_native_set *native; /* NULL: a set of the square, or a user's set */
    void *native_data;
    aur_pointset *square;
    aur_points *file; /* of directions; otherwise NULL */
    aur_map map;
    double height;
    aur_lobe lobe;    /* the lobe of the weights */
    aur_lobe density; /* the sampling density */
    bool weighted;    /* the density is not the lobe, the map not uniform, or the set has weights */
    bool warped, rotated;
    bool axes; /* x and -x are one axis, returned with z >= 0 */
    aur_rotation rotation;
};

static aur_result check_options(const aur_directions_options *options, aur_error *error) {
    if (options->domain != AUR_DOMAIN_HEMISPHERE && options->domain != AUR_DOMAIN_SPHERE &&
        options->domain != AUR_DOMAIN_AXES)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "directions live on the hemisphere or the sphere, or they are axes");
    if (aur_map_name(options->map) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown map %d", (int)options->map);
    const double widest = options->domain == AUR_DOMAIN_SPHERE ? 180.0 : 90.0;
    const bool wide = options->cap_degrees > 90.0 && options->cap_degrees <= 180.0;
    if (!(options->cap_degrees >= 0.0 && options->cap_degrees <= widest))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a cap's angle must be above 0 and at most %g degrees, not %g%s", widest,
                        options->cap_degrees, wide ? ": wider ones are for the domain sphere" : "");
    const aur_result result = aur_lobe_check(&options->lobe, error);
    if (result != AUR_OK)
        return result;
    const bool uniform = options->lobe.kind == AUR_LOBE_COSINE_POWER && options->lobe.exponent == 0.0;
    if (!uniform && (options->domain != AUR_DOMAIN_HEMISPHERE || options->cap_degrees != 0.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a lobe needs the whole hemisphere as its domain");
    if (options->scramble == AUR_SCRAMBLE_ROTATE3D &&
        (options->domain == AUR_DOMAIN_HEMISPHERE || options->cap_degrees != 0.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "scrambling 'rotate3d' needs the whole sphere or axes as its domain: use rotate");
    return AUR_OK;
}

/* 1 - cos of the cap's angle, without cancellation. */
static double cap_height(const aur_directions_options *options) {
    if (options->cap_degrees == 0.0)
        return options->domain == AUR_DOMAIN_SPHERE ? 2.0 : 1.0;
    if (options->cap_degrees == 90.0)
        return 1.0;
    const double half = sin(options->cap_degrees * (AUR_PI / 360.0));
    return 2.0 * half * half;
}

static aur_result choose_density(aur_directions *directions, const aur_directions_options *options,
                                 aur_error *error) {
    directions->lobe = directions->density = options->lobe;
    if (options->optimal_density) {
        const double smoothness = options->smoothness != 0.0 ? options->smoothness : 1.5;
        const aur_result result = aur_lobe_optimal(&options->lobe, smoothness, &directions->density, error);
        if (result != AUR_OK)
            return result;
    }
    const bool ggx = aur_lobe_reflects(&options->lobe);
    directions->warped = ggx || directions->density.exponent != 0.0;
    directions->weighted = ggx || directions->density.exponent != directions->lobe.exponent;
    return AUR_OK;
}

/* Scramblings that are rotations are applied here, after the map; the others act on the square. */
static aur_scramble choose_rotation(aur_directions *directions, const aur_directions_options *options) {
    directions->rotated = true;
    if (options->scramble == AUR_SCRAMBLE_ROTATE) {
        aur_rotation_axial(options->seed, &directions->rotation);
        return AUR_SCRAMBLE_NONE;
    }
    if (options->scramble == AUR_SCRAMBLE_ROTATE3D) {
        aur_rotation_uniform(options->seed, &directions->rotation);
        return AUR_SCRAMBLE_NONE;
    }
    directions->rotated = false;
    return options->scramble;
}

static aur_result refuse_scramble(const char *set, aur_scramble scramble, aur_error *error) {
    const char *const name = aur_scramble_name(scramble);
    return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                    "set '%s': scrambling '%s' has no meaning on the sphere: use rotate or rotate3d", set,
                    name != NULL ? name : "?");
}

static aur_result open_square(const char *set, const aur_directions_options *options, uint64_t count,
                              aur_scramble scramble, aur_directions *directions, aur_error *error) {
    const aur_pointset_options requested = {.size = sizeof requested,
                                            .count = count,
                                            .dimension = 2,
                                            .scramble = scramble,
                                            .seed = options->seed,
                                            .warnings = options->warnings};
    directions->weighted = directions->weighted || directions->map == AUR_MAP_POLAR;
    const aur_result result = aur_pointset_create(set, &requested, &directions->square, error);
    if (result == AUR_OK)
        directions->size = aur_pointset_size(directions->square);
    return result;
}

static aur_result open_file(const char *set, const aur_directions_options *options, aur_scramble scramble,
                            aur_directions *directions, aur_error *error) {
    const char *const path = strchr(set, ':') + 1;
    const aur_user_request request = {.set = set, .count = options->count};
    const aur_result result = aur_user_points(&request, &directions->file, error);
    if (result != AUR_OK)
        return result;
    const aur_points_view *const file = aur_points_get_view(directions->file);
    const uint64_t count = options->count != 0 ? options->count : file->count;
    if (count > file->count)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%s has %zu points, not %llu", path, file->count,
                        (unsigned long long)count);
    if (file->domain == AUR_DOMAIN_DISK)
        return aur_fail_at(
            error, (aur_location){.file = path}, AUR_ERROR_UNSUPPORTED,
            "its points are on the disk (header x,y), neither directions nor on the square (u,v)");
    if (file->domain != AUR_DOMAIN_HEMISPHERE && file->domain != AUR_DOMAIN_SPHERE &&
        file->domain != AUR_DOMAIN_AXES) {
        aur_points_destroy(directions->file);
        directions->file = NULL;
        return open_square(set, options, count, scramble, directions, error);
    }
    if (scramble != AUR_SCRAMBLE_NONE)
        return refuse_scramble(set, scramble, error);
    for (size_t i = 0; i < count && !directions->axes; ++i)
        if (file->coordinates[3 * i + 2] < 1.0 - directions->height)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "%s: point %zu has z = %g, off the domain '%s'", path,
                            i + 1, file->coordinates[3 * i + 2], aur_domain_name(options->domain));
    directions->size = count;
    directions->weighted = directions->weighted || aur_points_weighted(file);
    aur_points_warn_of_prefix(file, count, path, &options->warnings);
    if (!file->guessed && (file->domain == AUR_DOMAIN_AXES || options->domain == AUR_DOMAIN_SPHERE) &&
        file->domain != options->domain)
        aur_warn_at(&options->warnings, (aur_location){.file = path},
                    "the file's points are of the domain '%s', and are taken for points of the domain '%s'",
                    aur_domain_name(file->domain), aur_domain_name(options->domain));
    return AUR_OK;
}

static aur_result open_set(const char *set, const aur_directions_options *options, aur_directions *directions,
                           aur_error *error) {
    aur_result result = choose_density(directions, options, error);
    if (result != AUR_OK)
        return result;
    const aur_scramble scramble = choose_rotation(directions, options);
    directions->map = options->map;
    directions->height = cap_height(options);
    directions->axes = options->domain == AUR_DOMAIN_AXES;
    if (aur_set_is_user(set))
        return open_file(set, options, scramble, directions, error);
    directions->native = aur_native_find(set);
    result = aur_set_check_name(set, error);
    if (result != AUR_OK)
        return result;
    if (directions->native == NULL)
        return open_square(set, options, options->count, scramble, directions, error);
    if (scramble != AUR_SCRAMBLE_NONE)
        return refuse_scramble(set, scramble, error);
    const aur_native_request request = {options->domain, options->count, directions->height,
                                        &options->warnings};
    directions->size = options->count;
    directions->weighted = directions->weighted || directions->native->weigh != NULL;
    return aur_native_open(directions->native, set, &request, &directions->native_data, error);
}

aur_result aur_directions_create(const char *set, const aur_directions_options *options,
                                 aur_directions **directions, aur_error *error) {
    *directions = NULL;
    aur_directions_options copy = {.size = sizeof copy};
    aur_directions_options_init(0, AUR_DOMAIN_HEMISPHERE, &copy, NULL);
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_directions_options", error);
    if (result == AUR_OK)
        result = check_options(&copy, error);
    if (result != AUR_OK)
        return result;
    aur_directions *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    result = open_set(set, &copy, created, error);
    if (result != AUR_OK) {
        aur_directions_destroy(created);
        return result;
    }
    *directions = created;
    return AUR_OK;
}

void aur_directions_destroy(aur_directions *directions) {
    if (directions == NULL)
        return;
    aur_pointset_destroy(directions->square);
    aur_points_destroy(directions->file);
    free(directions->native_data);
    free(directions);
}

uint64_t aur_directions_size(const aur_directions *directions) {
    return directions->size;
}

bool aur_directions_weighted(const aur_directions *directions) {
    return directions->weighted;
}

static aur_result lift(const aur_directions *directions, uint64_t first, size_t count, double *xyz,
                       double *weights, aur_error *error) {
    double square[2 * CHUNK];
    const aur_result result = aur_pointset_points(directions->square, first, count, 2 * CHUNK, square, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        aur_point_to_cap(directions->map, directions->height, square + 2 * i, xyz + 3 * i);
        if (weights != NULL)
            weights[i] *= aur_map_weight(directions->map, square + 2 * i);
    }
    return result;
}

static void take_from_file(const aur_directions *directions, uint64_t first, size_t count, double *xyz,
                           double *weights) {
    const aur_points_view *const file = aur_points_get_view(directions->file);
    memcpy(xyz, file->coordinates + 3 * first, 3 * count * sizeof *xyz);
    if (weights != NULL && file->weights != NULL)
        memcpy(weights, file->weights + first, count * sizeof *weights);
}

/* Weights p/q of a density, or 0 below the horizon. */
static double density_weight(const aur_directions *directions, const double direction[3]) {
    if (aur_lobe_reflects(&directions->lobe))
        return direction[2] >= 0.0 ? 1.0 : 0.0;
    const double p = directions->lobe.exponent;
    const double q = directions->density.exponent;
    return p != q ? (p + 1.0) / (q + 1.0) * pow(direction[2], p - q) : 1.0;
}

/* Selects the end of each axis with z >= 0. */
static void turn_up(size_t count, double *xyz) {
    for (size_t i = 0; i < count; ++i) {
        const double sign = xyz[3 * i + 2] < 0.0 ? -1.0 : 1.0;
        for (size_t d = 0; d < 3; ++d)
            xyz[3 * i + d] *= sign;
    }
}

/* At most CHUNK points, inside the set. */
static aur_result fill_chunk(const aur_directions *directions, uint64_t first, size_t count, double *xyz,
                             double *weights, aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && weights != NULL; ++i)
        weights[i] = 1.0 / (double)directions->size;
    if (directions->native != NULL) {
        directions->native->fill(directions->native_data, first, count, xyz);
        if (weights != NULL && directions->native->weigh != NULL)
            directions->native->weigh(directions->native_data, first, count, weights);
    } else if (directions->square != NULL)
        result = lift(directions, first, count, xyz, weights, error);
    else
        take_from_file(directions, first, count, xyz, weights);
    for (size_t i = 0; i < count && directions->warped && result == AUR_OK; ++i) {
        aur_lobe_warp(&directions->density, 1, xyz + 3 * i, xyz + 3 * i);
        if (weights != NULL)
            weights[i] *= density_weight(directions, xyz + 3 * i);
    }
    if (directions->rotated)
        aur_rotation_apply(&directions->rotation, count, xyz);
    if (directions->axes)
        turn_up(count, xyz);
    return result;
}

/* Coordinates of points `at` .. at+count-1 from values[dimension * count] to the output. */
static void store(const aur_output *to, const aur_strides *strides, size_t dimension, size_t at, size_t count,
                  const double *values) {
    for (size_t d = 0; d < dimension; ++d) {
        const size_t first = at * strides->point + d * strides->coordinate;
        for (size_t i = 0; i < count && to->doubles != NULL; ++i)
            to->doubles[first + i * strides->point] = values[dimension * i + d];
        for (size_t i = 0; i < count && to->floats != NULL; ++i)
            to->floats[first + i * strides->point] = (float)values[dimension * i + d];
    }
}

aur_result aur_directions_generate(const aur_directions *directions, uint64_t first, size_t count,
                                   const aur_output *xyz, const aur_output *weights, aur_error *error) {
    aur_strides xyz_strides, weight_strides;
    aur_result result = aur_check_range(directions->size, first, count, error);
    if (result == AUR_OK)
        result = aur_output_open(xyz, 3, count, &xyz_strides, error);
    if (result == AUR_OK && weights != NULL)
        result = aur_output_open(weights, 1, count, &weight_strides, error);
    if (result != AUR_OK)
        return result;
    const bool in_place = xyz->doubles != NULL && xyz->layout == AUR_LAYOUT_POINTS;
    if (directions->native != NULL && !directions->warped && !directions->rotated && !directions->axes &&
        in_place && weights == NULL) {
        directions->native->fill(directions->native_data, first, count, xyz->doubles);
        return AUR_OK;
    }
    double part_xyz[3 * CHUNK];
    double part_weights[CHUNK];
    for (size_t done = 0; done < count; done += CHUNK) {
        const size_t part = count - done < CHUNK ? count - done : CHUNK;
        double *const to = in_place ? xyz->doubles + 3 * done : part_xyz;
        result = fill_chunk(directions, first + done, part, to, weights != NULL ? part_weights : NULL, error);
        if (result != AUR_OK)
            return result;
        if (!in_place)
            store(xyz, &xyz_strides, 3, done, part, part_xyz);
        if (weights != NULL)
            store(weights, &weight_strides, 1, done, part, part_weights);
    }
    return AUR_OK;
}

aur_result aur_directions_points(const aur_directions *directions, uint64_t first, size_t count,
                                 size_t capacity, double *xyz, double *weights, aur_error *error) {
    const aur_output to = {.capacity = capacity, .doubles = xyz};
    const aur_output weights_to = {.capacity = capacity / 3, .doubles = weights};
    return aur_directions_generate(directions, first, count, &to, weights != NULL ? &weights_to : NULL,
                                   error);
}

aur_result aur_directions_options_init(uint64_t count, aur_domain domain, aur_directions_options *options,
                                       aur_error *error) {
    static const aur_directions_options defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_directions_options", error);
    if (result == AUR_OK) {
        options->count = count;
        options->domain = domain;
    }
    return result;
}
