/* Results that later runs may share, in files: each is found by a kind (a word) and a key, a text that says
 * all that it depends on. The folder is the value of the environment variable AUREOLE_CACHE, else aureole in
 * XDG_CACHE_HOME, else .cache/aureole in HOME; an empty AUREOLE_CACHE means that nothing is read or kept.
 *
 * Nothing here is an error: what cannot be read, or is not what was written, is as if it were not there, and
 * what cannot be written is not kept. Any number of processes and threads may do both at once. */
#pragma once

#include <stddef.h>
#include <stdint.h>

/* What was kept: data[*size] from malloc, with a zero byte behind it that is not counted; or NULL. */
char *aur_cache_file_read(const char *kind, const char *key, size_t *size);
/* Files of the cache that were not used for the longest time are removed until all have no more than the
 * limit together: AUREOLE_CACHE_MIB, 1024 unless it is set. Data of more than a quarter of it are not kept.
 */
void aur_cache_file_write(const char *kind, const char *key, size_t size, const void *data);

/* Stands for this build of the program and of every library that is loaded, but for those of MPI, for keys of
 * what follows from their code; 0 where the system does not tell: then nothing that does may be kept. */
uint64_t aur_build_identity(void);
