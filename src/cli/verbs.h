/* What the verbs `help` and `completion` do with the table of all verbs, which main.c has. */
#pragma once

#include <aureole/tables.h>

#include "cli/cli.h"

int cli_help(size_t verb_count, const cli_verb *const *verbs, int argc, char **argv);

/* The tables of both libraries, one after the other; NULL beyond the last. */
const aur_table *cli_table_at(size_t index);
