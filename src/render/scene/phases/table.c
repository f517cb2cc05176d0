/* Every phase function by name. One new phase function is one new file and one line here. */
#include <stdlib.h>
#include <string.h>

#include "render/scene/phase.h"

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

/* A blend that names another one twice, in a chain of such, is asked 2^n times. */
enum { MOST_ASKED = 1 << 12 };

static aur_result count_asked(const aur_parameters *parameters, aur_phase *phase, aur_error *error) {
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->kind == AUR_PARAMETER_OBJECT && strcmp(item->object_kind, "phase") == 0)
            phase->asked += 1 + ((const aur_phase *)item->object)->asked;
    }
    return phase->asked < MOST_ASKED
               ? AUR_OK
               : aur_fail_at(
                     error, parameters->location, AUR_ERROR_UNSUPPORTED,
                     "phase '%s' has %zu phase functions inside, counted as often as they are named, and at "
                     "most %d can be rendered",
                     parameters->plugin, phase->asked, (int)MOST_ASKED - 1);
}

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
    result = count_asked(parameters, made, error);
    if (result == AUR_OK)
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
