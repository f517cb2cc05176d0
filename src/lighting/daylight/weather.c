/* Weather files: EnergyPlus's EPW, eight header lines and then one record per hour; Radiance's .wea; and TMY3
 * as CSV. The first line selects the format. */
#include "lighting/daylight/hours.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/file.h"
#include "points/base/text.h"
#include "render/scene/lights/sun_position.h"

enum { LONGEST_YEAR = 8784, DAY = 24, HEADER_LINES = 64, SHOWN = 40, FIELDS = 48 };

struct aur_weather {
    aur_weather_view view;
    char *file;
    aur_weather_hour hours[LONGEST_YEAR];
};

/* Reader state: the fields of the current line, each terminated by a zero byte. */
typedef struct reader reader;
struct reader {
    const char *path;
    char *next; /* the next line, or NULL */
    size_t number, field_count;
    char *fields[FIELDS]; /* further ones are ignored */
    bool blanks;          /* blanks separate fields instead of commas */
    aur_result (*record)(const reader *r, aur_weather_hour *hour);
    aur_weather_view *view;
    aur_error *error;
};

/* Strips quotes and blanks (RFC 4180) from the field that begins at `at`, and returns the text behind its
 * comma, or NULL. */
static char *cut_field(char *at, char **field) {
    while (*at == ' ' || *at == '\t')
        ++at;
    const bool quoted = *at == '"';
    char *to = *field = at += quoted;
    while (*at != '\0' && (quoted ? *at != '"' || at[1] == '"' : *at != ',')) {
        at += quoted && *at == '"';
        *to++ = *at++;
    }
    at += strcspn(at, ",");
    char *const next = *at == ',' ? at + 1 : NULL;
    while (to > *field && strchr(" \t\r", to[-1]) != NULL)
        --to;
    *to = '\0';
    return next;
}

static bool next_line(reader *r) {
    if (r->next == NULL || *r->next == '\0')
        return false;
    char *at = r->next;
    char *const end = strchr(at, '\n');
    r->next = end != NULL ? end + 1 : NULL;
    if (end != NULL)
        *end = '\0';
    ++r->number;
    static const char mark[] = "\xEF\xBB\xBF"; /* byte order mark of UTF-8 */
    if (r->number == 1 && strncmp(at, mark, 3) == 0)
        at += 3;
    /* Radiance's .wea begins with `place`. */
    r->blanks = r->blanks || (r->number == 1 && strncmp(at, "place", 5) == 0);
    r->field_count = 0;
    for (char *rest = at, *piece; r->blanks && r->field_count < FIELDS; r->fields[r->field_count++] = piece)
        if ((piece = strtok_r(rest, " \t\r", &rest)) == NULL)
            return true;
    for (; at != NULL && r->field_count < FIELDS; ++r->field_count)
        at = cut_field(at, &r->fields[r->field_count]);
    return true;
}

static aur_location location_of(const reader *r) {
    return (aur_location){.file = r->path, .line = r->number};
}

/* Field `index`, from 0 on; NULL beyond the last. */
static const char *field(const reader *r, size_t index) {
    return index < r->field_count ? r->fields[index] : NULL;
}

static aur_result read_number(const reader *r, size_t index, const char *what, double least, double most,
                              double *value) {
    const char *const text = field(r, index);
    if (text == NULL)
        return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                           "the line ends before %s, its field %zu", what, index + 1);
    const char *const end = aur_read_double(*text == '+' ? text + 1 : text, AUR_NUMBER_FINITE, value);
    if (end == NULL || *end != '\0' || !(*value >= least && *value <= most))
        return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                           "%s (field %zu) must be a number from %g to %g, not '%.*s'", what, index + 1,
                           least, most, SHOWN, text);
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
               : aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                             "%s (field %zu) must be a whole number, not %g", what, index + 1, number);
}

static bool begins(const reader *r, const char *word) {
    return r->field_count > 1 && strcmp(r->fields[0], word) == 0;
}

static aur_result read_location(reader *r, aur_weather_view *view) {
    if (!begins(r, "LOCATION"))
        return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                           "an EPW file begins with LOCATION,CITY,... and not with '%.*s'", SHOWN,
                           r->field_count > 0 ? r->fields[0] : "");
    aur_result result = read_number(r, 6, "the latitude", -90.0, 90.0, &view->latitude);
    if (result == AUR_OK)
        result = read_number(r, 7, "the longitude", -180.0, 180.0, &view->longitude);
    if (result == AUR_OK)
        result = read_number(r, 8, "the time zone", -14.0, 14.0, &view->timezone);
    if (result == AUR_OK)
        result = read_number(r, 9, "the elevation", -1000.0, 9999.9, &view->elevation);
    return result;
}

