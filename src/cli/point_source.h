/* Where a verb's points come from: a set that is named, or a file. */
#pragma once

#include <aureole/sphere.h>

#include "cli/cli.h"

/* What the options say about points that a set makes. */
typedef struct cli_point_options {
    bool domain_given;
    aur_domain domain; /* with domain_given; HEMISPHERE or SPHERE lift sets of the square */
    size_t dimension;  /* 0: not given */
    aur_map map;
    aur_lobe lobe;
    bool optimal_density;
    double smoothness;
    aur_scramble scramble;
    uint64_t seed;
    aur_warnings warnings;
} cli_point_options;

/* The options that fill it, for a verb's table of long options, and what they do; on failure the error is
 * printed. */
enum {
    CLI_POINTS_DOMAIN = 512,
    CLI_POINTS_DIM,
    CLI_POINTS_MAP,
    CLI_POINTS_LOBE,
    CLI_POINTS_DENSITY,
    CLI_POINTS_SMOOTHNESS,
    CLI_POINTS_SCRAMBLE,
    CLI_POINTS_SEED
};
bool cli_parse_point_option(int option, const char *text, cli_point_options *points);

/* Prints the error of a result that is one; returns whether it is AUR_OK. */
bool cli_succeeded(aur_result result, const aur_error *error);

/* "square", "cube", "disk", "hemisphere", "sphere". */
bool cli_parse_domain(const char *text, aur_domain *domain);

/* Whether `text` names a file rather than a set: no set is called so, and there is such a file or "-". */
bool cli_is_file(const char *text);

/* The points of a set, `count` of them, on options->domain; of a file, all of them, on the file's domain
 * unless options->domain_given. `view` is of all of them, without weights where these are equal, until
 * aur_points_destroy. */
aur_result cli_load_points(const char *text, const cli_point_options *options, size_t count,
                           aur_points **points, aur_points_view *view, aur_error *error);
