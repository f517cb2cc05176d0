/* Annual daylight simulation: illuminances at sensor points under the skies and suns of a weather file.
 *
 * Light transport is linear: the illuminance at a sensor is the sum over the sky patches of their radiance
 * times a daylight coefficient, which depends only on the scene (Tregenza and Waters 1983). One trace
 * computes the coefficients; every hour is then a product.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_DAYLIGHT_H
#define AUREOLE_DAYLIGHT_H

#include <aureole-lighting/irradiance.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- weather */

/* One hour. Irradiances are means over the hour in W/m^2; NaN: missing. */
typedef struct aur_weather_hour {
    int year, month, day; /* month 1 to 12, day 1 to 31 */
    int hour;             /* 1 to 24: the hour that ends then, in the time zone's clock */
    size_t line;          /* line in the file; 0: none */
    double direct_normal, diffuse_horizontal, global_horizontal;
    double dew_point; /* degrees Celsius; NaN: missing */
} aur_weather_hour;

/* The number of occurrences of something in a file, and the line of the first. */
typedef struct aur_weather_note {
    size_t count, line;
} aur_weather_note;

/* A year of weather at one location, or consecutive whole days of a year. */
typedef struct aur_weather_view {
    size_t size;                /* of the caller's struct, so that it can grow */
    const char *file;           /* for messages; NULL: none */
    double latitude, longitude; /* degrees, north and east */
    double timezone;            /* hours ahead of UTC, -14 to 14 */
    double elevation;           /* metres */
    int first_weekday;          /* of the first hour: 0 is Sunday; -1: unspecified */
    size_t count;               /* number of hours: 8760 or 8784 for a year; at least 24 */
    const aur_weather_hour *hours;
    /* What estimates warn of: negative irradiances, read as 0; empty fields, read as missing; hours that the
     * file counts from 0 to 23. Then the number of records per hour in the file, which are averaged (0: 1).
     */
    aur_weather_note negative, empty;
    bool from_zero;
    int records;
} aur_weather_view;

typedef struct aur_weather aur_weather;

/* Reads an EPW file (EnergyPlus weather), a year of Radiance's .wea (units 1) or a year of TMY3 as CSV; the
 * first line selects the format. An EPW has consecutive records, as many per hour as its header states, for
 * whole days up to a year, starting on any day. Fields may be quoted (RFC 4180) or empty. An irradiance of
 * 9999 is missing; one from -20 to 0 is 0. Errors: OPEN, MEMORY, and FORMAT with the line: another kind of
 * file, coordinates out of range, a record with too few fields or with a field that is not a number, values
 * below -20 or above 2000 W/m^2, hours that are not consecutive, more than a year. */
