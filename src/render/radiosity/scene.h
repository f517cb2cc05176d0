/* The scene for radiosity (Keller 1994, section 1): disjoint diffuse triangles, each with a local frame, and
 * mirrors. Patches receive light: first the front of each triangle, in the scene's order, then the backs of
 * triangles that reflect on both sides. */
#pragma once

#include "points/base/error.h"
#include "render/scene/scene.h"

#define AUR_NO_PATCH UINT32_MAX

enum {
    AUR_RADIOSITY_TEXTURED = 1, /* the albedo varies over the triangle */
    AUR_RADIOSITY_MIRROR = 2,   /* only Dirac directions: particles continue without being counted */
    AUR_RADIOSITY_GLOWS = 4,    /* a light, on the side of the normal */
    AUR_RADIOSITY_TEXTURED_LIGHT = 8
};

typedef struct aur_radiosity_triangle {
    aur_vector corner, edge[2];
    aur_frame frame; /* z: the geometric normal */
    float offset;    /* how far from the plane rays begin */
    uint32_t back;   /* the patch on its back, or AUR_NO_PATCH */
    uint32_t flags;
    uint32_t shape;
    aur_vector albedo[2]; /* diffuse, front and back; of textured triangles their mean */
} aur_radiosity_triangle;

typedef struct aur_radiosity_scene {
    const aur_scene *scene;
    size_t triangle_count, patch_count;
    aur_radiosity_triangle *triangles;
    double *areas;        /* of triangles */
    aur_vector *emission; /* of triangles: mean radiance */
    uint32_t *first;      /* shape -> its first triangle */
    uint32_t *behind;     /* patch - triangle_count -> the triangle of that back */
    double area;          /* of all triangles */
    double glow_area;     /* of the lights: |S_0| */
    uint64_t hash;        /* of all that light depends on */
} aur_radiosity_scene;

/* Errors: UNSUPPORTED, with the position, for shapes other than triangle meshes, for a scene without light or
 * with lights of no area; warnings for albedos of 1 and for materials whose glossy part is ignored. `variant`
 * other than 0 turns every local frame by a random angle. */
aur_result aur_radiosity_scene_create(const aur_scene *scene, uint64_t variant, const aur_warnings *warnings,
                                      aur_radiosity_scene *created, aur_error *error);
void aur_radiosity_scene_release(aur_radiosity_scene *scene);

/* The triangle of a patch. */
static inline uint32_t aur_radiosity_triangle_of(const aur_radiosity_scene *scene, size_t patch) {
    return patch < scene->triangle_count ? (uint32_t)patch : scene->behind[patch - scene->triangle_count];
}

static inline uint32_t aur_radiosity_triangle_at(const aur_radiosity_scene *scene, const aur_hit *hit) {
    return scene->first[hit->shape] + hit->primitive;
}

/* A point of a triangle, moved a millionth away from its edges, where neighbouring walls begin. */
static inline aur_vector aur_radiosity_point(const aur_radiosity_triangle *triangle, float u, float v) {
    const float inset = 1e-6f;
    const aur_vector p =
        aur_vector_add_scaled(triangle->corner, u + inset * (1.0f - 3.0f * u), triangle->edge[0]);
    return aur_vector_add_scaled(p, v + inset * (1.0f - 3.0f * v), triangle->edge[1]);
}

/* Diffuse albedo where a ray has hit a triangle; `front`: on the side of the normal. */
AUR_INTERNAL aur_vector aur_radiosity_albedo(const aur_radiosity_scene *scene, uint32_t triangle, bool front,
                                             const aur_ray *ray, const aur_hit *hit);
/* Emitted radiance at a point of a light, with barycentric coordinates u, v. */
aur_vector aur_radiosity_emitted(const aur_radiosity_scene *scene, uint32_t triangle, float u, float v);

/* Follows a ray through mirrors until it hits something else. Multiplies *throughput by the mirrors'
 * reflectance; `particle` selects power instead of radiance. NONE: the ray leaves the scene; TRAPPED: after
 * AUR_RADIOSITY_HOPS mirrors, or absorbed by one. */
typedef enum aur_radiosity_end {
    AUR_RADIOSITY_HIT,
    AUR_RADIOSITY_NONE,
    AUR_RADIOSITY_TRAPPED
} aur_radiosity_end;
enum { AUR_RADIOSITY_HOPS = 32 };
aur_radiosity_end aur_radiosity_reflect(const aur_radiosity_scene *scene, bool particle, uint64_t hash,
                                        aur_ray *ray, aur_hit *hit, aur_vector *throughput);

/* Pairs of triangles that are coplanar and overlap. The search ends at this number, because many copies of
 * one triangle take quadratic time. */
enum { AUR_RADIOSITY_MOST_COINCIDENCES = 1 << 20 };
typedef struct aur_radiosity_coincidence {
    uint64_t pairs;
    uint64_t compared;     /* pairs of boxes, of nodes and of triangles: what the search took */
    uint32_t triangles[2]; /* the first pair */
} aur_radiosity_coincidence;
aur_result aur_radiosity_find_coincidences(const aur_radiosity_scene *scene, aur_radiosity_coincidence *found,
                                           aur_error *error);
