/* Shared by the three tables of Keller 1994. */
#ifndef AUR_LAB_KELLER_STUDY_H
#define AUR_LAB_KELLER_STUDY_H

#include <aureole-render/radiosity.h>

#include "program/lab/lab.h"

enum {
    KELLER_SCENES = 4,
    KELLER_SETS = 9,
    KELLER_PUBLISHED_SETS = 5,
    KELLER_VARIANTS = 12,
    KELLER_SIZES = 3
};

extern const uint64_t keller_sizes[KELLER_SIZES]; /* of tables 2 and 3 */
/* The values of tables 2 and 3 for a scene, one of these sizes, and one of the paper's sets. */
double keller_table2(size_t scene, size_t size, size_t set);
double keller_table3(size_t scene, size_t size, size_t set);

/* In the order of the paper's tables 2 and 3: cube, living room, office, teapot. */
typedef struct keller_scene {
    const char *name;
    const char *realistic; /* path in the scenes folder; the cube has its analytic form, as in the paper */
    const char *analytic;
} keller_scene;

/* The first KELLER_PUBLISHED_SETS are the paper's, in the same order. */
typedef struct keller_set {
    const char *name; /* SET syntax */
    bool extensible;
} keller_set;

const keller_scene *keller_scene_at(size_t index);
/* False past the end; the last one is the set of `--set`, if given. */
bool keller_set_at(const lab_run *run, size_t index, keller_set *set);

/* The solution for one variant: an order of the lights, a rotation of the frames, and a seed. */
aur_result keller_start(const lab_run *run, const aur_scene *scene, const char *set, size_t variant,
                        size_t bounces, aur_radiosity_directions directions, aur_radiosity **radiosity,
                        aur_error *error);

/* Delta_a^2 and Delta_aw^2 (section 4.1) of a solution in the analytic setting; `answer` is 1/2 without a
 * cut. */
aur_result keller_deviation(const aur_radiosity *radiosity, double answer, double *plain, double *weighted,
                            aur_error *error);

/* The root of the mean of `squares`, of their minimum and of their maximum. */
double keller_rms(size_t count, const double *squares, double *least, double *greatest);

/* The last cell of a row. NaN: not published. */
void keller_published(lab_run *run, double published);

#endif
