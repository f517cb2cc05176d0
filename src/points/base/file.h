/* Atomic replacement of files, and reading whole files. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>

#include "points/base/error.h"

/* A file being written next to its destination. "-" is standard output. */
typedef struct aur_file_writer {
    FILE *stream;    /* write here; buffered */
    char *path;      /* destination, with links resolved */
    bool nameless;   /* the file has no name before the commit */
    bool unsynced;   /* may be set before the commit: a loss of power may damage the file */
    char *temporary; /* name before the commit; NULL if nameless */
} aur_file_writer;

/* Opens `path` for replacement by a file with the same mode, owner and group, as far as permitted. If the
 * system supports it, the new file has no name until it is complete, so that a killed process leaves nothing
 * behind. Pipes, devices and dangling links are written in place. On failure nothing is left behind and
 * *writer is zero. */
AUR_INTERNAL aur_result aur_file_open(const char *path, aur_file_writer *writer, aur_error *error);

/* Flushes, syncs and renames. On any failure (a full disk, say) the temporary file is removed, the
 * destination is unchanged, and AUR_ERROR_WRITE is returned with the path and the reason. Ends the writer in
 * every case. */
AUR_INTERNAL aur_result aur_file_commit(aur_file_writer *writer, aur_error *error);

/* Removes the temporary file. Safe on a zero writer and after a commit. */
AUR_INTERNAL void aur_file_abandon(aur_file_writer *writer);

/* Reads all of `path` ("-": standard input) into *data, allocated with malloc and followed by a zero byte
 * that is not counted. Fails for files of more than `limit` bytes, and for everything but regular files and
 * /dev/fd/N of the shell: opening a pipe could block forever, a device might never end. With several
 * processes (io.h) one reads and writes for all. Errors: OPEN, FORMAT, MEMORY; ARGUMENT for an output of this
 * process. */
AUR_INTERNAL aur_result aur_file_read(const char *path, size_t limit, char **data, size_t *size,
                                      aur_error *error);
/* The same for a file that this program wrote and may replace, such as a checkpoint; it is not recorded as an
 * input. */
AUR_INTERNAL aur_result aur_file_read_back(const char *path, size_t limit, char **data, size_t *size,
                                           aur_error *error);

/* stat(2) with several processes; false if there is no such file. */
AUR_INTERNAL bool aur_file_status(const char *path, struct stat *status);

/* Which files this process reads and which it writes, so that no output replaces an input. Nothing is
 * recorded before aur_file_announce_output (core.h) has been called. Files are compared by device and inode.
 */

/* Records an input file; its errors, ARGUMENT, name `path` where it was announced as an output. */
aur_result aur_file_note_input(const char *path, const struct stat *status, aur_error *error);

/* ARGUMENT if `path`, which has this status, was read as an input. */
aur_result aur_file_refuse_input(const char *path, const struct stat *status, aur_error *error);

/* Results cached in files for later runs: each is found by a kind (a word) and a key, a text of everything
 * that it depends on. The folder is the value of the environment variable AUREOLE_CACHE, else aureole in
 * XDG_CACHE_HOME, else .cache/aureole in HOME; an empty AUREOLE_CACHE disables the cache.
 *
 * Nothing here is an error: unreadable or damaged files count as missing, and data that cannot be written is
 * dropped. Any number of processes and threads may read and write at once. */

/* The stored data[*size] from malloc, followed by a zero byte that is not counted; or NULL. */
AUR_INTERNAL char *aur_cache_file_read(const char *kind, const char *key, size_t *size);
/* The least recently used files of the cache are removed until its total size is at most AUREOLE_CACHE_MIB
 * (default 1024). Data of more than a quarter of the limit is not stored. */
AUR_INTERNAL void aur_cache_file_write(const char *kind, const char *key, size_t size, const void *data);

/* Identifies this build of the program and of all loaded libraries except those of modules, for keys of data
 * that depends on their code. 0 if the system does not report it: such data must not be cached then. */
AUR_INTERNAL uint64_t aur_build_identity(void);

/* Modules: separate shared objects next to the libraries, loaded on demand for their dependencies. A build
 * may lack one. */

/* The function `symbol` of the module `file`, searched for in the folder of the library and then in the
 * system's path; NULL if it is not found. `global`: RTLD_GLOBAL, so that libraries that the module loads see
 * its symbols. A module stays loaded until the process ends. */
void (*aur_module_find(const char *file, const char *symbol, bool global))(void);

/* The path of one of our programs next to the library; false if there is none. */
AUR_INTERNAL bool aur_module_find_program(const char *file, size_t capacity, char *path) AUR_NONNULL(1, 3);
