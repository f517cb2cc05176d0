/* The scene interface for transport: rays and hits, lights, the camera, and film settings. */
#pragma once

#include <aureole-render/scene.h>

#include "points/base/error.h"
#include "points/base/keys.h"
#include "render/scene/materials/bsdf.h"

/* `direction` is a unit vector. Hits are accepted for nearest < distance < farthest. */
typedef struct aur_ray {
    aur_vector origin;
    float nearest;
    aur_vector direction;
    float farthest;
} aur_ray;

typedef struct aur_hit {
    float distance;
    float u, v; /* barycentric: (1-u-v) a + u b + v c */
    uint32_t shape;
    uint32_t primitive; /* triangle of the shape */
    uint32_t instance;  /* the instance hit, or AUR_NO_INSTANCE */
} aur_hit;

#define AUR_NO_INSTANCE UINT32_MAX

/* A surface point with everything needed for shading. */
typedef struct aur_surface {
    aur_vector position;
    aur_vector geometric_normal; /* unit, on the side given by the shape's winding and flip_normals */
    aur_frame frame;             /* frame.z is the shading normal, on the side of geometric_normal */
    aur_bsdf_point texture;      /* texture coordinates */
    const aur_bsdf *bsdf;        /* never NULL */
    float offset;                /* offset of ray origins (aur_surface_offset) */
    uint32_t shape, primitive;
    uint32_t emitter; /* index of the shape's light, or AUR_NO_EMITTER */
} aur_surface;

#define AUR_NO_EMITTER UINT32_MAX

/* The nearest hit; false if there is none. */
AUR_INTERNAL bool aur_scene_intersect(const aur_scene *scene, const aur_ray *ray, aur_hit *hit);
/* Whether anything intersects the ray between its nearest and farthest distance. */
AUR_INTERNAL bool aur_scene_occluded(const aur_scene *scene, const aur_ray *ray);

/* Calls `found` for each surface (shape, primitive and instance) that may be within `radius` of a point, in
 * any orientation. The result is conservative. Needed because rays only resolve distances to float precision.
 */
AUR_INTERNAL void aur_scene_near(const aur_scene *scene, aur_vector point, float radius,
                                 void (*found)(void *context, const aur_hit *hit), void *context);

/* The surface at a hit. */
AUR_INTERNAL void aur_scene_surface(const aur_scene *scene, const aur_ray *ray, const aur_hit *hit,
                                    aur_surface *surface);

/* How far rounding puts a point off a surface with this unit normal, and more, where all coordinates that it
 * is made of are within +-reach. A number x is rounded by u |x|, u = 2^-24, which along the axis d moves a
 * point off a plane by u |n_d| reach_d; s is the sum of these over d. A triangle's point is off by 4 s at
 * most: its weights 1, their products with corners 1, two sums 2. The origin of a ray is off by 1 s more.
 * Embree counts corners from that origin, up to 2 reach: differences 1, their products with the normal and
 * sums 3; the normal is of sides, differences 3, and their cross product 2. That is 9 times 2 s, unless the
 * triangle is a sliver; in all 23 s, and 1.5e-6 are 25 u. */
static inline float aur_surface_rounding(aur_vector reach, aur_vector normal) {
    return 1.5e-6f * (fabsf(normal.x) * fabsf(reach.x) + fabsf(normal.y) * fabsf(reach.y) +
                      fabsf(normal.z) * fabsf(reach.z));
}

/* Offset of ray origins from a surface, so that rays never hit it again. */
#define AUR_LEAST_OFFSET 1e-9f
static inline float aur_surface_offset(aur_vector reach, aur_vector normal) {
    return aur_surface_rounding(reach, normal) + AUR_LEAST_OFFSET;
}

/* The same for points of a triangle. */
static inline float aur_triangle_offset(aur_vector a, aur_vector b, aur_vector c, aur_vector normal) {
    const aur_vector reach = {aur_larger(fabsf(a.x), aur_larger(fabsf(b.x), fabsf(c.x))),
                              aur_larger(fabsf(a.y), aur_larger(fabsf(b.y), fabsf(c.y))),
                              aur_larger(fabsf(a.z), aur_larger(fabsf(b.z), fabsf(c.z)))};
    return aur_surface_offset(reach, normal);
}

