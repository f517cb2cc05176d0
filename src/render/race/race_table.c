#include "render/race/race.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "points/base/text.h"

/* The work of tracing and sorting one photon, in rays. */
static const double RAYS_PER_PHOTON = 2.5;
enum { LEAST_PHOTONS = 50000, MOST_PHOTONS = 2000000 }; /* of a replica's map */

/* Path tracing; final gathering by 8 directions shared with neighbours; by 32, with 4 and with 16 light
 * samples; and without short rays; paths with two candidates for each light sample; and gathering by 4 shared
 * directions. A correction has only `keys`: nothing is shared. */
typedef struct race_row {
    const char *name, *keys, *more;
} race_row;

static const race_row rows[AUR_RACE_ROWS] = {
    [AUR_RACE_PATH] = {"path", NULL, NULL},
    [AUR_RACE_SHARED] = {"gather-8-shared", "split=1,diffuse_samples=8,glossy_samples=4,light_samples=4",
                         ",edges=96,share=near"},
    [AUR_RACE_MIDDLE] = {"gather-32", "split=4,diffuse_samples=32,glossy_samples=16,light_samples=4",
                         ",edges=192"},
    [AUR_RACE_LIGHTS] = {"gather-32-lights", "split=4,diffuse_samples=32,glossy_samples=16,light_samples=16",
                         ",edges=192"},
    [AUR_RACE_LONG] = {"gather-32-long",
                       "split=4,diffuse_samples=32,glossy_samples=16,light_samples=1,short_rays=0",
                       ",edges=192"},
    [AUR_RACE_CANDIDATES] = {"path-2", "candidates=2", NULL},
    [AUR_RACE_FOUR] = {"gather-4-shared", "split=1,diffuse_samples=4,glossy_samples=4,light_samples=2",
                       ",edges=48,share=near"},
};

const char *aur_race_name(size_t row) {
    return rows[row].name;
}

static char *compose(size_t row, const char *path, size_t photons, const char *more) {
    if (rows[row].keys == NULL)
        return strdup(path);
    const char *const keys = strchr(path, ':');
    if (!aur_race_gathers(row))
        return aur_new_text("%s%s%s", path, keys != NULL ? "," : ":", rows[row].keys);
    return aur_new_text("finalgather:%s,photons=%zu%s%s%s", rows[row].keys, photons, more,
                        keys != NULL ? "," : "", keys != NULL ? keys + 1 : "");
}

char *aur_race_integrator(size_t row, const char *path, size_t photons, uint64_t seed) {
    char more[80]; /* a number and the keys */
    const int length = snprintf(more, sizeof more, "%s", rows[row].more != NULL ? rows[row].more : "");
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
