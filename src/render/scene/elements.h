/* Elements: what a ray can hit, numbered one after another over the whole scene - every triangle, every
 * segment of a curve, and every other curved shape as one. A shape of a group counts once for each of its
 * instances. Photon maps and radiosity keep what they know of surfaces by element. */
#pragma once

#include "render/scene/scene.h"

/* One shape where it stands. */
typedef struct aur_placement {
    uint32_t shape, instance; /* instance: AUR_NO_INSTANCE for shapes that are no copies */
    uint32_t first, count;    /* elements */
    bool curved;
} aur_placement;

typedef struct aur_elements {
    size_t count;
    size_t placement_count;
    aur_placement *placements;
    /* The element of a hit is shape_first[shape] + primitive, for instances after instance_first[instance].
     */
    uint32_t *shape_first;
    uint32_t *instance_first;
    bool any_curved;
} aur_elements;

/* Errors: MEMORY, ARGUMENT when there are more elements than 32 bits can number. */
aur_result aur_elements_create(const aur_scene *scene, aur_elements *elements);
void aur_elements_release(aur_elements *elements);

static inline uint32_t aur_element_of(const aur_elements *elements, const aur_hit *hit) {
    const uint32_t first = elements->shape_first[hit->shape] + hit->primitive;
    return hit->instance == AUR_NO_INSTANCE ? first : elements->instance_first[hit->instance] + first;
}

/* Whether the element is a whole curved shape, or a segment of a curve. */
bool aur_element_is_curved(const aur_elements *elements, uint32_t element);

/* The area in square scene units. A curved shape in an instance is scaled by the mean scale of its map. */
double aur_element_area(const aur_scene *scene, const aur_placement *placement, uint32_t primitive);
/* A point in the middle of a triangle, or of a curved shape's box, and the triangle's unit normal. */
void aur_element_middle(const aur_scene *scene, const aur_placement *placement, uint32_t primitive,
                        aur_vector *position, aur_vector *normal);

/* The corners of a mesh's triangle, of a shape that is no copy. */
void aur_shape_corners(const aur_scene *scene, uint32_t shape, uint32_t primitive, aur_vector corner[3]);

/* Coordinates in which equal areas are equal: of a triangle the barycentric u, v of the hit (u + v <= 1), of
 * a curved shape a point of the unit square. */
void aur_element_coordinates(const aur_scene *scene, const aur_hit *hit, const aur_surface *surface,
                             float coordinates[2]);

/* Whether the shape is curved, and not a mesh. */
bool aur_shape_is_curved(const aur_scene *scene, uint32_t shape);
/* Whether it is a mesh whose triangles are flat: no normals at its vertices. */
bool aur_shape_is_flat(const aur_scene *scene, uint32_t shape);
uint32_t aur_shape_emitter(const aur_scene *scene, uint32_t shape); /* or AUR_NO_EMITTER */
