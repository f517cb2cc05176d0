/* aureole compare: difference metrics between a reference and images. */
#include <aureole-render/image.h>
#include <math.h>
#include <stdio.h>

#include "program/cli/render/image_input.h"

typedef struct compare_options {
    cli_list metrics;
    double tolerance;
    double scale;
    cli_image_input input;
    const char *outfile;
    const char *html;
    cli_common common;
} compare_options;

static const cli_option rows[] = {
    {CLI_TEXT(compare_options, metrics, "metric", "NAME", "rmse", "error measures"), .list = true,
     .name = aur_image_metric_name},
    {CLI_REAL(compare_options, tolerance, "tolerance", "T", 0, INFINITY, "0",
              "largest value allowed for every metric; 0: identical")},
    {CLI_TEXT(compare_options, outfile, "output", "FILE", NULL,
              "write the absolute difference (the FLIP map if the first metric is flip) in false colour "
              "(PNG, EXR, ...); with --luminance with a scale in cd/m2 (PNG, SVG, PDF, TeX)"),
     .letter = 'o', .content = "file", .writes = true},
    {CLI_TEXT(compare_options, html, "html", "FILE", NULL,
              "write a page that shows the images: flip, slider, differences, values"),
     .content = "file", .writes = true},
    {CLI_REAL(compare_options, scale, "scale", "D", 0, INFINITY, "the largest; 1 for flip",
              "value of the brightest colour"),
     .key.computed = true},
    {.key = {0}}};

static aur_image_metric metric_at(const compare_options *options, size_t index) {
    aur_image_metric metric;
    aur_image_metric_from_name(cli_list_at(&options->metrics, index), &metric, NULL);
    return metric;
}

/* Adds the image's name to an error without a file name. */
static int fail_about(const char *path, aur_error *error) {
    snprintf(error->file, sizeof error->file, "%s", path);
    return cli_fail(error);
}

static int add_row(const char *path, const aur_image *reference, const aur_image *image,
                   const compare_options *options, report_table *table, bool *within) {
    aur_error error;
    double value[4], mean[4];
    report_text(table, path);
    for (size_t i = 0; i < options->metrics.count; ++i) {
        if (aur_image_compare(reference, image, metric_at(options, i), value, &error) != AUR_OK)
            return fail_about(path, &error);
        report_number(table, value[3], 6);
        *within = *within && value[3] <= options->tolerance;
    }
    if (aur_image_compare(reference, image, AUR_IMAGE_RELATIVE_RMSE, value, &error) != AUR_OK)
        return fail_about(path, &error);
    report_number(table, value[3], 6);
    static const aur_error_measure measures[] = {AUR_ERROR_MEASURE_RELATIVE, AUR_ERROR_MEASURE_DISPLAY};
    for (size_t m = 0; m < 2; ++m) {
        if (aur_image_error(reference, image, measures[m], value, &error) != AUR_OK)
            return fail_about(path, &error);
        report_number(table, value[0], 6);
    }
    const aur_image *const both[] = {image, reference};
    for (size_t i = 0; i < 2; ++i) {
        if (aur_image_mean(both[i], mean, &error) != AUR_OK)
            return fail_about(path, &error);
        for (size_t c = 0; c < 3; ++c)
            report_number(table, mean[c], 6);
    }
    return CLI_SUCCESS;
}

static report_table *create_table(const compare_options *options) {
    static const char *const others[] = {"relative_rmse",    "relative_error",   "display_error",
                                         "mean_r",           "mean_g",           "mean_b",
                                         "reference_mean_r", "reference_mean_g", "reference_mean_b"};
    report_table *const table = report_create(1, (const char *const[]){"image"});
    for (size_t i = 0; i < options->metrics.count; ++i)
        report_column(table, aur_image_metric_name(metric_at(options, i)));
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
        report_column(table, others[i]);
    return table;
}

/* Absolute differences of luminances with a color scale in cd/m2. */
static int draw_luminances(const aur_image *reference, const aur_image *image,
                           const compare_options *options) {
    aur_image *map = NULL;
    aur_error error;
    const size_t count = aur_image_width(image) * aur_image_height(image);
    aur_result result = aur_image_create(aur_image_width(image), aur_image_height(image), 1, &map, &error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        aur_image_data(map)[i] = fabsf(aur_image_data(image)[i] - aur_image_data(reference)[i]);
    if (result == AUR_OK)
        result = cli_image_map(options->outfile, map, options->scale, false, &error);
    aur_image_destroy(map);
    return cli_status(result, &error);
}

/* The error map: of FLIP its map, of all other metrics the absolute difference. */
static int write_difference(const aur_image *reference, const aur_image *image,
                            const compare_options *options) {
    if (options->input.luminance != CLI_LUMINANCE_NONE)
        return draw_luminances(reference, image, options);
    aur_error error;
    aur_image *map = NULL, *colored = NULL;
    aur_result result;
    if (metric_at(options, 0) == AUR_IMAGE_FLIP) {
        result = aur_image_flip(reference, image, &map, &error);
        if (result == AUR_OK)
            result =
                aur_image_false_color(map, options->scale > 0.0 ? options->scale : 1.0, &colored, &error);
    } else {
        result = aur_image_difference(reference, image, options->scale, &colored, &error);
    }
    if (result == AUR_OK)
        result = aur_image_write(options->outfile, colored, NULL, &error);
    aur_image_destroy(colored);
    aur_image_destroy(map);
    return cli_status(result, &error);
}

static int run(const cli_call *call) {
    const compare_options *const options = call->options;
    if (options->outfile != NULL && call->operand_count > 2)
        return cli_bad_usage("compare: --output takes one image (found %zu)", call->operand_count - 1);
    aur_image *reference = NULL;
    int status = cli_read_image(call->operands[0], &options->input, &reference);
    report_table *const table = create_table(options);
    bool within = true;
    for (size_t i = 1; i < call->operand_count && status == CLI_SUCCESS; ++i) {
        aur_image *image = NULL;
        status = cli_read_image(call->operands[i], &options->input, &image);
        if (status == CLI_SUCCESS)
            status = add_row(call->operands[i], reference, image, options, table, &within);
        if (status == CLI_SUCCESS && options->outfile != NULL)
            status = write_difference(reference, image, options);
        aur_image_destroy(image);
    }
    if (status == CLI_SUCCESS)
        status = cli_finish(table, options->common.format);
    else
        report_destroy(table);
    aur_image_destroy(reference);
    if (status == CLI_SUCCESS && options->html != NULL)
        status =
            cli_write_viewer(options->html, call->operand_count, call->operands, &options->input, 0.0, true);
    return status == CLI_SUCCESS && !within ? CLI_DIFFERENCE : status;
}

const cli_command cli_command_compare = {
    .name = "compare",
    .summary = "compare images: RMSE and other error measures",
    .notes =
        "Images are EXR, PFM, HDR, PNG or JPEG. --channels selects one or three channels instead of R, G, B. "
        "relative_rmse, relative_error and display_error are the errors by --error-measure mean, relative "
        "and display of 'aureole render'; mean_r to reference_mean_b are the mean radiances of both images. "
        "The exit status is 0 if every image is within the tolerance, 1 if one is not, 2 on an error.",
    .too_few = "expected a reference and at least one image",
    .operands = {{"REFERENCE", "the reference image", .content = "file"},
                 {"IMAGE", "images of the same size", .repeated = true, .content = "file"}},
    .groups = {{rows, 0},
               {cli_image_input_options, offsetof(compare_options, input)},
               {cli_format_option, offsetof(compare_options, common)}},
    .size = sizeof(compare_options),
    .run = run,
};
