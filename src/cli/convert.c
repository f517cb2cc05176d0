/* aureole convert: from one picture format to another. */
#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <strings.h>

#include "cli/cli.h"
#include "cli/picture.h"

typedef struct convert_options {
    aur_image_write_options write;
    bool toned; /* an option that only PNG has was given */
    size_t downsample;
    const char *channels;
} convert_options;

static bool parse_tone(const char *text, aur_tone *tone) {
    aur_error error;
    if (aur_tone_from_name(text, tone, &error) == AUR_OK)
        return true;
    cli_fail(&error);
    return false;
}

static bool parse_options(int argc, char **argv, convert_options *options) {
    static const struct option long_options[] = {{"exposure", required_argument, NULL, 'e'},
                                                 {"tone", required_argument, NULL, 't'},
                                                 {"half", no_argument, NULL, 'h'},
                                                 {"channels", required_argument, NULL, 'c'},
                                                 {"downsample", required_argument, NULL, 'd'},
                                                 {"to", required_argument, NULL, 'f'},
                                                 {0}};
    static const char *const formats[] = {"exr", "pfm", "hdr", "png"};
    *options = (convert_options){.downsample = 1, .write = aur_image_write_options_default()};
    optind = 0;
    for (int option; (option = cli_next_option(argc, argv, "", long_options)) != -1;) {
        bool good = true;
        double exposure = 0.0;
        size_t format = 0;
        switch (option) {
        case 'e':
            good = cli_parse_number("--exposure", optarg, -100.0, 100.0, &exposure);
            options->write.exposure = (float)exposure;
            options->toned = true;
            break;
        case 't':
            good = parse_tone(optarg, &options->write.tone);
            options->toned = true;
            break;
        case 'h':
            options->write.half = true;
            break;
        case 'c':
            options->channels = optarg;
            break;
        case 'd':
            good = cli_parse_size("--downsample", optarg, 1, SIZE_MAX, &options->downsample);
            break;
        case 'f':
            good = cli_parse_word("--to", optarg, 4, formats, &format);
            options->write.format = formats[format];
            break;
        default:
            return false;
        }
        if (!good)
            return false;
    }
    if (argc - optind == 2)
        return true;
    cli_bad_usage("convert: one input and one output are needed: try 'aureole help convert'");
    return false;
}

/* Options that would have no effect are mistakes. */
static bool options_fit(const char *output, const convert_options *options) {
    const char *format = options->write.format;
    if (format == NULL) {
        const char *const dot = strrchr(output, '.');
        format = dot != NULL ? dot + 1 : "exr";
    }
    if (options->toned && strcasecmp(format, "png") != 0) {
        cli_bad_usage("convert: --exposure and --tone are for PNG: %s holds radiance as it is", format);
        return false;
    }
    if (options->write.half && strcasecmp(format, "exr") != 0) {
        cli_bad_usage("convert: --half is for EXR, not %s", format);
        return false;
    }
    return true;
}

static int run(int argc, char **argv) {
    convert_options options;
    if (!parse_options(argc, argv, &options))
        return CLI_BAD_INPUT;
    const char *const input = argv[optind];
    const char *const output = argv[optind + 1];
    if (!options_fit(output, &options))
        return CLI_BAD_INPUT;
    aur_image *image = NULL;
    const int status = cli_read_picture(input, options.channels, &image);
    if (status != CLI_SUCCESS)
        return status;
    aur_error error;
    aur_image *smaller = NULL;
    aur_result result = AUR_OK;
    if (options.downsample > 1)
        result = aur_image_downsample(image, options.downsample, &smaller, &error);
    if (result == AUR_OK)
        result = aur_image_write(output, smaller != NULL ? smaller : image, &options.write, &error);
    aur_image_destroy(smaller);
    aur_image_destroy(image);
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(&error);
}

const cli_verb cli_verb_convert = {
    "convert", "IN OUT [options]", "convert a picture between EXR, PFM, HDR and PNG",
    "  --exposure STOPS        multiply radiance by 2^STOPS (PNG)\n"
    "  --tone srgb|filmic      the tone curve (PNG; default srgb: radiance 1 is white)\n"
    "  --half                  16-bit floats (EXR; default 32-bit ones)\n"
    "  --channels NAME[,...]   only these channels, in this order\n"
    "  --downsample N          average blocks of N x N pixels\n"
    "  --to exr|pfm|hdr|png    the format, where the name of OUT does not tell\n"
    "\n"
    "JPEG can be read too. The input's format is seen from its content, the output's from its name. '-' is\n"
    "standard input or standard output (EXR unless --to says otherwise).\n",
    run};
