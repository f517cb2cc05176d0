/* Rank-1 lattices whose vector is optimised for periodic functions with square integrable mixed second
 * derivatives, in a space with product weights: the squared worst-case error is the mean over the points of
 * the products of 1 + g_d w(x_d), less 1, with w(x) = 2 pi^2 (x^2 - x + 1/6) and g_d the dimension to the
 * power of -decay. cbc takes component after component (Sloan and Reztsov 2002): sizes of a power of two by
 * Fourier transforms in O(dimension N log N) (Nuyens and Cools 2006), others in O(dimension N^2). korobov
 * tries vectors 1, a, a^2, .. The baker's transform serves functions that are not periodic. Error nearly
 * O(N^-2), random access. */
#include <math.h>
#include <stdlib.h>

#include "points/base/fourier.h"
#include "points/pointset/generators/lattice.h"
#include "points/pointset/set.h"

enum { DIMENSIONS = 256, LEVELS = 20, PLAIN_SIZE = 4096 };

typedef struct vector {
    uint64_t of[DIMENSIONS];
} vector;

static void fill(const aur_pointset *set, const aur_block *block) {
    const vector *const data = set->data;
    for (size_t d = 0; d < block->dimension_count; ++d) {
        aur_run run;
        aur_run_of_lattice(data->of[block->first_dimension + d], block->first, set->size, &run);
        run.next(&run, block->count, block->data + d * block->coordinate_stride);
    }
}

/* w(k / n). */
static double kernel(uint64_t k, uint64_t n) {
    const double x = (double)k / (double)n;
    return 2.0 * AUR_PI * AUR_PI * (x * x - x + 1.0 / 6.0);
}

/* Mirror images differ only by rounding: take the smallest of the equally good components. */
static bool is_better(double sum, double best, uint64_t n) {
    return sum < best - 1e-15 * (double)n;
}

/* --- sizes of a power of two */

/* The points k = 2^i times an odd number. Their products are a sequence over the powers of 5 modulo size = N
 * / 2^i, since both signs are equal: multiplication by 5^b rotates it. */
typedef struct level {
    size_t size, length; /* length: size / 4 */
    double *kernel, *product;
    double *re, *im; /* the kernel's transform */
    double *turns;
} level;

typedef struct search {
    uint64_t size;
    size_t levels;
    level of[LEVELS];
    double *re, *im, *work, *sums; /* for the longest level */
    double *storage;
} search;

static bool open_search(uint64_t size, search *s) {
    *s = (search){.size = size};
    const size_t longest = (size_t)size / 4;
    s->storage = malloc(17 * longest * sizeof *s->storage);
    if (s->storage == NULL)
        return false;
    s->re = s->storage;
    s->im = s->re + longest;
    s->work = s->im + longest;
    s->sums = s->work + 2 * longest;
    double *next = s->sums + longest;
    for (size_t n = (size_t)size; n >= 4; n /= 2, ++s->levels) {
        const size_t length = n / 4;
        level *const l = s->of + s->levels;
        *l = (level){.size = n,
                     .length = length,
                     .kernel = next,
                     .product = next + length,
                     .re = next + 2 * length,
                     .im = next + 3 * length,
                     .turns = next + 4 * length};
        next += 6 * length;
        uint64_t power = 1;
        for (size_t a = 0; a < length; ++a, power = power * 5 % n) {
            l->re[a] = l->kernel[a] = kernel(power, n);
            l->im[a] = 0.0;
            l->product[a] = 1.0;
        }
        aur_fourier_prepare(length, l->turns);
        aur_fourier(length, l->turns, l->re, l->im, s->work);
    }
    return true;
}

/* Adds the level's sums for the components 5^b. */
static void correlate(search *s, const level *l) {
    const size_t length = l->length;
    for (size_t a = 0; a < length; ++a) {
        s->re[a] = l->product[a];
        s->im[a] = 0.0;
    }
    aur_fourier(length, l->turns, s->re, s->im, s->work);
    for (size_t k = 0; k < length; ++k) {
        const double re = s->re[k] * l->re[k] + s->im[k] * l->im[k];
        s->im[k] = s->re[k] * l->im[k] - s->im[k] * l->re[k];
        s->re[k] = re;
    }
    aur_fourier(length, l->turns, s->im, s->re, s->work); /* back: the other sign */
    const double scale = 2.0 / (double)length;
    for (size_t b = 0; b < s->of[0].length; ++b)
        s->sums[b] += scale * s->re[b % length];
}

/* The component that minimises the sum, as a power of 5; the first component is 1. */
static size_t choose(search *s, bool first) {
    if (first)
        return 0;
    for (size_t b = 0; b < s->of[0].length; ++b)
        s->sums[b] = 0.0;
    for (size_t i = 0; i < s->levels; ++i)
        correlate(s, s->of + i);
    size_t best = 0;
    for (size_t b = 1; b < s->of[0].length; ++b)
        if (is_better(s->sums[b], s->sums[best], s->size))
            best = b;
    return best;
}

static bool search_powers(uint64_t size, size_t dimension, double decay, vector *found) {
    search s;
    if (!open_search(size, &s))
        return false;
    for (size_t d = 0; d < dimension; ++d) {
        const double weight = pow((double)(d + 1), -decay);
        const size_t best = choose(&s, d == 0);
        for (size_t i = 0; i < s.levels; ++i)
            for (size_t a = 0; a < s.of[i].length; ++a)
                s.of[i].product[a] *= 1.0 + weight * s.of[i].kernel[(a + best) % s.of[i].length];
        uint64_t z = 1;
        for (size_t b = 0; b < best; ++b)
            z = z * 5 % size;
        found->of[d] = z < size - z ? z : size - z;
    }
    free(s.storage);
    return true;
}

