/* aureole irradiance: irradiance at points. */
#include <aureole-lighting/irradiance.h>
#include <aureole/text.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/lighting/irradiance.h"

typedef enum illuminance { ILLUMINANCE_RADIANCE, ILLUMINANCE_REC709, ILLUMINANCE_PHOTOPIC } illuminance;

typedef struct irradiance_command {
    const char *sensors, *output, *format, *plot;
    aur_sensors_options stand;
    aur_grid_options grid;
    aur_irradiance_options estimate;
    aur_irradiance_columns columns;
    illuminance illuminance;
    bool illuminates; /* report lux */
    cli_daylight daylight;
    cli_bifacial bifacial;
    cli_contributions contributions;
    cli_sky sky;
    cli_definitions definitions;
    cli_common common;
} irradiance_command;

/* Parses "1%" or ".01". */
static aur_result parse_error(const char *text, void *field, aur_error *error) {
    char copy[64];
    const size_t length = strlen(text);
    const bool percent = length > 0 && text[length - 1] == '%';
    double value;
    if (length >= sizeof copy)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "must be an error like 1%% or 0.01");
    memcpy(copy, text, length - percent);
    copy[length - percent] = '\0';
    if (!aur_parse_double(copy, &value) || !(value > 0.0 && value < (percent ? 100.0 : 1.0)))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "must be an error like 1%% or 0.01, not '%s'", text);
    *(double *)field = percent ? 0.01 * value : value;
    return AUR_OK;
}

/* Parses TARGET:SPACING[@HEIGHT], where the target may contain colons. The field is the target's. */
static aur_result parse_grid(const char *text, void *field, aur_error *error) {
    aur_grid_options *const grid =
        (aur_grid_options *)(void *)((char *)field - offsetof(aur_grid_options, target));
    const char *const colon = strrchr(text, ':'), *const at = colon != NULL ? strchr(colon, '@') : NULL;
    char spacing[64] = "";
    const size_t length = colon == NULL ? 0 : at != NULL ? (size_t)(at - colon - 1) : strlen(colon + 1);
    if (length > 0 && length < sizeof spacing)
        memcpy(spacing, colon + 1, length);
    grid->height = 0.0;
    if (colon == text || length == 0 || !aur_parse_double(spacing, &grid->spacing) ||
        !(grid->spacing > 0.0) || (at != NULL && !aur_parse_double(at + 1, &grid->height)))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "--grid: expected a surface, rectangle or mesh, a spacing and a height, such as "
                        "floor:0.5@0.8, not '%s'",
                        text);
    char *const target = (char *)(uintptr_t)text; /* an argument of the program, modified here */
    target[colon - text] = '\0';
    grid->target = text;
    return AUR_OK;
}

static aur_result choose_json(const char *text, void *field, aur_error *error) {
    (void)text, (void)error;
    *(const char **)field = "json";
    return AUR_OK;
}

