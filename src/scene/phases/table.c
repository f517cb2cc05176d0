/* Every phase function by name. One new phase function is one new file and one line here. */
#include <stdlib.h>

#include "scene/phase.h"

#define PHASES(ROW)                                                                                          \
    ROW(isotropic)                                                                                           \
    ROW(hg)                                                                                                  \
    ROW(rayleigh)                                                                                            \
    ROW(tabphase)                                                                                            \
    ROW(blendphase)

#define DECLARE(name) extern const aur_phase_descriptor aur_phase_##name;
PHASES(DECLARE)

#define ADDRESS(name) &aur_phase_##name.row,
static const aur_row *const rows[] = {PHASES(ADDRESS)};

const aur_table aur_phase_table = {
    .kind = "phase", .summary = "phase functions: how media scatter light", AUR_TABLE_ROWS(rows)};

aur_result aur_phase_create(aur_parameters *parameters, aur_phase **phase, aur_error *error) {
    *phase = NULL;
    const aur_row *row;
    aur_result result = aur_table_find(&aur_phase_table, parameters, &row, error);
    if (result != AUR_OK)
        return result;
    const aur_phase_descriptor *const descriptor = (const aur_phase_descriptor *)row;
    aur_phase *const made = calloc(1, sizeof *made);
    if (made != NULL)
        made->data = calloc(1, descriptor->size + 1);
    if (made == NULL || made->data == NULL) {
        free(made);
        return aur_fail_memory_at(error, parameters->location);
    }
    made->descriptor = descriptor;
    result = aur_keys_read(row->key_count, row->keys, parameters, made->data, error);
    if (result == AUR_OK && descriptor->create != NULL)
        result = descriptor->create(parameters, made, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK) {
        aur_phase_destroy(made);
        return result;
    }
    *phase = made;
    return AUR_OK;
}

void aur_phase_destroy(aur_phase *phase) {
    if (phase == NULL)
        return;
    if (phase->descriptor->release != NULL)
        phase->descriptor->release(phase);
    free(phase->data);
    free(phase);
}
