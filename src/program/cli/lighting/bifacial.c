/* Front and rear irradiance of solar modules, fixed or on trackers, over a year of weather. */
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/lighting/irradiance.h"
#include "program/report/report.h"

enum { DIGITS = 9 };

static aur_result parse_pivot(const char *text, void *field, aur_error *error) {
    double *const pivot = field;
    return cli_split_numbers(text, 3, pivot) == 3
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "--pivot: a point like 0,0,1.5 expected, not '%s'",
                          text);
}

const cli_option cli_bifacial_options[] = {
    {CLI_FLAG(cli_bifacial, requested, "bifacial",
              "with --weather, report front and rear irradiation (Wh/m2) and the bifacial gain of solar "
              "modules at the sensors, whose normals are those of the fronts")},
    {CLI_TEXT(cli_bifacial, tracker, "tracker", "TILT,AZIMUTH,LIMIT,GCR[,STEP]|FILE", NULL,
              "as --bifacial, for modules on a single-axis tracker: tilt and azimuth of the axis, largest "
              "rotation, ground cover (0: no backtracking) and the step of rotations (5), in degrees; or a "
              "file with a normal x y z per hour (0 0 0: none)"),
     .content = "file"},
    {CLI_TEXT(
        cli_bifacial, rotation, "rotation", "NAME", NULL,
        "the variable $NAME of the scene that turns its modules by the rotation of --tracker, in XML or "
        "in !xform of Radiance's files")},
    {CLI_TEXT(cli_bifacial, pivot, "pivot", "X,Y,Z", "the mean of the sensors",
              "a point of the axis about which all sensors turn from their normals to those of --tracker: "
              "give the sensors of one row of modules"),
     .parse = parse_pivot, .key.computed = true},
    {.key = {0}}};

bool cli_bifacial_check(const cli_call *call, cli_bifacial *given, const char *format) {
    given->has_pivot = cli_given(call, "pivot") != NULL;
    given->requested = given->requested || given->tracker != NULL;
    static const char *const needing[] = {"rotation", "pivot"};
    for (size_t i = 0; i < 2 && given->tracker == NULL; ++i)
        if (cli_given(call, needing[i]) != NULL)
            return cli_bad_usage("irradiance: --%s needs --tracker", needing[i]), false;
    static const char *const without[] = {"metrics", "schedule",     "weekdays", "threshold",
                                          "useful",  "coefficients", "efficacy", "illuminance"};
    for (size_t i = 0; i < sizeof without / sizeof without[0] && given->requested; ++i)
        if (cli_given(call, without[i]) != NULL)
            return cli_bad_usage("irradiance: --%s cannot be used with --bifacial or --tracker", without[i]),
                   false;
    if (given->requested && cli_given(call, "weather") == NULL)
        return cli_bad_usage("irradiance: --%s needs --weather FILE",
                             given->tracker != NULL ? "tracker" : "bifacial"),
               false;
    if (given->requested && strcmp(format, "csv") != 0 && strcmp(format, "json") != 0)
        return cli_bad_usage("irradiance: --bifacial and --tracker write csv or json, not %s", format), false;
    return true;
}

/* The distinct normals of a year, and sums over their runs. */
typedef struct work {
    cli_bifacial *given;
    const cli_bifacial_run_options *run;
    const aur_weather_view *weather;
    double *normals, *rotations; /* per hour; rotations: NaN without the axis of a tracker */
    bool *evaluated;
    size_t count;               /* sensors of the file; each stands for a front and a rear */
    double *frame;              /* positions and normals of the run: 2 * count each */
    double *hourly;             /* of one run */
    double *series;             /* [2 * count][2][hours], NULL: not requested */
    aur_daylight *found, *sums; /* 2 * count: of one run, and over all */
    aur_error *error;
} work;

/* --- normals */

static aur_result read_table(const work *w) {
    char *line = NULL;
    size_t capacity = 0, found = 0, number = 0;
    FILE *const file = cli_open_input(w->given->tracker, w->error);
    aur_result result = file != NULL ? AUR_OK : AUR_ERROR_OPEN;
    while (result == AUR_OK && getline(&line, &capacity, file) >= 0) {
        ++number;
        double row[3];
        size_t numbers = 0;
        bool valid = true;
        line[strcspn(line, "#\r\n")] = '\0';
        for (char *rest = line, *piece; (piece = strtok_r(rest, ",; \t", &rest)) != NULL; ++numbers)
            valid = valid && numbers < 3 && aur_parse_double(piece, &row[numbers]);
        if (numbers == 0)
            continue;
        if (found == w->weather->count || !valid || numbers != 3)
            result = aur_fail(w->error, AUR_ERROR_FORMAT, "%s:%zu: %s", w->given->tracker, number,
                              found == w->weather->count ? "more hours than the weather has"
                                                         : "a normal of three numbers expected");
        else
            memcpy(w->normals + 3 * found++, row, sizeof row);
    }
    if (result == AUR_OK && found != w->weather->count)
        result = aur_fail(w->error, AUR_ERROR_FORMAT, "%s: %zu hours, and the weather has %zu",
                          w->given->tracker, found, w->weather->count);
    free(line);
    if (file != NULL)
        fclose(file);
    return result;
}

