#include "render/path/path_group.h"

#include <string.h>

#include "render/trace/packet_rays.h"
#include "render/vertex/candidates.h"
#include "render/vertex/vertex.h"

enum { MOST_PANES = 1000 }; /* coplanar panes that a ray may hit repeatedly by rounding */

aur_result aur_path_prepare(aur_path *data, const aur_scene *scene, aur_error *error) {
    data->kernels = &AUR_KERNEL_HERE(aur_vertex_kernels);
    return aur_shape_classes_create(scene, &data->classes, error);
}

/* --- numbers */

static void share(float number, float *lanes) {
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        lanes[k] = number;
}

static void shared_numbers(aur_path_group *g, uint32_t depth) {
    aur_vertex_lanes *const lanes = &g->lanes;
    const uint32_t first = aur_path_pair(depth);
    if (depth == 1 || depth % 2 == 0)
        aur_stream_pairs(&g->shared, first, AUR_STREAM_BLOCK, g->ahead);
    float(*const pair)[2] = &g->ahead[depth == 1 ? 0 : depth % 2 * AUR_PATH_PAIRS];
    share(pair[AUR_PATH_CHOICE][0], lanes->choice);
    share(pair[AUR_PATH_CHOICE][1], lanes->roulette);
    share(pair[AUR_PATH_POSITION][0], lanes->light_u);
    share(pair[AUR_PATH_POSITION][1], lanes->light_v);
    share(pair[AUR_PATH_LOBE][0], lanes->lobe);
    share(pair[AUR_PATH_LOBE][1], lanes->selection);
    share(pair[AUR_PATH_DIRECTION][0], lanes->direction_u);
    share(pair[AUR_PATH_DIRECTION][1], lanes->direction_v);
}

/* Random numbers of one pair for the active paths; in one block if they are few. */
static void draw_pair(const aur_path_group *g, uint32_t pair, float *u, float *v) {
    if (aur_lane_count(g->alive) > AUR_STREAM_BLOCK) {
        aur_stream_pixels(g->sampler, AUR_PACKET_SIZE, g->pixels, g->index, pair, u, v);
        return;
    }
    uint64_t pixels[AUR_STREAM_BLOCK] = {0};
    float few_u[AUR_STREAM_BLOCK], few_v[AUR_STREAM_BLOCK];
    size_t i = 0;
    for (uint32_t rest = g->alive; rest != 0; rest &= rest - 1)
        pixels[i++] = g->pixels[aur_first_lane(rest)];
    aur_stream_pixels(g->sampler, AUR_STREAM_BLOCK, pixels, g->index, pair, few_u, few_v);
    i = 0;
    for (uint32_t rest = g->alive; rest != 0; rest &= rest - 1, ++i) {
        u[aur_first_lane(rest)] = few_u[i];
        v[aur_first_lane(rest)] = few_v[i];
    }
}

/* Fills each lane's needed random numbers only; `mixed`: not all surfaces are plain. */
static void draw_numbers(aur_path_group *g, uint32_t depth, bool mixed) {
    aur_vertex_lanes *const lanes = &g->lanes;
    const uint32_t first = aur_path_pair(depth);
    if (g->chooses || depth >= g->data->rr_depth)
        draw_pair(g, first + AUR_PATH_CHOICE, lanes->choice, lanes->roulette);
    if (g->has_lights)
        draw_pair(g, first + AUR_PATH_POSITION, lanes->light_u, lanes->light_v);
    if (mixed || g->candidates > 1)
        draw_pair(g, first + AUR_PATH_LOBE, lanes->lobe, lanes->selection);
    draw_pair(g, first + AUR_PATH_DIRECTION, lanes->direction_u, lanes->direction_v);
}

/* --- lanes on surfaces that are not plain, one by one */

/* The path of a lane. */
static aur_walk walk_of(const aur_path_group *g, size_t k) {
    const aur_vertex_lanes *const lanes = &g->lanes;
    return (aur_walk){
        aur_lane_vector(&lanes->sum, k), aur_lane_vector(&lanes->throughput, k),
        aur_packet_ray(&g->packet, k),
        (aur_bounce){{aur_lane_vector(&lanes->from, k), aur_lane_vector(&lanes->from_normal, k)},
                     lanes->pdf[k],
                     1.0f,
                     aur_has_lane(g->specular, k)}};
}

