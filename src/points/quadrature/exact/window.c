#include "points/quadrature/exact/fast.h"

#include <math.h>

#include "points/base/gauss.h"
#include "points/base/vector.h"

enum { GAUSS = 64 };

size_t aur_fourier_size(size_t least) {
    size_t best = SIZE_MAX;
    for (size_t odd = 1; odd <= 9; odd *= 3) {
        size_t size = 64 * odd;
        while (size < least)
            size *= 2;
        best = size < best ? size : best;
    }
    return best;
}

aur_window aur_window_make(size_t degree) {
    aur_window window = {.side = aur_fourier_size((7 * (2 * degree + 1) + 3) / 4)};
    /* The shape parameter that balances aliasing and the truncation of the window (Barnett et al. 2019). */
    const double cells = (double)window.side / (2.0 * (double)degree + 1.0);
    window.shape = 0.98 * AUR_PI * AUR_WINDOW_WIDTH * (1.0 - 0.5 / cells);
    return window;
}

static double value_at(const aur_window *window, double x) {
    return x * x < 1.0 ? exp(window->shape * (sqrt(1.0 - x * x) - 1.0)) : 0.0;
}

double aur_window_fill(const aur_window *window, double cell, double values[AUR_WINDOW_WIDTH]) {
    const double first = ceil(cell - 0.5 * AUR_WINDOW_WIDTH);
    for (int k = 0; k < AUR_WINDOW_WIDTH; ++k)
        values[k] = value_at(window, (first + k - cell) / (0.5 * AUR_WINDOW_WIDTH));
    return first;
}

void aur_window_invert(const aur_window *window, size_t degree, double *factors) {
    double nodes[GAUSS], weights[GAUSS];
    aur_gauss_legendre(GAUSS, nodes, weights);
    for (size_t k = 0; k <= degree; ++k) {
        double sum = 0.0;
        for (size_t i = 0; i < GAUSS; ++i)
            sum += weights[i] * value_at(window, nodes[i]) *
                   cos(AUR_PI * AUR_WINDOW_WIDTH * (double)k * nodes[i] / (double)window->side);
        factors[k] = 1.0 / (0.5 * AUR_WINDOW_WIDTH * sum);
    }
}
