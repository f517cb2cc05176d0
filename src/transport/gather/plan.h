/* Final gathering, from the inside: what its files share.
 *
 *     final_gather.c     keys; preparation: rules, weights, maps
 *     tile.c      a tile: its groups, its edges, the means of its pixels
 *     group.c     sixteen pixels at a time: what they see
 *     light_direct.c    their direct light
 *     light_bright.c    light of bright texels, drawn as lights are
 *     lobes.c     gathering by lobe; estimate_merged.c both lobes by merged samples;
 *                        estimate_levels.c by levels
 *     estimate_merged.c    two lobes of a place by the samples of both
 *     incident.c  radiance along gather rays; chain.c where it is not one array read
 *     edges.c     more primary rays where a pixel sees several things
 *     sharing.c   irradiance that neighbouring pixels have in common
 *
 * A tile of 16 x 16 pixels is done in 16 groups. A group has the pixels at one place of all 4 x 4 blocks of
 * the tile, and these share one randomisation of the patterns (interleaved sampling, Keller and Heidrich
 * 2001): on a flat wall its 16 rays of one direction of the pattern are parallel and make a coherent packet.
 */
#ifndef AUR_TRANSPORT_GATHER_PLAN_H
#define AUR_TRANSPORT_GATHER_PLAN_H

#include "scene/packet.h"
#include "transport/gather/rule.h"
#include "transport/gather/rule_levels.h"
#include "transport/gather/rule_merged.h"
#include "transport/gather/rule_weights.h"
#include "transport/integrator.h"
#include "transport/packets/interleave.h"
#include "transport/packets/packet_rays.h"
#include "transport/packets/shape_class.h"
#include "transport/photons/bright_texels.h"
#include "transport/photons/irradiance.h"

typedef enum aur_gather_component {
    AUR_COMPONENT_ALL,
    AUR_COMPONENT_DIFFUSE,
    AUR_COMPONENT_GLOSSY
} aur_gather_component;
typedef enum aur_gather_direct { AUR_DIRECT_NEE, AUR_DIRECT_GATHER, AUR_DIRECT_NONE } aur_gather_direct;
typedef enum aur_gather_incident { AUR_INCIDENT_PHOTONS, AUR_INCIDENT_EMITTERS } aur_gather_incident;
typedef enum aur_gather_decorrelation {
    AUR_DECORRELATION_BLUE,
    AUR_DECORRELATION_RANDOM,
    AUR_DECORRELATION_NONE
} aur_gather_decorrelation;
typedef enum aur_gather_weights {
    AUR_WEIGHTS_RATIO,
    AUR_WEIGHTS_EQUAL,
    AUR_WEIGHTS_OSW,
    AUR_WEIGHTS_OSWA,
    AUR_WEIGHTS_MIS,
    AUR_WEIGHTS_SOLVE
} aur_gather_weights;
typedef enum aur_gather_criterion { AUR_CRITERION_ENTROPY, AUR_CRITERION_VARIANCE } aur_gather_criterion;
enum { AUR_LONGEST_CHAIN = 16 }; /* specular bounces in a row */

typedef struct aur_final_gather {
    const aur_scene *scene;
    aur_gather_component component;
    aur_gather_direct direct;
    aur_gather_incident incident;
    aur_gather_decorrelation decorrelation;
    uint32_t max_depth;
    size_t samples_per_pixel, glossy_samples;
    uint32_t edge_samples;
    bool shares_irradiance; /* between neighbouring pixels */
    bool packets; /* else every ray by itself: the same picture to rounding, for tests and measurements */
    uint64_t pattern_seed;
    aur_gather_options options;
    aur_gather_rule diffuse;
    aur_gather_rule visible; /* evenly over the hemisphere, for lobes that are sampled: see
                                aur_gather_square; empty where no material has one */
    size_t glossy_count;     /* rules, one for each exponent of the scene's materials */
    aur_gather_rule *glossy;
    /* One a glossy rule, or NULL when the horizon is not minded. */
    float (*horizons)[AUR_HORIZON_STEPS + 1];
    size_t pair_count; /* with merged samples: one for each glossy rule */
    aur_gather_pair **pairs;
    bool adaptive;
    aur_gather_criterion criterion;
    float threshold;
    aur_gather_levels_options diffuse_growth, glossy_growth;
    aur_gather_levels diffuse_levels;
    aur_gather_levels *glossy_levels; /* one a glossy rule */
    size_t most_directions;           /* of any rule with levels */
    const aur_irradiance_map *map;    /* owned by the cache; NULL when incident light is emitters' alone */
    const aur_irradiance_map
        *caustics;            /* the light that specular bounces brought, which `map` has not; or NULL */
    aur_shape_class *classes; /* one a shape */
    uint32_t light_share;     /* points on lights that one sample draws */
    size_t bright_share;      /* draws of bright texels that one sample sends; 0: there are none */
    aur_bright_texels bright;
} aur_final_gather;

/* Renders a tile (tile.c): the integrator's `tile`. */
aur_result aur_final_gather_tile(const aur_integrator *integrator, aur_tile *tile);

