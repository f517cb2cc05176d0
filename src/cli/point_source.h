/* Where a verb's points come from: a set that is named, or a file. */
#ifndef AUR_CLI_POINT_SOURCE_H
#define AUR_CLI_POINT_SOURCE_H

#include <aureole/sphere.h>

#include "cli/cli.h"

/* What the options say about points that a set makes. */
typedef struct cli_point_options {
    bool domain_given;
    aur_domain domain; /* with domain_given; HEMISPHERE or SPHERE lift sets of the square */
    size_t dimension;  /* 0: not given */
    aur_map map;
    aur_lobe lobe;
    int optimal_density;
    double smoothness;
    aur_scramble scramble;
    uint64_t seed;
    aur_warnings warnings;
} cli_point_options;

/* "square", "cube", "disk", "hemisphere", "sphere". */
bool cli_parse_domain(const char *text, aur_domain *domain);
const char *cli_domain_name(aur_domain domain);

/* Whether `text` names a file rather than a set: no set is called so, and there is such a file or "-". */
bool cli_is_file(const char *text);

/* The points of a set, `count` of them, on options->domain; of a file, all of them, on the file's domain
 * unless options->domain_given. Equal weights are left out. Free with aur_points_release. */
aur_result cli_load_points(const char *text, const cli_point_options *options, size_t count,
                           aur_points *points, aur_error *error);

#endif
