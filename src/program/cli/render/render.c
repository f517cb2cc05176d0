/* aureole render: renders a scene to an image. */
#include <aureole-render/render.h>
#include <aureole/ranks.h>
#include <aureole/text.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/options.h"
#include "program/cli/render/denoise.h"
#include "program/cli/render/render_result.h"
#include "program/cli/render/stage.h"
#include "program/lab/gather.h"

typedef struct render_command {
    const char *output;
    cli_definitions definitions;
    aur_render_options options;
    const char *reference, *errors;
    cli_stage stage;
    cli_display display;
    size_t file_count;
    cli_target target;
    cli_checkpoint checkpoint;
    cli_watch watch;
    cli_denoise denoise;
    bool statistics, json;
    size_t texture_memory;
    cli_render_end end;
    const aur_scene *scene;
    cli_common common;
} render_command;

enum { LARGEST_SIDE = 65536 };

/* "x0,x1,y0,y1" */
static aur_result parse_crop(const char *text, void *field, aur_error *error) {
    aur_render_options *const options = field;
    size_t *const ends[] = {&options->crop_x0, &options->crop_x1, &options->crop_y0, &options->crop_y1};
    const char *at = text;
    bool good = true;
    for (size_t i = 0; i < 4 && good; ++i) {
        char piece[24] = "";
        const size_t length = strcspn(at, ",");
        good = length < sizeof piece && (at[length] == ',') == (i < 3);
        uint64_t value = 0;
        if (good)
            good = aur_parse_integer(memcpy(piece, at, length), SIZE_MAX, &value);
        *ends[i] = (size_t)value;
        at += length + (i < 3);
    }
    if (!good)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "--crop: '%s' is not of the form x0,x1,y0,y1", text);
    if (options->crop_x0 >= options->crop_x1 || options->crop_y0 >= options->crop_y1)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "--crop: '%s' is empty: x0 must be below x1 and y0 below y1", text);
    return AUR_OK;
}

/* "i/n" */
static aur_result parse_shard(const char *text, void *field, aur_error *error) {
    enum { MOST_SHARDS = 1000000 };
    aur_render_options *const options = field;
    char piece[24] = "";
    const size_t length = strcspn(text, "/");
    uint64_t shard = 0, count = 0;
    const bool good = length < sizeof piece && text[length] == '/' &&
                      aur_parse_integer(memcpy(piece, text, length), MOST_SHARDS, &shard) &&
                      aur_parse_integer(text + length + 1, MOST_SHARDS, &count);
    if (!good || shard == 0 || shard > count)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "--shard: expected i/n with i from 1 to n, such as 2/3, not '%s'", text);
    options->shard = (size_t)shard;
    options->shard_count = (size_t)count;
    return AUR_OK;
}

static aur_result parse_texture_memory(const char *text, void *field, aur_error *error) {
    return cli_parse_bytes("texture-memory", text, field, error);
}

static const cli_option options[] = {
    {CLI_TEXT(render_command, output, "output", "FILE", "SCENE.exr in the current folder",
              "output image (.exr, .png, ...; see 'aureole help image'); - writes EXR to standard output"),
     .letter = 'o', .key.computed = true, .content = "file", .writes = true},
    {CLI_TEXT(render_command, options.integrator, "integrator", "SPEC", NULL,
              "use this integrator, NAME[:key=value,...], instead of the scene's"),
     .content = "integrator"},
    {CLI_TEXT(render_command, options.sampler, "sampler", "SET", NULL,
              "use this point set instead of the scene's sampler (see 'aureole sets')"),
     .content = "set"},
    {CLI_TEXT(render_command, options.filter, "filter", "NAME", NULL,
              "use this reconstruction filter instead of the scene's (see 'aureole help rfilter')"),
     .content = "rfilter"},
    {CLI_INTEGER(render_command, options.samples_per_pixel, "samples", "N", 1, 1 << 30, "the scene's",
                 "samples per pixel (another name: spp)"),
     .key.computed = true},
    {CLI_INTEGER(render_command, options.width, "width", "N", 1, LARGEST_SIDE, "the scene's",
                 "width of the full image in pixels; if only the width or the height is given, the aspect "
                 "ratio is kept"),
     .key.computed = true},
    {CLI_INTEGER(render_command, options.height, "height", "N", 1, LARGEST_SIDE, "the scene's",
                 "height of the full image in pixels"),
     .key.computed = true},
    {CLI_REAL(render_command, options.clamp, "clamp", "C", 0, 1e30, "0",
              "clamp the indirect contribution to a sample of path or volpath (0: no limit); the light that "
              "is lost is estimated and reported")},
    {CLI_TEXT(render_command, options, "crop", "X0,X1,Y0,Y1", NULL,
              "render only the pixels X0 <= x < X1, Y0 <= y < Y1"),
     .parse = parse_crop},
    {CLI_TEXT(
         render_command, options, "shard", "I/N", NULL,
         "render only part I of N, to SCENE.I-of-N.part or the file of -o; 'aureole merge' merges the parts"),
     .parse = parse_shard},
    {CLI_TEXT(render_command, texture_memory, "texture-memory", "SIZE", "all",
              "memory for image textures, such as 500M, from 4M; the rest is read from a temporary file in "
              "$TMPDIR or /var/tmp"),
     .parse = parse_texture_memory, .key.computed = true},
    {CLI_INTEGER(render_command, options.seed, "seed", "N", 0, INFINITY, "0", "random seed")},
    {CLI_TEXT(render_command, reference, "reference", "REF", NULL,
              "reference image of --errors, rendered with another seed"),
     .content = "file"},
    {CLI_TEXT(
         render_command, errors, "errors", "CSV", NULL,
         "write samples, rays, CPU seconds and RMSE to the reference after 1, 2, 4, ... samples per pixel"),
     .content = "file", .writes = true},
    {CLI_FLAG(render_command, statistics, "stats", "print ray counts and timings")},
    {CLI_FLAG(render_command, statistics, "verbose", "same as --stats"), .letter = 'v'},
    {CLI_FLAG(render_command, json, "json",
              "print ray counts, timings and the error as JSON on standard output")},
    {.key = {0}}};

