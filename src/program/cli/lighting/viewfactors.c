/* aureole viewfactors: the fraction of radiation from each facet that arrives at each other facet. */
#include <aureole-lighting/view_factors.h>
#include <aureole/text.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/lighting/viewfactors.h"
#include "program/cli/options.h"

typedef struct factor_command {
    aur_facets_options facets;
    aur_view_factors_options factors;
    cli_definitions definitions;
    const char *output, *format;
    bool matrix_free, script;
    aur_facets_light light;
    const char *sun, *surfaces;
    cli_common common;
} factor_command;

static const cli_option options[] = {
    {CLI_TEXT(factor_command, output, "output", "FILE", "print a summary",
              "output file: .npz (read by scipy.sparse.load_npz), .csv, .txt or .vf (View3D output), .vs3 "
              "(facets as View3D input), vfsparse.inp.NNN (uDALES, with svf.inp.NNN and facetarea.inp.NNN)"),
     .letter = 'o', .key.computed = true, .content = "file", .writes = true},
    {CLI_TEXT(factor_command, format, "to", "FORMAT", NULL,
              "output format, if the extension of FILE does not select it"),
     .key.words = (const char *const[]){"npz", "csv", "view3d", "vs3", "udales", NULL}},
    {CLI_FLAG(factor_command, facets.group, "group",
              "report one row per group of an OBJ, or per shape of a scene")},
    {CLI_FLAG(factor_command, facets.both_sides, "both-sides",
              "add the back sides of facets; their rows follow the others")},
    {CLI_INTEGER(factor_command, factors.rays, "rays", "N", 2, 1 << 22, "2048",
                 "number of rays per facet and side")},
    {CLI_INTEGER(factor_command, factors.randomizations, "randomizations", "R", 2, 64, "8",
                 "number of independent randomisations of the rays; intervals come from their spread")},
    {CLI_INTEGER(factor_command, factors.half_planes, "half-planes", "N", 1, 1 << 22, "1.5 times the rays",
                 "number of half planes per facet and side, for the sky factor"),
     .key.computed = true},
    {CLI_TEXT(factor_command, factors.set, "set", "SET", "sobol",
              "point set of origins and directions of the rays, in four dimensions"),
     .content = "set"},
    {CLI_INTEGER(factor_command, factors.seed, "seed", "S", 0, INFINITY, "0", "random seed")},
    {CLI_REAL(factor_command, factors.confidence, "confidence", "P", 0.01, 0.999999, "0.95",
              "confidence level of the intervals")},
    {CLI_REAL(factor_command, factors.error, "error", "E", 1e-6, 1, NULL,
              "target error: double rays and half planes until no half width of factors and sky factors is "
              "larger")},
    {CLI_FLAG(factor_command, factors.rays_only, "rays-only",
              "use rays only, without closed forms and half planes")},
    {CLI_REAL(factor_command, light.reflectance, "radiosity", "RHO", 0, 1, NULL,
              "solve for radiosity with reflectance RHO of all facets, and write area, sky factor and "
              "radiosity with half its interval per row as CSV, or JSON with --json")},
    {CLI_REAL(factor_command, light.sky, "sky", "B", 0, 1e30, "1; 0 with --sun, --emission or --surfaces",
              "for --radiosity: radiosity of the sky"),
     .key.computed = true},
    {CLI_TEXT(
        factor_command, sun, "sun", "X,Y,Z", NULL,
        "for --radiosity: direction to the sun; the length is the irradiance of a surface that faces it")},
    {CLI_REAL(factor_command, light.emission, "emission", "B", 0, 1e30, "0",
              "for --radiosity: emission of every facet")},
    {CLI_TEXT(factor_command, surfaces, "surfaces", "FILE", NULL,
              "solve for radiosity with surface data from CSV: name (of a group, or *) or row, reflectance "
              "or emittance, emission or temperature in kelvin, or from uDALES's facets.inp.NNN; also "
              "reports irradiance and net flux"),
     .content = "file"},
    {CLI_FLAG(factor_command, script, "script-f",
              "write Hottel's script F instead of view factors, with the emittances of --surfaces or of a "
              ".vs3 file")},
    {CLI_FLAG(factor_command, matrix_free, "matrix-free",
              "for --radiosity: trace the rays again for each reflection instead of storing a matrix")},
    {.key = {0}}};

