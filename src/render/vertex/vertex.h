/* Direct light at a surface point by multiple importance sampling of lights and BSDF (Veach 1997, power
 * heuristic). */
#pragma once

#include "render/film/integrator.h"
#include "render/vertex/shading.h"

/* Dimension pairs of one bounce: (light choice, roulette), light position, (lobe choice, choice among
 * candidates), direction. */
enum { AUR_PATH_CHOICE, AUR_PATH_POSITION, AUR_PATH_LOBE, AUR_PATH_DIRECTION, AUR_PATH_PAIRS };

/* The first pair of a bounce. Those of the first come with the camera's, the others two bounces at once. */
static inline uint32_t aur_path_pair(uint32_t depth) {
    return depth == 1 ? AUR_PAIR_FIRST : AUR_STREAM_BLOCK + AUR_PATH_PAIRS * (depth - 2);
}

/* Whether a path that has become long is to be left because the work stops. */
static inline bool aur_path_stops(uint32_t depth, bool *stopped) {
    enum { EDGES_BETWEEN = 1 << 10 };
    if (depth % EDGES_BETWEEN == 0 && aur_parallel_stops())
        *stopped = true;
    return *stopped;
}

/* The probability to go on, under Russian roulette. */
static inline float aur_path_survival(aur_vector throughput) {
    return aur_smaller(aur_vector_max(throughput), 0.95f);
}

/* The weight of a sample drawn with density `pdf` where the rival technique has density `other`. */
static inline float aur_power_heuristic(float pdf, float other) {
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/* A light sample before it is known whether anything lies between. */
typedef struct aur_shadow {
    aur_ray ray; /* from the surface to the light */
    aur_vector
        radiance; /* reflected towards the viewer if nothing does, by its share in the sum of samples */
} aur_shadow;

/* How many light samples there are at a surface, and how many BSDF samples rival with them. */
typedef struct aur_light_draws {
    float count, rivals;
} aur_light_draws;

static const aur_light_draws AUR_LIGHT_DRAWS_OF_PATHS = {1.0f, 1.0f};

/* One of the light samples; u[0] chooses the light and the others a point on it, in [0,1). False: no light
 * comes that way. */
bool aur_direct_light_choose(const aur_scene *scene, const aur_shading *shading, const aur_light_draws *draws,
                             const float u[3], aur_shadow *shadow);
/* The same of a point that has been drawn. */
bool aur_direct_light_shadow(const aur_shading *shading, const aur_light_draws *draws,
                             const aur_light_sample *light, aur_shadow *shadow);
