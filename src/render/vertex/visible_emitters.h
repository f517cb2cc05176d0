/* Emitters that the camera sees directly. All first samples of a pixel may miss a small bright emitter, and
 * replicas that all miss it agree. So it is found from the other end, by points sampled on the emitters. */
#pragma once

#include "render/film/film.h"
#include "render/film/integrator.h"
#include "render/scene/scene.h"

/* Per sample of a pixel, uniform in it; arrays over the pixels of the film. NULL unless the camera is a
 * pinhole. */
typedef struct aur_visible_emitters {
    double
        *share; /* expected number of hits of an emitter of equal radiance with the same variance and mean */
    double *variance; /* variance of the sample due to emitters only, summed over R, G and B */
    bool *edges;      /* an emitter's edge crosses the pixel, sampled densely enough to be sure */
} aur_visible_emitters;

/* From this many points on all emitters together, sampled in proportion to power. Must be released in every
 * case. Errors: MEMORY. */
enum { AUR_EMITTER_POINTS = 4096 }; /* enough to know a fiftieth of the power to a tenth */
/* For surveys of a whole image: enough to find small emitters pixel by pixel. */
size_t aur_emitter_points(size_t pixels);
/* Whether emitters can be found: the camera is a pinhole, and the image is not so large that the survey takes
 * gigabytes of memory. */
bool aur_visible_emitters_can_be_found(const aur_view *view);
aur_result aur_visible_emitters_find(const aur_scene *scene, const aur_film_layout *layout, size_t points,
                                     uint64_t seed, aur_visible_emitters *visible, aur_error *error);
/* Accounts for pixels whose samples have several probe rays for emitters (edge_probes.c), over the whole
 * image; NULL: none. The mean of the probe rays replaces what the sample's camera ray hits. n rays, uniform
 * in the pixel, are expected to hit an emitter n times as often, and the variance is at most 1/n of that of
 * one ray: they are points of a sequence, not random. */
void aur_visible_emitters_take_probes(const aur_film_layout *layout, const uint16_t *probes,
                                      aur_visible_emitters *visible);
/* Leaves out pixels next to one that is covered by at least half: an integrator that refines where neighbours
 * see an emitter's edge (`edges` of final gathering) finds the emitter there itself. */
void aur_visible_emitters_leave_edges(const aur_film_layout *layout, aur_visible_emitters *visible);
void aur_visible_emitters_release(aur_visible_emitters *visible);

/* A lower bound of the variance of the mean of `samples` samples of a pixel. It is the emitters' variance
 * while the expected number of hits is too small for replicas to show it; else 0. */
double aur_visible_emitters_variance(const aur_visible_emitters *visible, size_t pixel, uint32_t samples);

/* Emitters that the camera sees directly. Where the edge of a bright emitter crosses a pixel, its visible
 * fraction may cause nearly all of the pixel's error, and a camera ray measures it without the rest of a
 * path. So each sample of such a pixel traces many probe rays: camera rays for emission only. Their mean
 * replaces the emission that the sample's camera ray hits. The probe rays of all samples of a pixel form one
 * Sobol' sequence, which determines the error's decay. Their number per pixel is fixed before any sample is
 * drawn, so images remain unbiased. */

typedef struct aur_edge_probes {
    uint16_t *counts; /* of each pixel of the whole image: probe rays per sample, powers of two; 0: none */
    aur_sampler *sampler;
} aur_edge_probes;

/* Distributes at most `rays` probe rays per sample, as the mean over the image, over the pixels in proportion
 * to the standard deviation of emitted radiance to the power 4/5: errors decrease as rays^-3/2 (Owen 1997),
 * so this minimises their sum. *probes belongs to the context's cache; NULL if no pixel has any, or the
 * camera is not a pinhole. Errors: MEMORY, CANCELLED. */
aur_result aur_edge_probes_find(const aur_view *view, double rays, const aur_integrator_context *context,
                                const aur_edge_probes **probes, aur_error *error);

/* Emitted radiance seen by sample `index` of a pixel, by probe rays. False: use the sample's camera ray. */
bool aur_edge_probe(const aur_edge_probes *probes, aur_tile *tile, size_t x, size_t y, uint32_t index,
                    aur_vector *emission);

/* Emitted radiance, the sum of R, G and B, that the camera sees at the centres of `count` <= 16 pixels of the
 * whole image. Only the scene and the size of the view count. */
void aur_emission_at_centres(const aur_view *view, size_t count, const size_t *x, const size_t *y,
                             float *emission);

/* Emitters as small as a few pixels, which the first samples of a pixel and of its neighbours may all miss.
 * Points sampled on the emitters show where their edges cross pixels, before any sample is drawn. Larger
 * emitters are seen by all pixels next to their edges. */

/* `probes` for each pixel of the whole image whose filter may see the edge of such an emitter, 0 for the
 * others. Belongs to the context's cache; NULL if there are none, or the camera is not a pinhole. Errors:
 * MEMORY. */
aur_result aur_emitter_edges_find(const aur_view *view, uint16_t probes,
                                  const aur_integrator_context *context, const uint16_t **edges,
                                  aur_error *error);
