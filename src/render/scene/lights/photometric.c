/* Photometric luminaires: points of the luminous opening, each emitting with the angular distribution of the
 * whole luminaire. */
#include <stdlib.h>
#include <string.h>

#include "render/scene/emitter.h"
#include "render/scene/lights/photometry.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

typedef struct photometric_light {
    aur_photometry photometry;
    aur_transform to_world, to_local;
    double world_middle[3]; /* centre in the world */
    aur_vector middle;      /* centre relative to the scene's origin */
    aur_vector half[3];     /* half axes of the opening: along length, width and height */
    float focus;
} photometric_light;

typedef struct photometric_keys {
    const char *filename, *text;
    aur_color color;
    aur_transform to_world;
    double lumens, scale, focus;
    bool point;
} photometric_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(photometric_keys, "filename", filename, NULL,
                     "an IES (LM-63, 1986 to 2019) or EULUMDAT file; must be given")},
    {AUR_KEY_OF_TEXT(photometric_keys, "text", text, NULL, "content of such a file, instead of filename")},
    {AUR_KEY_OF_TRANSFORM(
        photometric_keys, "to_world", to_world,
        "from a luminaire at the origin that shines along -z, with C 0 along +x, in metres")},
    {AUR_KEY_OF_COLOR(photometric_keys, "color", color, 1e30, "1", "factor of the light, RGB")},
    {AUR_KEY_OF_REAL(photometric_keys, "scale", scale, 0.0, 1e30, "1",
                     "factor of the light: dimming, depreciation")},
    {AUR_KEY_OF_REAL(photometric_keys, "lumens", lumens, 0.0, 1e30, "by the file",
                     "luminous flux of the whole luminaire, at 179 lm/W"),
     .computed = true, .minimum_open = true},
    {AUR_KEY_OF_BOOLEAN(photometric_keys, "point", point, "false",
                        "a point, whatever dimensions the file has")},
    {AUR_KEY_OF_REAL(
        photometric_keys, "focus", focus, 0.0, 1e9, "0",
        "distance of Radiance's focus behind the opening: the distance d receives the light of d + "
        "focus; particle tracing ignores it")},
};

static void release(void *data) {
    aur_photometry_release(&((photometric_light *)data)->photometry);
}

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    photometric_light *const self = emitter->data;
    photometric_keys p = {.filename = NULL};
    aur_result result = aur_colors_read(&emitter->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &p.to_world, &self->to_local, error);
    if (result == AUR_OK && p.color.texture != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED, "'color' cannot be a texture");
    if (result == AUR_OK && (p.filename == NULL) == (p.text == NULL))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "it needs the string 'filename', or 'text'");
    if (result == AUR_OK)
        result = p.text != NULL ? aur_photometry_parse(parameters->location.file, strlen(p.text), p.text,
                                                       &self->photometry, error)
                                : aur_photometry_read(p.filename, &self->photometry, error);
    if (result != AUR_OK)
        return result;
    const double flux = aur_photometry_flux(&self->photometry);
    const bool given = aur_parameters_find(parameters, "lumens") != NULL;
    const float watts = (float)(p.scale * (given ? p.lumens / flux : 1.0) / 179.0);
    self->focus = (float)p.focus;
    self->to_world = p.to_world;
    aur_transform_point(&p.to_world, (const double[3]){0.0}, self->world_middle);
    const double sizes[3] = {self->photometry.length, self->photometry.width, self->photometry.height};
    for (size_t i = 0; i < 3; ++i) {
        const float half = p.point ? 0.0f : (float)(0.5 * sizes[i]);
        self->half[i] = aur_transform_direction_f(
            &p.to_world, (aur_vector){i == 0 ? half : 0.0f, i == 1 ? half : 0.0f, i == 2 ? half : 0.0f});
    }
    emitter->radiance = p.color;
    emitter->radiance.constant = aur_vector_scale(p.color.constant, watts);
    emitter->extent = flux;
    return AUR_OK;
}

static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    (void)error;
    photometric_light *const self = emitter->data;
    self->middle = aur_internal_point(emitter->scene->origin, self->world_middle);
    return AUR_OK;
}

/* Uniform over the opening's plan. Its height is ignored: far-field measurements do not determine it. */
static aur_vector draw_point(const photometric_light *self, float u, float v) {
    float x = 2.0f * u - 1.0f, y = 2.0f * v - 1.0f;
    if (self->photometry.round)
        aur_sample_disk(u, v, &x, &y);
    return aur_vector_add_scaled(aur_vector_add_scaled(self->middle, x, self->half[0]), y, self->half[1]);
}

/* Luminous intensity in candela in a world direction. */
static float intensity(const photometric_light *self, aur_vector direction) {
    double local[3], world[3];
    aur_vector_to_doubles(direction, world);
    aur_transform_direction(&self->to_local, world, local);
    return (float)aur_photometry_intensity(&self->photometry, local);
}

static void find_bounds(const aur_emitter *emitter, size_t part, aur_light_bounds *bounds) {
    (void)part;
    const photometric_light *const self = emitter->data;
    double middle[3];
    *bounds = (aur_light_bounds){.axis = {0.0, 0.0, 1.0}, .spread = AUR_PI, .power = emitter->power};
    aur_vector_to_doubles(self->middle, middle);
    const float reach[3] = {fabsf(self->half[0].x) + fabsf(self->half[1].x),
                            fabsf(self->half[0].y) + fabsf(self->half[1].y),
                            fabsf(self->half[0].z) + fabsf(self->half[1].z)};
    for (size_t i = 0; i < 3; ++i) {
        bounds->lower[i] = middle[i] - (double)reach[i];
        bounds->upper[i] = middle[i] + (double)reach[i];
    }
}

/* radiance / pdf is the intensity over the squared distance. */
static bool sample(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    const photometric_light *const self = emitter->data;
    const aur_vector position = draw_point(self, query->u[1], query->u[2]);
    const aur_vector way = aur_vector_subtract(position, query->reference.position);
    const float squared = aur_vector_dot(way, way);
    if (!(squared > 0.0f))
        return false;
    drawn->distance = sqrtf(squared);
    drawn->direction = aur_vector_scale(way, 1.0f / drawn->distance);
    drawn->normal = aur_vector_scale(drawn->direction, -1.0f);
    drawn->position = aur_point_target(query->reference.position, position, drawn->normal);
    const float length = drawn->distance + self->focus,
                falloff = self->focus > 0.0f ? length * length : squared;
    drawn->radiance = aur_vector_scale(emitter->radiance.constant, intensity(self, drawn->normal) / falloff);
    drawn->pdf = 1.0f;
    drawn->delta = true;
    return aur_vector_max(drawn->radiance) > 0.0f;
}

static bool emit(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const photometric_light *const self = emitter->data;
    const aur_vector direction = aur_sample_sphere(u[3], u[4]);
    *ray = (aur_ray){draw_point(self, u[1], u[2]), 0.0f, direction, INFINITY};
    *power = aur_vector_scale(emitter->radiance.constant, 4.0f * AUR_PI_F * intensity(self, direction));
    return aur_vector_max(*power) > 0.0f;
}

const aur_emitter_descriptor aur_emitter_photometric = {
    .row = {.name = "photometric",
            .summary = "a measured luminaire, from an IES (LM-63) or EULUMDAT file",
            .source = "IESNA LM-63-2019; Stockmar 1990",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(photometric_light),
    .create = create,
    .prepare = prepare,
    .bounds = find_bounds,
    .sample = sample,
    .emit = emit,
    .release = release,
};
