/* Daylight through the hours of a year: illuminances at points under the skies and suns of a weather file.
 *
 * Light travels linearly, so what arrives at a point is the sum over the patches of the sky of their radiance
 * times a daylight coefficient, which the scene alone decides (Tregenza and Waters 1983). The coefficients
 * are found by one trace; every hour is a product then.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_DAYLIGHT_H
#define AUREOLE_DAYLIGHT_H

#include <aureole-lighting/irradiance.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- weather */

/* One hour. Irradiances are means over it in W/m^2, NaN where they are not known. */
typedef struct aur_weather_hour {
    int year, month, day; /* month 1 to 12, day 1 to 31 */
    int hour;             /* 1 to 24: the one that ends then, by the clock of the time zone */
    size_t line;          /* of its file; 0: none */
    double direct_normal, diffuse_horizontal, global_horizontal;
    double dew_point; /* degrees Celsius, NaN where it is not known */
} aur_weather_hour;

/* How often something was read in a file, and the line of the first. */
typedef struct aur_weather_note {
    size_t count, line;
} aur_weather_note;

/* A year of weather at a place, or whole days of one that follow each other. */
typedef struct aur_weather_view {
    size_t size;                /* of the caller's struct, so that it can grow */
    const char *file;           /* for messages; NULL: none */
    double latitude, longitude; /* degrees, north and east */
    double timezone;            /* hours that its clock is ahead of UTC, -14 to 14 */
    double elevation;           /* metres */
    int first_weekday;          /* of the first hour: 0 is Sunday; -1: not known */
    size_t count;               /* hours: 8760 or 8784 of a year; 24 at least */
    const aur_weather_hour *hours;
    /* What estimates warn of: irradiances below 0, taken for 0; empty fields, not known; hours that the file
     * counts from 0 to 23; and how many records an hour of the file has, whose mean it is (0: 1). */
    aur_weather_note negative, empty;
    bool from_zero;
    int records;
} aur_weather_view;

typedef struct aur_weather aur_weather;

/* Reads an EPW file (EnergyPlus weather), or a year of Radiance's .wea (units 1) or of TMY3 as CSV, told by
 * the first line. An EPW has records that follow each other, as many an hour as its header says, from any day
 * on, for whole days up to a year. Fields may be quoted (RFC 4180) or empty; 9999 stands for irradiances that
 * are not known; those from -20 to 0 are 0. Errors: OPEN, MEMORY, and FORMAT with the line: another kind of
 * file, a place that is none on earth, a record with too few fields or with something that is no number,
 * values below -20 or above 2000 W/m^2, hours that do not follow each other, more than a year. */
