/* Irradiance by groups of light sources, as rcontrib -V+ -m. */
#include <aureole/text.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/lighting/irradiance.h"
#include "program/report/report.h"

static aur_result add_modifier(const char *text, void *field, aur_error *error) {
    cli_contributions *const given = field; /* the first member is its count */
    if (text[0] == '\0' || given->count == CLI_MODIFIER_LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "-m: 1 to %d names of light sources' materials expected",
                        CLI_MODIFIER_LIMIT);
    given->names[given->count++] = text;
    return AUR_OK;
}

const cli_option cli_contributions_options[] = {
    {CLI_TEXT(
         cli_contributions, count, "modifier", "NAME", NULL,
         "report the light of the sources with this material of Radiance's files separately, as rcontrib "
         "-V+; repeatable"),
     .letter = 'm', .parse = add_modifier},
    {.key = {0}}};

bool cli_contributions_check(const cli_call *call, const cli_contributions *given, const char *format) {
    static const char *const without[] = {"weather",   "sky",    "lamp",    "coefficients", "parts",
                                          "intervals", "counts", "normals", "no-errors",    "plot"};
    for (size_t i = 0; i < sizeof without / sizeof without[0] && given->count > 0; ++i)
        if (cli_given(call, without[i]) != NULL) {
            cli_bad_usage("irradiance: --%s cannot be used with --modifier", without[i]);
            return false;
        }
    if (given->count == 0 || (strcmp(format, "npy") != 0 && strcmp(format, "ply") != 0))
        return true;
    cli_bad_usage("irradiance: --modifier writes csv, json or rtrace, not %s", format);
    return false;
}

typedef struct work {
    const cli_contributions *given;
    const aur_sensors_view *sensors;
    const aur_irradiance *results; /* [names][sensors] */
    bool lux;
} work;

/* Three numbers per light source and line, as rcontrib prints them. */
static void write_rtrace(const work *w, FILE *stream) {
    for (size_t i = 0; i < w->sensors->count; ++i) {
        for (size_t m = 0; m < w->given->count; ++m)
            for (size_t c = 0; c < 3; ++c)
                aur_print(stream, "%.6e\t",
                          w->results[m * w->sensors->count + i].value[AUR_IRRADIANCE_TOTAL][w->lux ? 3 : c]);
        fputc('\n', stream);
    }
}

static report_table *make_table(const work *w) {
    enum { DIGITS = 9 };
    static const char *const axes[] = {"x", "y", "z"}, *const letters[] = {"r", "g", "b", "lux"};
    report_table *const table = report_create(3, axes);
    const size_t first = w->lux ? 3 : 0, last = w->lux ? 4 : 3;
    for (size_t m = 0; m < w->given->count; ++m)
        for (size_t k = 0; k < 2; ++k)
            for (size_t c = first; c < last; ++c) {
                char name[256];
                aur_format(name, sizeof name, "%s_%s%s", w->given->names[m], letters[c],
                           k > 0 ? "_error" : "");
                report_column(table, name);
            }
    for (size_t i = 0; i < w->sensors->count; ++i) {
        for (size_t d = 0; d < 3; ++d)
            report_number(table, w->sensors->positions[3 * i + d], DIGITS);
        for (size_t m = 0; m < w->given->count; ++m) {
            const aur_irradiance *const found = &w->results[m * w->sensors->count + i];
            for (size_t k = 0; k < 2; ++k)
                for (size_t c = first; c < last; ++c)
                    report_number(table, (k == 0 ? found->value : found->error)[AUR_IRRADIANCE_TOTAL][c],
                                  DIGITS);
        }
    }
    return table;
}

static aur_result write_file(const work *w, const char *output, const char *format, aur_error *error) {
    char *text = NULL;
    size_t size = 0;
    aur_result result = AUR_OK;
    FILE *const stream = open_memstream(&text, &size);
    report_table *const table = strcmp(format, "rtrace") == 0 ? NULL : make_table(w);
    if (stream != NULL && table == NULL)
        write_rtrace(w, stream);
    else if (stream != NULL)
        result = report_write(table, strcmp(format, "json") == 0 ? REPORT_JSON : REPORT_CSV, stream, error);
    report_destroy(table);
    if (stream == NULL || (fclose(stream) != 0 && result == AUR_OK))
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the results");
    if (result == AUR_OK)
        result = aur_file_write(output, size, text, error);
    free(text);
    return result;
}

aur_result cli_contributions_run(const cli_contributions *given, const char *path,
                                 const aur_scene_options *load, const aur_irradiance_options *estimate,
                                 bool lux, const aur_sensors_view *sensors, const char *output,
                                 const char *format, aur_error *error) {
    aur_irradiance *const results = calloc(given->count, sensors->count * sizeof *results);
    if (results == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu sensors", sensors->count);
    aur_result result = AUR_OK;
    for (size_t m = 0; m < given->count && result == AUR_OK; ++m) {
        aur_scene_options some = *load;
        aur_irradiance_options once = *estimate;
        aur_scene *scene = NULL;
        some.light_modifier = given->names[m];
        some.warnings = once.warnings = (aur_warnings){.function = NULL};
        result = aur_scene_load(path, &some, &scene, error);
        if (result == AUR_OK)
            result = aur_irradiance_estimate(scene, sensors, &once, sizeof *results,
                                             results + m * sensors->count, error);
        aur_scene_destroy(scene);
    }
    cli_progress_clear();
    const work w = {given, sensors, results, lux};
    if (result == AUR_OK)
        result = write_file(&w, output, format, error);
    free(results);
    return result;
}
