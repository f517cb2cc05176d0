#include "ask/gather_size.h"

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
/* A ray to a point on a light takes about so much of the time of the others, with what is shaded for them:
 * .5 in the public Cornell box and in the room. */
static const double LIGHT_PRICE = 0.5;
/* With points on bright texels, which rays do not tell: their draws, which took 15 % of the time and 5 % of
 * the rays in the public Cornell box, and more where triangles are small. */
static const double BRIGHT_PRICE = 1.1;
/* What sharing adds is thought to be known, from the first pattern, to be under this part of its noise: .16
 * to .26 in the public Cornell box. A first pattern that does not do costs another one: noise is planned to
 * be a little less. */
static const double SHARING = 0.2, PLAN_MARGIN = 0.92;
/* A pattern that is not shared takes so many times the directions: in the public Cornell box to 1.7 % 80 in
 * place of 45. */
static const double UNSHARED = 1.8;
/* The square of a pattern's error falls nearly as its size to this power: patterns of 4 to 160 directions had
 * .8 to 1.2 of the noise that might be left, in boxes, the room, the cube and the office, and .5 in a room
 * behind blinds (with 32 rays at edges a direction). And so does what points on lights have of it as these
 * grow alone (8 to 128 of them in the room). */
static const double POWER = 1.5;

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
    MOST_LIGHTS = 32, /* a direction of the pilot's */
    DIFFERENCE_DIRECTIONS = 8
};
/* Of the picture and of what is looked for in its bias alike. With 4 in place of 2 the public Cornell box
 * took a fourth more time to 4 %, for a bias that is no smaller than that of half as many photons. */
enum { SHORT_RAYS = 2 };

bool aur_gather_is_shared(size_t directions) {
    return directions <= SINGLE_DIRECTIONS;
}

/* What a pattern takes to an error, by the power that its error follows. */
static double cost_of(const aur_gather_pattern *pattern) {
    return pattern->growing * pow(pattern->error, 2.0 / POWER);
}

/* With the square of the error a + b lights^-POWER. */
aur_gather_pattern aur_gather_pattern_of(aur_pilot_outcome few, aur_pilot_outcome more) {
    const double lights = AUR_PILOT_LIGHTS_MORE;
    const double before = few.error * few.error, after = more.error * more.error;
    const double b = fmax(before - after, 0.0) / (1.0 - pow(lights, -POWER));
    const double a = fmax(before - b, 0.05 * after);
    const double price = fmax(more.rays - few.rays, 0.0) / (lights - AUR_PILOT_LIGHTS);
    const double others = fmax(few.rays - AUR_PILOT_LIGHTS * price, 0.0);
    aur_gather_pattern best = {.error = INFINITY, .growing = 1.0};
    for (double l = AUR_PILOT_LIGHTS; l <= MOST_LIGHTS; l *= 2.0) {
        /* Rays at edges are in none of these. The parts are chosen: together they are what the pilot's
         * own pattern takes, to which the camera's rays and those of mirrors come once. */
        const aur_gather_pattern pattern = {.lights = l,
                                            .error = sqrt(a + b * pow(l, -POWER)),
                                            .fixed = 0.2 * others,
                                            .growing = 0.8 * others + LIGHT_PRICE * l * price};
        if (cost_of(&pattern) < cost_of(&best))
            best = pattern;
    }
    return best;
}

/* Bright texels change the square as much with few points on lights as with more. Pilots see less of it than
 * whole pictures, which have fewer edges: they left .88 of the error in the public Cornell box and .92 in the
 * room, whole pictures with 64 directions .64 and .76. So the choice goes by about the square of what is
 * seen; how many directions it takes does not, which would often be too few. */
aur_gather_pattern aur_gather_pattern_best(aur_pilot_outcome few, aur_pilot_outcome more,
                                           aur_pilot_outcome bright) {
    const double square = few.error * few.error - more.error * more.error + bright.error * bright.error;
    const aur_pilot_outcome few_bright = {sqrt(fmax(square, 0.0)), few.rays - more.rays + bright.rays};
    const aur_gather_pattern plain = aur_gather_pattern_of(few, more);
    aur_gather_pattern drawn = aur_gather_pattern_of(few_bright, bright);
    drawn.bright = AUR_PILOT_BRIGHT;
    const double unseen = pow(fmin(bright.error / more.error, 1.0), 2.0 / POWER);
    return BRIGHT_PRICE * unseen * cost_of(&drawn) < cost_of(&plain) ? drawn : plain;
}

