#include "check.h"

#include <string.h>

#include "points/base/names.h"

typedef struct row {
    int number;
    const char *name;
} row;

static const char *name_at(const void *table, size_t index) {
    const row *const rows = table;
    return rows[index].name;
}

static const row rows[] = {{1, "diffuse"}, {2, "mask"}, {3, "phong"}};
static const aur_names names = {.count = 3, .at = name_at, .table = rows};

static void finds_and_suggests(void **state) {
    (void)state;
    assert_int_equal(aur_names_find(names, "mask"), 1);
    assert_int_equal(aur_names_find(names, "mas"), 3);
    assert_string_equal(aur_names_nearest(names, "difuse"), "diffuse");
    assert_null(aur_names_nearest(names, "zzzzzz"));
    assert_null(aur_names_nearest(names, ""));
    /* Case and _ instead of - make no difference; three letters with two wrong are no typing error. */
    assert_string_equal(
        aur_names_nearest(aur_names_of(2, (const char *const[]){"cube-map", "sphere-map"}), "SPHERE_MAP"),
        "sphere-map");
    assert_null(aur_names_nearest(aur_names_of(1, (const char *const[]){"ao"}), "foo"));
    /* Words of one or two letters are other words, not slips; longer ones may be, and words may be missing.
     */
    const aur_names media = aur_names_of(3, (const char *const[]){"sigma_t", "alpha_u", "int_ior"});
    assert_null(aur_names_nearest(media, "sigma_a"));
    assert_null(aur_names_nearest(media, "sigma_s"));
    assert_null(aur_names_nearest(media, "alpha_x"));
    assert_string_equal(aur_names_nearest(media, "simga_t"), "sigma_t");
    assert_string_equal(aur_names_nearest(media, "Sigma-T"), "sigma_t");
    assert_string_equal(aur_names_nearest(media, "sigmat"), "sigma_t");
    assert_string_equal(aur_names_nearest(media, "int_iro"), "int_ior");
}

static void chooses_or_says_what_there_is(void **state) {
    (void)state;
    aur_error error;
    size_t index = 9;
    const aur_location where = {.file = "a.xml", .line = 3};
    assert_int_equal(aur_names_choose(names, "bsdf", "phong", where, &index, &error), AUR_OK);
    assert_int_equal(index, 2);
    assert_int_equal(aur_names_choose(names, "bsdf", "phnog", where, &index, &error), AUR_ERROR_NAME);
    assert_string_equal(error.message, "unknown bsdf 'phnog'; did you mean 'phong'?");
    assert_int_equal(error.line, 3);
    assert_int_equal(aur_names_choose(names, "bsdf", "glass-of-wine", where, &index, &error), AUR_ERROR_NAME);
    assert_string_equal(error.message, "unknown bsdf 'glass-of-wine'; there are: diffuse, mask, phong");
    assert_int_equal(index, 2);
}

static void sorts_by_distance(void **state) {
    (void)state;
    static const char *const keys[] = {"albedo", "phase", "sigma_t", "scale"};
    aur_sorted_names sorted;
    char text[64];
    aur_names_list(aur_names_by_distance(aur_names_of(4, keys), "sigma_a", &sorted), sizeof text, text);
    assert_string_equal(text, "sigma_t, scale, phase, albedo");
}

/* A table of any size is listed whole: earlier lists ended after 64 or 128 names. */
static void lists_long_tables(void **state) {
    (void)state;
    const char *many[200];
    for (size_t i = 0; i < 200; ++i)
        many[i] = i == 199 ? "last" : "name";
    char text[2000];
    const size_t length = aur_names_list(aur_names_of(200, many), sizeof text, text);
    assert_int_equal(length, 200 * 4 + 199 * 2);
    assert_string_equal(text + length - 10, "name, last");
    char small[8] = "xxxxxxx";
    assert_int_equal(aur_names_list(aur_names_of(200, many), sizeof small, small), length);
    assert_string_equal(small, "name, n");
    assert_int_equal(aur_names_list(aur_names_of(0, NULL), sizeof small, small), 0);
    assert_string_equal(small, "");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_and_suggests), cmocka_unit_test(chooses_or_says_what_there_is),
        cmocka_unit_test(sorts_by_distance), cmocka_unit_test(lists_long_tables)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
