/* From a direction to the nearest points of a spherical Fibonacci set (Keinert, Innmann, Saenger, Stamminger
 * 2015).
 *
 * The set is a lattice in (index, azimuth), and two neighbouring basis vectors are nearly orthogonal on the
 * sphere at each latitude; the nearest point is a corner of the cell that they make about the direction. That
 * was checked against all points for every N to 20,000, and against the 16 points about the cell to 10^6. The
 * k nearest come from all lattice points in a cap that is sure to hold them, listed row by row. Both are
 * constant time in N. */
#include "sphere/nearest/inverse.h"

#include <math.h>
#include <string.h>

#include <aureole/sphere.h>

#include "core/error.h"
#include "core/simd.h"
#include "core/vector.h"
#include "sphere/phase.h"

const double aur_sphere_lattice_fibonacci[AUR_SPHERE_LATTICE_VECTORS] = {
    0.0,         1.0,         1.0,         2.0,         3.0,         5.0,          8.0,          13.0,
    21.0,        34.0,        55.0,        89.0,        144.0,       233.0,        377.0,        610.0,
    987.0,       1597.0,      2584.0,      4181.0,      6765.0,      10946.0,      17711.0,      28657.0,
    46368.0,     75025.0,     121393.0,    196418.0,    317811.0,    514229.0,     832040.0,     1346269.0,
    2178309.0,   3524578.0,   5702887.0,   9227465.0,   14930352.0,  24157817.0,   39088169.0,   63245986.0,
    102334155.0, 165580141.0, 267914296.0, 433494437.0, 701408733.0, 1134903170.0, 1836311903.0, 2971215073.0,
};

const double aur_sphere_lattice_turns[AUR_SPHERE_LATTICE_VECTORS] = {
    -1.0,
    0.6180339887498949,
    -0.38196601125010515,
    0.2360679774997897,
    -0.14589803375031546,
    0.09016994374947424,
    -0.05572809000084122,
    0.034441853748633025,
    -0.02128623625220819,
    0.013155617496424838,
    -0.008130618755783348,
    0.00502499874064149,
    -0.003105620015141858,
    0.0019193787254996324,
    -0.0011862412896422258,
    0.0007331374358574064,
    -0.0004531038537848195,
    0.0002800335820725869,
    -0.00017307027171223257,
    0.00010696331036035435,
    -6.610696135187822e-05,
    4.085634900847612e-05,
    -2.5250612343402103e-05,
    1.5605736665074018e-05,
    -9.644875678328085e-06,
    5.9608609867459325e-06,
    -3.684014691582153e-06,
    2.2768462951637796e-06,
    -1.4071683964183733e-06,
    8.696778987454063e-07,
    -5.374904976729669e-07,
    3.3218740107243943e-07,
    -2.0530309660052749e-07,
    1.2688430447191194e-07,
    -7.841879212861554e-08,
    4.84655123432964e-08,
    -2.995327978531914e-08,
    1.8512232557977258e-08,
    -1.1441047227341884e-08,
    7.071185330635374e-09,
    -4.36986189670651e-09,
    2.7013234339288636e-09,
    -1.6685384627776467e-09,
    1.0327849711512169e-09,
    -6.357534916264299e-10,
    3.97031479524787e-10,
    -2.3872201210164284e-10,
    1.5830946742314417e-10,
};

/* The azimuth in turns, within 1e-12: it only has to find the cell. */
static double azimuth(double x, double y) {
    const double a = fabs(x);
    const double b = fabs(y);
    const double longer = a > b ? a : b;
    const double shorter = a > b ? b : a;
    /* atan t = pi/4 + atan((t - 1)/(t + 1)) above tan(pi/8) */
    const int steep = shorter > 0.41421356237309503 * longer;
    const double above = steep ? shorter - longer : shorter;
    const double below = steep ? shorter + longer : longer;
    const double t = above / (below > 0.0 ? below : 1.0);
    const double q = t * t;
    static const double coefficients[] = {AUR_AZIMUTH_COEFFICIENTS};
    double p = coefficients[0];
    for (size_t i = 1; i < sizeof coefficients / sizeof coefficients[0]; ++i)
        p = p * q + coefficients[i];
    p = p * t + (steep ? 0.125 : 0.0);
    p = a > b ? p : 0.25 - p;
    p = x < 0.0 ? 0.5 - p : p;
    return y < 0.0 ? -p : p;
}

/* The zone: b_k and b_{k+1} are nearly orthogonal on the sphere where Phi^{2k} is sqrt 5 pi N sin^2 theta
 * (Keinert 2015), at least 2. */
