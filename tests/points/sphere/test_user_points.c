/* Sets that a program registers, and a file for each size, compared with the library's points. */
#include "check.h"

#include <aureole/quality.h>
#include <aureole/sphere.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* The points of the set that `user` names: the callback must return them unchanged. */
static aur_result copy_set(void *user, uint64_t count, size_t dimension, double *points, double *weights,
                           aur_error *error) {
    const aur_domain domain = dimension == 3 ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_SQUARE;
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    aur_points *generated;
    const aur_result result = aur_points_generate(user, &request, &generated, error);
    if (result != AUR_OK)
        return result;
    memcpy(points, aur_points_get_view(generated)->coordinates, count * dimension * sizeof *points);
    for (size_t i = 0; weights != NULL && i < count; ++i)
        weights[i] = 2.0 * ((double)i + 0.5) / ((double)count * (double)count);
    aur_points_destroy(generated);
    return AUR_OK;
}

static aur_result generate(const char *set, aur_domain domain, uint64_t count, aur_scramble scramble,
                           aur_points **points, aur_error *error) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    options.scramble = scramble;
    options.seed = 3;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    return aur_points_generate(set, &request, points, error);
}

static void assert_same(const char *set, const char *other, aur_domain domain, uint64_t count,
                        aur_scramble scramble) {
    aur_points *a, *b;
    aur_error error = {0};
    assert_int_equal(generate(set, domain, count, scramble, &a, &error), AUR_OK);
    assert_int_equal(generate(other, domain, count, scramble, &b, &error), AUR_OK);
    const aur_points_view *const x = aur_points_get_view(a), *const y = aur_points_get_view(b);
    assert_int_equal(x->count, count);
    assert_memory_equal(x->coordinates, y->coordinates, count * x->dimension * sizeof(double));
    aur_points_destroy(a);
    aur_points_destroy(b);
}

static void register_set(const char *name, aur_domain domain, bool weighted, const char *set) {
    const aur_set_callback callback = {.size = sizeof callback,
                                       .name = name,
                                       .domain = domain,
                                       .weighted = weighted,
                                       .user = (void *)set,
                                       .generate = copy_set};
    assert_int_equal(aur_set_register(&callback, NULL), AUR_OK);
}

static void callbacks_are_sets(void **state) {
    (void)state;
    register_set("mine", AUR_DOMAIN_SQUARE, false, "hammersley");
    register_set("mine.directions", AUR_DOMAIN_SPHERE, false, "spherical-fibonacci");
    for (uint64_t count = 1; count < 100; count += 33) {
        assert_same("callback:mine", "hammersley", AUR_DOMAIN_SQUARE, count, AUR_SCRAMBLE_NONE);
        assert_same("callback:mine", "hammersley", AUR_DOMAIN_SQUARE, count, AUR_SCRAMBLE_SHIFT);
        assert_same("callback:mine", "hammersley", AUR_DOMAIN_HEMISPHERE, count, AUR_SCRAMBLE_ROTATE);
        assert_same("callback:mine", "hammersley", AUR_DOMAIN_DISK, count, AUR_SCRAMBLE_NONE);
        assert_same("callback:mine.directions", "spherical-fibonacci", AUR_DOMAIN_SPHERE, count,
                    AUR_SCRAMBLE_ROTATE3D);
    }
    /* Another function under the same name, and none. */
    register_set("mine", AUR_DOMAIN_SQUARE, false, "sobol");
    assert_same("callback:mine", "sobol", AUR_DOMAIN_SQUARE, 64, AUR_SCRAMBLE_NONE);
    assert_int_equal(
        aur_set_register(&(const aur_set_callback){.size = sizeof(aur_set_callback), .name = "mine"}, NULL),
        AUR_OK);
    aur_points *points;
    aur_error error = {0};
    assert_int_equal(generate("callback:mine", AUR_DOMAIN_SQUARE, 64, AUR_SCRAMBLE_NONE, &points, &error),
                     AUR_ERROR_NAME);
    assert_non_null(strstr(error.message, "callback:mine"));
}

static void weights_of_callbacks_are_preserved(void **state) {
    (void)state;
    register_set("weighted", AUR_DOMAIN_SPHERE, true, "spherical-fibonacci");
    aur_points *points;
    assert_int_equal(generate("callback:weighted", AUR_DOMAIN_SPHERE, 10, AUR_SCRAMBLE_NONE, &points, NULL),
                     AUR_OK);
    for (size_t i = 0; i < 10; ++i)
        assert_true(aur_points_get_view(points)->weights[i] == 2.0 * ((double)i + 0.5) / 100.0);
    aur_points_destroy(points);
}

