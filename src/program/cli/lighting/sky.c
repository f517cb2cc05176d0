/* The options of a sky at one time. */
#include <stddef.h>
#include <string.h>

#include "program/cli/lighting/irradiance.h"

const cli_option cli_sky_options[] = {
    {CLI_TEXT(cli_sky, sky.model, "sky", "MODEL", NULL,
              "add a sky: cie-overcast, cie-clear, cie:1 to cie:15, uniform, or perez:DNI,DHI (W/m2) with "
              "its sun")},
    {CLI_TEXT(cli_sky, sky.date, "date", "TIME", NULL,
              "of --sky, like 2026-06-21T12:00, by the clock of the time zone")},
    {CLI_TEXT(cli_sky, sky.location, "location", "LAT,LON,TZ", NULL,
              "of --sky: degrees north, degrees east, hours ahead of UTC")},
    {CLI_REAL(cli_sky, sky.illuminance, "sky-lux", "LUX", 1e-3, 1e6, "10000",
              "of --sky but perez: illuminance of the unobstructed horizontal plane by the sky"),
     .key.computed = true},
    {CLI_FLAG(cli_sky, daylight_factor, "daylight-factor",
              "percent of the unobstructed horizontal illuminance, of --sky without the scene's own lights")},
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
        cli_bad_usage("irradiance: --sky does not go with --weather, which has skies of its own");
        return false;
    }
    if (cli_given(call, "daylight-factor") == NULL)
        return true;
    if (strncmp(cli_given(call, "sky"), "perez", 5) == 0) {
        cli_bad_usage(
            "irradiance: --daylight-factor is of a sky without sun: cie-overcast expected, not perez");
        return false;
    }
    if (cli_given(call, "illuminance") != NULL) {
        cli_bad_usage("irradiance: --daylight-factor does not go with --illuminance");
        return false;
    }
    return true;
}
