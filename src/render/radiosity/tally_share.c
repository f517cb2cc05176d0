/* Tallies of several processes, added up. */
#include "points/base/bytes.h"
#include "points/base/io.h"
#include "render/radiosity/walk.h"

typedef struct counters {
    aur_exact_sum last, rest;
    uint64_t rays, lost, behind, trapped, cut, not_finite;
} counters;

static void put(const aur_radiosity_tally *tally, aur_bytes *bytes) {
    const counters counted = {tally->last,   tally->rest,    tally->rays, tally->lost,
                              tally->behind, tally->trapped, tally->cut,  tally->not_finite};
    aur_bytes_put(bytes, sizeof counted, &counted);
    aur_bytes_put(bytes, tally->patch_count * sizeof *tally->power, tally->power);
}

static void get(aur_bytes_reader *reader, aur_radiosity_tally *tally) {
    counters counted;
    aur_bytes_get(reader, sizeof counted, &counted);
    aur_bytes_get(reader, tally->patch_count * sizeof *tally->power, tally->power);
    tally->last = counted.last;
    tally->rest = counted.rest;
    tally->rays = counted.rays;
    tally->lost = counted.lost;
    tally->behind = counted.behind;
    tally->trapped = counted.trapped;
    tally->cut = counted.cut;
    tally->not_finite = counted.not_finite != 0;
}

static uint64_t rays_of(size_t count, const aur_radiosity_tally *tallies) {
    uint64_t rays = 0;
    for (size_t i = 0; i < count; ++i)
        rays += tallies[i].rays;
    return rays;
}

typedef struct sum {
    size_t count;
    aur_radiosity_tally *tallies;
} sum;

static aur_result add(void *context, size_t rank, size_t size, const void *data) {
    const sum *const total = context;
    aur_bytes_reader reader = {.at = data, .end = (const unsigned char *)data + size};
    aur_radiosity_tally *other;
    (void)rank;
    const aur_result result = aur_radiosity_tallies_create(1, total->tallies->patch_count, &other, NULL);
    for (size_t i = 0; i < total->count && result == AUR_OK; ++i) {
        get(&reader, other);
        total->tallies[i].not_finite |= other->not_finite;
        aur_radiosity_tally_take(&total->tallies[i], other);
    }
    aur_radiosity_tallies_release(1, other);
    return result != AUR_OK ? result : reader.failed ? AUR_ERROR_INTERNAL : AUR_OK;
}

aur_result aur_radiosity_tallies_share(size_t count, aur_radiosity_tally *tallies, aur_error *error) {
    const aur_io *const io = aur_io_here();
    if (io == NULL)
        return AUR_OK;
    aur_bytes bytes = {0};
    const uint64_t before = rays_of(count, tallies);
    sum total = {count, tallies};
    for (size_t i = 0; i < count; ++i)
        put(&tallies[i], &bytes);
    aur_result result = bytes.failed ? aur_fail_memory(error)
                                     : io->gather(io->user, bytes.size, bytes.data, add, &total, error);
    bytes.size = 0;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        put(&tallies[i], &bytes);
    char *all = (char *)bytes.data;
    size_t size = bytes.size;
    if (result == AUR_OK)
        result = io->share(io->user, &all, &size, error);
    if (result == AUR_OK && io->rank != 0) {
        aur_bytes_reader reader = {.at = (unsigned char *)all, .end = (unsigned char *)all + size};
        for (size_t i = 0; i < count; ++i)
            get(&reader, &tallies[i]);
        free(all);
    }
    aur_rays_traced += rays_of(count, tallies) - before;
    aur_bytes_release(&bytes);
    return result;
}
