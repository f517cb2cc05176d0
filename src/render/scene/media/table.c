/* Every medium by name. To add a medium: one new file, and one line here. */
#include <stddef.h>
#include <string.h>

#include "render/scene/medium.h"
#include "render/scene/plugin/plugin.h"

#define MEDIA(ROW)                                                                                           \
    ROW(homogeneous)                                                                                         \
    ROW(heterogeneous)

#define DECLARE(name) extern const aur_medium_descriptor aur_medium_##name;
MEDIA(DECLARE)

#define ADDRESS(name) &aur_medium_##name.row,
static const aur_row *const rows[] = {MEDIA(ADDRESS)};

/* Parameters of every medium. */
typedef struct medium_keys {
    bool sample_emitters;
    const aur_parameter *phase;
} medium_keys;

static const aur_key common_keys[] = {
    {AUR_KEY_OF_ITEM(medium_keys, "phase", phase, "isotropic", "phase function", "phase")},
    {AUR_KEY_OF_BOOLEAN(medium_keys, "sample_emitters", sample_emitters, "true",
                        "sample points on lights at scattering events; else only paths find lights")},
};

static const aur_row common = {
    .name = "medium", .summary = "what every medium takes", AUR_ROW_KEYS(common_keys)};

const aur_table aur_medium_table = {.kind = "medium",
                                    .summary = "media that absorb and scatter light between surfaces",
                                    AUR_TABLE_ROWS(rows),
                                    .common = &common};

/* `create` reads the parameters of its row, and may select another type of medium by them. */
static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    (void)context;
    aur_medium *const medium = object;
    medium_keys p = {.phase = NULL};
    medium->location = parameters->location;
    const aur_result result = aur_keys_read(common.key_count, common.keys, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    medium->samples_emitters = p.sample_emitters;
    medium->phase = &aur_phase_uniform;
    if (p.phase != NULL &&
        (p.phase->kind != AUR_PARAMETER_OBJECT || strcmp(p.phase->object_kind, "phase") != 0))
        return aur_parameters_fail_value(parameters, p.phase, "a <phase>", error);
    if (p.phase != NULL)
        medium->phase = p.phase->object;
    return medium->descriptor->create(parameters, medium, error);
}

static const aur_plugin_kind kind = AUR_PLUGIN_KIND(medium);

aur_result aur_medium_create(aur_parameters *parameters, aur_medium **medium, aur_error *error) {
    return aur_plugin_create(&kind, parameters, NULL, medium, error);
}

void aur_medium_destroy(aur_medium *medium) {
    aur_plugin_destroy(&kind, medium);
}
