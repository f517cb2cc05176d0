/* Diffuse area lights: constant radiance on the side of the surface normal. */
#include <stdlib.h>

#include "render/scene/emitter.h"
#include "render/scene/lights/spherical_rectangle.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(aur_emitter, "radiance", radiance, 1e30, "1", "emitted radiance, RGB")},
};

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    return aur_colors_read(&emitter->descriptor->row, parameters, emitter, error);
}

/* How points of the shape are sampled. */
typedef struct area_light {
    const aur_shape *shape;
    aur_distribution triangles; /* triangles of meshes, by area */
    bool is_mesh, is_rectangle;
    float offset;                  /* offset of rays that leave a parallelogram */
    aur_rectangle_light rectangle; /* sampled by solid angle */
    const aur_rectangle_kernels *kernels;
} area_light;

static bool find_rectangle(const aur_shape *shape, aur_rectangle *rectangle) {
    const aur_vector corner = aur_mesh_position(&shape->mesh, 0);
    const aur_vector x = aur_vector_subtract(aur_mesh_position(&shape->mesh, 1), corner);
    const aur_vector y = aur_vector_subtract(aur_mesh_position(&shape->mesh, 3), corner);
    *rectangle = (aur_rectangle){.corner = corner,
                                 .x = aur_vector_normalize(x),
                                 .y = aur_vector_normalize(y),
                                 .width = aur_vector_length(x),
                                 .height = aur_vector_length(y)};
    return fabsf(aur_vector_dot(rectangle->x, rectangle->y)) < 1e-4f;
}

static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    const aur_shape *const shape = emitter->scene->shapes[emitter->shape];
    if (shape->curved != NULL && shape->curved->sample == NULL)
        return aur_fail_at(error, emitter->location, AUR_ERROR_UNSUPPORTED,
                           "emitter 'area': a shape '%s' cannot be a light", shape->descriptor->row.name);
    if (!(shape->area > 0.0))
        return aur_fail_at(error, emitter->location, AUR_ERROR_FORMAT,
                           "emitter 'area': its shape has no area, so it gives no light");
    emitter->extent = AUR_PI * shape->area;
    area_light *const light = emitter->data;
    light->shape = shape;
    light->is_mesh = emitter->needs_choice = shape->curved == NULL && !shape->parallelogram;
    if (light->is_mesh)
        emitter->part_count = shape->mesh.triangle_count;
    if (shape->parallelogram) {
        const aur_shape_point on = aur_shape_sample(shape, NULL, (const float[3]){0.0f});
        light->rectangle.normal = on.normal;
        light->rectangle.rounding = on.rounding;
        light->offset = on.offset;
        light->is_rectangle = find_rectangle(shape, &light->rectangle.rectangle);
    }
    light->rectangle.area = (float)shape->area;
    light->rectangle.radiance = emitter->radiance.constant;
    light->kernels = &AUR_KERNEL_HERE(aur_rectangle_kernels);
    return light->is_mesh ? aur_mesh_distribution(&shape->mesh, &light->triangles, error) : AUR_OK;
}

static double triangle_area(const area_light *light, size_t triangle) {
    aur_vector corner[3];
    aur_mesh_corners(&light->shape->mesh, triangle, corner);
    return aur_triangle_area(corner);
}

/* A triangle's mean luminance, plus a fraction of the whole light's, in case the points tested miss bright
 * texels. */
static double triangle_brightness(const aur_emitter *emitter, size_t triangle) {
    static const float points[][2] = {{1.0f / 3.0f, 1.0f / 3.0f},
                                      {0.1f, 0.1f},
                                      {0.8f, 0.1f},
                                      {0.1f, 0.8f},
                                      {0.05f, 0.475f},
                                      {0.475f, 0.05f},
                                      {0.475f, 0.475f}};
    enum { COUNT = sizeof points / sizeof points[0] };
    const aur_mesh *const mesh = &((const area_light *)emitter->data)->shape->mesh;
    double sum = 0.0;
    for (size_t i = 0; i < COUNT && emitter->radiance.texture != NULL; ++i)
        sum += (double)aur_luminance(
            aur_color_at(&emitter->radiance, aur_mesh_texture(mesh, triangle, points[i][0], points[i][1])));
    return emitter->radiance.texture != NULL ? 0.9 * sum / COUNT + 0.1 * emitter->brightness
                                             : emitter->brightness;
}

static void release(void *data) {
    aur_distribution_release(&((area_light *)data)->triangles);
}

static aur_shape_point sample_area(const area_light *light, const float u[3]) {
    if (light->is_rectangle) {
        const aur_rectangle *const r = &light->rectangle.rectangle;
        const aur_vector along = aur_vector_add_scaled(r->corner, u[1] * r->width, r->x);
        return (aur_shape_point){.position = aur_vector_add_scaled(along, u[2] * r->height, r->y),
                                 .normal = light->rectangle.normal,
                                 .offset = light->offset,
                                 .rounding = light->rectangle.rounding,
                                 .texture = {.u = u[1], .v = u[2]}};
    }
    return aur_shape_sample(light->shape, light->is_mesh ? &light->triangles : NULL, u);
}

