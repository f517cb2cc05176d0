/* Points of aureole_sampling.h compared with those of libaureole, bit by bit; C99 and C++. */
#include <aureole/sphere.h>
#include <aureole_sampling.h>
#include <stdio.h>

enum { COUNT = 1000 };

static int failures;

static void same(const char *what, size_t count, const double *expected, const double *found) {
    if (memcmp(expected, found, count * sizeof *found) == 0)
        return;
    ++failures;
    for (size_t i = 0; i < count; ++i)
        if (expected[i] != found[i]) {
            printf("%s: number %u is %.17g, and the library's %.17g\n", what, (unsigned)i, found[i],
                   expected[i]);
            return;
        }
}

/* Points of the library's set. */
static void take(const char *set, aur_domain domain, size_t dimension, aur_scramble scramble,
                 double *points) {
    aur_error error;
    aur_directions_options options;
    options.size = sizeof options;
    aur_directions_options_init(COUNT, domain, &options, NULL);
    aur_points_request request;
    request.size = sizeof request;
    aur_points_request_init(&options, &request, NULL);
    aur_points *generated = NULL;
    options.scramble = scramble;
    options.seed = 11;
    request.dimension = dimension;
    if (aur_points_generate(set, &request, &generated, &error) != AUR_OK) {
        printf("%s: %s\n", set, error.message);
        ++failures;
        return;
    }
    memcpy(points, aur_points_get_view(generated)->coordinates,
           COUNT * aur_points_get_view(generated)->dimension * sizeof *points);
    aur_points_destroy(generated);
}

static void squares(void) {
    static double expected[2 * COUNT], found[2 * COUNT];
    take("sobol", AUR_DOMAIN_SQUARE, 2, AUR_SCRAMBLE_NONE, expected);
    for (uint32_t i = 0; i < COUNT; ++i)
        aureole_sobol_2d(i, found + 2 * i);
    same("sobol", 2 * COUNT, expected, found);
    take("sobol", AUR_DOMAIN_SQUARE, 2, AUR_SCRAMBLE_OWEN, expected);
    for (uint32_t i = 0; i < COUNT; ++i)
        aureole_sobol_2d_owen(i, 11, found + 2 * i);
    same("sobol, scrambled", 2 * COUNT, expected, found);
    take("hammersley", AUR_DOMAIN_SQUARE, 2, AUR_SCRAMBLE_NONE, expected);
    for (uint32_t i = 0; i < COUNT; ++i)
        aureole_hammersley_2d(i, COUNT, found + 2 * i);
    same("hammersley", 2 * COUNT, expected, found);
    take("r2", AUR_DOMAIN_SQUARE, 2, AUR_SCRAMBLE_NONE, expected);
    for (uint32_t i = 0; i < COUNT; ++i)
        aureole_r2_2d(i, found + 2 * i);
    same("r2", 2 * COUNT, expected, found);
    take("golden", AUR_DOMAIN_CUBE, 1, AUR_SCRAMBLE_NONE, expected);
    for (uint32_t i = 0; i < COUNT; ++i)
        found[i] = aureole_golden(i);
    same("golden", COUNT, expected, found);
}

static void maps(void) {
    static double square[2 * COUNT], expected[3 * COUNT], found[3 * COUNT];
    take("sobol", AUR_DOMAIN_SQUARE, 2, AUR_SCRAMBLE_OWEN, square);
    for (int map = 0; map < 4; ++map) {
        const char *const name = aur_map_name((aur_map)map);
        aur_map_to_disk((aur_map)map, COUNT, square, expected, NULL);
        for (size_t i = 0; i < COUNT; ++i)
            aureole_point_to_disk((aureole_map)map, square + 2 * i, found + 2 * i);
        same(name, 2 * COUNT, expected, found);
        aur_map_to_cap((aur_map)map, AUR_CAP_HEMISPHERE, COUNT, square, expected, NULL);
        for (size_t i = 0; i < COUNT; ++i)
            aureole_point_to_hemisphere((aureole_map)map, square + 2 * i, found + 3 * i);
        same(name, 3 * COUNT, expected, found);
        aur_map_to_cap((aur_map)map, AUR_CAP_SPHERE, COUNT, square, expected, NULL);
        for (size_t i = 0; i < COUNT; ++i)
            aureole_point_to_sphere((aureole_map)map, square + 2 * i, found + 3 * i);
        same(name, 3 * COUNT, expected, found);
    }
}

static void spheres(void) {
    static double expected[3 * COUNT], found[3 * COUNT];
    for (int whole = 0; whole < 2; ++whole) {
        const aur_domain domain = whole ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_HEMISPHERE;
        take("spherical-fibonacci", domain, 0, AUR_SCRAMBLE_NONE, expected);
        for (size_t i = 0; i < COUNT; ++i)
            aureole_spherical_fibonacci(COUNT, 1.0 + whole, i, found + 3 * i);
        same("spherical-fibonacci", 3 * COUNT, expected, found);
        take("esfg:base=63,levels=2,first-shift=paper", domain, 0, AUR_SCRAMBLE_NONE, expected);
        for (size_t i = 0; i < COUNT; ++i)
            aureole_grid_point(63, 2, aureole_grid_first_shift(63, 1.0), 1.0 + whole, i, found + 3 * i);
        same("esfg", 3 * COUNT, expected, found);
    }
}

int main(void) {
    squares();
    maps();
    spheres();
    return failures != 0;
}