/* How far rounding puts a point, a corner and shares of two sides, off the triangle that rays meet, with
 * u = 2^-24: 4 u of the reach along axes in which the triangle extends (two sums 2, the fourth corner of a
 * parallelogram 2), u of all (the point is moved, aur_surface_target), and 13 u of the extent (the shares 4,
 * Embree's normal 5 and its distance to a corner 4). */
static inline float aur_triangle_rounding(aur_vector a, aur_vector b, aur_vector c, aur_vector normal) {
    const aur_vector low = aur_vector_smaller(a, aur_vector_smaller(b, c));
    const aur_vector high = aur_vector_larger(a, aur_vector_larger(b, c));
    const aur_vector zero = {0}, extent = aur_vector_subtract(high, low);
    const aur_vector reach = aur_vector_larger(high, aur_vector_subtract(zero, low));
    const aur_vector summed = {extent.x > 0.0f ? reach.x : 0.0f, extent.y > 0.0f ? reach.y : 0.0f,
                               extent.z > 0.0f ? reach.z : 0.0f};
    return 2.4e-7f * aur_vector_dot_absolute(summed, normal) +
           6e-8f * aur_vector_dot_absolute(reach, normal) + 7.8e-7f * aur_vector_dot_absolute(extent, normal);
}

/* Where a ray from `from` ends to be short of the surface on which the point lies: moved along the unit
 * normal by all that may be rounded, at most half the way to the plane of `from`. To the `rounding` of the
 * point, the ray adds 11 u of its way: the difference of its ends 1, the direction 2, Embree's difference
 * from a corner 1, its products with the normal and their sums 3, those of the direction 3, their
 * comparison 1. */
static inline aur_vector aur_surface_target(aur_vector from, aur_vector position, aur_vector normal,
                                            float rounding) {
    const aur_vector way = aur_vector_subtract(from, position);
    const float all = rounding + 6.6e-7f * aur_vector_dot_absolute(way, normal);
    return aur_vector_add_scaled(position, aur_smaller(all, 0.5f * aur_vector_dot(way, normal)), normal);
}

/* The same of a light without a size, which may stand in a surface: as of one that faces `from`, `back` the
 * unit direction there. */
static inline aur_vector aur_point_target(aur_vector from, aur_vector position, aur_vector back) {
    return aur_surface_target(from, position, back, 1.2e-7f * aur_vector_dot_absolute(position, back));
}

/* A point offset from the surface, on the side of `direction`. */
static inline aur_vector aur_surface_leave(const aur_surface *surface, aur_vector direction) {
    const float side = aur_vector_dot(direction, surface->geometric_normal) < 0.0f ? -1.0f : 1.0f;
    return aur_vector_add_scaled(surface->position, side * surface->offset, surface->geometric_normal);
}

/* A ray that leaves the surface without hitting it again; farthest is infinite. */
static inline aur_ray aur_surface_ray(const aur_surface *surface, aur_vector direction) {
    return (aur_ray){aur_surface_leave(surface, direction), 0.0f, direction, INFINITY};
}

/* A ray between two points. It does not hit a surface for which the second point is an aur_surface_target. */
static inline aur_ray aur_ray_between(aur_vector from, aur_vector target) {
    const aur_vector way = aur_vector_subtract(target, from);
    const float distance = aur_vector_length(way);
    return (aur_ray){from, 0.0f, aur_vector_scale(way, 1.0f / aur_larger(distance, 1e-30f)), distance};
}

/* The same from a point offset from the surface. */
static inline aur_ray aur_surface_ray_to(const aur_surface *surface, aur_vector target) {
    return aur_ray_between(aur_surface_leave(surface, aur_vector_subtract(target, surface->position)),
                           target);
}

/* --- lights */

typedef struct aur_light_sample {
    aur_vector position;  /* just before the light (aur_surface_target), as end of shadow rays; beyond the
                             scene for infinitely distant lights */
    aur_vector normal;    /* normal of the light there */
    aur_vector direction; /* unit, from the reference point to the light */
    float distance;
    aur_vector radiance; /* RGB, towards the reference point, without visibility; 0 behind the light */
    float pdf;           /* pdf by solid angle at the reference point, including the selection of the light */
    bool delta; /* a point or single direction: rays cannot hit the light, so there is no MIS; radiance / pdf
                   is its irradiance on a surface that faces it */
    uint32_t emitter; /* its index */
    bool environment; /* also included in aur_scene_environment */
} aur_light_sample;

