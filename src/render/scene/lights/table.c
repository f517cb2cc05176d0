/* Every light by name. To add a light: one new file, and one line here. */
#include <stddef.h>

#include "render/scene/emitter.h"
#include "render/scene/plugin/plugin.h"

#define EMITTERS(ROW)                                                                                        \
    ROW(area)                                                                                                \
    ROW(directionalarea)                                                                                     \
    ROW(point)                                                                                               \
    ROW(spot)                                                                                                \
    ROW(photometric)                                                                                         \
    ROW(projector)                                                                                           \
    ROW(directional)                                                                                         \
    ROW(constant)                                                                                            \
    ROW(envmap)                                                                                              \
    ROW(sky)                                                                                                 \
    ROW(sun)                                                                                                 \
    ROW(sunsky)

#define DECLARE(name) extern const aur_emitter_descriptor aur_emitter_##name;
EMITTERS(DECLARE)

#define ADDRESS(name) &aur_emitter_##name.row,
static const aur_row *const rows[] = {EMITTERS(ADDRESS)};

static const aur_key common_keys[] = {
    {AUR_KEY_OF_REAL(aur_emitter, "sampling_weight", sampling_weight, 0.0, 1e6, "1",
                     "weight of light sampling; values below 0.001 count as 0.001")},
};

static const aur_row common = {
    .name = "emitter", .summary = "what every light takes", AUR_ROW_KEYS(common_keys)};

const aur_table aur_emitter_table = {
    .kind = "emitter", .summary = "lights", AUR_TABLE_ROWS(rows), .common = &common};

static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    (void)context;
    aur_emitter *const emitter = object;
    emitter->location = parameters->location;
    emitter->shape = UINT32_MAX;
    emitter->first_leaf = AUR_WHOLE_LIGHT;
    const aur_result result = aur_keys_read(common.key_count, common.keys, parameters, emitter, error);
    return result == AUR_OK ? emitter->descriptor->create(parameters, emitter, error) : result;
}

static const aur_plugin_kind kind = AUR_PLUGIN_KIND(emitter);

aur_result aur_emitter_create(aur_parameters *parameters, aur_emitter **emitter, aur_error *error) {
    return aur_plugin_create(&kind, parameters, NULL, emitter, error);
}

void aur_emitter_destroy(aur_emitter *emitter) {
    aur_plugin_destroy(&kind, emitter);
}
