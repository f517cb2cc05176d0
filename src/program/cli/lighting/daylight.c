#include "program/cli/lighting/irradiance.h"

#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Parses `count` numbers separated by commas or blanks. */
static bool read_numbers(const char *text, size_t count, double *values) {
    char copy[128];
    if (strlen(text) >= sizeof copy)
        return false;
    strcpy(copy, text);
    size_t found = 0;
    for (char *rest = copy, *piece; (piece = strtok_r(rest, ", ", &rest)) != NULL; ++found)
        if (found == count || !aur_parse_double(piece, &values[found]))
            return false;
    return found == count;
}

static aur_result parse_direction(const char *text, void *field, aur_error *error) {
    double *const v = field;
    if (!read_numbers(text, 3, v) || !(v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "must be a direction like 0,0,1, not '%s'", text);
    return AUR_OK;
}

static aur_result parse_range(const char *text, void *field, aur_error *error) {
    double *const v = field;
    if (!read_numbers(text, 2, v) || !(v[0] >= 0.0 && v[1] > v[0] && v[1] < 1e9))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "must be two illuminances like 100,3000, not '%s'", text);
    return AUR_OK;
}

/* Parses hours such as 8-18, or 22-6 across midnight. */
static bool read_hours(const char *text, aur_daylight_options *options) {
    const char *const dash = strchr(text, '-');
    char first[8] = "";
    uint64_t from = 0, to = 0;
    if (dash != NULL && (size_t)(dash - text) < sizeof first)
        memcpy(first, text, (size_t)(dash - text));
    if (dash == NULL || !aur_parse_integer(first, 23, &from) || !aur_parse_integer(dash + 1, 24, &to) ||
        from == to)
        return false;
    options->from = (int)from;
    options->to = (int)to;
    return true;
}

/* Reads a number for each hour of the weather, the first in each line; hours with a positive number count. */
static aur_result read_schedule(const char *path, size_t count, bool *hours, aur_error *error) {
    aur_error why;
    FILE *const file = cli_open_input(path, &why);
    if (file == NULL)
        return aur_fail(error, AUR_ERROR_OPEN,
                        "--schedule: hours like 8-18 or 22-6, daylight, or a file expected: %s", why.message);
    char *line = NULL;
    size_t capacity = 0, found = 0, number = 0;
    aur_result result = AUR_OK;
    while (result == AUR_OK && getline(&line, &capacity, file) >= 0) {
        ++number;
        line[strcspn(line, ",;\r\n")] = '\0';
        double value;
        if (line[0] == '#' || line[0] == '\0')
            continue;
        if (!aur_parse_double(line, &value) || found == count) {
            result = aur_fail(error, AUR_ERROR_FORMAT, "%s:%zu: %s", path, number,
                              found == count ? "more hours than the weather has" : "a number expected");
            break;
        }
        hours[found++] = value > 0.0;
    }
    if (result == AUR_OK && found != count)
        result =
            aur_fail(error, AUR_ERROR_FORMAT, "%s: %zu hours, and the weather has %zu", path, found, count);
    free(line);
    fclose(file);
    return result;
}

static aur_result parse_patches(const char *text, void *field, aur_error *error) {
    static const char reinhart[] = "reinhart:";
    uint64_t subdivision = 0;
    if (strcmp(text, "tregenza") == 0)
        subdivision = 1;
    else if (strncmp(text, reinhart, sizeof reinhart - 1) == 0 &&
             !aur_parse_integer(text + sizeof reinhart - 1, 6, &subdivision))
        subdivision = 0;
    *(size_t *)field = (size_t)subdivision;
    return subdivision > 0 ? AUR_OK
                           : aur_fail(error, AUR_ERROR_ARGUMENT,
                                      "must be tregenza or reinhart:M with M from 1 to 6, not '%s'", text);
}

static aur_result parse_albedo(const char *text, void *field, aur_error *error) {
    double *const albedo = field;
    return aur_parse_double(text, albedo) && *albedo >= 0.0 && *albedo <= 1.0
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "must be a number from 0 to 1, not '%s'", text);
}

