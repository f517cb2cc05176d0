/* What may stand at a place of the command line, for the shells. */
#pragma once

#include "program/cli/options.h"

/* Prints what the last of `count` words may become, one a line with a tab and its help after it; ":file" and
 * ":folder" stand for names of files and folders. The first word is the verb. */
void cli_complete(const cli_verb *const *verbs, size_t count, char **words);
