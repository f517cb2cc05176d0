/* aureole convert: converts between image formats. */
#include <string.h>

#include "program/cli/render/image_input.h"

typedef struct convert_options {
    aur_image_write_options write;
    double falsecolor; /* the upper end of the scale */
    bool contours;
    cli_image_input input;
} convert_options;

static const cli_option options[] = {
    {CLI_REAL(convert_options, write.exposure, "exposure", "STOPS", -100, 100, "0",
              "multiply radiance by 2^STOPS (PNG, JPEG)")},
    {CLI_CHOICE(convert_options, write.tone, "tone", "CURVE", "srgb",
                "tone curve (PNG, JPEG); radiance 1 is white by default"),
     .key.words = (const char *const[]){"srgb", "filmic", NULL}},
    {CLI_FLAG(convert_options, write.half, "half", "write 16-bit floats instead of 32-bit ones (EXR)")},
    {CLI_TEXT(convert_options, write.format, "to", "FORMAT", NULL,
              "output format, if the extension of OUT does not select it"),
     .name = cli_image_input_format},
    {CLI_REAL(
        convert_options, falsecolor, "falsecolor", "MAX", 0, 1e30, NULL,
        "draw a map of --luminance in false colours with a scale up to MAX cd/m2 (0: the largest): PNG, SVG, "
        "PDF or TeX")},
    {CLI_FLAG(convert_options, contours, "contours",
              "draw contours at round values on the map of --falsecolor")},
    {.key = {0}}};

/* Rejects options that would have no effect. */
static bool options_fit(const cli_call *call, const aur_row *format) {
    static const char *const some[] = {"exposure", "tone", "half"};
    for (size_t i = 0; i < sizeof some / sizeof some[0]; ++i)
        if (cli_given(call, some[i]) != NULL && aur_row_find_key(format, some[i]) == NULL) {
            cli_bad_usage("convert: --%s cannot be used for %s: see 'aureole help image'", some[i],
                          format->name);
            return false;
        }
    return true;
}

static void warn_of_values(const char *path, const aur_image *image, const char *format) {
    if (strcmp(format, "png") == 0)
        cli_warn_of_values(path, image, true, "infinite ones become white, the others black");
    else if (strcmp(format, "hdr") == 0)
        cli_warn_of_values(path, image, true, "infinite ones become the largest of the format, the others 0");
    else
        cli_warn_of_values(path, image, false, "they are written as they are");
}

/* With --luminance a figure format is possible. */
static int draw_map(const cli_call *call, const char *output) {
    convert_options *const given = call->options;
    aur_image *image = NULL;
    aur_error error;
    if (given->input.luminance == CLI_LUMINANCE_NONE)
        return cli_bad_usage("convert: --falsecolor is of --luminance WEIGHTS");
    int status = cli_read_image(call->operands[0], &given->input, &image);
    if (status == CLI_SUCCESS) {
        status = cli_status(cli_image_map(output, image, given->falsecolor, given->contours, &error), &error);
    }
    aur_image_destroy(image);
    return status;
}

static int run(const cli_call *call) {
    convert_options *const given = call->options;
    const char *const output = call->operands[1];
    const aur_row *format;
    aur_error error;
    if (cli_given(call, "falsecolor") != NULL)
        return draw_map(call, output);
    if (given->contours)
        return cli_bad_usage("convert: --contours needs --falsecolor MAX");
    int status = cli_status(aur_image_find_writer(output, given->write.format, &format, &error), &error);
    if (status != CLI_SUCCESS || !options_fit(call, format))
        return CLI_BAD_INPUT;
    aur_image *image = NULL;
    status = cli_read_image(call->operands[0], &given->input, &image);
    if (status == CLI_SUCCESS) {
        warn_of_values(call->operands[0], image, format->name);
        given->write.size = sizeof given->write;
        status = cli_status(aur_image_write(output, image, &given->write, &error), &error);
    }
    aur_image_destroy(image);
    return status;
}

const cli_command cli_command_convert = {
    .name = "convert",
    .summary = "convert an image between EXR, PFM, HDR and PNG",
    .notes = "JPEG can be read and written too. The content of IN determines its format, the extension of "
             "OUT that of the output. '-' is standard input or standard output (EXR unless --to is given).",
    .too_few = "expected one input and one output",
    .too_many = "expected one input and one output",
    .operands = {{"IN", "input image", .content = "file"},
                 {"OUT", "output image", .content = "file", .writes = true}},
    .groups = {{options, 0}, {cli_image_input_options, offsetof(convert_options, input)}},
    .size = sizeof(convert_options),
    .run = run,
};
