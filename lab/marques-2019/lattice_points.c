/* Checks the library's points against the statements on their lattice. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "lattice.h"
#include "program/lab/points.h"

/* The points of a set of the sphere in the plane, as u, v pairs; the caller frees them. */
static aur_result to_plane(const char *set, size_t size, double **plane, aur_error *error) {
    aur_points *generated;
    const aur_result result = lab_points_make(
        &(lab_points){.set = set, .domain = AUR_DOMAIN_SPHERE, .size = size}, &generated, error);
    *plane = NULL;
    if (result != AUR_OK)
        return result;
    const aur_points_view *const points = aur_points_get_view(generated);
    *plane = malloc(2 * size * sizeof **plane);
    for (size_t i = 0; i < size && *plane != NULL; ++i)
        aur_map_from_cap(AUR_MAP_LAMBERT, AUR_CAP_SPHERE, 1, points->coordinates + points->stride * i,
                         *plane + 2 * i, NULL);
    aur_points_destroy(generated);
    if (*plane != NULL)
        return AUR_OK;
    *error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    return AUR_ERROR_MEMORY;
}

/* The distance of y from the nearest integer, for points of a plane that is periodic in y. */
static double wrapped(double y) {
    return y - nearbyint(y);
}

/* Eqs 3, 20 and 21: the unshifted grid, whose first point is the pole and has no azimuth. */
static aur_result check_coordinates(lab_run *run, aur_error *error) {
    static const size_t sizes[] = {20, 64, 100, 1000};
    lattice_check slices = lattice_begin("eq. 3, fig. 2", "the points' x are j/N, y the fractions of j/Phi",
                                         0.0, 8.0 * DBL_EPSILON);
    lattice_check whole =
        lattice_begin("eqs 20, 21, fig. 3", "in any basis b_k, b_{k+1} the points' coordinates are integers",
                      0.0, 8000.0 * DBL_EPSILON);
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; ++s) {
        double *plane;
        const double n = (double)sizes[s];
        const aur_result result = to_plane("spherical-fibonacci:offset=0", sizes[s], &plane, error);
        if (result != AUR_OK)
            return result;
        for (size_t j = 1; j < sizes[s]; ++j) {
            const double x = plane[2 * j], y = plane[2 * j + 1];
            lattice_count(&slices, n, fabs(x - (double)j / n));
            lattice_count(&slices, n, fabs(wrapped(y - (double)j / lattice_golden)) / (double)j);
            double b[2][2];
            for (size_t k = 0; lattice_fibonacci(k + 1) <= n; ++k) {
                lattice_vector(k, n, b[0]);
                lattice_vector(k + 1, n, b[1]);
                const double sign = k % 2 == 0 ? n : -n;
                const double z0 = sign * (b[1][1] * x - b[1][0] * y), z1 = sign * (b[0][0] * y - b[0][1] * x);
                lattice_count(&whole, n, fmax(fabs(wrapped(z0)), fabs(wrapped(z1))));
            }
        }
        free(plane);
    }
    lattice_end(run, &slices);
    lattice_end(run, &whole);
    return AUR_OK;
}

/* The smallest distance between points of the plane, periodic in y. */
static double smallest_distance(size_t count, const double *plane) {
    double least = INFINITY;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < i; ++k)
            least =
                fmin(least, hypot(plane[2 * i] - plane[2 * k], wrapped(plane[2 * i + 1] - plane[2 * k + 1])));
    return least;
}

/* Algorithm 1, including its final shift: must equal the library's set, up to whole turns of y. */
static void extend(size_t base, size_t levels, double *plane) {
    double b[3][2];
    size_t count = base;
    for (size_t k = 0; k < 3; ++k)
        lattice_vector(k, (double)base, b[k]);
    for (size_t j = 0; j < base; ++j) {
        plane[2 * j] = (double)j / (double)base;
        plane[2 * j + 1] = (double)j / lattice_golden;
    }
    for (size_t l = 1; l <= levels; ++l) {
        for (size_t k = 0; k < 3; ++k)
            for (size_t i = 0; i < count; ++i)
                for (size_t c = 0; c < 2; ++c)
                    plane[2 * ((k + 1) * count + i) + c] = plane[2 * i + c] + ldexp(b[k][c], -(int)l);
        count *= 4;
    }
    for (size_t i = 0; i < count; ++i)
        plane[2 * i] += ldexp(1.0 / (double)base, -(int)levels - 1);
}

