/* What a long render keeps in a file: what it is of, how far it has come, and its films. */
#pragma once

#include "render/film/film.h"

typedef struct aur_checkpoint {
    /* What the films are of, a line "KEY VALUE" each: a render goes on only from one with the same lines. */
    char *identity;
    size_t word_count;
    uint64_t *words; /* numbers of whoever made it */
    size_t film_count;
    aur_film **films;
} aur_checkpoint;

/* Replaces the file whole or not at all. Errors: WRITE, MEMORY. */
aur_result aur_checkpoint_save(const char *path, const char *identity, size_t word_count,
                               const uint64_t *words, size_t film_count, const aur_film *const *films,
                               aur_error *error);
/* To be released in every case. `input`: what must not be replaced (points/base/file_roles.h), unlike a
 * checkpoint to go on from. Errors: OPEN, FORMAT, MEMORY; ARGUMENT for an input that is an output. */
aur_result aur_checkpoint_load(const char *path, bool input, aur_checkpoint *checkpoint, aur_error *error);
aur_result aur_checkpoint_load_memory(const char *name, size_t size, const void *data,
                                      aur_checkpoint *checkpoint, aur_error *error);
void aur_checkpoint_release(aur_checkpoint *checkpoint);

/* Whether two texts say the same of what is rendered; lines that begin with `but` may differ (NULL: none).
 * The error, ARGUMENT, names `path` and the first line that differs. */
aur_result aur_identity_compare(const char *path, const char *kept, const char *wanted, const char *but,
                                aur_error *error);
/* The value of a key's line, or NULL; *length is its length. */
const char *aur_identity_find(const char *identity, const char *key, size_t *length);
