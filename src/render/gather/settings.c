#include "render/gather/settings.h"

#include <string.h>

#include "points/base/error.h"

/* Options that exclude others, as a bit mask. */
enum {
    EQUAL = 1 << 0,   /* weights */
    OPTIMAL = 1 << 1, /* density */
    SHARE = 1 << 2,
    SHARE_NEAR = 1 << 3,
    DEBIAS = 1 << 4,
    CAUSTICS = 1 << 5,
    NOT_DITHERED = 1 << 6, /* decorrelation */
    NOT_FIBONACCI = 1 << 7 /* pattern or scramble */
};

/* Options that exclude each other: all bits of a row together are an error. */
static const struct {
    unsigned all;
    aur_result result;
    const char *message;
} exclusions[] = {
    {EQUAL | OPTIMAL, AUR_ERROR_ARGUMENT,
     "equal weights are for density=same; for density=optimal take weights=ratio"},
    {SHARE | NOT_DITHERED, AUR_ERROR_UNSUPPORTED, "share needs decorrelation=blue"},
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
        {o->density == AUR_GATHER_DENSITY_OPTIMAL, OPTIMAL},
        {o->share != AUR_SHARE_NONE, SHARE},
        {o->share == AUR_SHARE_NEAR, SHARE_NEAR},
        {o->debias != AUR_DEBIAS_NONE, DEBIAS},
        {o->caustic_photons > 0, CAUSTICS},
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
    if (o->debias == AUR_DEBIAS_ONLY || o->debias == AUR_DEBIAS_FOUND)
        o->direct = AUR_DIRECT_NONE;
    const unsigned given = given_options(o);
    for (size_t i = 0; i < sizeof exclusions / sizeof exclusions[0]; ++i)
        if ((given & exclusions[i].all) == exclusions[i].all)
            return aur_fail(error, exclusions[i].result, "finalgather: %s", exclusions[i].message);
    return AUR_OK;
}
