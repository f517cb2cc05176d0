/* The program as one of several processes that do one job. */
#pragma once

#include "program/cli/options.h"

/* Runs the verb as `run` does, together with the other processes that a launcher has started, if there are
 * any: rank 0 speaks and writes for all. Returns the exit status. */
int cli_run_ranks(const cli_verb *verb, int argc, char **argv,
                  int (*run)(const cli_verb *verb, int argc, char **argv));
