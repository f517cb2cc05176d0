/* Ambient occlusion: the part of the hemisphere over a point, weighted by the cosine, that is open (Zhukov
 * 1998; Schretter 2012, fig. 5). One pattern of directions an image, shared out among the samples of a pixel
 * as final gathering does it, its rotations interleaved over blocks of 4 by 4 pixels. */
#include "transport/integrators/ambient_occlusion.h"

#include <stdlib.h>

#include "transport/gather/rule.h"

typedef struct occlusion_data {
    size_t samples_per_pixel;
    uint64_t seed;
    float max_distance;
    aur_gather_rule rule;
} occlusion_data;

static void release(aur_integrator *integrator) {
    occlusion_data *const data = integrator->data;
    aur_gather_rule_release(&data->rule);
    free(data);
}

typedef struct occlusion_parameters {
    int64_t samples, rotations, max_depth;
    uint64_t pattern_seed;
    const char *pattern, *map, *scramble; /* scramble NULL: not given */
    double max_distance;
    bool cosine;
    enum { PIXEL_FILTER, PIXEL_CENTRE } pixel;
} occlusion_parameters;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(occlusion_parameters, "samples", samples, 1, 1 << 30, "64",
                        "directions a pixel, shared out among its samples")},
    {AUR_KEY_OF_TEXT(occlusion_parameters, "pattern", pattern, "spherical-fibonacci",
                     "SET of the directions")},
    {AUR_KEY_OF_TEXT(occlusion_parameters, "map", map, "lambert",
                     "map of a square set to the hemisphere: lambert, concentric, azimuthal or polar")},
    {AUR_KEY_OF_TEXT(occlusion_parameters, "scramble", scramble, "rotate (nets: digit)",
                     "how a pattern is randomised: none, digit, owen, shift or rotate"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(occlusion_parameters, "rotations", rotations, 0, 65536, "16",
                        "randomisations made beforehand; 0 is one of its own for every pixel")},
    {AUR_KEY_OF_REAL(occlusion_parameters, "max_distance", max_distance, 0.0, INFINITY, "infinity",
                     "what is farther, in scene units, does not occlude")},
    {AUR_KEY_OF_BOOLEAN(occlusion_parameters, "cosine", cosine, "true",
                        "directions weighted by the cosine, else evenly")},
    {AUR_KEY_OF_CHOICE(occlusion_parameters, "pixel", pixel, "filter",
                       "camera rays over the pixel, or through its centre", "filter", "centre")},
    {AUR_KEY_OF_INTEGER(occlusion_parameters, "pattern_seed", pattern_seed, 0, INFINITY, "0",
                        "another randomisation of the pattern under the same seed")},
    {AUR_KEY_OF_INTEGER(occlusion_parameters, "max_depth", max_depth, -1, 1 << 20, "-1",
                        "of no effect: scenes set it for whatever integrator is asked for")},
};

