/* aureole info: what is in a scene, a picture, a file of points or a table of weights. */
#include <aureole-render/image.h>
#include <aureole-render/render.h>
#include <aureole-render/scene.h>
#include <aureole/quadrature.h>
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "program/cli/point_source.h"
#include "program/lab/gather.h"

enum { START_CAPACITY = 4096 };

typedef struct info_options {
    cli_definitions definitions;
    cli_common common;
} info_options;

/* What is described: a file, or the bytes that came by standard input. */
typedef struct info_input {
    const char *path;
    size_t size;
    char *data; /* NULL: a file */
} info_input;

static int describe_scene(const info_input *input, const info_options *options) {
    aur_error error;
    aur_scene *scene;
    const aur_scene_options scene_options = {.size = sizeof scene_options,
                                             .definition_count = options->definitions.count,
                                             .definitions = options->definitions.items,
                                             .confine = options->definitions.confine,
                                             .model_light = options->definitions.model_light,
                                             .warnings = cli_warnings(options->common.quiet)};
    const aur_result loaded =
        input->data != NULL
            ? aur_scene_load_memory(input->path, input->size, input->data, &scene_options, &scene, &error)
            : aur_scene_load(input->path, &scene_options, &scene, &error);
    if (loaded != AUR_OK)
        return cli_fail(&error);
    if (aur_render_check_scene(scene, &lab_finalgather, &error) != AUR_OK) {
        aur_scene_destroy(scene);
        return cli_fail(&error);
    }
    aur_scene_description d = {.size = sizeof d};
    aur_scene_describe(scene, &d, NULL);
    report_table *const facts = report_create(0, NULL);
    report_fact_text(facts, "kind", "scene");
    report_fact_number(facts, "shapes", (double)d.shapes);
    report_fact_number(facts, "triangles", (double)d.triangles);
    report_fact_number(facts, "emitters", (double)d.emitters);
    report_fact_number(facts, "materials", (double)d.materials);
    static const char *const bounds[2][3] = {{"lower_x", "lower_y", "lower_z"},
                                             {"upper_x", "upper_y", "upper_z"}};
    for (size_t i = 0; i < 3; ++i) {
        report_fact_number(facts, bounds[0][i], d.lower[i]);
        report_fact_number(facts, bounds[1][i], d.upper[i]);
    }
    report_fact_number(facts, "width", (double)d.width);
    report_fact_number(facts, "height", (double)d.height);
    report_fact_number(facts, "samples_per_pixel", (double)d.samples_per_pixel);
    report_fact_text(facts, "filter", d.filter);
    report_fact_text(facts, "integrator", d.integrator);
    report_fact_text(facts, "sampler", d.sampler);
    aur_scene_destroy(scene);
    return cli_finish(facts, options->common.format);
}

/* Range and mean of a column of `count` values, which stand `stride` apart, over the finite ones. */
static void put_summary(report_table *table, size_t count, size_t stride, const float *floats,
                        const double *doubles) {
    double minimum = INFINITY, maximum = -INFINITY, sum = 0.0;
    uint64_t finite = 0;
    for (size_t i = 0; i < count; ++i) {
        const double value = doubles != NULL ? doubles[i * stride] : (double)floats[i * stride];
        if (!isfinite(value))
            continue;
        minimum = fmin(minimum, value);
        maximum = fmax(maximum, value);
        sum += value;
        ++finite;
    }
    report_number(table, finite > 0 ? minimum : NAN, 6);
    report_number(table, finite > 0 ? sum / (double)finite : NAN, 6);
    report_number(table, finite > 0 ? maximum : NAN, 6);
    report_integer(table, count - finite);
}

static int describe_picture(const info_input *input, const char *format, const info_options *options) {
    aur_image *image;
    aur_error error;
    const aur_result read = input->data != NULL
                                ? aur_image_read_memory(input->path, input->size, input->data, &image, &error)
                                : aur_image_read(input->path, &image, &error);
    if (read != AUR_OK)
        return cli_fail(&error);
    static const char *const columns[] = {"format",  "width", "height",  "channel",
                                          "minimum", "mean",  "maximum", "not_finite"};
    report_table *const table = report_create(sizeof columns / sizeof columns[0], columns);
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t channel_count = aur_image_channel_count(image);
    for (size_t c = 0; c < channel_count; ++c) {
        report_text(table, format);
        report_integer(table, width);
        report_integer(table, height);
        report_text(table, aur_image_channel_name(image, c));
        put_summary(table, width * height, channel_count, aur_image_data(image) + c, NULL);
    }
    aur_image_destroy(image);
    return cli_finish(table, options->common.format);
}

