#include "render/volume/volume_shadow.h"

static bool pass_medium(const aur_medium *medium, const aur_ray *ray, float distance, aur_medium_walk *walk,
                        aur_counters *counters) {
    if (medium != NULL)
        medium->descriptor->pass(medium, ray, distance, walk);
    counters->cut += walk->cut;
    counters->stopped |= walk->stopped;
    return !walk->cut && !walk->stopped && aur_vector_max(walk->throughput) > 0.0f;
}

bool aur_volume_shadow(const aur_scene *scene, bool passes, float reach, const aur_ray *ray,
                       const aur_medium *medium, aur_medium_walk *walk, aur_counters *counters) {
    aur_ray rest = *ray;
    if (!passes) {
        return !aur_scene_occluded(scene, ray) && pass_medium(medium, ray, reach, walk, counters);
    }
    for (size_t i = 0; i < AUR_MOST_PASSED; ++i) {
        aur_hit hit;
        if (!aur_scene_intersect(scene, &rest, &hit))
            return pass_medium(medium, &rest, reach, walk, counters);
        aur_surface surface;
        aur_scene_surface(scene, &rest, &hit, &surface);
        const aur_vector view = aur_vector_scale(rest.direction, -1.0f);
        const aur_vector passed =
            aur_bsdf_passed(surface.bsdf, surface.texture, aur_frame_to_local(&surface.frame, view));
        if (aur_vector_is_zero(passed) || !pass_medium(medium, &rest, hit.distance, walk, counters))
            return false;
        walk->throughput = aur_vector_multiply(walk->throughput, passed);
        aur_surface_medium(scene, &surface, rest.direction, &medium);
        const float left = rest.farthest - hit.distance;
        reach = aur_larger(reach - hit.distance, 0.0f);
        rest = aur_surface_ray(&surface, rest.direction);
        rest.farthest = left;
    }
    ++counters->cut;
    return false;
}
