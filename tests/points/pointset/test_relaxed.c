/* Blue-noise sets: power diagrams against brute force, guarantees of relaxation, and the cache of results. */
#include "points.h"

#include <dirent.h>
#include <unistd.h>

#include "points/base/file.h"
#include "points/base/random.h"
#include "points/pointset/relax/relaxation.h"

static char folder[] = "/tmp/aureole-test-XXXXXX";

/* Independent uniform points. */
static void random_sites(uint64_t seed, size_t count, aur_point2 *sites) {
    for (size_t i = 0; i < count; ++i)
        sites[i] =
            (aur_point2){aur_unit_double(aur_hash3(seed, i, 0)), aur_unit_double(aur_hash3(seed, i, 1))};
}

static void cells_are_those_of_brute_force(void **state) {
    (void)state;
    enum { MOST = 60, SIDE = 300 };
    static const size_t counts[] = {1, 2, 3, 7, MOST};
    aur_point2 sites[MOST];
    double weights[MOST];
    aur_power_cell cells[MOST];
    for (size_t attempt = 0; attempt < 5; ++attempt) {
        const size_t count = counts[attempt];
        random_sites(attempt, count, sites);
        for (size_t i = 0; i < count; ++i)
            weights[i] = 0.02 * aur_unit_double(aur_hash2(attempt, i)) / (double)count;
        aur_power_diagram diagram = {.count = count, .sites = sites, .weights = weights, .cells = cells};
        assert_true(aur_site_grid_create(&diagram.grid, count));
        aur_site_grid_fill(&diagram.grid, count, sites);
        aur_power_diagram_compute(&diagram);
        double areas[MOST] = {0};
        for (size_t c = 0; c < SIDE * SIDE; ++c) {
            const aur_point2 p = {((double)(c % SIDE) + 0.5) / SIDE, ((double)(c / SIDE) + 0.5) / SIDE};
            size_t best = 0;
            double least = INFINITY;
            for (size_t i = 0; i < count; ++i) {
                const aur_point2 d = aur_wrapped_difference(p, sites[i]);
                const double power = d.x * d.x + d.y * d.y - weights[i];
                if (power < least) {
                    least = power;
                    best = i;
                }
            }
            areas[best] += 1.0 / (SIDE * SIDE);
        }
        double total = 0.0;
        for (size_t i = 0; i < count; ++i) {
            /* A grid's error: its cells along a border of length about 4 / sqrt(count). */
            assert_near(cells[i].area, areas[i], 1.0 / SIDE / sqrt((double)count) + 1e-3);
            total += cells[i].area;
        }
        assert_near(total, 1.0, 1e-12);
        aur_site_grid_destroy(&diagram.grid);
    }
}

/* The slopes are the derivatives of the areas: central differences. */
static void slopes_are_derivatives(void **state) {
    (void)state;
    enum { COUNT = 40 };
    static const double h = 1e-7;
    aur_point2 sites[COUNT];
    double weights[COUNT] = {0};
    aur_power_cell cells[COUNT], more[COUNT], less[COUNT];
    random_sites(9, COUNT, sites);
    aur_power_diagram diagram = {.count = COUNT, .sites = sites, .weights = weights, .cells = cells};
    assert_true(aur_site_grid_create(&diagram.grid, COUNT));
    aur_site_grid_fill(&diagram.grid, COUNT, sites);
    aur_power_diagram_compute(&diagram);
    for (size_t j = 0; j < COUNT; j += 7) {
        weights[j] = h;
        diagram.cells = more;
        aur_power_diagram_compute(&diagram);
        weights[j] = -h;
        diagram.cells = less;
        aur_power_diagram_compute(&diagram);
        weights[j] = 0.0;
        for (size_t i = 0; i < COUNT; ++i) {
            double slope = 0.0;
            for (size_t k = 0; k < cells[i].edge_count; ++k) {
                const bool across = cells[i].neighbours[k] == j;
                if (i == j && !across)
                    slope += cells[i].slopes[k];
                else if (i != j && across)
                    slope -= cells[i].slopes[k];
            }
            assert_near((more[i].area - less[i].area) / (2.0 * h), slope, 2e-4);
        }
    }
    aur_site_grid_destroy(&diagram.grid);
}

/* Beginning with the cells of sites that have moved on gives the same cells. */
static void warm_starts_change_nothing(void **state) {
    (void)state;
    enum { COUNT = 300 };
    static aur_point2 sites[COUNT];
    static double weights[COUNT];
    static aur_power_cell cold[COUNT], warm[COUNT];
    for (uint64_t attempt = 0; attempt < 20; ++attempt) {
        random_sites(attempt, COUNT, sites);
        aur_power_diagram diagram = {.count = COUNT, .sites = sites, .weights = weights, .cells = warm};
        assert_true(aur_site_grid_create(&diagram.grid, COUNT));
        aur_site_grid_fill(&diagram.grid, COUNT, sites);
        aur_power_diagram_compute(&diagram);
        for (size_t i = 0; i < COUNT; ++i) {
            sites[i].x = aur_unwrap(sites[i].x + 0.05 * (aur_unit_double(aur_hash3(attempt, i, 2)) - 0.5));
            weights[i] = 0.001 * aur_unit_double(aur_hash3(attempt, i, 3));
        }
        aur_site_grid_fill(&diagram.grid, COUNT, sites);
        diagram.warm = true;
        aur_power_diagram_compute(&diagram);
        diagram.warm = false;
        diagram.cells = cold;
        aur_power_diagram_compute(&diagram);
        for (size_t i = 0; i < COUNT; ++i) {
            /* The order of the cuts differs, and so does rounding: borders of length below 1. */
            assert_near(warm[i].area, cold[i].area, 1e-14);
            assert_near(warm[i].centre.x, cold[i].centre.x, 1e-10);
        }
        aur_site_grid_destroy(&diagram.grid);
    }
}

