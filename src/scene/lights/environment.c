/* Light from beyond the scene: the same from everywhere, or from a picture. */
#include <stdlib.h>

#include "material/sampling.h"
#include "scene/emitter.h"
#include "scene/patches.h"
#include "scene/scene_data.h"

void aur_sample_far(const aur_scene *scene, aur_vector reference, aur_vector direction,
                    aur_light_sample *drawn) {
    const aur_vector way = aur_vector_subtract(scene->center, reference);
    drawn->direction = direction;
    drawn->distance = aur_vector_length(way) + 2.0f * scene->radius;
    drawn->position = aur_vector_add_scaled(reference, drawn->distance, direction);
    drawn->normal = aur_vector_scale(direction, -1.0f);
}

aur_ray aur_emit_far(const aur_scene *scene, aur_vector direction, float u, float v) {
    const aur_frame frame = aur_frame_about(direction);
    float x, y;
    aur_sample_disk(u, v, &x, &y);
    aur_vector origin = aur_vector_add_scaled(scene->center, scene->radius, direction);
    origin = aur_vector_add_scaled(origin, scene->radius * x, frame.x);
    origin = aur_vector_add_scaled(origin, scene->radius * y, frame.y);
    return (aur_ray){origin, 0.0f, aur_vector_scale(direction, -1.0f), INFINITY};
}

bool aur_sample_environment(const aur_emitter *emitter, const aur_light_query *query, aur_vector direction,
                            aur_light_sample *drawn) {
    if (aur_vector_dot(query->reference.normal, direction) < 0.0f)
        return false;
    aur_sample_far(emitter->scene, query->reference.position, direction, drawn);
    /* Radiance and density are asked for by the direction, as rays that find the light ask: rounding cannot
     * make the two differ. */
    drawn->radiance = aur_emitter_light_from(emitter, direction, &drawn->pdf);
    return drawn->pdf > 0.0f;
}

bool aur_emit_environment(const aur_emitter *emitter, aur_vector direction, float u, float v, aur_ray *ray,
                          aur_vector *power) {
    const float pdf = emitter->descriptor->pdf_from(emitter, direction), radius = emitter->scene->radius;
    if (!(pdf > 0.0f))
        return false;
    *ray = aur_emit_far(emitter->scene, direction, u, v);
    *power = aur_vector_scale(emitter->descriptor->radiance_from(emitter, direction),
                              AUR_PI_F * radius * radius / pdf);
    return true;
}

/* --- constant */

static const aur_key constant_keys[] = {
    {AUR_KEY_OF_COLOR(aur_emitter, "radiance", radiance, 1e30, "1", "radiance from everywhere, RGB")},
};

static aur_result create_constant(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    const aur_result result = aur_colors_read(&emitter->descriptor->row, parameters, emitter, error);
    if (result == AUR_OK && emitter->radiance.texture != NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED,
                                   "'radiance' cannot be a texture; use an envmap");
    emitter->extent = 4.0 * AUR_PI * AUR_PI;
    return result;
}

static aur_vector constant_from(const aur_emitter *emitter, aur_vector direction) {
    (void)direction;
    return emitter->radiance.constant;
}

static float constant_pdf(const aur_emitter *emitter, aur_vector direction) {
    (void)emitter;
    (void)direction;
    return 0.25f / AUR_PI_F;
}

static bool sample_constant(const aur_emitter *emitter, const aur_light_query *query,
                            aur_light_sample *drawn) {
    aur_sample_far(emitter->scene, query->reference.position, aur_sample_sphere(query->u[1], query->u[2]),
                   drawn);
    drawn->radiance = emitter->radiance.constant;
    drawn->pdf = 0.25f / AUR_PI_F;
    return true;
}

static bool emit_constant(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const float radius = emitter->scene->radius;
    *ray = aur_emit_far(emitter->scene, aur_sample_sphere(u[1], u[2]), u[3], u[4]);
    *power = aur_vector_scale(emitter->radiance.constant, 4.0f * AUR_PI_F * AUR_PI_F * radius * radius);
    return true;
}

const aur_emitter_descriptor aur_emitter_constant = {
    .row = {.name = "constant", .summary = "the same radiance from everywhere", AUR_ROW_KEYS(constant_keys)},
    .is_far = true,
    .create = create_constant,
    .sample = sample_constant,
    .emit = emit_constant,
    .radiance_from = constant_from,
    .pdf_from = constant_pdf,
};

/* --- envmap */

/* A latitude-longitude picture, +y up. Its values stand at azimuths (i + 1/2) / width and, from pole to pole,
 * at polar angles j / (height - 1), and are interpolated between: each patch lies between four of them. */