/* SCENE.exr in the current folder, from the scene's file name; SCENE.i-of-n.part for a shard. */
static void default_output(const char *scene, const aur_render_options *part, size_t capacity, char *output) {
    const char *const slash = strrchr(scene, '/');
    const char *const name = slash != NULL ? slash + 1 : scene;
    const char *const dot = strrchr(name, '.');
    const size_t length = dot != NULL && dot != name ? (size_t)(dot - name) : strlen(name);
    if (part->shard_count > 0)
        snprintf(output, capacity, "%.*s.%zu-of-%zu.part", (int)length, name, part->shard, part->shard_count);
    else
        snprintf(output, capacity, "%.*s.exr", (int)length, name);
}

/* The samples of the next step: all remaining ones, or with progress display until every pixel has 1, 2, 4,
 * ... samples. Otherwise two halves, if the result is bit-identical: their difference estimates the error. */
static size_t next_step(const aur_render *render, bool displayed) {
    const size_t done = aur_render_samples(render);
    if (displayed)
        return done > 0 ? done : 1;
    return done == 0 && aur_render_steps_agree(render) ? aur_render_samples_target(render) / 2 : 0;
}

static aur_result render_steps(aur_render *render, render_command *command, cli_errors *errors,
                               aur_error *error) {
    const bool displayed =
        errors != NULL || (cli_watch_is_requested(&command->watch) && aur_render_steps_agree(render));
    aur_result result = AUR_OK;
    while (result == AUR_OK && aur_render_samples(render) < aur_render_samples_target(render)) {
        result = cli_watch_step(&command->watch, render, next_step(render, displayed), error);
        if (result == AUR_OK && errors != NULL)
            result = cli_errors_note(errors, render, error);
    }
    command->end = (cli_render_end){aur_render_samples(render), cli_relative_error(aur_render_film(render))};
    return result;
}

static aur_result print_json(const aur_render *render, const render_command *command, const aur_image *image,
                             aur_error *error) {
    aur_scene_description scene = {.size = sizeof scene};
    aur_scene_get_description(command->scene, &scene, NULL);
    cli_render_summary summary = {
        .output = command->output,
        .integrator = command->options.integrator != NULL ? command->options.integrator : scene.integrator,
        .error = command->end.error > 0.0 ? command->end.error : NAN,
        .error_low = NAN,
        .error_high = NAN,
        .bias_high = NAN,
        .mean = NAN,
        .rounds = NAN,
        .samples_per_pixel = (double)command->end.samples,
        .clamped = cli_clamped_part(image),
        .statistics.size = sizeof summary.statistics};
    aur_render_get_statistics(render, &summary.statistics, NULL);
    return cli_print_json(&summary, error);
}

