#include "render/adaptive/race.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Tracing and sorting a photon takes the time of so many rays. */
static const double RAYS_PER_PHOTON = 2.5;
enum { LEAST_PHOTONS = 50000, MOST_PHOTONS = 2000000 }; /* of a replica's map */

/* Path tracing; final gathering by 8 directions that neighbours share; by 32, with 4 and with 16 points on
 * lights; and without short rays. A correction has `keys` alone: nothing is shared there. */
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
};

const char *aur_race_name(size_t row) {
    return rows[row].name;
}

static char *compose(size_t row, const char *path, size_t photons, const char *more) {
    enum { CAPACITY = 320 }; /* the keys and their numbers */
    const char *const keys = strchr(path, ':');
    const size_t capacity = CAPACITY + strlen(path);
    char *const text = malloc(capacity);
    if (text != NULL && rows[row].keys == NULL)
        snprintf(text, capacity, "%s", path);
    else if (text != NULL)
        snprintf(text, capacity, "finalgather:%s,photons=%zu%s%s%s", rows[row].keys, photons, more,
                 keys != NULL ? "," : "", keys != NULL ? keys + 1 : "");
    return text;
}

char *aur_race_integrator(size_t row, const char *path, size_t photons, uint64_t seed) {
    char more[80]; /* a number and the keys */
    const char *const own = rows[row].more != NULL ? rows[row].more : "";
    if (seed > 0)
        snprintf(more, sizeof more, "%s,photon_seed=%" PRIu64, own, seed);
    else
        snprintf(more, sizeof more, "%s", own);
    return compose(row, path, photons, more);
}

char *aur_race_correction(size_t row, const char *path, size_t photons) {
    return row == AUR_RACE_PATH ? NULL : compose(row, path, photons, ",debias=found,continued=1");
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

size_t aur_race_blocks(size_t width, size_t height, size_t count, size_t **order) {
    const size_t columns = (width + AUR_RACE_BLOCK - 1) / AUR_RACE_BLOCK;
    const size_t rows_of_blocks = (height + AUR_RACE_BLOCK - 1) / AUR_RACE_BLOCK,
                 all = columns * rows_of_blocks;
    const size_t wanted = count < all ? count : all;
    const double g = 1.32471795724474602596; /* of the plane's R2 sequence (Roberts 2018) */
    bool *const taken = calloc(all, sizeof *taken);
    *order = calloc(wanted, sizeof **order);
    if (taken == NULL || *order == NULL) {
        free(taken);
        free(*order);
        *order = NULL;
        return 0;
    }
    size_t found = 0;
    for (size_t i = 0; i < 64 * all && found < wanted; ++i) {
        const double x = fmod(0.5 + (double)i / g, 1.0), y = fmod(0.5 + (double)i / (g * g), 1.0);
        const size_t block = (size_t)(y * (double)rows_of_blocks) * columns + (size_t)(x * (double)columns);
        if (!taken[block])
            (*order)[found++] = block;
        taken[block] = true;
    }
    for (size_t block = 0; block < all && found < wanted; ++block)
        if (!taken[block])
            (*order)[found++] = block;
    free(taken);
    return wanted;
}

size_t aur_race_pixels(size_t width, size_t height, size_t block,
                       size_t pixels[AUR_RACE_BLOCK * AUR_RACE_BLOCK]) {
    const size_t columns = (width + AUR_RACE_BLOCK - 1) / AUR_RACE_BLOCK;
    const size_t x0 = block % columns * AUR_RACE_BLOCK, y0 = block / columns * AUR_RACE_BLOCK;
    size_t count = 0;
    for (size_t y = y0; y < y0 + AUR_RACE_BLOCK && y < height; ++y)
        for (size_t x = x0; x < x0 + AUR_RACE_BLOCK && x < width; ++x)
            pixels[count++] = y * width + x;
    return count;
}