typedef struct envmap {
    size_t width, height;
    float *rgb;
    float *heights;  /* [height], the cosines of the rows' polar angles */
    aur_frame frame; /* the world's directions of the picture's axes */
    aur_patches patches;
} envmap;

static void release_envmap(aur_emitter *emitter) {
    envmap *const self = emitter->data;
    aur_patches_release(&self->patches);
    free(self->heights);
    free(self->rgb);
}

typedef struct envmap_keys {
    const char *filename;
    double scale;
    aur_transform to_world;
} envmap_keys;

static const aur_key envmap_keys_table[] = {
    {AUR_KEY_OF_TEXT(envmap_keys, "filename", filename, NULL,
                     "the picture, beside the scene; must be given")},
    {AUR_KEY_OF_REAL(envmap_keys, "scale", scale, 0.0, 1e30, "1", "radiance is the picture's times this")},
    {AUR_KEY_OF_TRANSFORM(envmap_keys, "to_world", to_world, "a rotation")},
};

static aur_result read_picture(const aur_parameters *parameters, const envmap_keys *p, envmap *self,
                               aur_error *error) {
    if (p->filename == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "emitter 'envmap' needs the string 'filename'");
    const aur_result result = aur_read_rgb(p->filename, &self->width, &self->height, &self->rgb, error);
    if (result == AUR_OK && (self->width < 2 || self->height < 2))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "the picture must be at least 2 x 2");
    for (size_t i = 0; result == AUR_OK && i < 3 * self->width * self->height; ++i)
        self->rgb[i] *= (float)p->scale;
    return result;
}

static aur_result create_envmap(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    envmap *const self = emitter->data = calloc(1, sizeof *self);
    if (self == NULL)
        return aur_fail_memory_at(error, parameters->location);
    envmap_keys p = {.filename = NULL};
    aur_transform to_local;
    aur_result result = aur_row_read(&emitter->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &p.to_world, &to_local, error);
    if (result == AUR_OK)
        result = read_picture(parameters, &p, self, error);
    if (result != AUR_OK)
        return result;
    aur_vector *const axes[3] = {&self->frame.x, &self->frame.y, &self->frame.z};
    for (size_t i = 0; i < 3; ++i)
        *axes[i] = aur_vector_normalize(
            aur_transform_direction_f(&p.to_world, (aur_vector){i == 0, i == 1, i == 2}));
    const float skew = fabsf(aur_vector_dot(self->frame.x, self->frame.y)) +
                       fabsf(aur_vector_dot(self->frame.y, self->frame.z)) +
                       fabsf(aur_vector_dot(self->frame.z, self->frame.x));
    if (skew > 1e-3f)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED, "'to_world' may only turn");
    emitter->extent = AUR_PI;
    return AUR_OK;
}

static aur_vector value_at(const envmap *self, size_t i, size_t j) {
    const float *const rgb = &self->rgb[3 * (j * self->width + i % self->width)];
    return (aur_vector){rgb[0], rgb[1], rgb[2]};
}

static aur_result prepare_envmap(aur_emitter *emitter, aur_error *error) {
    envmap *const self = emitter->data;
    const size_t width = self->width, rows = self->height - 1;
    double *const radiance = malloc((width + 1) * rows * sizeof *radiance);
    self->heights = malloc(self->height * sizeof *self->heights);
    if (radiance == NULL || self->heights == NULL) {
        free(radiance);
        return aur_fail_memory_at(error, emitter->location);
    }
    for (size_t j = 0; j <= rows; ++j)
        self->heights[j] = (float)cos(AUR_PI * (double)j / (double)rows);
    double *const rises = radiance + width * rows;
    for (size_t j = 0; j < rows; ++j) {
        for (size_t i = 0; i < width; ++i)
            radiance[j * width + i] = 0.25 * (double)(aur_luminance(value_at(self, i, j)) +
                                                      aur_luminance(value_at(self, i + 1, j)) +
                                                      aur_luminance(value_at(self, i, j + 1)) +
                                                      aur_luminance(value_at(self, i + 1, j + 1)));
        rises[j] = cos(AUR_PI * (double)j / (double)rows) - cos(AUR_PI * (double)(j + 1) / (double)rows);
    }
    const aur_result result = aur_patches_create(&self->patches, rows, width, radiance, rises, error);
    free(radiance);
    emitter->brightness = aur_patches_integral(&self->patches);
    return result;
}

/* A place in patch (i, j): s between its columns, and between its rows t by the angle, which radiance is
 * interpolated by, and w by the height, which directions are drawn by; all in [0, 1]. */
