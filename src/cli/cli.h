/* What the verbs share: options, errors, exit statuses, tables of results. */
#pragma once

#include <aureole/core.h>
#include <getopt.h>
#include <stdbool.h>

/* The exit statuses of the command line. */
enum { CLI_SUCCESS = 0, CLI_DIFFERENCE = 1, CLI_BAD_INPUT = 2, CLI_FAILURE = 3 };

/* One verb: its file defines `const cli_verb cli_verb_<name>`, and main.c has the table. */
typedef struct cli_verb {
    const char *name;
    const char *arguments; /* "SET -n N [options]" */
    const char *summary;   /* one line for the list */
    const char *help;      /* the options, one a line; printed by `aureole help VERB` and `VERB --help` */
    int (*run)(int argc, char **argv); /* argv[0] is the verb; returns the exit status */
} cli_verb;

void cli_print_verb_help(const cli_verb *verb);

/* Prints "aureole: ..." on standard error and returns the exit status that belongs to the result. */
int cli_fail(const aur_error *error);
/* The same for a mistake in the command line itself; returns CLI_BAD_INPUT. */
int cli_bad_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* getopt_long with our messages: the option's value, -1 at the end, '?' after an error that has been printed.
 * Names of long options must be unabbreviated or unique. Start with optind = 0. */
int cli_next_option(int argc, char **argv, const char *short_options, const struct option *long_options);

/* Parse a whole argument; on failure print what is wrong with option `name` and return false. */
bool cli_parse_size(const char *name, const char *text, size_t minimum, size_t maximum, size_t *value);
bool cli_parse_u64(const char *name, const char *text, uint64_t *value);
bool cli_parse_number(const char *name, const char *text, double minimum, double maximum, double *value);
/* One of `count` words; *value is its index. */
bool cli_parse_word(const char *name, const char *text, size_t count, const char *const *words,
                    size_t *value);
/* N[,N...]: *values is allocated with malloc. */
bool cli_parse_sizes(const char *name, const char *text, size_t *count, size_t **values);

/* Warnings go to standard error as "aureole: warning: ..."; nothing when quiet. */
aur_warnings cli_warnings(bool quiet);
/* A progress bar with elapsed and remaining time, on a terminal only; none when quiet. An interrupt (SIGINT)
 * asks the work to stop once cli_progress has been called. */
aur_progress cli_progress(bool quiet);
/* Takes the bar off the terminal. */
void cli_progress_clear(void);

/* A table of results that prints as aligned text, CSV or a JSON array of objects. */
typedef enum cli_format { CLI_TABLE, CLI_CSV, CLI_JSON } cli_format;
bool cli_parse_format(const char *text, cli_format *format);

typedef struct cli_table cli_table;
/* Returns NULL when out of memory; the functions below accept NULL and then do nothing, and cli_table_print
 * fails. */
cli_table *cli_table_create(size_t column_count, const char *const *columns);
void cli_table_destroy(cli_table *table);
/* Cells fill the table row by row. Numbers are printed with `digits` significant digits in text, 17 in CSV
 * and JSON. */
void cli_table_text(cli_table *table, const char *text);
void cli_table_number(cli_table *table, double value, int digits);
void cli_table_integer(cli_table *table, uint64_t value);
/* Prints to standard output and returns the exit status (CLI_FAILURE when it cannot be written). */
int cli_table_print(const cli_table *table, cli_format format);
