/* Weather files: EnergyPlus's EPW, eight lines of header and then a record an hour. */
#include "lighting/daylight/weather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/text.h"
#include "scene/lights/sun_position.h"

enum { LONGEST_YEAR = 8784, HEADER_LINES = 64, SHOWN = 40 };

struct aur_weather {
    aur_weather_view view;
    char *file;
    aur_weather_hour hours[LONGEST_YEAR];
};

/* Where a file is being read: the line, which ends with a zero byte. */
typedef struct reader {
    const char *path;
    char *line, *next; /* the next line, or NULL */
    size_t number;
    aur_error *error;
} reader;

static bool next_line(reader *r) {
    if (r->next == NULL || *r->next == '\0')
        return false;
    r->line = r->next;
    char *const end = strchr(r->line, '\n');
    r->next = end != NULL ? end + 1 : NULL;
    if (end != NULL)
        *end = '\0';
    ++r->number;
    return true;
}

static aur_location place_of(const reader *r) {
    return (aur_location){.file = r->path, .line = r->number};
}

/* Field `index` of the line, from 0 on, with blanks before it skipped; NULL beyond the last. */
static const char *field(const reader *r, size_t index) {
    const char *at = r->line;
    for (; index > 0; --index) {
        at = strchr(at, ',');
        if (at == NULL)
            return NULL;
        ++at;
    }
    return aur_skip_spaces(at);
}

static aur_result read_number(const reader *r, size_t index, const char *what, double least, double most,
                              double *value) {
    const char *const text = field(r, index);
    if (text == NULL)
        return aur_fail_at(r->error, place_of(r), AUR_ERROR_FORMAT, "the line ends before %s, its field %zu",
                           what, index + 1);
    const char *end = aur_read_double(*text == '+' ? text + 1 : text, AUR_NUMBER_FINITE, value);
    end = end != NULL ? aur_skip_spaces(end) : NULL;
    if (end == NULL || (*end != ',' && *end != '\0') || !(*value >= least && *value <= most))
        return aur_fail_at(r->error, place_of(r), AUR_ERROR_FORMAT,
                           "%s (field %zu) must be a number from %g to %g, not '%.*s'", what, index + 1,
                           least, most, (int)fmin((double)strcspn(text, ",\r"), SHOWN), text);
    return AUR_OK;
}

static aur_result read_whole(const reader *r, size_t index, const char *what, double least, double most,
                             int *value) {
    double number = 0.0;
    const aur_result result = read_number(r, index, what, least, most, &number);
    if (result != AUR_OK)
        return result;
    *value = (int)number;
    return number == (double)*value
               ? AUR_OK
               : aur_fail_at(r->error, place_of(r), AUR_ERROR_FORMAT,
                             "%s (field %zu) must be a whole number, not %g", what, index + 1, number);
}

static bool begins(const reader *r, const char *word) {
    const size_t length = strlen(word);
    return strncmp(r->line, word, length) == 0 && r->line[length] == ',';
}

static aur_result read_location(reader *r, aur_weather_view *view) {
    static const char mark[] = "\xEF\xBB\xBF"; /* which some editors put before UTF-8 */
    if (next_line(r) && strncmp(r->line, mark, 3) == 0)
        r->line += 3;
    if (r->number == 0 || !begins(r, "LOCATION"))
        return aur_fail_at(r->error, place_of(r), AUR_ERROR_FORMAT,
                           "an EPW file begins with LOCATION,CITY,... and not with '%.*s'", SHOWN,
                           r->number > 0 ? r->line : "");
    aur_result result = read_number(r, 6, "the latitude", -90.0, 90.0, &view->latitude);
    if (result == AUR_OK)
        result = read_number(r, 7, "the longitude", -180.0, 180.0, &view->longitude);
    if (result == AUR_OK)
        result = read_number(r, 8, "the time zone", -14.0, 14.0, &view->timezone);
    if (result == AUR_OK)
        result = read_number(r, 9, "the elevation", -1000.0, 9999.9, &view->elevation);
    return result;
}

/* Of the first day, -1 where none of the seven is named. */
static int weekday_of(const char *text) {
    static const char *const names[] = {"Sunday",   "Monday", "Tuesday", "Wednesday",
                                        "Thursday", "Friday", "Saturday"};
    for (int i = 0; i < 7; ++i)
        if (text != NULL && strncmp(text, names[i], strlen(names[i])) == 0)
            return i;
    return -1;
}

/* The header's other lines, to the one before the records. */
static aur_result read_periods(reader *r, aur_weather_view *view) {
    while (r->number < HEADER_LINES && next_line(r)) {
        if (!begins(r, "DATA PERIODS"))
            continue;
        int periods = 0, records = 0;
        aur_result result = read_whole(r, 1, "the number of data periods", 1.0, 1.0, &periods);
        if (result == AUR_OK)
            result = read_whole(r, 2, "the number of records an hour", 1.0, 1.0, &records);
        view->first_weekday = weekday_of(field(r, 4));
        return result;
    }
    return aur_fail_at(r->error, place_of(r), AUR_ERROR_FORMAT,
                       "the header of an EPW file ends with a line DATA PERIODS,1,1,...: there is none");
}

/* One of the irradiances: 9999 stands for what was not measured. */
static aur_result read_irradiance(const reader *r, size_t index, const char *what, double *value) {
    const aur_result result = read_number(r, index, what, 0.0, 1e6, value);
    if (result != AUR_OK || *value <= 2000.0)
        return result;
    if (*value < 9999.0)
        return aur_fail_at(r->error, place_of(r), AUR_ERROR_FORMAT,
                           "%s (field %zu) is %g W/m^2, more than there is sun: 2000 is the most, and 9999 "
                           "stands for what is not known",
                           what, index + 1, *value);
    *value = NAN;
    return AUR_OK;
}

