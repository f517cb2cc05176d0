#include "points/pointset/points.h"

#include <aureole/pointset.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/names.h"

aur_result aur_points_create(aur_domain domain, uint64_t count, size_t dimension, bool weighted,
                             aur_points **points, aur_error *error) {
    size_t size = 0;
    aur_points *const created = calloc(1, sizeof *created);
    if (created != NULL && count <= SIZE_MAX / sizeof(double) &&
        aur_size_product((size_t)count * sizeof(double), dimension, &size)) {
        created->coordinates = malloc(size);
        created->weights = weighted ? malloc((size_t)count * sizeof(double)) : NULL;
    }
    if (created == NULL || created->coordinates == NULL || (weighted && created->weights == NULL)) {
        aur_points_destroy(created);
        return aur_fail(error, AUR_ERROR_MEMORY, "%llu points do not fit into memory",
                        (unsigned long long)count);
    }
    created->view = aur_points_view_of(domain, (size_t)count, dimension, created->coordinates);
    created->view.weights = created->weights;
    *points = created;
    return AUR_OK;
}

void aur_points_destroy(aur_points *points) {
    if (points == NULL)
        return;
    free(points->coordinates);
    free(points->weights);
    free(points->lines);
    free(points);
}

const aur_points_view *aur_points_get_view(const aur_points *points) {
    return &points->view;
}

bool aur_points_weighted(const aur_points_view *points) {
    for (size_t i = 0; i < points->count && points->weights != NULL; ++i)
        if (!(fabs(points->weights[i] * (double)points->count - 1.0) <= 1e-12))
            return true;
    return false;
}

bool aur_points_are_above(const aur_points_view *points) {
    bool above = points->domain == AUR_DOMAIN_SPHERE || points->domain == AUR_DOMAIN_HEMISPHERE;
    for (size_t i = 0; i < points->count && above; ++i)
        above = aur_point_at(points, i)[2] >= 0.0;
    return above || points->domain == AUR_DOMAIN_AXES;
}

void aur_points_warn_of_prefix(const aur_points_view *points, uint64_t used, const char *path,
                               const aur_warnings *warnings) {
    if (used < points->count)
        aur_warn_at(
            warnings, (aur_location){.file = path},
            "only the first %llu of the file's %zu points are used: they need not be as even as a set "
            "of that size",
            (unsigned long long)used, points->count);
}

void aur_points_warn_of_guess(const aur_points_view *points, const char *path, const aur_warnings *warnings) {
    if (points->guessed)
        aur_warn_at(warnings, (aur_location){.file = path},
                    "the file does not state the domain of its points; assuming the %s: set the domain if it "
                    "is another one (sphere, axes, cube)",
                    aur_domain_name(points->domain));
}

aur_result aur_points_view_read(const aur_points_view *given, aur_points_view *view, aur_error *error) {
    *view = aur_points_view_of(AUR_DOMAIN_SQUARE, 0, 0, NULL);
    const aur_result result = aur_options_read(given, sizeof *view, view, "aur_points_view", error);
    if (result != AUR_OK)
        return result;
    if (aur_domain_name(view->domain) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown domain %d", (int)view->domain);
    if (view->stride == 0)
        view->stride = view->dimension;
    if (view->stride < view->dimension)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a stride of %zu is too short for points of %zu coordinates", view->stride,
                        view->dimension);
    return AUR_OK;
}

/* The names of the domains. */

static const char *const names[] = {"square", "cube", "disk", "hemisphere", "sphere", "axes", "rotations"};
enum { DOMAIN_COUNT = sizeof names / sizeof names[0] };

aur_result aur_domain_from_name(const char *name, aur_domain *domain, aur_error *error) {
    size_t index;
    const aur_result result =
        aur_names_choose(aur_names_of(DOMAIN_COUNT, names), "domain", name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *domain = (aur_domain)index;
    return result;
}

const char *aur_domain_name(aur_domain domain) {
    return (size_t)domain < DOMAIN_COUNT ? names[domain] : NULL;
}
