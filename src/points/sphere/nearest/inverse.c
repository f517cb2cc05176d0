/* The nearest points of a spherical Fibonacci set to a direction (Keinert, Innmann, Saenger, Stamminger
 * 2015).
 *
 * The set is a lattice in (index, azimuth), and two neighbouring basis vectors are nearly orthogonal on the
 * sphere at each latitude; the nearest point is a corner of their cell that contains the direction. That was
 * checked against all points for every N to 20,000, and against the 16 points about the cell to 10^6. The k
 * nearest are selected from all lattice points in a cap that certainly contains them, listed row by row. Both
 * are constant time in N. */
#include "points/sphere/nearest/inverse.h"

#include <aureole/sphere.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/sphere/phase.h"

/* Up to 2^50 points an index and its neighbours are exact. */
static const uint64_t size_limit = UINT64_C(1) << 50;

static aur_result make_lattice(const aur_fibonacci_set *set, aur_sphere_lattice *lattice, aur_error *error) {
    if (set->size == 0 || set->size > size_limit)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a spherical Fibonacci set has 1 to 2^50 points, not %llu",
                        (unsigned long long)set->size);
    const double size = (double)set->size;
    if (set->domain == AUR_DOMAIN_SPHERE)
        *lattice = (aur_sphere_lattice){2.0 / size, size, size};
    else if (set->domain == AUR_DOMAIN_HEMISPHERE)
        *lattice = (aur_sphere_lattice){1.0 / size, 2.0 * size, size};
    else
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a spherical Fibonacci set is on the hemisphere or the sphere");
    return AUR_OK;
}

/* A direction must be of unit length within 1e-4, and not below the horizon if the domain is the hemisphere;
 * NaN fails. */
static aur_result check_direction(const aur_sphere_lattice *lattice, const double *q, aur_error *error) {
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    if (fabs(square - 1.0) <= 1e-4 && (lattice->limit == lattice->whole || q[2] >= -1e-4))
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT, "%g, %g, %g is not a unit vector of the domain", q[0], q[1],
                    q[2]);
}

static aur_result check_capacity(size_t count, size_t capacity, aur_error *error) {
    return count <= capacity
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_CAPACITY, "%zu indices do not fit into %zu", count, capacity);
}

/* The nearest points so far, by distance and then by index. */
typedef struct candidates {
    size_t count, capacity;
    double distances[AUR_FIBONACCI_NEIGHBOURS_MAX];
    uint64_t *indices;
} candidates;

static void offer(const aur_sphere_lattice *lattice, const double *q, double index, candidates *nearest) {
    const uint64_t j = (uint64_t)index;
    const double down = (index + 0.5) * lattice->step;
    const double radius = sqrt(down * (2.0 - down));
    double sine, cosine;
    aur_phase_sincos(j * AUR_GOLDEN_PHASE, &sine, &cosine);
    const double x = radius * cosine - q[0];
    const double y = radius * sine - q[1];
    const double z = (1.0 - down) - q[2];
    const double distance = x * x + y * y + z * z;
    size_t at = nearest->count;
    while (at > 0 && (distance < nearest->distances[at - 1] ||
                      (distance == nearest->distances[at - 1] && j < nearest->indices[at - 1])))
        --at;
    if (at == nearest->capacity)
        return;
    if (nearest->count < nearest->capacity)
        ++nearest->count;
    for (size_t i = nearest->count - 1; i > at; --i) {
        nearest->distances[i] = nearest->distances[i - 1];
        nearest->indices[i] = nearest->indices[i - 1];
    }
    nearest->distances[at] = distance;
    nearest->indices[at] = j;
}

/* An interval of real numbers, and its part in a lattice row. */
typedef struct interval {
    double low, high;
} interval;

/* The i with low <= start + i * pace <= high, a little wider. */
static interval steps_within(interval range, double start, double pace) {
    const double a = (range.low - start) / pace;
    const double b = (range.high - start) / pace;
    const double slack = 1e-9 * (1.0 + fabs(a) + fabs(b));
    return (interval){fmin(a, b) - slack, fmax(a, b) + slack};
}

/* All points with index and azimuth in a box; the azimuth range is modulo a turn and less than one turn. */
static void offer_box(const aur_sphere_lattice *lattice, const double *q, interval index, interval turns,
                      int64_t k, candidates *nearest) {
    const double f0 = aur_sphere_lattice_vectors[0][k];
    const double f1 = aur_sphere_lattice_vectors[0][k + 1];
    const double e0 = aur_sphere_lattice_vectors[1][k];
    const double e1 = aur_sphere_lattice_vectors[1][k + 1];
    const double sign = e0 > 0.0 ? -1.0 : 1.0;
    const double middle = sign * (f0 * (turns.low + turns.high) - e0 * (index.low + index.high)) / 2.0;
    const double reach = (f0 * (turns.high - turns.low) + fabs(e0) * (index.high - index.low)) / 2.0;
    const double last = floor(middle + reach + 1e-9 * (1.0 + fabs(middle)));
    for (double row = ceil(middle - reach - 1e-9 * (1.0 + fabs(middle))); row <= last; row += 1.0) {
        const interval by_index = steps_within(index, row * f1, f0);
        const interval by_turns = steps_within(turns, row * e1, e0);
        const double end = floor(fmin(by_index.high, by_turns.high));
        for (double i = ceil(fmax(by_index.low, by_turns.low)); i <= end; i += 1.0) {
            const double j = i * f0 + row * f1;
            if (j >= 0.0 && j < lattice->limit)
                offer(lattice, q, j, nearest);
        }
    }
}

