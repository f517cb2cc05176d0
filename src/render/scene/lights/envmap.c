/* Environment lighting from an image. */
#include "render/scene/lights/envmap.h"

#include <stdlib.h>
#include <string.h>

#include "render/image/format.h"
#include "render/scene/emitter.h"
#include "render/scene/scene_data.h"

static void release_envmap(void *data) {
    aur_envmap *const self = data;
    aur_patches_release(&self->patches);
    aur_patches_release(&self->emission);
    free(self->heights);
    free(self->texels);
}

typedef struct envmap_keys {
    const char *filename;
    double scale;
    aur_transform to_world;
} envmap_keys;

static const aur_key envmap_keys_table[] = {
    {AUR_KEY_OF_TEXT(envmap_keys, "filename", filename, NULL, "image file, relative to the scene; required")},
    {AUR_KEY_OF_REAL(envmap_keys, "scale", scale, 0.0, 1e30, "1", "factor of the radiance")},
    {AUR_KEY_OF_TRANSFORM(envmap_keys, "to_world", to_world, "a rotation")},
};

static aur_vector color_of(aur_texel texel) {
    return (aur_vector){texel[0], texel[1], texel[2]};
}

/* Copies the texels, with the first column repeated at the end. */
static aur_result store_image(size_t width, size_t height, const float *rgb, float scale, aur_envmap *self) {
    self->width = width;
    self->rows = height - 1;
    self->texels = malloc((width + 1) * height * sizeof *self->texels);
    for (size_t k = 0; self->texels != NULL && k < (width + 1) * height; ++k) {
        const float *const from = &rgb[3 * (k / (width + 1) * width + k % (width + 1) % width)];
        aur_texel texel = {from[0] * scale, from[1] * scale, from[2] * scale};
        texel[3] = aur_luminance(color_of(texel));
        self->texels[k] = texel;
    }
    return self->texels != NULL ? AUR_OK : AUR_ERROR_MEMORY;
}

static aur_result read_image(const aur_parameters *parameters, const aur_parameter *held,
                             const envmap_keys *p, aur_envmap *self, aur_error *error) {
    if (p->filename == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "emitter 'envmap' needs the string 'filename'");
    if (held == NULL || held->kind != AUR_PARAMETER_OBJECT || strcmp(held->object_kind, "image") != 0)
        return aur_fail_at(error, held != NULL ? held->location : parameters->location, AUR_ERROR_FORMAT,
                           "emitter 'envmap': the image is named by the string 'filename'");
    const aur_image *const image = held->object;
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    float *rgb = NULL;
    aur_result result = aur_image_radiance(p->filename, image, &rgb, error);
    if (result == AUR_OK && (width < 2 || height < 2))
        result = aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "the image must be at least 2 x 2");
    else if (result == AUR_OK && store_image(width, height, rgb, (float)p->scale, self) != AUR_OK)
        result = aur_fail_memory_at(error, parameters->location);
    free(rgb);
    return result;
}

