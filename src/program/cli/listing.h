/* Layout of listings and help on a terminal of 80 columns, and the texts of their entries. */
#pragma once

#include "program/cli/options.h"

enum { CLI_WORDS_CAPACITY = 1024, CLI_HELP_CAPACITY = 2 * CLI_WORDS_CAPACITY + 256 };

/* Prints words from a column on, in lines of at most 80 columns indented by `indent`. */
void cli_print_paragraph(size_t column, size_t indent, const char *text);
/* Prints an entry, and the description in its column. */
void cli_print_entry(const char *what, int column, const char *help);

/* "-n, --count N[,N...]"; `aligned` aligns options without a short name with the others. */
void cli_write_option(const cli_option *option, bool aligned, char text[CLI_WORDS_CAPACITY]);
/* The names or the range of a value. */
void cli_list_values(const cli_option *option, char text[CLI_WORDS_CAPACITY]);
/* The help, the values and the default of an option. */
void cli_write_option_help(const cli_option *option, char text[CLI_HELP_CAPACITY]);
/* "photons=integer", and the help, the values and the default of a key. */
void cli_write_key(const aur_key *key, char text[CLI_WORDS_CAPACITY]);
void cli_write_key_help(const aur_key *key, char text[CLI_HELP_CAPACITY]);

/* Prints a listing, destroys it, and returns the exit status. As text each row is an entry: the name (the
 * first column), the column "summary" or the last one, and below it the other nonempty columns. */
int cli_finish_listing(report_table *table, report_format format);

/* Completion for shells. */

/* Prints the candidates for the last of `count` words, one per line with a tab and its help; ":file" and
 * ":folder" stand for file names. The first word is the command. */
void cli_complete(const cli_command *const *commands, size_t count, char **words);

/* The tables of components, for help and completion. */

/* The tables of the libraries by index; NULL beyond the last. */
const aur_table *cli_table_at(size_t index);
/* Those of libaureole-render and the lab's integrators; none if the program is built without it. */
const aur_table *cli_render_table_at(size_t index);
/* The table of a kind, "integrator" or "integrators"; or NULL. */
const aur_table *cli_find_table(const char *kind);

/* Replaces names that differ from a row's only in case or '_' for '-' by the row's:
 * "Spherical_Fibonacci:offset=0" becomes spherical-fibonacci. Names of existing files are unchanged. */
void cli_forgive_names(cli_call *call);

/* Prints `aureole help KIND NAME` for an existing kind; returns the exit status. */
int cli_print_row(const char *kind, const char *name, report_format format);
/* Prints `aureole help VERB`; returns CLI_SUCCESS. */
int cli_print_command_help(const cli_command *command);

/* The program as one of several processes of an MPI job. */

/* Runs the command with `run` together with the other processes of a launcher, if any: rank 0 prints and
 * writes for all. Returns the exit status. */
int cli_run_ranks(const cli_command *command, int argc, char **argv,
                  int (*run)(const cli_command *command, int argc, char **argv));
