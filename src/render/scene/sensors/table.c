/* Every camera by name. To add a camera: one new file, and one line here. */
#include "render/scene/sensor.h"

#define SENSORS(ROW)                                                                                         \
    ROW(perspective)                                                                                         \
    ROW(thinlens)                                                                                            \
    ROW(orthographic)                                                                                        \
    ROW(radiancemeter)                                                                                       \
    ROW(irradiancemeter)                                                                                     \
    ROW(batch)

#define DECLARE(name) extern const aur_sensor_descriptor aur_sensor_##name;
SENSORS(DECLARE)

#define ADDRESS(name) &aur_sensor_##name.row,
static const aur_row *const rows[] = {SENSORS(ADDRESS)};

/* Parameters of every sensor. */
typedef struct sensor_keys {
    aur_transform to_world;
    double near_clip, far_clip;
    const aur_parameter *film, *sampler, *medium; /* read by the loader */
} sensor_keys;

static const aur_key common_keys[] = {
    {AUR_KEY_OF_TRANSFORM(sensor_keys, "to_world", to_world, "camera to world; the camera faces +z, +y up")},
    {AUR_KEY_OF_REAL(sensor_keys, "near_clip", near_clip, 0.0, 1e30, "0.01", "near clipping distance")},
    {AUR_KEY_OF_REAL(sensor_keys, "far_clip", far_clip, 0.0, INFINITY, "10000", "far clipping distance")},
    {AUR_KEY_OF_ITEM(sensor_keys, "film", film, NULL, "film: image size and filter", "film")},
    {AUR_KEY_OF_ITEM(sensor_keys, "sampler", sampler, NULL, "sampler of the camera", "sampler")},
    {AUR_KEY_OF_ITEM(sensor_keys, "medium", medium, NULL, "medium around the camera", "medium")},
};

static const aur_row common = {
    .name = "sensor", .summary = "what every sensor takes", AUR_ROW_KEYS(common_keys)};

const aur_table aur_sensor_table = {
    .kind = "sensor", .summary = "cameras", AUR_TABLE_ROWS(rows), .common = &common};

static aur_result read_common(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    sensor_keys p = {.film = NULL};
    aur_transform to_local;
    aur_result result = aur_keys_read(common.key_count, common.keys, parameters, &p, error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &p.to_world, &to_local, error);
    if (result != AUR_OK)
        return result;
    if (!(p.near_clip < p.far_clip))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "near_clip (%g) must be less than far_clip (%g)", p.near_clip, p.far_clip);
    for (size_t i = 0; i < 12; ++i)
        sensor->to_world[i] = (float)p.to_world.m[i];
    for (size_t i = 0; i < 3; ++i)
        sensor->position[i] = p.to_world.m[4 * i + 3];
    sensor->near_clip = (float)p.near_clip;
    sensor->far_clip = (float)p.far_clip;
    return AUR_OK;
}

aur_result aur_sensor_recenter(aur_sensor *sensor, const double origin[3], aur_error *error) {
    for (size_t i = 0; i < 3; ++i)
        sensor->to_world[4 * i + 3] = (float)(sensor->position[i] - origin[i]);
    return sensor->descriptor != NULL && sensor->descriptor->prepare != NULL
               ? sensor->descriptor->prepare(sensor, error)
               : AUR_OK;
}

void aur_sensor_release(aur_sensor *sensor) {
    aur_distribution_release(&sensor->triangles);
}

aur_result aur_sensor_create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    *sensor = (aur_sensor){0};
    const aur_row *row;
    aur_result result = aur_table_find(&aur_sensor_table, parameters, &row, error);
    if (result != AUR_OK)
        return result;
    sensor->descriptor = (const aur_sensor_descriptor *)row;
    result = read_common(parameters, sensor, error);
    if (result == AUR_OK && sensor->descriptor->create != NULL)
        result = sensor->descriptor->create(parameters, sensor, error);
    return result != AUR_OK ? result : aur_parameters_finish(parameters, error);
}