static const cli_option options[] = {
    {CLI_TEXT(irradiance_command, sensors, "sensors", "POINTS", NULL,
              "sensor file: six numbers per line, x y z nx ny nz (Radiance .pts, CSV, NPY; - is standard "
              "input), or a mesh: .obj, .ply, .stl or .off"),
     .content = "file"},
    {CLI_TEXT(irradiance_command, grid.target, "grid", "TARGET:SPACING[@HEIGHT]", NULL,
              "place sensors on a square grid above surfaces by name (floor, *Floor*), a mesh file, or the "
              "rectangle X0,Y0,X1,Y1,H"),
     .parse = parse_grid},
    {CLI_REAL(irradiance_command, grid.margin, "margin", "D", 0, INFINITY, "0",
              "with --grid, the least distance of sensors from the edges")},
    {CLI_TEXT(irradiance_command, output, "output", "FILE", "-",
              "output file, one row per sensor; the extension selects the format; '-' is standard output"),
     .letter = 'o', .content = "file", .writes = true},
    {CLI_TEXT(irradiance_command, format, "to", "FORMAT", "from the extension, or csv",
              "output format; rtrace: r, g, b per line, as 'rtrace -h -I'"),
     .key.computed = true, .key.words = (const char *const[]){"csv", "json", "npy", "ply", "rtrace", NULL}},
    {CLI_FLAG(irradiance_command, format, "json", "same as --to json"), .parse = choose_json},
    {CLI_CHOICE(irradiance_command, definitions.model_light, "model-light", "WHEN", "none",
                "add a constant environment light to a model; auto adds it if the model has no light source "
                "except emissive surfaces"),
     .key.words = (const char *const[]){"auto", "always", "none", NULL}},
    {CLI_CHOICE(irradiance_command, stand.place, "at", "PLACE", "faces",
                "where sensors are placed on a mesh"),
     .key.words = (const char *const[]){"faces", "vertices", NULL}},
    {CLI_REAL(irradiance_command, stand.lift, "lift", "D", -INFINITY, INFINITY, "0",
              "move sensors along their normals by this distance, in scene units")},
    {CLI_TEXT(irradiance_command, estimate.set, "set", "SET", "spherical-fibonacci",
              "point set of the directions"),
     .content = "set"},
    {CLI_INTEGER(irradiance_command, estimate.directions, "directions", "N", 1, 1 << 28,
                 "16384; with --error 2^20", "number of directions per sensor; with --error the maximum"),
     .letter = 'n', .key.computed = true},
    {CLI_REAL(irradiance_command, estimate.error, "error", "E", 0, 1, NULL,
              "target relative error (1% or .01): each sensor takes directions until half the width of its "
              "interval is below"),
     .parse = parse_error},
    {CLI_REAL(irradiance_command, estimate.confidence, "confidence", "P", 0.01, 0.999999, "0.95",
              "confidence level of the intervals")},
    {CLI_INTEGER(irradiance_command, estimate.max_depth, "max-depth", "N", 1, 1 << 20, "no limit",
                 "maximum number of edges of a light path; 1 is direct light only"),
     .key.computed = true},
    {CLI_CHOICE(irradiance_command, estimate.reflected, "reflected", "HOW", "paths",
                "method for reflected light: path tracing, or a photon map or radiosity solution with its "
                "bias corrected by path tracing"),
     .key.words = (const char *const[]){"paths", "map", "radiosity", NULL}},
    {CLI_INTEGER(irradiance_command, estimate.particles, "particles", "N", 1, 1 << 28, "500000",
                 "number of particles of the photon map or the radiosity solution")},
    {CLI_CHOICE(
         irradiance_command, illuminance, "illuminance", "WEIGHTS", NULL,
         "report lux instead of r, g, b: radiance and rec709 take 179 lm/W with Radiance's weights (.265, "
         ".670, .065) or those of Rec. 709 (.2126, .7152, .0722), photopic 683 lm/W with the latter"),
     .key.words = (const char *const[]){"radiance", "rec709", "photopic", NULL}},
    {CLI_TEXT(irradiance_command, plot, "plot", "FILE", NULL,
              "draw luminance, or the lux of --illuminance, as a falsecolour map with a legend, and contours "
              "on a grid: .svg, .pdf, .png, or .tex for pgfplots"),
     .parse = cli_parse_plot, .content = "file", .writes = true},
    {CLI_FLAG(irradiance_command, columns.parts, "parts",
              "report direct, sky, reflected and sun light separately, after the total")},
    {CLI_FLAG(irradiance_command, columns.intervals, "intervals",
              "report half the width of each interval, after the standard errors")},
    {CLI_FLAG(irradiance_command, columns.no_errors, "no-errors", "leave out the standard errors")},
    {CLI_FLAG(irradiance_command, columns.normals, "normals", "report nx, ny, nz after x, y, z")},
    {CLI_FLAG(irradiance_command, columns.directions, "counts",
              "report the number of directions of each sensor")},
    {CLI_INTEGER(irradiance_command, estimate.seed, "seed", "S", 0, INFINITY, "0", "random seed")},
    {.key = {0}}};

/* Luminous efficacy times the weights of r, g, b. */
static void set_illuminance(irradiance_command *given) {
    static const struct {
        double efficacy, weights[3];
    } rows[] = {
        {179.0, {0.265, 0.670, 0.065}}, {179.0, {0.2126, 0.7152, 0.0722}}, {683.0, {0.2126, 0.7152, 0.0722}}};
    for (size_t c = 0; c < 3; ++c)
        given->estimate.luminance[c] =
            rows[given->illuminance].efficacy * rows[given->illuminance].weights[c];
    given->columns.luminance = true;
    given->columns.unit = "lux";
}

/* Percent of the sky's illuminance instead of lux. */
static void set_daylight_factor(irradiance_command *given) {
    aur_scene_sky *const sky = &given->sky.sky;
    sky->alone = true;
    sky->illuminance = sky->illuminance > 0.0 ? sky->illuminance : 1e4;
    for (size_t c = 0; c < 3; ++c)
        given->estimate.luminance[c] *= 100.0 / sky->illuminance;
    given->columns.unit = "daylight_factor";
}

