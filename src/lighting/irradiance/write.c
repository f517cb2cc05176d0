/* Writes sensors' results to files. */
#include <aureole-lighting/irradiance.h>
#include <aureole/text.h>
#include <stdlib.h>

#include "lighting/irradiance/table.h"
#include "points/base/error.h"

typedef enum content { POSITION, NORMAL, VALUE, ERROR, HALF_WIDTH, DIRECTIONS } content;

typedef struct column {
    content content;
    size_t part, channel; /* component of a value; the channel is the axis of a position or normal */
} column;

typedef struct columns {
    size_t count;
    column items[AUR_SENSOR_COLUMNS];
    aur_sensor_column names[AUR_SENSOR_COLUMNS];
} columns;

static void add(columns *all, content what, size_t part, size_t channel, const char *name,
                const char *ending) {
    static const char *const parts[] = {"", "direct_", "sky_", "reflected_", "sun_"};
    aur_sensor_column *const new = &all->names[all->count];
    all->items[all->count++] = (column){.content = what, .part = part, .channel = channel};
    new->rough = what == ERROR || what == HALF_WIDTH;
    aur_format(new->name, sizeof new->name, "%s%s%s", parts[part], name, ending);
}

static void choose(const aur_irradiance_columns *requested, columns *all) {
    static const char *const axes[] = {"x", "y", "z"}, *const normals[] = {"nx", "ny", "nz"};
    const char *const channels[] = {"r", "g", "b", requested->unit != NULL ? requested->unit : "luminance"};
    const size_t first = requested->luminance ? 3 : 0, end = requested->luminance ? 4 : 3;
    all->count = 0;
    for (size_t d = 0; d < 3; ++d)
        add(all, POSITION, 0, d, axes[d], "");
    for (size_t d = 0; d < 3 && requested->normals; ++d)
        add(all, NORMAL, 0, d, normals[d], "");
    for (size_t part = 0; part < (requested->parts ? AUR_IRRADIANCE_PARTS : 1); ++part) {
        for (size_t c = first; c < end; ++c)
            add(all, VALUE, part, c, channels[c], "");
        for (size_t c = first; c < end && !requested->no_errors; ++c)
            add(all, ERROR, part, c, channels[c], "_error");
        for (size_t c = first; c < end && requested->intervals && part == 0; ++c)
            add(all, HALF_WIDTH, part, c, channels[c], "_half_width");
    }
    if (requested->directions)
        add(all, DIRECTIONS, 0, 0, "directions", "");
}

static double cell(const column *requested, const aur_sensors_view *sensors, size_t i,
                   const aur_irradiance *result) {
    switch (requested->content) {
    case POSITION:
        return sensors->positions[3 * i + requested->channel];
    case NORMAL:
        return sensors->normals[3 * i + requested->channel];
    case VALUE:
        return result->value[requested->part][requested->channel];
    case ERROR:
        return result->error[requested->part][requested->channel];
    case HALF_WIDTH:
        return result->half_width[requested->channel];
    case DIRECTIONS:
        break;
    }
    return (double)result->directions;
}

aur_result aur_irradiance_write(const char *path, const char *format, const aur_irradiance_columns *requested,
                                const aur_sensors_view *sensors, size_t result_size,
                                const aur_irradiance *results, aur_error *error) {
    aur_irradiance_columns chosen = {.size = sizeof chosen};
    aur_result result = aur_options_read(requested, sizeof chosen, &chosen, "aur_irradiance_columns", error);
    if (result != AUR_OK)
        return result;
    if (result_size != sizeof *results)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the results have %zu bytes each, not %zu",
                        sizeof *results, result_size);
    columns all;
    choose(&chosen, &all);
    aur_sensor_table table = {.sensors = sensors,
                              .width = all.count,
                              .columns = all.names,
                              .color = chosen.normals ? 6 : 3,
                              .colors = chosen.luminance ? 1 : 3,
                              .values = malloc(sensors->count * all.count * sizeof *table.values)};
    if (table.values == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < sensors->count; ++i)
        for (size_t k = 0; k < all.count; ++k)
            table.values[i * all.count + k] = cell(&all.items[k], sensors, i, &results[i]);
    result = aur_sensor_table_write(path, format, &table, error);
    free(table.values);
    return result;
}
