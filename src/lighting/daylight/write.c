/* Writes the measures of a year to files. */
#include <aureole-lighting/daylight.h>
#include <aureole/text.h>
#include <stdlib.h>

#include "lighting/irradiance/table.h"
#include "points/base/error.h"

enum { AXES = 3, WIDTH = AXES + 2 * AUR_DAYLIGHT_MEASURES };

aur_result aur_daylight_write(const char *path, const char *format, const aur_sensors_view *sensors,
                              size_t result_size, const aur_daylight *results, aur_error *error) {
    static const char *const axes[] = {"x", "y", "z"};
    static const char *const names[AUR_DAYLIGHT_MEASURES] = {[AUR_DAYLIGHT_FACTOR] = "daylight_factor",
                                                             [AUR_DAYLIGHT_AUTONOMY] = "autonomy",
                                                             [AUR_DAYLIGHT_CONTINUOUS] =
                                                                 "continuous_autonomy",
                                                             [AUR_DAYLIGHT_USEFUL] = "useful",
                                                             [AUR_DAYLIGHT_BELOW] = "below_useful",
                                                             [AUR_DAYLIGHT_ABOVE] = "above_useful",
                                                             [AUR_DAYLIGHT_SUN_HOURS] = "sun_hours",
                                                             [AUR_DAYLIGHT_ANNUAL] = "annual_lux_hours"};
    if (result_size != sizeof *results)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the results have %zu bytes each, not %zu",
                        sizeof *results, result_size);
    aur_sensor_column columns[WIDTH] = {{.rough = false}};
    for (size_t d = 0; d < AXES; ++d)
        aur_format(columns[d].name, sizeof columns[d].name, "%s", axes[d]);
    for (size_t m = 0; m < AUR_DAYLIGHT_MEASURES; ++m) {
        aur_sensor_column *const column = &columns[AXES + 2 * m];
        aur_format(column[0].name, sizeof column[0].name, "%s", names[m]);
        aur_format(column[1].name, sizeof column[1].name, "%s_error", names[m]);
        column[1].rough = true;
    }
    aur_sensor_table table = {.sensors = sensors,
                              .width = WIDTH,
                              .columns = columns,
                              .color = AXES + 2 * AUR_DAYLIGHT_AUTONOMY,
                              .colors = 1,
                              .values = malloc(sensors->count * WIDTH * sizeof *table.values)};
    if (table.values == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < sensors->count; ++i) {
        double *const row = table.values + i * WIDTH;
        for (size_t d = 0; d < AXES; ++d)
            row[d] = sensors->positions[3 * i + d];
        for (size_t m = 0; m < AUR_DAYLIGHT_MEASURES; ++m) {
            row[AXES + 2 * m] = results[i].value[m];
            row[AXES + 2 * m + 1] = results[i].error[m];
        }
    }
    const aur_result result = aur_sensor_table_write(path, format, &table, error);
    free(table.values);
    return result;
}
