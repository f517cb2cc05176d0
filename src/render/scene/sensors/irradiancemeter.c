/* The irradiance of a shape: rays start on its surface, with film coordinates as texture coordinates, in
 * cosine-distributed directions. pi times their mean radiance is the irradiance. */
#include "render/scene/materials/sampling.h"
#include "render/scene/sensor.h"
#include "render/scene/shape.h"

typedef struct irradiancemeter_keys {
    const aur_parameter *shape;
} irradiancemeter_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_ITEM(irradiancemeter_keys, "shape", shape, NULL, "the shape", "shape")},
};

static aur_result create(aur_parameters *parameters, aur_sensor *sensor, aur_error *error) {
    irradiancemeter_keys p = {NULL};
    const aur_result result = aur_keys_read(sizeof keys / sizeof keys[0], keys, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    if (p.shape == NULL || p.shape->kind != AUR_PARAMETER_OBJECT)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it must be inside a <shape>");
    const aur_shape *const shape = p.shape->object;
    if (shape->grouped || (shape->curved != NULL && shape->curved->sample == NULL))
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED,
                                   "it cannot be inside a curve or a shape of a shapegroup");
    if (aur_parameters_find(parameters, "to_world") != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "it has the position of its shape and takes no 'to_world'");
    sensor->shape = shape;
    return AUR_OK;
}

static aur_result prepare(aur_sensor *sensor, aur_error *error) {
    const aur_shape *const shape = sensor->shape;
    if (shape->curved != NULL || shape->parallelogram)
        return AUR_OK;
    aur_distribution_release(&sensor->triangles);
    return aur_mesh_distribution(&shape->mesh, &sensor->triangles, error);
}

static float within(float x) {
    return fminf(fmaxf(x, 0.0f), 0x1.fffffep-1f);
}

static void ray(const aur_sensor *sensor, float aspect, float x, float y, const float lens[2],
                aur_ray *result) {
    (void)aspect;
    const aur_shape *const shape = sensor->shape;
    double across = (double)within(x);
    aur_shape_point on;
    if (sensor->triangles.count > 0) {
        const size_t triangle = aur_distribution_choose_double(&sensor->triangles, &across);
        on = aur_triangle_sample(&shape->mesh, triangle, within((float)across), within(y));
    } else {
        on = aur_shape_sample(shape, NULL, (const float[3]){0.0f, (float)across, within(y)});
    }
    const aur_frame frame = aur_frame_about(on.normal);
    *result = (aur_ray){.origin = aur_vector_add_scaled(on.position, on.offset, on.normal),
                        .direction = aur_frame_to_world(&frame, aur_sample_cosine(lens[0], lens[1])),
                        .farthest = INFINITY};
}

const aur_sensor_descriptor aur_sensor_irradiancemeter = {
    .row = {.name = "irradiancemeter",
            .summary = "the irradiance of the shape around it",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .create = create,
    .prepare = prepare,
    .ray = ray,
    .factor = AUR_PI_F,
};
