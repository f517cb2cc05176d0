/* Direct light from triangles by solid angle (Keller 1994, eq. 6; Arvo 1995). */
#pragma once

#include "transport/radiosity/scene.h"

/* The solid angle of a triangle, three corners of three coordinates, seen from a point without obstruction,
 * and a direction in it drawn uniformly by u, v in [0,1). 0 when it is seen edge on. */
double aur_spherical_triangle(const double corner[9], const double from[3], double u, double v,
                              double direction[3]);

/* A point that light is reflected from: its triangle, the side (1 or -1) and the albedo there. */
typedef struct aur_radiosity_place {
    aur_vector position, normal; /* normal: on the side that is seen */
    uint32_t triangle;
    bool front;
    aur_vector albedo, emission;
} aur_radiosity_place;

/* A ray from the place. */
static inline aur_ray aur_radiosity_leave(const aur_radiosity_scene *scene, const aur_radiosity_place *place,
                                          aur_vector direction) {
    return (aur_ray){
        aur_vector_add_scaled(place->position, scene->triangles[place->triangle].offset, place->normal), 0.0f,
        direction, INFINITY};
}

/* One sample of the radiance that the light `triangle` makes the place reflect; 0 when something else is met
 * first. */
aur_vector aur_radiosity_direct(const aur_radiosity_scene *scene, const aur_radiosity_place *place,
                                uint32_t triangle, float u, float v, uint64_t *rays);
