#include "points/pointset/digits/digital_kernels.h"

/* Two words in the form of the kernels, see digital_kernels.h; the form is linear. */
static void put_form(aur_scramble scramble, const uint64_t words[2], uint64_t form[2]) {
    const bool owen = scramble == AUR_SCRAMBLE_OWEN;
    const uint64_t a = words[0], b = words[1];
    form[0] =
        owen ? (uint64_t)aur_reverse_bits((uint32_t)(b >> 32)) << 32 | aur_reverse_bits((uint32_t)(a >> 32))
             : a;
    form[1] = owen ? b << 32 | (uint32_t)a : b;
}

void aur_digital_run_start(aur_digital_run *run, size_t slots) {
    aur_digital_group *const group = &run->group;
    const size_t dimensions = run->dimension_count;
    const uint64_t size = slots / dimensions;
    const unsigned bits = (unsigned)__builtin_ctzll(size);
    const uint64_t start = run->first % size;
    const uint64_t number = run->first / size;
    uint64_t words[2] = {0};
    uint64_t sums[2] = {0};
    for (size_t d = 0; d < dimensions; ++d) {
        const uint64_t *const columns = run->columns[d];
        const uint64_t key = run->scramble == AUR_SCRAMBLE_DIGIT ? run->keys[d] : 0;
        uint64_t lanes[AUR_DIGITAL_SLOTS] = {key};
        for (unsigned k = 0; k < bits; ++k)
            for (size_t l = 0; l < (size_t)1 << k; ++l)
                lanes[((size_t)1 << k) + l] = lanes[l] ^ columns[k];
        for (uint64_t p = 0; p < size; ++p) {
            const size_t slot = p * dimensions + d;
            group->lanes[slot] = lanes[(start + p) % size];
            group->wrapped[slot] = start + p >= size ? UINT64_MAX : 0;
        }
        words[d] = aur_digital_word(columns, number * size);
    }
    /* A single coordinate is used for both of a pair. */
    const size_t last = dimensions - 1;
    words[1] = words[last];
    put_form(run->scramble, words, group->words);
    group->next = number + 1;
    uint64_t digits = words[0] | words[1];
    for (size_t s = 0; s < slots; ++s)
        digits |= group->lanes[s];
    const uint64_t numbers = run->last / size + 1;
    for (unsigned z = 0; numbers >> z != 0; ++z) {
        sums[0] ^= run->columns[0][bits + z];
        sums[1] ^= run->columns[last][bits + z];
        digits |= sums[0] | sums[1];
        put_form(run->scramble, sums, group->flips[z]);
    }
    group->tails = (uint32_t)digits != 0;
    run->started = true;
}
