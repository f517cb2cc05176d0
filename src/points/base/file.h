/* Files that are replaced whole or not at all, and reading a whole file. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>

#include "points/base/error.h"

/* A file that is being written beside its destination. "-" is standard output. */
typedef struct aur_file_writer {
    FILE *stream;    /* write here; buffered */
    char *path;      /* what is replaced: links are followed */
    bool nameless;   /* the file has no name before the commit */
    bool unsynced;   /* may be set before the commit: a loss of power may damage the file */
    char *temporary; /* the name before the commit of a file that has one; else NULL */
} aur_file_writer;

/* Opens `path` for replacement by a file with the same mode, owner and group, as far as these may be given.
 * Where the system has files without a name the new one has none until it is complete, so that a killed
 * process leaves nothing behind. Pipes, devices and links to nothing are written as they are. On failure
 * nothing is left behind and *writer is zero. */
AUR_INTERNAL aur_result aur_file_open(const char *path, aur_file_writer *writer, aur_error *error);

/* Flushes, syncs and renames. On any failure (a full disk, say) the temporary file is removed, the
 * destination is as it was, and AUR_ERROR_WRITE is returned with the path and the reason. Ends the writer in
 * every case. */
AUR_INTERNAL aur_result aur_file_commit(aur_file_writer *writer, aur_error *error);

/* Removes the temporary file. Safe on a zero writer and after a commit. */
AUR_INTERNAL void aur_file_abandon(aur_file_writer *writer);

/* Reads all of `path` ("-": standard input) into *data, allocated with malloc and followed by a zero byte
 * that is not counted. Refuses files beyond `limit` bytes, and what is neither a regular file nor handed over
 * by the shell as /dev/fd/N: opening a pipe could block forever, a device might never end. Of several
 * processes (io.h) one reads, and writes, for all. Errors: OPEN, FORMAT, MEMORY;
 * ARGUMENT for an output of this process. */
AUR_INTERNAL aur_result aur_file_read(const char *path, size_t limit, char **data, size_t *size,
                                      aur_error *error);
/* The same for a file that this program wrote and may replace, such as a checkpoint: no input. */
AUR_INTERNAL aur_result aur_file_read_back(const char *path, size_t limit, char **data, size_t *size,
                                           aur_error *error);

/* stat(2), likewise; false where there is no such file. */
AUR_INTERNAL bool aur_file_status(const char *path, struct stat *status);

/* Which files this process reads and which it writes, so that no output replaces an input. Nothing is
 * recorded before aur_file_announce_output (core.h) has been called. Files are compared by device and inode.
 */

/* Records an input file; its errors, ARGUMENT, name `path` where it was announced as an output. */
aur_result aur_file_note_input(const char *path, const struct stat *status, aur_error *error);

/* Whether `path`, which has this status, was read as an input: ARGUMENT. */
aur_result aur_file_refuse_input(const char *path, const struct stat *status, aur_error *error);

/* Results that later runs may share, in files: each is found by a kind (a word) and a key, a text that says
 * all that it depends on. The folder is the value of the environment variable AUREOLE_CACHE, else aureole in
 * XDG_CACHE_HOME, else .cache/aureole in HOME; an empty AUREOLE_CACHE means that nothing is read or kept.
 *
 * Nothing here is an error: what cannot be read, or is not what was written, is as if it were not there, and
 * what cannot be written is not kept. Any number of processes and threads may do both at once. */

/* What was kept: data[*size] from malloc, with a zero byte behind it that is not counted; or NULL. */
AUR_INTERNAL char *aur_cache_file_read(const char *kind, const char *key, size_t *size);
/* Files of the cache that were not used for the longest time are removed until all have no more than the
 * limit together: AUREOLE_CACHE_MIB, 1024 unless it is set. Data of more than a quarter of it are not kept.
 */
AUR_INTERNAL void aur_cache_file_write(const char *kind, const char *key, size_t size, const void *data);

/* Stands for this build of the program and of every library that is loaded, but for those of modules, for
 * keys of what follows from their code; 0 where the system does not tell: then nothing that does may be kept.
 */
AUR_INTERNAL uint64_t aur_build_identity(void);

/* Modules: what stands beside the libraries in a file of its own, so that only those who need it pay for what
 * it links. A build may lack one. */

/* The function `symbol` of the module `file`, searched for in the folder of the library and then in the
 * system's path; NULL if it is not found. `global`: RTLD_GLOBAL, so that libraries that the module loads see
 * its symbols. A module stays loaded until the process ends. */
void (*aur_module_find(const char *file, const char *symbol, bool global))(void);

/* The path of a program of ours that stands beside the library; false where there is none. */
AUR_INTERNAL bool aur_module_find_program(const char *file, size_t capacity, char *path) AUR_NONNULL(1, 3);
