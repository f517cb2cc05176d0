/* Points of any set on any domain, allocated. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include <aureole/sphere.h>

#include "core/error.h"
#include "core/options.h"
#include "sphere/native.h"

/* Chooses domain and size when the request leaves them to the set. `file` is what a file holds, if it had to
 * be read for it. */
static aur_result natural_domain(const char *set, const aur_points_request *request, aur_domain *domain,
                                 uint64_t *size, aur_points *file, aur_error *error) {
    *domain = request->options->domain;
    if (request->natural_domain && !aur_set_is_file(set))
        *domain = aur_native_find(set) != NULL ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_SQUARE;
    if (!aur_set_is_file(set) || (*size != 0 && !request->natural_domain && *domain != AUR_DOMAIN_DISK))
        return AUR_OK;
    const bool flat =
        !request->natural_domain && (*domain == AUR_DOMAIN_SQUARE || *domain == AUR_DOMAIN_CUBE);
    const aur_result result = flat ? aur_points_read_on(set + 5, AUR_DOMAIN_CUBE, file, error)
                                   : aur_points_read(set + 5, file, error);
    if (result != AUR_OK)
        return result;
    if (request->natural_domain)
        *domain = file->domain;
    if (*size == 0)
        *size = file->count;
    if (*size > file->count)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%s has %zu points, not %llu", set + 5, file->count,
                        (unsigned long long)*size);
    return AUR_OK;
}

/* The part of the set that is asked for, and room for it. */
static aur_result allocate(const aur_points_request *request, uint64_t size, int weighted, aur_points *points,
                           aur_error *error) {
    if (request->first > size || request->count > size - request->first)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a set of %llu points has no points %llu to %llu",
                        (unsigned long long)size, (unsigned long long)request->first,
                        (unsigned long long)(request->first + (request->count > 0 ? request->count - 1 : 0)));
    const uint64_t count = request->count != 0 ? request->count : size - request->first;
    if (count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "no points are asked for");
    if (count > SIZE_MAX / sizeof(double) / points->dimension)
        return aur_fail(error, AUR_ERROR_MEMORY, "%llu points do not fit into memory",
                        (unsigned long long)count);
    points->count = (size_t)count;
    points->coordinates = malloc(points->count * points->dimension * sizeof *points->coordinates);
    points->weights = weighted ? malloc(points->count * sizeof *points->weights) : NULL;
    if (points->coordinates == NULL || (weighted && points->weights == NULL))
        return aur_fail(error, AUR_ERROR_MEMORY, "%llu points do not fit into memory",
                        (unsigned long long)count);
    return AUR_OK;
}

static aur_result fail_generation(aur_result result, aur_error *error) {
    return result == AUR_OK ? AUR_OK : aur_fail(error, result, "%s", aur_result_string(result));
}

/* On the square and the cube. */
static aur_result generate_flat(const char *set, const aur_points_request *request, uint64_t size,
                                size_t dimension, aur_points *points, aur_error *error) {
    const aur_directions_options *const options = request->options;
    if (aur_native_find(set) != NULL)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "set '%s' lives on the sphere: ask for the disk, the hemisphere or the sphere", set);
    const aur_pointset_options wanted = {.size = sizeof wanted,
                                         .count = size,
                                         .dimension = dimension,
                                         .scramble = options->scramble,
                                         .seed = options->seed,
                                         .warnings = options->warnings};
    aur_pointset *pointset;
    aur_result result = aur_pointset_create(set, &wanted, &pointset, error);
    if (result != AUR_OK)
        return result;
    points->dimension = aur_pointset_dimension(pointset);
    result = allocate(request, aur_pointset_size(pointset), 0, points, error);
    if (result == AUR_OK)
        result = fail_generation(aur_pointset_points(pointset, request->first, points->count,
                                                     points->count * points->dimension, points->coordinates),
                                 error);
    aur_pointset_destroy(pointset);
    return result;
}

static aur_result generate_disk(const char *set, const aur_points_request *request, uint64_t size,
                                aur_points *points, aur_error *error) {
    const aur_map map = request->options->map;
    const aur_result result = generate_flat(set, request, size, 2, points, error);
    if (result != AUR_OK)
        return result;
    if (map == AUR_MAP_POLAR) {
        points->weights = malloc(points->count * sizeof *points->weights);
        if (points->weights == NULL)
            return aur_fail_memory(error);
    }
    for (size_t i = 0; i < points->count; ++i) {
        double *const point = points->coordinates + 2 * i;
        const double square[2] = {point[0], point[1]};
        aur_map_to_disk(map, square, point);
        if (points->weights != NULL)
            points->weights[i] = aur_map_weight(map, square) / (double)size;
    }
    return AUR_OK;
}