/* Copies the options of the single-time estimate to the annual simulation. */
static aur_result estimate_year(irradiance_command *given, const aur_scene *scene,
                                const aur_scene_options *load, const char *path,
                                const aur_sensors_view *sensors, aur_error *error) {
    const aur_irradiance_options *const estimate = &given->estimate;
    aur_daylight_options *const year = &given->daylight.options;
    year->set = estimate->set;
    year->directions = estimate->directions;
    year->max_depth = estimate->max_depth;
    year->seed = estimate->seed;
    year->threads = estimate->threads;
    year->progress = estimate->progress;
    year->warnings = estimate->warnings;
    memcpy(year->luminance, estimate->luminance, sizeof year->luminance);
    const cli_bifacial_run_options run = {.path = path,
                                          .weather = given->daylight.weather,
                                          .load = load,
                                          .daylight = year,
                                          .lift = given->sensors != NULL ? given->stand.lift
                                                                         : given->grid.height};
    if (given->bifacial.requested) {
        year->size = sizeof *year;
        year->no_ground = year->ground_albedo == 0.0;
        return cli_bifacial_run(&given->bifacial, &run, scene, sensors, given->output, given->format, error);
    }
    return given->daylight.coefficients
               ? cli_daylight_coefficients(&given->daylight, scene, sensors, given->output, error)
               : cli_daylight_run(&given->daylight, scene, sensors, given->output, given->format,
                                  given->common.quiet, error);
}

/* In units of a particle's time: a path from a sensor takes two. */
static void plan(const irradiance_command *given, size_t sensors) {
    static cli_phase phases[] = {{"photons", 0.0}, {"radiosity", 0.0}, {"sensors", 0.0}};
    const double particles = given->estimate.particles > 0 ? (double)given->estimate.particles : 5e5;
    const double directions = given->estimate.directions > 0 ? (double)given->estimate.directions : 16384.0;
    phases[0].work = given->estimate.reflected == AUR_REFLECTED_BY_MAP ? particles : 0.0;
    phases[1].work = given->estimate.reflected == AUR_REFLECTED_BY_RADIOSITY ? particles : 0.0;
    phases[2].work = 2.0 * directions * (double)sensors;
    cli_progress_plan(sizeof phases / sizeof phases[0], phases);
}

