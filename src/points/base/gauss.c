#include "points/base/gauss.h"

#include <math.h>

#include "points/base/vector.h"

void aur_gauss_legendre(size_t count, double *nodes, double *weights) {
    const double n = (double)count;
    for (size_t i = 0; i < (count + 1) / 2; ++i) {
        /* Newton's method from Tricomi's guess. */
        double x = cos(AUR_PI * ((double)i + 0.75) / (n + 0.5));
        double derivative = 1.0;
        for (int iteration = 0; iteration < 10; ++iteration) {
            double before = 1.0, value = x;
            for (size_t l = 2; l <= count; ++l) {
                const double degree = (double)l;
                const double next = ((2.0 * degree - 1.0) * x * value - (degree - 1.0) * before) / degree;
                before = value;
                value = next;
            }
            derivative = n * (x * value - before) / (x * x - 1.0);
            const double step = value / derivative;
            x -= step;
            if (fabs(step) < 1e-16)
                break;
        }
        const double weight = 2.0 / ((1.0 - x * x) * derivative * derivative);
        nodes[i] = -x;
        nodes[count - 1 - i] = x;
        weights[i] = weights[count - 1 - i] = weight;
    }
}
