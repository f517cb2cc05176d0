/* finalgather with all variants of the papers on gathering: patterns and their weights, randomisation per
 * pixel, gathered light. */
#include "program/lab/gather.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <aureole/quadrature.h>

#include "levels.h"
#include "weighted.h"

/* Parameters, each a field of lab_gather_settings. */
#define LAB_FIELD(type_, name_, field_, default_, help_)                                                     \
    .name = (name_), .type = (type_), .help = (help_), .default_text = (default_),                           \
    .offset = offsetof(lab_gather_settings, field_), .size = sizeof(((lab_gather_settings *)0)->field_)
#define LAB_BOOLEAN(name_, field_, default_, help_) LAB_FIELD(AUR_KEY_BOOLEAN, name_, field_, default_, help_)
#define LAB_TEXT(name_, field_, default_, help_) LAB_FIELD(AUR_KEY_TEXT, name_, field_, default_, help_)
#define LAB_INTEGER(name_, field_, minimum_, maximum_, default_, help_)                                      \
    LAB_FIELD(AUR_KEY_INTEGER, name_, field_, default_, help_), .minimum = (minimum_), .maximum = (maximum_)
#define LAB_REAL(name_, field_, minimum_, maximum_, default_, help_)                                         \
    LAB_FIELD(AUR_KEY_REAL, name_, field_, default_, help_), .minimum = (minimum_), .maximum = (maximum_)
#define LAB_CHOICE(name_, field_, default_, help_, ...)                                                      \
    LAB_FIELD(AUR_KEY_CHOICE, name_, field_, default_, help_), .words = (const char *const[]) {              \
        __VA_ARGS__, NULL                                                                                    \
    }

static const aur_key keys[] = {
    {LAB_TEXT("map", gather.map, "lambert",
              "map of a square set to the hemisphere: lambert, concentric or azimuthal")},
    {LAB_TEXT("scramble", gather.scramble, "rotate (nets: digit)",
              "how a pattern is randomised: none, digit, owen, shift or rotate"),
     .computed = true},
    {LAB_INTEGER("rotations", gather.rotations, 0, 65536, "16",
                 "randomisations made beforehand; 0 is one of its own for every pixel")},
    {LAB_CHOICE("density", gather.density, "optimal (weights=equal: same)",
                "directions follow the lobe, or its power 2/(s+1)", "same", "optimal"),
     .computed = true},
    {LAB_CHOICE("weights", weights, "ratio", "how samples are weighed (Marques 2018, 2019)", "ratio", "equal",
                "osw", "oswa", "mis", "oswa-solve")},
    {LAB_BOOLEAN("clip", gather.clip, "true", "glossy lobes end at the surface's horizon")},
    {LAB_REAL("regularization", regularization, 0.0, 1e6, "1e-6 (oswa-solve: 0.5)",
              "added to the diagonal of optimal weights' systems"),
     .computed = true},
    {LAB_REAL("smoothness", gather.smoothness, 1.0, 2.0, "1.5", "s of the optimal weights and density"),
     .minimum_open = true, .maximum_open = true},
    {LAB_TEXT("photon_pattern", gather.photon_pattern, "sobol", "SET of the photons' numbers")},
    {LAB_CHOICE("decorrelation", gather.decorrelation, "blue", "how pixels choose among the rotations",
                "blue", "random", "none")},
    {LAB_BOOLEAN("packets", gather.packets, "true",
                 "sixteen rays at a time, else one: the same image to rounding")},
    {LAB_BOOLEAN("adaptive", adaptive, "false", "more directions where the light varies (Marques 2019)")},
    {LAB_INTEGER("levels", levels, 1, LAB_LEVEL_CAPACITY - 1, "2", "extensions of an adaptive pattern"),
     .computed = true},
    {LAB_INTEGER("level_factor", level_factor, 2, 4, "4",
                 "directions of a level over those of the one before: 2 or 4"),
     .computed = true},
    {LAB_REAL("threshold", threshold, 0.0, 1e6, "0.03 (entropy: 0.3, entropy-histogram: 1)",
              "contrast above which the next level is gathered"),
     .computed = true},
    {LAB_CHOICE("criterion", criterion, "variance", "how that contrast is measured", "entropy",
                "entropy-brightness", "entropy-histogram", "variance"),
     .computed = true},
    {LAB_CHOICE("component", gather.component, "all", "the lobes to gather", "all", "diffuse", "glossy")},
    {LAB_CHOICE("incident", gather.incident, "photons",
                "what gather rays meet shines by its photons, or by what it emits alone", "photons",
                "emitters")},
    {LAB_INTEGER("pattern_seed", gather.pattern_seed, 0, INFINITY, "0",
                 "another randomisation of the pattern under the same seed")},
};

/* The lab's options; the others have the library's defaults. */
static const lab_gather_settings initial = {
    .regularization = -1.0, .criterion = LAB_CRITERION_DEFAULT, .threshold = -1.0f};

static aur_result select(aur_gather_settings *given, aur_warnings warnings, const aur_gather_method **method,
                         aur_error *error) {
    lab_gather_settings *const o = (lab_gather_settings *)given;
    if (o->regularization < 0.0) /* as published for the published method */
        o->regularization = o->weights == LAB_WEIGHTS_SOLVE ? 0.5 : AUR_REGULARIZATION_DEFAULT;
    given->weights = o->weights == LAB_WEIGHTS_RATIO   ? AUR_WEIGHTS_RATIO
                     : o->weights == LAB_WEIGHTS_EQUAL ? AUR_WEIGHTS_EQUAL
                                                       : AUR_WEIGHTS_METHOD;
    if (o->adaptive) {
        *method = &lab_gather_by_levels;
        return lab_levels_check(o, error);
    }
    lab_levels_warn_unused(o, warnings);
    if (lab_merges(o) && given->rotations == 0)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "finalgather-lab: weights of merged samples need prepared rotations, not rotations=0");
    if (lab_merges(o) && given->share != AUR_SHARE_NONE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather-lab: share needs weights=ratio, equal or osw");
    *method = lab_merges(o)                   ? &lab_gather_merged
              : o->weights == LAB_WEIGHTS_OSW ? &lab_gather_weighted
                                              : NULL;
    return AUR_OK;
}

const aur_gather_integrator lab_finalgather = {
    .size = sizeof lab_finalgather,
    .row = {.name = "finalgather-lab",
            .summary = "finalgather, whose keys it takes too, with those that reproduce papers",
            .source = "Marques 2013, Marques 2018, Marques 2019",
            .key_count = sizeof keys / sizeof keys[0],
            .keys = keys},
    .settings_size = sizeof(lab_gather_settings),
    .initial = &initial,
    .select = select};

static const aur_row *const rows[] = {&lab_finalgather.row};

const aur_table lab_integrator_table = {
    .kind = "lab-integrator",
    .summary = "integrators that reproduce papers, for the lab and render --integrator",
    .count = sizeof rows / sizeof rows[0],
    .rows = rows,
};
