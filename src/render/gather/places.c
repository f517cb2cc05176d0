#include "render/gather/places.h"
#include "render/trace/packet_rays.h"

/* The merged rule of a place whose lobes are one diffuse and one glossy lobe, both with a formula, and
 * specular ones. */
static void find_merged(aur_gather_place *place) {
    bool found[2] = {false, false};
    place->merged = NULL;
    for (size_t i = 0; i < place->lobe_count; ++i) {
        const aur_bsdf_lobe *const lobe = &place->lobes[i];
        const size_t which = lobe->diffuse ? 0 : 1;
        if (lobe->shape == AUR_LOBE_SHAPE_SPECULAR || aur_vector_is_zero(lobe->coefficient))
            continue;
        if (lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER || lobe->factor != NULL || found[which] ||
            (which == 0 && lobe->exponent != 1.0f))
            return;
        found[which] = true;
        place->merged_lobes[which] = i;
    }
    if (found[0] && found[1])
        place->merged = place->rules[place->merged_lobes[1]]->merged;
}

void aur_gather_place_set(const aur_gather_plan *plan, const aur_ray *ray, const aur_hit *hit,
                          aur_gather_place *place) {
    aur_surface *const surface = &place->surface;
    aur_scene_surface(plan->scene, ray, hit, surface);
    const aur_vector view = aur_vector_scale(ray->direction, -1.0f);
    place->side = aur_vector_dot(surface->geometric_normal, view) < 0.0f ? -1.0f : 1.0f;
    place->view = aur_frame_to_local(&surface->frame, view);
    place->origin = aur_surface_ray(surface, aur_vector_scale(surface->geometric_normal, place->side)).origin;
    place->lobe_count = aur_bsdf_lobes(surface->bsdf, surface->texture, place->view, place->lobes);
    place->rules = plan->rules.of_shape[surface->shape];
    place->ggx = plan->rules.ggx_of_shape[surface->shape];
    place->merged = NULL;
    if (plan->rules.merged != NULL)
        find_merged(place);
}

/* Whether a packet from these places is coherent: from normals and positions, never from timing. */
static bool are_flat(const aur_gather_places *places) {
    if (aur_lane_count(places->lanes) < AUR_PACKET_SIZE / 2)
        return false;
    const aur_gather_place *const first = &places->at[aur_first_lane(places->lanes)];
    for (uint32_t rest = places->lanes; rest != 0; rest &= rest - 1) {
        const aur_gather_place *const place = &places->at[aur_first_lane(rest)];
        const aur_vector offset = aur_vector_subtract(place->origin, first->origin);
        const float cosine = aur_vector_dot(place->surface.frame.z, first->surface.frame.z);
        if (aur_is_off_plane(offset, first->surface.geometric_normal, cosine * place->side * first->side) !=
            0)
            return false;
    }
    return true;
}

aur_embree_order aur_gather_places_order(const aur_gather_places *places) {
    return are_flat(places) ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
}
