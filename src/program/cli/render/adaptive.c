
#include <aureole/ranks.h>
#include <aureole/text.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "program/cli/options.h"
#include "program/cli/render/render_result.h"

static aur_result parse_part(const char *option, const char *text, void *field, aur_error *error) {
    static const cli_unit units[] = {{"%", 0.01}};
    double *const value = field;
    if (cli_parse_quantity(text, 1, units, value) && *value <= 1.0)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT, "--%s: expected 1%% or .01, from above 0 to 100%%, not '%s'",
                    option, text);
}

static aur_result parse_error(const char *text, void *field, aur_error *error) {
    return parse_part("error", text, field, error);
}

static aur_result parse_bias(const char *text, void *field, aur_error *error) {
    return parse_part("bias", text, field, error);
}

static aur_result parse_time(const char *text, void *field, aur_error *error) {
    return cli_parse_seconds("time", text, field, error);
}

static aur_result parse_rays(const char *text, void *field, aur_error *error) {
    double value = 0.0;
    if (!cli_parse_quantity(text, 0, NULL, &value) || value < 1.0 || value > 1e18)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "--rays: expected a number such as 1e9, not '%s'", text);
    *(uint64_t *)field = (uint64_t)value;
    return AUR_OK;
}

const cli_option cli_target_options[] = {
    {CLI_TEXT(cli_target, error, "error", "ERROR", NULL,
              "render until the error by --error-measure is below this target, such as 1%"),
     .parse = parse_error},
    {CLI_CHOICE(cli_target, measure, "error-measure", "NAME", "relative",
                "measure of --error: root mean square error relative to the local mean of each pixel, "
                "relative to the mean of the image, or of the displayed image"),
     .key.words = (const char *const[]){"relative", "mean", "display", NULL}},
    {CLI_TEXT(cli_target, bias, "bias", "ERROR", NULL,
              "systematic error to allow for the integrator given by --integrator, as printed by an earlier "
              "--error render"),
     .parse = parse_bias},
    {CLI_TEXT(cli_target, seconds, "time", "TIME", NULL,
              "render for this time, such as 30s, and print the command that reproduces the image"),
     .parse = parse_time},
    {CLI_TEXT(cli_target, rays, "rays", "N", NULL, "render with this number of rays, such as 1e9"),
     .parse = parse_rays},
    {CLI_INTEGER(cli_target, rounds, "rounds", "N", 1, 1000, NULL,
                 "render this number of rounds of samples, as printed by --time")},
    {CLI_FLAG(cli_target, error_map, "error-map",
              "add the standard error of each pixel as channels error.R, error.G, error.B")},
    {.key = {0}}};

/* In the order of aur_error_measure. */
static const char *const measure_texts[AUR_ERROR_MEASURE_COUNT] = {
    "of the local mean (relative)", "of the image mean (mean)", "of the displayed range (display)"};

bool cli_is_target(const cli_target *target) {
    return target->error > 0.0 || target->seconds > 0.0 || target->rays > 0 || target->rounds > 0;
}

