#include "images.h"

#include <aureole/statistics.h>
#include <math.h>
#include <stdio.h>
#include <time.h>

aur_result lab_gather_open(lab_gather *gather, const char *file, const char *environment, aur_error *error) {
    const aur_definition definition = {"environment", environment};
    return lab_gather_open_defined(gather, file, environment != NULL ? 1 : 0, &definition, error);
}

aur_result lab_gather_open_defined(lab_gather *gather, const char *file, size_t definition_count,
                                   const aur_definition *definitions, aur_error *error) {
    return lab_stage_open(gather->run, file, definition_count, definitions, &gather->stage, error);
}

void lab_gather_close(lab_gather *gather) {
    aur_image_destroy(gather->reference);
    aur_image_destroy(gather->mask);
    lab_stage_close(&gather->stage);
    gather->reference = gather->mask = NULL;
}

aur_result lab_gather_render(lab_gather *gather, const char *set, const char *keys,
                             const size_t directions[2], size_t seed, aur_image **image, aur_error *error) {
    char integrator[400];
    snprintf(
        integrator, sizeof integrator,
        "finalgather-lab:%s,pixel=centre,edges=0,short_rays=0,decorrelation=random,photons=%zu,pattern=%s,"
        "diffuse_samples=%zu,"
        "glossy_samples=%zu,pattern_seed=%zu,%s",
        gather->light, gather->photons, set, directions[0], directions[1], seed, keys);
    const lab_rendering how = {.renderer = gather->stage.renderer,
                               .integrator = integrator,
                               .width = gather->side,
                               .height = gather->side};
    const clock_t begin = clock();
    const aur_result result = lab_render(gather->run, &how, image, error);
    gather->seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    return result;
}

aur_result lab_gather_need_reference(lab_gather *gather, aur_error *error) {
    if (gather->mask != NULL)
        return AUR_OK;
    const size_t many[2] = {gather->reference_directions, gather->reference_directions}, few[2] = {64, 64};
    const char *const set = "spherical-fibonacci";
    const aur_result result = lab_gather_render(gather, set, "density=same,rotations=0,clip=false", many, 0,
                                                &gather->reference, error);
    return result != AUR_OK
               ? result
               : lab_gather_render(gather, set, "component=glossy,clip=false", few, 0, &gather->mask, error);
}

static double value_at(const aur_image *image, size_t pixel, size_t channel) {
    return (double)aur_image_data(image)[pixel * aur_image_channel_count(image) + channel];
}

void lab_gather_judge(const lab_gather *gather, const aur_image *image, double *both, double *all) {
    const aur_image *const reference = gather->reference;
    const size_t pixels = aur_image_width(reference) * aur_image_height(reference);
    double sums[2] = {0.0, 0.0};
    size_t marked = 0;
    for (size_t i = 0; i < pixels; ++i) {
        double square = 0.0;
        bool glossy = false;
        for (size_t c = 0; c < 3; ++c) {
            const double off = value_at(image, i, c) - value_at(reference, i, c);
            square += off * off / 3.0;
            glossy = glossy || value_at(gather->mask, i, c) > 0.0;
        }
        sums[0] += glossy ? square : 0.0;
        sums[1] += square;
        marked += glossy;
    }
    *both = marked > 0 ? sums[0] / (double)marked : 0.0;
    *all = sums[1] / (double)pixels;
}

lab_interval lab_gather_one_set(size_t count, const double *squares, const double *base) {
    aur_moments logs = {0};
    for (size_t k = 0; k < count; ++k)
        aur_moments_add(&logs, 0.5 * log(squares[k] / base[k]));
    if (squares == base || count < 2)
        return (lab_interval){exp(logs.mean), exp(logs.mean), exp(logs.mean)};
    const double half = aur_student_quantile(count - 1, 0.975) *
                        sqrt(aur_moments_variance(&logs) * (1.0 + 1.0 / (double)count));
    return (lab_interval){exp(logs.mean), exp(logs.mean - half), exp(logs.mean + half)};
}
