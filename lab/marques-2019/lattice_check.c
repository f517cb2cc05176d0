/* Checks of a statement over its cases, and the basis vectors of spherical Fibonacci grids (Marques 2019). */
#include "lattice.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

const double lattice_golden = 1.6180339887498948482;

lattice_check lattice_begin(const char *item, const char *statement, double at_least, double at_most) {
    return (lattice_check){.item = item,
                           .statement = statement,
                           .at_least = at_least,
                           .at_most = at_most,
                           .least = INFINITY,
                           .most = -INFINITY,
                           .first_exception = NAN};
}

void lattice_count(lattice_check *check, double which, double value) {
    ++check->cases;
    check->least = fmin(check->least, value);
    check->most = fmax(check->most, value);
    if (value >= check->at_least && value <= check->at_most)
        return;
    if (check->exceptions++ == 0)
        check->first_exception = which;
}

void lattice_end(lab_run *run, const lattice_check *check) {
    lab_row(run, (const char *const[]){check->item, check->statement, NULL}, 7,
            (const double[]){(double)check->cases, check->least, check->most, check->at_least, check->at_most,
                             (double)check->exceptions, check->first_exception});
    if (!check->ours)
        lab_claim(run, check->exceptions == 0, "%s: %s (%zu of %zu cases)", check->item, check->statement,
                  check->cases - check->exceptions, check->cases);
}

double lattice_fibonacci(size_t k) {
    double before = 1.0, now = 0.0; /* F_{-1}, F_0 */
    for (; k > 0; --k) {
        const double next = before + now;
        before = now;
        now = next;
    }
    return now;
}

void lattice_vector(size_t k, double n, double vector[2]) {
    vector[0] = lattice_fibonacci(k) / n;
    vector[1] = (k % 2 == 1 ? 1.0 : -1.0) * pow(lattice_golden, -(double)k);
}

double lattice_length2(size_t k, double n, double sx) {
    double b[2];
    lattice_vector(k, n, b);
    return sx * sx * b[0] * b[0] + b[1] * b[1];
}

size_t lattice_shortest(double n, double sx) {
    size_t best = 1;
    for (size_t k = 2; k < LATTICE_MOST_INDEX; ++k)
        if (lattice_length2(k, n, sx) < lattice_length2(best, n, sx))
            best = k;
    return best;
}