/* Mean power of the frequencies 0 < |k| < radius: 1 for independent points. */
static double low_power(size_t count, const double *points, int radius) {
    double sum = 0.0;
    size_t frequencies = 0;
    for (int kx = 0; kx <= radius; ++kx) {
        for (int ky = -radius; ky <= radius; ++ky) {
            if (kx * kx + ky * ky >= radius * radius || (kx == 0 && ky <= 0))
                continue;
            double real = 0.0, imaginary = 0.0;
            for (size_t i = 0; i < count; ++i) {
                const double phase = 6.283185307179586 * (kx * points[2 * i] + ky * points[2 * i + 1]);
                real += cos(phase);
                imaginary += sin(phase);
            }
            sum += (real * real + imaginary * imaginary) / (double)count;
            ++frequencies;
        }
    }
    return sum / (double)frequencies;
}

/* The least distance on the torus, in units of the hexagonal lattice's. */
static double least_distance(size_t count, const double *points) {
    double least = INFINITY;
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = 0; j < i; ++j) {
            const double x = aur_wrap(points[2 * i] - points[2 * j]);
            const double y = aur_wrap(points[2 * i + 1] - points[2 * j + 1]);
            least = fmin(least, x * x + y * y);
        }
    }
    return sqrt(least * (double)count * sqrt(3.0) / 2.0);
}

/* The relative deviation of the areas of Voronoi cells: .53 for independent points. */
static double area_deviation(size_t count, const double *points) {
    double *const weights = calloc(count, sizeof *weights);
    aur_power_cell *const cells = malloc(count * sizeof *cells);
    aur_point2 *const sites = malloc(count * sizeof *sites);
    assert_true(weights != NULL && cells != NULL && sites != NULL);
    memcpy(sites, points, count * sizeof *sites);
    aur_power_diagram diagram = {.count = count, .sites = sites, .weights = weights, .cells = cells};
    assert_true(aur_site_grid_create(&diagram.grid, count));
    aur_site_grid_fill(&diagram.grid, count, sites);
    aur_power_diagram_compute(&diagram);
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += pow((double)count * cells[i].area - 1.0, 2.0);
    aur_site_grid_destroy(&diagram.grid);
    free(weights);
    free(cells);
    free(sites);
    return sqrt(sum / (double)count);
}

static void points_are_blue(void **state) {
    (void)state;
    static const char *const sets[] = {"blue-noise", "bnot"};
    enum { COUNT = 256 };
    for (size_t k = 0; k < 2; ++k) {
        double *const points = make_points(
            sets[k], (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = COUNT, .seed = 3});
        assert_true(low_power(COUNT, points, 6) < 0.03);
        assert_true(least_distance(COUNT, points) > 0.6);
        assert_true(area_deviation(COUNT, points) < 0.1);
        free(points);
    }
    double *const random = make_points(
        "random", (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = COUNT, .seed = 3});
    assert_true(low_power(COUNT, random, 6) > 0.5);
    assert_true(area_deviation(COUNT, random) > 0.4);
    free(random);
}

static void every_small_size_works(void **state) {
    (void)state;
    for (uint64_t count = 1; count <= 12; ++count) {
        free(make_points("blue-noise",
                         (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = count}));
        free(make_points("bnot",
                         (aur_pointset_options){.size = sizeof(aur_pointset_options), .count = count}));
    }
}

/* core/cache_file tests storage and the rejection of damaged files. */
static void results_are_cached(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    setenv("AUREOLE_CACHE", folder, 1);
    const aur_pointset_options options = {.size = sizeof options, .count = 20, .seed = 5};
    double *const computed = make_points("bnot", options);
    size_t size;
    char *const stored = aur_cache_file_read("bnot", "bnot 2 20 5", &size);
    assert_non_null(stored);
    assert_int_equal(size, 40 * sizeof *computed);
    /* Reads return the stored data, whatever they are, unless they are too short. */
    const double half = 0.5;
    memcpy(stored, &half, sizeof half);
    aur_cache_file_write("bnot", "bnot 2 20 5", size, stored);
    double *const read = make_points("bnot", options);
    assert_true(read[0] == half);
    assert_memory_equal(computed + 1, read + 1, 39 * sizeof *read);
    free(read);
    aur_cache_file_write("bnot", "bnot 2 20 5", size - 8, stored);
    double *const again = make_points("bnot", options);
    assert_memory_equal(computed, again, 40 * sizeof *again);
    free(again);
    free(stored);
    setenv("AUREOLE_CACHE", "", 1);
    double *const unkept = make_points("bnot", options);
    assert_memory_equal(computed, unkept, 40 * sizeof *unkept);
    free(unkept);
    free(computed);
    DIR *const all = opendir(folder);
    for (struct dirent *entry; (entry = readdir(all)) != NULL;)
        (void)unlinkat(dirfd(all), entry->d_name, 0); /* it has one file */
    closedir(all);
    assert_int_equal(rmdir(folder), 0);
}

int main(void) {
    setenv("AUREOLE_CACHE", "", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_those_of_brute_force), cmocka_unit_test(slopes_are_derivatives),
        cmocka_unit_test(warm_starts_change_nothing),     cmocka_unit_test(points_are_blue),
        cmocka_unit_test(every_small_size_works),         cmocka_unit_test(results_are_cached),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