const cli_option cli_daylight_options[] = {
    {CLI_TEXT(cli_daylight, weather, "weather", "FILE", NULL,
              "compute a year of daylight from an EPW, .wea or TMY3 file instead of the scene's emitters; "
              "the options after this one are for it"),
     .content = "file"},
    {CLI_TEXT(cli_daylight, metrics, "metrics", "FILE", NULL,
              "write daylight metrics (sDA, ASE, means, LEED v4.1, EN 17037) with intervals to a .csv or "
              ".json file"),
     .content = "file", .writes = true},
    {CLI_TEXT(cli_daylight, options.subdivision, "patches", "PATCHES", "tregenza",
              "sky subdivision: tregenza, or reinhart:M with M x M parts of each Tregenza patch"),
     .parse = parse_patches},
    {CLI_CHOICE(cli_daylight, options.efficacy, "efficacy", "MODEL", "perez",
                "luminous efficacy in lm/W: from the weather (Perez et al. 1990), or 179; none reports W/m2 "
                "instead of lux"),
     .key.words = (const char *const[]){"perez", "179", "none", NULL}},
    {CLI_TEXT(cli_daylight, options.ground_albedo, "ground-albedo", "A", "0.2",
              "reflectance of the ground around the scene"),
     .parse = parse_albedo},
    {CLI_TEXT(cli_daylight, options.up, "up", "X,Y,Z", "of the scene's sky; +y, in .rad +z",
              "direction of the zenith"),
     .parse = parse_direction, .key.computed = true},
    {CLI_TEXT(cli_daylight, options.north, "north", "X,Y,Z", "of the scene's sky; -z, or +y where z is up",
              "direction of north"),
     .parse = parse_direction, .key.computed = true},
    {CLI_REAL(cli_daylight, options.threshold, "threshold", "LUX", 1e-3, 1e9, "300",
              "illuminance threshold of daylight autonomy")},
    {CLI_TEXT(cli_daylight, options.useful, "useful", "LUX,LUX", "100,3000",
              "limits of useful daylight illuminance"),
     .parse = parse_range},
    {CLI_TEXT(
        cli_daylight, schedule, "schedule", "H-H|daylight|FILE", "8-18",
        "occupied hours, in the clock time of the weather file (22-6: over midnight); daylight: the half "
        "of the hours with the most diffuse irradiance (EN 17037); or a file with a number per hour "
        "(above 0: occupied)")},
    {CLI_FLAG(cli_daylight, options.weekdays, "weekdays", "count Monday to Friday only")},
    {CLI_TEXT(
         cli_daylight, options.series, "series", "FILE", NULL,
         "write the illuminances of all hours: .npy (sensors x 2 x hours, with standard errors) or .csv"),
     .content = "file", .writes = true},
    {CLI_FLAG(
        cli_daylight, coefficients, "coefficients",
        "instead of a year, write daylight coefficients of the ground and the patches of --patches as a "
        "matrix for dctimestep, or as .npy (sensors x patches x 3)")},
    {.key = {0}}};

/* Whether an option also belongs to --sky or --coefficients, and that was given. */
static bool is_shared(const cli_call *call, const char *name) {
    const bool coefficients = cli_given(call, "coefficients") != NULL;
    const bool frame = strcmp(name, "up") == 0 || strcmp(name, "north") == 0;
    return (cli_given(call, "sky") != NULL && (frame || strcmp(name, "ground-albedo") == 0)) ||
           (coefficients && (frame || strcmp(name, "patches") == 0 || strcmp(name, "coefficients") == 0));
}

