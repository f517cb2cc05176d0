#include "check.h"

#include <aureole/pointset.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char path[] = "points-that-are-written";

/* The whole of a file as text, to be freed. */
static char *slurp(size_t *size) {
    FILE *const stream = fopen(path, "rb");
    assert_non_null(stream);
    char *const text = calloc(1, 4096);
    assert_non_null(text);
    *size = fread(text, 1, 4095, stream);
    fclose(stream);
    return text;
}

static void expect_text(aur_points_format format, const aur_points_view *points,
                        const aur_points_origin *origin, const char *expected) {
    const aur_points_write_options options = {.size = sizeof options, .origin = origin};
    assert_int_equal(aur_points_write(path, format, points, &options, NULL), AUR_OK);
    size_t size;
    char *const text = slurp(&size);
    assert_string_equal(text, expected);
    free(text);
}

static double square[] = {0.0, 0.1, 0.5, 0.75};
static double direction[] = {0.0, 0.6, 0.8};
static double weight[] = {0.25, 0.125};

static const aur_points_view flat = {
    .size = sizeof flat, .domain = AUR_DOMAIN_SQUARE, .count = 2, .dimension = 2, .coordinates = square};
static const aur_points_view round_one = {.size = sizeof round_one,
                                          .domain = AUR_DOMAIN_SPHERE,
                                          .count = 1,
                                          .dimension = 3,
                                          .coordinates = direction,
                                          .weights = weight};

/* Headers by domain, weights last, 17 digits. */
static void csv_is_as_documented(void **state) {
    (void)state;
    expect_text(AUR_POINTS_CSV, &flat, NULL, "u,v\n0,0.10000000000000001\n0.5,0.75\n");
    expect_text(AUR_POINTS_CSV, &round_one, NULL,
                "x,y,z,w# domain: sphere\n0,0.59999999999999998,0.80000000000000004,0.25\n");
    aur_points_view disk = flat;
    disk.domain = AUR_DOMAIN_DISK;
    disk.weights = weight;
    expect_text(AUR_POINTS_CSV, &disk, NULL, "x,y,w\n0,0.10000000000000001,0.25\n0.5,0.75,0.125\n");
    const aur_points_view cube = {
        .size = sizeof cube, .domain = AUR_DOMAIN_CUBE, .count = 1, .dimension = 4, .coordinates = square};
    expect_text(AUR_POINTS_CSV, &cube, NULL, "u1,u2,u3,u4\n0,0.10000000000000001,0.5,0.75\n");
}

/* The text of a set may contain characters that JSON must escape. */
static void json_names_its_origin(void **state) {
    (void)state;
    const aur_points_origin origin = {.size = sizeof origin,
                                      .set = "file:a\"b\\c\n",
                                      .count = 9,
                                      .first = 3,
                                      .scramble = AUR_SCRAMBLE_OWEN,
                                      .seed = 5};
    expect_text(
        AUR_POINTS_JSON, &round_one, &origin,
        "{\n  \"set\": \"file:a\\\"b\\\\c\\u000a\",\n  \"n\": 9,\n  \"first\": 3,\n  \"scramble\": "
        "\"owen\",\n"
        "  \"seed\": 5,\n  \"domain\": \"sphere\",\n  \"dimension\": 3,\n  \"points\": [\n"
        "    [0, 0.59999999999999998, 0.80000000000000004]\n  ],\n  \"weights\": [\n    0.25\n  ]\n}\n");
    expect_text(AUR_POINTS_JSON, &flat, NULL,
                "{\n  \"domain\": \"square\",\n  \"dimension\": 2,\n  \"points\": [\n"
                "    [0, 0.10000000000000001],\n    [0.5, 0.75]\n  ]\n}\n");
}

