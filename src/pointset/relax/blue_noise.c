/* Blue noise by capacity-constrained Voronoi tessellation (Balzer, Schloemer, Deussen 2009): every site owns
 * the same number of points of a fine uniform set; points are swapped between two sites while that shortens
 * the sum of squared distances, then sites move to the centres of their points, until hardly a swap is left.
 * On the torus, from random sites, by the seed. A table: n up to 2^16, time in proportion to n above 1024.
 * Error about N^-3/4 and lower for smooth functions; no alignments. */
#include <math.h>
#include <stdlib.h>

#include "pointset/relax/relaxation.h"
#include "pointset/sets.h"

enum {
    VERSION = 1,
    POINT_TARGET = 1 << 20, /* points in all, within the limits of points a site */
    LEAST_CAPACITY = 64,
    MOST_CAPACITY = 512,
    SWEEPS = 100
};

/* Swaps stop when fewer than this share of the points moves in a sweep. */
static const double quiet = 1e-4;

typedef struct tessellation {
    size_t count, capacity; /* sites; points a site */
    aur_point2 *sites;
    aur_point2 *points; /* those of site i at i * capacity */
    double *radii;      /* of a site's points about it */
    aur_site_grid grid;
    double *gains; /* 4 * capacity: scratch */
} tessellation;

static int compare_x(const void *a, const void *b) {
    const double x = ((const aur_point2 *)a)->x;
    const double y = ((const aur_point2 *)b)->x;
    return (x > y) - (x < y);
}

static int compare_y(const void *a, const void *b) {
    const double x = ((const aur_point2 *)a)->y;
    const double y = ((const aur_point2 *)b)->y;
    return (x > y) - (x < y);
}

/* Reorders sites and points so that each site finds its points near it: half of the sites get half of the
 * points, across x and across y in turns. */
static void assign(size_t capacity, size_t count, aur_point2 *sites, aur_point2 *points, bool across_x) {
    if (count <= 1)
        return;
    qsort(sites, count, sizeof *sites, across_x ? compare_x : compare_y);
    qsort(points, count * capacity, sizeof *points, across_x ? compare_x : compare_y);
    const size_t half = count / 2;
    assign(capacity, half, sites, points, !across_x);
    assign(capacity, count - half, sites + half, points + half * capacity, !across_x);
}

static double squared(aur_point2 v) {
    return v.x * v.x + v.y * v.y;
}

/* How much farther a point is from site a than from site b, in squared distances. */
static double gain(aur_point2 point, aur_point2 a, aur_point2 b) {
    return squared(aur_wrapped_difference(point, a)) - squared(aur_wrapped_difference(point, b));
}

/* The value of rank `rank` of values[0..count-1], which are reordered (Hoare's selection). */
static double select_rank(double *values, size_t count, size_t rank) {
    size_t low = 0;
    size_t high = count - 1;
    while (low < high) {
        const double pivot = values[low + (high - low) / 2];
        size_t i = low;
        size_t j = high;
        for (;;) {
            while (values[i] < pivot)
                ++i;
            while (values[j] > pivot)
                --j;
            if (i >= j)
                break;
            const double other = values[i];
            values[i++] = values[j];
            values[j--] = other;
        }
        /* [low, j] holds no value above the pivot, [j + 1, high] none below it. */
        if (rank <= j)
            high = j;
        else
            low = j + 1;
    }
    return values[rank];
}

/* Gives each of two sites those of their points that prefer it most; ties stay. Returns how many changed
 * hands. */
static size_t swap_points(const tessellation *t, size_t a, size_t b) {
    const size_t capacity = t->capacity;
    aur_point2 *const of_a = t->points + a * capacity;
    aur_point2 *const of_b = t->points + b * capacity;
    double *const gains = t->gains;
    double most = -INFINITY;
    double least = INFINITY;
    for (size_t i = 0; i < capacity; ++i) {
        gains[i] = gain(of_a[i], t->sites[a], t->sites[b]);
        most = fmax(most, gains[i]);
        gains[capacity + i] = gain(of_b[i], t->sites[a], t->sites[b]);
        least = fmin(least, gains[capacity + i]);
    }
    if (most <= least)
        return 0;
    double *const sorted = gains + 2 * capacity;
    for (size_t i = 0; i < 2 * capacity; ++i)
        sorted[i] = gains[i];
    const double border = select_rank(sorted, 2 * capacity, capacity);
    /* No more than `capacity` gains are below the border, so that each such point of b finds one of a to
     * change places with. */
    size_t swaps = 0;
    size_t i = 0;
    for (size_t j = 0; j < capacity; ++j) {
        if (gains[capacity + j] >= border)
            continue;
        while (gains[i] < border)
            ++i;
        const aur_point2 other = of_a[i];
        of_a[i++] = of_b[j];
        of_b[j] = other;
        ++swaps;
    }
    return swaps;
}