typedef struct patch_place {
    size_t i, j;
    float s, t, w;
} patch_place;

static patch_place place_of(const envmap *self, aur_vector direction) {
    const aur_vector local = aur_frame_to_local(&self->frame, direction);
    float azimuth = atan2f(local.x, -local.z) / (2.0f * AUR_PI_F);
    azimuth -= 0.5f / (float)self->width;
    azimuth -= floorf(azimuth);
    const float x = fminf(azimuth, 0x1.fffffep-1f) * (float)self->width;
    const float y = acosf(fminf(fmaxf(local.y, -1.0f), 1.0f)) / AUR_PI_F * (float)(self->height - 1);
    const size_t i = (size_t)x, j = y < (float)(self->height - 2) ? (size_t)y : self->height - 2;
    const float top = self->heights[j];
    const float w = (top - local.y) / (top - self->heights[j + 1]);
    return (patch_place){i, j, x - (float)i, y - (float)j, fminf(fmaxf(w, 0.0f), 1.0f)};
}

/* The density follows the radiance within patches, too: were it the same all over a patch, the ratio of both
 * would jump from patch to patch, and what is even among the numbers that draw would be lost. It is
 * interpolated by the height because a point in proportion to it is then drawn without a search. */
static aur_vector light_at(const envmap *self, patch_place at, float *pdf) {
    aur_vector upper = aur_vector_scale(value_at(self, at.i, at.j), 1.0f - at.s);
    upper = aur_vector_add_scaled(upper, at.s, value_at(self, at.i + 1, at.j));
    aur_vector lower = aur_vector_scale(value_at(self, at.i, at.j + 1), 1.0f - at.s);
    lower = aur_vector_add_scaled(lower, at.s, value_at(self, at.i + 1, at.j + 1));
    const float above = aur_luminance(upper), below = aur_luminance(lower);
    *pdf = aur_patches_density(&self->patches, (1.0f - at.w) * above + at.w * below);
    return aur_vector_add_scaled(aur_vector_scale(upper, 1.0f - at.t), at.t, lower);
}

static aur_vector envmap_light_from(const aur_emitter *emitter, aur_vector direction, float *pdf) {
    const envmap *const self = emitter->data;
    return light_at(self, place_of(self, direction), pdf);
}

static aur_vector envmap_from(const aur_emitter *emitter, aur_vector direction) {
    float unused;
    return envmap_light_from(emitter, direction, &unused);
}

static float envmap_pdf(const aur_emitter *emitter, aur_vector direction) {
    float pdf;
    envmap_light_from(emitter, direction, &pdf);
    return pdf;
}

static aur_vector draw_direction(const envmap *self, float u, float v) {
    size_t i, j;
    aur_patches_choose(&self->patches, &u, &v, &i, &j);
    aur_bilinear weights;
    for (size_t k = 0; k < 4; ++k)
        weights.corner[k] = aur_luminance(value_at(self, i + k % 2, j + k / 2));
    aur_patch_draw(&weights, &u, &v);
    const float height = self->heights[j] + v * (self->heights[j + 1] - self->heights[j]);
    const float radius = sqrtf(fmaxf(0.0f, 1.0f - height * height));
    const float azimuth = 2.0f * AUR_PI_F * ((float)i + u + 0.5f) / (float)self->width;
    return aur_frame_to_world(&self->frame,
                              (aur_vector){radius * sinf(azimuth), height, -radius * cosf(azimuth)});
}

static const aur_distribution *table_of_envmap(const aur_emitter *emitter, const float u[3], float *number) {
    const envmap *const self = emitter->data;
    float v = u[2];
    *number = u[1];
    return &self->patches.cells[aur_distribution_choose(&self->patches.rows, &v)];
}

static bool sample_envmap(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    const envmap *const self = emitter->data;
    return aur_sample_environment(emitter, query, draw_direction(self, query->u[1], query->u[2]), drawn);
}

static bool emit_envmap(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const envmap *const self = emitter->data;
    return aur_emit_environment(emitter, draw_direction(self, u[1], u[2]), u[3], u[4], ray, power);
}

const aur_emitter_descriptor aur_emitter_envmap = {
    .row = {.name = "envmap",
            .summary = "a latitude-longitude picture around the scene, +y up",
            AUR_ROW_KEYS(envmap_keys_table)},
    .is_far = true,
    .create = create_envmap,
    .prepare = prepare_envmap,
    .sample = sample_envmap,
    .table = table_of_envmap,
    .emit = emit_envmap,
    .release = release_envmap,
    .radiance_from = envmap_from,
    .pdf_from = envmap_pdf,
    .light_from = envmap_light_from,
};
