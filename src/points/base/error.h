/* Functions that fill aur_error. Each returns its result argument, for `return aur_fail(...)`. */
#pragma once

#include <aureole/core.h>

/* Marks symbols that a library exports to the other libraries of this tree. Their symbol version changes with
 * each release, so that no other program can depend on them. Public headers have none of them. */
#define AUR_INTERNAL AUR_API

/* A location in a file; file may be NULL, line and column 0 when unknown. */
typedef struct aur_location {
    const char *file;
    size_t line;
    size_t column;
} aur_location;

/* aur_fail (core.h) with a location. */
AUR_INTERNAL aur_result aur_fail_at(aur_error *error, aur_location location, aur_result result,
                                    const char *format, ...) AUR_PRINTF(4, 5);

/* Adds `file` to an error without a file, unless the result is AUR_OK; returns the result. */
AUR_INTERNAL aur_result aur_fail_in(aur_error *error, aur_result result, const char *file);

/* Sends one formatted warning, if there is a callback, with the location before it as in aur_error_format. */
AUR_INTERNAL void aur_warn_at(const aur_warnings *warnings, aur_location location, const char *format, ...)
    AUR_PRINTF(3, 4);

/* Reports an error, if there is one, as a warning, so that the caller can continue with further errors. */
AUR_INTERNAL void aur_warn_error(const aur_warnings *warnings, const aur_error *error);

/* Out-of-memory error. */
AUR_INTERNAL aur_result aur_fail_memory(aur_error *error);
AUR_INTERNAL aur_result aur_fail_memory_at(aur_error *error, aur_location location);

/* Option structs that can grow. The first field of such a struct is `size_t size`, the caller's sizeof, so
 * that programs compiled with an older or newer header work. */

/* Copies the caller's options into the library's struct of `library_size` bytes, which contains the defaults.
 * `given` may be NULL. Fields beyond the caller's struct keep their defaults. Fields beyond the library's
 * struct must be zero, since the library cannot apply them: UNSUPPORTED. A size of 0 or not a multiple of
 * sizeof(size_t) was not set: ARGUMENT. `what` names the struct in messages. */
AUR_INTERNAL aur_result aur_options_read(const void *given, size_t library_size, void *library,
                                         const char *what, aur_error *error);

/* Fills the caller's description struct, whose `size` the caller has set, from the library's struct of
 * `library_size` bytes. Common fields are copied; fields beyond the library's struct become zero. ARGUMENT as
 * above. */
AUR_INTERNAL aur_result aur_description_write(const void *library, size_t library_size, void *given,
                                              const char *what, aur_error *error);