/* The sum of squares about the points' own mean is least when the site is that mean; the torus allows it
 * because a cell is far smaller than a half of it, and for the few sites where it is not any place near will
 * do. */
static void centre_site(tessellation *t, size_t i) {
    const aur_point2 *const points = t->points + i * t->capacity;
    aur_point2 sum = {0.0, 0.0};
    for (size_t k = 0; k < t->capacity; ++k) {
        const aur_point2 difference = aur_wrapped_difference(points[k], t->sites[i]);
        sum.x += difference.x;
        sum.y += difference.y;
    }
    t->sites[i].x = aur_unwrap(t->sites[i].x + sum.x / (double)t->capacity);
    t->sites[i].y = aur_unwrap(t->sites[i].y + sum.y / (double)t->capacity);
}

static void measure_radius(tessellation *t, size_t i) {
    double farthest = 0.0;
    for (size_t k = 0; k < t->capacity; ++k)
        farthest =
            fmax(farthest, squared(aur_wrapped_difference(t->points[i * t->capacity + k], t->sites[i])));
    t->radii[i] = sqrt(farthest);
}

/* Swaps points between all pairs of sites whose points can be worth it: those whose circles overlap. */
static size_t sweep(tessellation *t) {
    aur_site_grid_fill(&t->grid, t->count, t->sites);
    double largest = 0.0;
    for (size_t i = 0; i < t->count; ++i) {
        measure_radius(t, i);
        largest = fmax(largest, t->radii[i]);
    }
    const size_t side = t->grid.side;
    size_t swaps = 0;
    for (size_t i = 0; i < t->count; ++i) {
        const size_t reach = (size_t)((t->radii[i] + largest) * (double)side) + 1;
        const bool all = 2 * reach + 1 >= side;
        const size_t width = all ? side : 2 * reach + 1;
        const size_t x0 = all ? 0 : (size_t)(t->sites[i].x * (double)side) + side - reach;
        const size_t y0 = all ? 0 : (size_t)(t->sites[i].y * (double)side) + side - reach;
        for (size_t c = 0; c < width * width; ++c) {
            const size_t cell = (y0 + c / width) % side * side + (x0 + c % width) % side;
            for (uint32_t k = t->grid.start[cell]; k < t->grid.start[cell + 1]; ++k) {
                const size_t j = t->grid.sites[k];
                const double reach_of_both = t->radii[i] + t->radii[j];
                if (j <= i ||
                    squared(aur_wrapped_difference(t->sites[i], t->sites[j])) > reach_of_both * reach_of_both)
                    continue;
                const size_t swapped = swap_points(t, i, j);
                swaps += swapped;
                if (swapped > 0) {
                    measure_radius(t, i);
                    measure_radius(t, j);
                }
            }
        }
    }
    return swaps;
}

static aur_result relax(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error) {
    size_t capacity = POINT_TARGET / count;
    capacity = capacity < LEAST_CAPACITY  ? LEAST_CAPACITY
               : capacity > MOST_CAPACITY ? MOST_CAPACITY
                                          : capacity;
    tessellation t = {.count = count, .capacity = capacity, .sites = sites};
    t.points = malloc(count * capacity * sizeof *t.points);
    t.radii = malloc(count * sizeof *t.radii);
    t.gains = malloc(4 * capacity * sizeof *t.gains);
    aur_result result = AUR_OK;
    if (t.points == NULL || t.radii == NULL || t.gains == NULL || !aur_site_grid_create(&t.grid, count))
        result = aur_fail_memory(error);
    if (result == AUR_OK)
        result = aur_pointset_emit(&(aur_pointset){.kind = &aur_set_jittered,
                                                   .size = count * capacity,
                                                   .dimension = 2,
                                                   .seed = aur_hash2(seed, 2)},
                                   0, 0, count * capacity,
                                   &(aur_output){.capacity = 2 * count * capacity, .doubles = &t.points[0].x},
                                   error);
    if (result == AUR_OK) {
        aur_random_sites(aur_hash2(seed, 1), count, sites);
        assign(capacity, count, sites, t.points, true);
        const double enough = quiet * (double)(count * capacity);
        for (unsigned n = 0; n < SWEEPS; ++n) {
            const size_t swaps = sweep(&t);
            for (size_t i = 0; i < count; ++i)
                centre_site(&t, i);
            if ((double)swaps <= enough)
                break;
        }
    }
    free(t.points);
    free(t.radii);
    free(t.gains);
    aur_site_grid_destroy(&t.grid);
    return result;
}

const aur_square_set aur_set_blue_noise = {
    .description = {.row = {.name = "blue-noise",
                            .summary = "capacity-constrained Voronoi tessellation, periodic",
                            .source = "Balzer, Schloemer, Deussen 2009"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = 1 << 16},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .own = &(const aur_relaxation){VERSION, relax},
    .prepare = aur_prepare_relaxed,
    .fill = aur_fill_table,
};
