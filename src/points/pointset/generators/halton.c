/* van der Corput 1935: the radical inverse in base 2, one dimension, equally spaced when n is a power of two.
 * Halton 1960: coordinate d of point i is the radical inverse of i in the d-th prime base. Hammersley 1960:
 * the first coordinate is i/N and the others are Halton's. Random access, up to 6542 dimensions (primes below
 * 2^16), n below 2^48; there are no preferred sizes. Error O(log^d N / N), log^(d-1) for Hammersley. In many
 * dimensions neighbouring large bases are correlated unless digits are permuted. */
#include <stdlib.h>

#include "points/pointset/digits/radical_inverse.h"

typedef struct halton {
    bool permuted;
    uint32_t primes[];
} halton;

typedef struct halton_keys {
    enum { PERMUTE_NONE, PERMUTE_RANDOM } permute;
} halton_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(halton_keys, "permute", permute, "none", "random permutations of the digits", "none",
                       "random")},
};

/* Of both sets; hammersley has no keys. */
static aur_result prepare(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    halton_keys p = {PERMUTE_NONE};
    const aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    if (p.permute == PERMUTE_RANDOM &&
        (set->scramble == AUR_SCRAMBLE_DIGIT || set->scramble == AUR_SCRAMBLE_OWEN))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "set 'halton': permute=random already permutes the digits: expected scrambling "
                        "none, shift or rotate");
    halton *const data = malloc(sizeof *data + set->dimension * sizeof data->primes[0]);
    if (data == NULL)
        return aur_fail_memory(error);
    data->permuted = p.permute == PERMUTE_RANDOM;
    aur_primes(set->dimension, data->primes);
    set->data = data;
    return AUR_OK;
}

/* The prime of a dimension, computed if the set has no table. */
static uint32_t prime_of(const halton *data, size_t dimension) {
    if (data != NULL)
        return data->primes[dimension];
    uint32_t prime = 2;
    for (size_t d = 0; !aur_is_prime(prime) || d++ < dimension; ++prime)
        continue;
    return prime;
}

static void fill_halton(const aur_pointset *set, const aur_block *block) {
    const halton *const data = set->data;
    const aur_digits digits =
        data != NULL && data->permuted ? AUR_DIGITS_PERMUTE : aur_digits_of(set->scramble);
    for (size_t d = 0; d < block->dimension_count; ++d)
        aur_fill_radical_inverse(set, block, d, prime_of(data, block->first_dimension + d), digits);
}

static bool fill_halton_pairs(const aur_pointset *set, const aur_block *block) {
    const halton *const data = set->data;
    aur_run x, y;
    if ((data != NULL && data->permuted) || !aur_run_of_base(set, block, 0, 2, &x) ||
        !aur_run_of_base(set, block, 1, 3, &y))
        return false;
    aur_run_pairs(&x, &y, block->count, block->data);
    return true;
}

static void fill_hammersley(const aur_pointset *set, const aur_block *block) {
    const halton *const data = set->data;
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        if (dimension == 0)
            aur_fill_fraction(set, block, d);
        else
            aur_fill_radical_inverse(set, block, d, prime_of(data, dimension - 1),
                                     aur_digits_of(set->scramble));
    }
}

static bool fill_hammersley_pairs(const aur_pointset *set, const aur_block *block) {
    aur_run x, y;
    if (set->scramble != AUR_SCRAMBLE_NONE || !aur_run_of_base(set, block, 1, 2, &y))
        return false;
    aur_run_of_multiples(block->first, 1 % set->size, set->size, &x);
    aur_run_pairs(&x, &y, block->count, block->data);
    return true;
}

const aur_square_set aur_set_halton = {
    .description = {.row = {.name = "halton",
                            .summary = "radical inverses in the first primes",
                            .source = "Halton 1960; permutations Owen 2017",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, AUR_RADICAL_PRIMES},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare,
    .fill = fill_halton,
    .fill_pairs = fill_halton_pairs,
};

const aur_square_set aur_set_hammersley = {
    .description = {.row = {.name = "hammersley",
                            .summary = "i/N, then radical inverses in the first primes",
                            .source = "Hammersley 1960"},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, AUR_RADICAL_PRIMES},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .binary_net = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare,
    .fill = fill_hammersley,
    .fill_pairs = fill_hammersley_pairs,
};

const aur_square_set aur_set_van_der_corput = {
    .description = {.row = {.name = "van-der-corput",
                            .summary = "radical inverse in base 2, one dimension",
                            .source = "van der Corput 1935"},
                    .domains = AUR_ON_CUBE,
                    .dimensions = {1, 1},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .fill = fill_halton,
};
