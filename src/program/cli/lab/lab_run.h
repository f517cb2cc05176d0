/* aureole lab run: runs experiments one after the other. */
#pragma once

#include "program/cli/options.h"
#include "program/lab/lab.h"

typedef struct cli_lab {
    lab_options lab;
    cli_definitions definitions; /* overrides parameters of experiments */
    const char *module;
    lab_paper_style paper;
    bool all, again, small;
    bool check;         /* compare the results with the stored tables */
    const char *stored; /* folder of those tables; NULL: docs/report/results here or in the source tree */
    cli_common common;
} cli_lab;

/* "8 s", "12 min", "1 h 5 min". */
void cli_lab_duration(double seconds, char text[32]);
/* Runs experiments and, with `check`, compares their tables with the stored ones. Returns the exit status. */
int cli_lab_run(cli_lab *command, size_t count, char **names);