/* The rule that serves a lobe: every lobe with a formula of the scene has one. */
const aur_gather_rule *aur_final_gather_rule(const aur_final_gather *data, const aur_bsdf_lobe *lobe);

/* The levels of a rule; NULL unless gathering is adaptive. */
const aur_gather_levels *aur_final_gather_levels(const aur_final_gather *data, const aur_gather_rule *rule);

/* Directions of a rule that one sample of a pixel sends; when adaptive, those of the first level. */
float aur_final_gather_share(const aur_final_gather *data, const aur_gather_rule *rule);

/* --- incident light (incident.c) */

/* Sixteen gather rays and what comes along them. */
typedef struct aur_gather_rays {
    aur_packet packet;
    /* The density of each direction, a steradian, times the number of directions a surface point sends, that
     * a light's own sampling is weighed against. */
    float density[AUR_PACKET_SIZE];
    /* Not NULL: instead, the density of both its patterns about these axes, found only where it is needed. */
    const aur_gather_pair *pairs[AUR_PACKET_SIZE];
    aur_vector axes[AUR_PACKET_SIZE][2];
    uint64_t hash;                         /* of what chance decides along specular chains */
    aur_vector reference[AUR_PACKET_SIZE]; /* the points that gather */
    float radiance[3][AUR_PACKET_SIZE];    /* 0 for lanes without a ray */
} aur_gather_rays;

void aur_gather_trace(const aur_final_gather *data, aur_embree_order order, aur_gather_rays *rays,
                      aur_counters *counters);

/* One ray that has left a gathering point. */
typedef struct aur_gather_ray {
    aur_ray ray;
    aur_vector reference; /* the point */
    float density;        /* see aur_gather_rays */
    uint64_t hash;        /* of what chance decides on its way */
} aur_gather_ray;

/* Radiance along a ray whose first hit is `hit`, or NULL when it left the scene (chain.c). */
aur_vector aur_gather_chain_radiance(const aur_final_gather *data, const aur_gather_ray *from,
                                     const aur_hit *hit, aur_counters *counters);

/* Closest hits of a packet, as the parameter `packets` wants them. */
uint32_t aur_final_gather_intersect(const aur_final_gather *data, aur_embree_order order, aur_packet *packet,
                                    aur_counters *counters);
uint32_t aur_final_gather_occluded(const aur_final_gather *data, aur_embree_order order, aur_packet *packet,
                                   aur_counters *counters);

/* Whether gather rays count the lights that they meet in full. Under next-event estimation they count them
 * by multiple importance sampling. */
bool aur_gathers_emitters(const aur_final_gather *data);

/* --- groups of pixels (group.c) */

/* What a pixel's samples have seen of one thing. */
typedef struct aur_stratum {
    uint64_t key;  /* of the surface that the eye's ray met; 0: nothing */
    double seen;   /* samples that met it, by weight */
    double shaded; /* those whose radiance is in `sum` */
    double sum[3];
    /* With shared irradiance, over the samples that gathered, `gathers` by weight: */
    float gathers;
    aur_vector irradiance;  /* sum of the diffuse lobe's integrals without its coefficient */
    aur_vector coefficient; /* sum of what they are to be multiplied by */
    aur_vector position, normal;
} aur_stratum;

enum { AUR_STRATUM_COUNT = 6 }; /* the last one takes what comes after */

typedef struct aur_pixel_strata {
    uint32_t count;
    uint32_t samples;    /* valid ones */
    uint64_t directions; /* gathered with, when adaptive */
    aur_stratum strata[AUR_STRATUM_COUNT];
} aur_pixel_strata;

/* Adds sample `index` of the group's pixels whose bit in `lanes` is set. With `known` only what a pixel has
 * not yet seen is shaded. `strata` has AUR_TILE_PIXELS, row by row. */
typedef struct aur_group_task {
    const aur_final_gather *data;
    const aur_view *view;
    size_t x, y; /* of the tile's corner */
    uint32_t group;
    uint32_t lanes;
    uint32_t index;
    bool known;
} aur_group_task;

typedef struct aur_group aur_group;
/* Working memory; NULL: out of memory. */
aur_group *aur_group_create(const aur_final_gather *data);
void aur_group_destroy(aur_group *group);
void aur_group_add_sample(aur_group *group, const aur_group_task *task, aur_pixel_strata *strata,
                          aur_counters *counters);

/* --- sharing (sharing.c) */

/* Adds to every stratum of a tile its diffuse light by the irradiance that neighbouring pixels share. False:
 * out of memory. */
bool aur_gather_share_irradiance(aur_pixel_strata *strata);

/* --- edges (edges.c) */

/* What a lane's ray hit: the shape and which way it faces. Never 0, which is nothing. */
uint64_t aur_final_gather_key(const aur_final_gather *data, const aur_packet *packet, size_t lane);
#define AUR_KEY_EMITS (UINT64_C(1) << 63)

/* Adds edge_samples to the pixels that see, or whose neighbours see, more than one thing. */
void aur_gather_refine_edges(aur_group *group, const aur_group_task *task, uint32_t first_index,
                             aur_pixel_strata *strata, aur_counters *counters);

#endif
