/* Camera, lighting and models of `aureole render`, and the display of images. */
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "program/cli/render/stage.h"

/* "R,G,B", or "#rrggbb" as in HTML. */
static aur_result parse_background(const char *text, void *field, aur_error *error) {
    aur_scene_stage *const stage = field;
    double numbers[3];
    bool good = cli_split_numbers(text, 3, numbers) == 3;
    for (size_t i = 0; good && i < 3; ++i)
        good = numbers[i] >= 0.0 && numbers[i] <= 1e30;
    if (text[0] == '#' && strlen(text) == 7 && strspn(text + 1, "0123456789abcdefABCDEF") == 6) {
        const unsigned long code = strtoul(text + 1, NULL, 16);
        for (size_t i = 0; i < 3; ++i) {
            const double value = (double)(code >> (16 - 8 * i) & 255) / 255.0;
            numbers[i] = value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
        }
        good = true;
    }
    if (!good)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "--background: expected a radiance R,G,B or a colour #rrggbb, not '%s'", text);
    stage->has_background = true;
    memcpy(stage->background, numbers, sizeof numbers);
    return AUR_OK;
}

static aur_result parse_time(const char *text, void *field, aur_error *error) {
    aur_scene_stage *const stage = field;
    stage->has_time = aur_parse_double(text, &stage->time) && fabs(stage->time) < 1e9;
    return stage->has_time
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "--at: expected a time in seconds, not '%s'", text);
}

const cli_option cli_stage_options[] = {
    {CLI_TEXT(cli_stage, stage.camera, "camera", "VIEW", NULL,
              "front, back, left, right, top, bottom, corner, iso or AZIMUTH,ELEVATION: a camera that shows "
              "the full scene; X,Y,Z,X,Y,Z[,FOV]: position, target, vertical field of view in degrees; or a "
              "view of "
              "Radiance, also without --camera: -vp X Y Z -vd X Y Z -vu X Y Z -vh DEGREES -vv DEGREES")},
    {CLI_TEXT(cli_stage, stage.environment, "environment", "NAME", NULL,
              "environment light: studio, sky[:TURBIDITY], none, or a latitude-longitude environment map "
              "(.exr, .hdr)"),
     .content = "file"},
    {CLI_CHOICE(cli_stage, stage.ground, "ground", "KIND", "auto",
                "add a ground plane that catches shadows; auto: with studio and sky"),
     .key.words = (const char *const[]){"auto", "shadow", "none", NULL}},
    {CLI_TEXT(cli_stage, stage, "background", "COLOR", NULL,
              "background that the camera sees instead of the environment: #rrggbb or a radiance R,G,B"),
     .parse = parse_background},
    {CLI_TEXT(cli_stage, stage, "at", "SECONDS", NULL,
              "show a model as its first animation has it at this time; without it at rest"),
     .parse = parse_time},
    {CLI_TEXT(cli_stage, stage.variant, "variant", "NAME", NULL,
              "material variant of a glTF model (KHR_materials_variants)")},
    {CLI_CHOICE(cli_stage, stage.up, "up", "AXIS", "auto",
                "upward axis for views, environments, the ground and rotations; auto: z for a .stl and "
                "Radiance files, else y"),
     .key.words = (const char *const[]){"auto", "y", "z", NULL}},
    {.key = {0}}};

/* Does not open it: opening a pipe would block or consume its data. */
static bool exists(const char *path) {
    struct stat status;
    return stat(path, &status) == 0;
}

aur_result cli_stage_read_files(cli_stage *given, const cli_call *call, aur_error *error) {
    aur_scene_stage *const stage = &given->stage;
    for (size_t i = 0; i < call->operand_count; ++i) {
        char *const name = call->operands[i];
        char *const at = exists(name) ? NULL : strrchr(name, '@');
        double numbers[5] = {0.0, 0.0, 0.0, 0.0, 1.0};
        const size_t count = at != NULL ? cli_split_numbers(at + 1, 5, numbers) : 0;
        if (i == CLI_FILE_LIMIT)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "more than %d files", (int)CLI_FILE_LIMIT);
        if (i > 0)
            given->further[i - 1] = name;
        if (at == NULL)
            continue;
        if (count < 3 || !(numbers[4] > 0.0))
            return aur_fail(
                error, AUR_ERROR_ARGUMENT,
                "'%s': expected FILE@X,Y,Z[,TURN[,SCALE]]: a shift, degrees, and a factor above 0", name);
        *at = '\0'; /* an argument of the program */
        given->placements[stage->placement_count++] =
            (aur_scene_placement){i, {numbers[0], numbers[1], numbers[2]}, numbers[3], numbers[4]};
    }
    stage->placements = given->placements;
    return AUR_OK;
}

