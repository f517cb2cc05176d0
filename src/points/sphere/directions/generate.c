/* Points of any set on any domain, in newly allocated arrays. */
#include <string.h>

#include <aureole/rotations.h>

#include "points/base/error.h"
#include "points/pointset/points.h"
#include "points/pointset/set.h"
#include "points/sphere/map.h"
#include "points/sphere/native.h"

/* The request with domain and size filled in. */
typedef struct job {
    const char *set;
    const aur_points_request *request;
    const aur_directions_options *options; /* the request's */
    aur_domain domain;
    uint64_t size;
    aur_points *file; /* contents of a file, if it was read to find domain and size */
    aur_error *error;
} job;

static bool is_flat(aur_domain domain) {
    return domain == AUR_DOMAIN_SQUARE || domain == AUR_DOMAIN_CUBE;
}

static aur_domain natural_domain(const aur_native_set *native) {
    if (native == NULL)
        return AUR_DOMAIN_SQUARE;
    return (native->description.domains & AUR_ON_ROTATIONS) != 0 ? AUR_DOMAIN_ROTATIONS : AUR_DOMAIN_SPHERE;
}

/* Takes domain and size from the set if the request does not specify them. */
static aur_result choose_domain(job *j) {
    const aur_points_request *const request = j->request;
    j->domain = j->options->domain;
    j->size = j->options->count;
    if (!aur_set_is_user(j->set)) {
        if (request->natural_domain)
            j->domain = natural_domain(aur_native_find(j->set));
        return AUR_OK;
    }
    if (j->size != 0 && !request->natural_domain && j->domain != AUR_DOMAIN_DISK &&
        j->domain != AUR_DOMAIN_ROTATIONS)
        return AUR_OK;
    const char *const path = strchr(j->set, ':') + 1;
    const aur_domain cube = AUR_DOMAIN_CUBE;
    const bool flat = !request->natural_domain && is_flat(j->domain);
    const aur_result result =
        aur_user_points(&(const aur_user_request){j->set, j->size, request->dimension, flat ? &cube : NULL},
                        &j->file, j->error);
    if (result != AUR_OK)
        return result;
    const aur_points_view *const held = aur_points_get_view(j->file);
    if (request->natural_domain) {
        j->domain = held->domain;
        aur_points_warn_of_guess(held, path, &j->options->warnings);
    }
    if (j->size == 0)
        j->size = held->count;
    if (j->size > held->count)
        return aur_fail(j->error, AUR_ERROR_ARGUMENT, "%s has %zu points, not %llu", path, held->count,
                        (unsigned long long)j->size);
    return AUR_OK;
}

/* Allocates the requested part of a set of `size` points. */
static aur_result allocate(const job *j, uint64_t size, size_t dimension, bool weighted,
                           aur_points **points) {
    const aur_points_request *const request = j->request;
    const aur_result result = aur_check_range(size, request->first, request->count, j->error);
    if (result != AUR_OK)
        return result;
    const uint64_t count = request->count != 0 ? request->count : size - request->first;
    if (count == 0)
        return aur_fail(j->error, AUR_ERROR_ARGUMENT, "the number of points is 0");
    return aur_points_create(j->domain, count, dimension, weighted, points, j->error);
}

/* Points on the square and the cube, with memory for weights if requested. */
static aur_result generate_flat(const job *j, size_t dimension, bool weighted, aur_points **points) {
    if (aur_native_find(j->set) != NULL)
        return aur_fail(j->error, AUR_ERROR_UNSUPPORTED,
                        "set '%s' is a set of the sphere: expected the domain disk, hemisphere or sphere",
                        j->set);
    const aur_pointset_options requested = {.size = sizeof requested,
                                            .count = j->size,
                                            .dimension = dimension,
                                            .scramble = j->options->scramble,
                                            .seed = j->options->seed,
                                            .warnings = j->options->warnings};
    aur_pointset *pointset;
    aur_result result = aur_pointset_create(j->set, &requested, &pointset, j->error);
    if (result != AUR_OK)
        return result;
    dimension = aur_pointset_dimension(pointset);
    result = allocate(j, aur_pointset_size(pointset), dimension, weighted, points);
    if (result == AUR_OK) {
        const size_t count = (*points)->view.count;
        result = aur_pointset_points(pointset, j->request->first, count, count * dimension,
                                     (*points)->coordinates, j->error);
    }
    if (result == AUR_OK && is_flat(j->domain))
        (*points)->view.domain = dimension == 2 ? AUR_DOMAIN_SQUARE : AUR_DOMAIN_CUBE;
    aur_pointset_destroy(pointset);
    return result;
}

