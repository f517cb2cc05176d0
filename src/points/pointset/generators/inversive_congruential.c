/* The inversive congruential generator of Eichenauer and Lehn 1986, x <- 9102 / x + 36884165 modulo 2^31 - 1
 * with 1/0 = 0, consumed point by point: value i d + c gives coordinate c of point i. Its period is the full
 * 2^31 - 1, so n d is at most that. Seed 0 starts at x = 0. Error N^-1/2.
 *
 * Random access: the step is the map (b x + a) / x of the projective line, where 0 goes to infinity and
 * infinity to b. Full period means that this map runs through all 2^31 points of the line, and the
 * generator's sequence is the same without infinity. So value k is a power of a 2 x 2 matrix. A run of one
 * coordinate takes the same power from point to point, as fractions p / q, and their denominators are
 * inverted together (Montgomery 1987). */
#include "points/pointset/set.h"

static const uint64_t modulus = (UINT64_C(1) << 31) - 1;
static const uint64_t factor = 9102;
static const uint64_t summand = 36884165;

typedef struct matrix {
    uint64_t a, b, c, d;
} matrix;

static matrix multiply(matrix m, matrix n) {
    return (matrix){(m.a * n.a + m.b * n.c) % modulus, (m.a * n.b + m.b * n.d) % modulus,
                    (m.c * n.a + m.d * n.c) % modulus, (m.c * n.b + m.d * n.d) % modulus};
}

/* 1/x modulo the prime, by Fermat's little theorem; 0 for 0. */
static uint64_t inverse(uint64_t x) {
    uint64_t result = 1;
    for (uint64_t exponent = modulus - 2; exponent > 0; exponent >>= 1) {
        if (exponent & 1u)
            result = result * x % modulus;
        x = x * x % modulus;
    }
    return result;
}

static matrix power_of_step(uint64_t exponent) {
    matrix result = {1, 0, 0, 1};
    matrix step = {summand, factor, 1, 0};
    for (; exponent > 0; exponent >>= 1) {
        if (exponent & 1u)
            result = multiply(result, step);
        step = multiply(step, step);
    }
    return result;
}

/* Value k of the stream that starts at 0, by jumping: infinity is between the values 0 and 1. */
static uint64_t value_at(uint64_t k) {
    k %= modulus;
    if (k == 0)
        return 0;
    const matrix m = power_of_step(k + 1);
    return m.b * inverse(m.d) % modulus;
}

enum { BATCH = 128 };

/* values[i] = numerators[i] / denominators[i]; no denominator is 0. */
static void divide_all(size_t count, const uint64_t *numerators, const uint64_t *denominators,
                       uint64_t *values) {
    uint64_t product = 1;
    for (size_t i = 0; i < count; ++i) {
        values[i] = product;
        product = product * denominators[i] % modulus;
    }
    uint64_t rest = inverse(product);
    for (size_t i = count; i-- > 0;) {
        values[i] = values[i] * rest % modulus * numerators[i] % modulus;
        rest = rest * denominators[i] % modulus;
    }
}

/* Values k, k + stride, k + 2 stride, ... of the stream. */
typedef struct run {
    uint64_t k, stride, p, q; /* value k is p / q */
    matrix jump;
} run;

static void go_on(run *r) {
    const bool leaves_zero = r->k == 0;
    r->k += r->stride;
    if (leaves_zero || r->k >= modulus) {
        /* The generator has no infinity: the run continues after it. */
        r->k %= modulus;
        r->p = value_at(r->k);
        r->q = 1;
        return;
    }
    const uint64_t p = (r->jump.a * r->p + r->jump.b * r->q) % modulus;
    r->q = (r->jump.c * r->p + r->jump.d * r->q) % modulus;
    r->p = p;
}

static void fill(const aur_pointset *set, const aur_block *block) {
    const uint64_t start = set->seed == 0 ? 0 : aur_mix64(set->seed) % modulus;
    const matrix jump = power_of_step(set->dimension);
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        const uint64_t key = aur_scramble_key(block->seed, dimension);
        const uint64_t k = (start + block->first * set->dimension + dimension) % modulus;
        run r = {.k = k, .stride = set->dimension, .p = value_at(k), .q = 1, .jump = jump};
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t begin = 0; begin < block->count; begin += BATCH) {
            const size_t count = block->count - begin < BATCH ? block->count - begin : BATCH;
            uint64_t numerators[BATCH], denominators[BATCH], values[BATCH];
            for (size_t i = 0; i < count; ++i) {
                numerators[i] = r.p;
                denominators[i] = r.q;
                go_on(&r);
            }
            divide_all(count, numerators, denominators, values);
            for (size_t i = 0; i < count; ++i)
                out[begin + i] = aur_scrambled_fraction(set->scramble, values[i], modulus, key);
        }
    }
}

const aur_square_set aur_set_icg = {
    .description = {.row = {.name = "icg",
                            .summary = "inversive congruential generator of full period",
                            .source = "Eichenauer, Lehn 1986"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, (UINT64_C(1) << 31) - 1},
                    .maximum_size = (UINT64_C(1) << 31) - 1,
                    .counts_coordinates = true,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .fill = fill,
};