/* The weekday of the first day; -1 if none of the seven names matches. */
static int weekday_of(const char *text) {
    static const char *const names[] = {"Sunday",   "Monday", "Tuesday", "Wednesday",
                                        "Thursday", "Friday", "Saturday"};
    for (int i = 0; i < 7; ++i)
        if (text != NULL && strncmp(text, names[i], strlen(names[i])) == 0)
            return i;
    return -1;
}

/* The other header lines, up to the one before the records. */
static aur_result read_periods(reader *r, aur_weather_view *view) {
    while (r->number < HEADER_LINES && next_line(r)) {
        if (!begins(r, "DATA PERIODS"))
            continue;
        int periods = 0;
        aur_result result = read_whole(r, 1, "the number of data periods", 1.0, 1.0, &periods);
        if (result == AUR_OK)
            result = read_whole(r, 2, "the number of records an hour", 1.0, 60.0, &view->records);
        if (result == AUR_OK && 60 % view->records != 0)
            result =
                aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                            "the number of records an hour (field 3) must divide 60, not %d", view->records);
        view->first_weekday = weekday_of(field(r, 4));
        return result;
    }
    return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                       "the header of an EPW file ends with a line DATA PERIODS,1,1,...: there is none");
}

static void note(const reader *r, aur_weather_note *what) {
    if (what->count++ == 0)
        what->line = r->number;
}

/* A number that may be missing: NaN if the field is empty. */
static aur_result read_optional(const reader *r, size_t index, const char *what, double least, double most,
                                double *value) {
    const char *const text = field(r, index);
    if (text == NULL || *text != '\0')
        return read_number(r, index, what, least, most, value);
    note(r, &r->view->empty);
    *value = NAN;
    return AUR_OK;
}

/* An irradiance: 9999 means missing; instruments may report small negative values at night. */
static aur_result read_irradiance(const reader *r, size_t index, const char *what, double *value) {
    static const double NIGHT = -20.0;
    const aur_result result = read_optional(r, index, what, -1e6, 1e6, value);
    if (result != AUR_OK || (*value >= 0.0 && *value <= 2000.0) || isnan(*value))
        return result;
    if (*value < 0.0 && *value >= NIGHT) {
        note(r, &r->view->negative);
        *value = 0.0;
        return AUR_OK;
    }
    if (*value < 9999.0)
        return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                           "%s (field %zu) must be from 0 to 2000 W/m^2, or 9999 if it is missing, not %g",
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
        result = read_whole(r, 3, "the hour", 0.0, 24.0, &hour->hour);
    if (result == AUR_OK)
        result = read_optional(r, 7, "the dew point", -1e3, 1e3, &hour->dew_point);
    if (result == AUR_OK)
        result = read_irradiance(r, 13, "the global horizontal irradiance", &hour->global_horizontal);
    if (result == AUR_OK)
        result = read_irradiance(r, 14, "the direct normal irradiance", &hour->direct_normal);
    if (result == AUR_OK)
        result = read_irradiance(r, 15, "the diffuse horizontal irradiance", &hour->diffuse_horizontal);
    if (!(hour->dew_point > -90.0 && hour->dew_point < 70.0)) /* 99.9 means missing */
        hour->dew_point = NAN;
    return result;
}

/* Whether `hour` is the first of a day, or follows `before`; the year may begin with any day. */
static bool follows(const aur_weather_hour *before, const aur_weather_hour *hour) {
    if (before == NULL)
        return hour->hour == 1 && hour->day <= (int)aur_days_of_month(2004, (unsigned)hour->month);
    if (before->hour < DAY)
        return hour->month == before->month && hour->day == before->day && hour->hour == before->hour + 1;
    const int last = (int)aur_days_of_month(2001, (unsigned)before->month);
    if (hour->hour != 1)
        return false;
    if (before->month == 2 && before->day == 28 && hour->month == 2)
        return hour->day == 29;
    return before->day >= last ? hour->month == before->month % 12 + 1 && hour->day == 1
                               : hour->month == before->month && hour->day == before->day + 1;
}

static aur_result refuse_hour(const reader *r, const aur_weather_hour *before, const aur_weather_hour *hour) {
    if (before == NULL)
        return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                           "the first record must be hour 1 (or 0) of a day, not hour %d of %d-%d",
                           hour->hour, hour->month, hour->day);
    const bool again = hour->month == before->month && hour->day == before->day && hour->hour == before->hour;
    return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                       "hours must follow each other%s: %d-%d, hour %d does not follow %d-%d, hour %d",
                       again ? ", with as many records as the line DATA PERIODS gives (field 3)" : "",
                       hour->month, hour->day, hour->hour, before->month, before->day, before->hour);
}

