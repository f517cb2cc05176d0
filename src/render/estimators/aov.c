/* Properties of the visible surfaces (AOVs), in channels after the radiance of another integrator, named as
 * in Mitsuba 3. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/names.h"
#include "points/base/random.h"
#include "render/film/integrator.h"
#include "render/trace/packet.h"

enum { NAME_CAPACITY = 96, CHANNEL_CAPACITY = AUR_EXTRA_CHANNELS_MAX };

/* One sample as the channels see it. */
typedef struct aov_sample {
    aur_vector radiance;
    const aur_ray *ray;
    const aur_hit *hit; /* NULL: the ray hits nothing, and the rest is 0 */
    const aur_surface *surface;
    const double *origin; /* of the scene's coordinates */
    uint64_t hash;        /* for random numbers */
} aov_sample;

typedef struct aov_type {
    const char *name;
    const char *letters; /* one per channel */
    void (*evaluate)(const aov_sample *sample, float *values);
} aov_type;

static void put(aur_vector v, float *values) {
    values[0] = v.x;
    values[1] = v.y;
    values[2] = v.z;
}

static void albedo(const aov_sample *sample, float *values) {
    const aur_surface *const surface = sample->surface;
    const float side = -aur_vector_dot(surface->frame.z, sample->ray->direction);
    put(aur_bsdf_diffuse_albedo(surface->bsdf, surface->texture, side), values);
}

static aur_vector without_bending(aur_vector value, float ior_squared) {
    return aur_vector_scale(value, ior_squared > 0.0f ? ior_squared : 1.0f);
}

/* The share of equal light from all directions that reaches the eye, without the concentration by refraction.
 * Only lobes without a closed form are sampled: denoisers take this as free of noise. */
static void reflectance(const aov_sample *sample, float *values) {
    const aur_surface *const surface = sample->surface;
    const aur_bsdf *const bsdf = surface->bsdf;
    const aur_vector view =
        aur_frame_to_local(&surface->frame, aur_vector_scale(sample->ray->direction, -1.0f));
    aur_vector sum = aur_bsdf_diffuse_albedo(bsdf, surface->texture, view.z);
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    const size_t count = aur_bsdf_lobes(bsdf, surface->texture, view, lobes);
    bool sampled = false;
    for (size_t i = 0; i < count; ++i) {
        if (lobes[i].shape == AUR_LOBE_SHAPE_SPECULAR)
            sum = aur_vector_add(sum, without_bending(lobes[i].coefficient, lobes[i].ior_squared));
        else if (lobes[i].shape == AUR_LOBE_SHAPE_COSINE_POWER && !lobes[i].diffuse)
            sum = aur_vector_add_scaled(sum, 2.0f * AUR_PI_F / (lobes[i].exponent + 1.0f),
                                        lobes[i].coefficient);
        sampled = sampled || lobes[i].shape == AUR_LOBE_SHAPE_SAMPLED;
    }
    uint64_t hash = sample->hash;
    float u[3];
    aur_draw_units(&hash, u);
    aur_bsdf_sample drawn;
    if (sampled && aur_bsdf_draw(bsdf, AUR_BSDF_SAMPLED_LOBES, surface->texture, view, u, &drawn) &&
        !drawn.specular)
        sum = aur_vector_add(sum, without_bending(drawn.weight, drawn.ior_squared));
    put(sum, values);
}

static void depth(const aov_sample *sample, float *values) {
    values[0] = sample->hit->distance;
}

static void position(const aov_sample *sample, float *values) {
    double surface_point[3];
    aur_vector_to_doubles(sample->surface->position, surface_point);
    for (size_t i = 0; i < 3; ++i)
        values[i] = (float)(surface_point[i] + sample->origin[i]);
}

static void uv(const aov_sample *sample, float *values) {
    values[0] = sample->surface->texture.u;
    values[1] = sample->surface->texture.v;
}

static void geo_normal(const aov_sample *sample, float *values) {
    put(sample->surface->geometric_normal, values);
}

static void sh_normal(const aov_sample *sample, float *values) {
    put(sample->surface->frame.z, values);
}

