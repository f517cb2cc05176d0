#include "check.h"

#include <aureole/pointset.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const char path[] = "test_points_file.tmp";

static void write_file(const char *data, size_t size) {
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static aur_points *read_text(const char *text) {
    write_file(text, strlen(text));
    aur_points *points;
    aur_error error = {0};
    const aur_result result = aur_points_read(path, NULL, &points, &error);
    if (result != AUR_OK)
        print_error("%s\n", error.message);
    assert_int_equal(result, AUR_OK);
    return points;
}

static void headers_say_what_columns_are(void **state) {
    (void)state;
    static const struct {
        const char *text;
        aur_domain domain;
        size_t dimension;
        bool weights;
    } cases[] = {
        {"u,v\n0,0.5\n", AUR_DOMAIN_SQUARE, 2, false},
        {"0.25 0.5\n", AUR_DOMAIN_SQUARE, 2, false},
        {"x,y\n-0.5,0.5\n", AUR_DOMAIN_DISK, 2, false},
        {"x,y,z\r\n0,0,1\r\n", AUR_DOMAIN_HEMISPHERE, 3, false},
        {"x,y,z,w\n0,0,1,0.5\n0,1,0,0.5\n", AUR_DOMAIN_HEMISPHERE, 3, true},
        {"\xef\xbb\xbfX, Y, Z\n0,0,1\n0,0,-1", AUR_DOMAIN_SPHERE, 3, false},
        {"# a comment\n\n0,0,-1\n", AUR_DOMAIN_SPHERE, 3, false},
        {"u\n0.5\n", AUR_DOMAIN_CUBE, 1, false},
        {"u1,u2,u3\n0,0.5,0.25\n", AUR_DOMAIN_CUBE, 3, false},
        {"u,v,w\n0,0.5,1\n", AUR_DOMAIN_SQUARE, 2, true},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        aur_points *points = read_text(cases[k].text);
        assert_int_equal(aur_points_get_view(points)->domain, cases[k].domain);
        assert_int_equal(aur_points_get_view(points)->dimension, cases[k].dimension);
        assert_int_equal(aur_points_get_view(points)->weights != NULL, cases[k].weights);
        aur_points_destroy(points);
    }
}

static aur_result read_on(aur_domain domain, const char *text, aur_points **points, aur_error *error) {
    write_file(text, strlen(text));
    return aur_points_read(path, &domain, points, error);
}

/* A header x,y means the disk, or the square if the square is requested. */
static void the_requested_domain_decides(void **state) {
    (void)state;
    static const char unit[] = "x,y\n0.9,0.9\n";
    aur_points *points;
    aur_error error = {0};
    assert_int_equal(read_on(AUR_DOMAIN_SQUARE, unit, &points, &error), AUR_OK);
    assert_int_equal(aur_points_get_view(points)->domain, AUR_DOMAIN_SQUARE);
    aur_points_destroy(points);
    assert_int_equal(aur_points_read(path, NULL, &points, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "header x,y"));
    assert_int_equal(read_on(AUR_DOMAIN_DISK, unit, &points, &error), AUR_ERROR_FORMAT);
    assert_int_equal(read_on(AUR_DOMAIN_DISK, "u,v\n0.5,0.5\n", &points, &error), AUR_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.message, "u,v"));
    assert_int_equal(error.line, 1);
    assert_int_equal(read_on(AUR_DOMAIN_SPHERE, "u1,u2,u3\n0,0.5,0.25\n", &points, &error),
                     AUR_ERROR_UNSUPPORTED);
    assert_int_equal(read_on(AUR_DOMAIN_SPHERE, "x,y,z\n0,0,1\n", &points, &error), AUR_OK);
    assert_int_equal(aur_points_get_view(points)->domain, AUR_DOMAIN_SPHERE);
    aur_points_destroy(points);
    assert_int_equal(read_on(AUR_DOMAIN_HEMISPHERE, "x,y,z\n0,0,-1\n", &points, &error), AUR_ERROR_FORMAT);
    assert_int_equal(error.line, 2);

    aur_pointset *set;
    const aur_pointset_options options = {.size = sizeof options};
    write_file(unit, sizeof unit - 1);
    assert_int_equal(aur_pointset_create("file:test_points_file.tmp", &options, &set, &error), AUR_OK);
    aur_pointset_destroy(set);
}

static void domains_have_names(void **state) {
    (void)state;
    for (int d = AUR_DOMAIN_SQUARE; d <= AUR_DOMAIN_SPHERE; ++d) {
        aur_domain domain;
        assert_int_equal(aur_domain_from_name(aur_domain_name((aur_domain)d), &domain, NULL), AUR_OK);
        assert_int_equal(domain, d);
    }
    aur_domain domain;
    assert_int_equal(aur_domain_from_name("ball", &domain, NULL), AUR_ERROR_NAME);
    assert_null(aur_domain_name((aur_domain)77));
}

static void numbers_come_back(void **state) {
    (void)state;
    aur_points *points = read_text("u,v,w\n0.10000000000000001,2.5e-1,3\n0.99999999999999989,0,-1\n");
    assert_int_equal(aur_points_get_view(points)->count, 2);
    assert_near(aur_points_get_view(points)->coordinates[0], 0.1, 0.0);
    assert_near(aur_points_get_view(points)->coordinates[1], 0.25, 0.0);
    assert_near(aur_points_get_view(points)->coordinates[2], 0.99999999999999989, 0.0);
    assert_near(aur_points_get_view(points)->weights[0], 3.0, 0.0);
    assert_near(aur_points_get_view(points)->weights[1], -1.0, 0.0);
    aur_points_destroy(points);
}

