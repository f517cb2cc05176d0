#include "render/scene/elements.h"

#include <stdlib.h>

#include "render/scene/scene_data.h"

static size_t count_placements(const aur_scene *scene) {
    size_t count = 0;
    for (size_t i = 0; i < scene->shape_count; ++i)
        count += scene->shapes[i]->grouped ? 0 : 1;
    for (size_t i = 0; i < scene->instance_count; ++i)
        count += scene->instances[i]->group->count;
    return count;
}

/* Adds a placement; elements->count grows by its primitives. */
static void add_placement(const aur_scene *scene, aur_elements *elements, uint32_t shape, uint32_t instance) {
    const aur_shape *const s = scene->shapes[shape];
    elements->placements[elements->placement_count++] =
        (aur_placement){.shape = shape,
                        .instance = instance,
                        .first = (uint32_t)elements->count,
                        .count = (uint32_t)aur_shape_primitives(s),
                        .curved = s->curved != NULL};
    elements->count += aur_shape_primitives(s);
}

static void number_all(const aur_scene *scene, aur_elements *elements) {
    for (size_t i = 0; i < scene->shape_count; ++i) {
        if (scene->shapes[i]->grouped)
            continue;
        elements->shape_first[i] = (uint32_t)elements->count;
        add_placement(scene, elements, (uint32_t)i, AUR_NO_INSTANCE);
    }
    for (size_t i = 0; i < scene->instance_count; ++i) {
        const aur_shape_group *const group = scene->instances[i]->group;
        elements->instance_first[i] = (uint32_t)elements->count;
        for (size_t k = 0; k < group->count; ++k) {
            elements->shape_first[group->shapes[k]] = (uint32_t)elements->count - elements->instance_first[i];
            add_placement(scene, elements, group->shapes[k], (uint32_t)i);
        }
    }
}

aur_result aur_elements_create(const aur_scene *scene, aur_elements *elements) {
    *elements = (aur_elements){0};
    const size_t placements = count_placements(scene);
    elements->placements = malloc((placements + 1) * sizeof *elements->placements);
    elements->shape_first = calloc(scene->shape_count + 1, sizeof *elements->shape_first);
    elements->instance_first = calloc(scene->instance_count + 1, sizeof *elements->instance_first);
    if (elements->placements == NULL || elements->shape_first == NULL || elements->instance_first == NULL) {
        aur_elements_release(elements);
        return AUR_ERROR_MEMORY;
    }
    number_all(scene, elements);
    if (elements->count < UINT32_MAX)
        return AUR_OK;
    aur_elements_release(elements);
    return AUR_ERROR_ARGUMENT;
}

void aur_elements_release(aur_elements *elements) {
    free(elements->placements);
    free(elements->shape_first);
    free(elements->instance_first);
    *elements = (aur_elements){0};
}

static const aur_instance *instance_of(const aur_scene *scene, const aur_placement *placement) {
    return placement->instance == AUR_NO_INSTANCE ? NULL : scene->instances[placement->instance];
}

static void world_corners(const aur_scene *scene, const aur_placement *placement, uint32_t primitive,
                          aur_vector corner[3]) {
    aur_mesh_corners(&scene->shapes[placement->shape]->mesh, primitive, corner);
    const aur_instance *const instance = instance_of(scene, placement);
    for (size_t i = 0; instance != NULL && i < 3; ++i)
        corner[i] = aur_transform_point_f(&instance->to_world, corner[i]);
}

void aur_shape_corners(const aur_scene *scene, uint32_t shape, uint32_t primitive, aur_vector corner[3]) {
    aur_mesh_corners(&scene->shapes[shape]->mesh, primitive, corner);
}

double aur_element_area(const aur_scene *scene, const aur_placement *placement, uint32_t primitive) {
    if (placement->curved) {
        const aur_instance *const instance = instance_of(scene, placement);
        const double scale =
            instance != NULL ? cbrt(fabs(aur_transform_determinant(&instance->to_world))) : 1.0;
        const aur_shape *const shape = scene->shapes[placement->shape];
        const double area = shape->curved->area != NULL ? shape->curved->area(shape, primitive) : shape->area;
        return area * scale * scale;
    }
    aur_vector corner[3];
    world_corners(scene, placement, primitive, corner);
    return aur_triangle_area(corner);
}

void aur_element_middle(const aur_scene *scene, const aur_placement *placement, uint32_t primitive,
                        aur_vector *position, aur_vector *normal) {
    *normal = (aur_vector){0.0f, 0.0f, 1.0f};
    if (placement->curved) {
        const aur_shape *const shape = scene->shapes[placement->shape];
        const aur_instance *const instance = instance_of(scene, placement);
        double lower[3], upper[3];
        shape->curved->bounds(shape, primitive, lower, upper);
        const aur_vector middle = {(float)(0.5 * (lower[0] + upper[0])), (float)(0.5 * (lower[1] + upper[1])),
                                   (float)(0.5 * (lower[2] + upper[2]))};
        *position = instance != NULL ? aur_transform_point_f(&instance->to_world, middle) : middle;
        return;
    }
    aur_vector corner[3];
    world_corners(scene, placement, primitive, corner);
    *position =
        aur_vector_scale(aur_vector_add(aur_vector_add(corner[0], corner[1]), corner[2]), 1.0f / 3.0f);
    const aur_vector unit = aur_triangle_normal(corner);
    if (!aur_vector_is_zero(unit))
        *normal = unit;
}

void aur_element_coordinates(const aur_scene *scene, const aur_hit *hit, const aur_surface *surface,
                             float coordinates[2]) {
    const aur_shape *const shape = scene->shapes[hit->shape];
    coordinates[0] = shape->curved == NULL ? hit->u : surface->texture.u;
    coordinates[1] = shape->curved == NULL ? hit->v : surface->texture.v;
    if (shape->curved != NULL && shape->curved->equal_area != NULL)
        shape->curved->equal_area(hit, coordinates);
}

bool aur_shape_is_curved(const aur_scene *scene, uint32_t shape) {
    return scene->shapes[shape]->curved != NULL;
}

bool aur_shape_is_flat(const aur_scene *scene, uint32_t shape) {
    const aur_shape *const found = scene->shapes[shape];
    return found->curved == NULL && found->mesh.normals == NULL && !found->extreme;
}

uint32_t aur_shape_emitter(const aur_scene *scene, uint32_t shape) {
    return scene->shapes[shape]->emitter;
}
