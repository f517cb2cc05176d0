/* Shared by the experiments on merged samples of several lobes: a diffuse lobe with one to three glossy ones,
 * cos^m and GGX, seen at one angle, with 64 diffuse samples, 32 of the first glossy lobe and 16 of each
 * further one. Lobes are normalised over the upper hemisphere and have equal weights. */
#ifndef LAB_MARQUES_2018_LOBE_WEIGHTS_H
#define LAB_MARQUES_2018_LOBE_WEIGHTS_H

#include "samples.h"

enum { LAB_MOST_LOBES = 4, LAB_MOST_SAMPLES = 64 + 32 + 16 + 16, LAB_LOBE_REFERENCE = 8192 };

typedef enum lab_lobe_method { LAB_PLAIN, LAB_MIS, LAB_OSW, LAB_OSWA, LAB_LOBE_METHODS } lab_lobe_method;

extern const char *const lab_lobe_method_names[LAB_LOBE_METHODS];

typedef struct lab_lobes {
    size_t count;
    aur_lobe lobes[LAB_MOST_LOBES]; /* the first is cos; for a GGX lobe only its alpha is set */
    double view_degrees;
    /* Set by lab_lobes_open: */
    size_t counts[LAB_MOST_LOBES], all; /* samples */
    aur_potential *potentials[LAB_MOST_LOBES];
    double *reference; /* 4 * LAB_LOBE_REFERENCE per lobe: directions, then weights */
} lab_lobes;

#define LAB_COSINE(m_)                                                                                       \
    { .exponent = (m_) }
#define LAB_GGX(alpha_)                                                                                      \
    { .kind = AUR_LOBE_GGX, .alpha = (alpha_) }

/* The caller closes it, also after an error. */
aur_result lab_lobes_open(lab_lobes *of, aur_error *error);
void lab_lobes_close(lab_lobes *of);

/* All samples, lobe by lobe: the first counts[k] of `size` directions of the set; 0: of counts[k]. */
aur_result lab_lobes_draw(const lab_lobes *of, const char *set, size_t size, uint64_t seed, double *xyz,
                          aur_error *error);
/* weights[i]: of all samples for the sum of all lobes. */
aur_result lab_lobes_weigh(const lab_lobes *of, lab_lobe_method how, const double *xyz, double *weights,
                           aur_error *error);
/* A row per method, and a note: squares[method * stride + i], the squared errors of `count` lights. */
void lab_lobes_rows(lab_run *run, const char *name, const char *set, bool hard, size_t count, size_t stride,
                    const double *squares);
/* The integral of light over all lobes. */
double lab_lobes_integrate(const lab_lobes *of, const lab_light *light);

#endif
