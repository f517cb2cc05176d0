/* aureole info: what is in a scene, a picture, a file of points or a table of weights. */
#include <aureole/quadrature.h>
#include <aureole/scene.h>
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/picture.h"
#include "cli/point_source.h"

enum { DEFINITION_CAPACITY = 64, FACT_CAPACITY = 32, START_CAPACITY = 4096 };

typedef struct info_options {
    size_t definition_count;
    aur_definition definitions[DEFINITION_CAPACITY];
    bool quiet;
    cli_format format;
} info_options;

/* One thing that is known of a file: a text, or a number. */
typedef struct info_fact {
    const char *name;
    const char *text; /* NULL: a number */
    double number;
} info_fact;

typedef struct info_facts {
    size_t count;
    info_fact items[FACT_CAPACITY];
} info_facts;

static void add_text(info_facts *facts, const char *name, const char *text) {
    facts->items[facts->count++] = (info_fact){.name = name, .text = text};
}

static void add_number(info_facts *facts, const char *name, double number) {
    facts->items[facts->count++] = (info_fact){.name = name, .number = number};
}

static void put_fact(cli_table *table, const info_fact *fact) {
    if (fact->text != NULL)
        cli_table_text(table, fact->text);
    else
        cli_table_number(table, fact->number, 9);
}

/* For people a line a fact, for programs a column a fact. */
static int print_facts(const info_facts *facts, cli_format format) {
    cli_table *table;
    if (format == CLI_TABLE) {
        table = cli_table_create(2, (const char *const[]){"property", "value"});
        for (size_t i = 0; i < facts->count; ++i) {
            cli_table_text(table, facts->items[i].name);
            put_fact(table, &facts->items[i]);
        }
    } else {
        const char *columns[FACT_CAPACITY];
        for (size_t i = 0; i < facts->count; ++i)
            columns[i] = facts->items[i].name;
        table = cli_table_create(facts->count, columns);
        for (size_t i = 0; i < facts->count; ++i)
            put_fact(table, &facts->items[i]);
    }
    const int status = cli_table_print(table, format);
    cli_table_destroy(table);
    return status;
}

static int describe_scene(const char *path, const info_options *options) {
    aur_error error;
    aur_scene *scene;
    const aur_scene_options scene_options = {.size = sizeof scene_options,
                                             .definition_count = options->definition_count,
                                             .definitions = options->definitions,
                                             .warnings = cli_warnings(options->quiet)};
    if (aur_scene_load(path, &scene_options, &scene, &error) != AUR_OK)
        return cli_fail(&error);
    aur_scene_description d = {.size = sizeof d};
    aur_scene_describe(scene, &d, NULL);
    info_facts facts = {0};
    add_text(&facts, "kind", "scene");
    add_number(&facts, "shapes", (double)d.shapes);
    add_number(&facts, "triangles", (double)d.triangles);
    add_number(&facts, "emitters", (double)d.emitters);
    add_number(&facts, "materials", (double)d.materials);
    static const char *const bounds[2][3] = {{"lower_x", "lower_y", "lower_z"},
                                             {"upper_x", "upper_y", "upper_z"}};
    for (size_t i = 0; i < 3; ++i) {
        add_number(&facts, bounds[0][i], (double)d.lower[i]);
        add_number(&facts, bounds[1][i], (double)d.upper[i]);
    }
    add_number(&facts, "width", (double)d.width);
    add_number(&facts, "height", (double)d.height);
    add_number(&facts, "samples_per_pixel", (double)d.samples_per_pixel);
    add_text(&facts, "filter", d.filter);
    add_text(&facts, "integrator", d.integrator);
    add_text(&facts, "sampler", d.sampler);
    const int status = print_facts(&facts, options->format);
    aur_scene_destroy(scene);
    return status;
}

/* Mean and range of a column of values. */
typedef struct info_summary {
    double minimum, mean, maximum;
    uint64_t not_finite; /* left out of the others */
} info_summary;

static void summary_start(info_summary *summary) {
    *summary = (info_summary){.minimum = INFINITY, .maximum = -INFINITY};
}

