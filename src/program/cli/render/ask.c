
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

const cli_option cli_wish_options[] = {
    {CLI_TEXT(cli_wish, error, "error", "1%", NULL,
              "render until the root mean square error is below this part of the picture's mean"),
     .parse = parse_error},
    {CLI_TEXT(
         cli_wish, bias, "bias", "1%", NULL,
         "of --error: what the integrator of --integrator may be wrong by in the mean, as a picture to an "
         "error says afterwards"),
     .parse = parse_bias},
    {CLI_TEXT(cli_wish, seconds, "time", "30s", NULL,
              "render for so long, and say the command that makes the same picture"),
     .parse = parse_time},
    {CLI_TEXT(cli_wish, rays, "rays", "1e9", NULL, "render with so many rays"), .parse = parse_rays},
    {CLI_INTEGER(cli_wish, rounds, "rounds", "N", 1, 1000, NULL,
                 "render so many rounds of samples, as --time says afterwards")},
    {CLI_FLAG(cli_wish, error_map, "error-map",
              "the standard error of each pixel as channels error.R, error.G, error.B")},
    {.key = {0}}};

bool cli_is_wish(const cli_wish *wish) {
    return wish->error > 0.0 || wish->seconds > 0.0 || wish->rays > 0 || wish->rounds > 0;
}

/* An option with the fewest digits that mean the same number. */
static void say_number(const char *option, double value) {
    char text[40];
    for (int digits = 15; digits <= 17; ++digits) {
        aur_format(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    aur_print(stderr, " %s %s", option, text);
}

/* The command that makes the same bits without a choice and without a clock. */
static void say_again(const aur_ask *ask, const cli_wish *wish, const aur_ask_report *report) {
    aur_print(stderr, "aureole: the same picture again:");
    if (*aur_ask_integrator(ask) != '\0')
        aur_print(stderr, " --integrator '%s'", aur_ask_integrator(ask));
    if (wish->error > 0.0)
        say_number("--error", wish->error);
    if (report->bias_high > 0.0)
        say_number("--bias", report->bias_high);
    if (wish->rays > 0) /* the trials may have taken them all */
        aur_print(stderr, " --rays %" PRIu64,
                  wish->rays > report->trial_rays ? wish->rays - report->trial_rays : 1);
    if (wish->seconds > 0.0 || wish->rounds > 0)
        aur_print(stderr, " --rounds %" PRIu64, report->rounds);
    aur_print(stderr, "\n");
}

static void say(const aur_ask *ask, const cli_wish *wish, const char *output) {
    aur_ask_report report = {.size = sizeof report};
    aur_ask_get_report(ask, &report, NULL);
    const aur_render_statistics *const spent = &report.statistics;
    if (!(report.mean > 0.0)) {
        aur_print(stderr, "aureole: %s is black: no light of the scene reaches the camera\n", output);
        return;
    }
    say_again(ask, wish, &report);
    char bias[64] = "";
    if (report.bias_high > 0.0)
        snprintf(bias, sizeof bias, ", of which at most %.3g %% are bias", 100.0 * report.bias_high);
    aur_print(stderr,
              "aureole: %s has an error of %.3g %% of its mean, between %.3g and %.3g (95 %%)%s, after %.4g "
              "samples a pixel, %.3g rays, %.1f s by %s\n",
              output, 100.0 * report.error, 100.0 * report.error_low, 100.0 * report.error_high, bias,
              report.samples_per_pixel, (double)spent->rays, spent->prepare_seconds + spent->render_seconds,
              aur_ask_integrator(ask));
}

static aur_result print_json(const aur_ask *ask, const char *output, aur_error *error) {
    aur_ask_report report = {.size = sizeof report};
    aur_ask_get_report(ask, &report, NULL);
    const cli_render_summary summary = {.output = output,
                                        .integrator = aur_ask_integrator(ask),
                                        .error = report.error,
                                        .error_low = report.error_low,
                                        .error_high = report.error_high,
                                        .bias_high = report.bias_high,
                                        .mean = report.mean,
                                        .rounds = (double)report.rounds,
                                        .samples_per_pixel = report.samples_per_pixel,
                                        .statistics = report.statistics};
    return cli_print_json(&summary, error);
}

aur_result cli_render_wish(aur_renderer *renderer, const aur_render_options *options, const cli_wish *wish,
                           const cli_surroundings *beside, aur_ask **made, aur_image **image,
                           aur_error *error) {
    aur_ask_options own = {.size = sizeof own};
    aur_ask_options_init(&own, NULL);
    own.error = wish->error;
    own.bias = wish->bias;
    own.seconds = wish->seconds;
    own.rays = wish->rays;
    own.rounds = wish->rounds;
    aur_ask *ask = NULL;
    aur_result result = aur_ask_create(renderer, options, &own, &ask, error);
    *made = ask;
    if (result == AUR_OK)
        result = cli_checkpoint_begin(beside->checkpoint, NULL, ask, beside->quiet, error);
    const bool begun = result == AUR_OK;
    if (begun) {
        cli_watch_show(beside->watch, NULL, ask);
        result = aur_ask_run(ask, error);
        cli_watch_hide(beside->watch);
    }
    cli_progress_clear();
    if (begun && result != AUR_OK && result != AUR_ERROR_CANCELLED)
        cli_checkpoint_end(beside->checkpoint, false);
    if (result == AUR_OK || (result == AUR_ERROR_CANCELLED && ask != NULL)) {
        const aur_result developed = aur_ask_develop(ask, wish->error_map, image, error);
        result = developed != AUR_OK ? developed : result;
    }
    if (result == AUR_OK && !beside->quiet)
        say(ask, wish, beside->output);
    if (result == AUR_OK && beside->json && aur_ranks_rank() == 0)
        result = print_json(ask, beside->output, error);
    return result;
}
