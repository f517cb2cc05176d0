/* Every light by name. One new light is one new file and one line here. */
#include <stddef.h>

#include "render/scene/emitter.h"
#include "render/scene/plugin/plugin.h"

#define EMITTERS(ROW)                                                                                        \
    ROW(area)                                                                                                \
    ROW(directionalarea)                                                                                     \
    ROW(point)                                                                                               \
    ROW(spot)                                                                                                \
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

const aur_table aur_emitter_table = {.kind = "emitter", .summary = "lights", AUR_TABLE_ROWS(rows)};

static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    (void)context;
    aur_emitter *const emitter = object;
    emitter->location = parameters->location;
    emitter->shape = UINT32_MAX;
    return emitter->descriptor->create(parameters, emitter, error);
}

static const aur_plugin_kind kind = AUR_PLUGIN_KIND(emitter);

aur_result aur_emitter_create(aur_parameters *parameters, aur_emitter **emitter, aur_error *error) {
    return aur_plugin_create(&kind, parameters, NULL, emitter, error);
}

void aur_emitter_destroy(aur_emitter *emitter) {
    aur_plugin_destroy(&kind, emitter);
}