static void bad_text_names_its_line(void **state) {
    (void)state;
    static const struct {
        const char *text;
        size_t line;
    } cases[] = {
        {"u,v\n0,0.5\n0.25\n", 3},
        {"u,v\n0,0.5\n\n0,nan\n", 4},
        {"0,inf\n", 1},
        {"u,v\n0,1\n", 2},
        {"u,v\n0,0.5\n-0.1,0\n", 3},
        {"x,y,z\n0,0,2\n", 2},
        {"x,y\n0.9,0.9\n", 2},
        {"u,v\n0,0.5x\n", 2},
        {"a,b\n0,0.5\n", 1},
        {"u,v\n0,0.5\n0,0.5,0.5\n", 3},
        {"u,v\n0,\n", 2},
        {"0,0,0.5\n", 1},
        {"u,v\n0,,0.5\n", 2},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        write_file(cases[k].text, strlen(cases[k].text));
        aur_points *points;
        aur_error error = {0};
        assert_int_equal(aur_points_read(path, NULL, &points, &error), AUR_ERROR_FORMAT);
        assert_string_equal(error.file, path);
        assert_int_equal(error.line, cases[k].line);
        assert_null(points);
    }
    aur_points *points;
    write_file("", 0);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_ERROR_FORMAT);
    write_file("u,v\n", 4);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_ERROR_FORMAT);
    write_file("0,\0", 3);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_ERROR_FORMAT);
    assert_int_equal(aur_points_read("no such folder/file.csv", NULL, &points, NULL), AUR_ERROR_OPEN);
}

/* Builds an NPY file of version 1 around the given numbers. */
static void write_npy(const char *header, const void *numbers, size_t size) {
    char data[1024] = "\x93NUMPY\x01";
    const size_t length = strlen(header);
    data[8] = (char)length;
    memcpy(data + 10, header, length);
    memcpy(data + 10 + length, numbers, size);
    write_file(data, 10 + length + size);
}

static void arrays_come_back(void **state) {
    (void)state;
    static const double rows[] = {0.125, 0.25, 0.5, 0.625, 0.75, 0.875};
    aur_points *points;
    write_npy("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }\n", rows, sizeof rows);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_OK);
    assert_int_equal(aur_points_get_view(points)->domain, AUR_DOMAIN_SQUARE);
    assert_int_equal(aur_points_get_view(points)->count, 3);
    assert_memory_equal(aur_points_get_view(points)->coordinates, rows, sizeof rows);
    aur_points_destroy(points);

    write_npy("{'descr': '<f8', 'fortran_order': True, 'shape': (3, 2), }\n", rows, sizeof rows);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_OK);
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 2; ++c)
            assert_near(aur_points_get_view(points)->coordinates[2 * r + c], rows[3 * c + r], 0.0);
    aur_points_destroy(points);

    static const unsigned char half[] = {0x3f, 0, 0, 0};
    write_npy("{'descr': '>f4', 'fortran_order': False, 'shape': (1,), }\n", half, sizeof half);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_OK);
    assert_int_equal(aur_points_get_view(points)->domain, AUR_DOMAIN_CUBE);
    assert_int_equal(aur_points_get_view(points)->dimension, 1);
    assert_near(aur_points_get_view(points)->coordinates[0], 0.5, 0.0);
    aur_points_destroy(points);

    static const float pole[] = {0, 0, -1, 0.25f};
    write_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 4), }\n", pole, sizeof pole);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_OK);
    assert_int_equal(aur_points_get_view(points)->domain, AUR_DOMAIN_SPHERE);
    assert_near(aur_points_get_view(points)->weights[0], 0.25, 0.0);
    aur_points_destroy(points);
}

static void bad_arrays_are_refused(void **state) {
    (void)state;
    static const double rows[] = {0.125, 0.25, NAN, 1.0};
    static const char *const headers[] = {
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }", /* NaN */
        "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }", /* cut short */
        "{'descr': '<i8', 'fortran_order': False, 'shape': (1, 2), }",
        "{'descr': '<f8', 'shape': (1, 2), }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 2), }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999, 2), }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296), }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (0, 2), }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 0), }",
        "{'descr': '<f8', 'fortran_order': False, }",
        "",
    };
    for (size_t k = 0; k < sizeof headers / sizeof headers[0]; ++k) {
        write_npy(headers[k], rows, sizeof rows);
        aur_points *points;
        aur_error error = {0};
        assert_int_equal(aur_points_read(path, NULL, &points, &error), AUR_ERROR_FORMAT);
        assert_null(points);
    }
    aur_points *points;
    /* Points and columns count from 1, as lines do. */
    aur_error error = {0};
    write_npy(headers[0], rows, sizeof rows);
    aur_points_read(path, NULL, &points, &error);
    assert_non_null(strstr(error.message, "point 2, column 1"));
    static const double outside[] = {0.5, 0.5, 0.5, 2.0};
    write_npy(headers[0], outside, sizeof outside);
    aur_points_read(path, NULL, &points, &error);
    assert_non_null(strstr(error.message, "point 2:"));
    write_file("\x93NUMPY\x01", 8);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_ERROR_FORMAT);
    write_file("\x93NUMPY\x01\0\xff\xff{}          ", 20);
    assert_int_equal(aur_points_read(path, NULL, &points, NULL), AUR_ERROR_FORMAT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(headers_say_what_columns_are), cmocka_unit_test(the_requested_domain_decides),
        cmocka_unit_test(domains_have_names),           cmocka_unit_test(numbers_come_back),
        cmocka_unit_test(bad_text_names_its_line),      cmocka_unit_test(arrays_come_back),
        cmocka_unit_test(bad_arrays_are_refused),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    remove(path);
    return failed;
}
