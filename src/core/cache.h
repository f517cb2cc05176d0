/* Things that are costly to make and that several renders of one scene may share, found by a text that says
 * all that they depend on. Not for two threads at once. */
#pragma once

#include <aureole/core.h>

typedef struct aur_cache aur_cache;

/* NULL when out of memory. */
aur_cache *aur_cache_create(void);
void aur_cache_destroy(aur_cache *cache);

/* The thing stored under `key`, or NULL. It lives as long as the cache. */
void *aur_cache_find(const aur_cache *cache, const char *key);
/* Takes ownership of `thing` in every case; `destroy` ends it. Fails with AUR_ERROR_MEMORY only. */
aur_result aur_cache_store(aur_cache *cache, const char *key, void *thing, void (*destroy)(void *));
