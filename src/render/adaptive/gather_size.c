#include "render/adaptive/gather_size.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The part of final gathering's rays that is spent on its photon map. It is chosen: it costs time, never
 * truth. */
static const double MAP_PART = 0.25;
/* Tracing and sorting a photon takes the time of so many rays of path tracing: 2.4 in the Cornell box by
 * `render --stats`. Other scenes were not measured: a wrong ratio costs time, never truth. */
static const double RAYS_A_PHOTON = 2.5;
/* What sharing adds is thought to be known, from the first pattern, to be under this part of its noise: .16
 * to .26 in the public Cornell box. A first pattern that does not do costs another one: noise is planned to
 * be a little less. */
static const double SHARING = 0.2, PLAN_MARGIN = 0.92;
/* A pattern that is not shared takes so many times the directions: in the public Cornell box to 1.7 % 80 in
 * place of 45. */
static const double UNSHARED = 1.8;
/* Of the noise's square, what the places of camera rays in their pixels may have in the first pattern: of one
 * sample, and of several. It is chosen. */
static const double MOST_CAMERA_SHARED = 0.75, MOST_CAMERA = 0.5;
/* Where these have so many times the noise's square, pixels need many more samples than patterns are for: of
 * the parade to 8 % they had 88 times, and final gathering was tried in vain. */
static const double HOPELESS_CAMERA = 16.0;

enum { MOST_PHOTONS = 8000000 };
/* A pattern of few directions is a single sample's, so that each replica can be a coarse picture, and shared
 * with the neighbouring pixels. One of many is shared out among so many samples of a pixel, and not shared
 * with others: what is wrong in the map is alike in neighbours, and sharing would leave little but that. The
 * bias is looked for with few directions, for each goes on as a path. */
enum {
    PATTERN_SAMPLES = 4,
    SINGLE_DIRECTIONS = 16,
    LEAST_DIRECTIONS = 2,
    MOST_DIRECTIONS = 1024,
    DIFFERENCE_DIRECTIONS = 8
};
/* Of the picture and of what is looked for in its bias alike. With 4 in place of 2 the public Cornell box
 * took a fourth more time to 4 %, for a bias that is no smaller than that of half as many photons. */
enum { SHORT_RAYS = 2 };

bool aur_gather_is_shared(size_t directions) {
    return directions <= SINGLE_DIRECTIONS;
}

/* The noise n with n^2 + (b + sharing n)^2 the square of what is wanted, and b the map's bias. */
static double noise_planned(double wanted, double square_bias, double sharing) {
    const double b = sharing * sqrt(square_bias), square = 1.0 + sharing * sharing;
    const double rest = fmax(wanted * wanted - square_bias, 0.0);
    return PLAN_MARGIN * (sqrt(b * b + square * rest) - b) / square;
}

/* A pattern by which the replicas are thought to come to the noise without another one. Where that is wrong,
 * rounds go on with more patterns, or the first one is larger than it needs: it costs time, never truth. One
 * sample's is shared with the neighbouring pixels. */
static aur_gather_pattern pattern_for(const aur_gather_model *model, double wanted, double square_bias) {
    const double shared_noise = noise_planned(wanted, square_bias, SHARING);
    const double alone_noise = noise_planned(wanted, square_bias, 0.0);
    const aur_gather_target shared = {shared_noise * shared_noise, 1.0, 1.0, MOST_CAMERA_SHARED};
    const aur_gather_target alone = {alone_noise * alone_noise, PATTERN_SAMPLES, UNSHARED, MOST_CAMERA};
    aur_gather_pattern pattern = aur_gather_model_pattern(model, &shared);
    if (pattern.directions <= SINGLE_DIRECTIONS && model->camera <= shared.most_camera * shared.noise &&
        !model->alone) {
        pattern.directions = fmax(pattern.directions, LEAST_DIRECTIONS);
        return pattern;
    }
    pattern = aur_gather_model_pattern(model, &alone);
    pattern.directions = fmax(pattern.directions, SINGLE_DIRECTIONS + 1);
    return pattern;
}

/* Where the largest pattern does not do, more and more of them do, whose error falls as the root of their
 * number. */
double aur_gather_rays(const aur_gather_model *model, double wanted, double square_bias) {
    const aur_gather_pattern pattern = pattern_for(model, wanted, square_bias);
    const double directions = fmin(pattern.directions, MOST_DIRECTIONS);
    if (model->camera / PATTERN_SAMPLES > HOPELESS_CAMERA * wanted * wanted)
        return INFINITY;
    return pow(pattern.directions / directions, model->power) *
           (model->fixed + model->direction * directions + model->light * pattern.lights);
}

