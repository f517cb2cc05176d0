/* Finds surfaces so close above the sensor's surface that rays, which start at an offset from it, would start
 * beyond them. Double precision resolves their order. */
#include <float.h>

#include "lighting/irradiance/sensor_trace.h"
#include "points/base/vector3d.h"
#include "render/scene/scene_data.h"

enum { MOST_NEAR = 32 };

/* A surface that the axis intersects. */
typedef struct near_surface {
    aur_hit hit;
    double distance, slack; /* distance along the axis, and its error bound */
    bool exact, edge;       /* corners are available in doubles; the axis passes its boundary */
} near_surface;

typedef struct near_search {
    const aur_scene *scene;
    double from[3], axis[3], farthest, coarse;
    size_t count;
    bool full;
    near_surface found[MOST_NEAR];
} near_search;

/* The corners of a triangle relative to the scene's origin; false if only floats are available. */
static bool find_corners(const aur_scene *scene, const aur_hit *hit, double corners[3][3]) {
    const aur_mesh *const mesh = &scene->shapes[hit->shape]->mesh;
    const aur_instance *const instance =
        hit->instance != AUR_NO_INSTANCE ? scene->instances[hit->instance] : NULL;
    const double *const origin = instance != NULL ? instance->group->origin : scene->origin;
    for (size_t c = 0; c < 3; ++c) {
        const size_t vertex = mesh->indices[3 * (size_t)hit->primitive + c];
        double local[3];
        for (size_t d = 0; d < 3; ++d)
            local[d] = mesh->points != NULL ? mesh->points[3 * vertex + d] - origin[d]
                                            : (double)mesh->positions[3 * vertex + d];
        if (instance != NULL)
            aur_transform_point(&instance->to_world, local, corners[c]);
        else
            memcpy(corners[c], local, sizeof local);
    }
    return mesh->points != NULL;
}

/* Intersection of the axis with the triangle's plane; accepted if the smallest barycentric coordinate is
 * above a small negative tolerance. */
static bool meet_triangle(const near_search *search, const double corners[3][3], near_surface *found) {
    aur_plane plane;
    double between[3], at[3], sides[2][3], way[3], cross[3];
    const double width = aur_polygon_plane(3, corners, &plane);
    const double cosine = aur_dot3(plane.normal, search->axis);
    if (!(width > 0.0) || !(fabs(cosine) > 0.99))
        return false;
    for (size_t d = 0; d < 3; ++d)
        between[d] = corners[0][d] - search->from[d];
    found->distance = aur_dot3(plane.normal, between) / cosine;
    for (size_t d = 0; d < 3; ++d) {
        at[d] = search->from[d] + found->distance * search->axis[d];
        sides[0][d] = corners[1][d] - corners[0][d];
        sides[1][d] = corners[2][d] - corners[0][d];
        way[d] = at[d] - corners[0][d];
    }
    aur_cross3(sides[0], sides[1], cross);
    const double area = aur_dot3(plane.normal, cross);
    aur_cross3(way, sides[1], cross);
    const double u = aur_dot3(plane.normal, cross) / area;
    aur_cross3(sides[0], way, cross);
    const double v = aur_dot3(plane.normal, cross) / area, least = fmin(fmin(u, v), 1.0 - u - v);
    found->hit.u = (float)fmin(fmax(u, 0.0), 1.0);
    found->hit.v = (float)fmin(fmax(v, 0.0), 1.0 - fmin(fmax(u, 0.0), 1.0));
    found->edge = least < 1e-6;
    return least > -1e-9;
}

/* The same for a disk, whose position and axes are floats. */
static bool meet_disk(const near_search *search, const aur_shape *shape, near_surface *found) {
    double center[3], normal[3], across[2][3], between[3], squared = 0.0;
    aur_vector_to_doubles(shape->center, center);
    aur_vector_to_doubles(shape->axis[2], normal);
    aur_normalize3(normal);
    const double cosine = aur_dot3(normal, search->axis);
    if (!(fabs(cosine) > 0.99))
        return false;
    for (size_t d = 0; d < 3; ++d)
        between[d] = center[d] - search->from[d];
    found->distance = aur_dot3(normal, between) / cosine;
    const double aa = (double)aur_vector_dot(shape->axis[0], shape->axis[0]);
    const double bb = (double)aur_vector_dot(shape->axis[1], shape->axis[1]);
    for (size_t k = 0; k < 2; ++k) {
        aur_vector_to_doubles(shape->axis[k], across[k]);
        const double part = aur_dot3(across[k], between) / (k == 0 ? aa : bb);
        squared += part * part;
    }
    found->edge = squared > 0.999998;
    return squared <= 1.0 && squared >= (double)shape->inner * (double)shape->inner;
}

