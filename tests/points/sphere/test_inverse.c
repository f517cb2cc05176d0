#include "sphere_check.h"

#include <string.h>

#include "points/base/simd.h"
#include "points/sphere/nearest/inverse.h"

/* Every other direction near a pole, where the lattice is bent most. */
static void sample_direction(uint64_t size, uint64_t index, aur_domain domain, double q[3]) {
    check_random_direction(size, index, q);
    if (index % 2 == 1) {
        const double depth = 40.0 * aur_unit_double(aur_hash3(size, index, 9)) / (double)size;
        const double z = depth < 2.0 ? 1.0 - depth : -1.0;
        const double scale = sqrt((1.0 - z) * (1.0 + z) / (q[0] * q[0] + q[1] * q[1]));
        q[0] *= scale;
        q[1] *= scale;
        q[2] = index % 4 == 1 ? z : -z;
    }
    if (domain == AUR_DOMAIN_HEMISPHERE)
        q[2] = fabs(q[2]);
}

static double squared(const double *a, const double *b) {
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

static size_t nearest_by_force(size_t count, const double *xyz, const double *q) {
    size_t nearest = 0;
    double best = INFINITY;
    for (size_t j = 0; j < count; ++j) {
        const double distance = squared(xyz + 3 * j, q);
        if (distance < best) {
            best = distance;
            nearest = j;
        }
    }
    return nearest;
}

/* Equal computed distances may belong to two points; anything else must agree. */
static void check_nearest(const double *xyz, const double *q, size_t expected, uint64_t actual) {
    const double best = squared(xyz + 3 * expected, q);
    const double other = squared(xyz + 3 * actual, q);
    if (expected != actual && other > best * (1.0 + 1e-12) + 1e-30)
        fail_msg("nearest is %zu at %.17g, not %zu at %.17g", expected, best, (size_t)actual, other);
}

static void check_size(size_t size, aur_domain domain, size_t directions) {
    const aur_fibonacci_set set = {size, domain};
    double *const xyz = check_directions(
        "spherical-fibonacci",
        (aur_directions_options){.size = sizeof(aur_directions_options), .count = size, .domain = domain});
    for (size_t i = 0; i < directions; ++i) {
        double q[3];
        uint64_t index;
        sample_direction(size, i, domain, q);
        assert_int_equal(aur_fibonacci_nearest(&set, 1, q, 1, &index, NULL), AUR_OK);
        assert_true(index < size);
        check_nearest(xyz, q, nearest_by_force(size, xyz, q), index);
    }
    free(xyz);
}

/* Every size from 1 to 20,000. */
static void nearest_agrees_with_brute_force(void **state) {
    (void)state;
    for (size_t size = 1; size <= 20000; ++size)
        check_size(size, AUR_DOMAIN_SPHERE, size < 400 ? 60 : 2);
    for (size_t size = 1; size <= 20000; size += 1 + size / 40)
        check_size(size, AUR_DOMAIN_HEMISPHERE, 40);
}

static void points_are_nearest_to_themselves(void **state) {
    (void)state;
    static const size_t sizes[] = {1, 2, 3, 17, 1000, 4181};
    for (size_t s = 0; s < 6; ++s) {
        const size_t size = sizes[s];
        const aur_fibonacci_set set = {size, AUR_DOMAIN_SPHERE};
        double *const xyz = check_directions("spherical-fibonacci",
                                             (aur_directions_options){.size = sizeof(aur_directions_options),
                                                                      .count = size,
                                                                      .domain = AUR_DOMAIN_SPHERE});
        uint64_t *const indices = malloc(size * sizeof *indices);
        assert_int_equal(aur_fibonacci_nearest(&set, size, xyz, size, indices, NULL), AUR_OK);
        for (size_t i = 0; i < size; ++i)
            assert_int_equal(indices[i], i);
        free(indices);
        free(xyz);
    }
}

/* Huge sets, where brute force cannot follow: no point of the 64 nearest is nearer. */
static void nearest_agrees_with_its_neighbours(void **state) {
    (void)state;
    static const uint64_t sizes[] = {1000000, 1000000007, UINT64_C(1) << 40, UINT64_C(1) << 50};
    for (size_t s = 0; s < 4; ++s) {
        const aur_fibonacci_set set = {sizes[s], AUR_DOMAIN_SPHERE};
        for (uint64_t i = 0; i < 500; ++i) {
            double q[3];
            uint64_t nearest, neighbours[64];
            sample_direction(sizes[s], i, AUR_DOMAIN_SPHERE, q);
            assert_int_equal(aur_fibonacci_nearest(&set, 1, q, 1, &nearest, NULL), AUR_OK);
            assert_int_equal(aur_fibonacci_neighbours(&set, q, 64, 64, neighbours, NULL), AUR_OK);
            assert_int_equal(nearest, neighbours[0]);
        }
    }
}

static void kernels_agree(void **state) {
    (void)state;
#if defined(AUR_PORTABLE)
    skip();
#else
    enum { COUNT = 4003 };
    static aur_sphere_lattice_kernel *const kernels[] = {aur_sphere_lattice_nearest_avx2,
                                                         aur_sphere_lattice_nearest_avx512};
    static const aur_isa needs[] = {AUR_ISA_AVX2, AUR_ISA_AVX512};
    static double xyz[3 * COUNT], expected[COUNT], actual[COUNT];
    for (size_t s = 0; s < 30; ++s) {
        const double size = floor(pow(1.8, (double)s)) + 1.0;
        const aur_sphere_lattice lattice = s % 2 == 0 ? (aur_sphere_lattice){2.0 / size, size, size}
                                                      : (aur_sphere_lattice){1.0 / size, 2.0 * size, size};
        for (size_t i = 0; i < COUNT; ++i)
            sample_direction((uint64_t)size, i, s % 2 == 0 ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_HEMISPHERE,
                             xyz + 3 * i);
        xyz[0] = xyz[1] = 0.0;
        xyz[2] = 1.0;
        aur_sphere_lattice_nearest_portable(&lattice, COUNT, xyz, expected);
        for (size_t k = 0; k < 2; ++k) {
            if (aur_isa_available() < needs[k])
                continue;
            kernels[k](&lattice, COUNT, xyz, actual);
            assert_memory_equal(expected, actual, sizeof expected);
        }
    }
#endif
}

/* The k nearest, in order, against sorting all by brute force. */
static void neighbours_agree_with_brute_force(void **state) {
    (void)state;
    static const size_t numbers[] = {1, 2, 6, 7, 33, 256};
    for (size_t size = 1; size < 3000; size += 1 + size / 6) {
        for (size_t domain = 0; domain < 2; ++domain) {
            const aur_fibonacci_set set = {size, domain == 0 ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_HEMISPHERE};
            double *const xyz = check_directions(
                "spherical-fibonacci", (aur_directions_options){.size = sizeof(aur_directions_options),
                                                                .count = size,
                                                                .domain = set.domain});
            for (size_t w = 0; w < 6; ++w) {
                const size_t k = numbers[w] < size ? numbers[w] : size;
                for (uint64_t i = 0; i < 4; ++i) {
                    double q[3];
                    uint64_t found[256];
                    sample_direction(size, 4 * w + i, set.domain, q);
                    assert_int_equal(aur_fibonacci_neighbours(&set, q, k, k, found, NULL), AUR_OK);
                    /* ordered, different, and nothing else is nearer than the last */
                    const double last = squared(xyz + 3 * found[k - 1], q);
                    size_t nearer = 0;
                    for (size_t j = 0; j < size; ++j)
                        nearer += squared(xyz + 3 * j, q) < last * (1.0 - 1e-12);
                    assert_true(nearer <= k - 1);
                    for (size_t n = 1; n < k; ++n) {
                        assert_true(squared(xyz + 3 * found[n - 1], q) <=
                                    squared(xyz + 3 * found[n], q) * (1.0 + 1e-12));
                        for (size_t m = 0; m < n; ++m)
                            assert_true(found[m] != found[n]);
                    }
                }
            }
            free(xyz);
        }
    }
}

static void refuses_what_is_wrong(void **state) {
    (void)state;
    const aur_fibonacci_set sphere = {100, AUR_DOMAIN_SPHERE};
    const aur_fibonacci_set half = {100, AUR_DOMAIN_HEMISPHERE};
    const aur_fibonacci_set empty = {0, AUR_DOMAIN_SPHERE};
    const aur_fibonacci_set flat = {100, AUR_DOMAIN_DISK};
    const double up[3] = {0, 0, 1};
    const double down[3] = {0, 0, -1};
    const double none[3] = {NAN, 0, 1};
    const double endless[3] = {INFINITY, 0, 0};
    const double zero[3] = {0, 0, 0};
    uint64_t found[300];
    assert_int_equal(aur_fibonacci_nearest(&sphere, 1, up, 0, found, NULL), AUR_ERROR_CAPACITY);
    assert_int_equal(aur_fibonacci_nearest(&empty, 1, up, 1, found, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_fibonacci_nearest(&flat, 1, up, 1, found, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_fibonacci_nearest(&half, 1, down, 1, found, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_fibonacci_nearest(&sphere, 1, none, 1, found, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_fibonacci_nearest(&sphere, 1, endless, 1, found, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_fibonacci_nearest(&sphere, 1, zero, 1, found, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_fibonacci_neighbours(&sphere, up, 101, 300, found, NULL), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_fibonacci_neighbours(&sphere, up, 9, 8, found, NULL), AUR_ERROR_CAPACITY);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_agrees_with_brute_force),
        cmocka_unit_test(points_are_nearest_to_themselves),
        cmocka_unit_test(nearest_agrees_with_its_neighbours),
        cmocka_unit_test(kernels_agree),
        cmocka_unit_test(neighbours_agree_with_brute_force),
        cmocka_unit_test(refuses_what_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
