/* Parts of an image, put together. */
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/text.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

aur_result aur_render_check_kind(const char *path, const aur_checkpoint *checkpoint, aur_error *error) {
    if (checkpoint->film_count == 1 && checkpoint->word_count == AUR_SPENT_WORDS)
        return AUR_OK;
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                       "of another render: it was made to an error, a time or a number of rays");
}

typedef struct merger {
    aur_film *film;     /* of all parts so far */
    char *identity;     /* of the first part */
    size_t count;       /* of parts that there are */
    const char **paths; /* by the part's number from 0 on; NULL: not read yet */
} merger;

static bool read_number(const char *identity, const char *key, size_t *numbers, size_t capacity) {
    size_t length = 0;
    const char *at = aur_identity_find(identity, key, &length);
    for (size_t i = 0; i < capacity && at != NULL; ++i) {
        uint64_t value = 0;
        at = aur_read_integer(at, UINT32_MAX, &value);
        numbers[i] = (size_t)value;
        if (at != NULL && i + 1 < capacity)
            at = *at == '/' ? at + 1 : NULL;
    }
    return at != NULL;
}

/* Whether the part has all its samples, and none in tiles of other parts. */
static bool is_finished(const aur_film *film, size_t part, size_t count, size_t samples) {
    for (size_t i = 0; i < aur_film_unit_count(film); ++i)
        if (aur_film_unit_given(film, i) != (aur_film_unit_tile(film, i) % count == part ? samples : 0))
            return false;
    return true;
}

static aur_result add_part(merger *all, const char *path, aur_checkpoint *part, aur_error *error) {
    const aur_location where = {.file = path};
    size_t shard[2] = {1, 1}, samples = 0;
    (void)read_number(part->identity, "shard", shard, 2);
    if (!read_number(part->identity, "samples_per_pixel", &samples, 1) || shard[0] == 0 ||
        shard[0] > shard[1])
        return aur_fail_at(error, where, AUR_ERROR_FORMAT, "not a part of an image");
    if (all->film == NULL) {
        all->count = shard[1];
        all->paths = calloc(all->count, sizeof *all->paths);
        if (all->paths == NULL)
            return aur_fail_memory(error);
        all->identity = part->identity;
        part->identity = NULL;
    } else if (shard[1] != all->count) {
        return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                           "it is one of %zu parts, the first file is one of %zu", shard[1], all->count);
    } else {
        const aur_result result = aur_identity_compare(path, part->identity, all->identity, "shard ", error);
        if (result != AUR_OK)
            return result;
    }
    const char **const entry = &all->paths[shard[0] - 1];
    if (*entry != NULL)
        return aur_fail_at(error, where, AUR_ERROR_ARGUMENT, "part %zu of %zu is given twice: also %s",
                           shard[0], shard[1], *entry);
    *entry = path;
    if (!is_finished(part->films[0], shard[0] - 1, shard[1], samples))
        return aur_fail_at(error, where, AUR_ERROR_ARGUMENT,
                           "part %zu of %zu is not finished: render it on with --resume", shard[0], shard[1]);
    if (all->film != NULL)
        return aur_fail_in(error, aur_film_merge(all->film, part->films[0], error), path);
    all->film = part->films[0];
    part->films[0] = NULL;
    return AUR_OK;
}

static aur_result check_all(const merger *all, aur_error *error) {
    for (size_t i = 0; i < all->count; ++i)
        if (all->paths[i] == NULL)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "part %zu of %zu is missing", i + 1, all->count);
    return AUR_OK;
}

aur_result aur_render_merge_parts(size_t count, const char *const *paths, aur_film **film, aur_error *error) {
    merger all = {0};
    *film = NULL;
    aur_result result =
        count > 0 ? AUR_OK : aur_fail(error, AUR_ERROR_ARGUMENT, "an image has at least one part");
    for (size_t i = 0; result == AUR_OK && i < count; ++i) {
        aur_checkpoint part;
        result = aur_checkpoint_load(paths[i], true, &part, error);
        if (result == AUR_OK)
            result = aur_render_check_kind(paths[i], &part, error);
        if (result == AUR_OK)
            result = add_part(&all, paths[i], &part, error);
        aur_checkpoint_release(&part);
    }
    if (result == AUR_OK)
        result = check_all(&all, error);
    if (result == AUR_OK)
        *film = all.film;
    else
        aur_film_destroy(all.film);
    free(all.paths);
    free(all.identity);
    return result;
}
