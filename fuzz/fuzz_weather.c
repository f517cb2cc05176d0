/* Weather files. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "lighting/daylight/weather.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_weather *weather = NULL;
    char *const copy = malloc(size + 1);
    if (copy == NULL)
        return 0;
    memcpy(copy, data, size);
    copy[size] = '\0';
    const aur_result result = aur_weather_parse("input.epw", copy, size, &weather, &error);
    free(copy);
    if (result != AUR_OK)
        fuzz_require(error.result == AUR_ERROR_FORMAT && error.message[0] != '\0' && weather == NULL,
                     "a failure of the wrong kind, or without a message");
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
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index >= sizeof seeds / sizeof seeds[0])
        return 0;
    const size_t size = strlen(seeds[index]);
    fuzz_require(size <= capacity, "a seed is too large");
    memcpy(data, seeds[index], size);
    return size;
}
