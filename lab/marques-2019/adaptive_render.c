/* Renders adaptive gathers, and measures their directions and errors. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "adaptive.h"
#include "program/lab/points.h"

aur_result adaptive_render(const adaptive_study *study, const adaptive_way *way, size_t seed,
                           bool whole_image, aur_image **image, aur_error *error) {
    char integrator[600], how[360];
    const size_t first = study->lobe->first * (way->criterion == NULL ? way->factor : 1);
    if (way->criterion != NULL)
        snprintf(how, sizeof how,
                 "adaptive=true,criterion=%s,threshold=%.17g,level_factor=%zu,levels=%zu,scramble=rotate,"
                 "pattern=(%.160s)",
                 way->criterion, way->threshold, way->factor, way->levels,
                 way->pattern != NULL ? way->pattern : "spherical-fibonacci");
    else
        snprintf(how, sizeof how, "pattern=%s", way->pattern != NULL ? way->pattern : "spherical-fibonacci");
    snprintf(
        integrator, sizeof integrator,
        "finalgather-lab:component=%s,direct=none,pixel=centre,edges=0,short_rays=0,density=same,weights="
        "equal,rotations="
        "0,photons=%zu,photons_per_texel=64,diffuse_samples=%zu,glossy_samples=%zu,pattern_seed=%zu,%s",
        study->lobe->name, study->photons, first, first, seed, how);
    const size_t side = whole_image ? study->image_side : study->side;
    return lab_render(
        study->run,
        &(lab_rendering){
            .renderer = study->stage.renderer, .integrator = integrator, .width = side, .height = side},
        image, error);
}

void adaptive_count(const adaptive_study *study, const adaptive_way *way, const aur_image *image,
                    adaptive_counts *counts) {
    const size_t channels = aur_image_channel_count(image), at = aur_image_find_channel(image, "directions");
    const size_t pixels = aur_image_width(image) * aur_image_height(image);
    const float *const data = aur_image_data(image);
    size_t point_count = 0;
    *counts = (adaptive_counts){0};
    for (size_t i = 0; i < pixels && at != SIZE_MAX; ++i) {
        const double directions = (double)data[i * channels + at];
        if (directions < 1.0) /* no pixel gathers */
            continue;
        ++point_count;
        counts->mean += directions;
        double end = (double)study->lobe->first;
        for (size_t l = 0; l < 3; ++l, end *= (double)way->factor)
            counts->shares[l] += directions == end;
    }
    const double all = fmax(1.0, (double)point_count);
    counts->mean /= all;
    for (size_t l = 0; l < 3; ++l)
        counts->shares[l] /= all;
}

const char *adaptive_pattern(const adaptive_way *way) {
    return way->pattern != NULL ? way->pattern : way->criterion != NULL ? "esfg" : "spherical-fibonacci";
}

static aur_result need_reference(adaptive_study *study, aur_error *error) {
    static const char *const patterns[] = {"spherical-fibonacci", "sobol"};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < 2 && study->reference_images[i] == NULL && result == AUR_OK; ++i) {
        const adaptive_way fine = {.factor = study->references / study->lobe->first, .pattern = patterns[i]};
        result = adaptive_render(study, &fine, 1000 * (i + 1), false, &study->reference_images[i], error);
    }
    return result;
}

/* The mean square error and the directions of each seed. */
static aur_result measure(adaptive_study *study, const adaptive_way *way, adaptive_found *found,
                          aur_error *error) {
    char key[300];
    double values[5 * ADAPTIVE_SEEDS];
    snprintf(key, sizeof key, "%s %s %zu %zu %.6g %.160s", study->lobe->name,
             way->criterion != NULL ? way->criterion : "one size", way->factor, way->levels, way->threshold,
             adaptive_pattern(way));
    if (!lab_recall(study->run, key, 5 * study->seeds, values)) {
        aur_result result = need_reference(study, error);
        for (size_t k = 0; k < study->seeds && result == AUR_OK; ++k) {
            aur_image *image = NULL, *colour = NULL;
            adaptive_counts counts;
            result = adaptive_render(study, way, 1 + k, false, &image, error);
            if (result == AUR_OK)
                result = aur_image_select(image, 3, (const char *const[]){"R", "G", "B"}, &colour, error);
            if (result == AUR_OK) {
                adaptive_count(study, way, image, &counts);
                values[5 * k] =
                    lab_mean_product(colour, study->reference_images[0], study->reference_images[1]);
                values[5 * k + 1] = counts.mean;
                memcpy(&values[5 * k + 2], counts.shares, sizeof counts.shares);
            }
            aur_image_destroy(image);
            aur_image_destroy(colour);
        }
        if (result == AUR_OK)
            result = lab_save(study->run, key, 5 * study->seeds, values, error);
        if (result != AUR_OK)
            return result;
    }
    for (size_t k = 0; k < study->seeds; ++k) {
        found->mse[k] = values[5 * k];
        found->mean[k] = values[5 * k + 1];
        for (size_t l = 0; l < 3; ++l)
            found->shares[l][k] = values[5 * k + 2 + l];
    }
    return AUR_OK;
}

