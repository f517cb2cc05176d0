#include "lighting/irradiance/sensor_trace.h"

#include <string.h>

#include "points/base/random.h"
#include "points/base/vector3d.h"
#include "render/scene/scene_data.h"
#include "render/trace/packet_rays.h"
#include "render/vertex/vertex.h"

enum { DIRECT, SKY, REFLECTED, SUN }; /* rows of aur_sensor_sums.sums */

/* Finds the nearest surface on which the sensor may lie: within the rounding errors of both. */
typedef struct footing {
    aur_vector normal;
    float height, offset; /* height of the sensor above it along the normal; rounding error */
} footing;

/* Error bound of a round shape: rays are exact for its position and size in floats, which are off by four
 * roundings (its centre 1, its radius 1, or the normal of a disk 2). aur_surface_rounding counts 25. */
static float shape_rounding(const aur_scene *scene, const aur_hit *hit, aur_vector normal) {
    const aur_shape *const shape = scene->shapes[hit->shape];
    if (shape->curved == NULL || hit->instance != AUR_NO_INSTANCE)
        return 0.0f;
    double lower[3], upper[3];
    shape->curved->bounds(shape, hit->primitive, lower, upper);
    const aur_vector reach = {(float)fmax(fabs(lower[0]), fabs(upper[0])),
                              (float)fmax(fabs(lower[1]), fabs(upper[1])),
                              (float)fmax(fabs(lower[2]), fabs(upper[2]))};
    return 0.16f * aur_surface_rounding(reach, normal);
}

/* Traces a probe ray from -reach to reach along an axis. The hit may be a flat emitter above a ground whose
 * distance is less exact than their gap. */
static void probe_along(const aur_scene *scene, const aur_sensor_point *surface_point, aur_vector axis,
                        float reach, const footing *before, footing *found) {
    enum { MOST_HITS = 16 };
    aur_ray ray = {aur_vector_add_scaled(surface_point->position, -reach, axis), 0.0f, axis, 2.0f * reach};
    aur_hit hit;
    for (size_t i = 0; i < MOST_HITS && aur_scene_intersect(scene, &ray, &hit); ++i) {
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        const aur_vector normal = surface.geometric_normal;
        const float height =
            aur_vector_dot(normal, aur_vector_subtract(surface_point->position, surface.position));
        const float offset = surface.offset + aur_surface_offset(surface_point->position, normal) +
                             shape_rounding(scene, &hit, normal);
        const bool parallel = fabsf(aur_vector_dot(normal, before->normal)) > 0.999f;
        if (!parallel && fabsf(height) <= offset && fabsf(height) < fabsf(found->height))
            *found = (footing){normal, height, offset};
        ray.nearest = nextafterf(hit.distance, INFINITY);
    }
}

/* Moves the position off a surface on which it lies; false if there is none except that of `before`. One of
 * three axes is always close to a plane's normal. */
static bool move_off(const aur_scene *scene, float reach, footing *before, aur_sensor_point *surface_point) {
    const aur_frame *const frame = &surface_point->frame;
    const aur_vector axes[] = {frame->z, frame->x, frame->y};
    footing found = {.height = INFINITY};
    for (size_t i = 0; i < 3; ++i)
        probe_along(scene, surface_point, axes[i], reach, before, &found);
    if (!(found.height < INFINITY))
        return false;
    const float side = aur_vector_dot(found.normal, frame->z) < -1e-3f ? -1.0f : 1.0f;
    surface_point->position = aur_vector_add_scaled(surface_point->position,
                                                    side * 2.0f * found.offset - found.height, found.normal);
    *before = found;
    return true;
}

/* Twice the largest possible offset, because the axis may be oblique to the surface. */
static float reach_of(const aur_scene *scene, aur_vector at) {
    const aur_vector low = scene->lower, high = scene->upper;
    const aur_vector reach = {fabsf(at.x) + aur_larger(fabsf(low.x), fabsf(high.x)),
                              fabsf(at.y) + aur_larger(fabsf(low.y), fabsf(high.y)),
                              fabsf(at.z) + aur_larger(fabsf(low.z), fabsf(high.z))};
    return 2.0f * aur_surface_offset(reach, (aur_vector){1.0f, 1.0f, 1.0f});
}