/* NPY format: magic, version, a header padded to a multiple of 64, then rows of doubles. */
static void npy_is_what_numpy_reads(void **state) {
    (void)state;
    assert_int_equal(aur_points_write(path, AUR_POINTS_NPY, &round_one, NULL, NULL), AUR_OK);
    size_t size;
    char *const text = slurp(&size);
    assert_int_equal(size, 128 + 4 * 8);
    assert_memory_equal(
        text, "\x93NUMPY\x01\x00\x76\x00{'descr': '<f8', 'fortran_order': False, 'shape': (1, 4), }", 66);
    assert_non_null(strstr(text + 66, " # domain: sphere; weights   "));
    assert_int_equal(text[127], '\n');
    const double row[] = {0.0, 0.6, 0.8, 0.25};
    assert_memory_equal(text + 128, row, sizeof row);
    free(text);
}

static void ply_has_three_coordinates(void **state) {
    (void)state;
    const aur_points_origin origin = {.size = sizeof origin, .set = "file:a\nb", .count = 2};
    const aur_points_write_options options = {.size = sizeof options, .origin = &origin};
    assert_int_equal(aur_points_write(path, AUR_POINTS_PLY, &flat, &options, NULL), AUR_OK);
    size_t size;
    char *const text = slurp(&size);
    static const char header[] =
        "ply\nformat binary_little_endian 1.0\ncomment set file:a b\ncomment n 2\ncomment scramble "
        "none\ncomment seed 0\ncomment domain square\nelement vertex 2\nproperty double "
        "x\nproperty double y\nproperty double z\nend_header\n";
    assert_memory_equal(text, header, sizeof header - 1);
    const double rows[] = {0.0, 0.1, 0.0, 0.5, 0.75, 0.0};
    assert_int_equal(size, sizeof header - 1 + sizeof rows);
    assert_memory_equal(text + sizeof header - 1, rows, sizeof rows);
    free(text);
}

static int exists(const char *name) {
    return access(name, F_OK) == 0;
}

/* Nothing is left behind and nothing is replaced when writing fails. */
static void failures_leave_the_old_file(void **state) {
    (void)state;
    expect_text(AUR_POINTS_CSV, &flat, NULL, "u,v\n0,0.10000000000000001\n0.5,0.75\n");
    const aur_points_view cube = {
        .size = sizeof cube, .domain = AUR_DOMAIN_CUBE, .count = 1, .dimension = 4, .coordinates = square};
    aur_error error = {0};
    assert_int_equal(aur_points_write(path, AUR_POINTS_PLY, &cube, NULL, &error), AUR_ERROR_UNSUPPORTED);
    assert_true(strlen(error.message) > 0);
    size_t size;
    char *const text = slurp(&size);
    assert_string_equal(text, "u,v\n0,0.10000000000000001\n0.5,0.75\n");
    free(text);
    assert_int_equal(aur_points_write(path, (aur_points_format)9, &flat, NULL, &error), AUR_ERROR_ARGUMENT);
    assert_int_equal(aur_points_write("no-such-folder/points", AUR_POINTS_CSV, &flat, NULL, &error),
                     AUR_ERROR_WRITE);
    if (exists("/dev/full"))
        assert_int_equal(aur_points_write("/dev/full", AUR_POINTS_CSV, &flat, NULL, &error), AUR_ERROR_WRITE);
}

static void names_round_trip(void **state) {
    (void)state;
    for (int i = 0; i < 4; ++i) {
        aur_points_format format;
        assert_int_equal(
            aur_points_format_from_name(aur_points_format_name((aur_points_format)i), &format, NULL), AUR_OK);
        assert_int_equal(format, i);
    }
    aur_points_format format;
    assert_int_equal(aur_points_format_from_name("obj", &format, NULL), AUR_ERROR_NAME);
    assert_null(aur_points_format_name((aur_points_format)4));
}

static int clean(void **state) {
    (void)state;
    unlink(path);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_is_as_documented),        cmocka_unit_test(json_names_its_origin),
        cmocka_unit_test(npy_is_what_numpy_reads),     cmocka_unit_test(ply_has_three_coordinates),
        cmocka_unit_test(failures_leave_the_old_file), cmocka_unit_test(names_round_trip),
    };
    return cmocka_run_group_tests(tests, NULL, clean);
}
