/* Cache of expensive objects that several renders of a scene share, keyed by a string of everything that they
 * depend on. Not thread-safe. */
#pragma once

#include <aureole/core.h>

#include "points/base/error.h"

typedef struct aur_cache aur_cache;

/* NULL when out of memory. */
AUR_INTERNAL aur_cache *aur_cache_create(void);
AUR_INTERNAL void aur_cache_destroy(aur_cache *cache);

/* The thing stored under `key`, or NULL. It lives as long as the cache. */
AUR_INTERNAL void *aur_cache_find(aur_cache *cache, const char *key);
/* Takes ownership of `thing`, which took so many rays to make, in every case; `destroy` ends it. Fails with
 * AUR_ERROR_MEMORY only. */
AUR_INTERNAL aur_result aur_cache_store(aur_cache *cache, const char *key, void *thing, uint64_t rays,
                                        void (*destroy)(void *));

/* Which things were used, and the rays that these took to make, now or earlier: what renders are prepared
 * with costs the same whichever was the first to ask for it. Zero at first. */
typedef struct aur_cache_uses {
    struct aur_cache_uses *outer; /* that counts them, too; NULL: none does */
    uint64_t rays;
    size_t count, capacity;
    const void **things;
} aur_cache_uses;

/* From here on things that are found and stored are counted in `uses` (NULL: nowhere). Returns where they
 * were before. */
AUR_INTERNAL aur_cache_uses *aur_cache_count(aur_cache *cache, aur_cache_uses *uses);
AUR_INTERNAL void aur_cache_uses_release(aur_cache_uses *uses);
