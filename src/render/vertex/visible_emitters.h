/* Lamps that the camera sees directly. A small bright one may be met by none of a pixel's first samples, and
 * replicas that all miss it agree: so it is looked for from the other end, by points on the lamps. */
#pragma once

#include "render/film/film.h"
#include "render/film/integrator.h"
#include "render/scene/scene.h"

/* Of one sample of a pixel, uniform in it: [pixels of the film] each. NULL where the camera is no pinhole. */
typedef struct aur_visible_emitters {
    double *share;    /* how often it is expected to meet a lamp */
    double *variance; /* what that alone makes of its variance, summed over R, G and B */
    bool *edges; /* the edge of a lamp is there, of which so many points lie in a pixel that this is known */
} aur_visible_emitters;

/* From so many points on all lamps together, drawn in proportion to power. To be released in every case.
 * Errors: MEMORY. */
enum { AUR_EMITTER_POINTS = 4096 }; /* where a fiftieth of the power is to be known to a tenth */
/* For surveys of a whole image: so many that lamps are known pixel by pixel where they are small. */
size_t aur_emitter_points(size_t pixels);
/* Whether a survey can find them: through the pixels of a pinhole camera, in an image that is not so large
 * that what is found of each pixel takes gigabytes for a while. */
bool aur_visible_emitters_can_be_found(const aur_view *view);
aur_result aur_visible_emitters_find(const aur_scene *scene, const aur_film_layout *layout, size_t points,
                                     uint64_t seed, aur_visible_emitters *visible, aur_error *error);
/* Where a sample of a pixel has several rays for emitters (edge_probes.c), of all pixels of the image;
 * NULL: none. Their mean takes the place of what the sample's own ray meets: of n rays that are uniform in
 * the pixel n times as many are expected to meet a lamp, and the variance is the n-th part (at most: they are
 * a sequence's points, not random). */
void aur_visible_emitters_take_probes(const aur_film_layout *layout, const uint16_t *probes,
                                      aur_visible_emitters *visible);
/* Leaves out pixels beside one that is covered by half at least: an integrator that looks again where
 * neighbours see a lamp's edge (`edges` of final gathering) finds the lamp there by itself. */
void aur_visible_emitters_leave_edges(const aur_film_layout *layout, aur_visible_emitters *visible);
void aur_visible_emitters_release(aur_visible_emitters *visible);

/* The variance of the mean of `samples` samples of a pixel, at least: where they are expected to have met
 * its lamps so seldom that replicas do not tell it yet, that of the lamps; else 0. */
double aur_visible_emitters_variance(const aur_visible_emitters *visible, size_t pixel, uint32_t samples);

/* Lamps that the camera sees straight. Where the edge of a bright one crosses a pixel, how much of it is seen
 * may be nearly all of the pixel's error, and a camera ray tells it without the path that follows. So in such
 * pixels a sample has many camera rays for the lamps alone: their mean takes the place of what the sample's
 * own ray meets. The rays of all samples are one sequence of Sobol's, which the pixel's error follows. Which
 * pixels have how many is known before any sample is drawn, so that images stay without bias. */

typedef struct aur_edge_probes {
    uint16_t *counts; /* of each pixel of the whole image: rays per sample, powers of two; 0: none */
    aur_sampler *sampler;
} aur_edge_probes;

/* So many rays per sample in the image's mean at most, shared out over the pixels in proportion to the
 * standard deviation of what lamps send there, to the power 4/5: errors fall as rays^-3/2 (Owen 1997), and so
 * their sum is least. *looks belongs to the context's cache; NULL where no pixel has any, or the camera is no
 * pinhole. Errors: MEMORY, CANCELLED. */
aur_result aur_edge_probes_find(const aur_view *view, double rays, const aur_integrator_context *context,
                                const aur_edge_probes **probes, aur_error *error);

/* What lamps send straight to sample `index` of a pixel. False where its own ray is to tell. */
bool aur_edge_probe(const aur_edge_probes *probes, aur_tile *tile, size_t x, size_t y, uint32_t index,
                    aur_vector *seen);

/* Lamps of a few pixels, which a pixel's first samples and those of its neighbours may all miss: where an
 * edge of one crosses a pixel is known from points on the lamps, before any sample is drawn. Larger lamps are
 * seen by all pixels beside their edges. */

/* `looks` for each pixel of the whole image whose filter may see the edge of such a lamp, 0 for the others.
 * Belongs to the context's cache; NULL where there are none, or the camera is no pinhole. Errors: MEMORY. */
aur_result aur_emitter_edges_find(const aur_view *view, uint16_t probes,
                                  const aur_integrator_context *context, const uint16_t **edges,
                                  aur_error *error);
