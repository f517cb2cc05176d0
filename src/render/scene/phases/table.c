/* Every phase function by name. To add a phase function: one new file, and one line here. */
#include <stddef.h>
#include <string.h>

#include "render/scene/phase.h"
#include "render/scene/plugin/plugin.h"

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

/* A chain of blends that each reference another one twice would be evaluated 2^n times. */
enum { MOST_EVALUATIONS = 1 << 12 };

static aur_result count_evaluations(const aur_parameters *parameters, aur_phase *phase, aur_error *error) {
    for (size_t i = 0; i < parameters->count; ++i) {
        const aur_parameter *const item = &parameters->items[i];
        if (item->kind == AUR_PARAMETER_OBJECT && strcmp(item->object_kind, "phase") == 0)
            phase->evaluations += 1 + ((const aur_phase *)item->object)->evaluations;
    }
    return phase->evaluations < MOST_EVALUATIONS
               ? AUR_OK
               : aur_fail_at(
                     error, parameters->location, AUR_ERROR_UNSUPPORTED,
                     "phase '%s' has %zu phase functions inside, counted as often as they are named, and at "
                     "most %d can be rendered",
                     parameters->plugin, phase->evaluations, (int)MOST_EVALUATIONS - 1);
}

static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    (void)context;
    aur_phase *const phase = object;
    const aur_row *const row = &phase->descriptor->row;
    aur_result result = aur_keys_read(row->key_count, row->keys, parameters, phase->data, error);
    if (result == AUR_OK)
        result = count_evaluations(parameters, phase, error);
    return result == AUR_OK && phase->descriptor->create != NULL
               ? phase->descriptor->create(parameters, phase, error)
               : result;
}

static const aur_plugin_kind kind = AUR_PLUGIN_KIND(phase);

aur_result aur_phase_create(aur_parameters *parameters, aur_phase **phase, aur_error *error) {
    return aur_plugin_create(&kind, parameters, NULL, phase, error);
}

void aur_phase_destroy(aur_phase *phase) {
    aur_plugin_destroy(&kind, phase);
}