/* A point of one triangle, or of the whole light. */
static aur_shape_point sample_part(const area_light *light, uint32_t part, const float u[3]) {
    return light->is_mesh && part != AUR_WHOLE_LIGHT
               ? aur_triangle_sample(&light->shape->mesh, part, u[1], u[2])
               : sample_area(light, u);
}

static void widen_box(aur_light_bounds *bounds, const double lower[3], const double upper[3]) {
    for (size_t d = 0; d < 3; ++d) {
        bounds->lower[d] = fmin(bounds->lower[d], lower[d]);
        bounds->upper[d] = fmax(bounds->upper[d], upper[d]);
    }
}

static void find_bounds(const aur_emitter *emitter, size_t part, aur_light_bounds *bounds) {
    const area_light *const light = emitter->data;
    const aur_shape *const shape = light->shape;
    const bool flat = shape->curved == NULL || shape->ellipse;
    *bounds = (aur_light_bounds){.axis = {0.0, 0.0, 1.0},
                                 .spread = flat ? 0.0 : AUR_PI,
                                 .emission = 0.5 * AUR_PI,
                                 .power = emitter->power};
    if (light->is_mesh)
        bounds->power = AUR_PI * triangle_area(light, part) * triangle_brightness(emitter, part);
    for (size_t d = 0; d < 3; ++d) {
        bounds->lower[d] = INFINITY;
        bounds->upper[d] = -INFINITY;
    }
    for (size_t k = 0; shape->curved != NULL && k < aur_shape_primitives(shape); ++k) {
        double lower[3], upper[3];
        shape->curved->bounds(shape, k, lower, upper);
        widen_box(bounds, lower, upper);
    }
    const size_t triangles = light->is_mesh ? 1 : shape->mesh.triangle_count;
    for (size_t k = 0; shape->curved == NULL && k < 3 * triangles; ++k) {
        double corner[3];
        aur_vector_to_doubles(aur_mesh_position(&shape->mesh, shape->mesh.indices[3 * part + k]), corner);
        widen_box(bounds, corner, corner);
    }
    if (flat)
        aur_vector_to_doubles(sample_part(light, (uint32_t)part, (const float[3]){0.0f}).normal,
                              bounds->axis);
}

/* Pdf by solid angle, or, if by_area, relative to uniform area sampling. */
typedef struct area_density {
    float value;
    bool by_area;
} area_density;

/* Pdf relative to uniform area sampling, of one triangle or of the whole light. */
static float part_density(const area_light *light, uint32_t part) {
    return light->is_mesh && part != AUR_WHOLE_LIGHT
               ? (float)(light->shape->area / triangle_area(light, part))
               : 1.0f;
}

/* Samples by the solid angle visible from the reference, for shapes that support it. */
static aur_shape_point sample_seen(const area_light *light, bool textured, const aur_light_query *query,
                                   area_density *density) {
    const aur_curved *const curved = light->shape->curved;
    const aur_light_reference *const reference = &query->reference;
    const float *const u = query->u;
    aur_shape_point point;
    *density = (area_density){0.0f, false};
    if (curved != NULL && curved->sample_seen != NULL &&
        curved->sample_seen(light->shape, reference->position, u[1], u[2], textured, &point, &density->value))
        return point;
    if (light->is_rectangle) {
        const aur_seen_rectangle seen = aur_rectangle_see(&light->rectangle.rectangle, reference);
        float along[3] = {0.0f};
        *density =
            (area_density){aur_seen_rectangle_draw(&seen, u[1], u[2], &along[1], &along[2]), seen.by_area};
        return sample_area(light, along);
    }
    *density = (area_density){part_density(light, query->part), true};
    return sample_part(light, query->part, u);
}

static area_density density_of(const area_light *light, const aur_light_reference *reference,
                               const aur_surface *surface, bool by_parts) {
    const aur_curved *const curved = light->shape->curved;
    if (curved != NULL && curved->pdf_seen != NULL) {
        const float pdf = curved->pdf_seen(light->shape, reference->position);
        if (pdf > 0.0f)
            return (area_density){pdf, false};
    }
    if (!light->is_rectangle)
        return (area_density){part_density(light, by_parts ? surface->primitive : AUR_WHOLE_LIGHT), true};
    const aur_rectangle *const r = &light->rectangle.rectangle;
    const aur_vector way = aur_vector_subtract(surface->position, r->corner);
    const aur_seen_rectangle seen = aur_rectangle_see(r, reference);
    return (area_density){aur_seen_rectangle_density(&seen, aur_vector_dot(way, r->x) / r->width,
                                                     aur_vector_dot(way, r->y) / r->height),
                          seen.by_area};
}

