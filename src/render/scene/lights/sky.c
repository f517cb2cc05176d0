/* Daylight: the sky by a formula above the horizon, and the same radiance from everywhere below it. */
#include <stdlib.h>

#include "points/base/text.h"
#include "points/base/vector3d.h"
#include "render/scene/emitter.h"
#include "render/scene/lights/sky_model.h"
#include "render/scene/lights/sun_position.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/patches.h"
#include "render/scene/scene_data.h"

/* Patches of the sky that are equal in azimuth and height, in which radiance is nearly what it is at their
 * corners, interpolated; the last row is the ground. */
enum { COLUMNS = 96, SKY_ROWS = 48, ROWS = SKY_ROWS + 1 };

typedef struct sky_light {
    aur_sky_model model;
    aur_sun_position position;
    aur_vector color;  /* radiance is this times the model's */
    aur_vector ground; /* radiance from below */
    aur_patches patches;
    float (*corners)[COLUMNS]; /* [SKY_ROWS + 1], their luminance */
    float below;               /* the ground's */
    bool round;                /* each row of patches is equally bright */
} sky_light;

typedef enum sky_kind { UNIFORM, OVERCAST, CIE, PEREZ } sky_kind;

typedef struct sky_keys {
    sky_kind model;
    int64_t cie_type;
    const char *coefficients;
    aur_color irradiance, zenith_radiance, ground, ground_albedo;
    double illuminance, zenith_luminance;
    double direct_normal, diffuse_horizontal, extraterrestrial;
    aur_sun_keys sun;
} sky_keys;

/* Lumens a watt of radiation that counts alike in all three colours, as Radiance has it. */
static const double EFFICACY = 179.0;

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(
        sky_keys, "model", model, "cie-overcast",
        "uniform; cie-overcast: 1 + 2 cos Z; cie: a general sky of ISO 15469; perez: Perez et al. "
        "(1993)",
        "uniform", "cie-overcast", "cie", "perez")},
    {AUR_KEY_OF_INTEGER(sky_keys, "cie_type", cie_type, 1, 15, "12",
                        "which general sky; 12 is the clear one")},
    {AUR_KEY_OF_TEXT(sky_keys, "coefficients", coefficients, NULL,
                     "a b c d e of a general sky, in place of cie_type")},
    {AUR_KEY_OF_COLOR(sky_keys, "irradiance", irradiance, 1e30, "1",
                      "of the sky on the horizontal plane, RGB; of perez diffuse_horizontal by default")},
    {AUR_KEY_OF_REAL(sky_keys, "illuminance", illuminance, 0.0, 1e30, "by irradiance",
                     "the same in lux, divided by 179 lm/W"),
     .computed = true},
    {AUR_KEY_OF_COLOR(sky_keys, "zenith_radiance", zenith_radiance, 1e30, "by irradiance",
                      "of the zenith, RGB, in place of irradiance"),
     .computed = true},
    {AUR_KEY_OF_REAL(sky_keys, "zenith_luminance", zenith_luminance, 0.0, 1e30, "by irradiance",
                     "the same in cd/m^2, divided by 179 lm/W"),
     .computed = true},
    {AUR_KEY_OF_REAL(sky_keys, "direct_normal", direct_normal, 0.0, 2000.0, "0",
                     "of perez: the sun's irradiance on a plane that faces it, W/m^2")},
    {AUR_KEY_OF_REAL(sky_keys, "diffuse_horizontal", diffuse_horizontal, 0.0, 2000.0, "100",
                     "of perez: the sky's irradiance on the horizontal plane, W/m^2"),
     .minimum_open = true},
    {AUR_KEY_OF_REAL(sky_keys, "extraterrestrial", extraterrestrial, 100.0, 2000.0,
                     "1367 over the date's squared distance",
                     "of perez: the sun's irradiance outside of the atmosphere, W/m^2"),
     .computed = true},
    {AUR_KEY_OF_COLOR(sky_keys, "ground", ground, 1e30, "0", "radiance from below the horizon, RGB")},
    {AUR_KEY_OF_COLOR(sky_keys, "ground_albedo", ground_albedo, 1.0, "by ground",
                      "in place of ground: what is below reflects so much of the sky's irradiance, RGB"),
     .computed = true},
    AUR_SUN_KEYS(sky_keys),
};

static bool is_given(aur_parameters *parameters, const char *name) {
    return aur_parameters_find(parameters, name) != NULL;
}

static aur_result fail_both(const aur_parameters *parameters, const char *first, const char *second,
                            aur_error *error) {
    return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "give '%s' or '%s', not both", first,
                               second);
}

/* --- reading */

static aur_result read_cie(const sky_keys *p, aur_parameters *parameters, sky_light *self, aur_error *error) {
    const double *const sun = self->position.sun;
    if (p->coefficients == NULL) {
        self->model = aur_sky_model_cie((size_t)p->cie_type, sun);
        return AUR_OK;
    }
    double values[6] = {0};
    if (is_given(parameters, "cie_type"))
        return fail_both(parameters, "cie_type", "coefficients", error);
    if (aur_parse_doubles(p->coefficients, values, 6) != 5 || !(values[1] <= 0.0) || !isfinite(values[1]) ||
        !(fabs(values[0]) + fabs(values[2]) + fabs(values[3]) + fabs(values[4]) < 1e3))
        return aur_parameters_fail_value(parameters, aur_parameters_find(parameters, "coefficients"),
                                         "five numbers 'a b c d e' below 1000, b at most 0", error);
    self->model = aur_sky_model_cie_of(values, sun);
    return AUR_OK;
}

