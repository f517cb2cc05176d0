/* Integrators supplied by the caller that gather light like `finalgather`, with more keys. `finalgather` has
 * the keys that images need. What reproduces papers on gathering (Marques 2013, 2018, 2019) is an integrator
 * supplied by the caller, whose further keys are fields of the struct below:
 *
 *     static const aur_key keys[] = {
 *         {.name = "rotations", .type = AUR_KEY_INTEGER, .help = "randomisations made beforehand",
 *          .default_text = "16", .maximum = 65536,
 *          .offset = offsetof(aur_gather_settings, rotations), .size = sizeof(size_t)},
 *     };
 *     static const aur_gather_integrator study = {
 *         .size = sizeof study, .row = {.name = "study", .key_count = 1, .keys = keys}};
 *     options.integrator = "study:rotations=0,diffuse_samples=16";
 *     options.gather = &study;
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_GATHER_H
#define AUREOLE_GATHER_H

#include <aureole/sphere.h>
#include <aureole/tables.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The words of a CHOICE key are listed in the order of its field's enum. */

/* Which lobes are gathered. */
typedef enum aur_gather_component {
    AUR_COMPONENT_ALL,
    AUR_COMPONENT_DIFFUSE,
    AUR_COMPONENT_GLOSSY
} aur_gather_component;
/* Direct light: by light samples, by gather rays that hit lights, or left out. */
typedef enum aur_gather_direct { AUR_DIRECT_NEE, AUR_DIRECT_GATHER, AUR_DIRECT_NONE } aur_gather_direct;
/* Incident light of gather rays: from photons and emitters, or from emitters only. */
typedef enum aur_gather_incident { AUR_INCIDENT_PHOTONS, AUR_INCIDENT_EMITTERS } aur_gather_incident;
/* Whether paths correct the bias of the photon map; or the image has the correction alone. */
typedef enum aur_gather_debias {
    AUR_DEBIAS_NONE,
    AUR_DEBIAS_ALL,
    AUR_DEBIAS_ONLY,
    AUR_DEBIAS_FOUND /* the correction alone, without light of the map that paths cannot find */
} aur_gather_debias;
/* How the rotations of neighbouring pixels differ: dithered over blocks of 4 x 4, at random, not at all. */
typedef enum aur_gather_decorrelation {
    AUR_DECORRELATION_BLUE,
    AUR_DECORRELATION_RANDOM,
    AUR_DECORRELATION_NONE
} aur_gather_decorrelation;
/* Weights of samples: p/q, 1, or those that the caller's method computes. */
typedef enum aur_gather_weights {
    AUR_WEIGHTS_RATIO,
    AUR_WEIGHTS_EQUAL,
    AUR_WEIGHTS_METHOD
} aur_gather_weights;
/* The density of directions: the lobe's, or its power 2/(s+1); DEFAULT is the first with equal weights, else
 * the second. */
typedef enum aur_gather_density {
    AUR_GATHER_DENSITY_SAME,
    AUR_GATHER_DENSITY_OPTIMAL,
    AUR_GATHER_DENSITY_DEFAULT
} aur_gather_density;
/* Diffuse light shared with neighbouring pixels: none; one pattern is split among the pixels of 4 x 4, which
 * pool their results; or patterns complement each other, and pixels pool with the nearest. */
typedef enum aur_gather_share { AUR_SHARE_NONE, AUR_SHARE_BLOCKS, AUR_SHARE_NEAR } aur_gather_share;
/* Camera rays over the pixel, or through its centre. */
typedef enum aur_gather_pixel { AUR_PIXEL_FILTER, AUR_PIXEL_CENTRE } aur_gather_pixel;

/* Settings of gathering. The library creates the struct with the defaults in brackets; then keys set its
 * fields. Strings are read only while the integrator is created. */
