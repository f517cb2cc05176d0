/* What `aureole info` describes by each library. */
#pragma once

#include "program/cli/options.h"

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