/* --- any size */

static bool search_all(uint64_t size, size_t dimension, double decay, vector *found) {
    double *const product = malloc(2 * (size_t)size * sizeof *product), *const values = product + size;
    if (product == NULL)
        return false;
    for (uint64_t k = 0; k < size; ++k) {
        product[k] = 1.0;
        values[k] = kernel(k, size);
    }
    for (size_t d = 0; d < dimension; ++d) {
        double least = INFINITY;
        for (uint64_t z = 1; z <= (d == 0 ? 1 : size / 2 + 1); ++z) {
            if (aur_common_divisor(z, size) != 1)
                continue;
            double sum = 0.0;
            for (uint64_t k = 0, at = 0; k < size; ++k, at = (at + z) % size)
                sum += product[k] * values[at];
            if (is_better(sum, least, size)) {
                least = sum;
                found->of[d] = z;
            }
        }
        const double weight = pow((double)(d + 1), -decay);
        for (uint64_t k = 0; k < size; ++k)
            product[k] *= 1.0 + weight * values[k * found->of[d] % size];
    }
    free(product);
    return true;
}

/* --- korobov */

/* The squared worst-case error and 1. */
static double korobov_error(uint64_t size, size_t dimension, const double *weights, uint64_t a) {
    double sum = 0.0;
    for (uint64_t k = 0; k < size; ++k) {
        double product = 1.0;
        uint64_t at = k;
        for (size_t d = 0; d < dimension; ++d, at = at * a % size)
            product *= 1.0 + weights[d] * kernel(at, size);
        sum += product;
    }
    return sum / (double)size;
}

/* The best of evenly spaced multipliers, limited to about a second of work. */
static uint64_t choose_multiplier(uint64_t size, size_t dimension, double decay) {
    const double work = (double)size * (double)dimension;
    const uint64_t tries = (uint64_t)fmax(16.0, fmin((double)size / 2.0, 0x1p27 / work));
    double weights[DIMENSIONS], least = INFINITY;
    for (size_t d = 0; d < dimension; ++d)
        weights[d] = pow((double)(d + 1), -decay);
    uint64_t best = 1;
    for (uint64_t t = 0; t < tries; ++t) {
        uint64_t a = (t * 2 + 1) * size / (4 * tries);
        while (a < size && aur_common_divisor(a, size) != 1)
            ++a;
        if (a == 0 || a >= size)
            continue;
        const double error = korobov_error(size, dimension, weights, a);
        if (error < least - 1e-15) {
            least = error;
            best = a;
        }
    }
    return best;
}

/* --- the two sets */

typedef struct lattice_keys {
    double decay;
    bool baker;
    uint64_t multiplier;
} lattice_keys;

/* The first two keys are those of both sets. */
static const aur_key keys[] = {
    {AUR_KEY_OF_REAL(lattice_keys, "decay", decay, 0.0, 16.0, "2", "the weight of dimension d is d^-decay")},
    {AUR_KEY_OF_BOOLEAN(lattice_keys, "baker", baker, "false",
                        "fold coordinates at 1/2 (x to 1 - |2x - 1|), for functions that are not periodic")},
    {AUR_KEY_OF_INTEGER(lattice_keys, "multiplier", multiplier, 0, 1 << LEVELS, "0",
                        "a of the vector 1, a, a^2, ..; 0: the best of those that a second can try")},
};

static aur_result open_lattice(aur_pointset *set, aur_parameters *parameters, lattice_keys *p,
                               aur_error *error) {
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, p, error);
    if (result != AUR_OK)
        return result;
    set->fold = p->baker;
    set->data = calloc(1, sizeof(vector));
    return set->data == NULL ? aur_fail_memory(error) : AUR_OK;
}

static aur_result prepare_cbc(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    lattice_keys p = {0};
    const aur_result result = open_lattice(set, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    const bool power = set->size >= 4 && (set->size & (set->size - 1)) == 0;
    if (!power && set->size > PLAIN_SIZE)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set 'cbc': sizes above %d must be powers of 2, not %llu",
                        PLAIN_SIZE, (unsigned long long)set->size);
    const bool good = (power ? search_powers : search_all)(set->size, set->dimension, p.decay, set->data);
    return good ? AUR_OK : aur_fail_memory(error);
}

static aur_result prepare_korobov(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    lattice_keys p = {0};
    const aur_result result = open_lattice(set, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    vector *const data = set->data;
    const uint64_t a =
        p.multiplier != 0 ? p.multiplier : choose_multiplier(set->size, set->dimension, p.decay);
    uint64_t power = 1;
    for (size_t d = 0; d < set->dimension; ++d, power = power * a % set->size)
        data->of[d] = power;
    return AUR_OK;
}

const aur_square_set aur_set_cbc = {
    .description = {.row = {.name = "cbc",
                            .summary =
                                "rank-1 lattice found component by component, for smooth periodic functions",
                            .source = "Sloan, Reztsov 2002; Nuyens, Cools 2006",
                            .key_count = 2,
                            .keys = keys},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, DIMENSIONS},
                    .maximum_size = UINT64_C(1) << LEVELS},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare_cbc,
    .fill = fill,
};

const aur_square_set aur_set_korobov = {
    .description = {.row = {.name = "korobov",
                            .summary = "rank-1 lattice of the vector 1, a, a^2, .. with a good multiplier a",
                            .source = "Korobov 1959",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, DIMENSIONS},
                    .maximum_size = UINT64_C(1) << LEVELS},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare_korobov,
    .fill = fill,
};
