/* What a run has measured so far, in a file that outlives an interruption. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

typedef struct lab_kept lab_kept;

/* Takes up the file of a run of the same `identity` (a line), or begins it anew. Errors: WRITE, MEMORY. */
aur_result lab_kept_open(const char *path, const char *identity, lab_kept **kept, aur_error *error);
void lab_kept_close(lab_kept *kept); /* NULL is allowed */

/* Whether there is anything from an earlier run, and the processor seconds that it took. */
bool lab_kept_continues(const lab_kept *kept);
double lab_kept_seconds(const lab_kept *kept);

/* The numbers of a key; false when there are none. */
bool lab_kept_find(const lab_kept *kept, const char *key, size_t count, double *values);
/* `seconds` are all that the run has taken. Errors: WRITE. */
aur_result lab_kept_add(lab_kept *kept, const char *key, size_t count, const double *values, double seconds,
                        aur_error *error);