static aur_result estimate(const irradiance_command *given, const aur_scene *scene,
                           const aur_sensors_view *sensors, aur_error *error) {
    plan(given, sensors->count);
    aur_irradiance *const results = calloc(sensors->count, sizeof *results);
    if (results == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu sensors", sensors->count);
    aur_result result =
        aur_irradiance_estimate(scene, sensors, &given->estimate, sizeof *results, results, error);
    cli_progress_clear();
    if (result == AUR_OK)
        result = aur_irradiance_write(given->output, given->format, &given->columns, sensors, sizeof *results,
                                      results, error);
    if (result == AUR_OK && given->plot != NULL)
        result = cli_irradiance_plot(given->plot,
                                     given->sky.daylight_factor ? "daylight factor, %" : given->columns.unit,
                                     sensors, results, error);
    free(results);
    return result;
}

/* The format given by option, or else by the output file's name. */
static void find_format(const cli_call *call, irradiance_command *given) {
    static const char *const formats[] = {"csv", "json", "npy", "ply"};
    const char *const dot = strrchr(given->output, '.');
    if (cli_given(call, "to") != NULL || cli_given(call, "json") != NULL)
        return;
    given->format = "csv";
    for (size_t i = 0; i < 4 && dot != NULL; ++i)
        if (strcmp(dot + 1, formats[i]) == 0)
            given->format = formats[i];
}

/* False, with a message, if options conflict. */
static bool check(const cli_call *call) {
    irradiance_command *const given = call->options;
    const char *conflict = NULL;
    if (given->sensors == NULL && given->grid.target == NULL)
        conflict = "irradiance: no sensors given: expected --sensors POINTS or --grid SURFACE:SPACING";
    else if (given->sensors != NULL && given->grid.target != NULL)
        conflict = "irradiance: --sensors cannot be used with --grid";
    else if (given->grid.margin > 0.0 && given->grid.target == NULL)
        conflict = "irradiance: --margin needs --grid";
    else if (cli_given(call, "particles") != NULL && given->estimate.reflected == AUR_REFLECTED_BY_PATHS)
        conflict = "irradiance: --particles needs --reflected map or radiosity";
    if (conflict != NULL)
        cli_bad_usage("%s", conflict);
    return conflict == NULL && cli_daylight_check(call) && cli_sky_check(call) &&
           cli_bifacial_check(call, &given->bifacial, given->format) &&
           cli_contributions_check(call, &given->contributions, given->format);
}

/* Options of the scene loader. */
static aur_scene_options loading(const cli_call *call) {
    const irradiance_command *const given = call->options;
    aur_scene_options load = {.size = sizeof load};
    aur_scene_options_init(&load, NULL);
    load.definition_count = given->definitions.count;
    load.definitions = given->definitions.items;
    load.confine = given->definitions.confine;
    load.diffuse = given->definitions.diffuse;
    load.model_light = given->definitions.model_light;
    load.stage.ground = AUR_SCENE_GROUND_NONE;
    if (call->operand_count == 1 && aur_scene_is_name(call->operands[0]))
        load.stage.camera = "front"; /* of a model; unused, but no warning of a default one */
    load.progress = given->estimate.progress;
    load.further_count = call->operand_count - 1;
    load.further = (const char *const *)call->operands + 1;
    load.warnings = cli_warnings(given->common.quiet);
    load.threads = given->common.threads;
    load.sky = given->sky.sky;
    load.sky.ground_albedo = given->daylight.options.ground_albedo;
    memcpy(load.sky.up, given->daylight.options.up, sizeof load.sky.up);
    memcpy(load.sky.north, given->daylight.options.north, sizeof load.sky.north);
    load.luminaire_count = given->sky.luminaire_count;
    load.luminaires = given->sky.luminaires;
    return load;
}

/* Places a grid of sensors on surfaces of the scene. */
static aur_result place_grid(irradiance_command *given, const aur_scene *scene, aur_sensors **sensors,
                             aur_error *error) {
    aur_grid_options grid = {.size = sizeof grid};
    aur_grid_options_init(&grid, NULL);
    given->grid.size = grid.size;
    given->grid.warnings = given->stand.warnings;
    memcpy(given->grid.up, given->daylight.options.up, sizeof given->grid.up);
    return aur_sensors_grid(scene, &given->grid, sensors, error);
}

/* Warns of probable mistakes in units or positions. */
static void warn_of_units(const irradiance_command *given, const aur_scene *scene) {
    static const double SMALLEST = 0.1, LARGEST = 1000.0; /* metres: a room with light sources */
    static const double ZONE = 3.0;                       /* hours between a time zone and its longitude */
    const aur_warnings warnings = cli_warnings(given->common.quiet);
    aur_scene_description d = {.size = sizeof d};
    double place[3] = {1.0, 1.0, 0.0}, extent = 0.0;
    char text[200];
    aur_scene_get_description(scene, &d, NULL);
    for (size_t i = 0; i < 3; ++i)
        extent = fmax(extent, d.upper[i] - d.lower[i]);
    if (warnings.function == NULL)
        return;
    if (given->illuminates && given->sky.sky.model != NULL && strncmp(given->sky.sky.model, "perez", 5) == 0)
        warnings.function(warnings.user,
                          "lux of --sky perez are too large: its W/m2 are of the whole solar spectrum, about "
                          "110 lm/W; --weather converts them by the state of the sky");
    if (given->sky.luminaire_count > 0 && (extent > LARGEST || extent < SMALLEST)) {
        aur_format(text, sizeof text,
                   "the scene is %.4g units wide and luminaires are in metres: check the units of the scene",
                   extent);
        warnings.function(warnings.user, text);
    }
    const char *const location = given->sky.sky.location;
    if (location == NULL || cli_split_numbers(location, 3, place) < 2)
        return;
    if (place[0] == 0.0 && place[1] == 0.0)
        warnings.function(warnings.user,
                          "--location 0,0 is in the sea: expected degrees north, then degrees east");
    if (fabs(remainder(place[2] - place[1] / 15.0, 24.0)) > ZONE) {
        aur_format(
            text, sizeof text,
            "--location: the time zone %g is %.1f hours from that of %g degrees east: expected degrees "
            "north, degrees east, hours ahead of UTC",
            place[2], fabs(remainder(place[2] - place[1] / 15.0, 24.0)), place[1]);
        warnings.function(warnings.user, text);
    }
}

/* Warns of sensors farther from the scene than its size, as with positions in millimetres. */
static void warn_of_positions(const irradiance_command *given, const aur_scene *scene,
                              const aur_sensors_view *sensors) {
    const aur_warnings warnings = cli_warnings(given->common.quiet);
    aur_scene_description d = {.size = sizeof d};
    double extent = 0.0;
    size_t count = 0, first = 0;
    aur_scene_get_description(scene, &d, NULL);
    for (size_t i = 0; i < 3; ++i)
        extent = fmax(extent, d.upper[i] - d.lower[i]);
    for (size_t i = 0; i < sensors->count; ++i) {
        bool far = false;
        for (size_t k = 0; k < 3; ++k) {
            const double at = sensors->positions[3 * i + k];
            far = far || at < d.lower[k] - 10.0 * extent || at > d.upper[k] + 10.0 * extent;
        }
        if (far && count++ == 0)
            first = i;
    }
    if (count == 0 || !(extent > 0.0) || warnings.function == NULL)
        return;
    char text[AUR_ERROR_FILE_CAPACITY + 160], line_suffix[32] = "";
    if (sensors->lines != NULL)
        aur_format(line_suffix, sizeof line_suffix, ":%zu", sensors->lines[first]);
    aur_format(text, sizeof text,
               "%s%s: %zu of %zu sensors are more than ten times the size of the scene away from it (the "
               "first is here): check the units",
               sensors->file != NULL ? sensors->file : "sensors", line_suffix, count, sensors->count);
    warnings.function(warnings.user, text);
}

static int run(const cli_call *call) {
    irradiance_command *const given = call->options;
    find_format(call, given);
    if (!check(call))
        return 2;
    given->estimate.size = sizeof given->estimate;
    given->estimate.threads = given->common.threads;
    given->estimate.progress = cli_progress(given->common.quiet);
    given->estimate.warnings = cli_warnings(given->common.quiet);
    given->columns.size = sizeof given->columns;
    given->illuminates = cli_given(call, "illuminance") != NULL;
    if (given->illuminates || given->sky.daylight_factor)
        set_illuminance(given);
    if (given->sky.daylight_factor)
        set_daylight_factor(given);
    aur_error error;
    if (given->bifacial.rotation != NULL) {
        if (given->definitions.count == CLI_DEFINITION_LIMIT) {
            cli_bad_usage("irradiance: too many definitions");
            return 2;
        }
        strcpy(given->bifacial.degrees, "0");
        given->definitions.items[given->definitions.count++] =
            (aur_definition){given->bifacial.rotation, given->bifacial.degrees};
    }
    const aur_scene_options load = loading(call);
    aur_scene *scene = NULL;
    aur_sensors *sensors = NULL;
    given->stand.size = sizeof given->stand;
    given->stand.warnings = cli_warnings(given->common.quiet);
    aur_result result =
        given->sensors != NULL ? aur_sensors_read(given->sensors, &given->stand, &sensors, &error) : AUR_OK;
    if (result == AUR_OK)
        result = aur_scene_load(call->operands[0], &load, &scene, &error);
    if (result == AUR_OK)
        warn_of_units(given, scene);
    if (result == AUR_OK && given->sensors == NULL)
        result = place_grid(given, scene, &sensors, &error);
    if (result == AUR_OK)
        warn_of_positions(given, scene, aur_sensors_get_view(sensors));
    if (result == AUR_OK && given->contributions.count > 0)
        result = cli_contributions_run(&given->contributions, call->operands[0], &load, &given->estimate,
                                       given->columns.luminance, aur_sensors_get_view(sensors), given->output,
                                       given->format, &error);
    else if (result == AUR_OK)
        result =
            given->daylight.weather != NULL || given->daylight.coefficients
                ? estimate_year(given, scene, &load, call->operands[0], aur_sensors_get_view(sensors), &error)
                : estimate(given, scene, aur_sensors_get_view(sensors), &error);
    aur_scene_destroy(scene);
    aur_sensors_destroy(sensors);
    return cli_status(result, &error);
}

const cli_command cli_command_irradiance = {
    .name = "irradiance",
    .summary = "compute irradiance or illuminance at sensors, now or over a year, with standard errors",
    .notes = "The scene needs no camera. Values have the unit of the scene's radiance times steradians. "
             "Standard errors come from 16 independent randomisations. See docs/lighting.md.",
    .too_few = "no scene given",
    .operands = {{"SCENE", "a scene (.xml, .rad, .glb, ...); further files are appended, as by oconv",
                  .repeated = true, .content = "file"}},
    .groups = {{options, 0},
               {cli_sky_options, offsetof(irradiance_command, sky)},
               {cli_daylight_options, offsetof(irradiance_command, daylight)},
               {cli_contributions_options, offsetof(irradiance_command, contributions)},
               {cli_bifacial_options, offsetof(irradiance_command, bifacial)},
               {cli_definitions_option, offsetof(irradiance_command, definitions)},
               {cli_threads_option, offsetof(irradiance_command, common)},
               {cli_quiet_option, offsetof(irradiance_command, common)},
               {cli_cache_option, offsetof(irradiance_command, common)}},
    .size = sizeof(irradiance_command),
    .run = run,
};
