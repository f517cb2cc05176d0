/* The rays of ambient occlusion, packet by packet: what the integrator traces and the bench compares with. */
#pragma once

#include "render/sampling/rule.h"
#include "render/trace/interleave.h"
#include "render/trace/packet.h"

/* The 16 pixels of a group (render/trace/interleave.h) share a rotation of the pattern, so the rays of a
 * packet have one direction of it at 16 shading points, almost parallel where the surface is flat. */
enum { AUR_OCCLUSION_POINTS = AUR_TILE_PIXELS };

typedef struct aur_occlusion {
    size_t samples_per_pattern; /* among which its directions are shared out */
    size_t part_stride;         /* from the part of one sample to that of the next, if `renews` */
    bool renews;                /* further samples turn the pattern again; else there are none */
    uint64_t seed;
    /* What is farther, in scene units, does not occlude. */
    float max_distance;
    aur_gather_rule rule;
} aur_occlusion;

/* The surface points that the camera sees in a tile, in packet order: those of group g begin at g *
 * AUR_PACKET_SIZE. */
typedef struct aur_occlusion_points {
    uint64_t arrangement; /* of the tile's pixels in groups */
    _Alignas(64) float origin[3][AUR_OCCLUSION_POINTS];
    _Alignas(64) float axis[3][3][AUR_OCCLUSION_POINTS]; /* x, y and z of the frame about the normal */
    float offset[AUR_OCCLUSION_POINTS][2];               /* of the camera sample from its pixel's centre */
    uint64_t pixel[AUR_OCCLUSION_POINTS];                /* a hash of the pixel */
    bool seen[AUR_OCCLUSION_POINTS];                     /* false: the camera sees no surface there */
} aur_occlusion_points;

/* Finds the points of sample `index` of every pixel of the tile whose corner is (x, y). */
void aur_occlusion_find_points(const aur_view *view, size_t x, size_t y, uint32_t index,
                               aur_occlusion_points *surface_points);

/* Called with each packet of the tile's rays in a fixed order; lane k is point first_place + k. */
typedef void (*aur_occlusion_visitor)(void *context, size_t first_point, aur_embree_order order,
                                      aur_packet *packet);

/* Builds the rays of sample `index` from its points and passes them to `visit`; returns the number of
 * directions per point. */
size_t aur_occlusion_visit(const aur_occlusion *occlusion, const aur_occlusion_points *surface_points,
                           size_t x, size_t y, uint32_t index, aur_occlusion_visitor visit, void *context);
