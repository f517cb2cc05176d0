/* Every volume by name. To add a volume: one new file, and one line here. */
#include <stddef.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/plugin/plugin.h"
#include "render/scene/volume.h"

#define VOLUMES(ROW)                                                                                         \
    ROW(constvolume)                                                                                         \
    ROW(gridvolume)

#define DECLARE(name) extern const aur_volume_descriptor aur_volume_##name;
VOLUMES(DECLARE)

#define ADDRESS(name) &aur_volume_##name.row,
static const aur_row *const rows[] = {VOLUMES(ADDRESS)};

const aur_table aur_volume_table = {
    .kind = "volume", .summary = "values that vary over space, for media", AUR_TABLE_ROWS(rows)};

static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    (void)context;
    aur_volume *const volume = object;
    const aur_row *const row = &volume->descriptor->row;
    const aur_result result = aur_keys_read(row->key_count, row->keys, parameters, volume->data, error);
    return result == AUR_OK ? volume->descriptor->create(parameters, volume, error) : result;
}

static const aur_plugin_kind kind = AUR_PLUGIN_KIND(volume);

aur_result aur_volume_create(aur_parameters *parameters, aur_volume **volume, aur_error *error) {
    return aur_plugin_create(&kind, parameters, NULL, volume, error);
}

void aur_volume_destroy(aur_volume *volume) {
    aur_plugin_destroy(&kind, volume);
}

void aur_volume_recenter(aur_volume *volume, const double origin[3]) {
    aur_transform to_local;
    if (volume->constant)
        return;
    aur_transform_move(&volume->to_world, origin);
    aur_transform_inverse(&volume->to_world, &to_local);
    for (size_t i = 0; i < 12; ++i)
        volume->to_local[i] = (float)to_local.m[i];
}

static bool is_volume(const aur_parameter *item) {
    return item->kind == AUR_PARAMETER_OBJECT && strcmp(item->object_kind, "volume") == 0;
}

aur_result aur_volume_value_read(aur_parameters *parameters, const char *name, float fallback, float maximum,
                                 aur_volume_value *value, aur_error *error) {
    *value = (aur_volume_value){.constant = {fallback, fallback, fallback}};
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    char expected[96];
    aur_format(expected, sizeof expected, "a number, a colour or a <volume>, from 0 to %g", (double)maximum);
    if (is_volume(item)) {
        const aur_volume *const volume = item->object;
        if (volume->minimum < 0.0f || volume->maximum > maximum)
            return aur_fail_at(error, item->location, AUR_ERROR_FORMAT,
                               "%s '%s': '%s' must be %s; the volume has values from %g to %g",
                               parameters->kind, parameters->plugin, name, expected, (double)volume->minimum,
                               (double)volume->maximum);
        value->volume = volume->constant ? NULL : volume;
        value->constant = volume->descriptor->evaluate(volume, (aur_vector){0});
        return AUR_OK;
    }
    double rgb[3];
    const size_t count = item->text != NULL ? aur_parse_doubles(item->text, rgb, 3) : 0;
    if (count == 1)
        rgb[2] = rgb[1] = rgb[0];
    bool good = count == 1 || count == 3;
    for (size_t k = 0; good && k < 3; ++k)
        good = rgb[k] >= 0.0 && rgb[k] <= (double)maximum;
    if (!good)
        return aur_parameters_fail_value(parameters, item, expected, error);
    value->constant = (aur_vector){(float)rgb[0], (float)rgb[1], (float)rgb[2]};
    return AUR_OK;
}
