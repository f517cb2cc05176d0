/* The source of a command's points: a named set, or a file. */
#pragma once

#include <aureole/pointset.h>
#include <aureole/rotations.h>
#include <aureole/symmetry.h>

#include "program/cli/options.h"

/* Options for the points of a set. */
typedef struct cli_points {
    aur_directions_options options; /* of any domain; the command fills size, count and warnings */
    size_t dimension;               /* 0: not given */
    bool domain_given;              /* otherwise the file's domain */
    bool natural_domain;            /* the set's default unless this option was given */
} cli_points;

extern const cli_option cli_points_options[], cli_dimension_option[], cli_cap_option[]; /* of a cli_points */

/* Whether `text` names a file rather than a set: no set has this name, and the file exists or it is "-". */
bool cli_is_file(const char *text);
/* Whether it is file:NAME-%d.csv or file:FOLDER, with a file for each number of points. */
bool cli_is_sized_file(const char *text);
/* Whether it is a file or file:PATH, whose points need no count. */
bool cli_has_size(const char *text);

/* Warns if the domain of a file's points was only guessed from the coordinates. */
void cli_warn_of_guess(const char *path, const aur_points_view *points, aur_warnings warnings);

/* Creates the points: `count` points of a set on the options' domain, or all points of a file (`count` is
 * that number or 0) on the file's domain unless domain_given. `view` shows all of them, without weights if
 * these are equal, until aur_points_destroy. */
aur_result cli_load_points(const char *text, const cli_points *from, size_t count, aur_points **points,
                           aur_points_view *view, aur_error *error);

/* The symmetry of --symmetry: for directions a point group, for rotations the crystal's and the sample's
 * groups. */
typedef struct cli_symmetry {
    bool given;
    aur_point_group group;
    aur_symmetry crystal, sample;
} cli_symmetry;

/* `text` NULL: no symmetry. Errors: NAME; UNSUPPORTED for a domain without symmetries. */
aur_result cli_parse_symmetry(const char *text, aur_domain domain, cli_symmetry *symmetry, aur_error *error);

/* Plots of points: the square, the disk, and the sphere from the side and from the pole. */

/* Draws points in a format of report/figure.h to `path` ("-": standard output), atomically. A point's area is
 * proportional to its weight. The square has v upwards; a point set on the cube shows its first two
 * coordinates. The sphere is seen from the side (x to the right, z up) and from the pole (x to the right, y
 * up); points on the far side are pale. */
aur_result cli_draw_points(const char *path, const char *format, const aur_points_view *points,
                           aur_error *error);

/* Reads the density given by an image's brightness (Rec. 709 luminance); returns the exit status. */
int cli_read_density(const char *path, aur_density_image **density);

/* The parts of `aureole info` by library. */

typedef struct cli_info_options {
    cli_definitions definitions;
    cli_common common;
} cli_info_options;

/* The file to describe, or the bytes of standard input. */
typedef struct cli_info_input {
    const char *path;
    size_t size;
    char *data; /* NULL: a file */
} cli_info_input;

/* Describes an image or a scene, whose file or stream starts with `size` bytes. False: it is neither;
 * otherwise *status is the exit status. */
bool cli_describe_rendered(const cli_info_input *input, size_t size, const char *start,
                           const cli_info_options *options, int *status);