/* Renders all samples; *image is the result, partial if cancelled. The caller always destroys *render. */
static aur_result render_samples(aur_renderer *renderer, render_command *command, cli_errors *errors,
                                 aur_render **created, aur_image **image, aur_error *error) {
    aur_result result = aur_render_create(renderer, &command->options, created, error);
    aur_render *const render = *created;
    if (result == AUR_OK)
        result = cli_checkpoint_begin(&command->checkpoint, render, NULL, command->common.quiet, error);
    const bool started = result == AUR_OK;
    if (started) {
        cli_watch_show(&command->watch, render, NULL);
        result = render_steps(render, command, errors, error);
        cli_watch_hide(&command->watch);
    }
    cli_progress_clear();
    if (started && result != AUR_OK && result != AUR_ERROR_CANCELLED)
        cli_checkpoint_end(&command->checkpoint, false);
    if (started && (result == AUR_OK || result == AUR_ERROR_CANCELLED)) {
        const aur_result developed = aur_film_develop(aur_render_film(render), image, error);
        result = developed != AUR_OK ? developed : result;
    }
    if (result == AUR_OK && command->options.shard_count > 0)
        result = aur_render_save(render, command->output, error);
    if (result == AUR_OK && command->statistics) {
        cli_print_statistics(render);
    }
    if (result == AUR_OK && command->json && aur_ranks_rank() == 0)
        result = print_json(render, command, *image, error);
    return result;
}

/* In units of a photon's or particle's time: a sample of a pixel takes three. */
static void plan(const render_command *command) {
    static cli_phase phases[] = {{"photons", 5e5}, {"rendering", 0.0}};
    aur_scene_description scene = {.size = sizeof scene};
    aur_scene_get_description(command->scene, &scene, NULL);
    const aur_render_options *const given = &command->options;
    const double width = (double)(given->width > 0 ? given->width : scene.width),
                 height = given->height > 0 ? (double)given->height
                          : scene.width > 0 ? width * (double)scene.height / (double)scene.width
                                            : width,
                 samples = (double)(given->samples_per_pixel > 0 ? given->samples_per_pixel
                                                                 : scene.samples_per_pixel);
    const char *const integrator = given->integrator != NULL ? given->integrator : scene.integrator;
    if (strncmp(integrator, "radiosity", strlen("radiosity")) == 0)
        phases[0].what = "radiosity";
    phases[1].work = 3.0 * width * height * samples;
    cli_progress_plan(sizeof phases / sizeof phases[0], phases);
}

/* Detects errors in the output before a long render. */
static bool check_output(const char *path) {
    aur_error error;
    const aur_row *format;
    const bool writable = aur_image_find_writer(path, NULL, &format, &error) == AUR_OK;
    if (!writable)
        cli_bad_usage("-o: %s", error.message);
    return writable;
}

static void print_clamped(const aur_image *image) {
    const double clamped = cli_clamped_part(image);
    if (clamped > 0.0)
        aur_print(stderr, "aureole: --clamp removed %.2g %% of the light (an estimate of the bias)\n",
                  100.0 * clamped);
}

static void print_end(render_command *command, const aur_image *image) {
    if (command->denoise.enabled)
        command->end.error = 0.0; /* the estimate applies to the noisy image */
    if (command->options.shard_count > 0)
        aur_print(stderr, "aureole: wrote the part %s; 'aureole merge' merges all parts\n", command->output);
    else
        cli_report_image(command->output, image, &command->end);
}

/* Opens the outputs before the computation, so that errors are reported immediately. */
static aur_result begin(render_command *command, aur_error *error) {
    aur_result result = command->checkpoint.path != NULL
                            ? aur_render_check_checkpoint(command->checkpoint.path, error)
                            : AUR_OK;
    if (result == AUR_OK)
        result = cli_denoise_begin(&command->denoise, error);
    if (result != AUR_OK)
        return result;
    result = cli_watch_begin(&command->watch, command->output, error);
    if (result != AUR_OK)
        cli_denoise_end(&command->denoise);
    if (command->checkpoint.path == NULL && command->errors == NULL && command->options.shard_count == 0)
        cli_watch_allow_turns(&command->watch);
    command->options.progress = cli_checkpoint_progress(
        &command->checkpoint,
        cli_watch_progress(&command->watch, cli_progress_of_resumable(command->common.quiet)));
    return result;
}

static aur_result denoise(const render_command *command, aur_renderer *renderer, aur_adaptive *adaptive,
                          aur_image **image, aur_error *error) {
    aur_error_figures halves;
    const aur_result result = cli_denoise_image(&command->denoise, renderer, &command->options, adaptive,
                                                command->target.error > 0.0, image, &halves, error);
    if (result == AUR_OK && !command->common.quiet && halves.high > 0.0)
        cli_report_denoised(&halves, command->target.measure);
    return result;
}

