/* The parts of `aureole weights`. */
#pragma once

#include <aureole/exact.h>
#include <aureole/quadrature.h>

#include "program/cli/points/point_source.h"

typedef enum cli_method {
    CLI_METHOD_OSW,   /* optimal weights, of two lobes each from its samples */
    CLI_METHOD_OSWA,  /* of two lobes from all samples */
    CLI_METHOD_MIS,   /* multiple importance sampling, balance heuristic */
    CLI_METHOD_POWER, /* power heuristic */
    CLI_METHOD_EQUAL, /* 1/N */
    CLI_METHOD_RATIO, /* p/(q N) */
    CLI_METHOD_EXACT, /* exact to a degree */
    CLI_METHOD_VORONOI
} cli_method;

typedef struct cli_weights_arguments {
    const char *source; /* NULL: none */
    cli_points points;
    bool look_up, mirrored, report, two, clipped, unconstrained;
    bool domain_follows; /* of the file */
    size_t size, mirror_size;
    aur_lobe mirror; /* of two lobes */
    double degrees;
    aur_weights_options weights;
    cli_method method;
    const char *method_name, *lobe_text, *mirror_text;
    cli_common common;
    const char *path, *plot, *table;
    size_t angles, roughnesses, rotations;
    double look_up_degrees, look_up_alpha;
    size_t rotation;
    size_t degree; /* AUR_DEGREE_LARGEST: the largest */
    bool near, negative;
    double tolerance; /* for exact weights */
    cli_list levels;  /* for nested exact weights */
    const char *symmetry;
} cli_weights_arguments;

enum { CLI_LEVEL_LIMIT = 32 };

/* Samples, weights and results, lobe by lobe. */
typedef struct cli_weights_result {
    size_t count;      /* number of samples */
    size_t lobe_count; /* or levels of exact weights */
    size_t dimension;  /* per sample: 3 for directions */
    double *xyz;       /* dimension * count */
    double *weights;   /* lobe_count * count */
    aur_domain domain; /* of the samples: the file's unless --domain, --lobe or --cap is given */
    double *near;      /* weights of the file, if requested and present; else NULL */
    aur_exact_report exact[CLI_LEVEL_LIMIT];
    double equal[2], weighted[2], sum[2];
    double ratio[2]; /* with has_ratio: of the weights p/(q N) */
    bool has_ratio;
    double condition; /* 0: not available */
} cli_weights_result;

/* The two patterns of the options; for one lobe, the pattern of a ggx lobe alone. */
aur_oswa_options cli_weights_oswa(const cli_weights_arguments *arguments);

/* Whether samples are directions of the sphere, the hemisphere or axes: other domains support only exact
 * weights. */
bool cli_has_directions(aur_domain domain);

/* Each returns the exit status, after printing an error. */
int cli_weights_compute(const cli_weights_arguments *arguments, cli_weights_result *result);
/* Exact weights, and areas of Voronoi cells, of one lobe's samples. */
aur_result cli_weights_by_degree(const cli_weights_arguments *arguments, cli_weights_result *result,
                                 aur_error *error);
aur_result cli_weights_by_cells(const cli_weights_arguments *arguments, cli_weights_result *result,
                                aur_error *error);
int cli_weights_plot(const cli_weights_arguments *arguments, const cli_weights_result *result);
int cli_weights_table(const cli_weights_arguments *arguments);
/* Reads a table and writes the samples and weights of one angle and rotation. Without a set any table is
 * accepted; otherwise it must have been built with the same options. */
int cli_weights_look_up(const cli_weights_arguments *arguments);