/* Prints an option with the fewest digits that preserve the value. */
static void print_option(const char *option, double value) {
    char text[40];
    for (int digits = 15; digits <= 17; ++digits) {
        aur_format(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    aur_print(stderr, " %s %s", option, text);
}

/* Prints the command that reproduces the image bit for bit without a choice of integrator or a time limit. */
static void print_command(const aur_adaptive *adaptive, const cli_target *target,
                          const aur_adaptive_report *report) {
    aur_print(stderr, "aureole: to reproduce this image:%s", target->replicas == 1 ? " --denoise" : "");
    if (*aur_adaptive_integrator(adaptive) != '\0')
        aur_print(stderr, " --integrator '%s'", aur_adaptive_integrator(adaptive));
    if (target->error > 0.0)
        print_option("--error", target->error);
    if (target->measure != AUR_ERROR_MEASURE_RELATIVE)
        aur_print(stderr, " --error-measure %s", aur_error_measure_name(target->measure));
    if (report->bias_room > 0.0)
        print_option("--bias", report->bias_room);
    if (target->rays > 0) /* the candidates may have used all */
        aur_print(stderr, " --rays %" PRIu64,
                  target->rays > report->candidate_rays ? target->rays - report->candidate_rays : 1);
    if (target->seconds > 0.0 || target->rounds > 0)
        aur_print(stderr, " --rounds %" PRIu64, report->rounds);
    aur_print(stderr, "\n");
}

static void print_result(aur_adaptive *adaptive, const cli_target *target, const char *output, bool verbose) {
    aur_adaptive_report report = {.size = sizeof report};
    aur_adaptive_get_report(adaptive, &report, NULL);
    const aur_render_statistics *const spent = &report.statistics;
    if (!(report.mean > 0.0)) {
        aur_print(
            stderr,
            "aureole: %s is black: none of %.4g samples per pixel met light (--camera, --environment)\n",
            output, report.samples_per_pixel);
        return;
    }
    print_command(adaptive, target, &report);
    const double seconds = spent->prepare_seconds + spent->render_seconds;
    char bias[64] = "";
    if (report.bias_high > 0.0)
        snprintf(bias, sizeof bias, ", of which at most %.3g %% are bias", 100.0 * report.bias_high);
    if (report.replicas == 1)
        aur_print(stderr, "aureole: %s has %.4g samples per pixel, %.3g rays, %.1f s by %s\n", output,
                  report.samples_per_pixel, (double)spent->rays, seconds, aur_adaptive_integrator(adaptive));
    else
        aur_print(stderr,
                  "aureole: %s has an error of %.3g %% %s, between %.3g and %.3g (95 %%)%s, after %.4g "
                  "samples per pixel, %.3g rays, %.1f s by %s\n",
                  output, 100.0 * report.error, measure_texts[target->measure], 100.0 * report.error_low,
                  100.0 * report.error_high, bias, report.samples_per_pixel, (double)spent->rays, seconds,
                  aur_adaptive_integrator(adaptive));
    for (size_t i = 0; i < report.race_count && verbose; ++i) {
        aur_adaptive_candidate candidate = {.size = sizeof candidate};
        if (aur_adaptive_get_candidate(adaptive, i, &candidate, NULL) == AUR_OK)
            aur_print(stderr, "aureole: candidate %s: %.3g rays for %zu pixels, needs %.3g: %s\n",
                      candidate.name, candidate.rays, candidate.pixels, candidate.need, candidate.reason);
    }
    for (unsigned m = 0; m < AUR_ERROR_MEASURE_COUNT && verbose && report.replicas > 1; ++m)
        aur_print(stderr, "aureole: its error is %.3g %% %s, between %.3g and %.3g (95 %%)\n",
                  100.0 * report.errors[m].error, measure_texts[m], 100.0 * report.errors[m].low,
                  100.0 * report.errors[m].high);
}

void cli_report_denoised(const aur_error_figures *figures, aur_error_measure measure) {
    char bound[64] = "without a bound for so few pixels";
    if (isfinite(figures->high))
        snprintf(bound, sizeof bound, "at most %.3g (95 %%)", 100.0 * figures->high);
    aur_print(stderr,
              "aureole: the error above is that of the noisy image; denoised half of the samples: %.3g %% "
              "%s, %s\n",
              100.0 * figures->error, measure_texts[measure], bound);
}

static aur_result print_json(aur_adaptive *adaptive, const char *output, const aur_image *image,
                             aur_error *error) {
    aur_adaptive_report report = {.size = sizeof report};
    aur_adaptive_get_report(adaptive, &report, NULL);
    const cli_render_summary summary = {.output = output,
                                        .integrator = aur_adaptive_integrator(adaptive),
                                        .error = report.error,
                                        .error_low = report.error_low,
                                        .error_high = report.error_high,
                                        .bias_high = report.bias_high,
                                        .mean = report.mean,
                                        .rounds = (double)report.rounds,
                                        .samples_per_pixel = report.samples_per_pixel,
                                        .clamped = cli_clamped_part(image),
                                        .measures = report.errors,
                                        .adaptive = adaptive,
                                        .statistics = report.statistics};
    return cli_print_json(&summary, error);
}

aur_result cli_render_target(aur_renderer *renderer, const aur_render_options *options,
                             const cli_target *target, const cli_render_services *services,
                             aur_adaptive **created, aur_image **image, aur_error *error) {
    aur_adaptive_options adaptive_options = {.size = sizeof adaptive_options};
    aur_adaptive_options_init(&adaptive_options, NULL);
    adaptive_options.error = target->error;
    adaptive_options.bias = target->bias;
    adaptive_options.seconds = target->seconds;
    adaptive_options.rays = target->rays;
    adaptive_options.rounds = target->rounds;
    adaptive_options.measure = target->measure;
    adaptive_options.independent_pixels = target->independent_pixels;
    adaptive_options.replicas = target->replicas;
    aur_adaptive *adaptive = NULL;
    aur_result result = aur_adaptive_create(renderer, options, &adaptive_options, &adaptive, error);
    *created = adaptive;
    if (result == AUR_OK)
        result = cli_checkpoint_begin(services->checkpoint, NULL, adaptive, services->quiet, error);
    const bool started = result == AUR_OK;
    if (started) {
        cli_watch_show(services->watch, NULL, adaptive);
        result = aur_adaptive_run(adaptive, error);
        cli_watch_hide(services->watch);
    }
    cli_progress_clear();
    if (started && result != AUR_OK && result != AUR_ERROR_CANCELLED)
        cli_checkpoint_end(services->checkpoint, false);
    if (result == AUR_OK)
        result = aur_adaptive_develop(adaptive, target->error_map, image, error);
    else if (result == AUR_ERROR_CANCELLED && adaptive != NULL) /* there may be no image yet */
        aur_adaptive_develop(adaptive, target->error_map, image, NULL);
    if (result == AUR_OK && !services->quiet)
        print_result(adaptive, target, services->output, services->verbose);
    if (result == AUR_OK && services->json && aur_ranks_rank() == 0)
        result = print_json(adaptive, services->output, *image, error);
    return result;
}
