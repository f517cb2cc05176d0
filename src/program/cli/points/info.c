/* aureole info: describes a scene, an image, a file of points or a table of weights. */
#include <aureole/quadrature.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/points/point_source.h"

enum { START_CAPACITY = 4096 };

static int describe_points(const cli_info_input *input, const cli_info_options *options) {
    aur_points *points;
    aur_error error;
    const aur_result read = input->data != NULL ? aur_points_read_memory(input->path, input->size,
                                                                         input->data, NULL, &points, &error)
                                                : aur_points_read(input->path, NULL, &points, &error);
    if (read != AUR_OK) {
        /* The content has no mark of a file of points. */
        if (read == AUR_ERROR_FORMAT && error.line <= 1) {
            const aur_error as_points = error;
            snprintf(error.message, sizeof error.message, "unknown kind of file; as points: %.900s",
                     as_points.message);
        }
        return cli_fail(&error);
    }
    static const char *const columns[] = {"domain", "points",  "coordinate", "minimum",
                                          "mean",   "maximum", "not_finite"};
    report_table *const table = report_create(sizeof columns / sizeof columns[0], columns);
    const aur_points_view *const view = aur_points_get_view(points);
    cli_warn_of_guess(input->path, view, cli_warnings(false));
    const size_t column_count = view->dimension + (view->weights != NULL);
    for (size_t c = 0; c < column_count; ++c) {
        const bool weight = c == view->dimension;
        char number[32];
        const bool turns = view->domain == AUR_DOMAIN_ROTATIONS;
        const bool named = turns || (view->dimension <= 3 && view->domain != AUR_DOMAIN_CUBE);
        snprintf(number, sizeof number, "u%zu", c + 1);
        const char *const letters = turns                               ? "w\0x\0y\0z"
                                    : view->domain == AUR_DOMAIN_SQUARE ? "u\0v"
                                                                        : "x\0y\0z";
        report_text(table, aur_domain_name(view->domain));
        report_integer(table, view->count);
        report_text(table, weight ? turns ? "weight" : "w" : named ? letters + 2 * c : number);
        report_summary(table, view->count, weight ? 1 : view->stride, NULL,
                       weight ? view->weights : view->coordinates + c);
    }
    aur_points_destroy(points);
    return cli_finish(table, options->common.format);
}

static int describe_weight_table(const char *path, const cli_info_options *options) {
    aur_weight_table *table;
    aur_error error;
    if (aur_weight_table_load(path, NULL, &table, &error) != AUR_OK)
        return cli_fail(&error);
    const aur_oswa_options *const o = aur_weight_table_options(table);
    report_table *const facts = report_create(0, NULL);
    report_fact_text(facts, "kind", "weight table");
    report_fact_text(facts, "set", o->set);
    report_fact_number(facts, "samples", (double)o->count);
    report_fact_number(facts, "mirror_samples", (double)o->mirror_count);
    report_fact_number(facts, "exponent", o->lobe.exponent);
    /* Machine-readable output has both; one is empty. */
    const bool ggx = o->mirror_lobe.kind == AUR_LOBE_GGX, all = options->common.format != REPORT_TABLE;
    if (ggx || all)
        report_fact_number(facts, "mirror_alpha", ggx ? o->mirror_lobe.alpha : NAN);
    if (!ggx || all)
        report_fact_number(facts, "mirror_exponent", ggx ? NAN : o->mirror_lobe.exponent);
    report_fact_text(facts, "density", o->optimal_density ? "optimal" : "same");
    report_fact_text(facts, "horizon",
                     o->clipped || o->mirror_lobe.kind == AUR_LOBE_GGX ? "clipped" : "ignored");
    report_fact_number(facts, "seed", (double)o->seed);
    report_fact_number(facts, "smoothness", o->smoothness);
    report_fact_number(facts, "regularization", o->weights->regularization);
    report_fact_text(facts, "sum", o->weights->sum_constraint ? "1" : "free");
    report_fact_number(facts, "angles", (double)aur_weight_table_angles(table));
    report_fact_number(facts, "roughnesses", (double)aur_weight_table_roughnesses(table));
    report_fact_number(facts, "rotations", (double)aur_weight_table_rotations(table));
    aur_weight_table_destroy(table);
    return cli_finish(facts, options->common.format);
}