static aur_result generate_disk(const job *j, aur_points **points) {
    const aur_map map = j->options->map;
    const bool weighted = map == AUR_MAP_POLAR;
    const aur_result result = generate_flat(j, 2, weighted, points);
    for (size_t i = 0; result == AUR_OK && i < (*points)->view.count; ++i) {
        double *const point = (*points)->coordinates + 2 * i;
        const double square[2] = {point[0], point[1]};
        aur_point_to_disk(map, square, point);
        if (weighted)
            (*points)->weights[i] = aur_map_weight(map, square) / (double)j->size;
    }
    return result;
}

/* Points of a file on the disk. */
static aur_result copy_disk(const job *j, aur_points **points) {
    if (j->options->scramble != AUR_SCRAMBLE_NONE)
        return aur_fail(j->error, AUR_ERROR_UNSUPPORTED,
                        "points that are on the disk already take no scrambling");
    const aur_points_view *const held = aur_points_get_view(j->file);
    aur_points_warn_of_prefix(held, j->size, strchr(j->set, ':') + 1, &j->options->warnings);
    const aur_result result = allocate(j, j->size, 2, held->weights != NULL, points);
    if (result != AUR_OK)
        return result;
    const size_t count = (*points)->view.count;
    memcpy((*points)->coordinates, aur_point_at(held, j->request->first), 2 * count * sizeof(double));
    if (held->weights != NULL)
        memcpy((*points)->weights, held->weights + j->request->first, count * sizeof(double));
    return AUR_OK;
}

/* From the hemisphere to the disk by Lambert's azimuthal map, in place. */
static void flatten(aur_points *points) {
    points->view.dimension = points->view.stride = 2;
    for (size_t i = 0; i < points->view.count; ++i) {
        double square[2];
        aur_point_from_cap(AUR_MAP_AZIMUTHAL, AUR_CAP_HEMISPHERE, points->coordinates + 3 * i, square);
        aur_point_to_disk(AUR_MAP_AZIMUTHAL, square, points->coordinates + 2 * i);
    }
}

static aur_result generate_directions(const job *j, aur_points **points) {
    aur_directions_options options = *j->options;
    options.domain = j->domain == AUR_DOMAIN_DISK ? AUR_DOMAIN_HEMISPHERE : j->domain;
    options.count = j->size;
    aur_directions *directions;
    aur_result result = aur_directions_create(j->set, &options, &directions, j->error);
    if (result != AUR_OK)
        return result;
    result = allocate(j, aur_directions_size(directions), 3, aur_directions_weighted(directions), points);
    if (result == AUR_OK) {
        const size_t count = (*points)->view.count;
        result = aur_directions_points(directions, j->request->first, count, 3 * count,
                                       (*points)->coordinates, (*points)->weights, j->error);
    }
    aur_directions_destroy(directions);
    if (result == AUR_OK && j->domain == AUR_DOMAIN_DISK)
        flatten(*points);
    return result;
}

