#include "check.h"

#include "points/base/random.h"
#include "render/scene/patches.h"

/* The last item whose preceding sum is not above the target, by linear search; never one of weight 0. */
static size_t by_linear_search(const aur_distribution *distribution, double u) {
    size_t found = 0;
    for (size_t i = 0; i < distribution->count; ++i)
        if (distribution->sums[i] <= u * distribution->total &&
            distribution->sums[i + 1] > distribution->sums[i])
            found = i;
    return found;
}

enum { MOST = 700 };

/* Uniform, steep, mostly 0, and one with nearly all the weight. */
static double weight_of(size_t kind, size_t i, size_t count) {
    const double unit = aur_unit_double(aur_hash4(kind, i, count, 7));
    switch (kind) {
    case 0:
        return 1.0;
    case 1:
        return unit * unit * unit * unit;
    case 2:
        return unit < 0.9 ? 0.0 : unit;
    default:
        return i == count / 2 ? 1e9 : 1.0;
    }
}

static void chooses_as_a_linear_search_does(void **state) {
    (void)state;
    static const size_t counts[] = {1, 2, 15, 16, 17, 300, MOST};
    for (size_t kind = 0; kind < 4; ++kind) {
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; ++c) {
            const size_t count = counts[c];
            double weights[MOST];
            for (size_t i = 0; i < count; ++i)
                weights[i] = weight_of(kind, i, count);
            weights[count - 1] = kind == 2 ? 0.0 : weights[count - 1];
            weights[0] = kind == 2 ? 0.5 : weights[0];
            aur_distribution distribution;
            assert_int_equal(aur_distribution_create(&distribution, count, weights, NULL), AUR_OK);
            for (size_t k = 0; k < 4 * count + 200 && distribution.total > 0.0; ++k) {
                /* Steps of the guide table, the two neighbouring numbers, and others. */
                const double step = (double)(k / 4) / (double)count;
                const double tries[4] = {step, nextafter(step, 0.0), nextafter(step, 1.0),
                                         aur_unit_double(aur_hash4(k, count, kind, 1))};
                const double u = tries[k % 4] < 1.0 ? tries[k % 4] : 0x1.fffffffffffffp-1;
                double rest = u;
                assert_int_equal(aur_distribution_choose_double(&distribution, &rest),
                                 by_linear_search(&distribution, u));
                assert_true(count == 1 || (rest >= 0.0 && rest < 1.0));
            }
            aur_distribution_release(&distribution);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chooses_as_a_linear_search_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
