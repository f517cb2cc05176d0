/* What transport sees of a scene: rays and what they hit, lights, the camera, and the film's settings. */
#pragma once

#include <aureole-render/scene.h>

#include "points/base/error.h"
#include "points/base/keys.h"
#include "render/scene/materials/bsdf.h"

/* `direction` is of unit length. Hits are accepted for nearest < distance < farthest. */
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
    uint32_t instance;  /* which copy of the shape, or AUR_NO_INSTANCE */
} aur_hit;

#define AUR_NO_INSTANCE UINT32_MAX

/* A point on a surface with all that shading needs. */
typedef struct aur_surface {
    aur_vector position;
    aur_vector geometric_normal; /* unit, on the side the shape's winding and flip_normals give */
    aur_frame frame;             /* frame.z is the shading normal, on the side of geometric_normal */
    aur_bsdf_point texture;      /* texture coordinates */
    const aur_bsdf *bsdf;        /* never NULL */
    float offset;                /* how far beside it rays begin (aur_surface_offset) */
    uint32_t shape, primitive;
    uint32_t emitter; /* index of the light that the shape is, or AUR_NO_EMITTER */
} aur_surface;

#define AUR_NO_EMITTER UINT32_MAX

/* The nearest hit; false when there is none. */
AUR_INTERNAL bool aur_scene_intersect(const aur_scene *scene, const aur_ray *ray, aur_hit *hit);
/* Whether anything lies on the ray, between its nearest and farthest distance. */
AUR_INTERNAL bool aur_scene_occluded(const aur_scene *scene, const aur_ray *ray);

/* Calls `found` with each surface (its shape, primitive and instance) that may be within `radius` of a point,
 * however they lie: rays tell apart only what floats tell apart. Others may be among them. */
AUR_INTERNAL void aur_scene_near(const aur_scene *scene, aur_vector point, float radius,
                                 void (*found)(void *context, const aur_hit *place), void *context);

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

/* How far beside a surface rays begin, so that they never meet it. */
#define AUR_LEAST_OFFSET 1e-9f
static inline float aur_surface_offset(aur_vector reach, aur_vector normal) {
    return aur_surface_rounding(reach, normal) + AUR_LEAST_OFFSET;
}

/* The same of points of a triangle. */
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

/* A point beside the surface, on the side of `direction`. */
static inline aur_vector aur_surface_leave(const aur_surface *surface, aur_vector direction) {
    const float side = aur_vector_dot(direction, surface->geometric_normal) < 0.0f ? -1.0f : 1.0f;
    return aur_vector_add_scaled(surface->position, side * surface->offset, surface->geometric_normal);
}

/* A ray that leaves the surface without meeting it again; farthest is infinite. */
static inline aur_ray aur_surface_ray(const aur_surface *surface, aur_vector direction) {
    return (aur_ray){aur_surface_leave(surface, direction), 0.0f, direction, INFINITY};
}

/* A ray from one point to another. It meets no surface on which the other is an aur_surface_target. */
static inline aur_ray aur_ray_between(aur_vector from, aur_vector target) {
    const aur_vector way = aur_vector_subtract(target, from);
    const float distance = aur_vector_length(way);
    return (aur_ray){from, 0.0f, aur_vector_scale(way, 1.0f / aur_larger(distance, 1e-30f)), distance};
}

/* The same from a point beside the surface. */
static inline aur_ray aur_surface_ray_to(const aur_surface *surface, aur_vector target) {
    return aur_ray_between(aur_surface_leave(surface, aur_vector_subtract(target, surface->position)),
                           target);
}

/* --- lights */

typedef struct aur_light_sample {
    aur_vector position;  /* just before the light (aur_surface_target), where rays towards it end; beyond the
                             scene for lights that are infinitely far */
    aur_vector normal;    /* of the light there */
    aur_vector direction; /* unit, from the reference point to the light */
    float distance;
    aur_vector radiance; /* RGB, towards the reference point, before visibility; 0 behind the light */
    float pdf;           /* a steradian at the reference point, the choice of the light included */
    bool delta; /* a point or one direction: no ray finds the light, so nothing is to be weighed against it;
                   radiance / pdf is the light's irradiance on a surface that faces it */
    uint32_t emitter; /* its index */
    bool environment; /* what aur_scene_environment gives, too */
} aur_light_sample;