/* All points within `angle` radians, and some more. */
static void offer_cap(const aur_sphere_lattice *lattice, const double *q, double angle, candidates *nearest) {
    const double across = sqrt(q[0] * q[0] + q[1] * q[1]);
    const double theta = atan2(across, q[2]);
    const double top = sin(fmax(theta - angle, 0.0) / 2.0);
    const double bottom = sin(fmin(theta + angle, AUR_PI) / 2.0);
    interval index = {2.0 * top * top / lattice->step - 0.5, 2.0 * bottom * bottom / lattice->step - 0.5};
    index.low = fmax(floor(index.low - 1e-6 * (1.0 + fabs(index.low) * 1e-6)), 0.0);
    index.high = fmin(ceil(index.high + 1e-6 * (1.0 + fabs(index.high) * 1e-6)), lattice->limit - 1.0);
    const double sine = sin(angle);
    if (angle >= AUR_PI / 2.0 || theta <= angle || theta >= AUR_PI - angle || sine >= 0.999 * across) {
        for (double j = index.low; j <= index.high; j += 1.0)
            offer(lattice, q, j, nearest);
        return;
    }
    const double centre = atan2(q[1], q[0]) / (2.0 * AUR_PI);
    const double half = asin(sine / across) / (2.0 * AUR_PI) + 1e-12;
    offer_box(lattice, q, index, (interval){centre - half, centre + half},
              (int64_t)aur_sphere_lattice_zone(lattice->whole, (aur_reals){across * across})[0], nearest);
}

/* Starts with a cap that contains the requested number on average, and enlarges it until the last selected
 * point is inside. */
static void find_neighbours(const aur_sphere_lattice *lattice, const double *q, candidates *nearest) {
    double requested = (double)nearest->capacity;
    requested += 3.0 + 2.0 * sqrt(requested);
    for (;; requested *= 2.0) {
        /* A cap of chord r contains r^2/4 of all points. */
        const double chord = 2.0 * sqrt(requested / lattice->whole);
        nearest->count = 0;
        offer_cap(lattice, q, chord < 2.0 ? 2.0 * asin(chord / 2.0) : AUR_PI, nearest);
        if (chord >= 2.0 ||
            (nearest->count == nearest->capacity && nearest->distances[nearest->count - 1] <= chord * chord))
            return;
    }
}

aur_result aur_fibonacci_neighbours(const aur_fibonacci_set *set, const double direction[3], size_t count,
                                    size_t capacity, uint64_t *indices, aur_error *error) {
    aur_sphere_lattice lattice;
    aur_result result = make_lattice(set, &lattice, error);
    if (result == AUR_OK && (count > AUR_FIBONACCI_NEIGHBOURS_MAX || count > set->size))
        result =
            aur_fail(error, AUR_ERROR_ARGUMENT, "%zu neighbours are more than the set's points or than %d",
                     count, AUR_FIBONACCI_NEIGHBOURS_MAX);
    if (result == AUR_OK)
        result = check_direction(&lattice, direction, error);
    if (result == AUR_OK)
        result = check_capacity(count, capacity, error);
    if (result != AUR_OK || count == 0)
        return result;
    candidates nearest = {.capacity = count, .indices = indices};
    find_neighbours(&lattice, direction, &nearest);
    return AUR_OK;
}

aur_result aur_fibonacci_nearest(const aur_fibonacci_set *set, size_t count, const double *xyz,
                                 size_t capacity, uint64_t *indices, aur_error *error) {
    enum { CHUNK = 256 };
    aur_sphere_lattice lattice;
    aur_result result = make_lattice(set, &lattice, error);
    if (result == AUR_OK)
        result = check_capacity(count, capacity, error);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = check_direction(&lattice, xyz + 3 * i, error);
    if (result != AUR_OK)
        return result;
    aur_sphere_lattice_kernel *const find = AUR_KERNEL_HERE(aur_sphere_lattice_nearest);
    double found[CHUNK];
    for (size_t done = 0; done < count; done += CHUNK) {
        const size_t part = count - done < CHUNK ? count - done : CHUNK;
        find(&lattice, part, xyz + 3 * done, found);
        for (size_t i = 0; i < part; ++i) {
            if (found[i] >= 0.0) {
                indices[done + i] = (uint64_t)found[i];
                continue;
            }
            candidates nearest = {.capacity = 1, .indices = indices + done + i};
            find_neighbours(&lattice, xyz + 3 * (done + i), &nearest);
        }
    }
    return AUR_OK;
}
