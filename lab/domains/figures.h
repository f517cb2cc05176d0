/* A figure of some points of a set. */
#ifndef LAB_DOMAINS_FIGURES_H
#define LAB_DOMAINS_FIGURES_H

#include <aureole/quality.h>

typedef struct lab_points {
    const char *set;
    aur_domain domain;
    size_t size;         /* of the set */
    size_t first, count; /* the points to measure; count 0: all */
} lab_points;

aur_result lab_figure(const lab_points *points, const char *metric, size_t threads, double *value,
                      aur_error *error);

#endif
