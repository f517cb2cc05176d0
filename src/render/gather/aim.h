/* Directions of a rule made into gather rays at sixteen places. */
#pragma once

#include "render/gather/sums.h"

/* Frames of the lobes, and normals on the side that is seen, an array a coordinate. */
typedef struct aur_lobe_frames {
    aur_lane_vectors x, y, z, shading, geometric;
} aur_lobe_frames;

/* Sets one lane's frame and normals, and makes its ray begin at its place. */
void aur_gather_set_frame(const aur_gather_point *surface_point, size_t lane, const aur_frame *frame,
                          aur_lobe_frames *frames, aur_gather_rays *rays);

/* Directions local to the frames made into rays of the packet; the lanes' origins have been set. Those below
 * the surface are left out. Returns the lanes that have a ray, and their cosines at the surface. */
uint32_t aur_gather_aim(uint32_t lanes, const aur_lobe_frames *restrict frames, const aur_lane_vectors *local,
                        aur_packet *packet, float cosine[AUR_PACKET_SIZE]);

/* Sets what decides by chance where the rays of direction `index` for lobe number `lobe` go on. */
void aur_gather_set_probability(const aur_gather_points *surface_points, size_t lobe, size_t index,
                                aur_gather_rays *rays);

/* What a lane's pattern for its lobe number `lobe` is randomised by. Under "blue" all lanes of the group have
 * the same rotation. */
aur_gather_rotation aur_gather_rotation_at(const aur_gather_points *surface_points,
                                           const aur_gather_lobe_rule *rule, size_t lane, uint64_t lobe);

/* Which of the rotations prepared for a table of weights a lane has, and whether mirrored. Under "blue" all
 * lanes of the group have the same. */
size_t aur_gather_prepared_rotation(const aur_gather_points *surface_points, size_t rotations, size_t lane,
                                    bool *mirrored);

/* A draw of a place's sampled lobe, one of `draws` of a sample, becomes the lane's ray; *value is what it
 * reflects of the light that comes along it, *height that of the direction above the surface. False: there is
 * none. */
bool aur_gather_aim_draw(const aur_gather_point *surface_point, size_t lane, const float u[3], float draws,
                         aur_gather_rays *rays, aur_vector *value, float *height);

/* Whether the pixels of a block split this rule, each one's directions being a part of one pattern. */
bool aur_gather_splits(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule);

/* Whether what the places find by this rule is pooled with that of neighbouring pixels. */
bool aur_gather_pools(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule);

/* One rule at the places of some lanes, to be traced direction by direction for their lobe number `lobe`. */
struct aur_gather_sweep {
    const aur_gather_points *surface_points;
    aur_gather_sums *sums;
    const aur_gather_lobe_rule *rule;
    size_t lobe;
    uint32_t lanes;
    uint32_t factored; /* lanes whose lobe has a factor beside the power */
    bool together;     /* all lanes have one rotation */
    bool times_cosine[AUR_PACKET_SIZE];
    aur_gather_rotation rotations[AUR_PACKET_SIZE];
    aur_lobe_frames frames;
};

void aur_gather_sweep_start(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule,
                            size_t lobe, uint32_t lanes, aur_gather_sweep *sweep, aur_gather_rays *rays);

/* Traces direction `index`; sums->rays.radiance has what came along it. Returns the lanes above whose surface
 * it lies, and what their radiance is to be multiplied by: the rule's weight where it is `weighed`, times
 * what the lobe has beside the power. The radiance of other lanes is 0. */
uint32_t aur_gather_sweep_trace(const aur_gather_points *surface_points, const aur_gather_sweep *sweep,
                                size_t index, bool weighed, aur_gather_sums *sums,
                                float factor[AUR_PACKET_SIZE]);