static aur_result read_model(const sky_keys *p, aur_parameters *parameters, sky_light *self,
                             aur_error *error) {
    if (p->model == UNIFORM || p->model == OVERCAST) {
        self->model = p->model == UNIFORM ? aur_sky_model_uniform() : aur_sky_model_overcast();
        return AUR_OK;
    }
    const aur_result result = aur_sun_position_need(&self->position, parameters, error);
    if (result != AUR_OK)
        return result;
    if (self->position.sun[2] < 0.0)
        return aur_parameters_fail(
            parameters, error, AUR_ERROR_FORMAT,
            "this model has the sun above the horizon; 'sun_direction' is %.2f degrees "
            "below",
            asin(-self->position.sun[2]) * 180.0 / AUR_PI);
    if (p->model == CIE)
        return read_cie(p, parameters, self, error);
    const double distance = self->position.solar_distance;
    self->model = aur_sky_model_perez(
        p->direct_normal, p->diffuse_horizontal,
        is_given(parameters, "extraterrestrial") ? p->extraterrestrial : 1367.0 / (distance * distance),
        self->position.sun);
    return AUR_OK;
}

static aur_vector gray(double value) {
    return (aur_vector){(float)value, (float)value, (float)value};
}

/* How bright the sky is, by the one key of four that is given. */
static aur_result read_scale(const sky_keys *p, aur_parameters *parameters, sky_light *self,
                             aur_error *error) {
    static const char *const names[] = {"irradiance", "illuminance", "zenith_radiance", "zenith_luminance"};
    const double zenith = aur_sky_model_radiance(&self->model, (const double[3]){0.0, 0.0, 1.0});
    const double total = aur_sky_model_irradiance(&self->model);
    size_t chosen = 0, given = 0;
    for (size_t i = 0; i < 4; ++i) {
        if (!is_given(parameters, names[i]))
            continue;
        if (given++ > 0)
            return fail_both(parameters, names[chosen], names[i], error);
        chosen = i;
    }
    if (!(total > 0.0) || !isfinite(total) || (chosen >= 2 && !(zenith > 0.0)))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "such a sky is nowhere bright");
    const aur_vector values[4] = {
        given == 0 && p->model == PEREZ ? gray(p->diffuse_horizontal) : p->irradiance.constant,
        gray(p->illuminance / EFFICACY), p->zenith_radiance.constant, gray(p->zenith_luminance / EFFICACY)};
    self->color = aur_vector_scale(values[chosen], (float)(1.0 / (chosen < 2 ? total : zenith)));
    self->ground = p->ground.constant;
    if (is_given(parameters, "ground_albedo")) {
        if (is_given(parameters, "ground"))
            return fail_both(parameters, "ground", "ground_albedo", error);
        self->ground = aur_vector_scale(aur_vector_multiply(p->ground_albedo.constant, self->color),
                                        (float)(total / AUR_PI));
    }
    return AUR_OK;
}

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    sky_light *const self = emitter->data;
    sky_keys p = {.coefficients = NULL};
    aur_result result = aur_colors_read(&emitter->descriptor->row, parameters, &p, error);
    const aur_color *const colors[] = {&p.irradiance, &p.zenith_radiance, &p.ground, &p.ground_albedo};
    for (size_t i = 0; result == AUR_OK && i < sizeof colors / sizeof colors[0]; ++i)
        if (colors[i]->texture != NULL)
            return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED,
                                       "its colours cannot be textures; use an envmap");
    if (result == AUR_OK)
        result = aur_sun_position_read(&p.sun, parameters, &self->position, error);
    if (result == AUR_OK)
        result = read_model(&p, parameters, self, error);
    if (result == AUR_OK)
        result = read_scale(&p, parameters, self, error);
    emitter->extent = AUR_PI;
    return result;
}

static void release(void *data) {
    sky_light *const self = data;
    aur_patches_release(&self->patches);
    free(self->corners);
}

/* --- radiance */

/* By east, north and up, of unit length. */
static void to_local(const sky_light *self, aur_vector direction, double local[3]) {
    double d[3];
    aur_vector_to_doubles(direction, d);
    local[0] = aur_dot3(d, self->position.east);
    local[1] = aur_dot3(d, self->position.north);
    local[2] = aur_dot3(d, self->position.up);
    aur_normalize3(local);
}

static aur_vector radiance_from(const aur_emitter *emitter, aur_vector direction) {
    const sky_light *const self = emitter->data;
    double local[3];
    to_local(self, direction, local);
    if (local[2] < 0.0)
        return self->ground;
    return aur_vector_scale(self->color, (float)aur_sky_model_radiance(&self->model, local));
}

/* --- drawing directions */