static void prim_index(const aov_sample *sample, float *values) {
    values[0] = (float)sample->hit->primitive;
}

/* Numbered from 1; 0 means none. */
static void shape_index(const aov_sample *sample, float *values) {
    values[0] = (float)(sample->hit->shape + 1);
}

/* The film computes these two from its sums: see channel_kind. */
static void sample_count(const aov_sample *sample, float *values) {
    (void)sample;
    values[0] = 0.0f;
}

static void variance(const aov_sample *sample, float *values) {
    put(aur_vector_multiply(sample->radiance, sample->radiance), values);
}

static const aov_type types[] = {
    {"albedo", "RGB", albedo},           {"depth", "T", depth},
    {"position", "XYZ", position},       {"uv", "UV", uv},
    {"geo_normal", "XYZ", geo_normal},   {"sh_normal", "XYZ", sh_normal},
    {"prim_index", "I", prim_index},     {"shape_index", "I", shape_index},
    {"sample_count", "N", sample_count}, {"variance", "RGB", variance},
    {"reflectance", "RGB", reflectance},
};

enum { TYPE_COUNT = sizeof types / sizeof types[0] };

typedef struct aov_data {
    /* From the keys, and invalid after creation: */
    const char *list;
    const aur_parameter *item;

    aur_integrator *nested; /* NULL: none */
    size_t count;
    const aov_type *aovs[CHANNEL_CAPACITY];
    size_t channel_count;
    aur_channel_kind kinds[CHANNEL_CAPACITY];
    char names[CHANNEL_CAPACITY][NAME_CAPACITY];
    const char *name_list[CHANNEL_CAPACITY];
} aov_data;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(aov_data, "aovs", list,
                     "albedo:albedo,normal:sh_normal,position:position,shape:shape_index,"
                     "primitive:prim_index,samples:sample_count,variance:variance",
                     "name:type,...: channels added to the image")},
    {AUR_KEY_OF_ITEM(aov_data, "integrator", item, "path",
                     "integrator of the image; none: only directly visible light", "integrator")},
};

static void release(aur_integrator *integrator) {
    aov_data *const data = integrator->data;
    aur_integrator_destroy(data->nested);
}

static const char *type_name(const void *table, size_t index) {
    (void)table;
    return types[index].name;
}

static aur_channel_kind channel_kind(const aov_type *type, size_t channel) {
    if (type->evaluate == sample_count)
        return AUR_CHANNEL_COUNT;
    return type->evaluate == variance ? (aur_channel_kind)(AUR_CHANNEL_VARIANCE_R + channel)
                                      : AUR_CHANNEL_MEAN;
}

/* "name:type" */
static aur_result add_aov(aov_data *data, const char *text, size_t length, aur_location location,
                          aur_error *error) {
    const char *const colon = memchr(text, ':', length);
    const size_t name_length = colon != NULL ? (size_t)(colon - text) : 0;
    if (colon == NULL || name_length == 0 || name_length + 3 > NAME_CAPACITY)
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "integrator 'aov': '%.*s' is not of the form name:type, with a name of at most %d",
                           length < 64 ? (int)length : 64, text, NAME_CAPACITY - 3);
    char target[NAME_CAPACITY];
    size_t index;
    snprintf(target, sizeof target, "%.*s", (int)(length - name_length - 1), colon + 1);
    const aur_result result = aur_names_choose((aur_names){TYPE_COUNT, type_name, NULL}, "kind of channel",
                                               target, location, &index, error);
    if (result != AUR_OK)
        return result;
    const aov_type *const type = &types[index];
    const size_t channels = strlen(type->letters);
    if (data->channel_count + channels > CHANNEL_CAPACITY)
        return aur_fail_at(error, location, AUR_ERROR_ARGUMENT, "integrator 'aov': more than %d channels",
                           CHANNEL_CAPACITY);
    for (size_t c = 0; c < channels; ++c) {
        char *const name = data->names[data->channel_count];
        snprintf(name, NAME_CAPACITY, "%.*s.%c", (int)name_length, text, type->letters[c]);
        for (size_t i = 0; i < data->channel_count; ++i)
            if (strcmp(data->names[i], name) == 0)
                return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                                   "integrator 'aov': two channels are called '%s'", name);
        data->kinds[data->channel_count] = channel_kind(type, c);
        data->name_list[data->channel_count++] = name;
    }
    data->aovs[data->count++] = type;
    return AUR_OK;
}

