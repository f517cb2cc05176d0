#include "pointset/points.h"

#include <stdlib.h>

#include "core/array.h"
#include "core/error.h"
#include "core/options.h"

aur_result aur_points_create(aur_domain domain, uint64_t count, size_t dimension, bool weighted,
                             aur_points **points, aur_error *error) {
    size_t size = 0;
    aur_points *const made = calloc(1, sizeof *made);
    if (made != NULL && count <= SIZE_MAX / sizeof(double) &&
        aur_size_product((size_t)count * sizeof(double), dimension, &size)) {
        made->coordinates = malloc(size);
        made->weights = weighted ? malloc((size_t)count * sizeof(double)) : NULL;
    }
    if (made == NULL || made->coordinates == NULL || (weighted && made->weights == NULL)) {
        aur_points_destroy(made);
        return aur_fail(error, AUR_ERROR_MEMORY, "%llu points do not fit into memory",
                        (unsigned long long)count);
    }
    made->view = aur_points_view_of(domain, (size_t)count, dimension, made->coordinates);
    made->view.weights = made->weights;
    *points = made;
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

const aur_points_view *aur_points_look(const aur_points *points) {
    return &points->view;
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