/* The noise n with n^2 + (b + sharing n)^2 the square of what is wanted, and b the map's bias. */
static double noise_planned(double wanted, double square_bias, double sharing) {
    const double b = sharing * sqrt(square_bias), square = 1.0 + sharing * sharing;
    const double rest = fmax(wanted * wanted - square_bias, 0.0);
    return PLAN_MARGIN * (sqrt(b * b + square * rest) - b) / square;
}

/* Directions of a pattern by which the replicas are thought to come to the noise without another one. Where
 * that is wrong, rounds go on with more patterns, or the first one has more directions than it needs: it
 * costs time, never truth. */
static double directions_to_noise(const aur_gather_pattern *pattern, double noise) {
    const double part = pattern->error / noise;
    return AUR_PILOT_DIRECTIONS * pow(part * part, 1.0 / POWER);
}

static double directions_wanted(const aur_gather_pattern *pattern, double wanted, double square_bias) {
    const double shared = directions_to_noise(pattern, noise_planned(wanted, square_bias, SHARING));
    if (shared <= SINGLE_DIRECTIONS)
        return shared;
    const double alone = directions_to_noise(pattern, noise_planned(wanted, square_bias, 0.0));
    return fmax(UNSHARED * alone, SINGLE_DIRECTIONS + 1);
}

static double directions_of(double wanted) {
    return fmin(fmax(wanted, LEAST_DIRECTIONS), MOST_DIRECTIONS);
}

/* Where the largest pattern does not do, more and more of them do, whose error falls as the root of their
 * number. */
double aur_gather_rays(const aur_gather_pattern *pattern, double wanted, double square_bias) {
    const double directions = directions_wanted(pattern, wanted, square_bias);
    const double beyond = fmax(directions / MOST_DIRECTIONS, 1.0);
    return pow(beyond, POWER) *
           (pattern->fixed + pattern->growing * directions_of(directions) / AUR_PILOT_DIRECTIONS);
}

static size_t multiple_of(size_t step, double number) {
    return step * (size_t)ceil(number / (double)step);
}

aur_gather_size aur_gather_size_of(const aur_gather_pattern *pattern, double wanted, double square_bias,
                                   size_t photons, uint64_t seed) {
    const double directions = directions_of(directions_wanted(pattern, wanted, square_bias));
    const size_t step = directions <= SINGLE_DIRECTIONS ? 1 : PATTERN_SAMPLES;
    const double lights = directions * pattern->lights / AUR_PILOT_DIRECTIONS;
    const double bright = directions * pattern->bright / AUR_PILOT_DIRECTIONS;
    return (aur_gather_size){photons, seed, multiple_of(step, directions),
                             multiple_of(step, fmax(floor(lights), 1.0)), multiple_of(step, bright)};
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

char *aur_ask_gather(const char *path, aur_gather_size size) {
    const bool shared = aur_gather_is_shared(size.directions);
    char more[64]; /* two numbers and the keys */
    snprintf(more, sizeof more, ",edges=%zu,short_rays=%d%s", edges_of(size.directions), SHORT_RAYS,
             shared ? ",share=near" : "");
    return gather_instead(path, shared ? 1 : PATTERN_SAMPLES, size, more);
}

char *aur_ask_gather_pilot(const char *path, uint64_t seed, size_t lights, size_t bright) {
    char more[64]; /* a number and the keys */
    /* Coarse pixels see more edges. With four times as many the noise that is left is told too small. */
    snprintf(more, sizeof more, ",short_rays=0,edges=%zu,share=near", 2 * edges_of(AUR_PILOT_DIRECTIONS));
    const aur_gather_size size = {AUR_PILOT_PHOTONS, seed, AUR_PILOT_DIRECTIONS, lights, bright};
    return gather_instead(path, 1, size, more);
}

char *aur_ask_gather_difference(const char *path, size_t photons, uint64_t seed) {
    char more[96]; /* a number and the keys */
    snprintf(more, sizeof more, ",short_rays=%d,pixel=centre,debias=true,continued=1,incident=correction",
             SHORT_RAYS);
    const aur_gather_size size = {photons, seed, DIFFERENCE_DIRECTIONS, PATTERN_SAMPLES, 0};
    return gather_instead(path, PATTERN_SAMPLES, size, more);
}
