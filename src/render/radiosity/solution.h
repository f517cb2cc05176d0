/* A radiosity solution: its scene, and the sums of all paths so far, separate for each randomisation. Images
 * and files do not change it; one call at a time may trace more paths. */
#pragma once

#include "points/base/error.h"
#include "render/radiosity/walk.h"

struct aur_radiosity {
    aur_radiosity_scene scene;
    aur_radiosity_walk walk;
    aur_radiosity_options options;
    char *sequence; /* options.sequence */
    uint64_t paths, coincident;
    double change;                /* NaN: never measured */
    aur_radiosity_tally *tallies; /* one per randomisation */
    size_t lane_count;            /* threads with separate tallies; 0: none yet */
    aur_radiosity_tally *lanes;   /* [lane_count][randomizations]: empty between calls */
    bool warned;                  /* of paths that ended badly */
};

enum { AUR_RADIOSITY_MOST_BOUNCES = 10000, AUR_RADIOSITY_MOST_RANDOMIZATIONS = 1024 };

/* Paths of randomisation r among the first `paths`. */
static inline uint64_t aur_radiosity_paths_of(const aur_radiosity *radiosity, size_t r, uint64_t paths) {
    const uint64_t count = radiosity->options.randomizations;
    return paths / count + (r < paths % count);
}

/* --- statistics: powers, their errors and their change, each in time proportional to the number of
 * randomisations for one patch */

/* The power that a patch receives, RGB watts, over all randomisations. */
void aur_radiosity_power(const aur_radiosity *radiosity, size_t patch, double power[3]);
/* The patch's power over pi and its area: times the albedo it is the reflected radiance. */
AUR_INTERNAL aur_vector aur_radiosity_exitance(const aur_radiosity *radiosity, size_t patch);
/* The standard error of the power; NaN with one randomisation. */
void aur_radiosity_power_error(const aur_radiosity *radiosity, size_t patch, double error[3]);
/* Over all patches, in the unit of epsilon. */
double aur_radiosity_standard_error(const aur_radiosity *radiosity);

/* The change (see aur_radiosity_termination) from `before`, a power per patch, to the current powers, which
 * are copied to `before`. */
double aur_radiosity_measure_change(const aur_radiosity *radiosity, double (*before)[3]);

/* Fills the result of aur_radiosity_get_description. */
void aur_radiosity_summarize(const aur_radiosity *radiosity, aur_radiosity_description *description);

/* One triangle's row of aur_radiosity_get_results. */
void aur_radiosity_result(const aur_radiosity *radiosity, size_t triangle,
                          aur_radiosity_triangle_result *out);

/* Writes the solution with all data needed to continue; loading it for another scene is an error. Of
 * `options` only threads, progress and warnings are used. Errors: WRITE; OPEN, FORMAT (with the reason). */
aur_result aur_radiosity_save(const aur_radiosity *radiosity, const char *path, aur_error *error);
aur_result aur_radiosity_load(const aur_scene *scene, const char *path, const aur_radiosity_options *options,
                              aur_radiosity **radiosity, aur_error *error);

/* Triangles coloured by their radiance: a binary PLY file of 3 vertices a triangle, sRGB bytes at `exposure`
 * stops and the radiance itself as floats. Errors: WRITE, UNSUPPORTED beyond 715 million triangles. */
aur_result aur_radiosity_write_ply(const aur_radiosity *radiosity, const char *path, double exposure,
                                   aur_error *error);
