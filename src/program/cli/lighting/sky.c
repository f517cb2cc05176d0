/* Options for a sky at one time, and for luminaires. */
#include <aureole/text.h>
#include <stddef.h>
#include <string.h>

#include "program/cli/lighting/irradiance.h"

/* Parses FILE@X,Y,Z[,AIMX,AIMY,AIMZ[,TURN]]; the field is the number of luminaires. */
static aur_result parse_luminaire(const char *text, void *field, aur_error *error) {
    cli_sky *const given = (cli_sky *)(void *)((char *)field - offsetof(cli_sky, luminaire_count));
    char *const at = strrchr(text, '@');
    double n[7] = {0.0};
    const size_t count = at != NULL && at > text ? cli_split_numbers(at + 1, 7, n) : 0;
    if (count != 3 && count != 6 && count != 7)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "--lamp: must be a file and its position, aim and turn, like lamp.ies@2,1,2.8 or "
                        "lamp.ies@2,1,2.8,0,0,-1,90, not '%s'",
                        text);
    if (given->luminaire_count == CLI_LUMINAIRE_LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "--lamp: more than %d luminaires",
                        (int)CLI_LUMINAIRE_LIMIT);
    *at = '\0'; /* an argument of the program */
    given->luminaires[given->luminaire_count++] =
        (aur_scene_luminaire){text, {n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6]};
    return AUR_OK;
}

const cli_option cli_sky_options[] = {
    {CLI_TEXT(cli_sky, luminaire_count, "lamp", "FILE@X,Y,Z[,AIM[,TURN]]", NULL,
              "add a luminaire from an IES or EULUMDAT file at a position; AIM is a direction X,Y,Z (down by "
              "default); may be repeated"),
     .parse = parse_luminaire},
    {CLI_TEXT(cli_sky, sky.model, "sky", "MODEL", NULL,
              "add a sky: cie-overcast, cie-clear, cie:1 to cie:15, uniform, or perez:DNI,DHI (W/m2), which "
              "includes the sun")},
    {CLI_TEXT(cli_sky, sky.date, "date", "TIME", NULL,
              "date and local time of --sky, such as 2026-06-21T12:00")},
    {CLI_TEXT(cli_sky, sky.location, "location", "LAT,LON,TZ", NULL,
              "location of --sky: degrees north, degrees east, time zone in hours ahead of UTC")},
    {CLI_REAL(cli_sky, sky.illuminance, "sky-lux", "LUX", 1e-3, 1e6, "10000",
              "unobstructed horizontal illuminance by the sky, for all skies except perez"),
     .key.computed = true},
    {CLI_FLAG(cli_sky, daylight_factor, "daylight-factor",
              "report daylight factors: percent of the unobstructed horizontal illuminance by --sky, without "
              "the emitters of the scene")},
    {.key = {0}}};

bool cli_sky_check(const cli_call *call) {
    static const char *const needing[] = {"date", "location", "sky-lux", "daylight-factor"};
    const bool sky = cli_given(call, "sky") != NULL;
    for (size_t i = 0; i < sizeof needing / sizeof needing[0] && !sky; ++i)
        if (cli_given(call, needing[i]) != NULL) {
            cli_bad_usage("irradiance: --%s needs --sky MODEL", needing[i]);
            return false;
        }
    if (sky && cli_given(call, "weather") != NULL) {
        cli_bad_usage("irradiance: --sky cannot be used with --weather");
        return false;
    }
    if (cli_given(call, "daylight-factor") == NULL)
        return true;
    if (strncmp(cli_given(call, "sky"), "perez", 5) == 0) {
        cli_bad_usage(
            "irradiance: --daylight-factor needs a sky without sun such as cie-overcast (found perez)");
        return false;
    }
    if (cli_given(call, "illuminance") != NULL) {
        cli_bad_usage("irradiance: --daylight-factor cannot be used with --illuminance");
        return false;
    }
    return true;
}
