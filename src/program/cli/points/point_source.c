#include "program/cli/points/point_source.h"

#include <aureole/ranks.h>
#include <aureole/text.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static aur_result parse_lobe(const char *text, void *field, aur_error *error) {
    return aur_lobe_parse(text, field, error);
}

const cli_option cli_points_options[] = {
    {CLI_CHOICE(cli_points, options.domain, "domain", "DOMAIN", "from the other options",
                "domain of the points"),
     .key.computed = true, .name = aur_domain_name},
    {CLI_CHOICE(cli_points, options.map, "map", "MAP", "lambert", "map from the square to other domains"),
     .name = aur_map_name},
    {CLI_TEXT(cli_points, options.lobe, "lobe", "LOBE", "uniform on a hemisphere",
              "density of points on the hemisphere; implies --domain hemisphere"),
     .key.computed = true,
     .key.words = (const char *const[]){"uniform", "cosine", "phong:M", "ggx:ALPHA[:VIEW_DEGREES]",
                                        "visible:ALPHA[:VIEW_DEGREES]", NULL},
     .parse = parse_lobe},
    {CLI_CHOICE(cli_points, options.optimal_density, "density", "DENSITY", "same",
                "sample the lobe, or its power 2/(s+1) with weights"),
     .key.words = (const char *const[]){"same", "optimal", NULL}},
    {CLI_REAL(cli_points, options.smoothness, "smoothness", "S", 1, 6, "1.5",
              "smoothness s of the integrand, for optimal densities and weights; not an integer"),
     .key.minimum_open = true, .key.maximum_open = true},
    {CLI_CHOICE(cli_points, options.scramble, "scramble", "SCRAMBLE", "none", "randomisation of the points"),
     .name = aur_scramble_name},
    {CLI_INTEGER(cli_points, options.seed, "seed", "S", 0, INFINITY, "0",
                 "random seed of random sets and scrambling")},
    {.key = {0}}};

const cli_option cli_dimension_option[] = {
    {CLI_INTEGER(cli_points, dimension, "dim", "D", 1, INFINITY, "2", "dimensions of sets on the cube"),
     .key.computed = true},
    {.key = {0}}};

const cli_option cli_cap_option[] = {
    {CLI_REAL(cli_points, options.cap_degrees, "cap", "DEGREES", 1e-6, 180, NULL,
              "place all N points in the cap of this polar angle around +z; on the sphere if wider than 90")},
    {.key = {0}}};

bool cli_is_file(const char *text) {
    if (aur_set_find(text) != NULL || strncmp(text, "file:", 5) == 0)
        return false;
    bool exists = strcmp(text, "-") == 0 || access(text, F_OK) == 0;
    aur_ranks_agree(sizeof exists, &exists);
    return exists;
}

bool cli_is_sized_file(const char *text) {
    struct stat status;
    if (strncmp(text, "file:", 5) != 0)
        return false;
    return stat(text + 5, &status) == 0 ? S_ISDIR(status.st_mode) : strstr(text, "%d") != NULL;
}

bool cli_has_size(const char *text) {
    return cli_is_file(text) || (strncmp(text, "file:", 5) == 0 && !cli_is_sized_file(text));
}

/* Whether all weights are 1/N. */
static bool are_equal(size_t count, const double *weights) {
    for (size_t i = 0; i < count; ++i)
        if (!(fabs(weights[i] * (double)count - 1.0) <= 1e-12))
            return false;
    return true;
}

void cli_warn_of_guess(const char *path, const aur_points_view *points, aur_warnings warnings) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    aur_format(text, sizeof text,
               "%s: the file does not state the domain of its points; assuming the %s: --domain sets it "
               "(sphere, axes, cube)",
               path, aur_domain_name(points->domain));
    if (points->guessed && warnings.function != NULL)
        warnings.function(warnings.user, text);
}

static aur_result load(const char *text, const cli_points *from, size_t count, aur_points **points,
                       aur_error *error) {
    const aur_domain domain = from->options.domain;
    if (cli_is_file(text)) {
        const aur_result result = aur_points_read(text, from->domain_given ? &domain : NULL, points, error);
        const size_t available = result == AUR_OK ? aur_points_get_view(*points)->count : count;
        if (count == 0 || available == count)
            return result;
        aur_points_destroy(*points);
        *points = NULL;
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "%s has %zu points, not %zu: omit -n, or use file:PATH to take the first ones", text,
                        available, count);
    }
    aur_directions_options options = from->options;
    options.size = sizeof options;
    options.count = count;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    request.natural_domain = from->natural_domain;
    const bool cube = from->natural_domain || domain == AUR_DOMAIN_SQUARE || domain == AUR_DOMAIN_CUBE;
    request.dimension = cube ? from->dimension : 0;
    return aur_points_generate(text, &request, points, error);
}

aur_result cli_load_points(const char *text, const cli_points *from, size_t count, aur_points **points,
                           aur_points_view *view, aur_error *error) {
    *error = (aur_error){0};
    const aur_result result = load(text, from, count, points, error);
    if (result != AUR_OK)
        return result;
    *view = *aur_points_get_view(*points);
    cli_warn_of_guess(text, view, from->options.warnings);
    if (cli_is_file(text) && view->weights != NULL && are_equal(view->count, view->weights))
        view->weights = NULL;
    return AUR_OK;
}

aur_result cli_parse_symmetry(const char *text, aur_domain domain, cli_symmetry *symmetry, aur_error *error) {
    *symmetry = (cli_symmetry){.given = text != NULL};
    if (text == NULL)
        return AUR_OK;
    if (domain == AUR_DOMAIN_SPHERE)
        return aur_point_group_from_name(text, &symmetry->group, error);
    if (domain != AUR_DOMAIN_ROTATIONS)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "--symmetry: needs --domain sphere or rotations");
    char crystal[16];
    const char *const colon = strchr(text, ':');
    aur_format(crystal, sizeof crystal, "%.*s", colon != NULL ? (int)(colon - text) : 15, text);
    const aur_result result = aur_symmetry_from_name(crystal, &symmetry->crystal, error);
    return result != AUR_OK || colon == NULL ? result
                                             : aur_symmetry_from_name(colon + 1, &symmetry->sample, error);
}
