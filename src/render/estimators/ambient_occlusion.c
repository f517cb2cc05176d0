/* Ambient occlusion: the unoccluded fraction of the hemisphere over a point, weighted by the cosine (Zhukov
 * 1998; Schretter 2012, fig. 5). There is one pattern of directions per image, split among the samples of a
 * pixel as in final gathering, with rotations interleaved over blocks of 4 by 4 pixels. */
#include "render/film/integrator.h"
#include "render/occlusion/rays.h"

typedef struct occlusion_data {
    aur_occlusion occlusion; /* first: what the bench reads */
    aur_gather_rule_options pattern;
    const char *map, *scramble; /* scramble NULL: not given */
    bool cosine;
    enum { PIXEL_FILTER, PIXEL_CENTRE } pixel;
} occlusion_data;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(occlusion_data, "samples", pattern.count, 1, 1 << 30, "64",
                        "directions per pixel, split among its samples")},
    {AUR_KEY_OF_TEXT(occlusion_data, "pattern", pattern.set, "spherical-fibonacci",
                     "point set (SET) of the directions")},
    {AUR_KEY_OF_TEXT(occlusion_data, "map", map, "lambert",
                     "map of a square set to the hemisphere: lambert, concentric or azimuthal")},
    {AUR_KEY_OF_TEXT(occlusion_data, "scramble", scramble, "rotate (nets: digit)",
                     "how a pattern is randomised: none, digit, owen, shift or rotate"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(occlusion_data, "rotations", pattern.rotations, 0, 65536, "16",
                        "number of prepared randomisations; 0: a separate one for every pixel")},
    {AUR_KEY_OF_REAL(occlusion_data, "max_distance", occlusion.max_distance, 0.0, INFINITY, "infinity",
                     "largest distance of occluders, in scene units")},
    {AUR_KEY_OF_BOOLEAN(occlusion_data, "cosine", cosine, "true",
                        "cosine-weighted directions; false: uniform ones")},
    {AUR_KEY_OF_CHOICE(occlusion_data, "pixel", pixel, "filter",
                       "camera rays over the pixel, or through its centre", "filter", "centre")},
    {AUR_KEY_OF_INTEGER(occlusion_data, "pattern_seed", pattern.seed, 0, INFINITY, "0",
                        "another randomisation of the pattern under the same seed")},
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    (void)parameters;
    occlusion_data *const data = integrator->data;
    aur_gather_rule_options *const pattern = &data->pattern;
    /* AUR_SAMPLES_PER_PIXEL_MAX: final sample count unknown. Many samples share long patterns, whose heights,
     * which rotations do not change, are close together; each sample uses an eighth of `samples`. */
    enum { MOST_SAMPLES = 1 << 16, SAMPLES_A_PATTERN = 128, PATTERN_LENGTH = 16 };
    data->occlusion.renews = context->samples_per_pixel > MOST_SAMPLES;
    const size_t shares = data->occlusion.renews ? SAMPLES_A_PATTERN : context->samples_per_pixel;
    integrator->pixel_centre = data->pixel == PIXEL_CENTRE;
    if (data->occlusion.renews)
        pattern->count *= PATTERN_LENGTH;
    data->occlusion.samples_per_pattern = shares;
    data->occlusion.part_stride = aur_gather_part_stride(shares);
    data->occlusion.seed = aur_hash2(context->seed, pattern->seed);
    pattern->count = (pattern->count + shares - 1) / shares * shares;
    pattern->seed = pattern->set_seed = data->occlusion.seed;
    pattern->warnings = context->warnings;
    const aur_result result = aur_gather_rule_options_name(pattern, "ao", data->map, data->scramble, error);
    /* Scramblings prepared in advance would repeat. */
    if (data->occlusion.renews && pattern->scramble != AUR_SCRAMBLE_ROTATE)
        pattern->rotations = 0;
    return result == AUR_OK
               ? aur_gather_rule_create(pattern, data->cosine ? 1.0 : 0.0, &data->occlusion.rule, error)
               : result;
}

static void release(aur_integrator *integrator) {
    aur_gather_rule_release(&((occlusion_data *)integrator->data)->occlusion.rule);
}

typedef struct occlusion_sums {
    const aur_scene *scene;
    uint32_t stopped[AUR_OCCLUSION_POINTS];
} occlusion_sums;

static void trace(void *context, size_t first, aur_embree_order order, aur_packet *packet) {
    occlusion_sums *const sums = context;
    const uint32_t stopped = aur_scene_occluded16(sums->scene, order, packet);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        sums->stopped[first + k] += stopped >> k & 1;
}

/* The whole tile is traced even if only a part of it is needed: a ray's packet must always have the same
 * other rays. */
static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    const size_t x = tile->x0 - tile->x0 % AUR_TILE_SIZE, y = tile->y0 - tile->y0 % AUR_TILE_SIZE;
    aur_occlusion_points surface_points = {0};
    for (uint32_t i = tile->first; i < tile->first + tile->count; ++i) {
        occlusion_sums sums = {.scene = integrator->scene};
        aur_occlusion_find_points(tile->view, x, y, i, &surface_points);
        const size_t directions =
            aur_occlusion_visit(integrator->data, &surface_points, x, y, i, trace, &sums);
        for (size_t surface_point = 0; surface_point < AUR_OCCLUSION_POINTS; ++surface_point) {
            const size_t pixel =
                aur_group_pixel(surface_points.arrangement, (uint32_t)(surface_point / AUR_PACKET_SIZE),
                                surface_point % AUR_PACKET_SIZE);
            const size_t px = x + pixel % AUR_TILE_SIZE, py = y + pixel / AUR_TILE_SIZE;
            if (px < tile->x0 || px >= tile->x1 || py < tile->y0 || py >= tile->y1 ||
                !aur_tile_needs(tile, px, py, i))
                continue;
            const float open = 1.0f - (float)sums.stopped[surface_point] / (float)directions;
            aur_tile_add(tile, px, py, i, surface_points.offset[surface_point],
                         (aur_vector){open, open, open});
        }
    }
    return AUR_OK;
}

const aur_integrator_descriptor aur_integrator_ambient_occlusion = {
    .row = {.name = "ao",
            .summary = "ambient occlusion: the visible part of the hemisphere above a point",
            .source = "Zhukov 1998, Schretter 2012",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(occlusion_data),
    .create = create,
    .release = release,
    .tile = tile,
    .cuts = true,
    .own_image = true,
};
