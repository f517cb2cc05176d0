/* aureole merge: merges the separately rendered parts of an image. */
#include <aureole-render/render.h>
#include <string.h>

#include "program/cli/options.h"

typedef struct merge_command {
    const char *output;
} merge_command;

static const cli_option options[] = {{CLI_TEXT(merge_command, output, "output", "FILE", NULL,
                                               "output image (.exr, .png, ...; see 'aureole help image')"),
                                      .letter = 'o', .content = "file", .writes = true},
                                     {.key = {0}}};

static int run(const cli_call *call) {
    const merge_command *const command = call->options;
    aur_error error = {0};
    const aur_row *format;
    if (command->output == NULL)
        return cli_bad_usage("merge: no output image given: expected '-o FILE'");
    if (aur_image_find_writer(command->output, NULL, &format, &error) != AUR_OK)
        return cli_bad_usage("-o: %s", error.message);
    aur_film *film = NULL;
    aur_image *image = NULL;
    aur_result result =
        aur_render_merge_parts(call->operand_count, (const char *const *)call->operands, &film, &error);
    if (result == AUR_OK)
        result = aur_film_develop(film, &image, &error);
    if (result == AUR_OK)
        result = aur_image_write(command->output, image, NULL, &error);
    aur_image_destroy(image);
    aur_film_destroy(film);
    return cli_status(result, &error);
}

const cli_command cli_command_merge = {
    .name = "merge",
    .summary = "merge the parts of an image",
    .notes =
        "The parts are files of 'aureole render --shard'. The image is bit-identical to that of one render. "
        "Parts of other scenes, options, seeds or versions, repeated parts and missing parts are refused.",
    .too_few = "no parts given",
    .operands = {{"PART", "a file of 'aureole render --shard i/n'", .repeated = true, .content = "file"}},
    .groups = {{options, 0}},
    .size = sizeof(merge_command),
    .run = run,
};
