/* Pages with a viewer of pictures. */
#pragma once

#include "program/cli/render/picture.h"

/* Writes a page with pictures of one size to `path`; the first is the reference of the others where `judged`.
 * Prints what is wrong and returns the exit status. */
int cli_write_viewer(const char *path, size_t count, char **names, const cli_picture *how, double exposure,
                     bool judged);
