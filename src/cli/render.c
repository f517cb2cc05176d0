/* aureole render: a scene to a picture. */
#include <aureole/render.h>
#include <aureole/text.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"
#include "cli/errors.h"

enum { DEFINITION_CAPACITY = 64 };

typedef struct render_command {
    const char *scene;
    char *output;
    size_t definition_count;
    aur_definition definitions[DEFINITION_CAPACITY];
    aur_render_options options;
    const char *reference, *errors;
    bool quiet, statistics;
} render_command;

static bool parse_definition(render_command *command, char *text) {
    char *const equals = strchr(text, '=');
    if (equals == NULL || equals == text) {
        cli_bad_usage("-D: '%s' is not of the form name=value", text);
        return false;
    }
    if (command->definition_count == DEFINITION_CAPACITY) {
        cli_bad_usage("-D: more than %d definitions", DEFINITION_CAPACITY);
        return false;
    }
    *equals = '\0';
    command->definitions[command->definition_count++] = (aur_definition){text, equals + 1};
    return true;
}

static bool parse_crop(const char *text, aur_render_options *options) {
    uint64_t values[4];
    const char *at = text;
    bool good = true;
    for (size_t i = 0; i < 4 && good; ++i) {
        char piece[24] = "";
        const size_t length = strcspn(at, ",");
        good = length < sizeof piece && (at[length] == ',') == (i < 3);
        if (good)
            good = aur_parse_integer(memcpy(piece, at, length), SIZE_MAX, &values[i]);
        at += length + (i < 3);
    }
    if (!good) {
        cli_bad_usage("--crop: '%s' is not of the form x0,x1,y0,y1", text);
        return false;
    }
    if (values[0] >= values[1] || values[2] >= values[3]) {
        cli_bad_usage("--crop: '%s' is empty: x0 < x1 and y0 < y1 are wanted", text);
        return false;
    }
    options->crop_x0 = values[0];
    options->crop_x1 = values[1];
    options->crop_y0 = values[2];
    options->crop_y1 = values[3];
    return true;
}

/* SCENE.exr in the current folder, from the scene's file name. */
static char *default_output(const char *scene) {
    const char *const slash = strrchr(scene, '/');
    const char *const name = slash != NULL ? slash + 1 : scene;
    const char *const dot = strrchr(name, '.');
    const size_t length = dot != NULL && dot != name ? (size_t)(dot - name) : strlen(name);
    char *const output = malloc(length + sizeof ".exr");
    if (output != NULL) {
        memcpy(output, name, length);
        memcpy(output + length, ".exr", sizeof ".exr");
    }
    return output;
}

/* What can be known to fail is said before an hour is spent. */
static bool check_output(const char *path) {
    static const char *const extensions[] = {".exr", ".pfm", ".hdr", ".png"};
    const char *const dot = strrchr(path, '.');
    bool known = false;
    for (size_t i = 0; i < sizeof extensions / sizeof extensions[0]; ++i)
        known = known || (dot != NULL && strcmp(dot, extensions[i]) == 0);
    if (!known) {
        cli_bad_usage("-o: '%s' must end in .exr, .pfm, .hdr or .png", path);
        return false;
    }
    return true;
}