static aur_result create_envmap(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    aur_envmap *const self = emitter->data;
    envmap_keys p = {.filename = NULL};
    const aur_parameter *const held = aur_parameters_find(parameters, "bitmap");
    aur_transform to_local;
    aur_result result = aur_row_read(&emitter->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = aur_to_world_check(parameters, &p.to_world, &to_local, error);
    if (result == AUR_OK)
        result = read_image(parameters, held, &p, self, error);
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

static const aur_texel *texel_at(const aur_envmap *self, size_t i, size_t j) {
    return &self->texels[j * (self->width + 1) + i];
}

/* By the mean of the fourth values of a patch's corners. `values` has space for patches and rows. */
static aur_result fill_patches(const aur_envmap *self, double *values, aur_patches *patches, float *density,
                               aur_error *error) {
    const size_t width = self->width, rows = self->rows;
    double *const rises = values + width * rows;
    for (size_t j = 0; j < rows; ++j) {
        for (size_t i = 0; i < width; ++i) {
            const aur_texel *const upper = texel_at(self, i, j), *const lower = texel_at(self, i, j + 1);
            values[j * width + i] = 0.25 * (double)(upper[0][3] + upper[1][3] + lower[0][3] + lower[1][3]);
        }
        rises[j] = cos(AUR_PI * (double)j / (double)rows) - cos(AUR_PI * (double)(j + 1) / (double)rows);
    }
    const aur_result result = aur_patches_create(patches, rows, width, values, rises, error);
    *density = aur_patches_density(patches, 1.0f);
    return result;
}

/* Directions that a material is likely to reflect light from are sampled by the material too, so lights are
 * sampled by the luminance above its mean (Karlik et al. 2019, MIS compensation, for a material that reflects
 * evenly). A tenth follows the luminance itself, as in a defensive mixture (Hesterberg 1995): samples of
 * lights alone have no bias. */
static void compensate(aur_envmap *self, float mean) {
    const float defensive = 0.1f;
    for (size_t k = 0; k < (self->width + 1) * (self->rows + 1); ++k) {
        const float luminance = self->texels[k][3];
        self->texels[k][3] = defensive * luminance + (1.0f - defensive) * aur_larger(luminance - mean, 0.0f);
    }
}

static aur_result prepare_envmap(aur_emitter *emitter, aur_error *error) {
    aur_envmap *const self = emitter->data;
    const size_t width = self->width, rows = self->rows;
    double *const values = malloc((width + 1) * rows * sizeof *values);
    self->heights = malloc((rows + 1) * sizeof *self->heights);
    if (values == NULL || self->heights == NULL) {
        free(values);
        return aur_fail_memory_at(error, emitter->location);
    }
    for (size_t j = 0; j <= rows; ++j)
        self->heights[j] = (float)cos(AUR_PI * (double)j / (double)rows);
    aur_result result = fill_patches(self, values, &self->emission, &self->emission_density, error);
    if (result == AUR_OK) {
        emitter->brightness = aur_patches_integral(&self->emission);
        compensate(self, (float)(emitter->brightness / (4.0 * AUR_PI)));
        result = fill_patches(self, values, &self->patches, &self->density, error);
    }
    free(values);
    self->kernels = &AUR_KERNEL_HERE(aur_envmap_kernels);
    return result;
}

/* --- evaluation */

/* The pdf follows the radiance within patches too. A constant pdf per patch would make the ratio jump between
 * patches and destroy the stratification of the samples. It is interpolated by height, because points can
 * then be sampled without a search. */
static aur_vector light_at(const aur_envmap *self, const aur_envmap_position *at, float *pdf) {
    const aur_texel *const row = texel_at(self, at->i, at->j), *const next = row + self->width + 1;
    const aur_texel upper = row[0] + at->s * (row[1] - row[0]);
    const aur_texel lower = next[0] + at->s * (next[1] - next[0]);
    *pdf = self->density * ((1.0f - at->w) * upper[3] + at->w * lower[3]);
    return color_of((1.0f - at->t) * upper + at->t * lower);
}

static void corners_of(const aur_envmap *self, size_t i, size_t j, float corner[4]) {
    const aur_texel *const row = texel_at(self, i, j), *const next = row + self->width + 1;
    corner[0] = row[0][3];
    corner[1] = row[1][3];
    corner[2] = next[0][3];
    corner[3] = next[1][3];
}

static aur_vector envmap_light_from(const aur_emitter *emitter, aur_vector direction, float *pdf) {
    const aur_envmap *const self = emitter->data;
    const aur_envmap_position at = aur_envmap_find(self, direction);
    return light_at(self, &at, pdf);
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

static void choose_patch(const aur_patches *patches, float u, float v, aur_envmap_position *at) {
    size_t i, j;
    aur_patches_choose(patches, &u, &v, &i, &j);
    *at = (aur_envmap_position){(uint32_t)i, (uint32_t)j, u, 0.0f, v};
}

static bool sample_envmap(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    const aur_envmap *const self = emitter->data;
    aur_envmap_position at;
    float corner[4];
    choose_patch(&self->patches, query->u[1], query->u[2], &at);
    corners_of(self, at.i, at.j, corner);
    const aur_vector direction = aur_envmap_draw(self, corner, &at);
    if (aur_vector_dot(query->reference.normal, direction) < 0.0f)
        return false;
    aur_sample_far(emitter->scene, query->reference.position, direction, drawn);
    drawn->radiance = light_at(self, &at, &drawn->pdf);
    return drawn->pdf > 0.0f;
}

/* --- 16 lanes at once: table entries are prefetched for all lanes before they are read */

/* Selects the patches of all lanes. */
static void choose_patches(const aur_envmap *self, uint32_t lanes, const float *u, const float *v,
                           aur_envmap_positions *positions) {
    *positions = (aur_envmap_positions){0};
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        positions->s[k] = u[k];
        positions->w[k] = v[k];
        positions->j[k] = (uint32_t)aur_distribution_choose(&self->patches.rows, &positions->w[k]);
        aur_distribution_prefetch_guide(&self->patches.cells[positions->j[k]], (double)u[k]);
    }
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        aur_distribution_prefetch_items(&self->patches.cells[positions->j[k]], (double)u[k]);
    }
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        positions->i[k] =
            (uint32_t)aur_distribution_choose(&self->patches.cells[positions->j[k]], &positions->s[k]);
        const aur_texel *const row = texel_at(self, positions->i[k], positions->j[k]);
        __builtin_prefetch(row);
        __builtin_prefetch(row + self->width + 1);
    }
}

