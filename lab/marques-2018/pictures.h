/* What the experiments on weights in rendered pictures share: a scene that is gathered on the same photon map
 * and the same primary hits by any weights, and errors over the pixels whose surface has both a diffuse and a
 * glossy lobe: elsewhere the ways to weigh hardly differ. */
#ifndef LAB_MARQUES_2018_PICTURES_H
#define LAB_MARQUES_2018_PICTURES_H

#include "program/lab/lab.h"

/* The bundled studio, seen from the scenes' folders: four soft boxes without a spike, as the paper's probes
 * are. */
#define LAB_STUDIO "../generated/studio.exr"

typedef struct lab_gather {
    lab_run *run;
    const char *light; /* keys of finalgather: what gather rays see */
    size_t side, photons;
    size_t reference_directions; /* a lobe */
    lab_stage stage;
    aur_image *reference, *mask; /* made when they are first needed */
    double seconds;              /* of the processor, for the last picture */
} lab_gather;

/* `environment` NULL: the scene's own. Without meshes for the scene there is no renderer, and AUR_OK. */
aur_result lab_gather_open(lab_gather *gather, const char *file, const char *environment, aur_error *error);
/* The same of a scene with any definitions. */
aur_result lab_gather_open_defined(lab_gather *gather, const char *file, size_t definition_count,
                                   const aur_definition *definitions, aur_error *error);
void lab_gather_close(lab_gather *gather);

/* A picture with directions[0] diffuse and directions[1] glossy samples; `keys` say how they are weighed. */
aur_result lab_gather_render(lab_gather *gather, const char *set, const char *keys,
                             const size_t directions[2], size_t seed, aur_image **image, aur_error *error);
aur_result lab_gather_need_reference(lab_gather *gather, aur_error *error);
/* Mean square errors over the pixels with both lobes, and over the picture. */
void lab_gather_judge(const lab_gather *gather, const aur_image *image, double *both, double *all);

/* The RMSE over that of a base for one more set of points: the interval that holds it with probability .95
 * when logarithms of ratios are normal. The paper has one set for all shading points and images, so its
 * figures are of one set each. */
lab_interval lab_gather_one_set(size_t count, const double *squares, const double *base);

#endif