static aur_result generate_rotations(const job *j, aur_points **points) {
    const aur_rotations_options requested = {.size = sizeof requested,
                                             .count = j->size,
                                             .scramble = j->options->scramble,
                                             .seed = j->options->seed,
                                             .warnings = j->options->warnings};
    aur_rotations *rotations;
    aur_result result = aur_rotations_create(j->set, &requested, &rotations, j->error);
    if (result != AUR_OK)
        return result;
    result = allocate(j, aur_rotations_size(rotations), 4, false, points);
    if (result == AUR_OK)
        result = aur_rotations_points(rotations, j->request->first, (*points)->view.count,
                                      4 * (*points)->view.count, (*points)->coordinates, j->error);
    aur_rotations_destroy(rotations);
    return result;
}

/* Rotations of a file, unchanged. */
static aur_result copy_rotations(const job *j, aur_points **points) {
    const aur_points_view *const held = aur_points_get_view(j->file);
    aur_points_warn_of_prefix(held, j->size, strchr(j->set, ':') + 1, &j->options->warnings);
    const aur_result result = allocate(j, j->size, 4, held->weights != NULL, points);
    if (result != AUR_OK)
        return result;
    const size_t count = (*points)->view.count;
    memcpy((*points)->coordinates, aur_point_at(held, j->request->first), 4 * count * sizeof(double));
    if (held->weights != NULL)
        memcpy((*points)->weights, held->weights + j->request->first, count * sizeof(double));
    return AUR_OK;
}

static aur_result generate(const job *j, aur_points **points) {
    const aur_directions_options *const options = j->options;
    const aur_points_view *const held = j->file != NULL ? aur_points_get_view(j->file) : NULL;
    const bool rotations = j->domain == AUR_DOMAIN_ROTATIONS;
    if (is_flat(j->domain) || j->domain == AUR_DOMAIN_DISK || rotations) {
        if (options->lobe.kind != AUR_LOBE_COSINE_POWER || options->lobe.exponent != 0.0)
            return aur_fail(j->error, AUR_ERROR_UNSUPPORTED, "a lobe needs the hemisphere as its domain");
        if (options->cap_degrees != 0.0)
            return aur_fail(j->error, AUR_ERROR_UNSUPPORTED,
                            "a cap needs the hemisphere or the sphere as its domain");
    }
    if (is_flat(j->domain))
        return generate_flat(j, j->request->dimension, false, points);
    if (j->request->dimension != 0 && j->request->dimension != 2)
        return aur_fail(j->error, AUR_ERROR_ARGUMENT, "only the cube takes a number of dimensions");
    if (rotations && held != NULL && held->domain == AUR_DOMAIN_ROTATIONS &&
        options->scramble == AUR_SCRAMBLE_NONE)
        return copy_rotations(j, points);
    if (rotations)
        return generate_rotations(j, points);
    if (j->domain != AUR_DOMAIN_DISK)
        return generate_directions(j, points);
    if (held != NULL && held->domain == AUR_DOMAIN_DISK)
        return copy_disk(j, points);
    const bool directions = held != NULL ? held->dimension == 3 && held->domain != AUR_DOMAIN_CUBE
                                         : aur_native_find(j->set) != NULL;
    return directions ? generate_directions(j, points) : generate_disk(j, points);
}

aur_result aur_points_generate(const char *set, const aur_points_request *given, aur_points **points,
                               aur_error *error) {
    *points = NULL;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(0, AUR_DOMAIN_SQUARE, &options, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(NULL, &request, NULL);
    aur_result result = aur_options_read(given, sizeof request, &request, "aur_points_request", error);
    if (result == AUR_OK)
        result = aur_options_read(request.options, sizeof options, &options, "aur_directions_options", error);
    if (result != AUR_OK)
        return result;
    job j = {.set = set, .request = &request, .options = &options, .error = error};
    result = choose_domain(&j);
    if (result == AUR_OK)
        result = generate(&j, points);
    aur_points_destroy(j.file);
    if (result != AUR_OK) {
        aur_points_destroy(*points);
        *points = NULL;
    }
    return result;
}

aur_result aur_points_request_init(const aur_directions_options *options, aur_points_request *request,
                                   aur_error *error) {
    static const aur_points_request defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, request, "aur_points_request", error);
    if (result == AUR_OK)
        request->options = options;
    return result;
}