AUR_EXPERIMENTAL aur_result aur_weather_read(const char *path, aur_weather **weather, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL void aur_weather_destroy(aur_weather *weather); /* NULL is allowed */
/* Its arrays, with all fields set, for as long as it is kept. */
AUR_EXPERIMENTAL const aur_weather_view *aur_weather_get_view(const aur_weather *weather) AUR_NONNULL(1);

/* --- estimates */

/* How lumens are made of watts: by the models of Perez, Ineichen, Seals, Michalsky and Stewart (1990), from
 * the clearness and brightness of the sky and the water in it, or 179 lm/W; or not at all: then irradiances
 * in W/m^2 stand wherever illuminances are spoken of. */
typedef enum aur_luminous_efficacy {
    AUR_EFFICACY_PEREZ,
    AUR_EFFICACY_CONSTANT,
    AUR_EFFICACY_NONE
} aur_luminous_efficacy;

/* All zero but `size`, as aur_daylight_options_init fills it, takes the defaults. */
typedef struct aur_daylight_options {
    size_t size;          /* of the caller's struct, so that it can grow */
    const char *set;      /* a SET of directions; NULL: "spherical-fibonacci" */
    size_t directions;    /* from each sensor, all randomisations together; 0: 16384 */
    size_t max_depth;     /* edges of a light path; 0: no limit */
    size_t subdivision;   /* M of Reinhart's patches, 144 M^2 + 1, from 1 to 6; 0: 1, Tregenza's 145 */
    double luminance[3];  /* weights of the scene's r, g, b, in proportion; all 0: those of Rec. 709 */
    bool no_ground;       /* what is below the horizon is black */
    double ground_albedo; /* what it reflects else; 0: .2 */
    /* To the zenith and to the north in the scene; all 0: as the scene's sky has them; without one +z and +y
     * for scenes of Radiance, else +y and -z. */
    double up[3], north[3];
    aur_luminous_efficacy efficacy;
    double threshold; /* of the autonomy, lux; 0: 300 */
    double useful[2]; /* least and most of useful illuminances, lux; both 0: 100 and 3000 */
    int from, to;  /* o'clock: the hours that count, over midnight where from is above to; both 0: 8 to 18 */
    bool weekdays; /* Monday to Friday only */
    const char *series; /* a file for all hours of all sensors: .npy or .csv; NULL: none */
    uint64_t seed;
    size_t threads; /* 0: all */
    aur_progress progress;
    aur_warnings warnings; /* of sensors, as aur_irradiance_options has them; lamps that are left out; hours
                              that are not known, or whose sky is no sky of the model */
    /* Of each hour of the weather, whether it counts, in place of `from` and `to`; NULL: those. */
    const bool *schedule;
    size_t schedule_count; /* the weather's count */
} aur_daylight_options;

AUR_EXPERIMENTAL aur_result aur_daylight_options_init(aur_daylight_options *options, aur_error *error)
    AUR_NONNULL(1);

/* What is told of a sensor. Shares are percents of the hours that count. */
typedef enum aur_daylight_measure {
    AUR_DAYLIGHT_FACTOR,     /* percent of the horizontal illuminance outside, under the CIE overcast sky */
    AUR_DAYLIGHT_AUTONOMY,   /* share of hours with at least the threshold (Reinhart and Walkenhorst 2001) */
    AUR_DAYLIGHT_CONTINUOUS, /* the same, with hours below it counted in proportion (Rogers 2006) */
    AUR_DAYLIGHT_USEFUL, /* share of hours in the useful range, ends included (Nabil and Mardaljevic 2005) */
    AUR_DAYLIGHT_BELOW,  /* and below it */
    AUR_DAYLIGHT_ABOVE,  /* and above it */
    AUR_DAYLIGHT_SUN_HOURS, /* hours that count with more than 1000 lux straight from the sun */
    AUR_DAYLIGHT_ANNUAL,    /* the sum over all hours of the year, lux hours */
    AUR_DAYLIGHT_MEASURES
} aur_daylight_measure;

typedef struct aur_daylight {
    double value[AUR_DAYLIGHT_MEASURES];
    double error[AUR_DAYLIGHT_MEASURES]; /* standard errors: the jackknife's, over 16 randomisations */
    uint64_t directions;
    double dark;     /* the share of directions that meet the black back of a surface */
    bool on_surface; /* the sensor lay on one, and looked from just above */
    bool doubtful;   /* surfaces there are too near to each other to tell what covers the sensor */
} aur_daylight;

/* All sensors together; `size` is set by the caller to that of the struct. Spatial daylight autonomy and
 * annual sunlight exposure are those of IES LM-83-12 without blinds. */
typedef struct aur_daylight_summary {
    size_t size;
    size_t hours;         /* that count */
    size_t unknown_hours; /* of the year, which the weather does not tell: they do not count */
    size_t other_skies;   /* hours in which the model of Perez has no light anywhere: the sky is uniform */
    /* Percent of sensors whose autonomy is 50 % or more; by the lower and by the upper ends of their 95 %
     * intervals. */
    double spatial_autonomy, spatial_autonomy_least, spatial_autonomy_most;
    double sunlight_exposure; /* percent of sensors with more than 250 sun hours */
} aur_daylight_summary;

/* Estimates a year at each sensor. The scene's own lights are left out: the sky is that of Perez, Seals and
 * Michalsky (1993) by patches, each with its mean radiance; the ground below reflects what reaches it; the
 * sun is a disk of .2665 degrees whose own light is traced for each hour, while what it brings by reflection
 * goes by the patch in which it stands. `results` has sensors->count elements of `result_size` bytes, the
 * caller's sizeof; `summary` may be NULL. A sensor's result is a function of the scene, the weather, the
 * options, its position and its normal. Errors: as aur_irradiance_estimate; ARGUMENT and FORMAT for weather
 * that cannot be; OPEN and WRITE of the series. */
AUR_EXPERIMENTAL aur_result aur_daylight_estimate(const aur_scene *scene, const aur_sensors_view *sensors,
                                                  const aur_weather_view *weather,
                                                  const aur_daylight_options *options, size_t result_size,
                                                  aur_daylight *results, aur_daylight_summary *summary,
                                                  aur_error *error) AUR_NONNULL(1, 2, 3, 6);

/* Writes x, y, z, then each measure with its standard error, as aur_irradiance_write does; the colours of PLY
 * show the autonomy. */
AUR_EXPERIMENTAL aur_result aur_daylight_write(const char *path, const char *format,
                                               const aur_sensors_view *sensors, size_t result_size,
                                               const aur_daylight *results, aur_error *error)
    AUR_NONNULL(1, 2, 3, 5);

/* --- coefficients */

/* Patches of the sky with M x M parts of each Tregenza patch, and the ground: 144 M^2 + 2; M = 0 is 1. Patch
 * 0 is the ground, the others are in the order of Radiance's reinhartb.cal: rows from the horizon up, in each
 * row clockwise from north, the zenith last. */
AUR_EXPERIMENTAL size_t aur_daylight_patch_count(size_t subdivision);

/* Daylight coefficients of r, g, b (Tregenza and Waters 1983): the irradiance of each sensor for radiance 1
 * of each patch, in sr, with the light that the scene reflects. coefficients[sensors->count][patches][3];
 * `errors`, of the same shape, are their standard errors, or NULL. Of the options, those of weather and
 * metrics have no effect. Errors: as aur_irradiance_estimate. */
AUR_EXPERIMENTAL aur_result aur_daylight_coefficients(const aur_scene *scene, const aur_sensors_view *sensors,
                                                      const aur_daylight_options *options,
                                                      double *coefficients, double *errors, aur_error *error)
    AUR_NONNULL(1, 2, 4);

/* Writes coefficients[sensors][patches][3] as NPY (float64) where the name ends in .npy, else as a matrix of
 * Radiance (float), which dctimestep and rmtxop read. Errors: OPEN, WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_daylight_coefficients_write(const char *path, size_t sensors,
                                                            size_t subdivision, const double *coefficients,
                                                            aur_error *error) AUR_NONNULL(1, 4);

#ifdef __cplusplus
}
#endif

#endif
