/* Daylight: an analytic sky above the horizon, and constant radiance below it. */
#include "points/base/text.h"
#include "points/base/vector3d.h"
#include "render/scene/emitter.h"
#include "render/scene/lights/sky_dome.h"
#include "render/scene/lights/sky_model.h"
#include "render/scene/lights/sun_position.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

typedef struct sky_light {
    aur_sky_model model;
    aur_sun_position position;
    aur_vector color;  /* factor of the model's radiance */
    aur_vector ground; /* radiance below the horizon */
    bool blends;       /* blend sky and ground at the horizon */
    aur_sky_dome dome;
} sky_light;

typedef enum sky_kind { UNIFORM, OVERCAST, CIE, PEREZ } sky_kind;

typedef struct sky_keys {
    sky_kind model;
    int64_t cie_type;
    const char *coefficients;
    aur_color irradiance, zenith_radiance, ground, ground_albedo;
    double illuminance, zenith_luminance;
    double direct_normal, diffuse_horizontal, extraterrestrial;
    bool blends, lights_ground;
    aur_sun_keys sun;
} sky_keys;

/* Luminous efficacy in lumens per watt, with equal weights of the three colours, as in Radiance. */
static const double EFFICACY = 179.0;

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(
        sky_keys, "model", model, "cie-overcast",
        "uniform; cie-overcast: 1 + 2 cos Z; cie: a general sky of ISO 15469; perez: Perez et al. "
        "(1993)",
        "uniform", "cie-overcast", "cie", "perez")},
    {AUR_KEY_OF_INTEGER(sky_keys, "cie_type", cie_type, 1, 15, "12",
                        "type of ISO 15469 sky; 12 is the CIE clear sky")},
    {AUR_KEY_OF_TEXT(sky_keys, "coefficients", coefficients, NULL,
                     "a b c d e of a general sky, instead of cie_type")},
    {AUR_KEY_OF_COLOR(sky_keys, "irradiance", irradiance, 1e30, "1",
                      "of the sky on the horizontal plane, RGB; of perez diffuse_horizontal by default")},
    {AUR_KEY_OF_REAL(sky_keys, "illuminance", illuminance, 0.0, 1e30, "by irradiance",
                     "the same in lux, divided by 179 lm/W"),
     .computed = true},
    {AUR_KEY_OF_COLOR(sky_keys, "zenith_radiance", zenith_radiance, 1e30, "by irradiance",
                      "of the zenith, RGB, instead of irradiance"),
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
                      "instead of ground: reflectance of the ground under the sky, RGB"),
     .computed = true},
    {AUR_KEY_OF_BOOLEAN(sky_keys, "sun_lights_ground", lights_ground, "false",
                        "of perez: ground_albedo reflects direct_normal, too")},
    {AUR_KEY_OF_BOOLEAN(sky_keys, "blend_horizon", blends, "false",
                        "the sky and the ground mix about the horizon, as Radiance's skybright.cal has it")},
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

/* --- parameters */

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

/* The sky's brightness, from exactly one of four parameters. */
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
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "the sky has no radiance anywhere");
    const aur_vector values[4] = {
        given == 0 && p->model == PEREZ ? gray(p->diffuse_horizontal) : p->irradiance.constant,
        gray(p->illuminance / EFFICACY), p->zenith_radiance.constant, gray(p->zenith_luminance / EFFICACY)};
    self->color = aur_vector_scale(values[chosen], (float)(1.0 / (chosen < 2 ? total : zenith)));
    self->ground = p->ground.constant;
    self->blends = p->blends;
    if (is_given(parameters, "ground_albedo")) {
        if (is_given(parameters, "ground"))
            return fail_both(parameters, "ground", "ground_albedo", error);
        self->ground = aur_vector_scale(aur_vector_multiply(p->ground_albedo.constant, self->color),
                                        (float)(total / AUR_PI));
        if (p->model == PEREZ && p->lights_ground)
            self->ground = aur_vector_add_scaled(self->ground,
                                                 (float)(p->direct_normal * self->position.sun[2] / AUR_PI),
                                                 p->ground_albedo.constant);
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
    aur_sky_dome_release(&self->dome);
}

/* --- radiance */

/* Radiance of a direction (east, north, up). With blending the sky has weight a / (a + 1 / a), a = (z
 * + 1.01)^10. */
static aur_vector radiance_at(const sky_light *self, const double local[3]) {
    /* All gradations but the linear one are undefined below the horizon. */
    const double level[3] = {local[0], local[1], self->model.a != 0.0 ? fmax(local[2], 0.0) : local[2]};
    const double a = self->blends ? pow(local[2] + 1.01, 20.0) : 0.0;
    const double part = self->blends ? a / (1.0 + a) : local[2] < 0.0 ? 0.0 : 1.0;
    if (part == 0.0)
        return self->ground;
    const aur_vector sky =
        aur_vector_scale(self->color, (float)(part * aur_sky_model_radiance(&self->model, level)));
    return part == 1.0 ? sky : aur_vector_add_scaled(sky, (float)(1.0 - part), self->ground);
}

static aur_vector radiance_from(const aur_emitter *emitter, aur_vector direction) {
    const sky_light *const self = emitter->data;
    double local[3];
    aur_sun_position_to_local(&self->position, direction, local);
    return radiance_at(self, local);
}

static float luminance(const void *sky, const double direction[3]) {
    const sky_light *const self = sky;
    return self->blends ? aur_luminance(radiance_at(self, direction))
                        : aur_luminance(self->color) * (float)aur_sky_model_radiance(&self->model, direction);
}

/* Luminance used to sample directions below the horizon within the blend: the mean over heights. */
static float luminance_below(const sky_light *self) {
    enum { HEIGHTS = 64 };
    float sum = 0.0f;
    for (size_t i = 0; i < HEIGHTS; ++i) {
        const double z = -((double)i + 0.5) / HEIGHTS;
        sum += aur_luminance(radiance_at(self, (const double[3]){0.0, sqrt(1.0 - z * z), z}));
    }
    return sum / HEIGHTS;
}

static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    sky_light *const self = emitter->data;
    const float below = self->blends ? luminance_below(self) : aur_luminance(self->ground);
    if (aur_sky_dome_create(&self->dome, luminance, self, below, error) != AUR_OK)
        return aur_fail_memory_at(error, emitter->location);
    emitter->brightness = aur_patches_integral(&self->dome.patches);
    return AUR_OK;
}

static const aur_sun_position *position_of(const aur_emitter *emitter) {
    return &((const sky_light *)emitter->data)->position;
}

static float pdf_from(const aur_emitter *emitter, aur_vector direction) {
    const sky_light *const self = emitter->data;
    double local[3];
    aur_sun_position_to_local(&self->position, direction, local);
    return aur_sky_dome_pdf(&self->dome, local);
}

static aur_vector draw(const aur_emitter *emitter, float u, float v) {
    const sky_light *const self = emitter->data;
    double local[3];
    aur_sky_dome_draw(&self->dome, u, v, local);
    return aur_sun_position_to_world(&self->position, local);
}

const aur_emitter_descriptor aur_emitter_sky = {
    .row = {.name = "sky",
            .summary = "daylight of a uniform, overcast, general (ISO 15469) or all-weather (Perez) sky",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(sky_light),
    .is_far = true,
    .create = create,
    .prepare = prepare,
    .sample = aur_environment_sample,
    .emit = aur_environment_emit,
    .draw = draw,
    .release = release,
    .radiance_from = radiance_from,
    .pdf_from = pdf_from,
    .position_of = position_of,
};
