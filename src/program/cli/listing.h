/* How listings and help stand on a terminal of 80 columns, and the words of their entries. */
#pragma once

#include "program/cli/options.h"

enum { CLI_WORDS_CAPACITY = 1024, CLI_HELP_CAPACITY = 2 * CLI_WORDS_CAPACITY + 256 };

/* Prints words from a column on, in lines of at most 80 columns that begin at `indent`. */
void cli_print_paragraph(size_t column, size_t indent, const char *text);
/* Prints what is described, and the description in its column. */
void cli_print_entry(const char *what, int column, const char *help);

/* "-n, --count N[,N...]"; `aligned` long names stand below each other. */
void cli_write_option(const cli_option *option, bool aligned, char text[CLI_WORDS_CAPACITY]);
/* The names or the range that a value may have. */
void cli_list_values(const cli_option *option, char text[CLI_WORDS_CAPACITY]);
/* The help, the values and the default of an option. */
void cli_write_option_help(const cli_option *option, char text[CLI_HELP_CAPACITY]);
/* "photons=integer", and the help, the values and the default of a key. */
void cli_write_key(const aur_key *key, char text[CLI_WORDS_CAPACITY]);
void cli_write_key_help(const aur_key *key, char text[CLI_HELP_CAPACITY]);

/* Prints a listing of things, destroys it, and returns the exit status. For people each row is an entry: the
 * name, which is the first column, what stands in the column "summary" (or the last one), and below it the
 * other columns that say something. */
int cli_finish_listing(report_table *table, report_format format);

/* What may stand at a place of the command line, for the shells. */

/* Prints what the last of `count` words may become, one a line with a tab and its help after it; ":file" and
 * ":folder" stand for names of files and folders. The first word is the command. */
void cli_complete(const cli_command *const *commands, size_t count, char **words);

/* The tables of what there is to choose from, for help and completion. */

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
int cli_print_command_help(const cli_command *command);

/* The program as one of several processes that do one job. */

/* Runs the command as `run` does, together with the other processes that a launcher has started, if there are
 * any: rank 0 speaks and writes for all. Returns the exit status. */
int cli_run_ranks(const cli_command *command, int argc, char **argv,
                  int (*run)(const cli_command *command, int argc, char **argv));