static void summary_add(info_summary *summary, double value) {
    if (!isfinite(value)) {
        ++summary->not_finite;
        return;
    }
    summary->minimum = fmin(summary->minimum, value);
    summary->maximum = fmax(summary->maximum, value);
    summary->mean += value;
}

static void summary_finish(info_summary *summary, size_t count) {
    const uint64_t finite = count - summary->not_finite;
    summary->mean = finite > 0 ? summary->mean / (double)finite : NAN;
    if (finite == 0)
        summary->minimum = summary->maximum = NAN;
}

static void put_summary(cli_table *table, const info_summary *summary) {
    cli_table_number(table, summary->minimum, 6);
    cli_table_number(table, summary->mean, 6);
    cli_table_number(table, summary->maximum, 6);
    cli_table_integer(table, summary->not_finite);
}

static int describe_picture(const char *path, const char *format, const info_options *options) {
    aur_image *image;
    const int status = cli_read_picture(path, NULL, &image);
    if (status != CLI_SUCCESS)
        return status;
    static const char *const columns[] = {"format",  "width", "height",  "channel",
                                          "minimum", "mean",  "maximum", "not_finite"};
    cli_table *const table = cli_table_create(sizeof columns / sizeof columns[0], columns);
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t pixels = width * height, channel_count = aur_image_channel_count(image);
    const float *const data = aur_image_data(image);
    for (size_t c = 0; c < channel_count; ++c) {
        info_summary summary;
        summary_start(&summary);
        for (size_t i = 0; i < pixels; ++i)
            summary_add(&summary, (double)data[i * channel_count + c]);
        summary_finish(&summary, pixels);
        cli_table_text(table, format);
        cli_table_integer(table, width);
        cli_table_integer(table, height);
        cli_table_text(table, aur_image_channel_name(image, c));
        put_summary(table, &summary);
    }
    const int printed = cli_table_print(table, options->format);
    cli_table_destroy(table);
    aur_image_destroy(image);
    return printed;
}

static int describe_points(const char *path, const info_options *options) {
    aur_points *points;
    aur_error error;
    if (aur_points_read(path, &points, &error) != AUR_OK)
        return cli_fail(&error);
    static const char *const columns[] = {"domain", "points",  "coordinate", "minimum",
                                          "mean",   "maximum", "not_finite"};
    cli_table *const table = cli_table_create(sizeof columns / sizeof columns[0], columns);
    const aur_points_view *const view = aur_points_look(points);
    const size_t column_count = view->dimension + (view->weights != NULL);
    for (size_t c = 0; c < column_count; ++c) {
        const bool weight = c == view->dimension;
        info_summary summary;
        summary_start(&summary);
        for (size_t i = 0; i < view->count; ++i)
            summary_add(&summary, weight ? view->weights[i] : view->coordinates[i * view->stride + c]);
        summary_finish(&summary, view->count);
        char number[32];
        const bool named = view->dimension <= 3 && view->domain != AUR_DOMAIN_CUBE;
        snprintf(number, sizeof number, "u%zu", c + 1);
        const char *const letters = view->domain == AUR_DOMAIN_SQUARE ? "u\0v" : "x\0y\0z";
        cli_table_text(table, aur_domain_name(view->domain));
        cli_table_integer(table, view->count);
        cli_table_text(table, weight ? "w" : named ? letters + 2 * c : number);
        put_summary(table, &summary);
    }
    aur_points_destroy(points);
    const int status = cli_table_print(table, options->format);
    cli_table_destroy(table);
    return status;
}

