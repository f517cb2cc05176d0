/* The papers' experiments: each is one file in lab/<author-year>/ and one line in the table of lab.c, made
 * from public API calls only (aureole-lab/lab.h).
 */
#pragma once

#include <aureole-lab/lab.h>

#include "program/report/report.h"

/* Those of the table, and those that lab_add_experiments added. */
size_t lab_experiment_count(void);
const lab_experiment *lab_experiment_at(size_t index); /* NULL beyond the table */

/* Whether its results are in the folder already, made by this version with the same options. */
bool lab_is_finished(const lab_experiment *experiment, const lab_options *options);
