#pragma once

#include "transport/radiosity/scene.h"

/* Pairs of triangles that lie in one plane and overlap. Beyond a number that nobody looks at one by one they
 * are no longer sought: many copies of one triangle would take the square of their number. */
enum { AUR_RADIOSITY_MOST_COINCIDENCES = 1 << 20 };
typedef struct aur_radiosity_coincidence {
    uint64_t pairs;
    uint64_t compared;     /* pairs of boxes, of nodes and of triangles: what the search took */
    uint32_t triangles[2]; /* the first pair */
} aur_radiosity_coincidence;
aur_result aur_radiosity_find_coincidences(const aur_radiosity_scene *scene, aur_radiosity_coincidence *found,
                                           aur_error *error);
