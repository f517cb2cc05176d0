/* aureole lab run: the experiments one after the other. */
#pragma once

#include "program/cli/options.h"
#include "program/lab/lab.h"

typedef struct cli_lab {
    lab_options lab;
    cli_definitions definitions; /* parameters of experiments */
    const char *module;
    lab_paper_style paper;
    bool all, again, small;
    bool check;       /* compare what is run with the tables that are kept */
    const char *kept; /* the folder of those; NULL: ./docs/report/results, else that of the source tree */
    cli_common common;
} cli_lab;

/* "8 s", "12 min", "1 h 5 min". */
void cli_lab_duration(double seconds, char text[32]);
/* Runs experiments, and compares their tables with the kept ones with `check`. Returns the exit status. */
int cli_lab_run(cli_lab *command, size_t count, char **names);
