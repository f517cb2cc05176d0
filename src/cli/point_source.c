#include "cli/point_source.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool cli_parse_domain(const char *text, aur_domain *domain) {
    aur_error error = {0};
    return cli_succeeded(aur_domain_from_name(text, domain, &error), &error);
}

bool cli_succeeded(aur_result result, const aur_error *error) {
    if (result != AUR_OK)
        cli_fail(error);
    return result == AUR_OK;
}

static bool parse_density(const char *text, bool *optimal) {
    static const char *const words[] = {"same", "optimal"};
    size_t index;
    if (!cli_parse_word("--density", text, 2, words, &index))
        return false;
    *optimal = index == 1;
    return true;
}

bool cli_parse_point_option(int option, const char *text, cli_point_options *points) {
    aur_error error = {0};
    switch (option) {
    case CLI_POINTS_DOMAIN:
        points->domain_given = true;
        return cli_parse_domain(text, &points->domain);
    case CLI_POINTS_DIM:
        return cli_parse_size("--dim", text, 1, 1u << 20, &points->dimension);
    case CLI_POINTS_MAP:
        return cli_succeeded(aur_map_from_name(text, &points->map, &error), &error);
    case CLI_POINTS_LOBE:
        return cli_succeeded(aur_lobe_parse(text, &points->lobe, &error), &error);
    case CLI_POINTS_DENSITY:
        return parse_density(text, &points->optimal_density);
    case CLI_POINTS_SMOOTHNESS:
        return cli_parse_number("--smoothness", text, 1.0, 2.0, &points->smoothness);
    case CLI_POINTS_SCRAMBLE:
        return cli_succeeded(aur_scramble_from_name(text, &points->scramble, &error), &error);
    case CLI_POINTS_SEED:
        return cli_parse_u64("--seed", text, &points->seed);
    default:
        return false;
    }
}

bool cli_is_file(const char *text) {
    const size_t length = strcspn(text, ":");
    for (size_t i = 0; i < aur_set_count(); ++i) {
        const char *const name = aur_set_at(i)->row.name;
        if (strlen(name) == length && strncmp(name, text, length) == 0)
            return false;
    }
    if (strncmp(text, "file:", 5) == 0)
        return false;
    return strcmp(text, "-") == 0 || access(text, F_OK) == 0;
}

/* Weights of 1/N say nothing. */
static bool are_equal(size_t count, const double *weights) {
    for (size_t i = 0; i < count; ++i)
        if (!(fabs(weights[i] * (double)count - 1.0) <= 1e-12))
            return false;
    return true;
}

static aur_result load(const char *text, const cli_point_options *options, size_t count, aur_points **points,
                       aur_error *error) {
    if (cli_is_file(text))
        return options->domain_given ? aur_points_read_on(text, options->domain, points, error)
                                     : aur_points_read(text, points, error);
    const bool cube = options->domain == AUR_DOMAIN_SQUARE || options->domain == AUR_DOMAIN_CUBE;
    const aur_directions_options directions = {.size = sizeof directions,
                                               .count = count,
                                               .domain = options->domain,
                                               .map = options->map,
                                               .lobe = options->lobe,
                                               .optimal_density = options->optimal_density,
                                               .smoothness = options->smoothness,
                                               .scramble = options->scramble,
                                               .seed = options->seed,
                                               .warnings = options->warnings};
    aur_points_request request = aur_points_request_default(&directions);
    request.dimension = cube ? options->dimension : 0;
    return aur_points_generate(text, &request, points, error);
}

aur_result cli_load_points(const char *text, const cli_point_options *options, size_t count,
                           aur_points **points, aur_points_view *view, aur_error *error) {
    *error = (aur_error){0};
    const aur_result result = load(text, options, count, points, error);
    if (result != AUR_OK)
        return result;
    *view = *aur_points_look(*points);
    if (cli_is_file(text) && view->weights != NULL && are_equal(view->count, view->weights))
        view->weights = NULL;
    return AUR_OK;
}