/* The format given by the output file's extension. */
static bool find_format(factor_command *given) {
    if (given->format != NULL || given->output == NULL)
        return true;
    const char *const dot = strrchr(given->output, '.');
    const char *const ending = dot != NULL ? dot + 1 : "";
    const char *const slash = strrchr(given->output, '/');
    if (strncmp(slash != NULL ? slash + 1 : given->output, "vfsparse.inp", 12) == 0)
        given->format = "udales";
    else if (strcmp(ending, "npz") == 0 || strcmp(ending, "csv") == 0 || strcmp(ending, "vs3") == 0)
        given->format = ending;
    else if (strcmp(ending, "txt") == 0 || strcmp(ending, "vf") == 0)
        given->format = "view3d";
    if (given->format != NULL)
        return true;
    cli_bad_usage("viewfactors: unknown format of '%s': expected .npz, .csv, .txt, .vf or .vs3, or --to",
                  given->output);
    return false;
}

/* Whether radiosities are printed instead of a matrix. */
static bool is_radiosity(const cli_call *call) {
    const factor_command *const given = call->options;
    return cli_given(call, "radiosity") != NULL || (given->surfaces != NULL && !given->script);
}

static bool options_fit(const cli_call *call) {
    factor_command *const given = call->options;
    const bool radiosity = is_radiosity(call);
    const char *conflict = NULL;
    if (given->matrix_free && !radiosity)
        conflict = "--matrix-free needs --radiosity RHO or --surfaces";
    else if (given->matrix_free && given->factors.error > 0.0)
        conflict = "--error cannot be used with --matrix-free";
    else if (given->script && cli_given(call, "radiosity") != NULL)
        conflict = "--script-f cannot be used with --radiosity";
    else if (given->surfaces != NULL && cli_given(call, "radiosity") != NULL)
        conflict = "--surfaces has the reflectances: --radiosity cannot be used";
    else if (given->surfaces != NULL && cli_given(call, "emission") != NULL)
        conflict = "--surfaces has the emissions: --emission cannot be used";
    else if (radiosity && given->format != NULL)
        conflict = "--radiosity and --surfaces write CSV: --to cannot be used";
    if (conflict != NULL)
        cli_bad_usage("viewfactors: %s", conflict);
    return conflict == NULL && (radiosity || find_format(given));
}

/* The light sources: the sky unless others are given. */
static bool read_light(const cli_call *call) {
    factor_command *const given = call->options;
    const bool other = given->sun != NULL || cli_given(call, "emission") != NULL;
    given->light.size = sizeof given->light;
    if (cli_given(call, "sky") == NULL)
        given->light.sky = other || given->surfaces != NULL ? 0.0 : 1.0;
    if ((other || cli_given(call, "sky") != NULL) && !is_radiosity(call)) {
        cli_bad_usage("viewfactors: --sky, --sun and --emission need --radiosity RHO or --surfaces");
        return false;
    }
    if (given->sun == NULL)
        return true;
    char text[128];
    size_t used = 0, count = 0;
    bool good = true;
    for (const char *at = given->sun; good; ++at) {
        if (*at != ',' && *at != '\0') {
            good = used + 1 < sizeof text;
            text[used] = *at;
            used += good;
            continue;
        }
        text[used] = '\0';
        used = 0;
        good = count < 3 && aur_parse_double(text, &given->light.sun[count]);
        ++count;
        if (*at == '\0')
            break;
    }
    const double *const sun = given->light.sun;
    const double length = sqrt(sun[0] * sun[0] + sun[1] * sun[1] + sun[2] * sun[2]);
    if (good && count == 3 && length > 0.0 && length <= 1e30)
        return true;
    cli_bad_usage("viewfactors: --sun: expected a direction X,Y,Z that is not 0 (found '%s')", given->sun);
    return false;
}

/* Prints a summary. */
static int print_summary(const aur_view_factors *factors, report_format format) {
    aur_view_factors_description d = {.size = sizeof d};
    aur_view_factors_matrix m = {.size = sizeof m};
    aur_view_factors_get_description(factors, &d, NULL);
    aur_view_factors_get_matrix(factors, &m, NULL);
    report_table *const table = report_create(0, NULL);
    report_fact_number(table, "rows", (double)m.rows);
    report_fact_number(table, "entries", (double)m.starts[m.rows]);
    report_fact_number(table, "rays", (double)d.rays);
    report_fact_number(table, "closed_pairs", (double)d.closed_pairs);
    report_fact_number(table, "sampled_pairs", (double)d.sampled_pairs);
    report_fact_number(table, "closed_share", d.closed_share);
    report_fact_number(table, "raw_row_error", d.raw_row_error);
    report_fact_number(table, "moved", d.moved);
    report_fact_number(table, "largest_row_error", d.largest_row_error);
    report_fact_number(table, "unseen", d.unseen);
    return cli_finish(table, format);
}

