/* Tests that take long under sanitizers. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>

/* Whether a test may leave out cases that enter no code which others do not: set by the tree's option of that
 * name. */
static inline bool check_short(void) {
    return getenv("AUREOLE_SHORT_TESTS") != NULL;
}
