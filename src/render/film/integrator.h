/* Integrators: how radiance along a camera ray is found. One a file, with one line in the table of
 * integrator.c. */
#pragma once

#include <aureole-render/gather.h>
#include <aureole-render/render.h>

#include <stdlib.h>

#include "points/base/cache.h"
#include "points/base/keys.h"
#include "render/film/film.h"
#include "render/scene/scene.h"

/* What an integrator is made for. Everything but the parameters outlives it. */
typedef struct aur_integrator aur_integrator;
typedef struct aur_integrator_context aur_integrator_context;

/* Makes the integrator that parameters->plugin names ready; errors carry the place in the scene file. */
typedef aur_result aur_integrator_factory(aur_parameters *parameters, const aur_integrator_context *context,
                                          aur_integrator **integrator, aur_error *error);

struct aur_integrator_context {
    const aur_scene *scene;
    size_t samples_per_pixel;
    uint64_t seed;
    size_t threads;
    aur_cache *cache; /* what renders of one scene share */
    bool use_cache;   /* ... and what later runs may take from files of the cache (points/base/file.h) */
    aur_progress progress;
    aur_warnings warnings;
    const aur_gather_integrator *gather; /* the caller's own; or NULL */
    /* For integrators that hold another one; set by aur_integrator_create. */
    aur_integrator_factory *create;
};

/* A key that an integrator no longer has, and where it is now: "it is a key of ...". */
typedef struct aur_moved_key {
    const char *name, *where;
} aur_moved_key;

typedef struct aur_integrator_descriptor {
    aur_row row; /* first, so that a row of the table is its descriptor */
    /* Of what integrator->data points to: `initial`, or zeros where that is NULL, and then what the keys say.
     * Freed in the end. */
    size_t size;
    const void *initial;
    const aur_moved_key *moved; /* NULL: none; its last row is empty */
    /* Prepares what all rays share (a photon map, say), on several threads; NULL: nothing. Texts among the
     * keys are the caller's and are gone afterwards. */
    aur_result (*create)(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error);
    /* Prepares what hangs on the image's size and on the camera's rays, too; NULL: nothing. */
    aur_result (*look)(const aur_view *view, const aur_integrator_context *context,
                       aur_integrator *integrator, aur_error *error);
    /* Frees what integrator->data points to further, if it was prepared; NULL: nothing. */
    void (*release)(aur_integrator *integrator);
    /* Radiance that arrives along the camera ray. */
    aur_vector (*radiance)(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters);
    /* Adds the samples of a tile, for integrators that treat pixels together or fill more channels; NULL: one
     * camera ray after the other, as aur_integrator_add_samples does. The sums of a pixel must not depend on
     * which of its neighbours are wanted. */
    aur_result (*tile)(const aur_integrator *integrator, aur_tile *tile);
    /* For light paths, which end anywhere in the image: computes sample `index` of all pixels, which the
     * tiles then take. Samples are weighed by `filter` as they are splatted. NULL: none. Errors: MEMORY,
     * CANCELLED.
     */
    aur_result (*round)(aur_integrator *integrator, const aur_view *view, const aur_filter *filter,
                        uint32_t index, const aur_parallel_options *parallel, aur_counters *counters,
                        aur_error *error);
    /* Of `tile`: it adds a pixel's samples one after the other, so that any cut of them into calls gives the
     * same bits. Else it asks aur_tile_stops on the way, and returns AUR_ERROR_CANCELLED. */
    bool cuts;
    /* The camera's rays meet lamps, so that their outlines are part of the image's error. */
    bool shows_lamps;
} aur_integrator_descriptor;

/* False where samples_per_pixel is AUR_SAMPLES_PER_PIXEL_MAX: final sample count unknown. */
static inline bool aur_integrator_knows_samples(const aur_integrator_context *context) {
    return context->samples_per_pixel < AUR_SAMPLES_PER_PIXEL_MAX;
}

struct aur_integrator {
    const aur_integrator_descriptor *descriptor;
    const aur_scene *scene;
    const aur_gather_integrator *gather; /* where it is the caller's own; else NULL */
    void *data;
    void *made;                 /* by create, where it is not in `data` */
    bool pixel_centre;          /* every camera ray goes through the centre of its pixel */
    bool whole_tiles;           /* all pixels of a tile have as many samples */
    bool refines_lamp_edges;    /* where neighbours see the edge of a lamp a pixel has more rays */
    uint32_t samples_a_pattern; /* samples of a pixel that form one pattern; 0: no patterns */
    const uint16_t *lamp_looks; /* of each pixel of the image: rays of a sample for lamps alone; NULL: none */
    size_t extra_count;         /* channels after R, G, B; at most AUR_EXTRA_CHANNELS_MAX */
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
                if (!aur_tile_wants(tile, x, y, tile->first + i))
                    continue;
                aur_camera_sample sample;
                aur_view_sample(tile->view, x, y, tile->first + i, &sample);
                aur_tile_add(tile, x, y, tile->first + i, sample.offset,
                             integrator->descriptor->radiance(integrator, &sample, &tile->counters));
            }
}

aur_integrator_factory aur_integrator_create;
/* Whether the parameters name an integrator of the library or `gather` (or NULL), and its keys can be read:
 * what aur_integrator_create asks first. */
aur_result aur_integrator_check(aur_parameters *parameters, const aur_gather_integrator *gather,
                                aur_error *error);

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
