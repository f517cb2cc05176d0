/* Elements: all objects that a ray can hit, numbered consecutively over the scene. Every triangle, every
 * segment of a curve and every other curved shape is one element. A shape of a group has elements for each of
 * its instances. Photon maps and radiosity store surface data by element. */
#pragma once

#include "render/scene/scene.h"

/* A shape, possibly in an instance. */
typedef struct aur_placement {
    uint32_t shape, instance; /* instance: AUR_NO_INSTANCE for shapes outside of groups */
    uint32_t first, count;    /* elements */
    bool curved;
} aur_placement;

typedef struct aur_elements {
    size_t count;
    size_t placement_count;
    aur_placement *placements;
    /* The element of a hit is shape_first[shape] + primitive, plus instance_first[instance] for instances. */
    uint32_t *shape_first;
    uint32_t *instance_first;
} aur_elements;

/* Errors: MEMORY, ARGUMENT if 32 bits cannot number all elements. */
aur_result aur_elements_create(const aur_scene *scene, aur_elements *elements);
void aur_elements_release(aur_elements *elements);

static inline uint32_t aur_element_of(const aur_elements *elements, const aur_hit *hit) {
    const uint32_t first = elements->shape_first[hit->shape] + hit->primitive;
    return hit->instance == AUR_NO_INSTANCE ? first : elements->instance_first[hit->instance] + first;
}

/* The area in square scene units. A curved shape in an instance is scaled by the mean scale of its map. */
double aur_element_area(const aur_scene *scene, const aur_placement *placement, uint32_t primitive);
/* The centre of a triangle or of a curved shape's bounding box, and the triangle's unit normal. */
void aur_element_middle(const aur_scene *scene, const aur_placement *placement, uint32_t primitive,
                        aur_vector *position, aur_vector *normal);

/* The corners of a mesh triangle, of a shape outside of groups. */
void aur_shape_corners(const aur_scene *scene, uint32_t shape, uint32_t primitive, aur_vector corner[3]);

/* Area-preserving coordinates: for a triangle the barycentric u, v of the hit (u + v <= 1), for a curved
 * shape a point of the unit square. */
void aur_element_coordinates(const aur_scene *scene, const aur_hit *hit, const aur_surface *surface,
                             float coordinates[2]);

/* Whether the shape is curved rather than a mesh. */
bool aur_shape_is_curved(const aur_scene *scene, uint32_t shape);
/* Whether it is a mesh with flat triangles: without vertex normals. */
bool aur_shape_is_flat(const aur_scene *scene, uint32_t shape);
uint32_t aur_shape_emitter(const aur_scene *scene, uint32_t shape); /* or AUR_NO_EMITTER */
