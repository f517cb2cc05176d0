/* Every medium by name. One new medium is one new file and one line here. */
#include <stdlib.h>
#include <string.h>

#include "render/scene/medium.h"

#define MEDIA(ROW)                                                                                           \
    ROW(homogeneous)                                                                                         \
    ROW(heterogeneous)

#define DECLARE(name) extern const aur_medium_descriptor aur_medium_##name;
MEDIA(DECLARE)

#define ADDRESS(name) &aur_medium_##name.row,
static const aur_row *const rows[] = {MEDIA(ADDRESS)};

/* The keys that every medium takes. */
typedef struct medium_keys {
    bool sample_emitters, has_spectral_extinction;
    const aur_parameter *phase;
} medium_keys;

static const aur_key common_keys[] = {
    {AUR_KEY_OF_ITEM(medium_keys, "phase", phase, "isotropic", "how it scatters", "phase")},
    {AUR_KEY_OF_BOOLEAN(medium_keys, "sample_emitters", sample_emitters, "true",
                        "draws points on lights where it scatters; else light is found by chance")},
    {AUR_KEY_OF_BOOLEAN(medium_keys, "has_spectral_extinction", has_spectral_extinction, "true",
                        "of no effect: that is seen from sigma_t")},
};

static const aur_row common = {
    .name = "medium", .summary = "what every medium takes", AUR_ROW_KEYS(common_keys)};

const aur_table aur_medium_table = {.kind = "medium",
                                    .summary = "what absorbs and scatters light between surfaces",
                                    AUR_TABLE_ROWS(rows),
                                    .common = &common};

static aur_result read_common(aur_parameters *parameters, aur_medium *medium, aur_error *error) {
    medium_keys p = {.phase = NULL};
    const aur_result result = aur_keys_read(common.key_count, common.keys, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    medium->samples_emitters = p.sample_emitters;
    medium->phase = &aur_phase_uniform;
    if (p.phase == NULL)
        return AUR_OK;
    if (p.phase->kind != AUR_PARAMETER_OBJECT || strcmp(p.phase->object_kind, "phase") != 0)
        return aur_parameters_fail_value(parameters, p.phase, "a <phase>", error);
    medium->phase = p.phase->object;
    return AUR_OK;
}

aur_result aur_medium_create(aur_parameters *parameters, aur_medium **medium, aur_error *error) {
    *medium = NULL;
    const aur_row *row;
    aur_result result = aur_table_find(&aur_medium_table, parameters, &row, error);
    if (result != AUR_OK)
        return result;
    const aur_medium_descriptor *const descriptor = (const aur_medium_descriptor *)row;
    aur_medium *const made = calloc(1, sizeof *made);
    if (made != NULL)
        made->data = calloc(1, descriptor->size);
    if (made == NULL || made->data == NULL) {
        free(made);
        return aur_fail_memory_at(error, parameters->location);
    }
    made->descriptor = descriptor;
    made->location = parameters->location;
    result = read_common(parameters, made, error);
    if (result == AUR_OK)
        result = descriptor->create(parameters, made, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK) {
        aur_medium_destroy(made);
        return result;
    }
    *medium = made;
    return AUR_OK;
}

void aur_medium_destroy(aur_medium *medium) {
    if (medium == NULL)
        return;
    if (medium->descriptor->release != NULL)
        medium->descriptor->release(medium);
    free(medium->data);
    free(medium);
}
