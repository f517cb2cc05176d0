/* Options of final gathering: defaults and exclusions. */
#pragma once

#include <aureole-render/gather.h>

/* All defaults; placeholders for those that depend on other options. */
#define AUR_GATHER_SETTINGS_INITIAL                                                                          \
    {                                                                                                        \
        .diffuse_samples = 64, .glossy_samples = 64, .pattern = "spherical-fibonacci", .map = "lambert",     \
        .rotations = 16, .density = AUR_GATHER_DENSITY_DEFAULT, .smoothness = 1.5, .clip = true,             \
        .photons = 500000, .photon_pattern = "sobol", .photons_per_texel = 16.0, .continued = 0.25,          \
        .short_rays = 2.0, .light_samples = 1, .max_depth = UINT32_MAX, .edge_samples = 128, .packets = true \
    }

/* Sets the defaults that follow from other options. Errors: ARGUMENT and UNSUPPORTED for options that exclude
 * each other. */
aur_result aur_gather_settings_complete(aur_gather_settings *options, aur_error *error);