void aur_sensor_point_create(const aur_scene *scene, const aur_closed_lights *lights,
                             const double position[3], const double normal[3], uint64_t seed, float *shares,
                             aur_sensor_point *surface_point) {
    enum { MOST_SURFACES = 3 }; /* surfaces that meet in a corner */
    *surface_point = (aur_sensor_point){.hash = seed};
    double unit[3] = {normal[0], normal[1], normal[2]};
    /* The square of a tiny or huge normal may overflow or underflow a double. */
    const double size = fmax(fabs(unit[0]), fmax(fabs(unit[1]), fabs(unit[2])));
    for (size_t d = 0; d < 3; ++d)
        unit[d] /= size;
    aur_normalize3(unit);
    double from[3];
    for (size_t d = 0; d < 3; ++d) {
        from[d] = position[d] - scene->origin[d];
        const double numbers[2] = {from[d] + 0.0, unit[d] + 0.0}; /* -0 becomes 0 */
        uint64_t bits[2];
        memcpy(bits, numbers, sizeof bits);
        surface_point->hash = aur_hash3(surface_point->hash, bits[0], bits[1]);
    }
    const aur_vector z = {(float)unit[0], (float)unit[1], (float)unit[2]};
    const aur_vector at = aur_internal_point(scene->origin, position);
    surface_point->frame = aur_frame_about(aur_vector_normalize(z));
    surface_point->position = at;
    footing before = {.height = 0.0f};
    const float reach = reach_of(scene, at);
    for (size_t i = 0; i < MOST_SURFACES && move_off(scene, reach, &before, surface_point); ++i) {
        surface_point->on_surface = true;
        const float side = aur_vector_dot(before.normal, surface_point->frame.z) < -1e-3f ? -1.0f : 1.0f;
        aur_sensor_find_cover(scene, from, aur_vector_scale(before.normal, side), before.offset,
                              surface_point);
    }
    if (lights->count == 0 || surface_point->covered)
        return;
    surface_point->shares = shares;
    if (surface_point->on_surface)
        aur_vector_to_doubles(surface_point->position, from);
    aur_closed_lights_at(scene, lights, from, unit, surface_point->position, surface_point->hash, shares,
                         surface_point->closed);
}

/* The radiance in a direction of the small disks of the sky. */
static aur_vector sun_from(const aur_scene *scene, aur_vector direction) {
    static const double WIDEST = 2.0 * AUR_PI * AUR_PI * 3.8053e-3; /* extent of a disk whose edge is 5
                                                                     * degrees from its centre */
    aur_vector sum = {0};
    for (size_t i = 0; i < scene->environment_count; ++i) {
        const aur_emitter *const emitter = scene->environments[i];
        if (emitter->descriptor->adds && emitter->extent <= WIDEST)
            sum = aur_vector_add(sum, emitter->descriptor->radiance_from(emitter, direction));
    }
    return sum;
}

/* Light of one direction from the environment: the sun's part, and the rest. */
static void add_beyond(const aur_scene *scene, aur_vector direction, const double light[3],
                       double (*sums)[3]) {
    const aur_vector sun = sun_from(scene, direction);
    double part[3] = {0.0}, all[3] = {0.0};
    if (!aur_vector_is_zero(sun)) {
        aur_vector_to_doubles(sun, part);
        aur_vector_to_doubles(aur_scene_environment(scene, direction), all);
    }
    for (size_t c = 0; c < 3; ++c) {
        const double of_sun = part[c] > 0.0 ? light[c] * (part[c] / all[c]) : 0.0;
        sums[SKY][c] += light[c] - of_sun;
        sums[SUN][c] += of_sun;
    }
}

/* The rays of direction `index`, which look for light. */
static void set_rays(aur_path_group *g, const aur_sensor_rule *rule, size_t index,
                     const aur_sensor_point *surface_point, float (*shifts)[3]) {
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const float height = rule->heights[index] + shifts[k][0];
        const float square = aur_smaller(height < 1.0f ? height : height - 1.0f, 0x1.fffffep-1f);
        const float radius = sqrtf(square), z = sqrtf(1.0f - square);
        const float c = rule->cosines[index], s = rule->sines[index];
        const aur_vector local = {radius * (c * shifts[k][1] - s * shifts[k][2]),
                                  radius * (s * shifts[k][1] + c * shifts[k][2]), z};
        const aur_ray ray = {surface_point->position, 0.0f, aur_frame_to_world(&surface_point->frame, local),
                             INFINITY};
        aur_packet_set(&g->packet, k, &ray);
        aur_lane_set(&g->lanes.throughput, k, (aur_vector){1.0f, 1.0f, 1.0f});
        aur_lane_set(&g->lanes.sum, k, (aur_vector){0});
        aur_lane_set(&g->lanes.from, k, surface_point->position);
        aur_lane_set(&g->lanes.from_normal, k, surface_point->frame.z);
        g->lanes.pdf[k] = z / AUR_PI_F;
    }
    g->alive = UINT16_MAX;
    g->sensor.unscattered = UINT16_MAX;
    g->specular = 0;
}