static int write_matrix(const aur_facets *facets, const factor_command *given, const double *emittances) {
    aur_error error;
    aur_view_factors *factors = NULL, *script = NULL;
    aur_result result = aur_view_factors_create(facets, &given->factors, &factors, &error);
    cli_progress_clear();
    if (result == AUR_OK && given->script) {
        result = aur_view_factors_script(factors, emittances, given->factors.confidence, &script, &error);
        aur_view_factors_destroy(factors);
        factors = script;
    }
    if (result == AUR_OK && given->format != NULL)
        result = aur_view_factors_write(factors, given->format, given->output != NULL ? given->output : "-",
                                        &error);
    int status = cli_status(result, &error);
    if (result == AUR_OK && given->format == NULL)
        status = print_summary(factors, given->common.format);
    aur_view_factors_destroy(factors);
    return status;
}

/* In units of a ray's time: a half plane takes three, edges half of the default number of rays. */
static void plan(const factor_command *given) {
    static cli_phase phases[] = {{"tracing rays", 0.0},
                                 {"measuring the sky", 0.0},
                                 {"integrating along edges", 0.0},
                                 {"combining rows", 0.0}};
    const double rays = given->factors.rays > 0 ? (double)given->factors.rays : 2048.0;
    const bool all = !given->factors.rays_only;
    phases[0].work = rays;
    phases[1].work = !all                             ? 0.0
                     : given->factors.half_planes > 0 ? 3.0 * (double)given->factors.half_planes
                                                      : 4.5 * rays;
    phases[2].work = all ? 1024.0 : 0.0;
    phases[3].work = 64.0;
    if (!given->matrix_free) /* progress with a single phase */
        cli_progress_plan(sizeof phases / sizeof phases[0], phases);
}

static int write_results(const cli_call *call, const aur_facets *facets, const cli_surfaces *surfaces) {
    factor_command *const given = call->options;
    aur_error error;
    if (is_radiosity(call)) {
        given->light.reflectances = surfaces->reflectances;
        given->light.emissions = surfaces->emissions;
        return cli_viewfactors_radiosity(facets, &given->factors, given->matrix_free, given->surfaces != NULL,
                                         &given->light, given->common.format, given->output);
    }
    if (given->format != NULL && strcmp(given->format, "vs3") == 0)
        return cli_status(aur_facets_write_vs3(facets, given->output != NULL ? given->output : "-", &error),
                          &error);
    const double *const emittances =
        surfaces->emittances != NULL ? surfaces->emittances : aur_facets_emittances(facets);
    if (given->script && emittances == NULL)
        return cli_bad_usage("viewfactors: --script-f needs emittances: give --surfaces FILE");
    return write_matrix(facets, given, emittances);
}

static int run(const cli_call *call) {
    factor_command *const given = call->options;
    if (!options_fit(call) || !read_light(call))
        return CLI_BAD_INPUT;
    given->facets.size = sizeof given->facets;
    given->facets.definition_count = given->definitions.count;
    given->facets.definitions = given->definitions.items;
    given->facets.confine = given->definitions.confine;
    given->facets.diffuse = given->definitions.diffuse;
    given->facets.further_count = call->operand_count - 1;
    given->facets.further = (const char *const *)call->operands + 1;
    given->facets.warnings = given->factors.warnings = cli_warnings(given->common.quiet);
    given->factors.threads = given->common.threads;
    given->factors.size = sizeof given->factors;
    given->factors.progress = cli_progress(given->common.quiet);
    plan(given);
    aur_error error;
    aur_facets *facets = NULL;
    if (aur_facets_load(call->operands[0], &given->facets, &facets, &error) != AUR_OK)
        return cli_fail(&error);
    cli_surfaces surfaces = {NULL, NULL, NULL};
    int status =
        given->surfaces != NULL ? cli_surfaces_read(given->surfaces, facets, &surfaces) : CLI_SUCCESS;
    if (status == CLI_SUCCESS)
        status = write_results(call, facets, &surfaces);
    free(surfaces.emittances);
    aur_facets_destroy(facets);
    return status;
}

const cli_command cli_command_viewfactors = {
    .name = "viewfactors",
    .summary = "compute view factors between the facets of a mesh",
    .notes = "Facets face along their normals; corners are counter-clockwise as seen from the front. "
             "Unobstructed pairs have closed forms, other pairs are estimated by rays. Each row and its sky "
             "factor sum to 1, and areas times factors are symmetric. See docs/view-factors.md.",
    .too_few = "no mesh or scene given",
    .operands = {{"MESH",
                  "a mesh (.obj, .ply, .stl, .off), View3D's input (.vs3) or a scene (.xml, .rad, .glb, "
                  "...); further files go "
                  "on with a scene",
                  .repeated = true, .content = "file"}},
    .groups = {{options, 0},
               {cli_definitions_option, offsetof(factor_command, definitions)},
               {cli_threads_option, offsetof(factor_command, common)},
               {cli_format_option, offsetof(factor_command, common)},
               {cli_quiet_option, offsetof(factor_command, common)}},
    .size = sizeof(factor_command),
    .run = run,
};