/* --- the image */

static aur_result parse_exposure(const char *text, void *field, aur_error *error) {
    cli_display *const display = (cli_display *)(void *)((char *)field - offsetof(cli_display, exposure));
    double value = 0.0;
    display->is_given = true;
    display->automatic = strcmp(text, "auto") == 0;
    if (!display->automatic && (!aur_parse_double(text, &value) || !(fabs(value) <= 100.0)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "--exposure: expected auto or stops from -100 to 100, not '%s'", text);
    display->exposure = (float)value;
    return AUR_OK;
}

const cli_option cli_display_options[] = {
    {CLI_TEXT(
         cli_display, exposure, "exposure", "STOPS", "0, or auto for models too bright or dim",
         "multiply radiance by 2^STOPS (PNG, JPEG); auto: scale the geometric mean of the luminance to .18"),
     .parse = parse_exposure, .key.computed = true},
    {CLI_CHOICE(cli_display, tone, "tone", "CURVE", "srgb",
                "tone curve (PNG, JPEG); radiance 1 is white by default"),
     .key.words = (const char *const[]){"srgb", "filmic", NULL}},
    {.key = {0}}};

/* Automatic exposure in stops; 0 for images without light. */
static double automatic_exposure(const aur_image *image) {
    size_t channels[3], count = 0;
    double sum = 0.0;
    if (!aur_image_color_channels(image, channels))
        return 0.0;
    const size_t width = aur_image_width(image), height = aur_image_height(image);
    const size_t channel_count = aur_image_channel_count(image);
    const float *const data = aur_image_data(image);
    for (size_t i = 0; i < width * height; ++i) {
        const float *const pixel = data + i * channel_count;
        const double luminance = 0.212671 * (double)pixel[channels[0]] +
                                 0.715160 * (double)pixel[channels[1]] +
                                 0.072169 * (double)pixel[channels[2]];
        if (!(luminance > 0.0 && luminance < HUGE_VAL))
            continue;
        sum += log2(luminance);
        ++count;
    }
    return count > 0 ? log2(0.18) - sum / (double)count : 0.0;
}

const char *cli_display_conflict(const cli_display *display, const char *output) {
    const aur_row *format;
    const bool plain = !display->automatic && display->exposure == 0.0f && display->tone == AUR_TONE_SRGB;
    if (plain || aur_image_find_writer(output, NULL, &format, NULL) != AUR_OK ||
        aur_row_find_key(format, "exposure") != NULL)
        return NULL;
    return "render: '--exposure' and '--tone' need a .png or .jpg output: 'aureole convert' applies them "
           "to other files";
}

/* At more stops from the automatic exposure, most pixels without exposure are white or black. */
static const double TOO_FAR = 4.0;

aur_result cli_display_write(const cli_display *display, const char *scene, const char *output,
                             const aur_image *image, const aur_warnings *warnings, aur_error *error) {
    aur_image_write_options options = {.size = sizeof options};
    const aur_row *format;
    aur_image_write_options_init(&options, NULL);
    const double automatic = automatic_exposure(image);
    const bool adapts = !display->is_given && fabs(automatic) > TOO_FAR && aur_scene_is_name(scene) &&
                        aur_image_find_writer(output, NULL, &format, NULL) == AUR_OK &&
                        aur_row_find_key(format, "exposure") != NULL;
    options.exposure = display->automatic || adapts ? (float)automatic : display->exposure;
    options.tone = display->tone;
    if (adapts && warnings->function != NULL) {
        char text[128];
        aur_format(
            text, sizeof text,
            "the light of the model is too bright or too dim for an image: this one has --exposure %.3g",
            automatic);
        warnings->function(warnings->user, text);
    }
    return aur_image_write(output, image, &options, error);
}