static void direction_at(double column, double height, double local[3]) {
    const double azimuth = 2.0 * AUR_PI * column / COLUMNS, radius = sqrt(fmax(1.0 - height * height, 0.0));
    local[0] = radius * cos(azimuth);
    local[1] = radius * sin(azimuth);
    local[2] = height;
}

/* The luminance at the corners of a patch. */
static aur_bilinear corners_of(const sky_light *self, size_t column, size_t row) {
    if (row == SKY_ROWS)
        return (aur_bilinear){{self->below, self->below, self->below, self->below}};
    const float *const low = self->corners[row], *const high = self->corners[row + 1];
    const size_t next = (column + 1) % COLUMNS;
    return (aur_bilinear){{low[column], low[next], high[column], high[next]}};
}

static bool set_corners(sky_light *self) {
    self->below = aur_luminance(self->ground);
    self->corners = malloc((SKY_ROWS + 1) * sizeof *self->corners);
    self->round = true;
    for (size_t j = 0; j <= SKY_ROWS && self->corners != NULL; ++j)
        for (size_t i = 0; i < COLUMNS; ++i) {
            double local[3];
            direction_at((double)i, (double)j / SKY_ROWS, local);
            self->corners[j][i] =
                aur_luminance(self->color) * (float)aur_sky_model_radiance(&self->model, local);
            self->round &= self->corners[j][i] == self->corners[j][0];
        }
    return self->corners != NULL;
}

static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    sky_light *const self = emitter->data;
    double *const radiance = malloc(ROWS * COLUMNS * sizeof *radiance);
    if (!set_corners(self) || radiance == NULL) {
        free(radiance);
        return aur_fail_memory_at(error, emitter->location);
    }
    double rises[ROWS];
    for (size_t j = 0; j < ROWS; ++j) {
        rises[j] = j < SKY_ROWS ? 1.0 / SKY_ROWS : 1.0;
        for (size_t i = 0; i < COLUMNS; ++i) {
            const aur_bilinear at = corners_of(self, i, j);
            radiance[j * COLUMNS + i] = 0.25 * ((double)at.corner[0] + (double)at.corner[1] +
                                                (double)at.corner[2] + (double)at.corner[3]);
        }
    }
    const aur_result result = aur_patches_create(&self->patches, ROWS, COLUMNS, radiance, rises, error);
    free(radiance);
    emitter->brightness = aur_patches_integral(&self->patches);
    return result;
}

static const aur_sun_position *position_of(const aur_emitter *emitter) {
    return &((const sky_light *)emitter->data)->position;
}

static float pdf_from(const aur_emitter *emitter, aur_vector direction) {
    const sky_light *const self = emitter->data;
    double local[3];
    if (!(self->patches.rows.total > 0.0))
        return 0.0f;
    to_local(self, direction, local);
    const double turn = self->round ? 0.0 : atan2(local[1], local[0]) / (2.0 * AUR_PI);
    const double x = (turn < 0.0 ? turn + 1.0 : turn) * COLUMNS,
                 y = local[2] < 0.0 ? SKY_ROWS : local[2] * SKY_ROWS;
    const size_t column = x < COLUMNS ? (size_t)x : COLUMNS - 1;
    const size_t row = local[2] < 1.0 ? (size_t)y : SKY_ROWS - 1;
    const aur_bilinear corners = corners_of(self, column, row);
    return aur_patches_density(
        &self->patches, aur_bilinear_value(&corners, (float)(x - (double)column), (float)(y - (double)row)));
}

static aur_vector draw(const sky_light *self, float u, float v) {
    size_t column = 0, row;
    double local[3], world[3], along = (double)u * COLUMNS;
    if (self->round)
        row = aur_distribution_choose(&self->patches.rows, &v);
    else
        aur_patches_choose(&self->patches, &u, &v, &column, &row);
    const aur_bilinear corners = corners_of(self, column, row);
    aur_patch_draw(&corners, &u, &v);
    if (!self->round)
        along = (double)column + (double)u;
    direction_at(along, row < SKY_ROWS ? ((double)row + (double)v) / SKY_ROWS : -(double)v, local);
    const aur_sun_position *const at = &self->position;
    for (int d = 0; d < 3; ++d)
        world[d] = local[0] * at->east[d] + local[1] * at->north[d] + local[2] * at->up[d];
    return (aur_vector){(float)world[0], (float)world[1], (float)world[2]};
}

static bool sample(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn) {
    return aur_sample_environment(emitter, query, draw(emitter->data, query->u[1], query->u[2]), drawn);
}

static bool emit(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power) {
    return aur_emit_environment(emitter, draw(emitter->data, u[1], u[2]), u[3], u[4], ray, power);
}

const aur_emitter_descriptor aur_emitter_sky = {
    .row = {.name = "sky",
            .summary = "daylight of a uniform, overcast, general (ISO 15469) or all-weather (Perez) sky",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(sky_light),
    .is_far = true,
    .create = create,
    .prepare = prepare,
    .sample = sample,
    .emit = emit,
    .release = release,
    .radiance_from = radiance_from,
    .pdf_from = pdf_from,
    .position_of = position_of,
};
