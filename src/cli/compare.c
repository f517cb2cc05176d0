/* aureole compare: figures of the difference between a reference and pictures. */
#include <aureole/image.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/picture.h"

enum { METRIC_CAPACITY = 16 };

typedef struct compare_options {
    size_t metric_count;
    aur_image_metric metrics[METRIC_CAPACITY];
    double tolerance;
    double scale;
    size_t downsample;
    const char *channels;
    const char *outfile;
    cli_format format;
} compare_options;

static bool parse_metrics(const char *text, compare_options *options) {
    char *const copy = strdup(text);
    bool good = copy != NULL;
    options->metric_count = 0;
    for (char *rest = copy; good && rest != NULL;) {
        char *const comma = strchr(rest, ',');
        if (comma != NULL)
            *comma = '\0';
        aur_error error;
        if (options->metric_count == METRIC_CAPACITY)
            good = cli_bad_usage("--metric: at most %d metrics", METRIC_CAPACITY) == CLI_SUCCESS;
        else if (aur_image_metric_from_name(rest, &options->metrics[options->metric_count], &error) != AUR_OK)
            good = cli_fail(&error) == CLI_SUCCESS;
        ++options->metric_count;
        rest = comma != NULL ? comma + 1 : NULL;
    }
    free(copy);
    return good;
}

static bool parse_options(int argc, char **argv, compare_options *options) {
    static const struct option long_options[] = {
        {"metric", required_argument, NULL, 'm'},     {"tolerance", required_argument, NULL, 't'},
        {"outfile", required_argument, NULL, 'o'},    {"scale", required_argument, NULL, 's'},
        {"downsample", required_argument, NULL, 'd'}, {"channels", required_argument, NULL, 'c'},
        {"format", required_argument, NULL, 'f'},     {0}};
    *options = (compare_options){.metric_count = 1, .metrics = {AUR_IMAGE_RMSE}, .downsample = 1};
    optind = 0;
    for (int option; (option = cli_next_option(argc, argv, "o:", long_options)) != -1;) {
        bool good = true;
        switch (option) {
        case 'm':
            good = parse_metrics(optarg, options);
            break;
        case 't':
            good = cli_parse_number("--tolerance", optarg, 0.0, INFINITY, &options->tolerance);
            break;
        case 's':
            good = cli_parse_number("--scale", optarg, 0.0, INFINITY, &options->scale);
            break;
        case 'd':
            good = cli_parse_size("--downsample", optarg, 1, SIZE_MAX, &options->downsample);
            break;
        case 'o':
            options->outfile = optarg;
            break;
        case 'c':
            options->channels = optarg;
            break;
        case 'f':
            good = cli_parse_format(optarg, &options->format);
            break;
        default:
            return false;
        }
        if (!good)
            return false;
    }
    const int count = argc - optind;
    if (count < 2)
        cli_bad_usage("compare: a reference and at least one picture are needed: try 'aureole help compare'");
    else if (options->outfile != NULL && count > 2)
        cli_bad_usage("compare: --outfile shows the difference of one picture, not of %d", count - 1);
    return count == 2 || (count > 2 && options->outfile == NULL);
}

/* Reads a picture and makes of it what the options ask for. */
static int read_picture(const char *path, const compare_options *options, aur_image **image) {
    const int status = cli_read_picture(path, options->channels, image);
    if (status != CLI_SUCCESS || options->downsample == 1)
        return status;
    aur_error error;
    aur_image *smaller;
    const aur_result result = aur_image_downsample(*image, options->downsample, &smaller, &error);
    if (result != AUR_OK)
        return cli_fail(&error);
    aur_image_destroy(*image);
    *image = smaller;
    return CLI_SUCCESS;
}

/* Says which picture an error without a file is about. */
static int fail_about(const char *path, aur_error *error) {
    snprintf(error->file, sizeof error->file, "%s", path);
    return cli_fail(error);
}

