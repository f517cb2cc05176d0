#include "pointset/digits/digital_kernels.h"

/* OWEN's form of a word, see digital_kernels.h; exclusive sums of forms are forms of exclusive sums. */
static uint64_t form_of(aur_scramble scramble, uint64_t word) {
    if (scramble != AUR_SCRAMBLE_OWEN)
        return word;
    return (uint64_t)(uint32_t)word << 32 | aur_reverse_bits((uint32_t)(word >> 32));
}

void aur_digital_flips(aur_scramble scramble, const uint64_t columns[AUR_DIGITAL_COLUMNS], unsigned bits,
                       uint64_t flips[AUR_DIGITAL_COLUMNS]) {
    uint64_t sum = 0;
    for (unsigned k = bits; k < AUR_DIGITAL_COLUMNS; ++k) {
        sum ^= columns[k];
        flips[k - bits] = form_of(scramble, sum);
    }
}

void aur_digital_group_prepare(const aur_digital_run *run, size_t dimension, unsigned bits,
                               const unsigned char *order, aur_digital_group *group) {
    const uint64_t *const columns = run->columns[dimension];
    const uint64_t size = UINT64_C(1) << bits;
    const uint64_t xor_key = run->scramble == AUR_SCRAMBLE_DIGIT ? run->keys[dimension] : 0;
    for (size_t l = 0; l < size; ++l) {
        const uint64_t index = (run->first + order[l]) % size;
        group->lanes[l] = form_of(run->scramble, aur_digital_word(columns, index) ^ xor_key);
    }
    aur_digital_flips(run->scramble, columns, bits, group->flips);
    group->word = form_of(run->scramble, aur_digital_word(columns, run->first / size * size));
}