typedef struct aur_gather_settings {
    /* Directions and their weights. */
    size_t diffuse_samples, glossy_samples; /* directions per pixel of each lobe [64] */
    size_t split;                           /* samples that share a pattern; 0: all of a pixel [0] */
    const char *pattern;                    /* SET of the directions [spherical-fibonacci] */
    const char *map;                        /* of a square set to the hemisphere [lambert] */
    const char *scramble;                   /* of the pattern [NULL: digit for nets, else rotate] */
    size_t rotations;                       /* randomisations prepared in advance; 0: one per pixel [16] */
    uint64_t pattern_seed;                  /* another randomisation under the same seed [0] */
    aur_gather_decorrelation decorrelation; /* [BLUE] */
    aur_gather_share share;                 /* [NONE] */
    aur_gather_density density;             /* [DEFAULT] */
    aur_gather_weights weights;             /* [RATIO] */
    double smoothness;                      /* s of the optimal density, in (1, 2) [1.5] */
    bool clip;                              /* glossy lobes end at the surface's horizon [true] */
    /* Light. */
    size_t photons, caustic_photons; /* of the map [500000], and of a separate map of caustics [0: none] */
    uint64_t photon_seed;            /* the same photons under all seeds; 0: by the image's seed [0] */
    const char *photon_pattern;      /* SET of the photons' numbers [sobol] */
    double photons_per_texel;        /* that a texel of irradiance is the mean of [16] */
    aur_gather_debias debias;        /* [NONE] */
    double continued;         /* fraction of the gather rays that continue as paths, for debias [0.25] */
    double short_rays;        /* gather rays shorter than this many widths of a texel continue as paths [2] */
    uint32_t light_samples;   /* points on lights that each sample's shadow rays aim at [1] */
    size_t bright_samples;    /* rays per pixel to brightly lit texels, drawn as lights are [0] */
    aur_gather_direct direct; /* [NEE] */
    aur_gather_incident incident;   /* [PHOTONS] */
    aur_gather_component component; /* [ALL] */
    uint32_t max_depth;             /* edges of a light path; UINT32_MAX: no limit [that] */
    /* Camera rays. */
    aur_gather_pixel pixel; /* [FILTER] */
    uint32_t edge_samples;  /* extra camera rays at edges of objects [128] */
    bool packets;           /* sixteen rays at a time, else one: the same image up to rounding [true] */
} aur_gather_settings;

/* --- a gathering method supplied by the caller: directions and their weights */

/* Shading points that are gathered together, one per lane; a mask has one bit per lane. */
enum { AUR_GATHER_LANES = 16 };

/* The directions that gather a lobe cos^exponent about +z: the mean over all of weight * f estimates the
 * integral of cos^exponent * f over the hemisphere, of solid angle. */
typedef struct aur_gather_directions {
    size_t count, copies; /* the arrays hold copies * count: the pattern in all prepared scramblings */
    double exponent;
    const float *x, *y, *z, *densities; /* with which directions are drawn, per steradian */
    float *weights;                     /* `prepare` may replace them */
} aur_gather_directions;

/* What all patterns of a render have in common. */
typedef struct aur_gather_common {
    aur_map map;           /* of sets of the square */
    aur_scramble scramble; /* of the pattern */
    uint64_t seed;         /* of rotations */
    size_t subsets;        /* samples of a pixel among which directions are split */
    size_t threads;        /* 0: all */
    bool use_cache;        /* of earlier runs */
    const aur_progress *progress;
} aur_gather_common;

/* Some shading points, and what is gathered there. */
typedef struct aur_gather_sweep aur_gather_sweep;

/* Traces direction `index` of the pattern, below the count, in `lanes`, a subset of the lanes passed to
 * `gather`. values[c][lane] becomes the light reflected by the lobe, per channel, without the direction's
 * weight and the lobe's colour; 0 in other lanes. Returns the lanes whose surface the direction is above. */
AUR_EXPERIMENTAL uint32_t aur_gather_trace(aur_gather_sweep *sweep, uint32_t lanes, size_t index,
                                           float values[3][AUR_GATHER_LANES]) AUR_NONNULL(1, 4);
/* Completes a lane with its integral, the number of directions used, and its level in statistics.levels. */
AUR_EXPERIMENTAL void aur_gather_finish(aur_gather_sweep *sweep, size_t lane, const float integral[3],
                                        size_t directions, size_t level) AUR_NONNULL(1, 3);

/* A shading point of `gather_pairs` or `gather_ggx`. */
typedef struct aur_gather_shading_point {
    /* Of the point's pattern: the glossy one, or the GGX lobe's; NULL: it has the diffuse lobe only. */
    const void *state;
    float view[3];   /* unit, towards the viewer; in the frame of the surface, whose normal is +z */
    size_t rotation; /* of the options' number of prepared ones: by which the point turns its patterns, */
    bool mirrored;   /* and whether they are mirrored too */
    /* Pairs, the diffuse lobe first: */
    float axes[2][3];    /* of the lobes, unit, of the world */
    float colours[2][3]; /* of the lobes; black: not gathered */
    bool times_cosine;   /* the glossy lobe has a factor of the cosine to the normal besides its power */
    /* The diffuse lobe only: the cosine and sine of the pattern's rotation about its axis, and the first
     * direction of its copy. */
    float cosine, sine;
    size_t first;
} aur_gather_shading_point;

/* Describes the point of a lane. False: it cannot be gathered here, since it has other lobes or none. */
AUR_EXPERIMENTAL bool aur_gather_describe(const aur_gather_sweep *sweep, size_t lane,
                                          aur_gather_shading_point *point) AUR_NONNULL(1, 3);
/* The subset that this sample of the pixels traces: directions subset, subset + subsets, ... */
AUR_EXPERIMENTAL size_t aur_gather_subset(const aur_gather_sweep *sweep) AUR_NONNULL(1);
/* Traces a unit direction of the world from each of `lanes`. `index` numbers the directions of a point; it
 * seeds random decisions along the ray. densities[lane] is the density of the point's directions of this
 * sample there, per steradian, by which emission is weighed against light samples. Writes cosines to the
 * normal, and radiance[channel][lane], 0 in other lanes. Returns the lanes whose surface the direction is
 * above. */
