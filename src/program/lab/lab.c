/* The table of experiments: a new one adds a file and a line here. */
#include <string.h>

#include "program/lab/run.h"

extern const lab_experiment lab_analytical_cases;
extern const lab_experiment lab_aureole_correlated_rotations;
extern const lab_experiment lab_aureole_every_measure;
extern const lab_experiment lab_aureole_integrand;
extern const lab_experiment lab_aureole_scene;
extern const lab_experiment lab_domains_axes;
extern const lab_experiment lab_domains_every_number;
extern const lab_experiment lab_domains_grids;
extern const lab_experiment lab_domains_lifts;
extern const lab_experiment lab_domains_prefixes;
extern const lab_experiment lab_factors_coverage;
extern const lab_experiment lab_integrate_coverage;
extern const lab_experiment lab_irradiance_coverage;
extern const lab_experiment lab_keller_1994_boxes;
extern const lab_experiment lab_keller_1994_features;
extern const lab_experiment lab_keller_1994_figure1;
extern const lab_experiment lab_keller_1994_floor;
extern const lab_experiment lab_keller_1994_mirrors;
extern const lab_experiment lab_keller_1994_table1;
extern const lab_experiment lab_keller_1994_table2;
extern const lab_experiment lab_keller_1994_table3;
extern const lab_experiment lab_marques_2013_closeups;
extern const lab_experiment lab_marques_2013_fig1;
extern const lab_experiment lab_marques_2013_fig2;
extern const lab_experiment lab_marques_2013_fig3;
extern const lab_experiment lab_marques_2013_fig4;
extern const lab_experiment lab_marques_2013_gather;
extern const lab_experiment lab_marques_2013_table1;
extern const lab_experiment lab_marques_2018_beyond;
extern const lab_experiment lab_marques_2018_box;
extern const lab_experiment lab_marques_2018_coats;
extern const lab_experiment lab_marques_2018_fig7;
extern const lab_experiment lab_marques_2018_fig8;
extern const lab_experiment lab_marques_2018_functions;
extern const lab_experiment lab_marques_2018_gains;
extern const lab_experiment lab_marques_2018_ggx;
extern const lab_experiment lab_marques_2018_joint;
extern const lab_experiment lab_marques_2018_learned;
extern const lab_experiment lab_marques_2018_lobes;
extern const lab_experiment lab_marques_2018_metal;
extern const lab_experiment lab_marques_2018_rivals;
extern const lab_experiment lab_marques_2018_sensitivity;
extern const lab_experiment lab_marques_2018_slopes;
extern const lab_experiment lab_marques_2018_table1;
extern const lab_experiment lab_marques_2018_weights;
extern const lab_experiment lab_marques_2019_adaptive;
extern const lab_experiment lab_marques_2019_discrepancy;
extern const lab_experiment lab_marques_2019_grids;
extern const lab_experiment lab_marques_2019_lattice;
extern const lab_experiment lab_marques_2019_shifts;
extern const lab_experiment lab_marques_2019_statue;
extern const lab_experiment lab_image_coverage;
extern const lab_experiment lab_schretter_2012_fig5;
extern const lab_experiment lab_schretter_2012_gaps;
extern const lab_experiment lab_schretter_2012_sets;
extern const lab_experiment lab_schretter_2012_warp;
extern const lab_experiment lab_weights_choosing;

