/* Figures of merit of point sets: how even they are. */
#ifndef AUREOLE_QUALITY_H
#define AUREOLE_QUALITY_H

#include <aureole/pointset.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One row of the table of measures. */
typedef struct aur_measure_description {
    const char *name;
    const char *parameter; /* "S" for riesz:S, empty for none */
    const char *summary;
    const char *domains;
    const char *source;
} aur_measure_description;

AUR_API size_t aur_measure_count(void);
AUR_API const aur_measure_description *aur_measure_at(size_t index); /* NULL beyond the table */

typedef struct aur_measure_options {
    size_t threads; /* 0: all */
    aur_progress progress;
    aur_warnings warnings;
} aur_measure_options;

/* One measure, by name, of points with optional weights. The result does not depend on the number of threads.
 */
AUR_API aur_result aur_measure(const char *metric, const aur_points *points,
                               const aur_measure_options *options, double *value, aur_error *error)
    AUR_NONNULL(1, 2, 4);

#ifdef __cplusplus
}
#endif

#endif