static int describe_weight_table(const char *path, const info_options *options) {
    aur_weight_table *table;
    aur_error error;
    if (aur_weight_table_load(path, NULL, &table, &error) != AUR_OK)
        return cli_fail(&error);
    const aur_oswa_options *const o = aur_weight_table_options(table);
    info_facts facts = {0};
    add_text(&facts, "kind", "weight table");
    add_text(&facts, "set", o->set);
    add_number(&facts, "samples", (double)o->count);
    add_number(&facts, "mirror_samples", (double)o->mirror_count);
    add_number(&facts, "exponent", o->lobe.exponent);
    if (o->mirror_lobe.kind == AUR_LOBE_GGX)
        add_number(&facts, "mirror_alpha", o->mirror_lobe.alpha);
    else
        add_number(&facts, "mirror_exponent", o->mirror_lobe.exponent);
    add_text(&facts, "density", o->optimal_density ? "optimal" : "same");
    add_text(&facts, "horizon", o->clipped || o->mirror_lobe.kind == AUR_LOBE_GGX ? "clipped" : "ignored");
    add_number(&facts, "seed", (double)o->seed);
    add_number(&facts, "smoothness", o->smoothness);
    add_number(&facts, "regularization", o->weights->regularization);
    add_text(&facts, "sum", o->weights->sum_constraint ? "1" : "free");
    add_number(&facts, "angles", (double)aur_weight_table_angles(table));
    add_number(&facts, "rotations", (double)aur_weight_table_rotations(table));
    const int status = print_facts(&facts, options->format);
    aur_weight_table_destroy(table);
    return status;
}

/* XML begins with '<', after a byte order mark and white space. */
static bool is_xml(size_t size, const char *text) {
    size_t i = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (i < size && isspace((unsigned char)text[i]))
        ++i;
    return i < size && text[i] == '<';
}

static int describe(const char *path, const info_options *options) {
    char start[START_CAPACITY];
    FILE *const file = fopen(path, "rb");
    if (file == NULL)
        return cli_bad_usage("%s: cannot read: %s", path, strerror(errno));
    const size_t size = fread(start, 1, sizeof start, file);
    const int code = ferror(file) ? errno : 0;
    fclose(file);
    if (code != 0)
        return cli_bad_usage("%s: cannot read: %s", path, strerror(code));
    const char *const format = aur_image_format_of(size, start);
    if (format != NULL)
        return describe_picture(path, format, options);
    if (is_xml(size, start))
        return describe_scene(path, options);
    static const char table[] = "aureole weight table\n";
    if (size >= sizeof table - 1 && memcmp(start, table, sizeof table - 1) == 0)
        return describe_weight_table(path, options);
    return describe_points(path, options);
}

static bool add_definition(info_options *options, char *text) {
    char *const equals = strchr(text, '=');
    if (equals == NULL || equals == text || options->definition_count == DEFINITION_CAPACITY) {
        cli_bad_usage("-D: '%s' is not of the form name=value, or there are more than %d", text,
                      DEFINITION_CAPACITY);
        return false;
    }
    *equals = '\0';
    options->definitions[options->definition_count++] = (aur_definition){text, equals + 1};
    return true;
}

static int run(int argc, char **argv) {
    static const struct option long_options[] = {
        {"format", required_argument, NULL, 'f'}, {"quiet", no_argument, NULL, 'q'}, {0}};
    info_options options = {0};
    optind = 0;
    for (int option; (option = cli_next_option(argc, argv, "D:q", long_options)) != -1;) {
        if (option == '?' || (option == 'D' && !add_definition(&options, optarg)) ||
            (option == 'f' && !cli_parse_format(optarg, &options.format)))
            return CLI_BAD_INPUT;
        options.quiet = options.quiet || option == 'q';
    }
    if (argc - optind != 1)
        return cli_bad_usage("info: one file is needed: try 'aureole help info'");
    return describe(argv[optind], &options);
}

const cli_verb cli_verb_info = {
    "info", "SCENE|IMAGE|POINTS|TABLE [options]",
    "what is in a scene, a picture, a file of points or a table of weights",
    "  -D NAME=VALUE            set a <default> of the scene\n"
    "  --format table|csv|json  how it is printed\n"
    "  -q, --quiet              no warnings\n"
    "\n"
    "The kind of file is seen from its content. Scenes: sizes, bounding box (scene units), film and "
    "plugins.\n"
    "Pictures and points: range and mean of each channel or coordinate, over its finite values.\n",
    run};
