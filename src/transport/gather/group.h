/* Sixteen pixels at a time, from the inside: what the files that gather share. */
#ifndef AUR_TRANSPORT_GATHER_GROUP_H
#define AUR_TRANSPORT_GATHER_GROUP_H

#include <string.h>

#include "transport/gather/plan.h"

/* A surface point where light is gathered. */
typedef struct aur_gather_place {
    aur_surface surface;
    aur_vector view;   /* local */
    aur_vector origin; /* of rays that leave it, on the side that it is seen from */
    float side;        /* 1 where it is seen from the side of its normal, else -1 */
    size_t lobe_count;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
} aur_gather_place;

/* Whether a place has that one of its material's lobes. */
static inline bool aur_is_there(const aur_gather_place *p, const aur_bsdf_lobe *lobe) {
    return lobe->shape == AUR_LOBE_SHAPE_SAMPLED
               ? (aur_bsdf_scatters(p->surface.bsdf, p->view.z) & AUR_SCATTERS_SAMPLED) != 0
               : !aur_vector_is_zero(lobe->coefficient);
}

struct aur_group {
    const aur_group_task *task;
    aur_counters *counters;
    uint32_t lanes; /* on the way */
    uint32_t chain;
    bool flat; /* the places lie on one plane, nearly */
    aur_camera_sample samples[AUR_PACKET_SIZE];
    uint64_t pixels[AUR_PACKET_SIZE]; /* hashes of the samples' streams */
    float weights[AUR_PACKET_SIZE];
    aur_vector throughput[AUR_PACKET_SIZE];
    aur_vector sum[AUR_PACKET_SIZE];
    aur_gather_place places[AUR_PACKET_SIZE];
    float *merged;   /* weights of merged samples, and room for one lane's: see estimate_merged.c */
    uint32_t shared; /* lanes whose diffuse light is to be shared: */
    aur_vector irradiance[AUR_PACKET_SIZE], coefficient[AUR_PACKET_SIZE];
    aur_vector shared_position[AUR_PACKET_SIZE], shared_normal[AUR_PACKET_SIZE];
    uint32_t directions[AUR_PACKET_SIZE]; /* gathered with, when adaptive */
    float *values;                        /* room for what adaptive gathering keeps */
    aur_gather_rays rays;
};

/* Dimension pairs of one surface along the chain: choice of light, position on it, two for a specular
 * bounce, choice of a bright texel, position on it. */
enum {
    AUR_GATHER_PAIR_CHOICE,
    AUR_GATHER_PAIR_POSITION,
    AUR_GATHER_PAIR_LOBE,
    AUR_GATHER_PAIR_BOUNCE,
    AUR_GATHER_PAIR_TEXEL,
    AUR_GATHER_PAIR_TEXEL_POSITION,
    AUR_GATHER_PAIRS
};

/* Frames of the lobes and normals, an array a coordinate. */
typedef struct aur_lobe_frames {
    float x[3][AUR_PACKET_SIZE], y[3][AUR_PACKET_SIZE], z[3][AUR_PACKET_SIZE];
    float shading[3][AUR_PACKET_SIZE], geometric[3][AUR_PACKET_SIZE]; /* normals on the viewer's side */
    bool times_cosine[AUR_PACKET_SIZE];
} aur_lobe_frames;

static inline void aur_set_column(float column[3][AUR_PACKET_SIZE], size_t lane, aur_vector v) {
    column[0][lane] = v.x;
    column[1][lane] = v.y;
    column[2][lane] = v.z;
}

/* Adds what the places' lobes gather (lobes.c). */
void aur_group_gather(aur_group *group);

/* Adds the light that reaches the places straight from lights (light_direct.c). */
void aur_group_add_direct_light(aur_group *group);

/* BSDF * cos towards a light, each lobe less the part that its gather rays find. */
aur_vector aur_group_weighted_value(const aur_final_gather *data, const aur_gather_place *p,
                                    const aur_light_sample *light);

/* Traces the group's packet, whose lanes `aimed` are set, as shadow rays; adds what is not stopped. */
void aur_group_add_unoccluded(aur_group *group, aur_embree_order order, uint32_t aimed,
                              const aur_vector contribution[AUR_PACKET_SIZE]);

/* Adds the light that reaches the places from bright texels (light_bright.c). */
void aur_group_add_bright_light(aur_group *group);

/* Whether a lobe's light comes by gather rays. */
bool aur_group_gathers(const aur_final_gather *data, const aur_bsdf_lobe *lobe);

/* What a lane's pattern for its lobe number `lobe` is turned by. Under "blue" all lanes of the group have the
 * same turn. */
aur_gather_turn aur_group_turn(const aur_group *group, const aur_gather_rule *rule, size_t lane,
                               uint64_t lobe);

/* A rule at the places of some lanes, direction by direction. */
typedef struct aur_rule_walk {
    const aur_gather_rule *rule;
    size_t lobe;
    uint32_t lanes;
    uint32_t factored; /* lanes whose lobe has a factor */
    bool shared;       /* all lanes have one turn */
    bool weighs;       /* factors have the rule's weights */
    float share;       /* directions that one sample sends */
    aur_embree_order order;
    aur_gather_turn turns[AUR_PACKET_SIZE];
    aur_lobe_frames frames;
} aur_rule_walk;

/* Traces direction `index`; group->rays.radiance has what came along it. Returns the lanes above whose
 * surface it lies, and what their radiance is to be multiplied by; the others' is 0. */
uint32_t aur_group_trace_direction(aur_group *group, const aur_rule_walk *walk, size_t index,
                                   float factor[AUR_PACKET_SIZE]);

/* Adds the lobes' integrals by as many levels as they need (estimate_levels.c). */
void aur_group_gather_adaptive(aur_group *group, aur_rule_walk *walk, const aur_gather_levels *levels);

/* One lane's frame and normals; its rays start at its place. */
void aur_group_set_frame(aur_group *group, size_t lane, const aur_frame *frame, aur_lobe_frames *frames);

/* Directions local to the lobes made into rays; those below the surface are left out. Returns the lanes that
 * have one; their cosines at the surface in `cosine`. */
uint32_t aur_group_aim(aur_group *group, uint32_t lanes, const aur_lobe_frames *restrict frames,
                       float local[3][AUR_PACKET_SIZE], float cosine[AUR_PACKET_SIZE]);

#endif