static void add_sky(aur_path_group *g, uint32_t lanes) {
    const struct RTCRay16 *const rays = &g->packet.query.ray;
    aur_lane_vectors directions, radiance;
    aur_lane_numbers light_pdfs;
    if (lanes == 0)
        return;
    memcpy(directions.x, rays->dir_x, sizeof directions.x);
    memcpy(directions.y, rays->dir_y, sizeof directions.y);
    memcpy(directions.z, rays->dir_z, sizeof directions.z);
    aur_environment_lanes(g->scene, lanes, &directions, &radiance, light_pdfs);
    for (; lanes != 0; lanes &= lanes - 1) {
        const size_t k = aur_first_lane(lanes);
        const bool unscattered = aur_has_lane(g->sensor.unscattered, k);
        const aur_vector sky = g->background && unscattered
                                   ? aur_scene_background(g->scene, aur_lane_vector(&directions, k))
                                   : aur_lane_vector(&radiance, k);
        if (aur_vector_is_zero(sky))
            continue;
        const aur_bounce bounce = {
            .pdf = g->lanes.pdf[k], .light_samples = 1.0f, .specular_bounce = aur_has_lane(g->specular, k)};
        const float weight = aur_bounce_weight(&bounce, light_pdfs[k]);
        const aur_vector light = aur_vector_multiply(aur_lane_vector(&g->lanes.throughput, k), sky);
        aur_lane_set(&g->lanes.sum, k,
                     aur_vector_add_scaled(aur_lane_vector(&g->lanes.sum, k), weight, light));
        if (g->sensor.from_sky != NULL)
            g->sensor.from_sky(g->sensor.from_sky_user, k, aur_lane_vector(&directions, k),
                               aur_vector_scale(light, weight), unscattered);
    }
}

static void add_emission(aur_path_group *g, size_t k, const aur_surface *surface) {
    if (surface->emitter == AUR_NO_EMITTER ||
        (g->sensor.light_shares != NULL && aur_has_lane(g->sensor.unscattered, k) &&
         g->sensor.light_shares[surface->emitter] >= 0.0f))
        return;
    aur_walk walk = walk_of(g, k);
    aur_walk_add_emission(g->scene, surface, &walk);
    aur_lane_set(&g->lanes.sum, k, walk.radiance);
}

/* The surfaces of lanes that are not plain, with the light that they give. */
static void set_surfaces(aur_path_group *g, uint32_t lanes) {
    aur_packet_prefetch_indices(g->scene, &g->packet, lanes);
    aur_packet_prefetch_vertices(g->scene, &g->packet, lanes);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const aur_ray ray = aur_packet_ray(&g->packet, k);
        const aur_hit hit = aur_packet_hit(g->scene, &g->packet, k);
        aur_scene_surface(g->scene, &ray, &hit, &g->surfaces[k]);
        aur_surface_prefetch(g->scene, &g->surfaces[k]);
    }
    for (uint32_t rest = lanes & ~g->preset; rest != 0; rest &= rest - 1)
        add_emission(g, aur_first_lane(rest), &g->surfaces[aur_first_lane(rest)]);
}

static aur_vector view_of(const aur_path_group *g, size_t k) {
    return aur_vector_scale(aur_packet_ray(&g->packet, k).direction, -1.0f);
}

/* Where light arrives at lanes that are not plain. */
static void set_references(aur_path_group *g, uint32_t lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const size_t k = aur_first_lane(lanes);
        const aur_shading shading = aur_shading_at(&g->surfaces[k], view_of(g, k));
        const aur_light_reference reference = aur_shading_reference(&shading);
        aur_lane_set(&g->lanes.position, k, g->surfaces[k].position);
        aur_lane_set(&g->lanes.origin, k, reference.position);
        aur_lane_set(&g->lanes.facing, k, reference.normal);
    }
}