static aur_scene_options loading(const render_command *command) {
    return (aur_scene_options){.size = sizeof(aur_scene_options),
                               .definition_count = command->definitions.count,
                               .definitions = command->definitions.items,
                               .confine = command->definitions.confine,
                               .diffuse = command->definitions.diffuse,
                               .further_count = command->file_count - 1,
                               .further = command->stage.further,
                               .stage = command->stage.stage,
                               .texture_memory = command->texture_memory,
                               .model_light = command->definitions.model_light,
                               .progress = command->options.progress,
                               .threads = command->common.threads,
                               .warnings = command->options.warnings};
}

/* Objects of a render, in the order of their destruction. */
typedef struct rendered {
    aur_image *image;
    aur_adaptive *adaptive;
    aur_render *work;
    aur_renderer *renderer;
} rendered;

static void release(rendered *created) {
    aur_image_destroy(created->image);
    aur_adaptive_destroy(created->adaptive);
    aur_render_destroy(created->work);
    aur_renderer_destroy(created->renderer);
    *created = (rendered){NULL};
}

static aur_result render_once(aur_scene *scene, render_command *command, cli_errors *errors,
                              rendered *created, aur_error *error) {
    const cli_render_services services = {&command->checkpoint,  &command->watch, command->output,
                                          command->common.quiet, command->json,   command->statistics};
    const aur_result result = aur_renderer_create(scene, &created->renderer, error);
    if (result != AUR_OK)
        return result;
    return cli_is_target(&command->target)
               ? cli_render_target(created->renderer, &command->options, &command->target, &services,
                                   &created->adaptive, &created->image, error)
               : render_samples(created->renderer, command, errors, &created->work, &created->image, error);
}

static int render(const char *path, render_command *command, cli_errors *errors) {
    aur_error error = {0};
    aur_result result = begin(command, &error);
    if (result != AUR_OK)
        return cli_fail(&error);
    const aur_scene_options scene_options = loading(command);
    aur_scene *scene = NULL;
    rendered created = {NULL};
    result = aur_scene_load(path, &scene_options, &scene, &error);
    command->scene = scene;
    if (result == AUR_OK && !cli_is_target(&command->target)) /* progress with a single phase */
        plan(command);
    while (result == AUR_OK) {
        result = render_once(scene, command, errors, &created, &error);
        if (!cli_watch_turn(&command->watch, result, scene, created.image))
            break;
        release(&created);
        command->options.use_cache = false; /* the cache may hold results for the previous camera */
        result = AUR_OK;
    }
    if (result == AUR_OK)
        result = denoise(command, created.renderer, created.adaptive, &created.image, &error);
    cli_progress_clear();
    if (result == AUR_ERROR_CANCELLED && created.image != NULL)
        cli_write_partial(command->output, created.image);
    if (result == AUR_OK && command->options.shard_count == 0)
        result = cli_display_write(&command->display, path, command->output, created.image,
                                   &command->options.warnings, &error);
    cli_checkpoint_end(&command->checkpoint,
                       true); /* the image is written, or the checkpoint is its only copy */
    if (result == AUR_OK)
        result = cli_denoise_write_noisy(&command->denoise, command->output, created.image, &error);
    if (result == AUR_OK && errors != NULL)
        result = cli_errors_write(errors, command->errors, &error);
    if (result == AUR_OK && !command->common.quiet && created.image != NULL)
        print_clamped(created.image);
    if (result == AUR_OK && !command->common.quiet &&
        !cli_is_target(&command->target)) /* printed by cli_render_target */
        print_end(command, created.image);
    if (result == AUR_OK && !command->common.quiet && created.image != NULL)
        cli_explain_black(scene, created.image);
    cli_watch_end(&command->watch, created.image, result, &error);
    cli_denoise_end(&command->denoise);
    release(&created);
    aur_scene_destroy(scene);
    return cli_status(result, &error);
}

