#include "render/scene/overlaps.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

/* A copy of `bytes`, plus the padding of mesh arrays; NULL stays NULL, which is not an error. */
static void *copy_of(const void *array, size_t bytes, bool *good) {
    void *const copy = array != NULL ? calloc(1, bytes + sizeof(double)) : NULL;
    if (copy != NULL)
        memcpy(copy, array, bytes);
    *good = *good && (copy != NULL || array == NULL);
    return copy;
}

static aur_shape *copy_shape(const aur_shape *from) {
    aur_shape *const copy = calloc(1, sizeof *copy);
    if (copy == NULL)
        return NULL;
    bool good = true;
    *copy = *from;
    const aur_mesh *const mesh = &from->mesh;
    const size_t vertices = mesh->vertex_count, triangles = mesh->triangle_count;
    copy->file = copy_of(from->file, from->file != NULL ? strlen(from->file) + 1 : 0, &good);
    copy->flaws = (aur_face_flaws){0}; /* flaws are reported for the original */
    copy->mesh.points = copy_of(mesh->points, 3 * vertices * sizeof(double), &good);
    copy->mesh.normals = copy_of(mesh->normals, 3 * vertices * sizeof(float), &good);
    copy->mesh.uvs = copy_of(mesh->uvs, 2 * vertices * sizeof(float), &good);
    copy->mesh.vertex_colors = copy_of(mesh->vertex_colors, 3 * vertices * sizeof(float), &good);
    copy->mesh.indices = copy_of(mesh->indices, 3 * triangles * sizeof(uint32_t), &good);
    copy->mesh.sources = copy_of(mesh->sources, triangles * sizeof(uint32_t), &good);
    copy->mesh.face_colors = copy_of(mesh->face_colors, 3 * triangles * sizeof(float), &good);
    if (good)
        return copy;
    aur_shape_destroy(copy);
    return NULL;
}

aur_result aur_instance_separate_group(aur_scene *scene, aur_instance *instance, aur_error *error) {
    const aur_shape_group *const from = instance->group;
    if (!aur_array_reserve(&scene->groups, &scene->group_capacity, scene->group_count + 1,
                           sizeof *scene->groups) ||
        !aur_array_reserve(&scene->shapes, &scene->shape_capacity, scene->shape_count + from->count,
                           sizeof *scene->shapes))
        return aur_fail_memory(error);
    aur_shape_group *const group = calloc(1, sizeof *group);
    if (group == NULL)
        return aur_fail_memory(error);
    scene->groups[scene->group_count++] = group;
    group->shapes = malloc((from->count + 1) * sizeof *group->shapes);
    if (group->shapes == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < from->count; ++i) {
        aur_shape *const copy = copy_shape(scene->shapes[from->shapes[i]]);
        if (copy == NULL)
            return aur_fail_memory(error);
        copy->index = group->shapes[group->count++] = (uint32_t)scene->shape_count;
        scene->shapes[scene->shape_count++] = copy;
    }
    instance->group = group;
    return AUR_OK;
}
