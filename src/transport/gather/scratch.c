#include "transport/gather/scratch.h"

#include <stdlib.h>
#include <string.h>

static size_t larger(size_t a, size_t b) {
    return a > b ? a : b;
}

aur_gather_scratch *aur_gather_scratch_create(const aur_gather_plan *plan) {
    size_t samples = 0, directions = 0;
    for (size_t i = 0; i < plan->rules.count; ++i) {
        const aur_gather_lobe_rule *const lobe = &plan->rules.lobes[i];
        if (lobe->merged != NULL)
            samples = larger(samples, aur_merged_rule_samples(lobe->merged));
        if (lobe->levels.count > 0)
            directions = larger(directions, lobe->rule.count);
    }
    aur_gather_scratch *const scratch = aligned_alloc(64, (sizeof *scratch + 63) / 64 * 64);
    if (scratch == NULL)
        return NULL;
    memset(scratch, 0, sizeof *scratch);
    aur_packet_clear(&scratch->rays.packet);
    scratch->merged = calloc(2 * samples * (AUR_PACKET_SIZE + 1) + 1, sizeof *scratch->merged);
    scratch->values = malloc((3 * AUR_PACKET_SIZE * directions + 1) * sizeof *scratch->values);
    if (scratch->merged != NULL && scratch->values != NULL)
        return scratch;
    aur_gather_scratch_destroy(scratch);
    return NULL;
}

void aur_gather_scratch_destroy(aur_gather_scratch *scratch) {
    if (scratch == NULL)
        return;
    free(scratch->merged);
    free(scratch->values);
    free(scratch);
}