static size_t multiple_of(size_t step, double number) {
    return step * (size_t)ceil(number / (double)step);
}

aur_gather_size aur_gather_size_of(const aur_gather_model *model, double wanted, double square_bias,
                                   size_t photons, uint64_t seed) {
    const aur_gather_pattern pattern = pattern_for(model, wanted, square_bias);
    const double directions = fmin(pattern.directions, MOST_DIRECTIONS);
    const size_t step = directions <= SINGLE_DIRECTIONS ? 1 : PATTERN_SAMPLES;
    return (aur_gather_size){photons, seed, multiple_of(step, directions), multiple_of(step, pattern.lights),
                             multiple_of(step, directions * model->bright)};
}

double aur_photon_rays(double photons) {
    return RAYS_A_PHOTON * photons;
}

/* All replicas share one map: it has finer texels than four of a quarter, and what is wrong in it is bias,
 * which is looked for. */
size_t aur_gather_photons(double rays) {
    size_t photons = MOST_PHOTONS;
    while (aur_photon_rays((double)photons) > MAP_PART * rays && photons / 2 >= AUR_LEAST_PHOTONS)
        photons /= 2;
    return photons;
}

/* Glossy lobes get half of the directions: in the glossy box and the room a quarter to all of them were as
 * good for the picture. With `more` keys (",key=value"). */
static char *gather_instead(const char *path, size_t samples, aur_gather_size size, const char *more) {
    enum { CAPACITY = 256 }; /* seven numbers and the keys' names */
    const char *const keys = strchr(path, ':');
    const size_t capacity = CAPACITY + strlen(more) + (keys != NULL ? strlen(keys) : 0);
    char *const text = malloc(capacity);
    char bright[48] = ""; /* a number and the key */
    if (size.bright > 0)
        snprintf(bright, sizeof bright, ",bright_samples=%zu", size.bright);
    if (text != NULL)
        snprintf(text, capacity,
                 "finalgather:split=%zu,diffuse_samples=%zu,glossy_samples=%zu,light_samples=%zu%s,"
                 "photons=%zu,photon_seed=%" PRIu64 "%s%s%s",
                 samples, size.directions, multiple_of(samples, 0.5 * (double)size.directions),
                 size.lights / samples, bright, size.photons, size.seed, more, keys != NULL ? "," : "",
                 keys != NULL ? keys + 1 : "");
    return text;
}

/* Found by trial in two boxes, two scenes of Keller's and two more, with a box filter and with a gaussian: of
 * 8, 12, 16 and 32 a direction 12 and 16 take the least time in the Cornell box, and 8 and 12 in the others.
 * Where nothing is shared half of them do. */
static size_t edges_of(size_t directions) {
    return (aur_gather_is_shared(directions) ? 12 : 6) * directions;
}

char *aur_adaptive_gather(const char *path, aur_gather_size size) {
    const bool shared = aur_gather_is_shared(size.directions);
    char more[64]; /* two numbers and the keys */
    snprintf(more, sizeof more, ",edges=%zu,short_rays=%d%s", edges_of(size.directions), SHORT_RAYS,
             shared ? ",share=near" : "");
    return gather_instead(path, shared ? 1 : PATTERN_SAMPLES, size, more);
}

char *aur_adaptive_gather_pilot(const char *path, uint64_t seed, aur_pilot_kind kind) {
    char more[96]; /* a number and the keys */
    /* Coarse pixels see more edges. With four times as many the noise that is left is told too small. */
    snprintf(more, sizeof more, ",short_rays=0,edges=%zu,share=near%s", 2 * edges_of(AUR_PILOT_DIRECTIONS),
             kind.centre ? ",pixel=centre" : "");
    const aur_gather_size size = {AUR_PILOT_PHOTONS, seed, AUR_PILOT_DIRECTIONS, kind.lights, kind.bright};
    return gather_instead(path, 1, size, more);
}

char *aur_adaptive_gather_difference(const char *path, size_t photons, uint64_t seed) {
    char more[96]; /* a number and the keys */
    snprintf(more, sizeof more, ",short_rays=%d,pixel=centre,debias=only,continued=1", SHORT_RAYS);
    const aur_gather_size size = {photons, seed, DIFFERENCE_DIRECTIONS, PATTERN_SAMPLES, 0};
    return gather_instead(path, PATTERN_SAMPLES, size, more);
}
