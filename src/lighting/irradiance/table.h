/* Writes a table with a row per sensor to a file. */
#pragma once

#include <aureole-lighting/irradiance.h>

enum { AUR_SENSOR_COLUMNS = 64, AUR_SENSOR_NAME = 48 };

typedef struct aur_sensor_column {
    char name[AUR_SENSOR_NAME];
    bool rough; /* write six significant digits in CSV */
} aur_sensor_column;

typedef struct aur_sensor_table {
    const aur_sensors_view *sensors;
    size_t width;
    const aur_sensor_column *columns; /* the first three are x, y, z */
    size_t color, colors; /* the columns shown as colours: the first one, and their number: 3 (r, g, b) or 1
                           */
    double *values;       /* sensors->count * width */
} aur_sensor_table;

/* As described at aur_irradiance_write. */
aur_result aur_sensor_table_write(const char *path, const char *format, const aur_sensor_table *table,
                                  aur_error *error);