/* The reference point of light sampling. For MIS, the integrator passes the same reference to sampling and to
 * pdf queries. */
typedef struct aur_light_reference {
    aur_vector position;
    /* Unit normal on the lit side: light from behind may be skipped, which saves its evaluation. 0: light
     * from all directions counts equally. */
    aur_vector normal;
} aur_light_reference;

/* Samples a point on a light: u[0] selects the light in proportion to its power, u[1], u[2] the point, on
 * rectangles nearly in proportion to the cosine at the reference's normal. False if the scene has no light,
 * or the point is not visible from the reference (pdf 0). */
AUR_INTERNAL bool aur_light_sample_direct(const aur_scene *scene, const aur_light_reference *reference,
                                          const float u[3], aur_light_sample *sample);
bool aur_light_chooses(const aur_scene *scene); /* u[0] is used: several lights, or a mesh */
/* The pdf with which aur_light_sample_direct samples the point `surface` of a light, from `reference`. */
float aur_light_pdf_direct(const aur_scene *scene, const aur_light_reference *reference,
                           const aur_surface *surface);
/* Radiance emitted by `surface` in the unit direction `view` (world); 0 for surfaces that are not lights, and
 * from behind. */
AUR_INTERNAL aur_vector aur_surface_emission(const aur_scene *scene, const aur_surface *surface,
                                             aur_vector view);
/* Starts to load the texels that the material and the emission of `surface` read. */
void aur_surface_prefetch(const aur_scene *scene, const aur_surface *surface);

/* Environment lighting, for rays that hit nothing: the radiance from the unit `direction` (pointing out of
 * the scene), 0 without an environment; and the pdf with which aur_light_sample_direct samples it. */
bool aur_scene_has_environment(const aur_scene *scene);
AUR_INTERNAL aur_vector aur_scene_environment(const aur_scene *scene, aur_vector direction);
float aur_environment_pdf_direct(const aur_scene *scene, aur_vector direction);
/* Both at once. */
aur_vector aur_environment_light(const aur_scene *scene, aur_vector direction, float *pdf);

/* The same for camera rays: the visible background may differ from the environment. */
bool aur_scene_has_background(const aur_scene *scene);
aur_vector aur_scene_background(const aur_scene *scene, aur_vector direction);

/* An emitted particle: u[0] selects the light by power, u[1], u[2] the point, u[3], u[4] a cosine-distributed
 * direction. *power is the light's power: each of n particles carries 1/n of it, in watts (RGB). `hidden`: a
 * light that rays cannot hit, as a point or a single direction. False if the scene has no light. */
bool aur_light_emit(const aur_scene *scene, const float u[5], aur_ray *ray, aur_vector *power, bool *hidden);
/* Whether the scene has a light that rays cannot hit. */
bool aur_scene_has_hidden_light(const aur_scene *scene);

size_t aur_scene_emitter_count(const aur_scene *scene);

/* --- media */

typedef struct aur_medium aur_medium; /* render/scene/medium.h */

bool aur_scene_has_media(const aur_scene *scene);
/* The medium that contains the camera; NULL: none. */
const aur_medium *aur_scene_camera_medium(const aur_scene *scene);
/* The medium of a ray that leaves a surface in `direction`: *medium (NULL: none) is unchanged if the shape
 * bounds no medium. */
void aur_surface_medium(const aur_scene *scene, const aur_surface *surface, aur_vector direction,
                        const aur_medium **medium);
/* The distance through media of a light sample to `reference`: infinite for an environment; for directional
 * light twice the radius of the scene's sphere, as in Mitsuba 3. Otherwise unbounded fog would absorb all
 * sunlight. */
float aur_light_reach(const aur_scene *scene, const aur_light_sample *sample, aur_vector reference);
/* An UNSUPPORTED error if the scene has media, at the location of the first: "WHAT takes no media". */
AUR_INTERNAL aur_result aur_scene_refuse_media(const aur_scene *scene, const char *what, aur_error *error);
/* A warning in that case. */
void aur_scene_warn_of_media(const aur_scene *scene, const char *what, const aur_warnings *warnings);

