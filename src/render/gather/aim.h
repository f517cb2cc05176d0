/* Turns the directions of a rule into gather rays at sixteen shading points. */
#pragma once

#include "render/gather/sums.h"

/* Frames of the lobes, and normals on the side that is seen, an array a coordinate. */
typedef struct aur_lobe_frames {
    aur_lane_vectors x, y, z, shading, geometric;
} aur_lobe_frames;

/* Sets one lane's frame and normals, and the origin of its ray. */
void aur_gather_set_frame(const aur_gather_point *surface_point, size_t lane, const aur_frame *frame,
                          aur_lobe_frames *frames, aur_gather_rays *rays);

/* Sets the packet's rays from directions local to the frames; the lanes' origins must be set. Directions
 * below the surface are masked out. Returns the lanes that have a ray, and their cosines at the surface. */
uint32_t aur_gather_aim(uint32_t lanes, const aur_lobe_frames *restrict frames, const aur_lane_vectors *local,
                        aur_packet *packet, float cosine[AUR_PACKET_SIZE]);

/* The same from directions of the world. */
uint32_t aur_gather_aim_world(uint32_t lanes, const aur_lobe_frames *restrict frames,
                              const float directions[3][AUR_PACKET_SIZE], aur_packet *packet,
                              float cosine[AUR_PACKET_SIZE]);

/* The rotation of a lane's pattern for lobe `lobe`. Under "blue" all lanes of the group share it. */
aur_gather_rotation aur_gather_rotation_at(const aur_gather_points *surface_points,
                                           const aur_gather_lobe_rule *rule, size_t lane, uint64_t lobe);

/* The index of a lane's prepared rotation in a table of weights, and whether it is mirrored. Under "blue" all
 * lanes of the group share it. */
size_t aur_gather_prepared_rotation(const aur_gather_points *surface_points, size_t rotations, size_t lane,
                                    bool *mirrored);

/* Samples the BSDF of a sampled lobe, one of `draws` per sample, and sets the lane's ray. *value is the
 * throughput of the sample, *height the cosine above the surface. False if there is no sample. */
bool aur_gather_aim_draw(const aur_gather_point *surface_point, size_t lane, const float u[3], float draws,
                         aur_gather_rays *rays, aur_vector *value, float *height);

/* Whether the pixels of a block split this rule: each takes a part of one pattern's directions. */
bool aur_gather_splits(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule);

/* Whether irradiance gathered by this rule is pooled with neighbouring pixels. */
bool aur_gather_pools(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule);

/* One rule at the shading points of some lanes, to be traced direction by direction for lobe `lobe`; or, with
 * `rule` NULL, what a method gathers by directions of its choice. */
struct aur_gather_sweep {
    const aur_gather_points *surface_points;
    aur_gather_sums *sums;
    const aur_gather_lobe_rule *rule;
    size_t lobe;
    uint32_t lanes;
    uint32_t factored;              /* lanes whose lobe is a power of the cosine times another factor */
    bool together;                  /* all lanes share one rotation and the same directions */
    bool pairs;                     /* a method gathers pairs of lobes, else lobe `lobe` */
    uint32_t part[AUR_PACKET_SIZE]; /* what the lanes add to the index of a direction */
    bool times_cosine[AUR_PACKET_SIZE];
    aur_gather_rotation rotations[AUR_PACKET_SIZE];
    aur_lobe_frames frames;
};

void aur_gather_sweep_start(const aur_gather_points *surface_points, const aur_gather_lobe_rule *rule,
                            size_t lobe, uint32_t lanes, aur_gather_sweep *sweep, aur_gather_rays *rays);

/* Sets the hashes of the random decisions about whether rays of direction `index` continue. */
void aur_gather_set_probability(const aur_gather_points *surface_points, const aur_gather_sweep *sweep,
                                size_t index, aur_gather_rays *rays);

/* Traces direction `index` and leaves the incident radiance in sums->rays.radiance (0 in other lanes).
 * Returns the lanes whose surface the direction is above. `factor` is what to multiply their radiance by: the
 * lobe's factor besides the power, times the rule's weight if `weighed`. */
uint32_t aur_gather_sweep_trace(const aur_gather_points *surface_points, const aur_gather_sweep *sweep,
                                size_t index, bool weighed, aur_gather_sums *sums,
                                float factor[AUR_PACKET_SIZE]);