/* Points of a file that lie on the disk already. */
static aur_result copy_disk(const aur_points *file, const aur_points_request *request, uint64_t size,
                            aur_points *points, aur_error *error) {
    if (request->options->scramble != AUR_SCRAMBLE_NONE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "points that are on the disk already take no scrambling");
    points->dimension = 2;
    const aur_result result = allocate(request, size, file->weights != NULL, points, error);
    if (result != AUR_OK)
        return result;
    memcpy(points->coordinates, file->coordinates + 2 * request->first,
           2 * points->count * sizeof *points->coordinates);
    if (points->weights != NULL)
        memcpy(points->weights, file->weights + request->first, points->count * sizeof *points->weights);
    return AUR_OK;
}

/* From the hemisphere to the disk by Lambert's azimuthal map, in place. */
static void flatten(aur_points *points) {
    points->dimension = 2;
    for (size_t i = 0; i < points->count; ++i) {
        double square[2];
        aur_map_from_hemisphere(AUR_MAP_AZIMUTHAL, points->coordinates + 3 * i, square);
        aur_map_to_disk(AUR_MAP_AZIMUTHAL, square, points->coordinates + 2 * i);
    }
}

static aur_result generate_directions(const char *set, const aur_points_request *request, uint64_t size,
                                      aur_points *points, aur_error *error) {
    aur_directions_options options = *request->options;
    options.domain = points->domain == AUR_DOMAIN_DISK ? AUR_DOMAIN_HEMISPHERE : points->domain;
    options.count = size;
    aur_directions *directions;
    aur_result result = aur_directions_create(set, &options, &directions, error);
    if (result != AUR_OK)
        return result;
    points->dimension = 3;
    result = allocate(request, aur_directions_size(directions), aur_directions_weighted(directions), points,
                      error);
    if (result == AUR_OK)
        result =
            fail_generation(aur_directions_points(directions, request->first, points->count,
                                                  3 * points->count, points->coordinates, points->weights),
                            error);
    aur_directions_destroy(directions);
    if (result == AUR_OK && points->domain == AUR_DOMAIN_DISK)
        flatten(points);
    return result;
}

static aur_result check_flat_options(const aur_directions_options *options, aur_error *error) {
    if (options->lobe.kind != AUR_LOBE_COSINE_POWER || options->lobe.exponent != 0.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a lobe needs the hemisphere as its domain");
    if (options->cap_degrees != 0.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "a cap needs the hemisphere or the sphere as its domain");
    return AUR_OK;
}

/* On points->domain, which is known by now. */
static aur_result generate(const char *set, const aur_points_request *request, uint64_t size,
                           const aur_points *file, aur_points *points, aur_error *error) {
    const aur_domain domain = points->domain;
    const int flat = domain == AUR_DOMAIN_SQUARE || domain == AUR_DOMAIN_CUBE;
    if (flat || domain == AUR_DOMAIN_DISK) {
        const aur_result result = check_flat_options(request->options, error);
        if (result != AUR_OK)
            return result;
    }
    if (flat)
        return generate_flat(set, request, size, request->dimension, points, error);
    if (request->dimension != 0 && request->dimension != 2)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "only the square has other dimensions than its own");
    if (domain != AUR_DOMAIN_DISK)
        return generate_directions(set, request, size, points, error);
    if (file->count > 0 && file->domain == AUR_DOMAIN_DISK)
        return copy_disk(file, request, size, points, error);
    const int directions = file->count > 0 ? file->dimension == 3 && file->domain != AUR_DOMAIN_CUBE
                                           : aur_native_find(set) != NULL;
    return directions ? generate_directions(set, request, size, points, error)
                      : generate_disk(set, request, size, points, error);
}

aur_result aur_points_generate(const char *set, const aur_points_request *given, aur_points *points,
                               aur_error *error) {
    *points = (aur_points){0};
    aur_directions_options options = aur_directions_options_default(0, AUR_DOMAIN_SQUARE);
    aur_points_request request = aur_points_request_default(NULL);
    aur_result result =
        aur_options_read(given, sizeof request, sizeof request, &request, "aur_points_request", error);
    if (result == AUR_OK)
        result = aur_options_read(request.options, sizeof options, sizeof options, &options,
                                  "aur_directions_options", error);
    if (result != AUR_OK)
        return result;
    request.options = &options;
    aur_points file = {0};
    uint64_t size = options.count;
    result = natural_domain(set, &request, &points->domain, &size, &file, error);
    if (result == AUR_OK)
        result = generate(set, &request, size, &file, points, error);
    aur_points_release(&file);
    if (result != AUR_OK) {
        aur_points_release(points);
        *points = (aur_points){0};
    } else if (points->domain == AUR_DOMAIN_SQUARE || points->domain == AUR_DOMAIN_CUBE) {
        points->domain = points->dimension == 2 ? AUR_DOMAIN_SQUARE : AUR_DOMAIN_CUBE;
    }
    return result;
}
