/* Normals of solar modules on single-axis trackers. */
#include <math.h>
#include <string.h>

#include "lighting/daylight/hours.h"
#include "points/base/error.h"
#include "points/base/vector.h"

static const double DEGREE = AUR_PI / 180.0, DEFAULT_STEP = 5.0;

static aur_result check(const aur_tracker_options *o, const aur_weather_view *weather, aur_error *error) {
    if (!(o->tilt >= 0.0 && o->tilt <= 90.0) || !(fabs(o->azimuth) <= 360.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the axis of a tracker: a tilt from 0 to 90 and an azimuth from -360 to 360 degrees "
                        "expected, not %g and %g",
                        o->tilt, o->azimuth);
    if (!(o->limit > 0.0 && o->limit <= 90.0) || !(o->ground_cover >= 0.0 && o->ground_cover <= 1.0) ||
        !(o->step >= 0.0 && o->step <= o->limit))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a tracker: a limit above 0 and up to 90 degrees, a ground cover from 0 to 1 and "
                        "a step up to the limit expected, not %g, %g and %g",
                        o->limit, o->ground_cover, o->step);
    return aur_weather_check(weather, error);
}

/* Axes of the tracker at rotation 0, as (east, north, up): across the axis, and the normal. */
typedef struct tracker_frame {
    double across[3], normal[3];
} tracker_frame;

/* The rotation in degrees for a sun above the horizon. */
static double rotation_to(const aur_tracker_options *o, const tracker_frame *frame, const double sun[3]) {
    double x = 0.0, z = 0.0;
    for (size_t d = 0; d < 3; ++d) {
        x += sun[d] * frame->across[d];
        z += sun[d] * frame->normal[d];
    }
    double angle = atan2(x, z);
    const double room = o->ground_cover > 0.0 ? fabs(cos(angle)) / o->ground_cover : 1.0;
    if (room < 1.0)
        angle -= copysign(acos(room), angle);
    const double step = o->step > 0.0 ? o->step : DEFAULT_STEP;
    return fmin(fmax(step * round(angle / DEGREE / step), -o->limit), o->limit) + 0.0; /* no -0 */
}

aur_result aur_tracker_normals(const aur_scene *scene, const aur_weather_view *given_weather,
                               const aur_tracker_options *given, const double up[3], const double north[3],
                               double *rotations, double *normals, aur_error *error) {
    static const double none[3] = {0.0};
    aur_tracker_options o = {.size = sizeof o};
    aur_weather_view weather = {.size = sizeof weather};
    aur_open_sky sky = {.scene = NULL};
    aur_result result = aur_options_read(given, sizeof o, &o, "aur_tracker_options", error);
    if (result == AUR_OK)
        result = aur_options_read(given_weather, sizeof weather, &weather, "aur_weather_view", error);
    if (result == AUR_OK)
        result = check(&o, &weather, error);
    if (result == AUR_OK)
        result = aur_open_sky_create(scene, 0.0, up != NULL ? up : none, north != NULL ? north : none, &sky,
                                     error);
    const double t = o.tilt * DEGREE, a = o.azimuth * DEGREE;
    const tracker_frame frame = {{cos(a), -sin(a), 0.0}, {sin(a) * sin(t), cos(a) * sin(t), cos(t)}};
    for (size_t i = 0; i < weather.count && result == AUR_OK; ++i) {
        double sun[3], distance, *const normal = normals + 3 * i;
        bool is_up;
        result = aur_weather_sun(&weather, i, sun, &distance, &is_up, error);
        memset(normal, 0, 3 * sizeof *normal);
        const double degrees = result == AUR_OK && is_up ? rotation_to(&o, &frame, sun) : NAN;
        if (rotations != NULL)
            rotations[i] = degrees;
        for (size_t d = 0; d < 3 && !isnan(degrees); ++d) {
            const double local =
                sin(degrees * DEGREE) * frame.across[d] + cos(degrees * DEGREE) * frame.normal[d];
            const double *const axis = d == 0 ? sky.frame.east : d == 1 ? sky.frame.north : sky.frame.up;
            for (size_t k = 0; k < 3; ++k)
                normal[k] += local * axis[k];
        }
    }
    aur_open_sky_release(&sky);
    return result;
}

aur_result aur_tracker_options_init(aur_tracker_options *options, aur_error *error) {
    static const aur_tracker_options defaults = {.size = sizeof defaults, .azimuth = 180.0, .limit = 60.0};
    return aur_description_write(&defaults, sizeof defaults, options, "aur_tracker_options", error);
}
