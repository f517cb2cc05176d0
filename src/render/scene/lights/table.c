/* Every light by name. One new light is one new file and one line here. */
#include <stdlib.h>

#include "render/scene/emitter.h"

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
    ROW(sun)

#define DECLARE(name) extern const aur_emitter_descriptor aur_emitter_##name;
EMITTERS(DECLARE)

#define ADDRESS(name) &aur_emitter_##name.row,
static const aur_row *const rows[] = {EMITTERS(ADDRESS)};

typedef struct emitter_keys {
    double sampling_weight;
} emitter_keys;

static const aur_key common_keys[] = {
    {AUR_KEY_OF_REAL(emitter_keys, "sampling_weight", sampling_weight, 0.0, 1e30, "1",
                     "of no effect: lights are chosen by what they give")},
};

static const aur_row common = {
    .name = "emitter", .summary = "what every light takes", AUR_ROW_KEYS(common_keys)};

const aur_table aur_emitter_table = {
    .kind = "emitter", .summary = "lights", AUR_TABLE_ROWS(rows), .common = &common};

aur_result aur_emitter_create(aur_parameters *parameters, aur_emitter **emitter, aur_error *error) {
    *emitter = NULL;
    const aur_row *row;
    emitter_keys unused;
    aur_result result = aur_table_find(&aur_emitter_table, parameters, &row, error);
    if (result == AUR_OK)
        result = aur_keys_read(common.key_count, common.keys, parameters, &unused, error);
    if (result != AUR_OK)
        return result;
    aur_emitter *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return aur_fail_memory_at(error, parameters->location);
    made->descriptor = (const aur_emitter_descriptor *)row;
    made->location = parameters->location;
    made->shape = UINT32_MAX;
    result = made->descriptor->create(parameters, made, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK) {
        aur_emitter_destroy(made);
        return result;
    }
    *emitter = made;
    return AUR_OK;
}

void aur_emitter_destroy(aur_emitter *emitter) {
    if (emitter == NULL)
        return;
    if (emitter->data != NULL && emitter->descriptor->release != NULL)
        emitter->descriptor->release(emitter);
    free(emitter->data);
    free(emitter);
}
