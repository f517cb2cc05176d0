/* Weather files from memory. */
#pragma once

#include <aureole-lighting/daylight.h>

/* As aur_weather_read, from `size` bytes that are changed and end with a zero byte that is not counted. */
aur_result aur_weather_parse(const char *path, char *data, size_t size, aur_weather **weather,
                             aur_error *error);
