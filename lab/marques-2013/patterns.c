#include "patterns.h"

size_t marques_patterns(const lab_run *run, marques_pattern patterns[MARQUES_PATTERNS]) {
    static const marques_pattern others[] = {
        {"larcher-pillichshammer", "lambert", AUR_MAP_LAMBERT, AUR_SCRAMBLE_DIGIT},
        {"bnot", "lambert", AUR_MAP_LAMBERT, AUR_SCRAMBLE_ROTATE},
        {"sobol", "lambert", AUR_MAP_LAMBERT, AUR_SCRAMBLE_DIGIT},
    };
    const char *const set = lab_run_options(run)->set;
    size_t count = 0;
    patterns[count++] = (marques_pattern){"spherical-fibonacci", "-", AUR_MAP_LAMBERT, AUR_SCRAMBLE_ROTATE};
    for (aur_map map = AUR_MAP_LAMBERT; map <= AUR_MAP_CONCENTRIC; ++map) {
        for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i) {
            patterns[count] = others[i];
            patterns[count].map = map;
            patterns[count++].label = aur_map_name(map);
        }
        if (set != NULL)
            patterns[count++] = (marques_pattern){set, aur_map_name(map), map, AUR_SCRAMBLE_ROTATE};
    }
    return count;
}

aur_result marques_points(const marques_pattern *pattern, aur_domain domain, size_t count, uint64_t seed,
                          aur_points **points, aur_error *error) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    options.map = pattern->map;
    options.scramble = pattern->scramble;
    options.seed = seed;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    return aur_points_generate(pattern->set, &request, points, error);
}
