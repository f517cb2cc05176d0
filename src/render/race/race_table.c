#include "render/race/race.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "points/base/text.h"

/* The work of tracing and sorting one photon, in rays. */
static const double RAYS_PER_PHOTON = 2.5;
enum { LEAST_PHOTONS = 50000, MOST_PHOTONS = 2000000 }; /* of a replica's map */

/* Candidates' shading takes time without a ray: 1.13 to 1.22 times a plain path's in four scenes. */
#define CANDIDATES_PRICE 1.2

/* Path tracing; final gathering by 8 directions shared with neighbours; by 32, with 4 and with 16 light
 * samples; and without short rays; paths with two candidates for each light sample; and gathering by 4 shared
 * directions. */
const aur_race_row aur_race_rows[AUR_RACE_ROWS] = {
    [AUR_RACE_PATH] = {"path", NULL, NULL, 6, 1.0, 1.0, false},
    [AUR_RACE_SHARED] = {"gather-8-shared", "split=1,diffuse_samples=8,glossy_samples=4,light_samples=4",
                         ",edges=96,share=near", 2, 1.0, 1.0, true},
    [AUR_RACE_MIDDLE] = {"gather-32", "split=4,diffuse_samples=32,glossy_samples=16,light_samples=4",
                         ",edges=192", 4, 4.0, 1.0, false},
    [AUR_RACE_LIGHTS] = {"gather-32-lights", "split=4,diffuse_samples=32,glossy_samples=16,light_samples=16",
                         ",edges=192", 4, 4.0, 1.0, false},
    [AUR_RACE_LONG] = {"gather-32-long",
                       "split=4,diffuse_samples=32,glossy_samples=16,light_samples=1,short_rays=0",
                       ",edges=192", 4, 4.0, 1.0, false},
    [AUR_RACE_CANDIDATES] = {"path-2", "candidates=2", NULL, 6, 1.0, CANDIDATES_PRICE, false},
    [AUR_RACE_FOUR] = {"gather-4-shared", "split=1,diffuse_samples=4,glossy_samples=4,light_samples=2",
                       ",edges=48,share=near", 2, 1.0, 1.0, true},
};

static char *compose(size_t row, const char *path, size_t photons, const char *more) {
    if (aur_race_rows[row].keys == NULL)
        return strdup(path);
    const char *const keys = strchr(path, ':');
    if (!aur_race_gathers(row))
        return aur_new_text("%s%s%s", path, keys != NULL ? "," : ":", aur_race_rows[row].keys);
    return aur_new_text("finalgather:%s,photons=%zu%s%s%s", aur_race_rows[row].keys, photons, more,
                        keys != NULL ? "," : "", keys != NULL ? keys + 1 : "");
}

char *aur_race_integrator(size_t row, const char *path, size_t photons, uint64_t seed) {
    char more[80]; /* a number and the keys */
    const int length =
        snprintf(more, sizeof more, "%s", aur_race_rows[row].more != NULL ? aur_race_rows[row].more : "");
    if (seed > 0)
        snprintf(more + length, sizeof more - (size_t)length, ",photon_seed=%" PRIu64, seed);
    return compose(row, path, photons, more);
}

char *aur_race_correction(size_t row, const char *path, size_t photons) {
    return compose(row, path, photons, ",debias=found,continued=1");
}

uint64_t aur_race_seed(const aur_render_options *options) {
    return (options->seed & UINT32_MAX) + 1;
}

double aur_photon_work(size_t photons) {
    return RAYS_PER_PHOTON * (double)photons;
}

double aur_race_least_map(size_t replica_count) {
    return aur_photon_work(replica_count * LEAST_PHOTONS);
}

size_t aur_race_photons(double work, size_t replica_count) {
    const double photons = AUR_RACE_MAP_PART * work / (RAYS_PER_PHOTON * (double)replica_count);
    size_t rounded = LEAST_PHOTONS;
    while ((double)rounded * 2.0 <= photons && rounded * 2 <= MOST_PHOTONS)
        rounded *= 2;
    return rounded;
}
