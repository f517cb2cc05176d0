/* What the verbs share: errors, exit statuses, progress, tables of results. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

/* The exit statuses of the command line. */
enum { CLI_SUCCESS = 0, CLI_DIFFERENCE = 1, CLI_BAD_INPUT = 2, CLI_FAILURE = 3 };

/* Prints "aureole: ..." on standard error and returns the exit status that belongs to the result. */
int cli_fail(const aur_error *error);
/* The same unless the result is AUR_OK: then CLI_SUCCESS. */
int cli_status(aur_result result, const aur_error *error);
/* The same for a mistake in the command line itself; returns CLI_BAD_INPUT. */
int cli_bad_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Warnings go to standard error as "aureole: warning: ..."; nothing when quiet. */
aur_warnings cli_warnings(bool quiet);
/* A progress bar with elapsed and remaining time, on a terminal only; none when quiet. An interrupt (SIGINT)
 * asks the work to stop once cli_progress has been called. */
aur_progress cli_progress(bool quiet);
/* Takes the bar off the terminal. */
void cli_progress_clear(void);

/* A table of results that prints as aligned text, CSV or a JSON array of objects. */
typedef enum cli_format { CLI_TABLE, CLI_CSV, CLI_JSON } cli_format;

typedef struct cli_table cli_table;
/* Returns NULL when out of memory; the functions below accept NULL and then do nothing, and cli_table_finish
 * fails. */
cli_table *cli_table_create(size_t column_count, const char *const *columns);
/* One more column, before the first cell. */
void cli_table_column(cli_table *table, const char *name);
void cli_table_destroy(cli_table *table);
/* Cells fill the table row by row. Numbers are printed with `digits` significant digits in text, 17 in CSV
 * and JSON. */
void cli_table_text(cli_table *table, const char *text);
void cli_table_number(cli_table *table, double value, int digits);
void cli_table_integer(cli_table *table, uint64_t value);
/* Prints to standard output, destroys the table, and returns the exit status. A table of one row that was
 * filled by the functions below is printed for people as a line a cell. */
int cli_table_finish(cli_table *table, cli_format format);

/* A column and its cell: what is known of one thing. */
void cli_fact_text(cli_table *table, const char *name, const char *text);
void cli_fact_number(cli_table *table, const char *name, double value);