static aur_result find_normals(const work *w, const aur_scene *scene) {
    double numbers[5] = {0.0};
    for (size_t i = 0; i < w->weather->count; ++i)
        w->rotations[i] = NAN;
    if (w->given->tracker == NULL)
        return AUR_OK;
    const size_t count = cli_split_numbers(w->given->tracker, 5, numbers);
    if (count < 4 && w->given->rotation != NULL)
        return aur_fail(w->error, AUR_ERROR_ARGUMENT,
                        "--rotation needs --tracker TILT,AZIMUTH,LIMIT,GCR[,STEP] in numbers, not '%s'",
                        w->given->tracker);
    if (count < 4)
        return read_table(w);
    aur_tracker_options tracker = {.size = sizeof tracker};
    aur_tracker_options_init(&tracker, NULL);
    tracker.tilt = numbers[0];
    tracker.azimuth = numbers[1];
    tracker.limit = numbers[2];
    tracker.ground_cover = numbers[3];
    tracker.step = numbers[4];
    return aur_tracker_normals(scene, w->weather, &tracker, w->run->daylight->up, w->run->daylight->north,
                               w->rotations, w->normals, w->error);
}

/* --- sensors */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
    for (size_t d = 0; d < 3; ++d)
        c[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
}

/* Applies the smallest rotation from the unit vector `from` to `to` to a vector (Rodrigues). */
static void turn(const double from[3], const double to[3], double vector[3]) {
    double axis[3], once[3], twice[3];
    cross(from, to, axis);
    cross(axis, vector, once);
    cross(axis, once, twice);
    for (size_t d = 0; d < 3; ++d)
        vector[d] += once[d] + twice[d] / (1.0 + dot(from, to));
}

/* Turns the sensors to a normal (NULL: they stay), and places the rear ones on the other side. */
static aur_result place_sensors(work *w, const aur_sensors_view *sensors, const double *normal) {
    double *const positions = w->frame, *const normals = w->frame + 6 * w->count;
    for (size_t i = 0; i < w->count; ++i) {
        double position[3], from[3], length = sqrt(dot(sensors->normals + 3 * i, sensors->normals + 3 * i));
        for (size_t d = 0; d < 3; ++d) {
            from[d] = sensors->normals[3 * i + d] / length;
            position[d] = sensors->positions[3 * i + d] - w->given->pivot[d];
        }
        if (normal != NULL) {
            length = sqrt(dot(normal, normal));
            const double to[3] = {normal[0] / length, normal[1] / length, normal[2] / length};
            if (dot(from, to) < -0.999999)
                return aur_fail(w->error, AUR_ERROR_ARGUMENT,
                                "--tracker: a normal opposite to that of sensor %zu: it can turn to any side",
                                i);
            turn(from, to, position);
            memcpy(from, to, sizeof from);
        }
        for (size_t d = 0; d < 3; ++d) {
            positions[3 * i + d] = position[d] + w->given->pivot[d];
            positions[3 * (w->count + i) + d] = positions[3 * i + d] - 2.0 * w->run->lift * from[d];
            normals[3 * i + d] = from[d];
            normals[3 * (w->count + i) + d] = -from[d];
        }
    }
    return AUR_OK;
}

/* --- runs */