/* Where light arrives. An integrator that draws a point on a light and asks for the pdf of what a ray finds
 * has the same reference for both. */
typedef struct aur_light_reference {
    aur_vector position;
    /* Unit, on the side that is lit: light from behind may be left out, which then costs no look-up of what
     * shines there. Or 0, where light counts from all sides alike. */
    aur_vector normal;
} aur_light_reference;

/* Draws a point on a light: u[0] chooses the light in proportion to its power, u[1], u[2] the point, on
 * rectangles nearly in proportion to the cosine at the reference's normal. False when the scene has no light
 * or the point cannot be seen from there (pdf 0). */
AUR_INTERNAL bool aur_light_sample_direct(const aur_scene *scene, const aur_light_reference *reference,
                                          const float u[3], aur_light_sample *sample);
bool aur_light_chooses(const aur_scene *scene); /* u[0] matters: several lights, or a mesh */
/* The pdf with which aur_light_sample_direct would draw the point `surface` of a light, from `reference`. */
float aur_light_pdf_direct(const aur_scene *scene, const aur_light_reference *reference,
                           const aur_surface *surface);
/* Radiance that `surface` emits towards the unit direction `view` (world); 0 when it is no light or seen from
 * behind. */
AUR_INTERNAL aur_vector aur_surface_emission(const aur_scene *scene, const aur_surface *surface,
                                             aur_vector view);

/* Light from beyond the scene, for rays that hit nothing: the radiance that arrives from the unit `direction`
 * (which points out of the scene), 0 without an environment; and the pdf with which aur_light_sample_direct
 * would draw that direction. */
bool aur_scene_has_environment(const aur_scene *scene);
AUR_INTERNAL aur_vector aur_scene_environment(const aur_scene *scene, aur_vector direction);
float aur_environment_pdf_direct(const aur_scene *scene, aur_vector direction);
/* Both at once. */
aur_vector aur_environment_light(const aur_scene *scene, aur_vector direction, float *pdf);

/* The same for rays of the camera: a scene may have another background than its light. */
bool aur_scene_has_background(const aur_scene *scene);
aur_vector aur_scene_background(const aur_scene *scene, aur_vector direction);

/* A particle that leaves a light: u[0] chooses the light by power, u[1], u[2] the point, u[3], u[4] a cosine
 * distributed direction. *power is the light's power: each of n particles carries 1/n of it, in watts (RGB).
 * `hidden`: no ray meets the light, which is a point or a single direction. False when the scene has no
 * light. */
bool aur_light_emit(const aur_scene *scene, const float u[5], aur_ray *ray, aur_vector *power, bool *hidden);
/* Whether there is such a light. */
bool aur_scene_has_hidden_light(const aur_scene *scene);

AUR_INTERNAL size_t aur_scene_emitter_count(const aur_scene *scene);

/* --- media */

typedef struct aur_medium aur_medium; /* render/scene/medium.h */

bool aur_scene_has_media(const aur_scene *scene);
/* The one that the camera stands in; NULL: none. */
const aur_medium *aur_scene_camera_medium(const aur_scene *scene);
/* What a ray that leaves a surface in `direction` is in: *medium, NULL for none, stays as it is where the
 * shape bounds no medium. */
void aur_surface_medium(const aur_scene *scene, const aur_surface *surface, aur_vector direction,
                        const aur_medium **medium);
/* How far the light of a sample goes through media to `reference`: without end from an environment, and from
 * a light of one direction twice as far as the scene's sphere reaches, as in Mitsuba 3: else a fog without
 * bounds would have no sun. */
float aur_light_reach(const aur_scene *scene, const aur_light_sample *sample, aur_vector reference);
/* An UNSUPPORTED error where the scene has media, with the place of the first: "WHAT takes no media". */
AUR_INTERNAL aur_result aur_scene_refuse_media(const aur_scene *scene, const char *what, aur_error *error);
/* A warning there. */
void aur_scene_warn_of_media(const aur_scene *scene, const char *what, const aur_warnings *warnings);