static aur_result make_rule(const occlusion_parameters *p, const aur_integrator_context *context,
                            occlusion_data *data, aur_error *error) {
    const aur_set_description *const row = aur_set_find(p->pattern);
    const bool net = row != NULL && row->binary_net;
    const size_t shares = context->samples_per_pixel;
    aur_gather_rule_options options = {.set = p->pattern,
                                       .count = ((size_t)p->samples + shares - 1) / shares * shares,
                                       .scramble = net ? AUR_SCRAMBLE_DIGIT : AUR_SCRAMBLE_ROTATE,
                                       .rotations = (size_t)p->rotations,
                                       .seed = data->seed,
                                       .set_seed = data->seed,
                                       .warnings = context->warnings};
    aur_result result = aur_map_from_name(p->map, &options.map, error);
    if (result == AUR_OK && p->scramble != NULL)
        result = aur_scramble_from_name(p->scramble, &options.scramble, error);
    if (result == AUR_OK && options.scramble == AUR_SCRAMBLE_ROTATE3D)
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED,
                          "ao: 'rotate3d' would turn the pattern out of its hemisphere; use 'rotate'");
    if (result == AUR_OK)
        result = aur_gather_rule_create(&options, p->cosine ? 1.0 : 0.0, &data->rule, error);
    return result;
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    occlusion_parameters p = {.scramble = NULL};
    const aur_result result = aur_row_read(&integrator->descriptor->row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    occlusion_data *const data = calloc(1, sizeof *data);
    if (data == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    integrator->data = data;
    integrator->pixel_centre = p.pixel == PIXEL_CENTRE;
    data->samples_per_pixel = context->samples_per_pixel;
    data->seed = aur_hash2(context->seed, p.pattern_seed);
    data->max_distance = (float)p.max_distance;
    return make_rule(&p, context, data, error);
}

/* --- places --- */

static void put(float arrays[3][AUR_OCCLUSION_PLACES], size_t place, aur_vector v) {
    arrays[0][place] = v.x;
    arrays[1][place] = v.y;
    arrays[2][place] = v.z;
}

/* Surfaces are seen from either side. */
static void set_place(const aur_scene *scene, const aur_ray *ray, const aur_hit *hit, size_t place,
                      aur_occlusion_places *places) {
    aur_surface surface;
    aur_scene_surface(scene, ray, hit, &surface);
    const float side = aur_vector_dot(surface.geometric_normal, ray->direction) > 0.0f ? -1.0f : 1.0f;
    const aur_frame frame = aur_frame_about(aur_vector_scale(surface.frame.z, side));
    put(places->origin, place,
        aur_surface_ray(&surface, aur_vector_scale(surface.geometric_normal, side)).origin);
    put(places->axis[0], place, frame.x);
    put(places->axis[1], place, frame.y);
    put(places->axis[2], place, frame.z);
    places->seen[place] = true;
}

void aur_occlusion_find_places(const aur_view *view, size_t x, size_t y, uint32_t index,
                               aur_occlusion_places *places) {
    aur_packet packet;
    aur_packet_clear(&packet);
    aur_ray rays[AUR_PACKET_SIZE];
    for (size_t block = 0; block < AUR_PACKET_SIZE; ++block) {
        for (size_t within = 0; within < AUR_PACKET_SIZE; ++within) {
            const size_t place = within * AUR_PACKET_SIZE + block;
            const size_t pixel = aur_group_pixel((uint32_t)within, block);
            aur_camera_sample sample;
            places->weight[place] =
                aur_view_sample(view, x + pixel % AUR_TILE_SIZE, y + pixel / AUR_TILE_SIZE, index, &sample);
            places->pixel[place] = sample.stream.pixel;
            places->seen[place] = false;
            rays[within] = sample.ray;
            aur_packet_set(&packet, within, &sample.ray);
        }
        const uint32_t hits = aur_scene_intersect16(view->scene, AUR_EMBREE_COHERENT, &packet);
        for (size_t within = 0; within < AUR_PACKET_SIZE; ++within)
            if ((hits >> within & 1) != 0) {
                const aur_hit hit = aur_packet_hit(view->scene, &packet, within);
                set_place(view->scene, &rays[within], &hit, within * AUR_PACKET_SIZE + block, places);
            }
    }
}

/* --- rays --- */

/* Packets are fast together where their surface is flat, and slower than apart where it is not. */
static aur_embree_order order_of(const aur_occlusion_places *places, size_t first) {
    const float(*const normal)[AUR_OCCLUSION_PLACES] = places->axis[2];
    float least = 1.0f;
    bool all = true;
    for (size_t k = first; k < first + AUR_PACKET_SIZE; ++k) {
        const float cosine = normal[0][first] * normal[0][k] + normal[1][first] * normal[1][k] +
                             normal[2][first] * normal[2][k];
        least = fminf(least, cosine);
        all = all && places->seen[k];
    }
    return all && least > 0.999f ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
}

/* One local direction in the frames of 16 places. */
static void aim(const aur_occlusion_places *places, size_t first, aur_vector local, struct RTCRay16 *rays) {
    float *const out[3] = {rays->dir_x, rays->dir_y, rays->dir_z};
    for (size_t c = 0; c < 3; ++c) {
        const float *const x = places->axis[0][c] + first;
        const float *const y = places->axis[1][c] + first;
        const float *const z = places->axis[2][c] + first;
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            out[c][k] = local.x * x[k] + local.y * y[k] + local.z * z[k];
    }
}

/* Every place by a randomisation of its own. */
static void aim_apart(const aur_gather_rule *rule, const aur_occlusion_places *places, size_t first,
                      const aur_gather_rotation turns[AUR_PACKET_SIZE], size_t index, struct RTCRay16 *rays) {
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        aur_vector local;
        aur_gather_rule_direction(rule, &turns[k], index, &local);
        float direction[3];
        for (size_t c = 0; c < 3; ++c)
            direction[c] = local.x * places->axis[0][c][first + k] + local.y * places->axis[1][c][first + k] +
                           local.z * places->axis[2][c][first + k];
        rays->dir_x[k] = direction[0];
        rays->dir_y[k] = direction[1];
        rays->dir_z[k] = direction[2];
    }
}

