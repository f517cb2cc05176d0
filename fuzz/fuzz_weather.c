/* Weather files. If the text ends with three dots, or four in a leap year, the harness appends the rest of
 * the year, because inputs are shorter than a year. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "lighting/daylight/hours.h"

static bool ends_with(const uint8_t *data, size_t size, const char *end) {
    const size_t length = strlen(end);
    return size >= length && memcmp(data + size - length, end, length) == 0;
}

enum { LEAP_YEAR = 8784, LINE = 64 };

typedef struct year {
    size_t size;
    size_t starts[LEAP_YEAR]; /* where each hour's line begins */
    char text[LEAP_YEAR * LINE];
} year;

static void write_year(bool leap, year *written) {
    static const unsigned days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    size_t hour = 0;
    for (unsigned month = 1; month <= 12; ++month)
        for (unsigned day = 1; day <= days[month - 1] + (leap && month == 2); ++day)
            for (unsigned h = 1; h <= 24; ++h) {
                written->starts[hour++] = written->size;
                written->size +=
                    (size_t)snprintf(written->text + written->size, LINE,
                                     "2001,%u,%u,%u,60,x,10,6,75,1e5,9999,9999,300,0,0,0,0\n", month, day, h);
            }
}

/* The rest of a year after the hours in the text, each of which is a line that begins with a digit. */
static size_t rest_of_year(bool leap, size_t text_size, const uint8_t *text, const char **rest) {
    static year years[2];
    year *const whole = &years[leap];
    if (whole->size == 0)
        write_year(leap, whole);
    size_t hour = 0;
    for (size_t i = 1; i < text_size; ++i)
        hour += text[i - 1] == '\n' && text[i] >= '0' && text[i] <= '9';
    const size_t start = hour < LEAP_YEAR - 24 ? whole->starts[hour] : whole->size;
    *rest = whole->text + start;
    return whole->size - start;
}

static aur_result read_text(size_t size, const uint8_t *data, aur_weather **weather, aur_error *error) {
    char path[64];
    snprintf(path, sizeof path, "fuzz-weather-%ld.epw", (long)getpid());
    fuzz_write_file(path, data, size);
    const aur_result result = aur_weather_read(path, weather, error);
    unlink(path);
    return result;
}

static aur_result read_year(bool leap, size_t size, const uint8_t *data, aur_weather **weather,
                            aur_error *error) {
    const char *rest;
    const size_t rest_size = rest_of_year(leap, size, data, &rest);
    char *const text = malloc(size + rest_size + 1);
    fuzz_require(text != NULL, "out of memory");
    memcpy(text, data, size);
    memcpy(text + size, rest, rest_size);
    text[size + rest_size] = '\0';
    const aur_result result = aur_weather_parse("input.epw", text, size + rest_size, weather, error);
    free(text);
    return result;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_weather *weather = NULL;
    const size_t dots = ends_with(data, size, "....\n") ? 5 : ends_with(data, size, "...\n") ? 4 : 0;
    const aur_result result = dots > 0 ? read_year(dots == 5, size - dots, data, &weather, &error)
                                       : read_text(size, data, &weather, &error);
    if (result != AUR_OK)
        fuzz_require(error.result == AUR_ERROR_FORMAT && error.message[0] != '\0' && weather == NULL,
                     "a failure of the wrong kind, or without a message");
    else
        fuzz_require(aur_weather_get_view(weather)->count % 24 == 0 &&
                         aur_weather_get_view(weather)->count <= LEAP_YEAR,
                     "a year of other hours");
    aur_weather_destroy(weather);
    return 0;
}

#define HEADER "LOCATION,Nowhere,-,-,x,0,48.0,11.0,1.0,100.0\nCOMMENTS 1,x\n"
#define PERIODS "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n"

static const char *const seeds[] = {
    HEADER PERIODS "2001,1,1,1,60,x,10.0,6.0,75,1e5,9999,9999,300,0,0,0,0\n"
                   "2001,1,1,2,60,x,10.0,99.9,75,1e5,9999,9999,300,9999,-1,2001,0\r\n",
    HEADER "DATA PERIODS,1,4,Data,Sunday, 1/ 1,12/31\n",
    HEADER,
    HEADER PERIODS "2001,1,1,1,60,x,10.0,6.0,75,1e5,9999,9999,300,0,0,0,0\n...\n",
    "\xEF\xBB\xBF" HEADER PERIODS "....\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return fuzz_text_seed(sizeof seeds / sizeof seeds[0], seeds, index, capacity, data);
}