static int64_t zone(double whole, double sine_squared) {
    const double v = AUR_ZONE_SCALE * whole * sine_squared + 1.0;
    int64_t bits;
    memcpy(&bits, &v, sizeof bits);
    const int64_t exponent = (bits >> 52) - 1023;
    const int64_t one_bits = (bits & INT64_C(0xfffffffffffff)) | INT64_C(0x3ff0000000000000);
    double m;
    memcpy(&m, &one_bits, sizeof m);
    m -= 1.0;
    static const double coefficients[] = {AUR_ZONE_COEFFICIENTS};
    double fraction = coefficients[0];
    for (size_t i = 1; i < sizeof coefficients / sizeof coefficients[0]; ++i)
        fraction = fraction * m + coefficients[i];
    const int64_t k = (int64_t)(((double)exponent + fraction) * AUR_ZONE_PACE);
    return k > 2 ? k : 2;
}

static double nearest_index(const aur_sphere_lattice *lattice, const double *q) {
    const double across = q[0] * q[0] + q[1] * q[1];
    /* 1 - z without cancellation about the pole */
    const double depth = q[2] > 0.0 ? across / (1.0 + q[2]) : 1.0 - q[2];
    const double index = depth / lattice->step - 0.5;
    const double turns = azimuth(q[0], q[1]);
    const int64_t k = zone(lattice->whole, across);
    const double f0 = aur_sphere_lattice_fibonacci[k];
    const double f1 = aur_sphere_lattice_fibonacci[k + 1];
    const double e0 = aur_sphere_lattice_turns[k];
    const double e1 = aur_sphere_lattice_turns[k + 1];
    /* coordinates in the basis, whose determinant is (-1)^k */
    const double sign = e0 > 0.0 ? -1.0 : 1.0;
    const double c0 = floor((index * e1 - f1 * turns) * sign);
    const double c1 = floor((f0 * turns - e0 * index) * sign);
    const double corner = c0 * f0 + c1 * f1;
    double best = 1e300;
    double nearest = -1.0;
    double highest = -1.0;
    for (int i = 0; i < 4; ++i) {
        const double j = corner + ((i & 1) != 0 ? f0 : 0.0) + ((i & 2) != 0 ? f1 : 0.0);
        const int inside = j >= 0.0 && j < lattice->whole;
        const double clamped = inside ? j : 0.0;
        const double down = (clamped + 0.5) * lattice->step;
        const double radius = sqrt(down * (2.0 - down));
        double sine, cosine;
        aur_phase_sincos((uint64_t)(int64_t)clamped * AUR_GOLDEN_PHASE, &sine, &cosine);
        const double x = radius * cosine - q[0];
        const double y = radius * sine - q[1];
        const double z = (1.0 - down) - q[2];
        const double distance = inside ? x * x + y * y + z * z : 1e300;
        const int closer = distance < best || (distance == best && j < nearest);
        best = closer ? distance : best;
        nearest = closer ? j : nearest;
        highest = j > highest ? j : highest;
    }
    return lattice->limit < lattice->whole && highest >= lattice->limit ? -1.0 : nearest;
}

void aur_sphere_lattice_nearest_portable(const aur_sphere_lattice *lattice, size_t count, const double *xyz,
                                         double *indices) {
    for (size_t i = 0; i < count; ++i)
        indices[i] = nearest_index(lattice, xyz + 3 * i);
}

/* 2^50 points keep an index and its neighbours exact. */
static const uint64_t size_limit = UINT64_C(1) << 50;

static aur_result make_lattice(const aur_fibonacci_set *set, aur_sphere_lattice *lattice) {
    if (set->size == 0 || set->size > size_limit)
        return AUR_ERROR_ARGUMENT;
    const double size = (double)set->size;
    if (set->domain == AUR_DOMAIN_SPHERE)
        *lattice = (aur_sphere_lattice){2.0 / size, size, size};
    else if (set->domain == AUR_DOMAIN_HEMISPHERE)
        *lattice = (aur_sphere_lattice){1.0 / size, 2.0 * size, size};
    else
        return AUR_ERROR_ARGUMENT;
    return AUR_OK;
}

/* Near enough to the unit sphere, and to the hemisphere where that is the domain. NaN fails. */
static int is_direction(const aur_sphere_lattice *lattice, const double *q) {
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    return fabs(square - 1.0) <= 1e-4 && (lattice->limit == lattice->whole || q[2] >= -1e-4);
}

/* The nearest ones so far, by distance and then by index. */
typedef struct candidates {
    size_t count, capacity;
    double distances[AUR_FIBONACCI_NEIGHBOURS_MAX];
    uint64_t *indices;
} candidates;