/* Returns NULL, or a message if options conflict. */
static const char *conflict(const cli_call *call, const render_command *command) {
    if ((command->reference == NULL) != (command->errors == NULL))
        return "render: '--reference' and '--errors' must be given together";
    if (command->reference != NULL && command->checkpoint.path != NULL)
        return "render: '--checkpoint' cannot be used with '--errors'";
    if (command->options.shard_count > 0 && (cli_is_target(&command->target) || command->reference != NULL))
        return "render: '--shard' cannot be used with '--error', '--time', '--rays', '--rounds' or "
               "'--errors', which need the full image";
    if (command->options.shard_count > 0 && command->denoise.enabled)
        return "render: '--denoise' cannot be used with '--shard': it needs the full image";
    if (command->json && command->output != NULL && strcmp(command->output, "-") == 0)
        return "render: '--json' and the image cannot both be written to standard output";
    const char *const checkpoint = cli_checkpoint_conflict(call);
    if (checkpoint != NULL)
        return checkpoint;
    if (command->target.bias > 0.0 && !cli_is_target(&command->target))
        return "render: '--bias' needs '--error', '--time', '--rays' or '--rounds'";
    if (command->target.measure != AUR_ERROR_MEASURE_RELATIVE && !cli_is_target(&command->target))
        return "render: '--error-measure' needs '--error', '--time', '--rays' or '--rounds'";
    if (!cli_is_target(&command->target))
        return command->target.error_map ? "render: '--error-map' needs '--error', '--time' or '--rays'"
                                         : NULL;
    if (command->reference != NULL)
        return "render: '--errors' cannot be used with '--error', '--time', '--rays' or '--rounds'";
    if (cli_given(call, "samples") != NULL)
        return "render: '--samples' cannot be used with '--error', '--time', '--rays' or "
               "'--rounds', which choose the samples";
    return NULL;
}

/* Checks the image's output before the computation. */
static int announce(const cli_call *call, render_command *command, char output[PATH_MAX]) {
    default_output(call->operands[0], &command->options, PATH_MAX, output);
    if (command->output == NULL) {
        aur_error error;
        command->output = output;
        if (cli_announce_output(output, &error) != AUR_OK)
            return cli_fail(&error);
    }
    if (command->options.shard_count == 0 && !check_output(command->output))
        return CLI_BAD_INPUT;
    const char *const conflicting = cli_display_conflict(&command->display, command->output);
    return conflicting != NULL ? cli_bad_usage("%s", conflicting) : CLI_SUCCESS;
}

static int run(const cli_call *call) {
    render_command *const command = call->options;
    const char *const scene = call->operands[0];
    char output[PATH_MAX];
    const char *const conflicting = conflict(call, command);
    aur_error bad = {0};
    if (conflicting != NULL)
        return cli_bad_usage("%s", conflicting);
    command->file_count = call->operand_count;
    if (cli_stage_read_files(&command->stage, call, &bad) != AUR_OK)
        return cli_fail(&bad);
    if (command->denoise.enabled) { /* with replicas it is limited by each pixel's standard error */
        command->target.independent_pixels = command->target.error == 0.0;
        command->target.replicas = command->target.error == 0.0 && !command->target.error_map ? 1 : 0;
        command->target.error_map = command->target.replicas == 0;
    }
    if (command->denoise.enabled &&
        command->options.filter == NULL) /* denoisers keep noise that pixels share */
        command->options.filter = "box";
    const int status = announce(call, command, output);
    if (status != CLI_SUCCESS)
        return status;
    if (command->options.width > 0 && command->options.height > 0)
        command->stage.stage.aspect = (double)command->options.width / (double)command->options.height;
    command->options.size = sizeof command->options;
    command->options.threads = command->common.threads;
    command->options.resumable = command->checkpoint.path != NULL || command->options.shard_count > 0;
    command->options.warnings = cli_warnings(command->common.quiet);
    command->options.use_cache = true;
    command->options.gather = &lab_finalgather;
    if (command->reference == NULL)
        return render(scene, command, NULL);
    cli_errors *const errors = cli_errors_create(command->reference);
    const int ended = errors != NULL ? render(scene, command, errors) : CLI_BAD_INPUT;
    cli_errors_destroy(errors);
    return ended;
}

const cli_command cli_command_render = {
    .name = "render",
    .summary = "render a scene to an image",
    .too_few = "no scene given",
    .operands = {{"SCENE", "scene file: Mitsuba XML, Radiance .rad, or a model such as .glb",
                  .content = "file"},
                 {"MODEL",
                  "further models; FILE@X,Y,Z[,TURN[,SCALE]] translates a model, rotates it about the up "
                  "axis by TURN degrees, and scales it",
                  .optional = true, .repeated = true, .content = "file"}},
    .groups = {{options, 0},
               {cli_stage_options, offsetof(render_command, stage)},
               {cli_display_options, offsetof(render_command, display)},
               {cli_target_options, offsetof(render_command, target)},
               {cli_checkpoint_options, offsetof(render_command, checkpoint)},
               {cli_watch_options, offsetof(render_command, watch)},
               {cli_denoise_options, offsetof(render_command, denoise)},
               {cli_definitions_option, offsetof(render_command, definitions)},
               {cli_model_light_option, offsetof(render_command, definitions)},
               {cli_threads_option, offsetof(render_command, common)},
               {cli_quiet_option, offsetof(render_command, common)},
               {cli_cache_option, offsetof(render_command, common)}},
    .size = sizeof(render_command),
    .run = run,
    .ranks = true,
};
