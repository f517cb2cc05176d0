/* The tables of what there is to choose from, for help and completion. */
#pragma once

#include "program/cli/options.h"

/* The tables of the libraries, one after the other; NULL beyond the last. */
const aur_table *cli_table_at(size_t index);
/* Those of libaureole-render and of integrators of the lab; none where the program is built without it. */
const aur_table *cli_render_table_at(size_t index);
/* The table of a kind, "integrator" or "integrators"; or NULL. */
const aur_table *cli_find_table(const char *kind);

/* Names of things that differ from a row's in capitals or in '_' for '-' alone become the row's:
 * "Spherical_Fibonacci:offset=0" is spherical-fibonacci. Names of files that exist stay as they are. */
void cli_forgive_names(cli_call *call);

/* What `aureole help KIND NAME` prints, of a kind that there is; returns the exit status. */
int cli_print_thing(const char *kind, const char *name, report_format format);
/* What `aureole help VERB` prints; returns CLI_SUCCESS. */
int cli_print_verb_help(const cli_verb *verb);

/* The program as one of several processes that do one job. */

/* Runs the verb as `run` does, together with the other processes that a launcher has started, if there are
 * any: rank 0 speaks and writes for all. Returns the exit status. */
int cli_run_ranks(const cli_verb *verb, int argc, char **argv,
                  int (*run)(const cli_verb *verb, int argc, char **argv));