/* Sections 5.1, 5.2 and 7 on extended grids. */
static aur_result check_extension(lab_run *run, aur_error *error) {
    enum { LEVELS = 2, MOST = 100 << (2 * LEVELS) };
    static const size_t bases[] = {20, 33, 64, 100};
    double expected[2 * MOST];
    lattice_check algorithm =
        lattice_begin("algorithm 1, fig. 7", "the points of E-SFG, each at its index", 0.0, 1e-13);
    lattice_check distance =
        lattice_begin("sec. 5.2, fig. 6", "the smallest distance is halved at each level", 0.0, 1e-12);
    lattice_check poles =
        lattice_begin("sec. 7", "2^l points share each polar angle, here that of the first", 4.0, 4.0);
    for (size_t b = 0; b < sizeof bases / sizeof bases[0]; ++b) {
        const size_t base = bases[b], size = base << (2 * LEVELS);
        char set[64];
        double *plane;
        snprintf(set, sizeof set, "esfg:base=%zu,levels=%d,progression=4", base, LEVELS);
        const aur_result result = to_plane(set, size, &plane, error);
        if (result != AUR_OK)
            return result;
        extend(base, LEVELS, expected);
        size_t shared = 0;
        for (size_t i = 0; i < size; ++i) {
            lattice_count(&algorithm, (double)base,
                          fmax(fabs(plane[2 * i] - expected[2 * i]),
                               fabs(wrapped(plane[2 * i + 1] - expected[2 * i + 1]))));
            shared += fabs(plane[2 * i] - plane[0]) < 1e-12;
        }
        const double n = (double)base, first = sqrt(lattice_length2(lattice_shortest(n, 1.0), n, 1.0));
        lattice_count(&distance, n, fabs(smallest_distance(size, plane) / ldexp(first, -LEVELS) - 1.0));
        lattice_count(&poles, n, (double)shared);
        free(plane);
    }
    lattice_end(run, &algorithm);
    lattice_end(run, &distance);
    lattice_end(run, &poles);
    return AUR_OK;
}

/* Fig. 4c: the cells on the sphere, without those near the poles. */
static aur_result check_cells(lab_run *run, aur_error *error) {
    size_t six = 0;
    lattice_check sides = lattice_begin(
        "fig. 4", "the cells of 1000 points have five to seven sides, within 60 degrees of the equator", 5.0,
        7.0);
    lattice_check areas = lattice_begin("sec. 4.2", "and the mean area, within 2 %", 0.98, 1.02);
    aur_points *generated;
    aur_series *cells = NULL;
    const lab_points grid = {.set = "spherical-fibonacci", .domain = AUR_DOMAIN_SPHERE, .size = 1000};
    aur_result result = lab_points_make(&grid, &generated, error);
    if (result != AUR_OK)
        return result;
    const aur_points_view *const points = aur_points_get_view(generated);
    result = aur_measure_series("voronoi", points, NULL, &cells, error);
    for (size_t i = 0; result == AUR_OK && i < points->count; ++i) {
        const double *const cell = aur_series_values(cells) + i * aur_series_column_count(cells);
        if (fabs(points->coordinates[points->stride * i + 2]) > 0.8660254)
            continue;
        lattice_count(&areas, (double)i, cell[1]);
        lattice_count(&sides, (double)i, cell[3]);
        six += cell[3] == 6.0;
    }
    aur_series_destroy(cells);
    aur_points_destroy(generated);
    if (result == AUR_OK) {
        lattice_end(run, &sides);
        lattice_end(run, &areas);
        lab_note(run, "six sides, as all cells of the plane have, on %zu of %zu cells of the sphere", six,
                 sides.cases);
    }
    return result;
}

/* Drawings: 20 points in the plane, their basis vectors, the grid shifted in x and in y, and the extended
 * one. */
static void show(lab_run *run) {
    static const char *const of_plane[] = {"figure", "what", "x", "y", NULL};
    static const char *const of_vectors[] = {"what", "x", "y", NULL};
    enum { POINTS = 20 };
    report_table *const plane = lab_table(run, "plane", of_plane), *const vectors =
                                                                       lab_table(run, "vectors", of_vectors);
    double grid[2 * 4 * POINTS], b[2];
    extend(POINTS, 1, grid);
    for (size_t i = 0; i < 4 * POINTS; ++i) {
        static const char *const parts[] = {"the grid", "moved by b_0/2", "moved by b_1/2", "moved by b_2/2"};
        const double x = grid[2 * i] - 0.25 / POINTS, y = grid[2 * i + 1] - floor(grid[2 * i + 1]);
        lab_table_row(plane, (const char *const[]){"6", parts[i / POINTS], NULL}, 2, (const double[]){x, y});
        if (i >= POINTS)
            continue;
        lab_table_row(plane, (const char *const[]){"2", parts[0], NULL}, 2, (const double[]){x, y});
        for (size_t c = 0; c < 3; ++c)
            lab_table_row(plane,
                          (const char *const[]){"5",
                                                c == 0   ? parts[0]
                                                : c == 1 ? "moved by 1 in x"
                                                         : "moved by 1 in y",
                                                NULL},
                          2, (const double[]){c == 1 ? x + 1.0 : x, c == 2 ? y + 1.0 : y});
        for (size_t c = 0; c < 2; ++c)
            lab_table_row(vectors, (const char *const[]){"lattice", NULL}, 2,
                          (const double[]){x, y - (double)c});
    }
    for (size_t k = 0; lattice_fibonacci(k) <= POINTS; ++k) {
        char name[16];
        lattice_vector(k, POINTS, b);
        snprintf(name, sizeof name, "b_%zu", k);
        lab_table_row(vectors, (const char *const[]){name, NULL}, 2, b);
    }
}

aur_result lattice_check_points(lab_run *run, aur_error *error) {
    aur_result result = check_coordinates(run, error);
    if (result == AUR_OK)
        result = check_extension(run, error);
    if (result == AUR_OK)
        result = check_cells(run, error);
    if (result == AUR_OK)
        show(run);
    return result;
}