/* Pdf by solid angle for area sampling, at a distance and emission cosine. */
static float pdf_of(const area_light *light, area_density density, float squared, float cosine) {
    return density.by_area ? density.value * squared / (cosine * light->rectangle.area) : density.value;
}

static float pdf_seen(const aur_emitter *emitter, const aur_light_reference *reference,
                      const aur_surface *surface, float cosine) {
    const area_light *const light = emitter->data;
    const aur_vector way = aur_vector_subtract(surface->position, reference->position);
    const bool by_parts = emitter->first_leaf != AUR_WHOLE_LIGHT;
    return pdf_of(light, density_of(light, reference, surface, by_parts), aur_vector_dot(way, way), cosine);
}

/* Radiance and pdf of a point of the shape, seen from the reference. */
static bool finish_sample(const aur_emitter *emitter, aur_vector reference, const aur_shape_point *point,
                          area_density density, aur_light_sample *drawn) {
    const aur_vector way = aur_vector_subtract(point->position, reference);
    const float squared = aur_vector_dot(way, way);
    drawn->delta = false;
    drawn->distance = sqrtf(squared);
    drawn->direction = aur_vector_scale(way, 1.0f / drawn->distance);
    const float cosine = -aur_vector_dot(drawn->direction, point->normal);
    if (!(cosine > 0.0f) || !(squared > 0.0f))
        return false;
    const area_light *const light = emitter->data;
    drawn->position = aur_surface_target(reference, point->position, point->normal, point->rounding);
    drawn->normal = point->normal;
    drawn->radiance = aur_color_at(&emitter->radiance, point->texture);
    drawn->pdf = pdf_of(light, density, squared, cosine);
    return isfinite(drawn->pdf);
}

static bool sample(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    area_density density;
    const aur_shape_point point =
        sample_seen(emitter->data, emitter->radiance.texture != NULL, query, &density);
    return finish_sample(emitter, query->reference.position, &point, density, drawn);
}

static const aur_rectangle_light *rectangle_of(const aur_emitter *emitter) {
    const area_light *const light = emitter->data;
    return light->is_rectangle && emitter->radiance.texture == NULL ? &light->rectangle : NULL;
}

static bool sample_lanes(const aur_emitter *emitter, uint32_t lanes, const aur_light_references *references,
                         const float *u, const float *v, aur_light_lanes *drawn) {
    (void)lanes; /* all 16 lanes, which costs the same */
    const aur_rectangle_light *const rectangle = rectangle_of(emitter);
    if (rectangle == NULL)
        return false;
    ((const area_light *)emitter->data)->kernels->lanes(rectangle, references, u, v, drawn);
    return true;
}

/* Rectangles, unless there are few: vector code takes as long as some of them. */
static uint32_t sample_several(const aur_emitter *const *emitters, const aur_light_references *references,
                               const float *u, const float *v, aur_light_lanes *drawn) {
    enum { LEAST = 4 };
    const aur_rectangle_light *found[AUR_PACKET_SIZE], *any = NULL;
    aur_rectangle_lanes rectangles;
    uint32_t lanes = 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        found[k] = emitters[k] != NULL ? rectangle_of(emitters[k]) : NULL;
        lanes |= (uint32_t)(found[k] != NULL) << k;
        any = found[k] != NULL ? found[k] : any;
    }
    if (__builtin_popcount(lanes) < LEAST)
        return 0;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        aur_rectangle_lane_set(&rectangles, k, found[k] != NULL ? found[k] : any);
    AUR_KERNEL_HERE(aur_rectangle_kernels).each(&rectangles, references, u, v, drawn);
    return lanes;
}

static bool emit(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const aur_shape_point point = sample_area(emitter->data, u);
    const aur_frame frame = aur_frame_about(point.normal);
    const aur_surface surface = {
        .position = point.position, .geometric_normal = point.normal, .offset = point.offset};
    *ray = aur_surface_ray(&surface, aur_frame_to_world(&frame, aur_sample_cosine(u[3], u[4])));
    *power = aur_vector_scale(aur_color_at(&emitter->radiance, point.texture),
                              AUR_PI_F * ((const area_light *)emitter->data)->rectangle.area);
    return true;
}

const aur_emitter_descriptor aur_emitter_area = {
    .row = {.name = "area", .summary = "a shape that emits from the side of its normal", AUR_ROW_KEYS(keys)},
    .size = sizeof(area_light),
    .needs_shape = true,
    .create = create,
    .prepare = prepare,
    .bounds = find_bounds,
    .sample = sample,
    .lanes = sample_lanes,
    .several = sample_several,
    .emit = emit,
    .release = release,
    .pdf_seen = pdf_seen,
};
