/* The paper's rules for golden sequences and sets, implemented literally. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "schretter.h"

enum { MOST = 4096 };

/* The increment a = F_{2i+1} and the decrement b = F_{2i} of eq. 7. */
static void find_steps(size_t n, size_t *a, size_t *b) {
    *b = 1; /* F_2 */
    *a = 2; /* F_3 */
    while (*a + *b < n) {
        const size_t even = *a + *b; /* F_{2i+2} */
        *a += even;
        *b = even;
    }
}

/* Sorts the numbers 1..n of the golden sequence by eq. 7 from the smallest one; returns the longest run of
 * indices beyond n. */
static size_t walk(size_t n, size_t smallest, size_t *order) {
    size_t a, b, most = 0;
    find_steps(n, &a, &b);
    order[0] = smallest;
    for (size_t i = 1, now = smallest; i < n; ++i) {
        size_t skipped = 0;
        do {
            now = now <= b ? now + a : now - b;
            skipped += now > n;
        } while (now > n);
        most = skipped > most ? skipped : most;
        order[i] = now;
    }
    return most;
}

static size_t index_of_smallest(size_t n, const double *numbers) {
    size_t best = 1;
    for (size_t i = 2; i <= n; ++i)
        if (numbers[i - 1] < numbers[best - 1])
            best = i;
    return best;
}

/* Whether eq. 7 sorts for every n up to `count`; *most is the longest run to skip. */
static size_t check_order(size_t count, const double *numbers, size_t *most) {
    size_t sorted = 0;
    size_t order[MOST];
    *most = 0;
    for (size_t n = 2; n <= count; ++n) {
        const size_t skipped = walk(n, index_of_smallest(n, numbers), order);
        *most = skipped > *most ? skipped : *most;
        bool ascending = true;
        for (size_t i = 1; i < n; ++i)
            ascending = ascending && numbers[order[i - 1] - 1] < numbers[order[i] - 1];
        sorted += ascending;
    }
    return sorted;
}

/* Section 2: sums of 2654435769 in 32 bits against the sequence. */
static double check_integers(size_t count, const double *numbers) {
    double most = 0.0;
    uint32_t state = 0;
    for (size_t i = 0; i < count; ++i) {
        state += UINT32_C(2654435769);
        most = fmax(most, fabs((double)state / 4294967296.0 - numbers[i]));
    }
    return most;
}

void schretter_check_rules(lab_run *run, size_t count, const double *numbers) {
    static const size_t published[6] = {5, 2, 4, 1, 6, 3};
    size_t order[6], most;
    walk(6, index_of_smallest(6, numbers), order);
    lab_claim(run, memcmp(order, published, sizeof order) == 0,
              "sec. 3: for N = 6, s = 0 the order is 5, 2, 4, 1, 6, 3 (here %zu, %zu, %zu, %zu, %zu, %zu)",
              order[0], order[1], order[2], order[3], order[4], order[5]);
    const size_t sorted = check_order(count, numbers, &most);
    lab_claim(run, sorted == count - 1,
              "eq. 7: sorts the sequence, when every index beyond N is skipped (%zu of %zu sizes)", sorted,
              count - 1);
    lab_claim(run, most <= 1, "eq. 7, appendix: one index at a time has to be skipped (up to %zu in a row)",
              most);
    const double off = check_integers(count, numbers), bound = (double)count / 4294967296.0;
    lab_claim(
        run, off <= bound,
        "sec. 2: sums of 2654435769 in 32 bits are the sequence (off by %.2g after %zu, rounding allows "
        "%.2g)",
        off, count, bound);
}