/* Reads the next hour: the mean of its records. *ended: end of file. */
static aur_result read_hour(reader *r, aur_weather_hour *hour, bool *ended) {
    int records = 0;
    while (records < r->view->records && next_line(r)) {
        if (r->field_count == 0 || (r->field_count == 1 && r->fields[0][0] == '\0'))
            continue;
        aur_weather_hour record;
        const aur_result result = r->record(r, &record);
        if (result != AUR_OK)
            return result;
        if (records++ == 0) {
            *hour = record;
            continue;
        }
        if (record.month != hour->month || record.day != hour->day || record.hour != hour->hour)
            return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                               "%d-%d, hour %d has %d records, and the line DATA PERIODS gives %d (field 3)",
                               hour->month, hour->day, hour->hour, records - 1, r->view->records);
        const double part = 1.0 / (double)records;
        hour->direct_normal += part * (record.direct_normal - hour->direct_normal);
        hour->diffuse_horizontal += part * (record.diffuse_horizontal - hour->diffuse_horizontal);
        hour->global_horizontal += part * (record.global_horizontal - hour->global_horizontal);
        hour->dew_point += part * (record.dew_point - hour->dew_point);
    }
    *ended = records == 0;
    return records == 0 || records == r->view->records
               ? AUR_OK
               : aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                             "the file ends after %d records of an hour, and the line DATA PERIODS gives %d",
                             records, r->view->records);
}

static aur_result read_hours(reader *r, aur_weather *weather) {
    size_t count = 0;
    for (;;) {
        aur_weather_hour hour;
        bool ended = false;
        const aur_result result = read_hour(r, &hour, &ended);
        if (result != AUR_OK)
            return result;
        if (ended)
            break;
        weather->view.from_zero |= count == 0 && hour.hour == 0;
        hour.hour += weather->view.from_zero;
        const aur_weather_hour *const before = count > 0 ? &weather->hours[count - 1] : NULL;
        if (count == LONGEST_YEAR)
            return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                               "more than a year: 8784 hours at most");
        if (!follows(before, &hour))
            return refuse_hour(r, before, &hour);
        weather->hours[count++] = hour;
    }
    if (count == 0 || count % DAY != 0)
        return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                           "a file must have whole days of 24 hours; this one ends after %zu hours", count);
    weather->view.count = count;
    return AUR_OK;
}

/* --- other files */

/* Changes the month, day and hour just read to a year that has such days. */
static void set_year(aur_weather_hour *hour) {
    hour->year = hour->month == 2 && hour->day == 29 ? 2004 : 2001;
}

/* month day hour direct-normal diffuse-horizontal; the hour is the middle of the interval. */
static aur_result read_wea_record(const reader *r, aur_weather_hour *hour) {
    double middle = 0.0;
    *hour = (aur_weather_hour){.line = r->number, .dew_point = NAN, .global_horizontal = NAN};
    aur_result result = read_whole(r, 0, "the month", 1.0, 12.0, &hour->month);
    if (result == AUR_OK)
        result = read_whole(r, 1, "the day", 1.0, 31.0, &hour->day);
    if (result == AUR_OK)
        result = read_number(r, 2, "the hour", 0.0, 23.999, &middle);
    if (result == AUR_OK)
        result = read_irradiance(r, 3, "the direct normal irradiance", &hour->direct_normal);
    if (result == AUR_OK)
        result = read_irradiance(r, 4, "the diffuse horizontal irradiance", &hour->diffuse_horizontal);
    hour->hour = (int)middle + 1;
    set_year(hour);
    return result;
}

/* The six header lines of a .wea; its longitude and time zone are in degrees west. */
static aur_result read_wea_header(reader *r, aur_weather_view *view) {
    double west = 0.0, zone = 0.0, units = 0.0;
    const struct {
        const char *name;
        double least, most, *value;
    } rows[] = {{"latitude", -90.0, 90.0, &view->latitude},
                {"longitude", -180.0, 180.0, &west},
                {"time_zone", -210.0, 210.0, &zone},
                {"site_elevation", -1000.0, 9999.9, &view->elevation},
                {"weather_data_file_units", 1.0, 1.0, &units}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        if (!next_line(r) || !begins(r, rows[i].name))
            return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                               "a .wea file has a line '%s NUMBER' here", rows[i].name);
        const aur_result result = read_number(r, 1, rows[i].name, rows[i].least, rows[i].most, rows[i].value);
        if (result != AUR_OK)
            return result;
    }
    view->longitude = -west;
    view->timezone = -zone / 15.0;
    view->first_weekday = -1;
    view->records = 1;
    return AUR_OK;
}

