/* Figures of named sets that an independent program has computed. */
#include "check.h"

#include <aureole/quality.h>
#include <aureole/sphere.h>

typedef struct golden {
    const char *set;
    size_t count;
    aur_domain domain;
    const char *metric;
    double value, tolerance;
} golden;

static double measured(const golden *g) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(g->count, g->domain, &options, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    aur_points *points;
    aur_error error = {0};
    if (aur_points_generate(g->set, &request, &points, &error) != AUR_OK)
        print_error("%s: %s\n", g->set, error.message);
    double value = NAN;
    assert_int_equal(aur_measure(g->metric, aur_points_get_view(points), NULL, &value, &error), AUR_OK);
    aur_points_destroy(points);
    return value;
}

/* C = E^2 N^(3/2). */
static void energies_of_mapped_sets(void **state) {
    (void)state;
    static const golden table[] = {
        {"spherical-fibonacci", 64, AUR_DOMAIN_SPHERE, "energy", 0.8258, 0.51e-4},
        {"spherical-fibonacci", 1024, AUR_DOMAIN_SPHERE, "energy", 0.8128, 0.51e-4},
        {"larcher-pillichshammer", 1024, AUR_DOMAIN_SPHERE, "energy", 0.957, 0.51e-3},
        {"hammersley", 1024, AUR_DOMAIN_SPHERE, "energy", 0.967, 0.51e-3},
        {"sobol", 1024, AUR_DOMAIN_SPHERE, "energy", 1.508, 0.51e-3},
        {"halton", 1024, AUR_DOMAIN_SPHERE, "energy", 1.695, 0.51e-3},
        {"faure:base=3", 1024, AUR_DOMAIN_SPHERE, "energy", 2.34, 0.51e-2},
        {"spherical-fibonacci", 1024, AUR_DOMAIN_HEMISPHERE, "energy", 0.6036, 0.51e-4},
        {"larcher-pillichshammer", 1024, AUR_DOMAIN_HEMISPHERE, "energy", 0.681, 0.51e-3},
        {"sobol", 1024, AUR_DOMAIN_HEMISPHERE, "energy", 1.010, 0.51e-3},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i) {
        const double energy = measured(&table[i]);
        assert_near(energy * energy * pow((double)table[i].count, 1.5), table[i].value, table[i].tolerance);
    }
}

static void other_figures(void **state) {
    (void)state;
    static const golden table[] = {
        {"spherical-fibonacci", 64, AUR_DOMAIN_SPHERE, "scd", 2.83981e-2, 0.51e-7},
        {"spherical-fibonacci", 256, AUR_DOMAIN_SPHERE, "scd", 9.97857e-3, 0.51e-8},
        {"spherical-fibonacci", 4096, AUR_DOMAIN_SPHERE, "scd", 1.24430e-3, 0.51e-8},
        {"sobol", 64, AUR_DOMAIN_SPHERE, "scd", 3.62695e-2, 0.51e-7},
        {"sobol", 4096, AUR_DOMAIN_SPHERE, "scd", 1.79820e-3, 0.51e-8},
        {"spherical-fibonacci", 64, AUR_DOMAIN_SPHERE, "cap", 0.072890, 0.51e-6},
        {"sobol", 64, AUR_DOMAIN_SPHERE, "cap", 0.092349, 0.51e-6},
        {"hammersley", 64, AUR_DOMAIN_SQUARE, "star", 0.053711, 0.51e-6},
        {"sobol", 64, AUR_DOMAIN_SQUARE, "star", 0.053711, 0.51e-6},
        {"larcher-pillichshammer", 64, AUR_DOMAIN_SQUARE, "star", 0.041016, 0.51e-6},
        {"fibonacci-lattice:offset=0.5", 64, AUR_DOMAIN_SQUARE, "star", 0.036170, 0.51e-6},
        {"golden-set", 64, AUR_DOMAIN_SQUARE, "star", 0.035574, 0.51e-6},
        {"r2", 64, AUR_DOMAIN_SQUARE, "star", 0.073908, 0.51e-6},
        {"hammersley", 1024, AUR_DOMAIN_SQUARE, "star", 0.004665, 0.51e-6},
        {"sobol", 1024, AUR_DOMAIN_SQUARE, "star", 0.004299, 0.51e-6},
        {"larcher-pillichshammer", 1024, AUR_DOMAIN_SQUARE, "star", 0.003338, 0.51e-6},
        {"fibonacci-lattice:offset=0.5", 1024, AUR_DOMAIN_SQUARE, "star", 0.003142, 0.51e-6},
        {"golden-set", 1024, AUR_DOMAIN_SQUARE, "star", 0.003288, 0.51e-6},
        {"r2", 1024, AUR_DOMAIN_SQUARE, "star", 0.006302, 0.51e-6},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i)
        assert_near(measured(&table[i]), table[i].value, table[i].tolerance);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energies_of_mapped_sets),
        cmocka_unit_test(other_figures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