static bool folder_is_writable(const char *path) {
    char folder[AUR_ERROR_FILE_CAPACITY];
    const char *const slash = strrchr(path, '/');
    if (slash == NULL)
        snprintf(folder, sizeof folder, ".");
    else
        snprintf(folder, sizeof folder, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    return access(folder, W_OK | X_OK) == 0;
}

static bool parse(int argc, char **argv, render_command *command) {
    enum { SPP = 256, SEED, CROP, FILTER, INTEGRATOR, SAMPLER, STATS, WIDTH, HEIGHT, REFERENCE, ERRORS };
    static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                            {"threads", required_argument, NULL, 't'},
                                            {"quiet", no_argument, NULL, 'q'},
                                            {"verbose", no_argument, NULL, 'v'},
                                            {"spp", required_argument, NULL, SPP},
                                            {"seed", required_argument, NULL, SEED},
                                            {"crop", required_argument, NULL, CROP},
                                            {"filter", required_argument, NULL, FILTER},
                                            {"integrator", required_argument, NULL, INTEGRATOR},
                                            {"sampler", required_argument, NULL, SAMPLER},
                                            {"stats", no_argument, NULL, STATS},
                                            {"width", required_argument, NULL, WIDTH},
                                            {"height", required_argument, NULL, HEIGHT},
                                            {"reference", required_argument, NULL, REFERENCE},
                                            {"errors", required_argument, NULL, ERRORS},
                                            {NULL, 0, NULL, 0}};
    enum { LARGEST_SIDE = 65536 };
    aur_render_options *const o = &command->options;
    const char *output = NULL;
    int option;
    optind = 0;
    while ((option = cli_next_option(argc, argv, "o:D:t:qv", options)) != -1) {
        bool good = true;
        switch (option) {
        case 'o':
            output = optarg;
            break;
        case 'D':
            good = parse_definition(command, optarg);
            break;
        case 't':
            good = cli_parse_size("-t", optarg, 1, 1024, &o->threads);
            break;
        case 'q':
            command->quiet = true;
            break;
        case 'v':
        case STATS:
            command->statistics = true;
            break;
        case SPP:
            good = cli_parse_size("--spp", optarg, 1, (size_t)1 << 30, &o->samples_per_pixel);
            break;
        case SEED:
            good = cli_parse_u64("--seed", optarg, &o->seed);
            break;
        case CROP:
            good = parse_crop(optarg, o);
            break;
        case FILTER:
            o->filter = optarg;
            break;
        case INTEGRATOR:
            o->integrator = optarg;
            break;
        case SAMPLER:
            o->sampler = optarg;
            break;
        case WIDTH:
            good = cli_parse_size("--width", optarg, 1, LARGEST_SIDE, &o->width);
            break;
        case HEIGHT:
            good = cli_parse_size("--height", optarg, 1, LARGEST_SIDE, &o->height);
            break;
        case REFERENCE:
            command->reference = optarg;
            break;
        case ERRORS:
            command->errors = optarg;
            break;
        default:
            return false;
        }
        if (!good)
            return false;
    }
    if (argc - optind != 1) {
        cli_bad_usage(argc == optind ? "render: a scene is missing: try 'aureole help render'"
                                     : "render: one scene at a time");
        return false;
    }
    if ((command->reference == NULL) != (command->errors == NULL)) {
        cli_bad_usage("render: '--reference' and '--errors' are wanted together");
        return false;
    }
    command->scene = argv[optind];
    command->output = output != NULL ? strdup(output) : default_output(command->scene);
    return command->output != NULL && check_output(command->output);
}

static void print_statistics(const aur_render *render) {
    aur_render_statistics counted = {.size = sizeof counted};
    aur_render_get_statistics(render, &counted, NULL);
    const aur_render_statistics *const statistics = &counted;
    const double seconds = statistics->prepare_seconds + statistics->render_seconds;
    fprintf(stderr,
            "aureole: %" PRIu64 " samples, %" PRIu64
            " rays, prepared in %.2f s, rendered in %.2f s (%.2f Mray/s), "
            "%.2f CPU s, %" PRIu64 " invalid samples\n",
            statistics->samples, statistics->rays, statistics->prepare_seconds, statistics->render_seconds,
            seconds > 0 ? 1e-6 * (double)statistics->rays / seconds : 0.0, statistics->cpu_seconds,
            statistics->invalid_samples);
    for (size_t l = 0; l < AUR_RENDER_LEVELS; ++l)
        if (statistics->levels[l] > 0)
            fprintf(stderr, "aureole: %" PRIu64 " gathers ended at level %zu\n", statistics->levels[l],
                    l + 1);
}