/* One per line. */
/* clang-format off */
static const lab_experiment *const experiments[] = {
    &lab_analytical_cases,
    &lab_aureole_correlated_rotations,
    &lab_aureole_every_measure,
    &lab_aureole_integrand,
    &lab_aureole_scene,
    &lab_domains_axes,
    &lab_domains_every_number,
    &lab_domains_grids,
    &lab_domains_lifts,
    &lab_domains_prefixes,
    &lab_factors_coverage,
    &lab_integrate_coverage,
    &lab_irradiance_coverage,
    &lab_keller_1994_boxes,
    &lab_keller_1994_features,
    &lab_keller_1994_figure1,
    &lab_keller_1994_floor,
    &lab_keller_1994_mirrors,
    &lab_keller_1994_table1,
    &lab_keller_1994_table2,
    &lab_keller_1994_table3,
    &lab_marques_2013_closeups,
    &lab_marques_2013_fig1,
    &lab_marques_2013_fig2,
    &lab_marques_2013_fig3,
    &lab_marques_2013_fig4,
    &lab_marques_2013_gather,
    &lab_marques_2013_table1,
    &lab_marques_2018_beyond,
    &lab_marques_2018_box,
    &lab_marques_2018_coats,
    &lab_marques_2018_fig7,
    &lab_marques_2018_fig8,
    &lab_marques_2018_functions,
    &lab_marques_2018_gains,
    &lab_marques_2018_ggx,
    &lab_marques_2018_joint,
    &lab_marques_2018_learned,
    &lab_marques_2018_lobes,
    &lab_marques_2018_metal,
    &lab_marques_2018_rivals,
    &lab_marques_2018_sensitivity,
    &lab_marques_2018_slopes,
    &lab_marques_2018_table1,
    &lab_marques_2018_weights,
    &lab_marques_2019_adaptive,
    &lab_marques_2019_discrepancy,
    &lab_marques_2019_grids,
    &lab_marques_2019_lattice,
    &lab_marques_2019_shifts,
    &lab_marques_2019_statue,
    &lab_image_coverage,
    &lab_schretter_2012_fig5,
    &lab_schretter_2012_gaps,
    &lab_schretter_2012_sets,
    &lab_schretter_2012_warp,
    &lab_weights_choosing,
};
/* clang-format on */

enum { BUILT_IN_COUNT = sizeof experiments / sizeof experiments[0], MOST_ADDED = 256 };

/* Experiments registered by modules and programs before the first run, global to the process. */
static const lab_experiment *added[MOST_ADDED];
static size_t added_count;

size_t lab_experiment_count(void) {
    return BUILT_IN_COUNT + added_count;
}

const lab_experiment *lab_experiment_at(size_t index) {
    return index < BUILT_IN_COUNT           ? experiments[index]
           : index < lab_experiment_count() ? added[index - BUILT_IN_COUNT]
                                            : NULL;
}

const lab_experiment *lab_find_experiment(const char *name) {
    for (size_t i = lab_experiment_count(); i-- > 0;) /* the last registration wins */
        if (strcmp(lab_experiment_at(i)->name, name) == 0)
            return lab_experiment_at(i);
    return NULL;
}

static aur_result add_experiment(const lab_experiment *experiment, aur_error *error) {
    if (experiment->name == NULL || experiment->columns == NULL || experiment->run == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an experiment must have a name, columns and a function");
    for (size_t i = 0; i < BUILT_IN_COUNT; ++i)
        if (strcmp(experiments[i]->name, experiment->name) == 0)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "the lab has an experiment '%s' already",
                            experiment->name);
    size_t at = 0;
    while (at < added_count && strcmp(added[at]->name, experiment->name) != 0)
        ++at;
    if (at == MOST_ADDED)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "at most %d experiments can be added", MOST_ADDED);
    added[at] = experiment;
    added_count += at == added_count;
    return AUR_OK;
}

aur_result lab_add(const lab_module *module, aur_error *error) {
    if (module->size != sizeof *module || strcmp(module->version, aur_version()) != 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "built for version %s: expected %s (build it again with this version's headers)",
                        module->size == sizeof *module ? module->version : "another", aur_version());
    aur_result result = AUR_OK;
    for (size_t i = 0; i < module->experiment_count && result == AUR_OK; ++i)
        result = add_experiment(module->experiments[i], error);
    for (size_t i = 0; i < module->set_count && result == AUR_OK; ++i)
        result = aur_set_register(&module->sets[i], error);
    for (size_t i = 0; i < module->integrand_count && result == AUR_OK; ++i)
        result = lab_add_integrand(&module->integrands[i], error);
    return result;
}