/* Sets the shadow ray of a lane that is not plain, from its light sample. */
static void shadow_one(aur_path_group *g, size_t k, const aur_surface *surface) {
    const aur_shading shading = aur_shading_at(surface, view_of(g, k));
    const aur_light_sample light = aur_light_lane(&g->lanes.light, k);
    aur_shadow shadow;
    g->lanes.lit[k] = 0;
    if (!aur_vertex_light(&shading, AUR_VERTEX_ALL, AUR_VERTEX_ONE_EACH, &light, &shadow))
        return;
    g->lanes.lit[k] = -1;
    aur_packet_set(&g->shadows, k, &shadow.ray);
    aur_lane_set(&g->lanes.shadow, k,
                 aur_vector_multiply(aur_lane_vector(&g->lanes.throughput, k), shadow.radiance));
}

/* Scatters a lane that is not plain; `before` is its path. */
static bool scatter_one(aur_path_group *g, size_t k, const aur_walk *before, bool unscattered,
                        bool roulette) {
    const aur_surface *const surface = &g->surfaces[k];
    const aur_shading shading = aur_shading_at(surface, aur_vector_scale(before->ray.direction, -1.0f));
    const float u[3] = {g->lanes.lobe[k], g->lanes.direction_u[k], g->lanes.direction_v[k]};
    aur_walk walk = *before;
    if (!aur_walk_scatter(&shading, AUR_VERTEX_ALL, u, &walk) ||
        (roulette && !aur_vertex_survives(aur_survival(walk.beta), g->lanes.roulette[k], &walk.beta)))
        return false;
    const bool through = aur_walk_passed(surface, before->ray.direction, &walk);
    if (through && (g->sensor.panes || g->background))
        g->sensor.unscattered |= (uint32_t)unscattered << k;
    /* The ray behind a pane is the same ray, which shadow rays find as well. */
    if (through && g->sensor.panes) {
        walk.bounce = before->bounce;
        walk.ray = aur_surface_ray(surface, before->ray.direction);
    }
    aur_lane_set(&g->lanes.throughput, k, walk.beta);
    aur_lane_set(&g->lanes.from, k, walk.bounce.from.position);
    aur_lane_set(&g->lanes.from_normal, k, walk.bounce.from.normal);
    g->lanes.pdf[k] = walk.bounce.pdf;
    g->specular |= (uint32_t)walk.bounce.specular_bounce << k;
    aur_packet_set(&g->packet, k, &walk.ray);
    return true;
}

/* --- a bounce */

/* The reflectance of a lane whose shape has a texture, on the visible side; the triangle's corners are set.
 */
static void set_textured_albedo(aur_path_group *g, size_t k) {
    const aur_vector corner = aur_lane_vector(&g->lanes.corner[0], k);
    const aur_vector b = aur_vector_subtract(aur_lane_vector(&g->lanes.corner[1], k), corner);
    const aur_vector c = aur_vector_subtract(aur_lane_vector(&g->lanes.corner[2], k), corner);
    const aur_vector way = aur_packet_ray(&g->packet, k).direction;
    const bool behind = aur_vector_dot(aur_vector_cross(b, c), way) > 0.0f;
    const aur_bsdf *const bsdf = aur_scene_shape_bsdf(g->scene, g->packet.query.hit.geomID[k]);
    aur_vector albedo = {0};
    if (!behind || bsdf->scatters_from_behind)
        albedo =
            aur_bsdf_diffuse_albedo(bsdf, aur_packet_texture(g->scene, &g->packet, k), behind ? -1.0f : 1.0f);
    aur_lane_set(&g->lanes.albedo[0], k, behind ? (aur_vector){0} : albedo);
    aur_lane_set(&g->lanes.albedo[1], k, behind ? albedo : (aur_vector){0});
}

/* Prepares triangles and reflectances of the lanes whose surface the kernels support, and returns them. */
static uint32_t plain_lanes(aur_path_group *g, uint32_t lanes) {
    const struct RTCHit16 *const hits = &g->packet.query.hit;
    uint32_t plain = 0, textured = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        if (hits->instID[0][k] != RTC_INVALID_GEOMETRY_ID)
            continue;
        const aur_shape_class *const class = &g->data->classes[hits->geomID[k]];
        if (!class->plain_flat && !class->textured_flat)
            continue;
        plain |= 1u << k;
        textured |= (uint32_t) class->textured_flat << k;
        aur_lane_set(&g->lanes.albedo[0], k, class->albedo[0]);
        aur_lane_set(&g->lanes.albedo[1], k, class->albedo[1]);
    }
    aur_packet_corners(g->scene, &g->packet, plain, g->lanes.corner);
    for (uint32_t rest = textured; rest != 0; rest &= rest - 1)
        set_textured_albedo(g, aur_first_lane(rest));
    return plain;
}