/* "MM/DD/YYYY","HH:MM", then the fields of Wilcox and Marion (2008); the hour ends at HH:MM. */
static aur_result read_tmy3_record(const reader *r, aur_weather_hour *hour) {
    *hour = (aur_weather_hour){.line = r->number};
    int parts[4] = {0};
    const char *const texts[2] = {field(r, 0), field(r, 1)};
    const bool read = texts[1] != NULL && strlen(texts[0]) == 10 && strlen(texts[1]) == 5 &&
                      sscanf(texts[0], "%2d/%2d/%4d", &parts[0], &parts[1], &parts[2]) == 3 &&
                      sscanf(texts[1], "%2d:00", &parts[3]) == 1;
    if (!read || parts[0] < 1 || parts[0] > 12 || parts[1] < 1 || parts[1] > 31 || parts[3] < 0 ||
        parts[3] > DAY)
        return aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                           "a record must begin with a date and an hour, MM/DD/YYYY,HH:00, not '%.*s'", SHOWN,
                           texts[0] != NULL ? texts[0] : "");
    hour->month = parts[0];
    hour->day = parts[1];
    hour->year = parts[2];
    hour->hour = parts[3];
    aur_result result = read_irradiance(r, 4, "the global horizontal irradiance", &hour->global_horizontal);
    if (result == AUR_OK)
        result = read_irradiance(r, 7, "the direct normal irradiance", &hour->direct_normal);
    if (result == AUR_OK)
        result = read_irradiance(r, 10, "the diffuse horizontal irradiance", &hour->diffuse_horizontal);
    if (result == AUR_OK)
        result = read_optional(r, 34, "the dew point", -1e5, 1e5, &hour->dew_point);
    if (!(hour->dew_point > -90.0 && hour->dew_point < 70.0))
        hour->dew_point = NAN;
    return result;
}

/* code,name,state,time zone,latitude,longitude,elevation, then a line of column names. */
static aur_result read_tmy3_header(reader *r, aur_weather_view *view) {
    aur_result result = read_number(r, 3, "the time zone", -14.0, 14.0, &view->timezone);
    if (result == AUR_OK)
        result = read_number(r, 4, "the latitude", -90.0, 90.0, &view->latitude);
    if (result == AUR_OK)
        result = read_number(r, 5, "the longitude", -180.0, 180.0, &view->longitude);
    if (result == AUR_OK)
        result = read_number(r, 6, "the elevation", -1000.0, 9999.9, &view->elevation);
    if (result == AUR_OK && (!next_line(r) || strncmp(r->fields[0], "Date", 4) != 0))
        result = aur_fail_at(r->error, location_of(r), AUR_ERROR_FORMAT,
                             "the second line of a TMY3 file begins with Date (MM/DD/YYYY),Time (HH:MM)");
    view->first_weekday = -1;
    view->records = 1;
    return result;
}

/* Detects the format by the first line: that of a TMY3 has seven fields and begins with a station number. */
static aur_result read_header(reader *r, aur_weather_view *view) {
    double station = 0.0;
    const bool any = next_line(r);
    const char *const code = any ? field(r, 0) : NULL;
    const char *const after =
        code != NULL && r->field_count == 7 ? aur_read_double(code, AUR_NUMBER_FINITE, &station) : NULL;
    if (r->blanks) {
        r->record = read_wea_record;
        return read_wea_header(r, view);
    }
    if (after != NULL && *after == '\0') {
        r->record = read_tmy3_record;
        return read_tmy3_header(r, view);
    }
    r->record = read_record;
    const aur_result result = read_location(r, view);
    return result == AUR_OK ? read_periods(r, view) : result;
}

static aur_result read_year(const char *path, char *data, size_t size, aur_weather *weather,
                            aur_error *error) {
    reader r = {.path = path, .next = data, .view = &weather->view, .error = error};
    const char *const zero = memchr(data, '\0', size);
    if (zero != NULL) {
        for (const char *at = data; at < zero; ++at)
            r.number += *at == '\n';
        ++r.number;
        return aur_fail_at(error, location_of(&r), AUR_ERROR_FORMAT, "a zero byte: not a text file");
    }
    const aur_result result = read_header(&r, &weather->view);
    return result == AUR_OK ? read_hours(&r, weather) : result;
}

aur_result aur_weather_parse(const char *path, char *data, size_t size, aur_weather **weather,
                             aur_error *error) {
    *weather = NULL;
    aur_weather *const parsed = calloc(1, sizeof *parsed);
    if (parsed != NULL)
        parsed->file = strdup(path);
    aur_result result = AUR_OK;
    if (parsed == NULL || parsed->file == NULL) {
        result = aur_fail_memory(error);
    } else {
        parsed->view =
            (aur_weather_view){.size = sizeof parsed->view, .file = parsed->file, .hours = parsed->hours};
        result = read_year(parsed->file, data, size, parsed, error);
    }
    if (result != AUR_OK) {
        aur_weather_destroy(parsed);
        return result;
    }
    *weather = parsed;
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

const aur_weather_view *aur_weather_get_view(const aur_weather *weather) {
    return &weather->view;
}