static void set_distances(const occlusion_data *data, struct RTCRay16 *rays) {
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        rays->tfar[k] = data->max_distance;
}

size_t aur_occlusion_visit(const aur_integrator *integrator, const aur_occlusion_places *places, size_t x,
                           size_t y, uint32_t index, aur_occlusion_visitor visit, void *context) {
    const occlusion_data *const data = integrator->data;
    const aur_gather_rule *const rule = &data->rule;
    const uint64_t tile = aur_hash3(data->seed, y, x) >> 8;
    aur_packet packet;
    aur_packet_clear(&packet);
    for (size_t within = 0; within < AUR_PACKET_SIZE; ++within) {
        const size_t first = within * AUR_PACKET_SIZE;
        bool any = false;
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            packet.valid[k] = places->seen[first + k] ? -1 : 0;
            packet.query.ray.org_x[k] = places->origin[0][first + k];
            packet.query.ray.org_y[k] = places->origin[1][first + k];
            packet.query.ray.org_z[k] = places->origin[2][first + k];
            any = any || places->seen[first + k];
        }
        if (!any)
            continue;
        const aur_embree_order order = order_of(places, first);
        const bool together = rule->rotation_count > 0 || rule->scramble == AUR_SCRAMBLE_NONE;
        aur_gather_rotation turns[AUR_PACKET_SIZE];
        for (size_t k = 0; k < (together ? 1 : AUR_PACKET_SIZE); ++k)
            turns[k] =
                aur_gather_rule_rotation(rule, together ? tile + aur_group_rank((uint32_t)within)
                                                        : aur_hash2(data->seed, places->pixel[first + k]));
        for (size_t i = index % data->samples_per_pixel; i < rule->count; i += data->samples_per_pixel) {
            if (together) {
                aur_vector local;
                aur_gather_rule_direction(rule, &turns[0], i, &local);
                aim(places, first, local, &packet.query.ray);
            } else {
                aim_apart(rule, places, first, turns, i, &packet.query.ray);
            }
            set_distances(data, &packet.query.ray);
            visit(context, first, order, &packet);
        }
    }
    return rule->count / data->samples_per_pixel;
}

typedef struct occlusion_sums {
    const aur_scene *scene;
    uint32_t stopped[AUR_OCCLUSION_PLACES];
} occlusion_sums;

static void trace(void *context, size_t first, aur_embree_order order, aur_packet *packet) {
    occlusion_sums *const sums = context;
    const uint32_t stopped = aur_scene_occluded16(sums->scene, order, packet);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        sums->stopped[first + k] += stopped >> k & 1;
}

/* The whole tile is done even where a part of it is wanted: what lies beside a ray in its packet is always
 * the same. */
static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    const size_t x = tile->x0 - tile->x0 % AUR_TILE_SIZE, y = tile->y0 - tile->y0 % AUR_TILE_SIZE;
    aur_occlusion_places places = {0};
    for (uint32_t i = tile->first; i < tile->first + tile->count; ++i) {
        occlusion_sums sums = {.scene = integrator->scene};
        aur_occlusion_find_places(tile->view, x, y, i, &places);
        const size_t directions = aur_occlusion_visit(integrator, &places, x, y, i, trace, &sums);
        for (size_t place = 0; place < AUR_OCCLUSION_PLACES; ++place) {
            const size_t pixel =
                aur_group_pixel((uint32_t)(place / AUR_PACKET_SIZE), place % AUR_PACKET_SIZE);
            const size_t px = x + pixel % AUR_TILE_SIZE, py = y + pixel / AUR_TILE_SIZE;
            tile->counters.rays += 1 + (places.seen[place] ? directions : 0);
            if (px < tile->x0 || px >= tile->x1 || py < tile->y0 || py >= tile->y1)
                continue;
            const float open = 1.0f - (float)sums.stopped[place] / (float)directions;
            aur_tile_add(tile, px, py, places.weight[place], (aur_vector){open, open, open});
        }
    }
    return AUR_OK;
}

const aur_integrator_descriptor aur_integrator_ambient_occlusion = {
    .row = {.name = "ao",
            .summary = "ambient occlusion: how much of the hemisphere over a point is open",
            .source = "Zhukov 1998, Schretter 2012",
            AUR_ROW_KEYS(keys)},
    .create = create,
    .release = release,
    .tile = tile,
};