static uint32_t trace(aur_path_group *g, bool coherent) {
    aur_packet_set_lanes(&g->packet, g->alive);
    return aur_scene_intersect16(g->scene, coherent ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT,
                                 &g->packet);
}

/* For scenes lit by environments only. */
static void report_sky(aur_path_group *g, uint32_t lit) {
    for (; lit != 0; lit &= lit - 1) {
        const size_t k = aur_first_lane(lit);
        g->sensor.from_sky(g->sensor.from_sky_user, k, aur_packet_ray(&g->shadows, k).direction,
                           aur_lane_vector(&g->lanes.shadow, k), false);
    }
}

aur_vector aur_path_group_passed(const aur_path_group *g, size_t lane, float farthest, uint32_t depth) {
    if (!g->sensor.panes || depth + 1 >= g->data->max_depth)
        return (aur_vector){0};
    aur_ray ray = aur_packet_ray(&g->shadows, lane);
    ray.farthest = farthest;
    const uint32_t most = g->data->max_depth - depth - 1;
    return aur_panes_passed(g->scene, &ray, most < MOST_PANES ? most : MOST_PANES);
}

/* Of the occluded lanes, returns those that are lit through panes and scales their contribution by the
 * transmittance. */
static uint32_t pass_panes(aur_path_group *g, uint32_t stopped, const float *farthest, uint32_t depth) {
    uint32_t through = 0;
    for (uint32_t rest = g->sensor.panes ? stopped : 0; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        const aur_vector left = aur_path_group_passed(g, k, farthest[k], depth);
        if (aur_vector_is_zero(left))
            continue;
        aur_lane_set(&g->lanes.shadow, k, aur_vector_multiply(aur_lane_vector(&g->lanes.shadow, k), left));
        through |= 1u << k;
    }
    return through;
}

/* Draws light samples, traces their shadow rays, and adds their contributions. */
static void draw_lights(aur_path_group *g, const float *choice, const float *u, const float *v) {
    aur_vertex_lanes *const lanes = &g->lanes;
    const uint32_t plain = g->plain, others = g->alive & ~plain;
    const aur_light_references references = {&lanes->origin, &lanes->facing};
    if (plain != 0) {
        aur_light_lanes_direct(g->scene, plain, &references, choice, u, v, &lanes->light);
        g->data->kernels->shadow(lanes, &g->shadows);
    }
    if (others != 0)
        aur_light_lanes_each(g->scene, others, &references, choice, u, v, &lanes->light);
    for (uint32_t rest = others; rest != 0; rest &= rest - 1)
        shadow_one(g, aur_first_lane(rest), &g->surfaces[aur_first_lane(rest)]);
}

/* The same for one of several candidates. */
static void draw_candidates(aur_path_group *g) {
    aur_vertex_lanes *const lanes = &g->lanes;
    const aur_vertex_kernels *const kernels = g->data->kernels;
    aur_vertex_candidates selected = {0};
    for (uint32_t i = 0; i < g->candidates; ++i) {
        aur_lane_numbers choice, u, v;
        float shift[3];
        aur_candidate_shift(i, g->candidates, shift);
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            choice[k] = aur_candidate_number(lanes->choice[k], shift[0]);
            u[k] = aur_candidate_number(lanes->light_u[k], shift[1]);
            v[k] = aur_candidate_number(lanes->light_v[k], shift[2]);
        }
        draw_lights(g, choice, u, v);
        kernels->consider(lanes, &g->shadows, &selected);
    }
    kernels->choose(&selected, g->candidates, lanes, &g->shadows);
}