/* Adds the hours of one normal, which are those of `evaluated`. */
static aur_result run_normal(work *w, const aur_scene *fixed, const aur_sensors_view *sensors, size_t hour,
                             bool first) {
    aur_scene *turned = NULL;
    const double *const normal = w->given->tracker != NULL ? w->normals + 3 * hour : NULL;
    aur_result result = place_sensors(w, sensors, normal);
    if (result == AUR_OK && w->given->rotation != NULL) {
        aur_format(w->given->degrees, sizeof w->given->degrees, "%.9g", w->rotations[hour]);
        result = aur_scene_load(w->run->path, w->run->load, &turned, w->error);
    }
    if (result != AUR_OK)
        return result;
    aur_daylight_options options = *w->run->daylight;
    const aur_sensors_view both = {.size = sizeof both,
                                   .count = 2 * w->count,
                                   .positions = w->frame,
                                   .normals = w->frame + 6 * w->count};
    options.efficacy = AUR_EFFICACY_NONE;
    options.series = NULL;
    options.hourly = w->series != NULL ? w->hourly : NULL;
    options.evaluated = w->evaluated;
    if (!first)
        options.warnings = (aur_warnings){.function = NULL};
    result = aur_daylight_estimate(turned != NULL ? turned : fixed, &both, w->weather, &options,
                                   sizeof *w->found, w->found, NULL, w->error);
    aur_scene_destroy(turned);
    const size_t hours = w->weather->count;
    for (size_t i = 0; i < 2 * w->count && result == AUR_OK; ++i) {
        w->sums[i].value[AUR_DAYLIGHT_ANNUAL] += w->found[i].value[AUR_DAYLIGHT_ANNUAL];
        w->sums[i].error[AUR_DAYLIGHT_ANNUAL] += w->found[i].error[AUR_DAYLIGHT_ANNUAL];
        for (size_t k = 0; k < 2 * hours && w->series != NULL; ++k)
            if (w->evaluated[k % hours])
                w->series[2 * hours * i + k] = w->hourly[2 * hours * i + k];
    }
    return result;
}

