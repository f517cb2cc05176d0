/* Mitsuba's `sunsky`: the clear sky of Hosek and Wilkie with its sun, as one light with two parts. */
#include <math.h>

#include "points/base/vector3d.h"
#include "render/scene/emitter.h"
#include "render/scene/lights/hosek_wilkie.h"
#include "render/scene/lights/sky_dome.h"
#include "render/scene/lights/sun_disk.h"
#include "render/scene/lights/sun_position.h"
#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

typedef struct sunsky {
    aur_sun_position position;
    aur_hosek_wilkie_sky model;
    aur_sun_disk disk;
    aur_sky_dome dome;
    float sky_scale;
    aur_vector sun;   /* radiance of the disk */
    float dome_share; /* probability of sampling the dome rather than the disk */
} sunsky;

typedef struct sunsky_keys {
    double turbidity, sky_scale, sun_scale, sun_aperture;
    bool complex_sun;
    aur_color albedo;
    double latitude, longitude, timezone;
    int64_t year, month, day;
    double hour, minute, second;
    double sun_direction[3];
    aur_transform to_world;
} sunsky_keys;

/* The parameters of location and time, which determine the sun's direction unless it is given. */
static const char *const time_keys[] = {"latitude", "longitude", "timezone", "year",  "month",
                                        "day",      "hour",      "minute",   "second"};

static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(sunsky_keys, "turbidity", turbidity, 1.0, 10.0, "3",
                     "of the air: 2 is very clear, 10 hazy")},
    {AUR_KEY_OF_COLOR(sunsky_keys, "albedo", albedo, 1.0, "0.3", "of the ground, as the sky has it; RGB")},
    {AUR_KEY_OF_REAL(sunsky_keys, "sky_scale", sky_scale, 0.0, 1e30, "1", "factor of the sky's radiance")},
    {AUR_KEY_OF_REAL(sunsky_keys, "sun_scale", sun_scale, 0.0, 1e30, "1", "factor of the sun's radiance")},
    {AUR_KEY_OF_REAL(sunsky_keys, "sun_aperture", sun_aperture, 2e-2, 180.0, "0.5358",
                     "the sun's diameter, degrees; its irradiance stays")},
    {AUR_KEY_OF_BOOLEAN(
        sunsky_keys, "complex_sun", complex_sun, "false",
        "accepted; the disk is as bright at its edge as in its middle, with the same irradiance")},
    {AUR_KEY_OF_REAL(sunsky_keys, "latitude", latitude, -90.0, 90.0, "35.6894", "degrees to the north")},
    {AUR_KEY_OF_REAL(sunsky_keys, "longitude", longitude, -180.0, 180.0, "139.6917", "degrees to the east")},
    {AUR_KEY_OF_REAL(sunsky_keys, "timezone", timezone, -14.0, 14.0, "9", "time zone: hours ahead of UTC")},
    {AUR_KEY_OF_INTEGER(sunsky_keys, "year", year, 1950, 2050, "2010", "of the date")},
    {AUR_KEY_OF_INTEGER(sunsky_keys, "month", month, 1, 12, "7", "of the date")},
    {AUR_KEY_OF_INTEGER(sunsky_keys, "day", day, 1, 31, "10", "of the date")},
    {AUR_KEY_OF_REAL(sunsky_keys, "hour", hour, 0.0, 24.0, "15", "of the clock of the time zone")},
    {AUR_KEY_OF_REAL(sunsky_keys, "minute", minute, 0.0, 60.0, "0", "of the clock")},
    {AUR_KEY_OF_REAL(sunsky_keys, "second", second, 0.0, 60.0, "0", "of the clock")},
    {AUR_KEY_OF_VECTOR(sunsky_keys, "sun_direction", sun_direction, -AUR_REACH, AUR_REACH, "by date and time",
                       "to the sun, in the world"),
     .computed = true},
    {AUR_KEY_OF_TRANSFORM(sunsky_keys, "to_world", to_world,
                          "a rotation, from a frame whose z is up, -x north and -y east")},
};

/* --- parameters */

/* Mitsuba's sky frame is mirrored: its right-handed axes point south, west and up. */
static aur_result read_frame(const sunsky_keys *p, aur_parameters *parameters, aur_sun_position *position,
                             aur_error *error) {
    aur_transform to_local;
    const aur_result result = aur_to_world_check(parameters, &p->to_world, &to_local, error);
    if (result != AUR_OK)
        return result;
    double *const axes[3] = {position->north, position->east, position->up};
    for (int i = 0; i < 3; ++i) {
        for (int d = 0; d < 3; ++d)
            axes[i][d] = (i < 2 ? -1.0 : 1.0) * p->to_world.m[4 * d + i];
        aur_normalize3(axes[i]);
    }
    if (fabs(aur_dot3(axes[0], axes[1])) + fabs(aur_dot3(axes[1], axes[2])) +
            fabs(aur_dot3(axes[2], axes[0])) >
        1e-3)
        return aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED, "'to_world' may only turn");
    return AUR_OK;
}

static aur_result find_sun_by_time(const sunsky_keys *p, aur_parameters *parameters,
                                   aur_sun_position *position, aur_error *error) {
    double days;
    if (!aur_days_since_2000((long)p->year, (unsigned)p->month, (unsigned)p->day, &days))
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "%lld-%02lld has no day %lld",
                                   (long long)p->year, (long long)p->month, (long long)p->day);
    const double hours = p->hour + p->minute / 60.0 + p->second / 3600.0 - p->timezone;
    position->solar_distance =
        aur_sun_locate(days + (hours - 12.0) / 24.0, hours, p->latitude, p->longitude, position->sun);
    return AUR_OK;
}