/* --- camera and film */

/* A scene needs no camera unless it is rendered: a FORMAT error, with the place, where there is none. */
aur_result aur_scene_check_camera(const aur_scene *scene, aur_error *error);

/* The ray through the film point (x, y) in pixels, (0, 0) the top left corner of the image; width and
 * height are those of the image being rendered. lens[2] in [0,1) for cameras that have one. */
void aur_camera_ray(const aur_scene *scene, size_t width, size_t height, float x, float y,
                    const float lens[2], aur_ray *ray);

/* Of cameras all whose rays begin at one point: that point, and where a direction from there is seen. */
typedef struct aur_film_point {
    float x, y;        /* in pixels, within the image or not */
    float solid_angle; /* of a pixel there */
} aur_film_point;
bool aur_camera_is_pinhole(const aur_scene *scene);
aur_vector aur_camera_position(const aur_scene *scene);
/* False behind the camera. */
bool aur_camera_see(const aur_scene *scene, size_t width, size_t height, aur_vector direction,
                    aur_film_point *point);

/* A point in space as the camera sees it. */
typedef struct aur_camera_link {
    aur_film_point film; /* of the point; its solid angle is seen from `origin` */
    aur_vector origin;   /* of the camera's ray there: its place, or a point of its lens */
    aur_vector direction;
    float distance;
    float nearest; /* the part of the distance in which nothing is seen */
} aur_camera_link;
/* Whether the camera has such links: a lens, or a point that all rays leave. */
bool aur_camera_connects(const aur_scene *scene);
/* False for points that the camera cannot see, whatever lies between. lens[2] in [0,1). */
bool aur_camera_connect(const aur_scene *scene, size_t width, size_t height, const float lens[2],
                        aur_vector point, aur_camera_link *link);

/* Sixteen camera rays, an array a coordinate. */
enum { AUR_CAMERA_LANES = 16 };

typedef struct aur_camera_lanes {
    float origin[3][AUR_CAMERA_LANES], direction[3][AUR_CAMERA_LANES];
    float nearest[AUR_CAMERA_LANES], farthest[AUR_CAMERA_LANES];
} aur_camera_lanes;

/* aur_camera_ray of sixteen film points and points of the lens: the same bits. */
void aur_camera_rays(const aur_scene *scene, size_t width, size_t height, const float *x, const float *y,
                     const float *lens_u, const float *lens_v, aur_camera_lanes *rays);

/* What the mean radiance along rays is to be multiplied by: pi for irradiance, else 1. */
float aur_camera_factor(const aur_scene *scene);
/* Whether the camera's rays depend on `lens`. */
bool aur_camera_has_lens(const aur_scene *scene);

/* Reconstruction filters, by name: box (radius 0.5), tent (1), gaussian (stddev 0.5, radius 2), mitchell (B =
 * C = 1/3, radius 2), catmullrom (2), lanczos (3), as Mitsuba 3 defines them. */
typedef struct aur_filter aur_filter;
const aur_filter *aur_filter_find(const char *name); /* NULL: unknown */
const char *aur_filter_name(const aur_filter *filter);
double aur_filter_radius(const aur_filter *filter); /* in pixels */
/* The filter along one axis, so many pixels from its centre; not normalised. */
double aur_filter_value(const aur_filter *filter, double offset);
/* Whether a pixel gains by weighing the samples of its neighbours, too: samples spread evenly, each weighed
 * by w, are worth (int w)^2 / int w^2 of one pixel's along an axis, and samples drawn by |w|
 * (int w)^2 / (int |w|)^2. Filters of a radius up to 0.5 reach no neighbour; those that reach farther than
 * AUR_FILTER_REACH_MAX would need too much memory. */
bool aur_filter_shares_samples(const aur_filter *filter);
/* For filters that are not negative, box, tent and gaussian: the offset from the pixel's centre, in pixels,
 * that u in [0,1) stands for where samples are drawn by the filter. */
float aur_filter_sample(const aur_filter *filter, float u);