static aur_result read_aovs(aov_data *data, const char *text, aur_location location, aur_error *error) {
    while (*text != '\0') {
        const size_t skipped = strspn(text, ", \t\n");
        const size_t length = strcspn(text + skipped, ", \t\n");
        if (length > 0) {
            const aur_result result = add_aov(data, text + skipped, length, location, error);
            if (result != AUR_OK)
                return result;
        }
        text += skipped + length;
    }
    return AUR_OK;
}

static aur_result create_nested(const aur_parameters *parameters, const aur_parameter *item,
                                const aur_integrator_context *context, aov_data *data, aur_error *error) {
    aur_parameters nested;
    aur_result result;
    if (item != NULL && item->kind != AUR_PARAMETER_OBJECT && strcmp(item->text, "none") == 0)
        return AUR_OK;
    if (item != NULL && item->kind == AUR_PARAMETER_OBJECT) {
        if (strcmp(item->object_kind, "integrator") != 0)
            return aur_fail_at(error, item->location, AUR_ERROR_FORMAT,
                               "integrator 'aov': 'integrator' must be an integrator");
        result = aur_parameters_copy(item->object, &nested, error);
    } else {
        result = aur_parameters_parse(&nested, "integrator", item != NULL ? item->text : "path", error);
    }
    if (result != AUR_OK)
        return result;
    result = context->create(&nested, context, &data->nested, error);
    aur_parameters_release(&nested);
    if (result == AUR_OK && data->nested->descriptor->radiance == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                           "integrator 'aov': '%s' renders pixels jointly and cannot be inside",
                           data->nested->descriptor->row.name);
    return result;
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    aov_data *const data = integrator->data;
    aur_result result = read_aovs(data, data->list, parameters->location, error);
    if (result == AUR_OK)
        result = create_nested(parameters, data->item, context, data, error);
    if (result != AUR_OK)
        return result;
    integrator->pixel_centre = data->nested != NULL && data->nested->pixel_centre;
    integrator->extra_count = data->channel_count;
    integrator->extra_names = data->name_list;
    integrator->extra_kinds = data->kinds;
    return AUR_OK;
}

static void add_channels(const aov_data *data, const aov_sample *at, aur_tile *tile, size_t x, size_t y,
                         uint32_t index, const float offset[2]) {
    float values[3 + CHANNEL_CAPACITY] = {0};
    put(at->radiance, values);
    for (size_t i = 0, channel = 3; i < data->count; ++i) {
        if (at->hit != NULL || data->aovs[i]->evaluate == variance)
            data->aovs[i]->evaluate(at, &values[channel]);
        channel += strlen(data->aovs[i]->letters);
    }
    aur_tile_add_channels(tile, x, y, index, offset, values);
}

static uint64_t hash_of(size_t x, size_t y, uint32_t index) {
    return aur_hash4(UINT64_C(0x7265666c656374), x, y, index);
}

static void add_sample(const aur_integrator *integrator, aur_tile *tile, size_t x, size_t y, uint32_t index) {
    const aov_data *const data = integrator->data;
    aur_camera_sample sample;
    aur_view_sample(tile->view, x, y, index, &sample);
    aur_hit hit;
    aur_surface surface;
    const bool found = aur_scene_intersect(integrator->scene, &sample.ray, &hit);
    if (found)
        aur_scene_surface(integrator->scene, &sample.ray, &hit, &surface);
    const aur_vector radiance = data->nested->descriptor->radiance(data->nested, &sample, &tile->counters);
    const aov_sample at = {.radiance = aur_tile_measured(tile, radiance),
                           .ray = &sample.ray,
                           .hit = found ? &hit : NULL,
                           .surface = &surface,
                           .origin = aur_scene_origin(integrator->scene),
                           .hash = hash_of(x, y, index)};
    add_channels(data, &at, tile, x, y, index, sample.offset);
}