static aur_result check_folder(const char *path, aur_error *error) {
    if (folder_is_writable(path))
        return AUR_OK;
    error->result = AUR_ERROR_WRITE;
    snprintf(error->file, sizeof error->file, "%s", path);
    snprintf(error->message, sizeof error->message,
             "cannot write: its folder does not exist or is read-only");
    return AUR_ERROR_WRITE;
}

/* All samples, in the steps that the errors ask for; *image is what there is in the end. */
static aur_result render_samples(aur_render *render, cli_errors *errors, aur_image **image,
                                 aur_error *error) {
    const aur_result result =
        errors != NULL ? cli_errors_render(errors, render, error) : aur_render_step(render, 0, error);
    return result == AUR_OK ? aur_film_develop(aur_render_film(render), image, error) : result;
}

static int render(const render_command *command, cli_errors *errors) {
    aur_error error = {0};
    if (check_folder(command->output, &error) != AUR_OK ||
        (errors != NULL && strcmp(command->errors, "-") != 0 &&
         check_folder(command->errors, &error) != AUR_OK))
        return cli_fail(&error);
    const aur_scene_options scene_options = {.size = sizeof scene_options,
                                             .definition_count = command->definition_count,
                                             .definitions = command->definitions,
                                             .warnings = command->options.warnings};
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    aur_render *work = NULL;
    aur_image *image = NULL;
    aur_result result = aur_scene_load(command->scene, &scene_options, &scene, &error);
    if (result == AUR_OK)
        result = aur_renderer_create(scene, &renderer, &error);
    if (result == AUR_OK)
        result = aur_render_create(renderer, &command->options, &work, &error);
    if (result == AUR_OK)
        result = render_samples(work, errors, &image, &error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = aur_image_write(command->output, image, NULL, &error);
    if (result == AUR_OK && errors != NULL)
        result = cli_errors_write(errors, command->errors, &error);
    if (result == AUR_OK && command->statistics)
        print_statistics(work);
    aur_image_destroy(image);
    aur_render_destroy(work);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(&error);
}

static int run(int argc, char **argv) {
    render_command command = {.options = aur_render_options_default()};
    int status = CLI_BAD_INPUT;
    if (parse(argc, argv, &command)) {
        command.options.progress = cli_progress(command.quiet);
        command.options.warnings = cli_warnings(command.quiet);
        cli_errors *const errors = command.reference != NULL ? cli_errors_create(command.reference) : NULL;
        if (errors != NULL || command.reference == NULL)
            status = render(&command, errors);
        cli_errors_destroy(errors);
    }
    free(command.output);
    return status;
}

const cli_verb cli_verb_render = {
    "render", "SCENE.xml [-o OUT.exr|.pfm|.hdr|.png] [options]", "render a picture of a scene",
    "  -o FILE             where the picture goes (default: SCENE.exr in the current folder)\n"
    "  -D NAME=VALUE       set a <default> of the scene; may be repeated\n"
    "  --integrator SPEC   NAME[:key=value,...] instead of the scene's integrator\n"
    "  --sampler SET       instead of the scene's sampler ('aureole sets' lists them)\n"
    "  --filter NAME       instead of the scene's ('aureole help filter' lists them)\n"
    "  --spp N             samples a pixel\n"
    "  --width N, --height N  size of the whole picture in pixels\n"
    "  --crop x0,x1,y0,y1  render the pixels x0 <= x < x1, y0 <= y < y1 only\n"
    "  --seed N            of all random numbers (default 0)\n"
    "  -t N                threads (default: all); the picture does not depend on it\n"
    "  --reference REF --errors CSV  samples, rays, CPU seconds and RMSE against the picture REF after 1, "
    "2,\n"
    "                      4, ... samples a pixel\n"
    "  --stats, -v         say how many rays and how much time it took\n"
    "  -q                  no progress bar and no warnings\n",
    run};