static aur_result need_fixed(adaptive_study *study, aur_error *error) {
    for (size_t i = 0; i < ADAPTIVE_FIXED && study->fixed[i] == 0.0; ++i) {
        const adaptive_way way = {.factor = (size_t)1 << i};
        adaptive_found found;
        double unused;
        const aur_result result = measure(study, &way, &found, error);
        if (result != AUR_OK)
            return result;
        lab_mean_interval(study->seeds, found.mse, &study->fixed[i], &unused);
    }
    return AUR_OK;
}

/* The logarithm of the number of directions of constant size for a mean square error, by piecewise linear
 * interpolation of logarithms. */
static double log_directions(const adaptive_study *study, double mse) {
    size_t i = 0;
    while (i + 2 < ADAPTIVE_FIXED && mse < study->fixed[i + 1])
        ++i;
    const double share = log(mse / study->fixed[i]) / log(study->fixed[i + 1] / study->fixed[i]);
    return log((double)study->lobe->first) + ((double)i + share) * log(2.0);
}

aur_result adaptive_measure(adaptive_study *study, const adaptive_way *way, adaptive_found *found,
                            aur_error *error) {
    aur_result result = need_fixed(study, error);
    if (result == AUR_OK)
        result = measure(study, way, found, error);
    for (size_t k = 0; k < study->seeds && result == AUR_OK; ++k)
        found->log_rays[k] = log(found->mean[k]) - log_directions(study, found->mse[k]);
    return result;
}

/* The level of each pixel by colour, black if there is nothing to gather. */
static aur_result draw_map(const adaptive_study *study, const adaptive_way *way, const aur_image *image,
                           aur_error *error) {
    static const float nothing[3] = {0.0f, 0.0f, 0.0f};
    static const size_t colours[3] = {0, 2, 1}; /* blue, green, red, as in the paper */
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t channels = aur_image_channel_count(image), at = aur_image_find_channel(image, "directions");
    aur_image *map;
    aur_result result = aur_image_create(width, height, 3, &map, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < width * height; ++i) {
        const double directions = (double)aur_image_data(image)[i * channels + at];
        size_t level = 0;
        for (double end = (double)study->lobe->first; directions > end && level < 2;
             end *= (double)way->factor)
            ++level;
        memcpy(aur_image_data(map) + 3 * i, directions < 1.0 ? nothing : lab_colour(colours[level]),
               sizeof nothing);
    }
    char view[64];
    snprintf(view, sizeof view, "sampling map, %s", study->lobe->name);
    result = lab_image(study->run, &(lab_image_position){.view = view, .name = way->criterion}, map, error);
    aur_image_destroy(map);
    return result;
}

static aur_result draw_one(const adaptive_study *study, const adaptive_way *way, const char *name,
                           bool reference, aur_error *error) {
    aur_image *image = NULL;
    aur_result result = adaptive_render(study, way, 1, true, &image, error);
    if (result == AUR_OK && way->criterion != NULL)
        result = draw_map(study, way, image, error);
    const lab_image_position position = {
        .view = study->lobe->name, .name = name, .reference = reference, .exposure = 1.0};
    if (result == AUR_OK)
        result = lab_image(study->run, &position, image, error);
    aur_image_destroy(image);
    return result;
}

aur_result adaptive_draw(const adaptive_study *study, const adaptive_way *way, aur_error *error) {
    const adaptive_way first = {.factor = 1}, last = {.factor = 16}, fine = {.factor = 32};
    char key[64];
    double drawn;
    snprintf(key, sizeof key, "pictures %s %s", study->lobe->name, way->criterion);
    if (study->image_side == 0 || lab_recall(study->run, key, 1, &drawn))
        return AUR_OK;
    aur_result result = draw_one(study, way, way->criterion, false, error);
    const bool more = strcmp(way->criterion, "entropy") == 0; /* the others have one image */
    if (result == AUR_OK && more)
        result = draw_one(study, &first, "level 1 everywhere", false, error);
    if (result == AUR_OK && more)
        result = draw_one(study, &last, "level 3 everywhere", false, error);
    if (result == AUR_OK && more)
        result = draw_one(study, &fine, "reference", true, error);
    return result != AUR_OK ? result : lab_save(study->run, key, 1, (const double[]){1.0}, error);
}

void adaptive_release(adaptive_study *study) {
    for (size_t i = 0; i < 2; ++i) {
        aur_image_destroy(study->reference_images[i]);
        study->reference_images[i] = NULL;
    }
    memset(study->fixed, 0, sizeof study->fixed);
}
