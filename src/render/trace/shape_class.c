#include "render/trace/packet_rays.h"

#include <stdlib.h>

#include "points/base/error.h"
#include "render/scene/elements.h"

static bool is_diffuse(const aur_bsdf *bsdf) {
    for (size_t i = 0; i < bsdf->lobe_count; ++i)
        if (!bsdf->lobes[i].diffuse || bsdf->lobes[i].factor != NULL)
            return false;
    return true;
}

static aur_shape_class class_of(const aur_scene *scene, uint32_t shape) {
    const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, shape);
    aur_shape_class class = {.curved = aur_shape_is_curved(scene, shape),
                             .emits = aur_shape_emitter(scene, shape) != AUR_NO_EMITTER};
    class.plain = bsdf->plain_diffuse && !class.curved && !class.emits;
    class.plain_flat = class.plain && aur_shape_is_flat(scene, shape);
    class.textured_flat = !class.plain && !class.curved && !class.emits && is_diffuse(bsdf) &&
                          !bsdf->attributes.position && aur_shape_is_flat(scene, shape);
    for (size_t side = 0; side < (bsdf->scatters_from_behind ? 2 : 1) && class.plain; ++side) {
        class.albedo[side] = aur_bsdf_diffuse_albedo(bsdf, (aur_bsdf_point){0}, side == 0 ? 1.0f : -1.0f);
        class.albedo_on_pi[side] = aur_vector_scale(class.albedo[side], 1.0f / AUR_PI_F);
    }
    return class;
}

aur_result aur_shape_classes_create(const aur_scene *scene, aur_shape_class **classes, aur_error *error) {
    const size_t count = aur_scene_shape_count(scene);
    *classes = calloc(count + 1, sizeof **classes);
    if (*classes == NULL)
        return aur_fail_memory(error);
    for (uint32_t i = 0; i < count; ++i)
        (*classes)[i] = class_of(scene, i);
    return AUR_OK;
}
