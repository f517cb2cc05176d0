/* Halton 1960: coordinate d of point i is the radical inverse of i in the d-th prime base. Hammersley 1960:
 * the first coordinate is i/N and the others are Halton's. Random access, up to 6542 dimensions (primes below
 * 2^16), n below 2^48; any n is as good as another. Error O(log^d N / N), log^(d-1) for Hammersley. In many
 * dimensions neighbouring large bases are correlated unless digits are permuted. */
#include <stdlib.h>

#include "pointset/digits/radical_inverse.h"

typedef struct halton {
    bool permuted;
    uint32_t primes[];
} halton;

static aur_result prepare(aur_pointset *set, aur_parameters *keys, bool has_keys, aur_error *error) {
    static const char *const choices[] = {"none", "random"};
    size_t choice = 0;
    if (has_keys) {
        const aur_result result = aur_parameters_choice(keys, "permute", 2, choices, &choice, error);
        if (result != AUR_OK)
            return result;
    }
    if (choice == 1 && (set->scramble == AUR_SCRAMBLE_DIGIT || set->scramble == AUR_SCRAMBLE_OWEN))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "set 'halton': permute=random permutes the digits already; it goes with scrambling "
                        "none, shift or rotate");
    halton *const data = malloc(sizeof *data + set->dimension * sizeof data->primes[0]);
    if (data == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    data->permuted = choice == 1;
    aur_primes(set->dimension, data->primes);
    set->data = data;
    return AUR_OK;
}

static aur_result prepare_halton(aur_pointset *set, aur_parameters *keys, const aur_pointset_options *options,
                                 aur_error *error) {
    (void)options;
    return prepare(set, keys, true, error);
}

static aur_result prepare_hammersley(aur_pointset *set, aur_parameters *keys,
                                     const aur_pointset_options *options, aur_error *error) {
    (void)options;
    return prepare(set, keys, false, error);
}

/* The prime of a dimension, found when the set has none ready. */
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

const aur_square_set aur_set_halton = {
    .description = {.name = "halton",
                    .keys = "permute=none",
                    .summary = "radical inverses in the first primes",
                    .domains = "square, cube",
                    .sizes = "1..2^48",
                    .extensible = 1,
                    .source = "Halton 1960; permutations Owen 2017"},
    .minimum_dimension = 1,
    .maximum_dimension = AUR_RADICAL_PRIMES,
    .maximum_size = AUR_INDEX_LIMIT,
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare_halton,
    .fill = fill_halton,
};

const aur_square_set aur_set_hammersley = {
    .description = {.name = "hammersley",
                    .keys = "",
                    .summary = "i/N, then radical inverses in the first primes",
                    .domains = "square, cube",
                    .sizes = "1..2^48",
                    .extensible = 0,
                    .binary_net = 1,
                    .source = "Hammersley 1960"},
    .minimum_dimension = 1,
    .maximum_dimension = AUR_RADICAL_PRIMES,
    .maximum_size = AUR_INDEX_LIMIT,
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare_hammersley,
    .fill = fill_hammersley,
};
