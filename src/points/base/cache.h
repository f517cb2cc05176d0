/* Cache of expensive objects that several renders of a scene share, keyed by a string of everything that they
 * depend on. Not thread-safe. */
#pragma once

#include <aureole/core.h>

#include "points/base/error.h"

typedef struct aur_cache aur_cache;

/* NULL when out of memory. */
AUR_INTERNAL aur_cache *aur_cache_create(void);
AUR_INTERNAL void aur_cache_destroy(aur_cache *cache);

/* The object stored under `key`, or NULL. It lives as long as the cache. */
AUR_INTERNAL void *aur_cache_find(aur_cache *cache, const char *key);
/* Takes ownership of `value`, also on failure; it took `rays` to compute, and `destroy` frees it. Fails only
 * with AUR_ERROR_MEMORY. */
AUR_INTERNAL aur_result aur_cache_store(aur_cache *cache, const char *key, void *value, uint64_t rays,
                                        void (*destroy)(void *));

/* Counts the objects used and the rays that computed them, now or earlier: the reported cost of preparing a
 * render does not depend on which render computed an object. Zero-initialised. */
typedef struct aur_cache_uses {
    struct aur_cache_uses *outer; /* counts them, too; NULL: none */
    uint64_t rays;
    size_t count, capacity;
    const void **values;
} aur_cache_uses;

/* From here on objects found and stored are counted in `uses` (NULL: not counted). Returns the previous one.
 */
AUR_INTERNAL aur_cache_uses *aur_cache_count(aur_cache *cache, aur_cache_uses *uses);
AUR_INTERNAL void aur_cache_uses_release(aur_cache_uses *uses);
