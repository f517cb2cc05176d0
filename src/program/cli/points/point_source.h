/* Where a command's points come from: a set that is named, or a file. */
#pragma once

#include <aureole/pointset.h>
#include <aureole/rotations.h>
#include <aureole/symmetry.h>

#include "program/cli/options.h"

/* What the options say about points that a set makes. */
typedef struct cli_points {
    aur_directions_options options; /* of any domain; size, count and warnings are the command's to fill */
    size_t dimension;               /* 0: not given */
    bool domain_given;              /* else a file's own */
    bool natural_domain;            /* a set's own, whatever the options' is */
} cli_points;

extern const cli_option cli_points_options[], cli_dimension_option[], cli_cap_option[]; /* of a cli_points */

/* Whether `text` names a file rather than a set: no set is called so, and there is such a file or "-". */
bool cli_is_file(const char *text);
/* Whether it is file:NAME-%d.csv or file:FOLDER, a file for each number of points. */
bool cli_is_sized_file(const char *text);
/* Whether it is a file or file:PATH, whose points need no number. */
bool cli_has_size(const char *text);

/* Warns where only the numbers says what domain the points of a file are of. */
void cli_warn_of_guess(const char *path, const aur_points_view *points, aur_warnings warnings);

/* The points of a set, `count` of them, on the options' domain; of a file all of them (`count` is that number
 * or 0), on the file's domain unless domain_given. `view` is of all of them, without weights where these are
 * equal, until aur_points_destroy. */
aur_result cli_load_points(const char *text, const cli_points *from, size_t count, aur_points **points,
                           aur_points_view *view, aur_error *error);

/* What --symmetry names: of directions per point group, of rotations the crystal's group and the sample's. */
typedef struct cli_symmetry {
    bool given;
    aur_point_group group;
    aur_symmetry crystal, sample;
} cli_symmetry;

/* `text` NULL: none. Errors: NAME; UNSUPPORTED for a domain without symmetries. */
aur_result cli_parse_symmetry(const char *text, aur_domain domain, cli_symmetry *symmetry, aur_error *error);

/* Images of points: the square, the disk, and the sphere from the side and from the pole. */

/* Draws points in a format of report/figure.h to `path` ("-": standard output), whole or not at all. A
 * point's area goes with its weight. The square has v upwards; a point set on the cube shows its first two
 * coordinates. The sphere is seen from the side (x to the right, z up) and from the pole (x to the right, y
 * up); points on the far side are pale. */
aur_result cli_draw_points(const char *path, const char *format, const aur_points_view *points,
                           aur_error *error);

/* The density that an image's brightness (Rec. 709 luminance) makes; returns the exit status. */
int cli_read_density(const char *path, aur_density_image **density);

/* What `aureole info` describes by each library. */

typedef struct cli_info_options {
    cli_definitions definitions;
    cli_common common;
} cli_info_options;

/* What is described: a file, or the bytes that came by standard input. */
typedef struct cli_info_input {
    const char *path;
    size_t size;
    char *data; /* NULL: a file */
} cli_info_input;

/* Describes an image or a scene, whose file or stream starts with `size` bytes. False: it is neither of them;
 * else *status is the exit status. */
bool cli_describe_rendered(const cli_info_input *input, size_t size, const char *start,
                           const cli_info_options *options, int *status);
