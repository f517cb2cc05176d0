/* What the commands share: errors, exit statuses, progress, tables of results. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>

#include "program/cli/progress.h"
#include "program/report/report.h"

/* The exit statuses of the command line. */
enum { CLI_SUCCESS = 0, CLI_DIFFERENCE = 1, CLI_BAD_INPUT = 2, CLI_FAILURE = 3 };

/* Prints "aureole: ..." on standard error and returns the exit status that belongs to the result. */
int cli_fail(const aur_error *error);
/* The same unless the result is AUR_OK: then CLI_SUCCESS. */
int cli_status(aur_result result, const aur_error *error);
/* The same for a mistake in the command line itself; returns CLI_BAD_INPUT. */
int cli_bad_usage(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Opens an input file without waiting for the writer of a named pipe. Folders, devices and pipes are refused,
 * except those that the shell passes as /dev/fd/N. NULL if the file cannot be read. Errors: OPEN. */
FILE *cli_open_input(const char *path, aur_error *error);

/* Warnings go to standard error as "aureole: warning: ..."; nothing when quiet. */
aur_warnings cli_warnings(bool quiet);
/* A command's one progress bar with elapsed and remaining time, or lines where there is no terminal; none
 * when quiet. */
aur_progress cli_progress(bool quiet);
/* The same for work of which something is kept when it ends early: from its first report on SIGINT and
 * SIGTERM ask it to stop, and a second signal ends the program; before, while files are read, the first one
 * does. */
aur_progress cli_progress_of_kept(bool quiet);
/* What the command does after cli_progress, in phases[count] that last as long as it; without it all is one
 * phase. */
void cli_progress_plan(size_t count, const cli_phase *phases);
/* Begins phases[index]: for phases that the library does not name. */
void cli_progress_begin(size_t index);
/* How much of the command is done, from 0 to 1; it never falls. */
double cli_progress_share(void);
/* Takes the bar off the terminal. */
void cli_progress_clear(void);

/* Prints a table to standard output, destroys it, and returns the exit status. */
int cli_finish(report_table *table, report_format format);
