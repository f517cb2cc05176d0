/* The scene as a list of triangles. */
#include "render/scene/scene_data.h"

aur_result aur_scene_check_triangles(const aur_scene *scene, aur_error *error) {
    for (size_t i = 0; i < scene->shape_count; ++i) {
        const aur_shape *const shape = scene->shapes[i];
        if (shape->curved != NULL)
            return aur_fail_at(error, shape->location, AUR_ERROR_UNSUPPORTED,
                               "shape '%s' is not a mesh of triangles", shape->descriptor->row.name);
        if (shape->grouped)
            return aur_fail_at(error, shape->location, AUR_ERROR_UNSUPPORTED,
                               "shape '%s' is in a shape group: its instances have no triangles",
                               shape->descriptor->row.name);
    }
    for (size_t i = 0; i < scene->emitter_count; ++i)
        if (!aur_emitter_glows(scene->emitters[i]))
            return aur_fail_at(error, scene->emitters[i]->location, AUR_ERROR_UNSUPPORTED,
                               "emitter '%s' is not a surface: only 'area' lights are",
                               scene->emitters[i]->descriptor->row.name);
    return AUR_OK;
}

size_t aur_scene_shape_count(const aur_scene *scene) {
    return scene->shape_count;
}

size_t aur_scene_shape_triangles(const aur_scene *scene, size_t shape) {
    return scene->shapes[shape]->mesh.triangle_count;
}

void aur_scene_triangle(const aur_scene *scene, size_t shape, size_t index, aur_triangle *triangle) {
    const aur_mesh *const mesh = &scene->shapes[shape]->mesh;
    aur_mesh_corners(mesh, index, triangle->corner);
    for (size_t i = 0; i < 3; ++i)
        triangle->texture[i] = aur_mesh_texture(mesh, index, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f);
}

const aur_bsdf *aur_scene_shape_bsdf(const aur_scene *scene, size_t shape) {
    return scene->shapes[shape]->bsdf;
}

aur_location aur_scene_shape_location(const aur_scene *scene, size_t shape) {
    return scene->shapes[shape]->location;
}

static const aur_emitter *emitter_of(const aur_scene *scene, size_t shape) {
    const uint32_t emitter = scene->shapes[shape]->emitter;
    return emitter == AUR_NO_EMITTER ? NULL : scene->emitters[emitter];
}

aur_vector aur_scene_shape_emission(const aur_scene *scene, size_t shape, aur_bsdf_point point) {
    const aur_emitter *const emitter = emitter_of(scene, shape);
    return emitter == NULL ? (aur_vector){0} : aur_color_at(&emitter->radiance, point);
}

bool aur_scene_shape_emission_varies(const aur_scene *scene, size_t shape) {
    const aur_emitter *const emitter = emitter_of(scene, shape);
    return emitter != NULL && emitter->radiance.texture != NULL;
}
