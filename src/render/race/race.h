/* The race: which integrator needs the least work for a target error. Candidates render the same blocks of 4
 * x 4 pixels of the final image. Worse ones are dropped, and the number of blocks doubles, until one is left
 * or more blocks would cost more than they can save. */
#pragma once

#include <aureole-render/adaptive.h>

#include "render/film/blocks.h"
#include "render/film/film.h"
#include "render/replicas/replicas.h"

/* The rows of the table of candidates: path tracing, and the one that is used without a race. */
enum {
    AUR_RACE_PATH,
    AUR_RACE_SHARED,
    AUR_RACE_MIDDLE,
    AUR_RACE_LIGHTS,
    AUR_RACE_LONG,
    AUR_RACE_CANDIDATES,
    AUR_RACE_FOUR,
    AUR_RACE_ROWS
};

/* Whether a row gathers from a photon map; the others are path tracing, without bias. */
static inline bool aur_race_gathers(size_t row) {
    return row != AUR_RACE_PATH && row != AUR_RACE_CANDIDATES;
}

/* A candidate of the table. A correction has only `keys`: nothing is shared. */
typedef struct aur_race_row {
    const char *name, *keys, *more; /* of finalgather, or of path tracing; NULL: none */
    uint32_t samples;               /* per pixel that a replica renders in the race: whole patterns */
    double pattern;                 /* samples of a whole pattern */
    double price;                   /* work per ray, relative to path tracing's */
    bool shares;                    /* directions of neighbouring pixels */
} aur_race_row;

extern const aur_race_row aur_race_rows[AUR_RACE_ROWS];

/* The seed of the map that all candidates of a race share. */
uint64_t aur_race_seed(const aur_render_options *options);
/* A candidate's integrator with its keys, allocated with malloc; NULL: out of memory. `path` is
 * "path[:key=value...]", whose keys are passed on. Each replica has separate photons; with a `seed` other
 * than 0 all share one map. */
char *aur_race_integrator(size_t row, const char *path, size_t photons, uint64_t seed);
/* The integrator of a correction: paths' radiance at the ends of gather rays less the photon map's; not for
 * path tracing. */
char *aur_race_correction(size_t row, const char *path, size_t photons);

/* Photons of a replica's map that cost this part of so much work. */
#define AUR_RACE_MAP_PART 0.25
size_t aur_race_photons(double work, size_t replica_count);
/* The work of tracing `photons` photons, in rays; and of the smallest maps of all replicas. */
double aur_photon_work(size_t photons);
double aur_race_least_map(size_t replica_count);

typedef struct aur_race_entry {
    size_t blocks;   /* rendered so far */
    float *values;   /* [blocks][16 pixels][replicas][3] */
    double *roots;   /* [blocks] of the mean variance of a sample */
    double rays;     /* all that it took, without photons */
    double samples;  /* of all pixels and replicas */
    double bias;     /* square of the error beside the middle row's, at least */
    double need;     /* estimated work to the target, in rays; 0: not measured */
    char reason[96]; /* why it was dropped, not tried, or refused; else empty */
} aur_race_entry;

/* How much is compared. */
typedef struct aur_race_limits {
    size_t first_blocks; /* that all candidates render at first */
    double first_part; /* the largest work of these blocks, relative to the best candidate's for the image */
    double part;       /* and that of the whole race */
    double confidence; /* a candidate is dropped if it is worse in this part of the resamplings */
} aur_race_limits;

typedef struct aur_race {
    aur_renderer *renderer;
    const aur_render_options *options; /* of the image, with its size */
    const char *path;                  /* integrator of row 0 */
    size_t width, height;              /* of the film */
    size_t replica_count;              /* of the blocks */
    size_t image_replicas;             /* of the request */
    aur_error_measure measure;
    double error;   /* target of noise and bias; 0: none */
    double budget;  /* rays of the request; 0: none */
    double seconds; /* of the request; 0: none */
    bool apart;     /* pixels must not share directions */
    const atomic_bool *cancelled;
    const aur_race_limits *limits; /* NULL: the default ones */
    aur_film_layout layout;        /* of the film, once it is known */
    double emitted; /* mean of what the camera sees of emitters directly, R + G + B over the image */
    aur_blocks blocks;
    aur_race_entry entries[AUR_RACE_ROWS];
    size_t order[AUR_RACE_ROWS]; /* measured candidates, best first; always includes path */
    size_t order_count;
    double work; /* predicted work of the request, in rays */
    aur_spent spent;
} aur_race;

/* Fills entries, order and spent. Must be released in every case, which preserves these. Errors: CANCELLED,
 * MEMORY, and those of rendering by path tracing. */
aur_result aur_race_run(aur_race *race, aur_error *error);
void aur_race_release(aur_race *race);

/* Moves the candidate after `rank` that is expected to need least to the next place of the order; the one at
 * `rank` takes `wrong` (at least 1) times the rays that were predicted. False, and nothing is moved, if the
 * moved one is expected to need `left` rays or more, or was predicted to need more than `most`. */
bool aur_race_overtake(aur_race *race, size_t rank, double wrong, double most, double left);

/* The rank after `rank`. Behind the last it is the last place, where path tracing then is, which was left
 * before but has no bias: the one at `rank` would only repeat what it was rejected for. */
size_t aur_race_next(aur_race *race, size_t rank);
