#include "lighting/daylight/coefficients.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/vector3d.h"
#include "render/trace/packet_rays.h"

static void add_light(void *user, size_t lane, aur_vector direction, aur_vector light, bool unscattered) {
    const aur_coefficients *const c = user;
    const aur_sun_position *const frame = &c->sky->frame;
    double world[3], rgb[3];
    aur_vector_to_doubles(direction, world);
    aur_vector_to_doubles(light, rgb);
    double local[3] = {aur_dot3(world, frame->east), aur_dot3(world, frame->north),
                       aur_dot3(world, frame->up)};
    aur_normalize3(local);
    const size_t patch = aur_sky_patches_find(c->patches, local);
    const double ground = patch == 0 ? AUR_DAYLIGHT_GROUND : 1.0;
    for (size_t channel = 0; channel < c->channels; ++channel) {
        const size_t at = (channel * c->patches->count + patch) * AUR_DAYLIGHT_LANES + lane;
        const double value = aur_dot3(c->weights[channel], rgb) / ground;
        c->all[at] += value;
        if (!unscattered)
            c->reflected[at] += value;
    }
}

void aur_coefficients_find(aur_path_group *group, const aur_sensor_rule *rule, const aur_sensor_point *point,
                           const aur_coefficients *coefficients, aur_sensor_sums *sums) {
    const size_t count = coefficients->channels * coefficients->patches->count * AUR_DAYLIGHT_LANES;
    memset(coefficients->all, 0, count * sizeof *coefficients->all);
    memset(coefficients->reflected, 0, count * sizeof *coefficients->reflected);
    group->sensor.from_sky = add_light;
    group->sensor.from_sky_user = (void *)(uintptr_t)coefficients;
    aur_sensor_trace(group, rule, point, NULL, 0, sums);
    const double scale = AUR_PI / (double)rule->count;
    for (size_t i = 0; i < count; ++i) {
        coefficients->all[i] *= scale;
        coefficients->reflected[i] *= scale;
    }
}

aur_result aur_coefficient_trace_create(const aur_scene *scene, const aur_daylight_options *options,
                                        aur_coefficient_trace *trace, aur_error *error) {
    const aur_daylight_options *const o = options;
    *trace = (aur_coefficient_trace){.path = {.max_depth = o->max_depth > 0 && o->max_depth < UINT32_MAX
                                                               ? (uint32_t)o->max_depth
                                                               : UINT32_MAX,
                                              .rr_depth = 5},
                                     .panes = aur_panes_exist(scene)};
    aur_result result = aur_sky_patches_create(o->subdivision, &trace->patches, error);
    if (result == AUR_OK)
        result = aur_open_sky_create(scene, o->ground_albedo > 0.0 ? AUR_DAYLIGHT_GROUND : 0.0, o->up,
                                     o->north, &trace->sky, error);
    if (result == AUR_OK)
        result = aur_sensor_rule_create(o->set, (o->directions + AUR_DAYLIGHT_LANES - 1) / AUR_DAYLIGHT_LANES,
                                        o->seed, &o->warnings, &trace->rule, error);
    if (result == AUR_OK)
        result = aur_path_prepare(&trace->path, trace->sky.scene, error);
    if (result == AUR_OK)
        result = aur_sampler_create("sobol", trace->rule.count, NULL, &trace->sampler, error);
    return result;
}

void aur_coefficient_trace_release(aur_coefficient_trace *trace) {
    aur_sensor_rule_release(&trace->rule);
    aur_sky_patches_release(&trace->patches);
    aur_open_sky_release(&trace->sky);
    aur_sampler_destroy(trace->sampler);
    free(trace->path.classes);
}

/* Sixteen rays to the sun's disk, uniform by solid angle. */
static void set_rays(aur_packet *packet, const aur_sensor_point *point, const double center[3],
                     uint64_t hash) {
    static const double RISE = 1.0816e-5; /* 1 - cosine of .2665 degrees */
    double x[3], y[3];
    aur_frame3(center, x, y);
    for (size_t k = 0; k < AUR_DAYLIGHT_LANES; ++k) {
        float u[3];
        uint64_t state = aur_hash2(hash, k);
        aur_draw_units(&state, u);
        const double low = RISE * (double)u[0], radius = sqrt(low * (2.0 - low));
        const double c = radius * cos(2.0 * AUR_PI * (double)u[1]);
        const double s = radius * sin(2.0 * AUR_PI * (double)u[1]);
        float way[3];
        for (int d = 0; d < 3; ++d)
            way[d] = (float)((1.0 - low) * center[d] + c * x[d] + s * y[d]);
        const aur_ray ray = {point->position, 0.0f, {way[0], way[1], way[2]}, INFINITY};
        aur_packet_set(packet, k, &ray);
    }
}

/* The transmittance through panes of a ray that another surface blocks. */
static double passed(const aur_path_group *group, size_t lane, const aur_coefficients *coefficients) {
    double left[3];
    aur_vector_to_doubles(aur_path_group_passed(group, lane, INFINITY, 0), left);
    return aur_dot3(coefficients->weights[0], left);
}

void aur_sun_seen(aur_path_group *group, const aur_sensor_point *point, const aur_coefficients *coefficients,
                  const aur_lit_hours *lit, double *seen) {
    const aur_sun_position *const frame = &coefficients->sky->frame;
    double normal[3];
    aur_vector_to_doubles(point->frame.z, normal);
    memset(seen, 0, lit->count * AUR_DAYLIGHT_LANES * sizeof *seen);
    for (size_t i = 0; i < lit->count; ++i) {
        const aur_lit_hour *const hour = &lit->hours[i];
        double center[3];
        for (int d = 0; d < 3; ++d)
            center[d] =
                hour->sun[0] * frame->east[d] + hour->sun[1] * frame->north[d] + hour->sun[2] * frame->up[d];
        const double light = hour->direct * aur_dot3(center, normal);
        if (!(light > 0.0))
            continue;
        set_rays(&group->shadows, point, center, aur_hash3(point->hash, 0x73756e, hour->hour));
        aur_packet_set_lanes(&group->shadows, UINT16_MAX);
        const uint32_t stopped = aur_scene_occluded16(group->scene, AUR_EMBREE_COHERENT, &group->shadows);
        for (size_t k = 0; k < AUR_DAYLIGHT_LANES; ++k)
            seen[i * AUR_DAYLIGHT_LANES + k] =
                light * (aur_has_lane(stopped, k) ? passed(group, k, coefficients) : 1.0);
    }
}
