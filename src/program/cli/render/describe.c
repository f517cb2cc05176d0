/* Describes a scene, an image or a luminaire for `aureole info`. */
#include <aureole-render/image.h>
#include <aureole-render/render.h>
#include <aureole-render/scene.h>
#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "program/cli/points/point_source.h"
#include "program/lab/gather.h"

static int describe_scene(const cli_info_input *input, const cli_info_options *options) {
    aur_error error;
    aur_scene *scene;
    const aur_scene_options scene_options = {.size = sizeof scene_options,
                                             .definition_count = options->definitions.count,
                                             .definitions = options->definitions.items,
                                             .confine = options->definitions.confine,
                                             .diffuse = options->definitions.diffuse,
                                             .model_light = options->definitions.model_light,
                                             .stage.ground = AUR_SCENE_GROUND_NONE,
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
    aur_scene_get_description(scene, &d, NULL);
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

static int describe_image(const cli_info_input *input, const char *format, const cli_info_options *options) {
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
        report_summary(table, width * height, channel_count, aur_image_data(image) + c, NULL);
    }
    aur_image_destroy(image);
    return cli_finish(table, options->common.format);
}

static int describe_luminaire(const cli_info_input *input, const cli_info_options *options) {
    aur_luminaire_description d = {.size = sizeof d};
    aur_error error;
    if (aur_luminaire_describe(input->path, input->size, input->data, &d, &error) != AUR_OK)
        return cli_fail(&error);
    report_table *const facts = report_create(0, NULL);
    report_fact_text(facts, "kind", "luminaire");
    report_fact_text(facts, "format", d.format);
    report_fact_text(facts, "type", d.type);
    report_fact_text(facts, "symmetry", d.symmetry);
    report_fact_number(facts, "planes", (double)d.planes);
    report_fact_number(facts, "angles", (double)d.angles);
    report_fact_number(facts, "lumens", d.lumens);
    if (d.lamp_lumens > 0.0)
        report_fact_number(facts, "lamp_lumens", d.lamp_lumens);
    else
        report_fact_text(facts, "lamp_lumens", "absolute photometry");
    report_fact_number(facts, "peak_candela", d.peak);
    report_fact_text(facts, "opening",
                     !(d.length + d.width > 0.0) ? "point"
                     : d.round                   ? "ellipse"
                                                 : "rectangle");
    report_fact_number(facts, "length", d.length);
    report_fact_number(facts, "width", d.width);
    report_fact_number(facts, "height", d.height);
    return cli_finish(facts, options->common.format);
}

/* By the extension, or the first words of LM-63. */
static bool is_luminaire(const char *path, size_t size, const char *start) {
    const char *const dot = strrchr(path, '.');
    return (size >= 5 && (memcmp(start, "IESNA", 5) == 0 || memcmp(start, "TILT=", 5) == 0)) ||
           (dot != NULL && (strcasecmp(dot, ".ies") == 0 || strcasecmp(dot, ".ldt") == 0));
}

/* XML begins with '<', possibly after a byte order mark and white space. */
static bool is_xml(size_t size, const char *text) {
    size_t i = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (i < size && isspace((unsigned char)text[i]))
        ++i;
    return i < size && text[i] == '<';
}

bool cli_describe_rendered(const cli_info_input *input, size_t size, const char *start,
                           const cli_info_options *options, int *status) {
    const char *const format = aur_image_format_of(size, start);
    if (format != NULL)
        *status = describe_image(input, format, options);
    else if (is_luminaire(input->path, size, start))
        *status = describe_luminaire(input, options);
    else if (is_xml(size, start) || aur_scene_is_name(input->path))
        *status = describe_scene(input, options);
    else
        return false;
    return true;
}