static void take(void *context, const aur_hit *hit) {
    near_search *const search = context;
    const aur_shape *const shape = search->scene->shapes[hit->shape];
    near_surface found = {.hit = *hit};
    double corners[3][3] = {{0.0}};
    if (shape->curved == NULL) {
        found.exact = find_corners(search->scene, hit, corners);
        if (!meet_triangle(search, (const double(*)[3])corners, &found))
            return;
    } else if (!shape->ellipse || hit->instance != AUR_NO_INSTANCE || !meet_disk(search, shape, &found)) {
        return;
    }
    if (!(fabs(found.distance) <= search->farthest))
        return;
    /* Sixteen rounding errors of world coordinates. */
    double reach = 0.0;
    for (size_t d = 0; d < 3; ++d)
        reach += fabs(search->scene->origin[d]) + fabs(search->from[d]) + fabs(corners[0][d]);
    found.slack = found.exact ? 16.0 * DBL_EPSILON * reach : search->coarse;
    search->full |= search->count == MOST_NEAR;
    if (search->count < MOST_NEAR)
        search->found[search->count++] = found;
}

static bool hides(const aur_scene *scene, const near_surface *found) {
    const aur_bsdf *const bsdf = scene->shapes[found->hit.shape]->bsdf;
    return !bsdf->transmits && !bsdf->passes;
}

/* Whether the data cannot order the two surfaces, or cannot determine between which of them the sensor lies:
 * it is in front of the nearest one, but between both. Neighbours share an edge. */
static bool is_doubtful(const near_surface *nearest, const near_surface *other) {
    const double slack = fmax(nearest->slack, other->slack);
    if (!(nearest->exact && other->exact) && fabs(other->distance - nearest->distance) <= slack)
        return !(nearest->edge && other->edge);
    return nearest->distance > slack && other->distance < -slack;
}

void aur_sensor_find_cover(const aur_scene *scene, const double from[3], aur_vector axis, float offset,
                           aur_sensor_point *surface_point) {
    near_search search = {.scene = scene, .farthest = 4.0 * (double)offset, .coarse = 0.1 * (double)offset};
    memcpy(search.from, from, sizeof search.from);
    aur_vector_to_doubles(axis, search.axis);
    aur_normalize3(search.axis);
    const aur_vector at = {(float)from[0], (float)from[1], (float)from[2]};
    aur_scene_near(scene, at, 5.0f * offset, take, &search);
    const near_surface *nearest = search.found;
    for (size_t i = 1; i < search.count; ++i)
        if (fabs(search.found[i].distance) < fabs(nearest->distance))
            nearest = &search.found[i];
    double cover = 3.0 * (double)offset; /* rays start at an offset of 2, and certainly hit what is one offset
                                          * further away */
    surface_point->doubtful |= search.full;
    for (size_t i = 0; i < search.count; ++i) {
        const near_surface *const found = &search.found[i];
        if (found == nearest || !hides(scene, found))
            continue;
        surface_point->doubtful |= is_doubtful(nearest, found);
        if (!(found->distance > nearest->distance + fmax(nearest->slack, found->slack)) ||
            !(found->distance < cover))
            continue;
        cover = found->distance;
        surface_point->covered = true;
        aur_surface surface;
        const aur_ray ray = {at, 0.0f, axis, INFINITY};
        aur_scene_surface(scene, &ray, &found->hit, &surface);
        const float cosine = aur_vector_dot(axis, surface_point->frame.z);
        const aur_vector light = aur_surface_emission(scene, &surface, aur_vector_scale(axis, -1.0f));
        aur_vector_to_doubles(aur_vector_scale(light, 0.5f * AUR_PI_F * (1.0f + cosine)),
                              surface_point->closed);
    }
}