static void offer(const aur_sphere_lattice *lattice, const double *q, double index, candidates *kept) {
    const uint64_t j = (uint64_t)index;
    const double down = (index + 0.5) * lattice->step;
    const double radius = sqrt(down * (2.0 - down));
    double sine, cosine;
    aur_phase_sincos(j * AUR_GOLDEN_PHASE, &sine, &cosine);
    const double x = radius * cosine - q[0];
    const double y = radius * sine - q[1];
    const double z = (1.0 - down) - q[2];
    const double distance = x * x + y * y + z * z;
    size_t at = kept->count;
    while (at > 0 && (distance < kept->distances[at - 1] ||
                      (distance == kept->distances[at - 1] && j < kept->indices[at - 1])))
        --at;
    if (at == kept->capacity)
        return;
    if (kept->count < kept->capacity)
        ++kept->count;
    for (size_t i = kept->count - 1; i > at; --i) {
        kept->distances[i] = kept->distances[i - 1];
        kept->indices[i] = kept->indices[i - 1];
    }
    kept->distances[at] = distance;
    kept->indices[at] = j;
}

/* An interval of real numbers, and what of it a lattice row may take. */
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

/* All points whose index and azimuth lie in a box, the azimuth modulo a turn and narrower than one. */
static void offer_box(const aur_sphere_lattice *lattice, const double *q, interval index, interval turns,
                      int64_t k, candidates *kept) {
    const double f0 = aur_sphere_lattice_fibonacci[k];
    const double f1 = aur_sphere_lattice_fibonacci[k + 1];
    const double e0 = aur_sphere_lattice_turns[k];
    const double e1 = aur_sphere_lattice_turns[k + 1];
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
                offer(lattice, q, j, kept);
        }
    }
}

/* All points within `angle` radians, and some more. */
static void offer_cap(const aur_sphere_lattice *lattice, const double *q, double angle, candidates *kept) {
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
            offer(lattice, q, j, kept);
        return;
    }
    const double centre = atan2(q[1], q[0]) / (2.0 * AUR_PI);
    const double half = asin(sine / across) / (2.0 * AUR_PI) + 1e-12;
    offer_box(lattice, q, index, (interval){centre - half, centre + half},
              zone(lattice->whole, across * across), kept);
}

/* A cap that holds the wanted points on average, and then larger ones until the last point kept is within. */
static void find_neighbours(const aur_sphere_lattice *lattice, const double *q, candidates *kept) {
    double wanted = (double)kept->capacity;
    wanted += 3.0 + 2.0 * sqrt(wanted);
    for (;; wanted *= 2.0) {
        /* A cap of chord r holds r^2/4 of all points. */
        const double chord = 2.0 * sqrt(wanted / lattice->whole);
        kept->count = 0;
        offer_cap(lattice, q, chord < 2.0 ? 2.0 * asin(chord / 2.0) : AUR_PI, kept);
        if (chord >= 2.0 ||
            (kept->count == kept->capacity && kept->distances[kept->count - 1] <= chord * chord))
            return;
    }
}

aur_result aur_fibonacci_neighbours(const aur_fibonacci_set *set, const double direction[3], size_t count,
                                    size_t capacity, uint64_t *indices) {
    aur_sphere_lattice lattice;
    const aur_result result = make_lattice(set, &lattice);
    if (result != AUR_OK)
        return result;
    if (count > AUR_FIBONACCI_NEIGHBOURS_MAX || count > set->size || !is_direction(&lattice, direction))
        return AUR_ERROR_ARGUMENT;
    if (count > capacity)
        return AUR_ERROR_CAPACITY;
    if (count == 0)
        return AUR_OK;
    candidates kept = {.capacity = count, .indices = indices};
    find_neighbours(&lattice, direction, &kept);
    return AUR_OK;
}

aur_result aur_fibonacci_nearest(const aur_fibonacci_set *set, size_t count, const double *xyz,
                                 size_t capacity, uint64_t *indices) {
    enum { CHUNK = 256 };
    aur_sphere_lattice lattice;
    const aur_result result = make_lattice(set, &lattice);
    if (result != AUR_OK)
        return result;
    if (count > capacity)
        return AUR_ERROR_CAPACITY;
    for (size_t i = 0; i < count; ++i)
        if (!is_direction(&lattice, xyz + 3 * i))
            return AUR_ERROR_ARGUMENT;
    const int wide = aur_isa_available() == AUR_ISA_AVX512;
    double found[CHUNK];
    for (size_t done = 0; done < count; done += CHUNK) {
        const size_t part = count - done < CHUNK ? count - done : CHUNK;
        if (wide)
            aur_sphere_lattice_nearest_avx512(&lattice, part, xyz + 3 * done, found);
        else
            aur_sphere_lattice_nearest_portable(&lattice, part, xyz + 3 * done, found);
        for (size_t i = 0; i < part; ++i) {
            if (found[i] >= 0.0) {
                indices[done + i] = (uint64_t)found[i];
                continue;
            }
            candidates kept = {.capacity = 1, .indices = indices + done + i};
            find_neighbours(&lattice, xyz + 3 * (done + i), &kept);
        }
    }
    return AUR_OK;
}
