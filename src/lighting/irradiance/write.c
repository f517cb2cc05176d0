/* Results of sensors as files. */
#include <aureole/irradiance.h>
#include <aureole/text.h>

#include <string.h>

#include "core/file.h"
#include "core/options.h"

enum { MOST_COLUMNS = 64, NAME_CAPACITY = 48 };

typedef enum content { POSITION, NORMAL, VALUE, ERROR, HALF_WIDTH, DIRECTIONS } content;

typedef struct column {
    char name[NAME_CAPACITY];
    content content;
    size_t part, channel; /* of a value; the channel is the axis of a position or normal */
} column;

typedef struct columns {
    size_t count;
    column items[MOST_COLUMNS];
} columns;

static void add(columns *all, content what, size_t part, size_t channel, const char *name,
                const char *ending) {
    static const char *const parts[] = {"", "direct_", "sky_", "reflected_"};
    column *const new = &all->items[all->count++];
    *new = (column){.content = what, .part = part, .channel = channel};
    aur_format(new->name, sizeof new->name, "%s%s%s", parts[part], name, ending);
}

static void choose(const aur_irradiance_columns *wanted, columns *all) {
    static const char *const axes[] = {"x", "y", "z"}, *const normals[] = {"nx", "ny", "nz"};
    const char *const channels[] = {"r", "g", "b", wanted->unit != NULL ? wanted->unit : "luminance"};
    const size_t first = wanted->luminance ? 3 : 0, end = wanted->luminance ? 4 : 3;
    all->count = 0;
    for (size_t d = 0; d < 3; ++d)
        add(all, POSITION, 0, d, axes[d], "");
    for (size_t d = 0; d < 3 && wanted->normals; ++d)
        add(all, NORMAL, 0, d, normals[d], "");
    for (size_t part = 0; part < (wanted->parts ? AUR_IRRADIANCE_PARTS : 1); ++part) {
        for (size_t c = first; c < end; ++c)
            add(all, VALUE, part, c, channels[c], "");
        for (size_t c = first; c < end && !wanted->no_errors; ++c)
            add(all, ERROR, part, c, channels[c], "_error");
        for (size_t c = first; c < end && wanted->intervals && part == 0; ++c)
            add(all, HALF_WIDTH, part, c, channels[c], "_half_width");
    }
    if (wanted->directions)
        add(all, DIRECTIONS, 0, 0, "directions", "");
}

static double cell(const column *wanted, const aur_sensors_view *sensors, size_t i,
                   const aur_irradiance *result) {
    switch (wanted->content) {
    case POSITION:
        return sensors->positions[3 * i + wanted->channel];
    case NORMAL:
        return sensors->normals[3 * i + wanted->channel];
    case VALUE:
        return result->value[wanted->part][wanted->channel];
    case ERROR:
        return result->error[wanted->part][wanted->channel];
    case HALF_WIDTH:
        return result->half_width[wanted->channel];
    case DIRECTIONS:
        break;
    }
    return (double)result->directions;
}

static void write_csv(const columns *all, const aur_sensors_view *sensors, const aur_irradiance *results,
                      FILE *stream) {
    for (size_t k = 0; k < all->count; ++k)
        fprintf(stream, "%s%s", k > 0 ? "," : "", all->items[k].name);
    fputc('\n', stream);
    for (size_t i = 0; i < sensors->count; ++i)
        for (size_t k = 0; k < all->count; ++k) {
            const column *const item = &all->items[k];
            aur_print(stream, item->content == ERROR || item->content == HALF_WIDTH ? "%.6g%c" : "%.17g%c",
                      cell(item, sensors, i, &results[i]), k + 1 < all->count ? ',' : '\n');
        }
}

aur_result aur_irradiance_write(const char *path, const char *format, const aur_irradiance_columns *wanted,
                                const aur_sensors_view *sensors, size_t result_size,
                                const aur_irradiance *results, aur_error *error) {
    static const struct {
        const char *name;
        void (*write)(const columns *all, const aur_sensors_view *sensors, const aur_irradiance *results,
                      FILE *stream);
    } formats[] = {{"csv", write_csv}};
    aur_irradiance_columns own = {.size = sizeof own};
    const aur_result result =
        aur_options_read(wanted, sizeof own, sizeof own, &own, "aur_irradiance_columns", error);
    if (result != AUR_OK)
        return result;
    if (result_size != sizeof *results)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the results have %zu bytes each, not %zu",
                        sizeof *results, result_size);
    columns all;
    choose(&own, &all);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; ++i) {
        if (strcmp(format, formats[i].name) != 0)
            continue;
        aur_file_writer writer;
        const aur_result opened = aur_file_open(path, &writer, error);
        if (opened != AUR_OK)
            return opened;
        formats[i].write(&all, sensors, results, writer.stream);
        return aur_file_commit(&writer, error);
    }
    return aur_fail(error, AUR_ERROR_NAME, "no format '%s': csv is known", format);
}
