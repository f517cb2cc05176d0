/* A functional of four dimensions with its interval: the view factor between two opposed unit squares at the
 * distance 1, the mean of 1 / (pi r^4) over a point on each.
 *
 *     cc examples/estimate.c -laureole -lm -o estimate && ./estimate
 *
 * Prints the factor, half of its 95 % interval, how far it is from the closed form (Howell, C-11), and how
 * many points it took. */
#include <aureole/estimate.h>
#include <math.h>
#include <stdio.h>

static aur_result exchange(void *user, const aur_estimate_points *points, double *values, aur_error *error) {
    (void)user;
    (void)error;
    values[0] = 0.0;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const u = points->points + points->dimension * i;
        const double x = u[0] - u[2], y = u[1] - u[3], square = x * x + y * y + 1.0;
        values[0] += points->weights[i] / (3.14159265358979323846 * square * square);
    }
    return AUR_OK;
}

int main(void) {
    aur_estimate_options options = {.size = sizeof options};
    aur_estimate_options_init(4, 1, &options, NULL);
    options.relative = 1e-4;
    aur_estimated factor;
    aur_estimate_report report = {.size = sizeof report};
    aur_error error;
    if (aur_estimate(exchange, NULL, &options, &factor, &report, &error) != AUR_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("factor %.9f\ninterval %.2e\noff %.2e\npoints %llu\n", factor.value, factor.half_width,
           factor.value - 0.199824895698, (unsigned long long)report.evaluations);
    return report.reached ? 0 : 1;
}