/* --- without a nested integrator: one packet of rays for a row of a tile */

static aur_vector visible_light(const aur_scene *scene, const aur_ray *ray, const aur_surface *surface) {
    if (surface == NULL)
        return aur_scene_background(scene, ray->direction);
    return surface->emitter != AUR_NO_EMITTER
               ? aur_surface_emission(scene, surface, aur_vector_scale(ray->direction, -1.0f))
               : (aur_vector){0};
}

static void add_lane(const aur_integrator *integrator, const aur_camera_sample *sample, const aur_hit *hit,
                     aur_tile *tile, size_t x, size_t y) {
    const aur_scene *const scene = integrator->scene;
    aur_surface surface;
    if (hit != NULL)
        aur_scene_surface(scene, &sample->ray, hit, &surface);
    const aur_vector light = visible_light(scene, &sample->ray, hit != NULL ? &surface : NULL);
    const aov_sample at = {.radiance = aur_tile_measured(tile, light),
                           .ray = &sample->ray,
                           .hit = hit,
                           .surface = &surface,
                           .origin = aur_scene_origin(scene),
                           .hash = hash_of(x, y, sample->stream.index)};
    add_channels(integrator->data, &at, tile, x, y, sample->stream.index, sample->offset);
}

/* The whole row is traced even if a crop needs few of its pixels: rays of a packet may depend on each other
 * in their last bits. */
static void add_row(const aur_integrator *integrator, aur_tile *tile, size_t y, uint32_t index,
                    aur_packet *packet) {
    const size_t x0 = tile->x0 / AUR_TILE_SIZE * AUR_TILE_SIZE, width = tile->view->width;
    const size_t count = x0 + AUR_TILE_SIZE < width ? AUR_TILE_SIZE : width - x0;
    size_t columns[AUR_TILE_SIZE], rows[AUR_TILE_SIZE];
    uint32_t indices[AUR_TILE_SIZE];
    aur_camera_sample samples[AUR_TILE_SIZE];
    for (size_t k = 0; k < count; ++k) {
        columns[k] = x0 + k;
        rows[k] = y;
        indices[k] = index;
    }
    aur_view_samples(tile->view, count, columns, rows, indices, samples);
    for (size_t k = 0; k < count; ++k)
        aur_packet_set(packet, k, &samples[k].ray);
    const uint32_t found = aur_scene_intersect16(integrator->scene, AUR_EMBREE_COHERENT, packet);
    for (size_t x = tile->x0; x < tile->x1; ++x) {
        if (!aur_tile_needs(tile, x, y, index))
            continue;
        const aur_hit hit = aur_packet_hit(integrator->scene, packet, x - x0);
        add_lane(integrator, &samples[x - x0], (found >> (x - x0) & 1) != 0 ? &hit : NULL, tile, x, y);
    }
}

static aur_result add_tile(const aur_integrator *integrator, aur_tile *tile) {
    const aov_data *const data = integrator->data;
    aur_packet packet;
    aur_packet_clear(&packet);
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1 && data->nested != NULL; ++x)
            for (uint32_t i = 0; i < tile->count; ++i)
                if (aur_tile_needs(tile, x, y, tile->first + i))
                    add_sample(integrator, tile, x, y, tile->first + i);
    for (size_t y = tile->y0; y < tile->y1 && data->nested == NULL; ++y)
        for (uint32_t i = 0; i < tile->count; ++i)
            add_row(integrator, tile, y, tile->first + i, &packet);
    return AUR_OK;
}

const aur_integrator_descriptor aur_integrator_aov = {
    .row = {.name = "aov",
            .summary = "albedo, normals, positions and more as channels, added to another integrator",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(aov_data),
    .create = create,
    .release = release,
    .tile = add_tile,
    .cuts = true,
    .own_image = true,
};