/* Adds direct light. */
static void add_direct(aur_path_group *g, uint32_t depth) {
    aur_vertex_lanes *const lanes = &g->lanes;
    set_references(g, g->alive & ~g->plain);
    if (g->candidates > 1)
        draw_candidates(g);
    else
        draw_lights(g, lanes->choice, lanes->light_u, lanes->light_v);
    const uint32_t lit = aur_lanes_set(lanes->lit) & g->alive;
    if (lit == 0)
        return;
    aur_packet_set_lanes(&g->shadows, lit);
    float farthest[AUR_PACKET_SIZE];
    memcpy(farthest, g->shadows.query.ray.tfar, sizeof farthest);
    uint32_t stopped = aur_scene_occluded16(
        g->scene, g->coherent ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT, &g->shadows);
    stopped &= ~pass_panes(g, stopped & lit, farthest, depth);
    g->data->kernels->add(lanes, lit & ~stopped);
    if (g->sensor.from_sky != NULL)
        report_sky(g, lit & ~stopped);
}

static void scatter(aur_path_group *g, bool roulette) {
    const uint32_t plain = g->plain, others = g->alive & ~plain, unscattered = g->sensor.unscattered;
    aur_walk before[AUR_PACKET_SIZE]; /* the kernels overwrite it */
    for (uint32_t rest = others; rest != 0; rest &= rest - 1)
        before[aur_first_lane(rest)] = walk_of(g, aur_first_lane(rest));
    uint32_t alive = 0;
    if (plain != 0) {
        g->data->kernels->scatter(&g->lanes, roulette, &g->packet);
        alive = aur_lanes_set(g->lanes.alive) & plain;
    }
    g->specular = g->sensor.unscattered = 0;
    for (uint32_t rest = others; rest != 0; rest &= rest - 1) {
        const size_t k = aur_first_lane(rest);
        alive |= (uint32_t)scatter_one(g, k, &before[k], aur_has_lane(unscattered, k), roulette) << k;
    }
    g->alive = alive;
}

/* Whether rays that leave the surfaces are nearly parallel, and so a coherent packet: the lanes share random
 * numbers, and most lie in one plane. A function of normals and positions, never of timing. */
static bool are_parallel(const aur_path_group *g) {
    if (!g->data->interleaved || g->plain == 0)
        return false;
    const uint32_t flat = g->plain & ~g->data->kernels->tilted(&g->lanes, aur_first_lane(g->plain));
    return 2 * aur_lane_count(flat) >= aur_lane_count(g->alive);
}

void aur_path_group_hit(aur_path_group *g, uint32_t depth) {
    const uint32_t found = trace(g, depth == 1 || g->coherent);
    if (g->has_sky)
        add_sky(g, g->alive & ~found & ~g->preset);
    g->alive &= found;
    g->plain = plain_lanes(g, g->alive);
    if (g->plain != 0)
        g->data->kernels->surface(&g->lanes, &g->packet);
    set_surfaces(g, g->alive & ~g->plain);
    g->preset = 0;
}

void aur_path_group_scatter(aur_path_group *g, uint32_t depth) {
    if (g->data->interleaved)
        shared_numbers(g, depth);
    else
        draw_numbers(g, depth, g->alive != g->plain);
    g->coherent = are_parallel(g);
    if (g->has_lights)
        add_direct(g, depth);
    scatter(g, depth >= g->data->rr_depth);
}

void aur_path_group_trace(aur_path_group *g, uint32_t depth) {
    for (; depth <= g->data->max_depth && g->alive != 0; ++depth) {
        aur_path_group_hit(g, depth);
        if (depth == g->data->max_depth || aur_path_stops(depth, &g->stopped))
            return;
        aur_path_group_scatter(g, depth);
    }
}

void aur_path_group_prepare(const aur_path *data, const aur_scene *scene, const aur_sampler *sampler,
                            aur_path_group *g) {
    g->data = data;
    g->scene = scene;
    g->sampler = sampler;
    g->stopped = false;
    g->has_lights = aur_scene_emitter_count(scene) > 0;
    g->has_sky = aur_scene_has_background(scene);
    g->chooses = aur_light_chooses(scene);
    g->candidates = data->candidates > 1 ? data->candidates : 1;
    aur_packet_clear(&g->packet);
    aur_packet_clear(&g->shadows);
}
