/* Functions common to all commands: errors, exit statuses, progress, result tables. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>

#include "program/cli/progress.h"
#include "program/report/report.h"

/* Exit statuses of the program. */
enum { CLI_SUCCESS = 0, CLI_DIFFERENCE = 1, CLI_BAD_INPUT = 2, CLI_FAILURE = 3 };

/* Prints "aureole: ..." on standard error and returns the exit status for the result. */
int cli_fail(const aur_error *error);
/* The same, or CLI_SUCCESS for AUR_OK. */
int cli_status(aur_result result, const aur_error *error);
/* The same for an error in the command line; returns CLI_BAD_INPUT. */
int cli_bad_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Opens an input file without blocking on a named pipe that has no writer. Rejects folders, devices and
 * pipes, except those that the shell passes as /dev/fd/N. NULL on failure. Errors: OPEN. */
FILE *cli_open_input(const char *path, aur_error *error);

/* Prints warnings on standard error as "aureole: warning: ..."; none when quiet. */
aur_warnings cli_warnings(bool quiet);
/* The command's progress bar with elapsed and remaining time, or lines without a terminal; none when quiet.
 */
aur_progress cli_progress(bool quiet);
/* The same for work whose partial result is saved: after its first report SIGINT and SIGTERM request a stop,
 * and a second signal terminates the program. Before the first report one signal terminates it. */
aur_progress cli_progress_of_resumable(bool quiet);
/* Sets the phases of the command after cli_progress. phases[count] must outlive the command; without this
 * call there is one phase. */
void cli_progress_plan(size_t count, const cli_phase *phases);
/* Starts phases[index]: for phases that the library's reports do not name. */
void cli_progress_begin(size_t index);
/* The completed fraction of the command, 0 to 1; it never decreases. */
double cli_progress_share(void);
/* Clears the bar. */
void cli_progress_clear(void);

/* Prints a table on standard output, destroys it, and returns the exit status. */
int cli_finish(report_table *table, report_format format);