/* --- camera and film */

/* A FORMAT error, with location, if the scene has no camera: only rendering requires one. */
aur_result aur_scene_check_camera(const aur_scene *scene, aur_error *error);

/* The ray through the film point (x, y) in pixels, (0, 0) the top left corner of the image; width and
 * height are those of the image being rendered. lens[2] in [0,1) for cameras that have one. */
void aur_camera_ray(const aur_scene *scene, size_t width, size_t height, float x, float y,
                    const float lens[2], aur_ray *ray);

/* For cameras whose rays share one origin: that point, and the projection of a direction from it. */
typedef struct aur_film_point {
    float x, y;        /* in pixels, inside or outside of the image */
    float solid_angle; /* solid angle of a pixel there */
} aur_film_point;
bool aur_camera_is_pinhole(const aur_scene *scene);
aur_vector aur_camera_position(const aur_scene *scene);
/* False behind the camera. */
bool aur_camera_see(const aur_scene *scene, size_t width, size_t height, aur_vector direction,
                    aur_film_point *point);

/* A point in space, projected to the film. */
typedef struct aur_camera_link {
    aur_film_point film; /* of the point; its solid angle is seen from `origin` */
    aur_vector origin;   /* origin of the camera's ray: its position, or a point of its lens */
    aur_vector direction;
    float distance;
    float nearest; /* the fraction of the distance hidden by the near clip plane */
} aur_camera_link;
/* Whether the camera supports such connections: it has a lens, or a common origin of all rays. */
bool aur_camera_connects(const aur_scene *scene);
/* False for points outside of the camera's view; occlusion is ignored. lens[2] in [0,1). */
bool aur_camera_connect(const aur_scene *scene, size_t width, size_t height, const float lens[2],
                        aur_vector point, aur_camera_link *link);

/* Sixteen camera rays, as arrays per coordinate. */
enum { AUR_CAMERA_LANES = 16 };

typedef struct aur_camera_lanes {
    float origin[3][AUR_CAMERA_LANES], direction[3][AUR_CAMERA_LANES];
    float nearest[AUR_CAMERA_LANES], farthest[AUR_CAMERA_LANES];
} aur_camera_lanes;

/* aur_camera_ray for sixteen film points and lens points: bit-identical. */
void aur_camera_rays(const aur_scene *scene, size_t width, size_t height, const float *x, const float *y,
                     const float *lens_u, const float *lens_v, aur_camera_lanes *rays);

/* The factor from mean radiance along rays to the measured quantity: pi for irradiance, else 1. */
float aur_camera_factor(const aur_scene *scene);
/* Whether the camera's rays depend on `lens`. */
bool aur_camera_has_lens(const aur_scene *scene);

/* Reconstruction filters, by name: box (radius 0.5), tent (1), gaussian (stddev 0.5, radius 2), mitchell (B =
 * C = 1/3, radius 2), catmullrom (2), lanczos (3), as Mitsuba 3 defines them. */
typedef struct aur_filter aur_filter;
const aur_filter *aur_filter_find(const char *name); /* NULL: out of range */
const char *aur_filter_name(const aur_filter *filter);
double aur_filter_radius(const aur_filter *filter); /* in pixels */
/* The unnormalised filter along one axis, at this distance from its centre in pixels. */
double aur_filter_value(const aur_filter *filter, double offset);
/* Whether samples contribute to neighbouring pixels too. Relative to one pixel's samples, the efficiency
 * along an axis is (int w)^2 / int w^2 for evenly distributed samples with weight w, and (int w)^2 / (int
 * |w|)^2 for samples drawn by |w|. Filters of radius up to 0.5 reach no neighbour; those above
 * AUR_FILTER_REACH_MAX would need too much memory. */
bool aur_filter_shares_samples(const aur_filter *filter);
/* For non-negative filters (box, tent and gaussian): the offset from the pixel's centre, in pixels, sampled
 * in proportion to the filter by u in [0,1). */
float aur_filter_sample(const aur_filter *filter, float u);

