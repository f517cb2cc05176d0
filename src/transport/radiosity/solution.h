/* The inside of a radiosity solution. */
#ifndef AUR_TRANSPORT_RADIOSITY_SOLUTION_H
#define AUR_TRANSPORT_RADIOSITY_SOLUTION_H

#include "transport/radiosity/walk.h"

struct aur_radiosity {
    aur_radiosity_scene scene;
    aur_radiosity_walk walk;
    aur_radiosity_options options;
    char *sequence; /* options.sequence */
    uint64_t paths, coincident;
    double change;                /* NaN: never measured */
    aur_radiosity_tally *tallies; /* one a randomisation */
    size_t lane_count;
    aur_radiosity_tally *lanes; /* one a thread and randomisation: empty between calls */
    bool warned;
};

enum { AUR_RADIOSITY_MOST_BOUNCES = 10000, AUR_RADIOSITY_MOST_RANDOMIZATIONS = 1024 };

/* Paths that randomisation r has among the first `paths`. */
static inline uint64_t aur_radiosity_share(const aur_radiosity *radiosity, size_t r, uint64_t paths) {
    const uint64_t count = radiosity->options.randomizations;
    return paths / count + (r < paths % count);
}

/* The power that a patch receives, RGB watts, over all randomisations. */
void aur_radiosity_power(const aur_radiosity *radiosity, size_t patch, double power[3]);
/* The standard error of that; NaN with one randomisation. */
void aur_radiosity_power_error(const aur_radiosity *radiosity, size_t patch, double error[3]);
/* Over all patches, in the unit of epsilon. */
double aur_radiosity_standard_error(const aur_radiosity *radiosity);

/* Pairs of triangles that lie in one plane and overlap. Beyond a number that nobody looks at one by one they
 * are no longer sought: many copies of one triangle would take the square of their number. */
enum { AUR_RADIOSITY_MOST_COINCIDENCES = 1 << 20 };
typedef struct aur_radiosity_coincidence {
    uint64_t pairs;
    uint32_t triangles[2]; /* the first pair */
} aur_radiosity_coincidence;
aur_result aur_radiosity_find_coincidences(const aur_radiosity_scene *scene, aur_radiosity_coincidence *found,
                                           aur_error *error);

#endif
