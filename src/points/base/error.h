/* Filling aur_error: each returns the result that it was given, so that `return aur_fail(...)` reads well. */
#pragma once

#include <aureole/core.h>

/* Where in a file something stands; file may be NULL, line and column 0 when unknown. */
typedef struct aur_location {
    const char *file;
    size_t line;
    size_t column;
} aur_location;

/* aur_fail, which core.h declares, with a place. */
aur_result aur_fail_at(aur_error *error, aur_location location, aur_result result, const char *format, ...)
    AUR_PRINTF(4, 5);

/* Names `file` in an error that names none, unless the result is AUR_OK; returns the result. */
aur_result aur_fail_in(aur_error *error, aur_result result, const char *file);

/* Sends one formatted warning, if anyone listens; a location is put before it as in aur_error_format. */
void aur_warn_at(const aur_warnings *warnings, aur_location location, const char *format, ...)
    AUR_PRINTF(3, 4);

/* Warns of what an error says, where there is one: others like it are to be told of too. */
void aur_warn_error(const aur_warnings *warnings, const aur_error *error);

/* The one wording for memory that is not to be had. */
aur_result aur_fail_memory(aur_error *error);
aur_result aur_fail_memory_at(aur_error *error, aur_location location);