/* Image settings of a scene. */
typedef struct aur_film_settings {
    size_t width, height;
    size_t crop_x0, crop_x1, crop_y0, crop_y1; /* pixels x0 <= x < x1, y0 <= y < y1; all 0: the whole image */
    const aur_filter *filter;
} aur_film_settings;

const aur_film_settings *aur_scene_film(const aur_scene *scene);
/* At most 2^30, the limit of samplers. */
#define AUR_SAMPLES_PER_PIXEL_MAX ((int64_t)1 << 30)
/* The inputs of the scene, one per line: "scene NAME HASH", "file NAME HASH" for all referenced files,
 * sorted, and "define NAME=VALUE". The text is malloc'ed. Errors: OPEN if a file has been removed, MEMORY. */
aur_result aur_scene_contents(const aur_scene *scene, char **lines, aur_error *error);
/* Describes the ray tracing kernels: if the description differs, images differ by rounding. */
enum { AUR_SCENE_TRACER_CAPACITY = 96 };
void aur_scene_describe_tracer(const aur_scene *scene, size_t capacity, char *text);
size_t aur_scene_samples_per_pixel(const aur_scene *scene);
const char *aur_scene_sampler(const aur_scene *scene); /* SET syntax */
/* The integrator of the scene file; its plugin may be unsupported. */
const aur_parameters *aur_scene_integrator(const aur_scene *scene);
/* The text of one of its keys; NULL if that is not set. */
const char *aur_scene_integrator_key(const aur_scene *scene, const char *key);
/* The main file is a model: its integrator is a default, whose max_depth holds for others too. */
bool aur_scene_is_model(const aur_scene *scene);

/* --- geometry, for photon maps and radiosity */

/* The world position of the origin of internal coordinates, near most of the scene, so that floats are
 * accurate. Only input and output use world coordinates. `origin` is valid as long as the scene. */
const double *aur_scene_origin(const aur_scene *scene);
/* A world point in internal coordinates. */
static inline aur_vector aur_internal_point(const double origin[3], const double point[3]) {
    return (aur_vector){(float)(point[0] - origin[0]), (float)(point[1] - origin[1]),
                        (float)(point[2] - origin[2])};
}
void aur_scene_bounds(const aur_scene *scene, aur_vector *lower, aur_vector *upper);
/* Embree's scene, for code that traces rays directly: all shapes outside of groups, and the groups'
 * instances. */
struct RTCSceneTy *aur_scene_embree(const aur_scene *scene);
/* Configuration of Embree's devices for this number of primitives: one thread below a million, else `threads`
 * (0: all); no huge pages below 2^15; instruction sets up to aur_isa_of_rays(). */
enum { AUR_EMBREE_CONFIGURATION_CAPACITY = 48 };
void aur_embree_configuration(size_t primitives, size_t threads,
                              char text[AUR_EMBREE_CONFIGURATION_CAPACITY]);

/* A triangle of a mesh, in world coordinates. */
typedef struct aur_triangle {
    aur_vector corner[3]; /* counter-clockwise seen from the side of the normal */
    aur_bsdf_point texture[3];
} aur_triangle;

/* Checks that the scene consists of triangle meshes and is lit only by them. UNSUPPORTED, with location, for
 * other shapes, instances, and lights that are not surfaces. */
aur_result aur_scene_check_triangles(const aur_scene *scene, aur_error *error);

size_t aur_scene_shape_count(const aur_scene *scene);
/* Number of triangles of a shape; hits number them from 0. */
size_t aur_scene_shape_triangles(const aur_scene *scene, size_t shape);
void aur_scene_triangle(const aur_scene *scene, size_t shape, size_t index, aur_triangle *triangle);
const aur_bsdf *aur_scene_shape_bsdf(const aur_scene *scene, size_t shape);
aur_location aur_scene_shape_location(const aur_scene *scene, size_t shape);
/* Emission of a mesh on the side of its normal at a texture coordinate, and whether it varies; 0 for shapes
 * that are not lights. */
aur_vector aur_scene_shape_emission(const aur_scene *scene, size_t shape, aur_bsdf_point point);
bool aur_scene_shape_emission_varies(const aur_scene *scene, size_t shape);

/* Tables of plugins created by the loader itself. */
extern const aur_table aur_film_table, aur_sampler_table;
