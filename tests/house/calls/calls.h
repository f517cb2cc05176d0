/* Shared by the programs of tests/house/calls. They use only the public headers and the shared libraries. */
#pragma once

#include <aureole/core.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the program if a call did not behave as expected. */
static inline void require(bool good, const char *what) {
    if (good)
        return;
    fprintf(stderr, "%s\n", what);
    exit(1);
}

/* A call that must succeed. */
static inline void accept(aur_result result, const aur_error *error) {
    require(result == AUR_OK, error->message);
}

/* A call that must fail with a message. */
static inline void refuse(aur_result result, aur_result expected, aur_error *error) {
    if (result != expected)
        fprintf(stderr, "'%s' came in the place of '%s': ", aur_result_string(result),
                aur_result_string(expected));
    require(result == expected && error->message[0] != '\0', error->message);
    *error = (aur_error){0};
}
