/* Option structs that can grow. The first field of such a struct is `size_t size`, the caller's sizeof, so
 * that a program that was compiled with an older or a newer header than the library's is understood. */
#pragma once

#include "points/base/error.h"

/* Reads the caller's options into the library's own struct of `own_size` bytes, which holds the defaults.
 * `given` NULL leaves them as they are. Fields that the caller's struct does not have keep their defaults.
 * Fields that only the caller knows must be zero, else the library would ignore a wish: UNSUPPORTED. A size
 * that no struct with this first field has (0, or no multiple of it) is an ARGUMENT error: it was not set.
 * `what` names the struct in messages. */
aur_result aur_options_read(const void *given, size_t own_size, void *own, const char *what,
                            aur_error *error);

/* Fills the caller's description struct, whose `size` field the caller has set, from the library's own one of
 * `own_size` bytes: what both know is copied, what only the caller knows is zero. ARGUMENT as above. */
aur_result aur_description_write(const void *own, size_t own_size, void *given, const char *what,
                                 aur_error *error);
