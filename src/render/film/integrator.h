/* Integrators: estimators of the radiance along camera rays. One per file, with one line in the table of
 * integrator.c. */
#pragma once

#include <aureole-render/gather.h>
#include <aureole-render/render.h>

#include <stdlib.h>

#include "points/base/cache.h"
#include "points/base/keys.h"
#include "render/film/film.h"
#include "render/scene/scene.h"

/* The context of an integrator. Everything but the parameters outlives it. */
typedef struct aur_integrator aur_integrator;
typedef struct aur_integrator_context aur_integrator_context;

/* Creates the integrator that parameters->plugin names; errors include the position in the scene file. */
typedef aur_result aur_integrator_factory(aur_parameters *parameters, const aur_integrator_context *context,
                                          aur_integrator **integrator, aur_error *error);

struct aur_integrator_context {
    const aur_scene *scene;
    size_t samples_per_pixel;
    uint64_t seed;
    size_t threads;
    aur_cache *cache; /* shared by renders of one scene */
    bool use_cache;   /* ... and what later runs may take from files of the cache (points/base/file.h) */
    aur_progress progress;
    aur_warnings warnings;
    const aur_gather_integrator *gather; /* supplied by the caller; or NULL */
    /* For integrators that contain another one; set by aur_integrator_create. */
    aur_integrator_factory *create;
};

/* A key that an integrator no longer has, and where it is now: "it is a key of ...". */
typedef struct aur_moved_key {
    const char *name, *where;
} aur_moved_key;

typedef struct aur_integrator_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor */
    /* Of the struct at integrator->data. It starts as `initial`, or zeros if that is NULL; then the keys are
     * read. Freed with the integrator. */
    size_t size;
    const void *initial;
    const aur_moved_key *moved; /* NULL: none; the last row is empty */
    /* Prepares what all rays share (a photon map, for example), on several threads; NULL: nothing. Strings
     * among the keys belong to the caller and are invalid afterwards. */
    aur_result (*create)(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error);
    /* Prepares what also depends on the image size and the camera; NULL: nothing. */
    aur_result (*prepare_view)(const aur_view *view, const aur_integrator_context *context,
                               aur_integrator *integrator, aur_error *error);
    /* Frees what integrator->data points to, if it was prepared; NULL: nothing. */
    void (*release)(aur_integrator *integrator);
    /* Radiance that arrives along the camera ray. */
    aur_vector (*radiance)(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters);
    /* Adds the samples of a tile, for integrators that process pixels together or fill more channels; NULL:
     * one camera ray at a time, as in aur_integrator_add_samples. The sums of a pixel must not depend on
     * which of its neighbours need samples. */
    aur_result (*tile)(const aur_integrator *integrator, aur_tile *tile);
    /* For light tracing, whose paths end anywhere in the image: computes sample `index` of all pixels; the
     * tiles then read it. Splats are weighed by `filter`. NULL: none. Errors: MEMORY, CANCELLED. */
    aur_result (*round)(aur_integrator *integrator, const aur_view *view, const aur_filter *filter,
                        uint32_t index, const aur_parallel_options *parallel, aur_counters *counters,
                        aur_error *error);
    /* Of `tile`: it adds a pixel's samples one after the other, so that any division into calls gives the
     * same bits. Otherwise it calls aur_tile_stops itself, and returns AUR_ERROR_CANCELLED. */
    bool cuts;
    /* Its image is not the radiance of all paths of light, so no other integrator may replace it. */
    bool own_image;
    /* Camera rays hit emitters, so that their outlines contribute to the image's error. */
    bool shows_emitters;
} aur_integrator_descriptor;

/* False where samples_per_pixel is AUR_SAMPLES_PER_PIXEL_MAX: final sample count unknown. */
static inline bool aur_integrator_knows_samples(const aur_integrator_context *context) {
    return context->samples_per_pixel < AUR_SAMPLES_PER_PIXEL_MAX;
}

struct aur_integrator {
    const aur_integrator_descriptor *descriptor;
    const aur_scene *scene;
    const aur_gather_integrator *gather; /* supplied by the caller; else NULL */
    void *data;
    void *prepared;             /* by create, where it is not in `data` */
    bool pixel_centre;          /* every camera ray goes through the centre of its pixel */
    bool whole_tiles;           /* all pixels of a tile have the same number of samples */
    bool hides_emitters;        /* from camera rays */
    bool refines_emitter_edges; /* traces more rays in a pixel whose neighbours see the edge of an emitter */
    uint32_t samples_a_pattern; /* samples of a pixel that form one pattern; 0: no patterns */
    const uint16_t
        *emitter_probes; /* of each pixel of the image: probe rays for emitters per sample; NULL: none */
    size_t extra_count;  /* channels after R, G, B; at most AUR_EXTRA_CHANNELS_MAX */
    const char *const *extra_names; /* as in the image's file */
    /* What they show; NULL: means. */
    const aur_channel_kind *extra_kinds;
};

static inline bool aur_integrator_cuts(const aur_integrator *integrator) {
    return integrator->descriptor->tile == NULL || integrator->descriptor->cuts;
}

extern const aur_table aur_integrator_table;

/* Adds the samples of a tile, each the radiance along a camera ray. */
static inline void aur_integrator_add_samples(const aur_integrator *integrator, aur_tile *tile) {
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x)
            for (uint32_t i = 0; i < tile->count; ++i) {
                if (tile->counters.stopped)
                    return;
                if (!aur_tile_needs(tile, x, y, tile->first + i))
                    continue;
                aur_camera_sample sample;
                aur_view_sample(tile->view, x, y, tile->first + i, &sample);
                aur_tile_add(tile, x, y, tile->first + i, sample.offset,
                             integrator->descriptor->radiance(integrator, &sample, &tile->counters));
            }
}

aur_integrator_factory aur_integrator_create;
/* Whether the parameters name an integrator of the library or `gather` (or NULL), and its keys can be read:
 * the first check of aur_integrator_create. */
aur_result aur_integrator_check(aur_parameters *parameters, const aur_gather_integrator *gather,
                                aur_error *error);

/* The integrator of an image to a target as aur_render_options take it, a new string; NULL: the scene's.
 * `open`: none is requested, nor does the scene's hide what final gathering shows, so others may replace it.
 * Errors: MEMORY. */
aur_result aur_integrator_of_scene(const aur_scene *scene, const char *requested, char **integrator,
                                   bool *open, aur_error *error);

/* Frees what its data point to. */
static inline void aur_integrator_release(void *object) {
    aur_integrator *const integrator = object;
    if (integrator->descriptor->release != NULL)
        integrator->descriptor->release(integrator);
}

static inline void aur_integrator_destroy(aur_integrator *integrator) {
    if (integrator == NULL)
        return;
    aur_integrator_release(integrator);
    free(integrator->data);
    free(integrator);
}
