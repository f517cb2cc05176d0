/* Shared by the experiments on weights in rendered images: a scene gathered on the same photon map and the
 * same primary hits with any weights, and errors over the pixels whose surface has both a diffuse and a
 * glossy lobe. Elsewhere the weighting methods hardly differ. */
#ifndef LAB_MARQUES_2018_IMAGES_H
#define LAB_MARQUES_2018_IMAGES_H

#include "program/lab/lab.h"

/* The bundled studio, as a path relative to the scenes' folders: four soft boxes without a sharp peak, like
 * the paper's probes. */
#define LAB_STUDIO "../generated/studio.exr"

typedef struct lab_gather {
    lab_run *run;
    const char *light; /* parameters of finalgather: light that gather rays see */
    size_t side, photons;
    size_t reference_directions; /* per lobe */
    lab_stage stage;
    aur_image *reference, *mask; /* rendered on first use */
    double seconds;              /* processor seconds of the last image */
} lab_gather;

/* `environment` NULL: the scene's. If the scene's meshes have not been generated there is no renderer, and
 * AUR_OK is returned. */
aur_result lab_gather_open(lab_gather *gather, const char *file, const char *environment, aur_error *error);
/* The same for a scene with any definitions. */
aur_result lab_gather_open_defined(lab_gather *gather, const char *file, size_t definition_count,
                                   const aur_definition *definitions, aur_error *error);
void lab_gather_close(lab_gather *gather);

/* An image with directions[0] diffuse and directions[1] glossy samples; `keys` select their weights. */
aur_result lab_gather_render(lab_gather *gather, const char *set, const char *keys,
                             const size_t directions[2], size_t seed, aur_image **image, aur_error *error);
aur_result lab_gather_need_reference(lab_gather *gather, aur_error *error);
/* Mean square errors over the pixels with both lobes, and over the image. */
void lab_gather_judge(const lab_gather *gather, const aur_image *image, double *both, double *all);

/* The RMSE relative to that of a base for one further point set: its prediction interval of probability .95
 * if logarithms of ratios are normal. The paper uses one set for all shading points and images, so its
 * figures are for one set each. */
lab_interval lab_gather_one_set(size_t count, const double *squares, const double *base);

#endif