/* A sample's two numbers, with a separate shift per lane (Cranley-Patterson). If the edge of a visible region
 * is parallel to the strata of scrambled points, all but one stratum contribute equally in all
 * randomisations. The spread then shows no error if that stratum is rarely hit; shifted strata differ. */
static void draw_pair(const aur_path_group *g, uint32_t pair, float *u, float *v) {
    aur_stream_pixels(g->sampler, AUR_PACKET_SIZE, g->pixels, g->index, pair, u, v);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const uint64_t words = aur_hash3(g->pixels[k], 0x7368696674, pair);
        u[k] += aur_unit_float((uint32_t)words);
        v[k] += aur_unit_float((uint32_t)(words >> 32));
        u[k] -= u[k] < 1.0f ? 0.0f : 1.0f;
        v[k] -= v[k] < 1.0f ? 0.0f : 1.0f;
    }
}

/* A point on an emitter for each lane. */
static void add_lights(aur_path_group *g, const aur_sensor_point *surface_point,
                       aur_sensor_sums *sensor_sums) {
    float choice[AUR_PACKET_SIZE] = {0}, u[AUR_PACKET_SIZE], v[AUR_PACKET_SIZE], unused[AUR_PACKET_SIZE];
    double light[AUR_PACKET_SIZE][3], closed_shares[AUR_PACKET_SIZE];
    uint32_t drawn_lanes = 0, sky = 0;
    if (g->chooses)
        draw_pair(g, AUR_PAIR_FILTER, choice, unused);
    draw_pair(g, AUR_PAIR_LENS, u, v);
    const aur_light_reference reference = {surface_point->position, surface_point->frame.z};
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        aur_light_sample drawn;
        aur_shadow shadow;
        if (!aur_light_sample_direct(g->scene, &reference, (const float[3]){choice[k], u[k], v[k]}, &drawn))
            continue;
        const float share =
            surface_point->shares != NULL ? surface_point->shares[drawn.emitter] : AUR_LIGHT_OPEN;
        /* Emission that has a closed form is not counted along rays. */
        const aur_vertex_samples samples = {1.0f, share >= 0.0f ? 0.0f : 1.0f};
        if (!aur_vertex_irradiance(&reference, samples, &drawn, &shadow))
            continue;
        closed_shares[k] = share > 0.0f ? (double)share : 0.0;
        aur_vector_to_doubles(shadow.radiance, light[k]);
        aur_packet_set(&g->shadows, k, &shadow.ray);
        drawn_lanes |= 1u << k;
        sky |= (uint32_t)drawn.environment << k;
    }
    if (drawn_lanes == 0)
        return;
    aur_packet_set_lanes(&g->shadows, drawn_lanes);
    float farthest[AUR_PACKET_SIZE];
    memcpy(farthest, g->shadows.query.ray.tfar, sizeof farthest);
    const uint32_t lit = drawn_lanes & ~aur_scene_occluded16(g->scene, AUR_EMBREE_INCOHERENT, &g->shadows);
    for (uint32_t rest = drawn_lanes; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        double left[3] = {1.0, 1.0, 1.0};
        if (!aur_has_lane(lit, k))
            aur_vector_to_doubles(aur_path_group_passed(g, k, farthest[k], 0), left);
        double brought[3];
        for (size_t c = 0; c < 3; ++c)
            brought[c] = (left[c] - closed_shares[k]) * light[k][c];
        if (aur_has_lane(sky, k))
            add_beyond(g->scene, aur_packet_ray(&g->shadows, k).direction, brought, sensor_sums->sums[k]);
        else
            for (size_t c = 0; c < 3; ++c)
                sensor_sums->sums[k][DIRECT][c] += brought[c];
        if (g->sensor.from_sky == NULL || !aur_has_lane(sky, k))
            continue;
        const aur_vector sky_light = {(float)(left[0] * light[k][0]), (float)(left[1] * light[k][1]),
                                      (float)(left[2] * light[k][2])};
        g->sensor.from_sky(g->sensor.from_sky_user, k, aur_packet_ray(&g->shadows, k).direction,
                           aur_vector_scale(sky_light, 1.0f / AUR_PI_F), true);
    }
}