static int describe_points(const info_input *input, const info_options *options) {
    aur_points *points;
    aur_error error;
    const aur_result read = input->data != NULL ? aur_points_read_memory(input->path, input->size,
                                                                         input->data, NULL, &points, &error)
                                                : aur_points_read(input->path, &points, &error);
    if (read != AUR_OK) {
        /* Nothing says that this is a file of points. */
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
    const aur_points_view *const view = aur_points_look(points);
    cli_warn_of_guess(input->path, view, cli_warnings(false));
    const size_t column_count = view->dimension + (view->weights != NULL);
    for (size_t c = 0; c < column_count; ++c) {
        const bool weight = c == view->dimension;
        char number[32];
        const bool named = view->dimension <= 3 && view->domain != AUR_DOMAIN_CUBE;
        snprintf(number, sizeof number, "u%zu", c + 1);
        const char *const letters = view->domain == AUR_DOMAIN_SQUARE ? "u\0v" : "x\0y\0z";
        report_text(table, aur_domain_name(view->domain));
        report_integer(table, view->count);
        report_text(table, weight ? "w" : named ? letters + 2 * c : number);
        put_summary(table, view->count, weight ? 1 : view->stride, NULL,
                    weight ? view->weights : view->coordinates + c);
    }
    aur_points_destroy(points);
    return cli_finish(table, options->common.format);
}

static int describe_weight_table(const char *path, const info_options *options) {
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
    /* Programs are given both, of which one is not known. */
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

/* Its numbers have a meaning beside its scene alone. */
static int describe_radiosity(const info_options *options) {
    report_table *const facts = report_create(0, NULL);
    report_fact_text(facts, "kind", "solution of radiosity");
    report_fact_text(facts, "used_by", "render --integrator radiosity:load=FILE");
    return cli_finish(facts, options->common.format);
}

/* XML begins with '<', after a byte order mark and white space. */
static bool is_xml(size_t size, const char *text) {
    size_t i = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (i < size && isspace((unsigned char)text[i]))
        ++i;
    return i < size && text[i] == '<';
}

static int describe(const info_input *input, size_t size, const char *start, const info_options *options) {
    const char *const format = aur_image_format_of(size, start);
    if (format != NULL)
        return describe_picture(input, format, options);
    static const char radiosity[] = "aureole-radiosity ";
    if (size >= sizeof radiosity - 1 && memcmp(start, radiosity, sizeof radiosity - 1) == 0)
        return describe_radiosity(options);
    if (is_xml(size, start) || aur_scene_is_name(input->path))
        return describe_scene(input, options);
    static const char table[] = "aureole weight table\n";
    if (size < sizeof table - 1 || memcmp(start, table, sizeof table - 1) != 0)
        return describe_points(input, options);
    if (input->data != NULL)
        return cli_bad_usage("-: a table of weights is read from a file, not from standard input");
    return describe_weight_table(input->path, options);
}

static int describe_file(const char *path, const info_options *options) {
    char start[START_CAPACITY];
    struct stat status;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
        return cli_bad_usage("%s: cannot read: it is no file; '-' reads standard input", path);
    FILE *const file = fopen(path, "rb");
    if (file == NULL)
        return cli_bad_usage("%s: cannot read: %s", path, strerror(errno));
    const size_t size = fread(start, 1, sizeof start, file);
    const int code = ferror(file) ? errno : 0;
    fclose(file);
    if (code != 0)
        return cli_bad_usage("%s: cannot read: %s", path, strerror(code));
    return describe(&(info_input){.path = path}, size, start, options);
}

/* All of standard input, in memory that doubles. */
static int describe_stream(const info_options *options) {
    info_input input = {.path = "-"};
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

const cli_verb cli_verb_info = {
    .name = "info",
    .summary = "what is in a scene, a picture, a file of points or a table of weights",
    .notes =
        "'-' is standard input. The kind of file is seen from its content, and that of models (.glb, .obj, "
        "...) and .rad from its "
        "name. Scenes: sizes, bounding box (scene units), film and "
        "plugins. Pictures and points: range and mean of each channel or coordinate, over its finite values.",
    .too_few = "one file is needed",
    .too_many = "one file is needed",
    .operands = {{"FILE", "a scene, a picture, points or a table of weights", .content = "file"}},
    .groups = {{cli_definitions_option, offsetof(info_options, definitions)},
               {cli_model_light_option, offsetof(info_options, definitions)},
               {cli_format_option, offsetof(info_options, common)},
               {cli_quiet_option, offsetof(info_options, common)}},
    .size = sizeof(info_options),
    .run = run,
};
