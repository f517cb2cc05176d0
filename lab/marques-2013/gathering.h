/* One component of the indirect light by the patterns of Marques 2013, and the mean square errors of such
 * images. */
#ifndef LAB_MARQUES_2013_GATHERING_H
#define LAB_MARQUES_2013_GATHERING_H

#include "patterns.h"

enum { MARQUES_SCENES = 3 };

typedef struct marques_scene {
    const char *name, *file;
    const char *quick_file; /* needs no generated meshes; NULL: the quick form omits the scene */
    size_t width, height;   /* aspect ratio of its images, 256 pixels wide */
} marques_scene;

extern const marques_scene marques_scenes[MARQUES_SCENES];

typedef struct marques_gathering {
    const marques_pattern *pattern;
    const char *light;      /* parameters that select the gathered light: "direct=none,component=glossy" */
    size_t diffuse, glossy; /* directions per pixel */
    size_t photons;
    size_t seed;                   /* of the pattern, which is randomised independently at every pixel */
    size_t width, height, crop[4]; /* as in lab_rendering */
} marques_gathering;

/* Pixel centres, so that all images see the same points. */
aur_result marques_gather(const lab_run *run, aur_renderer *renderer, const marques_gathering *what,
                          aur_image **image, aur_error *error);

/* Two references with `directions` of both kinds: spherical Fibonacci and Sobol, so that neither set is
 * favoured. The caller destroys both, also after an error. */
aur_result marques_references(const lab_run *run, aur_renderer *renderer, const marques_gathering *like,
                              size_t directions, aur_image *references[2], aur_error *error);

#endif
