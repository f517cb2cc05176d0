#include "render/gather/settings.h"

#include <aureole/quadrature.h>

#include <string.h>

#include "points/base/error.h"

/* Options that exclude others, as a bit mask. */
enum {
    EQUAL = 1 << 0, /* weights */
    MERGED = 1 << 1,
    OPTIMAL = 1 << 2, /* density */
    SHARE = 1 << 3,
    SHARE_NEAR = 1 << 4,
    DEBIAS = 1 << 5,
    CAUSTICS = 1 << 6,
    NO_ROTATIONS = 1 << 7,
    NOT_DITHERED = 1 << 8, /* decorrelation */
    NOT_FIBONACCI = 1 << 9 /* pattern or scramble */
};

/* Options that exclude each other: all bits of a row together are an error. */
static const struct {
    unsigned all;
    aur_result result;
    const char *message;
} exclusions[] = {
    {EQUAL | OPTIMAL, AUR_ERROR_ARGUMENT,
     "equal weights are for density=same; for density=optimal take weights=ratio"},
    {MERGED | NO_ROTATIONS, AUR_ERROR_ARGUMENT,
     "weights of merged samples need prepared rotations, not rotations=0"},
    {SHARE | NOT_DITHERED, AUR_ERROR_UNSUPPORTED, "share needs decorrelation=blue"},
    {SHARE | MERGED, AUR_ERROR_UNSUPPORTED, "share needs weights=ratio, equal or osw"},
    {SHARE_NEAR | NOT_FIBONACCI, AUR_ERROR_UNSUPPORTED,
     "share=near has spherical Fibonacci sets that complete each other: leave 'pattern' and 'scramble' out"},
    {DEBIAS | SHARE, AUR_ERROR_UNSUPPORTED,
     "debias corrects the bias of the photon map, not that of share: they cannot be combined"},
    {DEBIAS | CAUSTICS, AUR_ERROR_UNSUPPORTED,
     "debias corrects the bias of the photon map, not that of caustic_photons: they cannot be combined"},
};

static unsigned given_options(const aur_gather_settings *o) {
    const bool fibonacci = strcmp(o->pattern, "spherical-fibonacci") == 0 &&
                           (o->scramble == NULL || strcmp(o->scramble, "rotate") == 0);
    const struct {
        bool given;
        unsigned bit;
    } bits[] = {
        {o->weights == AUR_WEIGHTS_EQUAL, EQUAL},
        {aur_merges_samples(o->weights), MERGED},
        {o->density == AUR_GATHER_DENSITY_OPTIMAL, OPTIMAL},
        {o->share != AUR_SHARE_NONE, SHARE},
        {o->share == AUR_SHARE_NEAR, SHARE_NEAR},
        {o->debias != AUR_DEBIAS_NONE, DEBIAS},
        {o->caustic_photons > 0, CAUSTICS},
        {o->rotations == 0, NO_ROTATIONS},
        {o->decorrelation != AUR_DECORRELATION_BLUE, NOT_DITHERED},
        {!fibonacci, NOT_FIBONACCI},
    };
    unsigned given = 0;
    for (size_t i = 0; i < sizeof bits / sizeof bits[0]; ++i)
        given |= bits[i].given ? bits[i].bit : 0;
    return given;
}

aur_result aur_gather_settings_complete(aur_gather_settings *o, aur_error *error) {
    if (o->density == AUR_GATHER_DENSITY_DEFAULT)
        o->density = o->weights == AUR_WEIGHTS_EQUAL ? AUR_GATHER_DENSITY_SAME : AUR_GATHER_DENSITY_OPTIMAL;
    if (o->regularization < 0.0) /* as published for the published method */
        o->regularization = o->weights == AUR_WEIGHTS_SOLVE ? 0.5 : AUR_REGULARIZATION_DEFAULT;
    if (o->debias == AUR_DEBIAS_ONLY || o->debias == AUR_DEBIAS_FOUND)
        o->direct = AUR_DIRECT_NONE;
    const unsigned given = given_options(o);
    for (size_t i = 0; i < sizeof exclusions / sizeof exclusions[0]; ++i)
        if ((given & exclusions[i].all) == exclusions[i].all)
            return aur_fail(error, exclusions[i].result, "finalgather: %s", exclusions[i].message);
    return AUR_OK;
}
