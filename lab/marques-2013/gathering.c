#include "gathering.h"

#include <stdio.h>

const marques_scene marques_scenes[MARQUES_SCENES] = {
    {"cornell-box", "cornell-box/figure.xml", "cornell-box/glossy.xml", 256, 256},
    {"room", "room/room.xml", NULL, 256, 171},
    {"cars", "parade/parade.xml", NULL, 256, 171},
};

aur_result marques_gather(const lab_run *run, aur_renderer *renderer, const marques_gathering *what,
                          aur_image **image, aur_error *error) {
    char integrator[400];
    snprintf(integrator, sizeof integrator,
             "finalgather-lab:%s,pixel=centre,density=same,rotations=0,edges=0,short_rays=0,photons=%zu,"
             "photons_per_texel=64,pattern=%.80s,map=%s,diffuse_samples=%zu,glossy_samples=%zu,"
             "pattern_seed=%zu",
             what->light, what->photons, what->pattern->set, aur_map_name(what->pattern->map), what->diffuse,
             what->glossy, what->seed);
    const lab_rendering how = {
        .renderer = renderer,
        .integrator = integrator,
        .width = what->width,
        .height = what->height,
        .crop = {what->crop[0], what->crop[1], what->crop[2], what->crop[3]},
    };
    return lab_render(run, &how, image, error);
}

aur_result marques_references(const lab_run *run, aur_renderer *renderer, const marques_gathering *like,
                              size_t directions, aur_image *references[2], aur_error *error) {
    static const marques_pattern patterns[2] = {{.set = "spherical-fibonacci", .map = AUR_MAP_LAMBERT},
                                                {.set = "sobol", .map = AUR_MAP_CONCENTRIC}};
    aur_result result = AUR_OK;
    references[0] = references[1] = NULL;
    for (size_t i = 0; i < 2 && result == AUR_OK; ++i) {
        marques_gathering what = *like;
        what.pattern = &patterns[i];
        what.diffuse = what.glossy = directions;
        what.seed = 1000 * (i + 1);
        result = marques_gather(run, renderer, &what, &references[i], error);
    }
    return result;
}