AUR_EXPERIMENTAL aur_result aur_weather_read(const char *path, aur_weather **weather, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL void aur_weather_destroy(aur_weather *weather); /* NULL is allowed */
/* Its arrays, with all fields set; valid until the weather is destroyed. */
AUR_EXPERIMENTAL const aur_weather_view *aur_weather_get_view(const aur_weather *weather) AUR_NONNULL(1);

/* --- estimates */

/* Luminous efficacy, from watts to lumens: the models of Perez, Ineichen, Seals, Michalsky and Stewart
 * (1990), by the clearness and brightness of the sky and its precipitable water; or 179 lm/W; or none: then
 * all illuminances are irradiances in W/m^2. */
typedef enum aur_luminous_efficacy {
    AUR_EFFICACY_PEREZ,
    AUR_EFFICACY_CONSTANT,
    AUR_EFFICACY_NONE
} aur_luminous_efficacy;

/* All zero but `size`, as set by aur_daylight_options_init, selects the defaults. */
typedef struct aur_daylight_options {
    size_t size;          /* of the caller's struct, so that it can grow */
    const char *set;      /* a SET of directions; NULL: "spherical-fibonacci" */
    size_t directions;    /* per sensor, over all randomisations; 0: 16384 */
    size_t max_depth;     /* edges of a light path; 0: no limit */
    size_t subdivision;   /* M of Reinhart's patches, 144 M^2 + 1, from 1 to 6; 0: 1, Tregenza's 145 */
    double luminance[3];  /* weights of the scene's r, g, b, in proportion; all 0: those of Rec. 709 */
    bool no_ground;       /* the ground below the horizon is black */
    double ground_albedo; /* reflectance of the ground otherwise; 0: .2 */
    /* Directions of the zenith and of north in the scene; all 0: those of the scene's sky. Without a sky +z
     * and +y for Radiance scenes, else +y and -z. */
    double up[3], north[3];
    aur_luminous_efficacy efficacy;
    double threshold;   /* for daylight autonomy, lux; 0: 300 */
    double useful[2];   /* lower and upper bound of useful illuminances, lux; both 0: 100 and 3000 */
    int from, to;       /* occupied hours, o'clock; over midnight if from is above to; both 0: 8 to 18 */
    bool weekdays;      /* Monday to Friday only */
    const char *series; /* file for all hours of all sensors: .npy or .csv; NULL: none */
    uint64_t seed;
    size_t threads; /* 0: all */
    aur_progress progress;
    aur_warnings warnings; /* of sensors, as in aur_irradiance_options; light sources that are ignored;
                            * missing hours; hours whose sky the model cannot represent */
    /* For each hour of the weather, whether it is occupied; overrides `from` and `to`. NULL: not used. */
    const bool *schedule;
    size_t schedule_count; /* must equal the weather's count */
    /* The occupied hours are the daylight hours of EN 17037: the half of the weather's hours with the most
     * diffuse horizontal irradiance, of equal hours the earlier ones. Overrides `from` and `to`; not together
     * with `schedule`. */
    bool daylight_hours;
    /* [sensors->count][2][weather->count]: receives the value of each hour and its standard error, NaN in
     * missing hours. NULL: not used. */
    double *hourly;
    /* For each hour of the weather, whether it is evaluated; all values of other hours are 0. NULL: all. */
    const bool *evaluated;
} aur_daylight_options;

AUR_EXPERIMENTAL aur_result aur_daylight_options_init(aur_daylight_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Measures of a sensor. Shares are percentages of the occupied hours. */
typedef enum aur_daylight_measure {
    AUR_DAYLIGHT_FACTOR,     /* percent of the horizontal illuminance outside, under the CIE overcast sky */
    AUR_DAYLIGHT_AUTONOMY,   /* share of hours with at least the threshold (Reinhart and Walkenhorst 2001) */
    AUR_DAYLIGHT_CONTINUOUS, /* the same, with hours below it counted in proportion (Rogers 2006) */
    AUR_DAYLIGHT_USEFUL, /* share of hours in the useful range, ends included (Nabil and Mardaljevic 2005) */
    AUR_DAYLIGHT_BELOW,  /* share of hours below the useful range */
    AUR_DAYLIGHT_ABOVE,  /* share of hours above the useful range */
    AUR_DAYLIGHT_SUN_HOURS, /* occupied hours with more than 1000 lux directly from the sun */
    AUR_DAYLIGHT_ANNUAL,    /* sum over all hours of the year, lux hours */
    AUR_DAYLIGHT_MEASURES
} aur_daylight_measure;

typedef struct aur_daylight {
    double value[AUR_DAYLIGHT_MEASURES];
    double error[AUR_DAYLIGHT_MEASURES]; /* jackknife standard errors over 16 randomisations */
    uint64_t directions;
    double dark;     /* share of directions that hit the black back of a surface */
    bool on_surface; /* the sensor lies on a surface; it was evaluated just above it */
    bool doubtful;   /* surfaces are too close together to determine whether one covers the sensor */
} aur_daylight;

/* Summary of all sensors; the caller sets `size` to that of the struct. Spatial daylight autonomy and annual
 * sunlight exposure follow IES LM-83-12, without blinds. */
typedef struct aur_daylight_summary {
    size_t size;
    size_t hours;         /* number of occupied hours */
    size_t unknown_hours; /* missing in the weather; not counted */
    size_t other_skies;   /* hours in which the Perez model gives no light anywhere: the sky is uniform */
    /* Percentage of sensors whose autonomy is 50 % or more; the same for the lower and upper ends of their 95
     * % intervals. */
    double spatial_autonomy, spatial_autonomy_least, spatial_autonomy_most;
    double sunlight_exposure; /* percentage of sensors with more than 250 sun hours */
} aur_daylight_summary;

/* Simulates a year at each sensor. The scene's own light sources are ignored. The sky is that of Perez, Seals
 * and Michalsky (1993), averaged over patches; the ground below reflects what reaches it. The sun is a disk
 * of .2665 degrees whose direct light is traced for each hour; its reflected light uses the coefficient of
 * the patch that contains it. `results` has sensors->count elements of `result_size` bytes (the caller's
 * sizeof); `summary` may be NULL. A sensor's result depends only on the scene, the weather, the options, its
 * position and its normal. Errors: as aur_irradiance_estimate; ARGUMENT and FORMAT for invalid weather; OPEN
 * and WRITE of the series. */
AUR_EXPERIMENTAL aur_result aur_daylight_estimate(const aur_scene *scene, const aur_sensors_view *sensors,
                                                  const aur_weather_view *weather,
                                                  const aur_daylight_options *options, size_t result_size,
                                                  aur_daylight *results, aur_daylight_summary *summary,
                                                  aur_error *error) AUR_NONNULL(1, 2, 3, 6);

/* Writes x, y, z, then each measure with its standard error, like aur_irradiance_write; PLY colours show the
 * autonomy. */
AUR_EXPERIMENTAL aur_result aur_daylight_write(const char *path, const char *format,
                                               const aur_sensors_view *sensors, size_t result_size,
                                               const aur_daylight *results, aur_error *error)
    AUR_NONNULL(1, 2, 3, 5);

/* --- trackers */

/* A single-axis tracker. */
typedef struct aur_tracker_options {
    size_t size;    /* of the caller's struct, so that it can grow */
    double tilt;    /* of the axis against the horizontal, 0 to 90 degrees */
    double azimuth; /* direction in which the axis descends, degrees clockwise from north; default: 180 */
    double limit;   /* largest rotation to each side, up to 90 degrees; default: 60 */
    /* Width of the modules over the distance of the axes, up to 1: with low sun the modules turn back so that
     * no row shades the next. 0: no backtracking. */
    double ground_cover;
    double step; /* rotations are rounded to multiples of this angle in degrees; 0: 5 */
} aur_tracker_options;

AUR_EXPERIMENTAL aur_result aur_tracker_options_init(aur_tracker_options *options, aur_error *error)
    AUR_NONNULL(1);

/* For each hour, the rotation in degrees (right-handed about the azimuth, so positive to the west for an axis
 * to the south; NaN when the sun is below the horizon), and the normal of the modules in the
 * scene, 0 0 0 when there is none. rotations[weather->count], or NULL; normals[weather->count][3]. `up` and
 * `north` are as in aur_daylight_options; NULL: 0. The algorithm is that of pvlib's singleaxis (Lorenzo,
 * Narvarte and Munoz 2011; Anderson and Mikofski 2020, without a slope across the axes) for the sun's
 * position at the middle of the sunlit part of the hour. Errors: ARGUMENT, MEMORY, FORMAT (directions). */
AUR_EXPERIMENTAL aur_result aur_tracker_normals(const aur_scene *scene, const aur_weather_view *weather,
                                                const aur_tracker_options *tracker, const double up[3],
                                                const double north[3], double *rotations, double *normals,
                                                aur_error *error) AUR_NONNULL(1, 2, 3, 7);

/* --- coefficients */

/* Number of patches: M x M per Tregenza patch, and the ground: 144 M^2 + 2; M = 0 means 1. Patch 0 is the
 * ground. The others are ordered as in Radiance's reinhartb.cal: rows from the horizon up, each clockwise
 * from north, the zenith last. */
AUR_EXPERIMENTAL size_t aur_daylight_patch_count(size_t subdivision);

/* Daylight coefficients for r, g, b (Tregenza and Waters 1983): the irradiance at each sensor,
 * interreflections included, for radiance 1 of each patch, in sr. coefficients[sensors->count][patches][3];
 * `errors`, of the same shape, are their standard errors, or NULL. Options for weather and metrics have no
 * effect. Errors: as aur_irradiance_estimate. */
AUR_EXPERIMENTAL aur_result aur_daylight_coefficients(const aur_scene *scene, const aur_sensors_view *sensors,
                                                      const aur_daylight_options *options,
                                                      double *coefficients, double *errors, aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* Writes coefficients[sensors][patches][3] as NPY (float64) if the name ends in .npy, else as a Radiance
 * matrix (float), which dctimestep and rmtxop read. Errors: OPEN, WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_daylight_coefficients_write(const char *path, size_t sensors,
                                                            size_t subdivision, const double *coefficients,
                                                            aur_error *error) AUR_NONNULL(1, 4);

#ifdef __cplusplus
}
#endif

#endif