static aur_result read_record(const reader *r, aur_weather_hour *hour) {
    *hour = (aur_weather_hour){.line = r->number};
    aur_result result = read_whole(r, 0, "the year", 0.0, 9999.0, &hour->year);
    if (result == AUR_OK)
        result = read_whole(r, 1, "the month", 1.0, 12.0, &hour->month);
    if (result == AUR_OK)
        result = read_whole(r, 2, "the day", 1.0, 31.0, &hour->day);
    if (result == AUR_OK)
        result = read_whole(r, 3, "the hour", 1.0, 24.0, &hour->hour);
    if (result == AUR_OK)
        result = read_number(r, 7, "the dew point", -1e3, 1e3, &hour->dew_point);
    if (result == AUR_OK)
        result = read_irradiance(r, 13, "the global horizontal irradiance", &hour->global_horizontal);
    if (result == AUR_OK)
        result = read_irradiance(r, 14, "the direct normal irradiance", &hour->direct_normal);
    if (result == AUR_OK)
        result = read_irradiance(r, 15, "the diffuse horizontal irradiance", &hour->diffuse_horizontal);
    if (!(hour->dew_point > -90.0 && hour->dew_point < 70.0)) /* 99.9 stands for what is not known */
        hour->dew_point = NAN;
    return result;
}

/* Whether `hour` is the first of the year, or the one after `before`. */
static bool follows(const aur_weather_hour *before, const aur_weather_hour *hour) {
    if (before == NULL)
        return hour->month == 1 && hour->day == 1 && hour->hour == 1;
    if (before->hour < 24)
        return hour->month == before->month && hour->day == before->day && hour->hour == before->hour + 1;
    const int last = (int)aur_days_of_month(2001, (unsigned)before->month);
    if (hour->hour != 1)
        return false;
    if (before->month == 2 && before->day == 28 && hour->month == 2)
        return hour->day == 29;
    return before->day >= last ? hour->month == before->month + 1 && hour->day == 1
                               : hour->month == before->month && hour->day == before->day + 1;
}

static aur_result read_hours(reader *r, aur_weather *weather) {
    size_t count = 0;
    while (next_line(r)) {
        if (*aur_skip_spaces(r->line) == '\0')
            continue;
        aur_weather_hour hour;
        const aur_result result = read_record(r, &hour);
        if (result != AUR_OK)
            return result;
        const aur_weather_hour *const before = count > 0 ? &weather->hours[count - 1] : NULL;
        if (count == LONGEST_YEAR || !follows(before, &hour))
            return aur_fail_at(
                r->error, place_of(r), AUR_ERROR_FORMAT,
                "hours follow each other from 1 January, hour 1, to 31 December, hour 24: day %d-%d, hour "
                "%d does not follow %d-%d, hour %d",
                hour.month, hour.day, hour.hour, before != NULL ? before->month : 12,
                before != NULL ? before->day : 31, before != NULL ? before->hour : 24);
        weather->hours[count++] = hour;
    }
    if (count != LONGEST_YEAR && count != LONGEST_YEAR - 24)
        return aur_fail_at(r->error, place_of(r), AUR_ERROR_FORMAT,
                           "a year has 8760 hours, or 8784; the file ends after %zu", count);
    weather->view.count = count;
    return AUR_OK;
}

static aur_result read_year(const char *path, char *data, size_t size, aur_weather *weather,
                            aur_error *error) {
    reader r = {.path = path, .next = data, .error = error};
    const char *const zero = memchr(data, '\0', size);
    if (zero != NULL) {
        for (const char *at = data; at < zero; ++at)
            r.number += *at == '\n';
        ++r.number;
        return aur_fail_at(error, place_of(&r), AUR_ERROR_FORMAT, "a zero byte: this is no text");
    }
    aur_result result = read_location(&r, &weather->view);
    if (result == AUR_OK)
        result = read_periods(&r, &weather->view);
    return result == AUR_OK ? read_hours(&r, weather) : result;
}

aur_result aur_weather_parse(const char *path, char *data, size_t size, aur_weather **weather,
                             aur_error *error) {
    *weather = NULL;
    aur_weather *const made = calloc(1, sizeof *made);
    if (made != NULL)
        made->file = strdup(path);
    aur_result result = AUR_OK;
    if (made == NULL || made->file == NULL) {
        result = aur_fail_memory(error);
    } else {
        made->view = (aur_weather_view){.size = sizeof made->view, .file = made->file, .hours = made->hours};
        result = read_year(made->file, data, size, made, error);
    }
    if (result != AUR_OK) {
        aur_weather_destroy(made);
        return result;
    }
    *weather = made;
    return AUR_OK;
}

aur_result aur_weather_read(const char *path, aur_weather **weather, aur_error *error) {
    static const size_t LIMIT = (size_t)1 << 26;
    *weather = NULL;
    char *data = NULL;
    size_t size = 0;
    aur_result result = aur_file_read(path, LIMIT, &data, &size, error);
    if (result == AUR_OK)
        result = aur_weather_parse(path, data, size, weather, error);
    free(data);
    return result;
}

void aur_weather_destroy(aur_weather *weather) {
    if (weather == NULL)
        return;
    free(weather->file);
    free(weather);
}

const aur_weather_view *aur_weather_look(const aur_weather *weather) {
    return &weather->view;
}