/* What a scene says of its image. */
typedef struct aur_film_settings {
    size_t width, height;
    size_t crop_x0, crop_x1, crop_y0, crop_y1; /* pixels x0 <= x < x1, y0 <= y < y1; all 0: the whole */
    const aur_filter *filter;
} aur_film_settings;

const aur_film_settings *aur_scene_film(const aur_scene *scene);
/* At most 2^30, as many as a sampler can count. */
#define AUR_SAMPLES_PER_PIXEL_MAX ((int64_t)1 << 30)
/* What the scene was read from, a line each: "scene NAME HASH", "file NAME HASH" for all that it names,
 * sorted, and "define NAME=VALUE". The text is allocated with malloc. Errors: OPEN when a file is gone,
 * MEMORY. */
aur_result aur_scene_contents(const aur_scene *scene, char **lines, aur_error *error);
/* What traces the rays, in words: images made with other words differ in the last bits. */
enum { AUR_SCENE_TRACER_CAPACITY = 96 };
void aur_scene_describe_tracer(const aur_scene *scene, size_t capacity, char *text);
size_t aur_scene_samples_per_pixel(const aur_scene *scene);
const char *aur_scene_sampler(const aur_scene *scene); /* SET syntax */
/* The integrator as the scene has it; its plugin may be one that Aureole does not know. */
const aur_parameters *aur_scene_integrator(const aur_scene *scene);

/* --- geometry, for photon maps and radiosity */

/* All coordinates but those of what is read or written count from this point of the world, near which most of
 * the scene is: as floats they are as exact wherever it stands. `origin` lasts as long as the scene. */
AUR_INTERNAL const double *aur_scene_origin(const aur_scene *scene);
/* A point of the world in such coordinates. */
static inline aur_vector aur_place_from(const double origin[3], const double point[3]) {
    return (aur_vector){(float)(point[0] - origin[0]), (float)(point[1] - origin[1]),
                        (float)(point[2] - origin[2])};
}
void aur_scene_bounds(const aur_scene *scene, aur_vector *lower, aur_vector *upper);
/* Embree's scene, for code that traces rays by itself: all shapes but those of groups, whose instances it
 * holds. */
struct RTCSceneTy *aur_scene_embree(const aur_scene *scene);
/* What Embree's devices are made with for so many primitives: one thread below a million, else as many as are
 * given, 0 for all that there are; no huge pages below 2^15; and kernels for no wider instructions than
 * aur_isa_of_rays(). */
enum { AUR_EMBREE_CONFIGURATION_CAPACITY = 48 };
void aur_embree_configuration(size_t primitives, size_t threads,
                              char text[AUR_EMBREE_CONFIGURATION_CAPACITY]);

/* A triangle of a mesh, in world coordinates. */
typedef struct aur_triangle {
    aur_vector corner[3]; /* counter-clockwise seen from the side of the normal */
    aur_bsdf_point texture[3];
} aur_triangle;

/* A scene that is made of triangle meshes and lit by them alone: UNSUPPORTED, with the place, for any other
 * shape, for copies of shape groups and for lights that are no surface. */
aur_result aur_scene_check_triangles(const aur_scene *scene, aur_error *error);

size_t aur_scene_shape_count(const aur_scene *scene);
/* Triangles of a shape; hits number them from 0. */
size_t aur_scene_shape_triangles(const aur_scene *scene, size_t shape);
void aur_scene_triangle(const aur_scene *scene, size_t shape, size_t index, aur_triangle *triangle);
const aur_bsdf *aur_scene_shape_bsdf(const aur_scene *scene, size_t shape);
aur_location aur_scene_shape_location(const aur_scene *scene, size_t shape);
/* What a mesh emits on the side of its normal at a texture coordinate, and whether that varies; 0 for shapes
 * that are no light. */
aur_vector aur_scene_shape_emission(const aur_scene *scene, size_t shape, aur_bsdf_point point);
bool aur_scene_shape_emission_varies(const aur_scene *scene, size_t shape);

/* Tables of what the loader itself makes. */
extern const aur_table aur_film_table, aur_sampler_table;
