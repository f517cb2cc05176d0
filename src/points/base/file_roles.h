/* Which files this process reads and which it writes, so that no output replaces an input. Nothing is
 * recorded before aur_file_announce_output (core.h) has been called. Files are compared by device and inode.
 */
#pragma once

#include <sys/stat.h>

#include "points/base/error.h"

/* Records an input file; its errors, ARGUMENT, name `path` where it was announced as an output. */
aur_result aur_file_note_input(const char *path, const struct stat *status, aur_error *error);

/* Whether `path`, which has this status, was read as an input: ARGUMENT. */
aur_result aur_file_refuse_input(const char *path, const struct stat *status, aur_error *error);