bool cli_daylight_check(const cli_call *call) {
    const bool weather = cli_given(call, "weather") != NULL;
    static const char *const without[] = {"error",   "confidence", "parts",     "intervals", "no-errors",
                                          "normals", "counts",     "reflected", "particles", "plot"};
    for (const cli_option *option = cli_daylight_options + 1; option->key.name != NULL && !weather; ++option)
        if (cli_given(call, option->key.name) != NULL && !is_shared(call, option->key.name)) {
            cli_bad_usage("irradiance: --%s needs --weather FILE", option->key.name);
            return false;
        }
    const bool coefficients = cli_given(call, "coefficients") != NULL;
    const char *const with = weather ? "weather" : "coefficients";
    for (size_t i = 0; i < sizeof without / sizeof without[0] && (weather || coefficients); ++i)
        if (cli_given(call, without[i]) != NULL) {
            cli_bad_usage("irradiance: --%s cannot be used with --%s", without[i], with);
            return false;
        }
    static const char *const others[] = {"weather", "sky", "lamp", "to", "json", "illuminance"};
    for (size_t i = 0; i < sizeof others / sizeof others[0] && coefficients; ++i)
        if (cli_given(call, others[i]) != NULL) {
            cli_bad_usage("irradiance: --%s cannot be used with --coefficients", others[i]);
            return false;
        }
    return true;
}

/* Prints a summary line. */
static void print_summary(const aur_daylight_summary *summary) {
    aur_print(stderr,
              "aureole: %zu occupied hours; %.4g %% of the sensors reach the threshold in half of them or "
              "more (%.4g "
              "to %.4g %% by their intervals), %.4g %% have more than 250 hours of direct sun\n",
              summary->hours, summary->spatial_autonomy, summary->spatial_autonomy_least,
              summary->spatial_autonomy_most, summary->sunlight_exposure);
}

static aur_result take_schedule(cli_daylight *given, const aur_weather_view *weather, bool **schedule,
                                aur_error *error) {
    given->options.daylight_hours = given->schedule != NULL && strcmp(given->schedule, "daylight") == 0;
    if (given->schedule == NULL || given->options.daylight_hours ||
        read_hours(given->schedule, &given->options))
        return AUR_OK;
    *schedule = malloc(weather->count * sizeof **schedule);
    if (*schedule == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    given->options.schedule = *schedule;
    given->options.schedule_count = weather->count;
    return read_schedule(given->schedule, weather->count, *schedule, error);
}

aur_result cli_daylight_coefficients(cli_daylight *given, const aur_scene *scene,
                                     const aur_sensors_view *sensors, const char *output, aur_error *error) {
    given->options.size = sizeof given->options;
    const size_t patches = aur_daylight_patch_count(given->options.subdivision);
    double *const coefficients = calloc(sensors->count * 3, patches * sizeof *coefficients);
    if (coefficients == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu sensors and %zu patches",
                        sensors->count, patches);
    aur_result result = aur_daylight_coefficients(scene, sensors, &given->options, coefficients, NULL, error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = aur_daylight_coefficients_write(output, sensors->count, given->options.subdivision,
                                                 coefficients, error);
    free(coefficients);
    return result;
}

aur_result cli_daylight_run(cli_daylight *given, const aur_scene *scene, const aur_sensors_view *sensors,
                            const char *output, const char *format, bool quiet, aur_error *error) {
    aur_weather *weather = NULL;
    aur_daylight_summary summary = {.size = sizeof summary};
    bool *schedule = NULL;
    given->options.size = sizeof given->options;
    given->options.no_ground = given->options.ground_albedo == 0.0;
    aur_result result = aur_weather_read(given->weather, &weather, error);
    if (result == AUR_OK)
        result = take_schedule(given, aur_weather_get_view(weather), &schedule, error);
    aur_daylight *const results = calloc(sensors->count, sizeof *results);
    if (result == AUR_OK && results == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu sensors", sensors->count);
    if (result == AUR_OK)
        result = aur_daylight_estimate(scene, sensors, aur_weather_get_view(weather), &given->options,
                                       sizeof *results, results, &summary, error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = aur_daylight_write(output, format, sensors, sizeof *results, results, error);
    if (result == AUR_OK && given->metrics != NULL)
        result = cli_daylight_metrics(given, &summary, sensors->count, results, error);
    if (result == AUR_OK && !quiet)
        print_summary(&summary);
    aur_weather_destroy(weather);
    free(schedule);
    free(results);
    return result;
}
