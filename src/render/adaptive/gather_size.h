/* How large final gathering is to be that comes to an error in one pattern, as pilots of few pixels tell. */
#pragma once

#include "render/adaptive/gather_model.h"

/* What final gathering is told: photons of the map that all replicas share, the seed of these, directions of
 * a pattern for diffuse light, and the pattern's points on lights and on bright texels. */
typedef struct aur_gather_size {
    size_t photons;
    uint64_t seed;
    size_t directions, lights, bright;
} aur_gather_size;

/* Rays of a pixel, all replicas together (infinite where pixels need many more samples than patterns are
 * for), and the size of the pattern, by which noise and a bias whose square is told come to the error wanted.
 */
double aur_gather_rays(const aur_gather_model *model, double wanted, double square_bias);
aur_gather_size aur_gather_size_of(const aur_gather_model *model, double wanted, double square_bias,
                                   size_t photons, uint64_t seed);
/* Photons of a map that costs little beside a picture of so many rays, or that is small: what is wrong in a
 * smaller one is seen in small pictures, as it is alike in neighbours. */
enum { AUR_LEAST_PHOTONS = 125000 };
size_t aur_gather_photons(double rays);
/* The rays that so many photons are worth. */
double aur_photon_rays(double photons);

/* Whether a pattern is one sample's, and shared with the neighbouring pixels. */
bool aur_gather_is_shared(size_t directions);

/* Final gathering in place of "path[:key=value...]", with these keys. A new text, or NULL where memory is
 * short: */
/* for a picture, */
char *aur_adaptive_gather(const char *path, aur_gather_size size);
/* for a pilot, */
typedef struct aur_pilot_kind {
    size_t lights, bright;
    bool centre; /* camera rays through the centres of pixels */
} aur_pilot_kind;
char *aur_adaptive_gather_pilot(const char *path, uint64_t seed, aur_pilot_kind kind);
/* and for what its map is wrong by. */
char *aur_adaptive_gather_difference(const char *path, size_t photons, uint64_t seed);