static aur_vector light_of_lane(const aur_envmap *self, const aur_envmap_positions *positions, size_t k,
                                float *pdf) {
    const aur_envmap_position at = {positions->i[k], positions->j[k], positions->s[k], positions->t[k],
                                    positions->w[k]};
    return light_at(self, &at, pdf);
}

static bool envmap_lanes(const aur_emitter *emitter, uint32_t lanes, const aur_light_references *references,
                         const float *u, const float *v, aur_light_lanes *drawn) {
    const aur_envmap *const self = emitter->data;
    aur_envmap_positions positions;
    aur_lane_vectors directions;
    aur_lane_numbers corner[4];
    choose_patches(self, lanes, u, v, &positions);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        float factors[4] = {1.0f, 1.0f, 1.0f, 1.0f};
        if ((lanes >> k & 1u) != 0)
            corners_of(self, positions.i[k], positions.j[k], factors);
        for (size_t c = 0; c < 4; ++c)
            corner[c][k] = factors[c];
    }
    self->kernels->draw(self, (const aur_lane_numbers *)corner, &positions, &directions);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        const aur_vector direction = aur_lane_vector(&directions, k);
        drawn->reachable[k] = 1.0f;
        drawn->pdf[k] = 0.0f;
        if (aur_vector_dot(aur_lane_vector(references->normal, k), direction) < 0.0f)
            continue;
        aur_light_sample far;
        aur_sample_far(emitter->scene, aur_lane_vector(references->position, k), direction, &far);
        float pdf;
        aur_lane_set(&drawn->position, k, far.position);
        aur_lane_set(&drawn->direction, k, direction);
        aur_lane_set(&drawn->radiance, k, light_of_lane(self, &positions, k, &pdf));
        drawn->pdf[k] = pdf;
    }
    return true;
}

static void envmap_lights_from(const aur_emitter *emitter, uint32_t lanes, const aur_lane_vectors *directions,
                               aur_lane_vectors *radiance, float *pdf) {
    const aur_envmap *const self = emitter->data;
    aur_envmap_positions positions;
    self->kernels->find(self, directions, &positions);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        const aur_texel *const row = texel_at(self, positions.i[k], positions.j[k]);
        __builtin_prefetch(row);
        __builtin_prefetch(row + self->width + 1);
    }
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        aur_lane_set(radiance, k, light_of_lane(self, &positions, k, &pdf[k]));
    }
}

/* Particles are emitted by luminance: no other sampling makes up for the rest. */
static bool emit_envmap(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    const aur_envmap *const self = emitter->data;
    const float radius = emitter->scene->radius;
    aur_envmap_position at;
    choose_patch(&self->emission, u[1], u[2], &at);
    const aur_texel *const row = texel_at(self, at.i, at.j), *const next = row + self->width + 1;
    const float corner[4] = {aur_luminance(color_of(row[0])), aur_luminance(color_of(row[1])),
                             aur_luminance(color_of(next[0])), aur_luminance(color_of(next[1]))};
    const aur_vector direction = aur_envmap_draw(self, corner, &at);
    const float upper = corner[0] + at.s * (corner[1] - corner[0]);
    const float lower = corner[2] + at.s * (corner[3] - corner[2]);
    const float pdf = self->emission_density * ((1.0f - at.w) * upper + at.w * lower);
    float unused;
    if (!(pdf > 0.0f))
        return false;
    *ray = aur_emit_far(emitter->scene, direction, u[3], u[4]);
    *power = aur_vector_scale(light_at(self, &at, &unused), AUR_PI_F * radius * radius / pdf);
    return true;
}

const aur_emitter_descriptor aur_emitter_envmap = {
    .row = {.name = "envmap",
            .summary = "latitude-longitude environment map, +y up",
            AUR_ROW_KEYS(envmap_keys_table)},
    .size = sizeof(aur_envmap),
    .is_far = true,
    .create = create_envmap,
    .prepare = prepare_envmap,
    .sample = sample_envmap,
    .lanes = envmap_lanes,
    .emit = emit_envmap,
    .release = release_envmap,
    .radiance_from = envmap_from,
    .pdf_from = envmap_pdf,
    .light_from = envmap_light_from,
    .lights_from = envmap_lights_from,
};