/* One run per distinct normal. */
static aur_result run_all(work *w, const aur_scene *scene, const aur_sensors_view *sensors) {
    const size_t hours = w->weather->count;
    bool *const done = calloc(hours, sizeof *done);
    if (done == NULL)
        return aur_fail(w->error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = AUR_OK;
    bool first = true;
    for (size_t i = 0; i < hours && result == AUR_OK; ++i) {
        const double *const normal = w->normals + 3 * i;
        if (done[i] || (w->given->tracker != NULL && !(dot(normal, normal) > 0.0)))
            continue;
        for (size_t k = 0; k < hours; ++k) {
            w->evaluated[k] = memcmp(w->normals + 3 * k, normal, 3 * sizeof *normal) == 0;
            done[k] = done[k] || w->evaluated[k];
        }
        result = run_normal(w, scene, sensors, i, first);
        first = false;
    }
    free(done);
    return result == AUR_OK && first ? aur_fail(w->error, AUR_ERROR_ARGUMENT, "no hour has a normal")
                                     : result;
}

/* --- results */

static aur_result write_table(const work *w, const report_table *table, const char *path, bool json) {
    char *text = NULL;
    size_t size = 0;
    FILE *const stream = open_memstream(&text, &size);
    if (stream == NULL)
        return aur_fail(w->error, AUR_ERROR_MEMORY, "out of memory for the results");
    aur_result result = report_write(table, json ? REPORT_JSON : REPORT_CSV, stream, w->error);
    if (fclose(stream) != 0 && result == AUR_OK)
        result = aur_fail(w->error, AUR_ERROR_MEMORY, "out of memory for the results");
    if (result == AUR_OK)
        result = aur_file_write(path, size, text, w->error);
    free(text);
    return result;
}

static aur_result write_sums(const work *w, const aur_sensors_view *sensors, const char *path,
                             const char *format) {
    static const char *const columns[] = {"x",    "y",          "z",    "front",     "front_error",
                                          "rear", "rear_error", "gain", "gain_error"};
    report_table *const table = report_create(sizeof columns / sizeof columns[0], columns);
    for (size_t i = 0; i < w->count; ++i) {
        const aur_daylight *const sides[2] = {&w->sums[i], &w->sums[w->count + i]};
        double value[2], error[2];
        for (size_t d = 0; d < 3; ++d)
            report_number(table, sensors->positions[3 * i + d], DIGITS);
        for (size_t s = 0; s < 2; ++s) {
            value[s] = sides[s]->value[AUR_DAYLIGHT_ANNUAL];
            error[s] = sides[s]->error[AUR_DAYLIGHT_ANNUAL];
            report_number(table, value[s], DIGITS);
            report_number(table, error[s], DIGITS);
        }
        const double gain = value[0] > 0.0 ? value[1] / value[0] : NAN;
        report_number(table, 100.0 * gain, DIGITS);
        report_number(table, isnan(gain) ? NAN : 100.0 * (error[1] + gain * error[0]) / value[0], DIGITS);
    }
    const aur_result result = write_table(w, table, path, strcmp(format, "json") == 0);
    report_destroy(table);
    return result;
}

static aur_result write_series(const work *w, const char *path) {
    static const char *const columns[] = {"sensor", "month",       "day",  "hour",      "rotation",
                                          "front",  "front_error", "rear", "rear_error"};
    const size_t hours = w->weather->count;
    report_table *const table = report_create(sizeof columns / sizeof columns[0], columns);
    for (size_t i = 0; i < w->count; ++i)
        for (size_t h = 0; h < hours; ++h) {
            const aur_weather_hour *const hour = &w->weather->hours[h];
            const double *const front = w->series + 2 * hours * i, *const rear = front + 2 * hours * w->count;
            report_integer(table, i);
            report_integer(table, (uint64_t)hour->month);
            report_integer(table, (uint64_t)hour->day);
            report_integer(table, (uint64_t)hour->hour);
            if (isnan(w->rotations[h]))
                report_text(table, "");
            else
                report_number(table, w->rotations[h], DIGITS);
            for (size_t k = 0; k < 4; ++k)
                report_number(table, (k < 2 ? front : rear)[k % 2 * hours + h], DIGITS);
        }
    const aur_result result = write_table(w, table, path, false);
    report_destroy(table);
    return result;
}

static void warn_of_darkness(const work *w) {
    const aur_warnings warnings = w->run->daylight->warnings;
    for (size_t i = 0; i < w->count; ++i)
        if (!(w->sums[i].value[AUR_DAYLIGHT_ANNUAL] > 0.0)) {
            char text[160];
            aur_format(text, sizeof text,
                       "sensor %zu: no light on its front over the whole year: its gain is not a number", i);
            if (warnings.function != NULL)
                warnings.function(warnings.user, text);
            return;
        }
}

static aur_result allocate(work *w) {
    const size_t hours = w->weather->count, sides = 2 * w->count;
    w->normals = calloc(3 * hours, sizeof *w->normals);
    w->rotations = calloc(hours, sizeof *w->rotations);
    w->evaluated = calloc(hours, sizeof *w->evaluated);
    w->frame = calloc(6 * sides, sizeof *w->frame);
    w->found = calloc(sides, sizeof *w->found);
    w->sums = calloc(sides, sizeof *w->sums);
    bool enough = w->normals != NULL && w->rotations != NULL && w->evaluated != NULL && w->frame != NULL &&
                  w->found != NULL && w->sums != NULL;
    if (enough && w->run->daylight->series != NULL) {
        w->hourly = calloc(2 * hours, sides * sizeof *w->hourly);
        w->series = calloc(2 * hours, sides * sizeof *w->series);
        enough = w->hourly != NULL && w->series != NULL;
    }
    return enough ? AUR_OK : aur_fail(w->error, AUR_ERROR_MEMORY, "out of memory for %zu sensors", w->count);
}

aur_result cli_bifacial_run(cli_bifacial *given, const cli_bifacial_run_options *run, const aur_scene *scene,
                            const aur_sensors_view *sensors, const char *output, const char *format,
                            aur_error *error) {
    aur_weather *weather = NULL;
    const char *const series = run->daylight->series;
    const size_t length = series != NULL ? strlen(series) : 0;
    if (series != NULL && (length < 4 || strcmp(series + length - 4, ".csv") != 0))
        return aur_fail(error, AUR_ERROR_NAME, "--series: with --bifacial or --tracker a .csv file expected");
    aur_result result = aur_weather_read(run->weather, &weather, error);
    if (result != AUR_OK)
        return result;
    work w = {.given = given,
              .run = run,
              .weather = aur_weather_get_view(weather),
              .count = sensors->count,
              .error = error};
    for (size_t i = 0; i < 3 * sensors->count && !given->has_pivot; ++i)
        given->pivot[i % 3] += sensors->positions[i] / (double)sensors->count;
    result = allocate(&w);
    if (result == AUR_OK)
        result = find_normals(&w, scene);
    if (result == AUR_OK)
        result = run_all(&w, scene, sensors);
    cli_progress_clear();
    if (result == AUR_OK)
        result = write_sums(&w, sensors, output, format);
    if (result == AUR_OK && series != NULL)
        result = write_series(&w, series);
    if (result == AUR_OK)
        warn_of_darkness(&w);
    aur_weather_destroy(weather);
    void *const parts[] = {w.normals, w.rotations, w.evaluated, w.frame, w.found, w.sums, w.hourly, w.series};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i)
        free(parts[i]);
    return result;
}
