#include "core/cache.h"

#include <stdlib.h>
#include <string.h>

typedef struct entry {
    struct entry *next;
    char *key;
    void *thing;
    void (*destroy)(void *);
} entry;

struct aur_cache {
    entry *first;
};

aur_cache *aur_cache_create(void) {
    return calloc(1, sizeof(aur_cache));
}

void aur_cache_destroy(aur_cache *cache) {
    if (cache == NULL)
        return;
    for (entry *at = cache->first; at != NULL;) {
        entry *const next = at->next;
        at->destroy(at->thing);
        free(at->key);
        free(at);
        at = next;
    }
    free(cache);
}

void *aur_cache_find(const aur_cache *cache, const char *key) {
    for (const entry *at = cache->first; at != NULL; at = at->next)
        if (strcmp(at->key, key) == 0)
            return at->thing;
    return NULL;
}

aur_result aur_cache_store(aur_cache *cache, const char *key, void *thing, void (*destroy)(void *)) {
    entry *const added = malloc(sizeof *added);
    char *const copy = strdup(key);
    if (added == NULL || copy == NULL) {
        free(added);
        free(copy);
        destroy(thing);
        return AUR_ERROR_MEMORY;
    }
    *added = (entry){.next = cache->first, .key = copy, .thing = thing, .destroy = destroy};
    cache->first = added;
    return AUR_OK;
}
