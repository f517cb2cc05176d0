/* Niederreiter 1988 in base 2 (Bratley, Fox and Niederreiter 1992): row j of coordinate d's matrix has the
 * Laurent coefficients of x^u / p(x)^(q + 1), where p is the d-th irreducible polynomial over GF(2), e its
 * degree and j = q e + u. A (t,s)-sequence with t the sum of e - 1; the first two coordinates are Sobol's.
 * Random access, n up to 2^53, up to 1024 dimensions. n that is not a power of two leaves a net incomplete: a
 * warning. Error O(log^d N / N). */
#include "points/pointset/digits/digital.h"

enum { DIMENSIONS = 1024 };

static const uint16_t irreducible_polynomials[DIMENSIONS] = {
#include "data/irreducible.inc"
};

static unsigned degree_of(uint64_t polynomial) {
    return 63u - (unsigned)__builtin_clzll(polynomial);
}

/* The first 64 coefficients of 1 / (x^-e p(x)) times the given series, in powers of 1/x, highest first: one
 * division by p shifts by e and divides by a series that begins with 1. */
static uint64_t divide_series(uint64_t series, uint32_t polynomial, unsigned degree) {
    uint64_t quotient = 0;
    for (unsigned k = 0; k < 64; ++k) {
        if ((series >> (63 - k) & 1u) == 0)
            continue;
        quotient |= UINT64_C(1) << (63 - k);
        /* Coefficient j of the divisor, from the highest, is bit degree - j of p. */
        series ^= (uint64_t)polynomial << (63 - degree) >> k;
    }
    return quotient;
}

static void make_matrix(size_t dimension, uint64_t columns[AUR_DIGITAL_COLUMNS]) {
    const uint32_t polynomial = irreducible_polynomials[dimension];
    const unsigned degree = degree_of(polynomial);
    for (unsigned c = 0; c < AUR_DIGITAL_COLUMNS; ++c)
        columns[c] = 0;
    uint64_t series = UINT64_C(1) << 63; /* x^(e q) / p^q from its first coefficient on */
    unsigned row = 0;
    for (unsigned q = 0; row < 64; ++q) {
        series = divide_series(series, polynomial, degree);
        for (unsigned u = 0; u < degree && row < 64; ++u, ++row) {
            /* x^u / p^(q+1) begins with x^(u - e (q + 1)), and column r is the coefficient of x^-(r + 1). */
            const unsigned begin = degree * (q + 1) - u - 1;
            for (unsigned c = begin; c < AUR_DIGITAL_COLUMNS; ++c)
                columns[c] |= (series >> (63 - (c - begin)) & 1u) << (63 - row);
        }
    }
}

static void fill(const aur_pointset *set, const aur_block *block) {
    aur_fill_digital_block(set, block, make_matrix);
}

static bool fill_pairs(const aur_pointset *set, const aur_block *block) {
    return aur_fill_digital_pairs(set, block, make_matrix);
}

static aur_result prepare(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    (void)keys;
    return aur_prepare_digital(set, set->dimension, make_matrix, error);
}

const aur_square_set aur_set_niederreiter = {
    .description = {.row = {.name = "niederreiter",
                            .summary = "(t,s)-sequence in base 2 from irreducible polynomials",
                            .source = "Niederreiter 1988; Bratley, Fox, Niederreiter 1992"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, DIMENSIONS},
                    .maximum_size = UINT64_C(1) << 53,
                    .best_sizes = AUR_SIZES_POWERS,
                    .size_base = 2,
                    .extensible = true,
                    .binary_net = true},
    .scramblings = AUR_SCRAMBLES_BINARY,
    .prepare = prepare,
    .fill = fill,
    .fill_pairs = fill_pairs,
};
