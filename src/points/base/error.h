/* Filling aur_error: each returns the result that it was given, so that `return aur_fail(...)` reads well. */
#pragma once

#include <aureole/core.h>

/* Marks what a library shows to the other libraries of this tree. Such names have a symbol version of one
 * release, so that no other program can come to depend on them, and public headers have none of them. */
#define AUR_INTERNAL AUR_API

/* Where in a file something stands; file may be NULL, line and column 0 when unknown. */
typedef struct aur_location {
    const char *file;
    size_t line;
    size_t column;
} aur_location;

/* aur_fail, which core.h declares, with a place. */
AUR_INTERNAL aur_result aur_fail_at(aur_error *error, aur_location location, aur_result result,
                                    const char *format, ...) AUR_PRINTF(4, 5);

/* Names `file` in an error that names none, unless the result is AUR_OK; returns the result. */
AUR_INTERNAL aur_result aur_fail_in(aur_error *error, aur_result result, const char *file);

/* Sends one formatted warning, if anyone listens; a location is put before it as in aur_error_format. */
AUR_INTERNAL void aur_warn_at(const aur_warnings *warnings, aur_location location, const char *format, ...)
    AUR_PRINTF(3, 4);

/* Warns of what an error says, where there is one: others like it are to be told of too. */
AUR_INTERNAL void aur_warn_error(const aur_warnings *warnings, const aur_error *error);

/* Out-of-memory error. */
AUR_INTERNAL aur_result aur_fail_memory(aur_error *error);
AUR_INTERNAL aur_result aur_fail_memory_at(aur_error *error, aur_location location);

/* Option structs that can grow. The first field of such a struct is `size_t size`, the caller's sizeof, so
 * that a program that was compiled with an older or a newer header than the library's is understood. */

/* Reads the caller's options into the library's own struct of `own_size` bytes, which holds the defaults.
 * `given` NULL leaves them as they are. Fields that the caller's struct does not have keep their defaults.
 * Fields that only the caller knows must be zero, else the library would ignore a wish: UNSUPPORTED. A size
 * that no struct with this first field has (0, or no multiple of it) is an ARGUMENT error: it was not set.
 * `what` names the struct in messages. */
AUR_INTERNAL aur_result aur_options_read(const void *given, size_t own_size, void *own, const char *what,
                                         aur_error *error);

/* Fills the caller's description struct, whose `size` field the caller has set, from the library's own one of
 * `own_size` bytes: what both know is copied, what only the caller knows is zero. ARGUMENT as above. */
AUR_INTERNAL aur_result aur_description_write(const void *own, size_t own_size, void *given, const char *what,
                                              aur_error *error);
