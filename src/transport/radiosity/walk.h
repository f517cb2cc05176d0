/* The random walk of all triangles at once (Keller 1994, eq. 15): path i leaves a light and flies M + 1
 * times, each decision by two coordinates of point i; every triangle that it meets receives its power. */
#pragma once

#include <aureole/radiosity.h>

#include "scene/distribution.h"
#include "transport/radiosity/scene.h"
#include "transport/radiosity/tally.h"

typedef struct aur_radiosity_walk {
    const aur_radiosity_scene *scene;
    aur_radiosity_directions directions;
    size_t bounces;
    uint64_t seed; /* of choices at glass */
    size_t light_count;
    uint32_t *lights;   /* triangles, in the order of the choice */
    double (*start)[3]; /* light -> power of one path that leaves it, in quanta, for a path alone */
    aur_distribution choice;
    double quantum; /* watts: the unit of the sums */
} aur_radiosity_walk;

aur_result aur_radiosity_walk_create(const aur_radiosity_scene *scene, const aur_radiosity_options *options,
                                     aur_radiosity_walk *walk, aur_error *error);
void aur_radiosity_walk_release(aur_radiosity_walk *walk);

enum { AUR_RADIOSITY_BLOCK = 512 };

/* Walks by the points first .. first + count - 1, count <= AUR_RADIOSITY_BLOCK. `key` tells randomisations
 * apart. */
void aur_radiosity_walk_block(const aur_radiosity_walk *walk, const aur_pointset *set, uint64_t key,
                              uint64_t first, size_t count, aur_radiosity_tally *tally);