/* Whether the lane's first hit is a surface's back that scatters nothing. */
static bool is_dark(const aur_path_group *g, size_t lane) {
    if (aur_has_lane(g->plain, lane))
        return g->lanes.side[lane] < 0.0f && aur_vector_is_zero(aur_lane_vector(&g->lanes.albedo[1], lane));
    const aur_surface *const surface = &g->surfaces[lane];
    const aur_ray ray = aur_packet_ray(&g->packet, lane);
    return !surface->bsdf->scatters_from_behind &&
           aur_vector_dot(ray.direction, surface->geometric_normal) > 0.0f;
}

/* Adds the increase of the lanes' sums since `seen` to the component of each lane. */
static void add_parts(const aur_path_group *g, const size_t *parts, double (*seen)[3],
                      aur_sensor_sums *sensor_sums) {
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        double light[3], more[3];
        aur_vector_to_doubles(aur_lane_vector(&g->lanes.sum, k), light);
        for (size_t c = 0; c < 3; ++c)
            more[c] = light[c] - seen[k][c];
        memcpy(seen[k], light, sizeof light);
        if (parts[k] == SKY)
            add_beyond(g->scene, aur_packet_ray(&g->packet, k).direction, more, sensor_sums->sums[k]);
        else
            for (size_t c = 0; c < 3; ++c)
                sensor_sums->sums[k][parts[k]][c] += more[c];
    }
}

/* The contribution of direction `index`; lanes begin with no light. Light through thin panes counts as direct
 * light. */
static void add_direction(aur_path_group *g, const aur_sensor_point *surface_point,
                          const aur_cached_light *cache, aur_sensor_sums *sensor_sums) {
    double seen[AUR_PACKET_SIZE][3] = {{0.0}};
    size_t parts[AUR_PACKET_SIZE], reflected[AUR_PACKET_SIZE];
    uint32_t unscattered = g->alive, pending = cache != NULL ? g->alive : 0;
    g->sensor.light_shares = surface_point->shares;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        reflected[k] = REFLECTED;
    for (uint32_t depth = 1;; ++depth) {
        aur_path_group_hit(g, depth);
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            const bool met = aur_has_lane(g->alive, k);
            parts[k] = !aur_has_lane(unscattered, k) ? REFLECTED : met ? DIRECT : SKY;
            sensor_sums->dark += depth == 1 && met && is_dark(g, k);
        }
        add_parts(g, parts, seen, sensor_sums);
        if (g->data->max_depth == depth || g->alive == 0)
            break;
        if (pending != 0)
            aur_cached_light_add(cache, g, depth, &pending);
        if (g->alive == 0)
            break;
        aur_path_group_scatter(g, depth);
        unscattered = g->sensor.unscattered & g->alive;
        if (unscattered == 0 && (pending & g->alive) == 0) {
            aur_path_group_trace(g, depth + 1);
            break;
        }
    }
    add_parts(g, reflected, seen, sensor_sums);
    g->sensor.light_shares = NULL;
}

void aur_sensor_trace(aur_path_group *g, const aur_sensor_rule *rule, const aur_sensor_point *surface_point,
                      const aur_cached_light *cache, uint32_t level, aur_sensor_sums *sensor_sums) {
    *sensor_sums = (aur_sensor_sums){0};
    for (size_t k = 0; k < AUR_PACKET_SIZE && surface_point->covered; ++k)
        memcpy(sensor_sums->sums[k][DIRECT], surface_point->closed, sizeof surface_point->closed);
    if (surface_point->covered)
        return;
    aur_sensor_sums from_lights = {0};
    float shifts[AUR_PACKET_SIZE][3]; /* per lane: of the height, and the cosine and sine of the rotation */
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        g->pixels[k] = aur_hash3(surface_point->hash, level, k);
        const uint64_t words = aur_hash2(g->pixels[k], 0x7475726e);
        const double turn = 2.0 * AUR_PI * aur_unit_double(words);
        shifts[k][0] = aur_unit_float((uint32_t)aur_mix64(words));
        shifts[k][1] = (float)cos(turn);
        shifts[k][2] = (float)sin(turn);
    }
    for (size_t i = 0; i < rule->count; ++i) {
        g->index = (uint32_t)i;
        set_rays(g, rule, i, surface_point, shifts);
        add_direction(g, surface_point, cache, sensor_sums);
        if (g->has_lights)
            add_lights(g, surface_point, &from_lights);
    }
    /* Directions have the pdf cos / pi. */
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        for (size_t part = 0; part < AUR_IRRADIANCE_PARTS - 1; ++part)
            for (size_t c = 0; c < 3; ++c)
                sensor_sums->sums[k][part][c] =
                    (part == DIRECT ? surface_point->closed[c] : 0.0) +
                    (AUR_PI * sensor_sums->sums[k][part][c] + from_lights.sums[k][part][c]) /
                        (double)rule->count;
}