/* The file's numbers are only meaningful with its scene. */
static int describe_radiosity(const cli_info_options *options) {
    report_table *const facts = report_create(0, NULL);
    report_fact_text(facts, "kind", "solution of radiosity");
    report_fact_text(facts, "used_by", "render --integrator radiosity:load=FILE");
    return cli_finish(facts, options->common.format);
}

static int describe(const cli_info_input *input, size_t size, const char *start,
                    const cli_info_options *options) {
    int status;
    static const char radiosity[] = "aureole-radiosity ";
    if (size >= sizeof radiosity - 1 && memcmp(start, radiosity, sizeof radiosity - 1) == 0)
        return describe_radiosity(options);
    if (cli_describe_rendered(input, size, start, options, &status))
        return status;
    static const char table[] = "aureole weight table\n";
    if (size < sizeof table - 1 || memcmp(start, table, sizeof table - 1) != 0)
        return describe_points(input, options);
    if (input->data != NULL)
        return cli_bad_usage("-: a table of weights is read from a file, not from standard input");
    return describe_weight_table(input->path, options);
}

static int describe_file(const char *path, const cli_info_options *options) {
    char start[START_CAPACITY];
    aur_error error;
    FILE *const file = cli_open_input(path, &error);
    if (file == NULL)
        return cli_fail(&error);
    const size_t size = fread(start, 1, sizeof start, file);
    const int code = ferror(file) ? errno : 0;
    fclose(file);
    if (code != 0)
        return cli_bad_usage("%s: cannot read: %s", path, strerror(code));
    return describe(&(cli_info_input){.path = path}, size, start, options);
}

/* Reads standard input into a buffer that grows by doubling. */
static int describe_stream(const cli_info_options *options) {
    cli_info_input input = {.path = "-"};
    size_t capacity = START_CAPACITY;
    input.data = malloc(capacity);
    while (input.data != NULL) {
        input.size += fread(input.data + input.size, 1, capacity - input.size, stdin);
        if (input.size < capacity)
            break;
        capacity *= 2;
        char *const larger = realloc(input.data, capacity);
        if (larger == NULL)
            free(input.data);
        input.data = larger;
    }
    const int code = ferror(stdin) ? errno : 0;
    int status;
    if (input.data == NULL)
        status = cli_fail(&(aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"});
    else if (code != 0)
        status = cli_bad_usage("-: cannot read: %s", strerror(code));
    else
        status = describe(&input, input.size, input.data, options);
    free(input.data);
    return status;
}

static int run(const cli_call *call) {
    const char *const path = call->operands[0];
    return strcmp(path, "-") == 0 ? describe_stream(call->options) : describe_file(path, call->options);
}

const cli_command cli_command_info = {
    .name = "info",
    .summary = "print the contents of a scene, an image, a luminaire's file, points or a table of weights",
    .notes = "'-' is standard input. The content determines the kind of file, except for models (.glb, .obj, "
             "...), .ldt and .rad, whose extension does. Luminaires: flux, "
             "type, symmetry, opening (metres). Scenes: sizes, bounding box (scene units), film and "
             "plugins. Images and points: range and mean of the finite values of each channel or coordinate.",
    .too_few = "expected one file",
    .too_many = "expected one file",
    .operands = {{"FILE", "a scene, an image, a luminaire (.ies, .ldt), points or a table of weights",
                  .content = "file"}},
    .groups = {{cli_definitions_option, offsetof(cli_info_options, definitions)},
               {cli_model_light_option, offsetof(cli_info_options, definitions)},
               {cli_format_option, offsetof(cli_info_options, common)},
               {cli_quiet_option, offsetof(cli_info_options, common)}},
    .size = sizeof(cli_info_options),
    .run = run,
};