static aur_result find_sun(const sunsky_keys *p, aur_parameters *parameters, aur_sun_position *position,
                           aur_error *error) {
    position->has_sun = true;
    if (aur_parameters_find(parameters, "sun_direction") == NULL)
        return find_sun_by_time(p, parameters, position, error);
    for (size_t i = 0; i < sizeof time_keys / sizeof time_keys[0]; ++i)
        if (aur_parameters_find(parameters, time_keys[i]) != NULL)
            return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                       "give 'sun_direction' or '%s', not both", time_keys[i]);
    position->sun[0] = aur_dot3(p->sun_direction, position->east);
    position->sun[1] = aur_dot3(p->sun_direction, position->north);
    position->sun[2] = aur_dot3(p->sun_direction, position->up);
    if (aur_normalize3(position->sun) < 1.0 / AUR_REACH)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "'sun_direction' must not be 0 0 0");
    position->solar_distance = 1.0;
    return AUR_OK;
}

/* With the sun below the horizon, sky and sun are black, as in Mitsuba. */
static void set_radiance(const sunsky_keys *p, sunsky *self) {
    static const double MEAN_APERTURE = 0.5358;
    const aur_sun_position *const at = &self->position;
    double center[3];
    for (int d = 0; d < 3; ++d)
        center[d] = at->sun[0] * at->east[d] + at->sun[1] * at->north[d] + at->sun[2] * at->up[d];
    self->disk = aur_sun_disk_make(center, 0.5 * p->sun_aperture);
    self->model = aur_hosek_wilkie_sky_make(p->turbidity, p->albedo.constant, at->sun);
    if (at->sun[2] < 0.0)
        return;
    const aur_sun_disk mean = aur_sun_disk_make(center, 0.5 * MEAN_APERTURE);
    self->sky_scale = (float)p->sky_scale;
    self->sun = aur_vector_scale(aur_hosek_wilkie_sun_radiance(p->turbidity, at->sun[2]),
                                 (float)(p->sun_scale * mean.rise / self->disk.rise));
}

static aur_result create(aur_parameters *parameters, aur_emitter *emitter, aur_error *error) {
    sunsky *const self = emitter->data;
    sunsky_keys p = {.turbidity = 0.0};
    aur_result result = aur_colors_read(&emitter->descriptor->row, parameters, &p, error);
    if (result == AUR_OK && p.albedo.texture != NULL)
        result =
            aur_parameters_fail(parameters, error, AUR_ERROR_UNSUPPORTED, "'albedo' cannot be a texture");
    if (result == AUR_OK)
        result = read_frame(&p, parameters, &self->position, error);
    if (result == AUR_OK)
        result = find_sun(&p, parameters, &self->position, error);
    if (result == AUR_OK)
        set_radiance(&p, self);
    emitter->extent = AUR_PI;
    return result;
}

static void release(void *data) {
    aur_sky_dome_release(&((sunsky *)data)->dome);
}

/* --- radiance */

static aur_vector radiance_from(const aur_emitter *emitter, aur_vector direction) {
    const sunsky *const self = emitter->data;
    double local[3];
    aur_sun_position_to_local(&self->position, direction, local);
    if (local[2] < 0.0)
        return (aur_vector){0};
    const aur_vector sky =
        aur_vector_scale(aur_hosek_wilkie_sky_radiance(&self->model, local), self->sky_scale);
    return aur_sun_disk_contains(&self->disk, direction) ? aur_vector_add(sky, self->sun) : sky;
}

static float luminance(const void *data, const double direction[3]) {
    const sunsky *const self = data;
    return self->sky_scale * aur_luminance(aur_hosek_wilkie_sky_radiance(&self->model, direction));
}

/* Sky and sun are sampled in proportion to their power. */
static aur_result prepare(aur_emitter *emitter, aur_error *error) {
    sunsky *const self = emitter->data;
    if (aur_sky_dome_create(&self->dome, luminance, self, 0.0f, error) != AUR_OK)
        return aur_fail_memory_at(error, emitter->location);
    const double sky = aur_patches_integral(&self->dome.patches);
    const double sun = (double)aur_luminance(self->sun) * aur_sun_disk_solid_angle(&self->disk);
    emitter->brightness = sky + sun;
    self->dome_share = sky + sun > 0.0 ? (float)(sky / (sky + sun)) : 1.0f;
    return AUR_OK;
}

static const aur_sun_position *position_of(const aur_emitter *emitter) {
    return &((const sunsky *)emitter->data)->position;
}

/* --- sampling directions */

static float pdf_from(const aur_emitter *emitter, aur_vector direction) {
    const sunsky *const self = emitter->data;
    double local[3];
    aur_sun_position_to_local(&self->position, direction, local);
    const float sky = self->dome_share * aur_sky_dome_pdf(&self->dome, local);
    return aur_sun_disk_contains(&self->disk, direction)
               ? sky + (1.0f - self->dome_share) / (float)aur_sun_disk_solid_angle(&self->disk)
               : sky;
}

static aur_vector draw(const aur_emitter *emitter, float u, float v) {
    const sunsky *const self = emitter->data;
    if (u >= self->dome_share)
        return aur_sun_disk_draw(&self->disk, (u - self->dome_share) / (1.0f - self->dome_share), v);
    double local[3];
    aur_sky_dome_draw(&self->dome, aur_smaller(u / self->dome_share, 1.0f - 0x1p-24f), v, local);
    return aur_sun_position_to_world(&self->position, local);
}

const aur_emitter_descriptor aur_emitter_sunsky = {
    .row = {.name = "sunsky",
            .summary = "a clear sky with its sun (Hosek and Wilkie 2012, 2013; Mitsuba 3)",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(sunsky),
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
