#include "study.h"

#include <math.h>
#include <stdlib.h>

static const keller_scene scenes[KELLER_SCENES] = {
    {"cube", "keller/cube-analytic.xml", "keller/cube-analytic.xml"},
    {"living-room", "keller/living-room.xml", "keller/living-room-analytic.xml"},
    {"office", "keller/office.xml", "keller/office-analytic.xml"},
    {"teapot", "keller/teapot-box.xml", "keller/teapot-box-analytic.xml"},
};

static const keller_set sets[KELLER_SETS] = {
    {"lcg", true},
    {"icg", true},
    {"halton", true},
    {"faure", true},
    {"sobol", true},
    {"random", true},
    {"faure:scramble=lower-triangular", true},
    {"niederreiter", true},
    {"hammersley", false},
};

const keller_scene *keller_scene_at(size_t index) {
    return &scenes[index];
}

bool keller_set_at(const lab_run *run, size_t index, keller_set *set) {
    if (index < KELLER_SETS) {
        *set = sets[index];
        return true;
    }
    *set = (keller_set){lab_run_options(run)->set, true};
    return index == KELLER_SETS && set->name != NULL;
}

aur_result keller_start(const lab_run *run, const aur_scene *scene, const char *set, size_t variant,
                        size_t bounces, aur_radiosity_directions directions, aur_radiosity **radiosity,
                        aur_error *error) {
    const lab_options *const lab = lab_run_options(run);
    aur_radiosity_options options = aur_radiosity_options_default();
    options.sequence = set;
    options.seed = variant;
    options.variant = variant;
    options.directions = directions;
    options.emission = AUR_RADIOSITY_BY_AREA;
    options.bounces = bounces;
    options.threads = lab->threads;
    options.warnings = variant == 0 ? lab->warnings : (aur_warnings){0};
    return aur_radiosity_create(scene, &options, radiosity, error);
}

aur_result keller_deviation(const aur_radiosity *radiosity, double *plain, double *weighted,
                            aur_error *error) {
    aur_radiosity_description d = {.size = sizeof d};
    aur_radiosity_describe(radiosity, &d, NULL);
    aur_radiosity_triangle_result *const results = malloc(d.triangles * sizeof *results);
    if (results == NULL) {
        if (error != NULL)
            *error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
        return AUR_ERROR_MEMORY;
    }
    const aur_result result = aur_radiosity_results(radiosity, d.triangles, sizeof *results, results, NULL);
    double sum = 0.0, weighted_sum = 0.0;
    for (size_t i = 0; i < d.triangles && result == AUR_OK; ++i) {
        const double difference = results[i].radiance[0] - 0.5;
        sum += difference * difference;
        weighted_sum += difference * difference * results[i].area;
    }
    *plain = sum / (double)d.triangles;
    *weighted = weighted_sum / ((double)d.triangles * d.area);
    free(results);
    return result;
}

void keller_published(lab_run *run, double published) {
    if (isnan(published))
        lab_text(run, NULL);
    else
        lab_number(run, published);
}