static int add_row(const char *path, const aur_image *reference, const aur_image *image,
                   const compare_options *options, cli_table *table, bool *within) {
    aur_error error;
    double value[4], mean[4];
    cli_table_text(table, path);
    for (size_t i = 0; i < options->metric_count; ++i) {
        if (aur_image_compare(reference, image, options->metrics[i], value, &error) != AUR_OK)
            return fail_about(path, &error);
        cli_table_number(table, value[3], 6);
        *within = *within && value[3] <= options->tolerance;
    }
    if (aur_image_compare(reference, image, AUR_IMAGE_RELATIVE_RMSE, value, &error) != AUR_OK)
        return fail_about(path, &error);
    cli_table_number(table, value[3], 6);
    const aur_image *const both[] = {image, reference};
    for (size_t i = 0; i < 2; ++i) {
        if (aur_image_mean(both[i], mean, &error) != AUR_OK)
            return fail_about(path, &error);
        for (size_t c = 0; c < 3; ++c)
            cli_table_number(table, mean[c], 6);
    }
    return CLI_SUCCESS;
}

static cli_table *create_table(const compare_options *options) {
    const char *columns[METRIC_CAPACITY + 8] = {"image"};
    size_t count = 1;
    for (size_t i = 0; i < options->metric_count; ++i)
        columns[count++] = aur_image_metric_name(options->metrics[i]);
    static const char *const others[] = {"relative_rmse",    "mean_r",           "mean_g",          "mean_b",
                                         "reference_mean_r", "reference_mean_g", "reference_mean_b"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
        columns[count++] = others[i];
    return cli_table_create(count, columns);
}

/* Of FLIP its map, of every other metric the absolute difference. */
static int write_difference(const aur_image *reference, const aur_image *image,
                            const compare_options *options) {
    aur_error error;
    aur_image *map = NULL, *colored = NULL;
    aur_result result;
    if (options->metrics[0] == AUR_IMAGE_FLIP) {
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
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(&error);
}

static int run(int argc, char **argv) {
    compare_options options;
    if (!parse_options(argc, argv, &options))
        return CLI_BAD_INPUT;
    aur_image *reference = NULL;
    int status = read_picture(argv[optind], &options, &reference);
    cli_table *const table = create_table(&options);
    bool within = true;
    for (int i = optind + 1; i < argc && status == CLI_SUCCESS; ++i) {
        aur_image *image = NULL;
        status = read_picture(argv[i], &options, &image);
        if (status == CLI_SUCCESS)
            status = add_row(argv[i], reference, image, &options, table, &within);
        if (status == CLI_SUCCESS && options.outfile != NULL)
            status = write_difference(reference, image, &options);
        aur_image_destroy(image);
    }
    if (status == CLI_SUCCESS)
        status = cli_table_print(table, options.format);
    cli_table_destroy(table);
    aur_image_destroy(reference);
    return status == CLI_SUCCESS && !within ? CLI_DIFFERENCE : status;
}

const cli_verb cli_verb_compare = {
    "compare", "REFERENCE IMAGE... [options]", "RMSE and other figures of the difference between pictures",
    "  --metric NAME[,NAME...]  rmse (default), mse, mae, relmse, mrse, relative-rmse, flip\n"
    "  --tolerance T            every metric named may be at most T (default 0: identical)\n"
    "  -o, --outfile FILE       write the absolute difference (FLIP's map when the first metric is\n"
    "                           flip) in false colour (PNG, EXR, ...)\n"
    "  --scale D                the value that is drawn brightest (default: the largest; 1 for flip)\n"
    "  --downsample N           compare after averaging blocks of N x N pixels\n"
    "  --channels NAME[,...]    compare these channels (one or three) instead of R, G, B\n"
    "  --format table|csv|json  how the figures are printed\n"
    "\n"
    "Pictures are EXR, PFM, HDR, PNG or JPEG. relative_rmse is RMSE divided by the reference's mean; mean_r "
    "to\n"
    "reference_mean_b are the mean radiances of both pictures. The exit status is 0 when every picture is\n"
    "within the tolerance, 1 when one is not, 2 on an error.\n",
    run};