AUR_EXPERIMENTAL uint32_t aur_gather_trace_directions(aur_gather_sweep *sweep, uint32_t lanes, size_t index,
                                                      const float directions[3][AUR_GATHER_LANES],
                                                      const float densities[AUR_GATHER_LANES],
                                                      float cosines[AUR_GATHER_LANES],
                                                      float radiance[3][AUR_GATHER_LANES])
    AUR_NONNULL(1, 4, 5, 6, 7);
/* The same along directions that the GGX lobe draws from points square[2][lane] of the unit square, `draws`
 * of them per sample. values[channel][lane] becomes the lobe times the cosine over the density and `draws`.
 */
AUR_EXPERIMENTAL uint32_t aur_gather_trace_ggx(aur_gather_sweep *sweep, uint32_t lanes, size_t index,
                                               float draws, const float square[2][AUR_GATHER_LANES],
                                               float values[3][AUR_GATHER_LANES],
                                               float cosines[AUR_GATHER_LANES],
                                               float radiance[3][AUR_GATHER_LANES])
    AUR_NONNULL(1, 5, 6, 7, 8);
/* Adds radiance that a lane's point reflects towards the viewer. */
AUR_EXPERIMENTAL void aur_gather_reflect(aur_gather_sweep *sweep, size_t lane, const float radiance[3])
    AUR_NONNULL(1, 3);
/* Counts a point whose weights could not be computed in statistics.unsolved_weights. */
AUR_EXPERIMENTAL void aur_gather_count_unsolved(aur_gather_sweep *sweep) AUR_NONNULL(1);

/* `options` are the settings of the render; if the integrator's struct begins with them, they are part of it.
 * Functions may be NULL where stated. Several threads call those that gather at once; `memory` is 3 *
 * AUR_GATHER_LANES floats for each direction of the diffuse and of the largest glossy pattern. */
typedef struct aur_gather_method {
    /* The SET and number of the directions for `base` of diffuse_samples or glossy_samples; `set` holds
     * `capacity` characters. For `gather`; else they are those of the options. */
    aur_result (*choose)(const aur_gather_settings *options, size_t base, size_t capacity, char *set,
                         size_t *count, aur_error *error);
    /* Makes *state for a pattern, which outlives it: first the diffuse one, `diffuse` is NULL; then one for
     * each exponent of glossy lobes, with the state of the diffuse one. Released also after an error. */
    aur_result (*prepare)(const aur_gather_settings *options, const aur_gather_common *common, size_t base,
                          const aur_gather_directions *pattern, void *diffuse, void **state,
                          aur_error *error);
    void (*release)(void *state); /* NULL is allowed */
    /* Gathers one lobe by its whole pattern; must finish each lane once. NULL: by the pattern's weights;
     * the samples of a pixel split the pattern. */
    void (*gather)(const void *state, uint32_t lanes, aur_gather_sweep *sweep, float *memory);
    /* Gathers both lobes of points that have one diffuse and one glossy lobe, and may gather points with a
     * diffuse lobe only. Returns the lanes that it gathered, all pairs among them. `diffuse` is the state of
     * the diffuse pattern. NULL: each lobe alone. */
    uint32_t (*gather_pairs)(const void *diffuse, uint32_t lanes, aur_gather_sweep *sweep, float *memory);
    /* Of pairs: the density of the directions of one sample at these cosines to both axes, per steradian. */
    float (*pair_density)(const void *glossy, const float cosines[2]);
    /* Makes *state for GGX lobes of one roughness, gathered with `count` directions; it may remain NULL.
     * NULL: they are sampled. */
    aur_result (*prepare_ggx)(const aur_gather_settings *options, const aur_gather_common *common,
                              size_t count, float alpha, void **state, aur_error *error);
    void (*release_ggx)(void *state); /* NULL is allowed */
    void (*gather_ggx)(uint32_t lanes, aur_gather_sweep *sweep);
} aur_gather_method;

/* --- the integrator */

/* An integrator supplied by the caller, in addition to those of the library. Its keys are fields of
 * aur_gather_settings, or of a struct that begins with it; the keys of `finalgather` are also accepted. It
 * must outlive the render. */
typedef struct aur_gather_integrator {
    size_t size; /* of this struct; else ARGUMENT */
    aur_row row; /* its name must differ from those of the library's integrators */
    /* Size of the struct that the keys are fields of; 0: aur_gather_settings alone. Fields after these start
     * as in `initial`, a whole struct, or as zeros if that is NULL. */
    size_t settings_size;
    const void *initial;
    /* Completes the options and selects a method for them: *method remains NULL to gather like finalgather.
     * NULL: never. Errors: options that exclude each other. */
    aur_result (*select)(aur_gather_settings *options, aur_warnings warnings,
                         const aur_gather_method **method, aur_error *error);
} aur_gather_integrator;

#ifdef __cplusplus
}
#endif

#endif
