#include "render/gather/points.h"
#include "render/trace/packet_rays.h"

/* Finds one diffuse and one glossy lobe, both analytic; specular lobes are allowed. */
static void find_pair(aur_gather_point *surface_point) {
    bool found[2] = {false, false};
    for (size_t i = 0; i < surface_point->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &surface_point->lobes[i];
        const size_t which = lobe->diffuse ? 0 : 1;
        if (lobe->shape == AUR_LOBE_SHAPE_SPECULAR || aur_vector_is_zero(lobe->coefficient))
            continue;
        if (lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER || lobe->factor != NULL || found[which] ||
            (which == 0 && lobe->exponent != 1.0f))
            return;
        found[which] = true;
        surface_point->pair[which] = i;
    }
    surface_point->paired = found[0] && found[1];
}

void aur_gather_point_set(const aur_gather_plan *plan, const aur_ray *ray, const aur_hit *hit,
                          aur_gather_point *surface_point) {
    aur_surface *const surface = &surface_point->surface;
    aur_scene_surface(plan->scene, ray, hit, surface);
    const aur_vector view = aur_vector_scale(ray->direction, -1.0f);
    surface_point->side = aur_vector_dot(surface->geometric_normal, view) < 0.0f ? -1.0f : 1.0f;
    surface_point->view = aur_frame_to_local(&surface->frame, view);
    surface_point->origin =
        aur_surface_ray(surface, aur_vector_scale(surface->geometric_normal, surface_point->side)).origin;
    surface_point->lobe_count =
        aur_bsdf_lobes(surface->bsdf, surface->texture, surface_point->view, surface_point->lobes);
    surface_point->rules = plan->rules.of_shape[surface->shape];
    surface_point->ggx = plan->rules.ggx_of_shape[surface->shape];
    surface_point->paired = false;
    if (plan->rules.pairs)
        find_pair(surface_point);
}

/* Whether packets from these points are coherent: decided by normals and positions, never by timing. */
static bool are_flat(const aur_gather_points *surface_points) {
    if (!surface_points->grouped || aur_lane_count(surface_points->lanes) < AUR_PACKET_SIZE / 2)
        return false;
    const aur_gather_point *const first = &surface_points->at[aur_first_lane(surface_points->lanes)];
    for (uint32_t rest = surface_points->lanes; rest != 0; rest &= rest - 1) {
        const aur_gather_point *const surface_point = &surface_points->at[aur_first_lane(rest)];
        const aur_vector offset = aur_vector_subtract(surface_point->origin, first->origin);
        const float cosine = aur_vector_dot(surface_point->surface.frame.z, first->surface.frame.z);
        if (aur_is_off_plane(offset, first->surface.geometric_normal,
                             cosine * surface_point->side * first->side) != 0)
            return false;
    }
    return true;
}

aur_embree_order aur_gather_points_order(const aur_gather_points *surface_points) {
    return are_flat(surface_points) ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
}
