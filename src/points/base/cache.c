#include "points/base/cache.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

typedef struct entry {
    struct entry *next;
    char *key;
    void *value;
    void (*destroy)(void *);
    uint64_t rays;
} entry;

struct aur_cache {
    entry *first;
    aur_cache_uses *uses;
};

aur_cache *aur_cache_create(void) {
    return calloc(1, sizeof(aur_cache));
}

void aur_cache_destroy(aur_cache *cache) {
    if (cache == NULL)
        return;
    for (entry *at = cache->first; at != NULL;) {
        entry *const next = at->next;
        at->destroy(at->value);
        free(at->key);
        free(at);
        at = next;
    }
    free(cache);
}

static bool has(const aur_cache_uses *uses, const void *value) {
    for (size_t i = 0; i < uses->count; ++i)
        if (uses->values[i] == value)
            return true;
    return false;
}

static void count(aur_cache *cache, const entry *used) {
    for (aur_cache_uses *uses = cache->uses; uses != NULL; uses = uses->outer)
        if (!has(uses, used->value) &&
            aur_array_reserve(&uses->values, &uses->capacity, uses->count + 1, sizeof *uses->values)) {
            uses->values[uses->count++] = used->value;
            uses->rays += used->rays;
        }
}

aur_cache_uses *aur_cache_count(aur_cache *cache, aur_cache_uses *uses) {
    aur_cache_uses *const before = cache->uses;
    cache->uses = uses;
    return before;
}

void aur_cache_uses_release(aur_cache_uses *uses) {
    free(uses->values);
    *uses = (aur_cache_uses){0};
}

void *aur_cache_find(aur_cache *cache, const char *key) {
    for (const entry *at = cache->first; at != NULL; at = at->next)
        if (strcmp(at->key, key) == 0) {
            count(cache, at);
            return at->value;
        }
    return NULL;
}

aur_result aur_cache_store(aur_cache *cache, const char *key, void *value, uint64_t rays,
                           void (*destroy)(void *)) {
    entry *const added = malloc(sizeof *added);
    char *const copy = strdup(key);
    if (added == NULL || copy == NULL) {
        free(added);
        free(copy);
        destroy(value);
        return AUR_ERROR_MEMORY;
    }
    *added = (entry){.next = cache->first, .key = copy, .value = value, .destroy = destroy, .rays = rays};
    cache->first = added;
    count(cache, added);
    return AUR_OK;
}
