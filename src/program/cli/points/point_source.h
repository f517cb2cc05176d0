/* Where a verb's points come from: a set that is named, or a file. */
#pragma once

#include <aureole/sphere.h>

#include "program/cli/options.h"

/* What the options say about points that a set makes. */
typedef struct cli_points {
    aur_directions_options options; /* of any domain; size, count and warnings are the verb's to fill */
    size_t dimension;               /* 0: not given */
    bool domain_given;              /* else a file's own */
    bool natural_domain;            /* a set's own, whatever the options' is */
} cli_points;

extern const cli_option cli_points_options[], cli_dimension_option[], cli_cap_option[]; /* of a cli_points */

/* Whether `text` names a file rather than a set: no set is called so, and there is such a file or "-". */
bool cli_is_file(const char *text);
/* The same, or file:PATH, whose points need no number. */
bool cli_has_size(const char *text);

/* Warns where nothing but the numbers says what domain the points of a file are of. */
void cli_warn_of_guess(const char *path, const aur_points_view *points, aur_warnings warnings);

/* The points of a set, `count` of them, on the options' domain; of a file all of them (`count` is that number
 * or 0), on the file's domain unless domain_given. `view` is of all of them, without weights where these are
 * equal, until aur_points_destroy. */
aur_result cli_load_points(const char *text, const cli_points *from, size_t count, aur_points **points,
                           aur_points_view *view, aur_error *error);
