#include "transport/radiosity/tally.h"

#include <stdlib.h>
#include <string.h>

aur_result aur_radiosity_tally_create(size_t patch_count, aur_radiosity_tally *tally, aur_error *error) {
    *tally =
        (aur_radiosity_tally){.patch_count = patch_count, .power = calloc(patch_count, sizeof *tally->power)};
    if (tally->power != NULL)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_MEMORY, "radiosity: out of memory for %zu patches", patch_count);
}

void aur_radiosity_tally_release(aur_radiosity_tally *tally) {
    free(tally->power);
    *tally = (aur_radiosity_tally){0};
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
