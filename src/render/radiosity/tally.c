#include "render/radiosity/walk.h"

#include <stdlib.h>
#include <string.h>

aur_result aur_radiosity_tallies_create(size_t count, size_t patch_count, aur_radiosity_tally **tallies,
                                        aur_error *error) {
    bool good = (*tallies = calloc(count, sizeof **tallies)) != NULL;
    for (size_t i = 0; i < count && good; ++i) {
        aur_radiosity_tally *const tally = &(*tallies)[i];
        tally->patch_count = patch_count;
        tally->power = calloc(patch_count, sizeof *tally->power);
        good = tally->power != NULL;
    }
    if (good)
        return AUR_OK;
    aur_radiosity_tallies_release(count, *tallies);
    *tallies = NULL;
    return aur_fail(error, AUR_ERROR_MEMORY, "radiosity: out of memory for %zu patches", patch_count);
}

void aur_radiosity_tallies_release(size_t count, aur_radiosity_tally *tallies) {
    for (size_t i = 0; tallies != NULL && i < count; ++i)
        free(tallies[i].power);
    free(tallies);
}

void aur_radiosity_tally_take(aur_radiosity_tally *tally, aur_radiosity_tally *other) {
    for (size_t i = 0; i < tally->patch_count; ++i)
        for (size_t c = 0; c < 3; ++c)
            aur_exact_merge(&tally->power[i][c], &other->power[i][c]);
    aur_exact_merge(&tally->last, &other->last);
    aur_exact_merge(&tally->rest, &other->rest);
    tally->rays += other->rays;
    tally->lost += other->lost;
    tally->behind += other->behind;
    tally->trapped += other->trapped;
    tally->cut += other->cut;
    memset(other->power, 0, other->patch_count * sizeof *other->power);
    *other = (aur_radiosity_tally){.patch_count = other->patch_count, .power = other->power};
}