static aur_result outside(void *user, uint64_t count, size_t dimension, double *points, double *weights,
                          aur_error *error) {
    (void)user, (void)weights, (void)error;
    for (size_t i = 0; i < count * dimension; ++i)
        points[i] = i == 3 ? 1.0 : 0.5;
    return AUR_OK;
}

static aur_result refuse(void *user, uint64_t count, size_t dimension, double *points, double *weights,
                         aur_error *error) {
    (void)user, (void)dimension, (void)points, (void)weights;
    return aur_fail(error, AUR_ERROR_UNSUPPORTED, "no set of %d points", (int)count);
}

static void wrong_callbacks_are_reported(void **state) {
    (void)state;
    aur_points *points;
    aur_error error = {0};
    aur_set_callback callback = {.size = sizeof callback, .name = "bad", .generate = outside};
    assert_int_equal(aur_set_register(&callback, &error), AUR_OK);
    assert_int_equal(generate("callback:bad", AUR_DOMAIN_SQUARE, 4, AUR_SCRAMBLE_NONE, &points, &error),
                     AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "point 2"));
    callback.generate = refuse;
    assert_int_equal(aur_set_register(&callback, &error), AUR_OK);
    assert_int_equal(generate("callback:bad", AUR_DOMAIN_SQUARE, 4, AUR_SCRAMBLE_NONE, &points, &error),
                     AUR_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.message, "no set of 4 points"));
    assert_int_equal(generate("callback:bad", AUR_DOMAIN_SQUARE, 0, AUR_SCRAMBLE_NONE, &points, NULL),
                     AUR_ERROR_ARGUMENT);
    callback.name = "a:b";
    assert_int_equal(aur_set_register(&callback, &error), AUR_ERROR_ARGUMENT);
}

static void write_points(const char *path, const char *set, aur_domain domain, uint64_t count) {
    aur_points *points;
    assert_int_equal(generate(set, domain, count, AUR_SCRAMBLE_NONE, &points, NULL), AUR_OK);
    assert_int_equal(aur_points_write(path, AUR_POINTS_CSV, aur_points_get_view(points), NULL, NULL), AUR_OK);
    aur_points_destroy(points);
}

static void a_file_for_each_size(void **state) {
    (void)state;
    mkdir("user_points.tmp", 0777);
    write_points("user_points.tmp/a-16.csv", "hammersley", AUR_DOMAIN_SQUARE, 16);
    write_points("user_points.tmp/a-64.csv", "hammersley", AUR_DOMAIN_SQUARE, 64);
    write_points("user_points.tmp/a-7.csv", "hammersley", AUR_DOMAIN_SQUARE, 8);
    static const char *const sets[] = {"file:user_points.tmp/a-%d.csv", "file:user_points.tmp",
                                       "file:user_points.tmp/"};
    for (size_t i = 0; i < 3; ++i)
        for (uint64_t count = 16; count <= 64; count *= 4) {
            assert_same(sets[i], "hammersley", AUR_DOMAIN_SQUARE, count, AUR_SCRAMBLE_NONE);
            assert_same(sets[i], "hammersley", AUR_DOMAIN_SPHERE, count, AUR_SCRAMBLE_SHIFT);
        }
    aur_points *points;
    aur_error error = {0};
    for (size_t i = 0; i < 3; ++i) {
        assert_int_equal(generate(sets[i], AUR_DOMAIN_SQUARE, 4, AUR_SCRAMBLE_NONE, &points, &error),
                         AUR_ERROR_OPEN);
        assert_int_equal(generate(sets[i], AUR_DOMAIN_SQUARE, 7, AUR_SCRAMBLE_NONE, &points, &error),
                         AUR_ERROR_FORMAT);
        assert_non_null(strstr(error.message, "found 8"));
        assert_int_equal(generate(sets[i], AUR_DOMAIN_SQUARE, 0, AUR_SCRAMBLE_NONE, &points, &error),
                         AUR_ERROR_ARGUMENT);
    }
    write_points("user_points.tmp/b64.npy.csv", "sobol", AUR_DOMAIN_SQUARE, 64); /* not of 64: no number */
    assert_same(sets[1], "hammersley", AUR_DOMAIN_SQUARE, 64, AUR_SCRAMBLE_NONE);
    write_points("user_points.tmp/b64.csv", "sobol", AUR_DOMAIN_SQUARE, 64);
    assert_int_equal(generate(sets[1], AUR_DOMAIN_SQUARE, 64, AUR_SCRAMBLE_NONE, &points, &error),
                     AUR_ERROR_FORMAT);
    remove("user_points.tmp/b64.csv");
    remove("user_points.tmp/b64.npy.csv");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(callbacks_are_sets),
        cmocka_unit_test(weights_of_callbacks_are_preserved),
        cmocka_unit_test(wrong_callbacks_are_reported),
        cmocka_unit_test(a_file_for_each_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
