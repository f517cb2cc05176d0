/* Reading and writing must not depend on the host's locale: with decimal commas, points lost their columns
 * and scenes did not load. */
#include "check.h"

#include <aureole-render/render.h>
#include <aureole/quadrature.h>
#include <aureole/quality.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "points/base/file.h"
#include "points/base/text.h"
#include "render/image/format.h"

static void write_text(const char *path, const char *text) {
    assert_int_equal(aur_file_write(path, strlen(text), text, NULL), AUR_OK);
}

static bool file_contains(const char *path, const char *text) {
    char *data;
    size_t size;
    assert_int_equal(aur_file_read(path, 1 << 20, &data, &size, NULL), AUR_OK);
    const bool found = strstr(data, text) != NULL;
    free(data);
    return found;
}

static void reads_and_writes_numbers(void **state) {
    (void)state;
    if (localeconv()->decimal_point[0] != ',')
        skip();
    char text[64];
    snprintf(text, sizeof text, "%g", 0.5);
    assert_string_equal(text, "0,5"); /* the locale has decimal commas */
    assert_int_equal(aur_format(text, sizeof text, "%g %.17g", 0.5, 0.1), 23);
    assert_string_equal(text, "0.5 0.10000000000000001");
    double value;
    assert_true(aur_parse_double("123456789012345678901234.5e-30", &value));
    assert_true(value == 1.234567890123456789012345e-7);
    assert_false(aur_parse_double("0,5", &value));
    aur_error error;
    aur_fail(&error, AUR_ERROR_ARGUMENT, "not %g", 0.25);
    assert_string_equal(error.message, "not 0.25");
    snprintf(text, sizeof text, "%g", 0.5);
    assert_string_equal(text, "0,5"); /* the host's locale is as it was */
}

static void writes_and_reads_points(void **state) {
    (void)state;
    aur_error error = {0};
    double coordinates[] = {0.5, 0.25, 0.125, 0.75};
    double weights[] = {1.5, 0.5};
    const aur_points_view points = {.size = sizeof points,
                                    .domain = AUR_DOMAIN_SQUARE,
                                    .count = 2,
                                    .dimension = 2,
                                    .coordinates = coordinates,
                                    .weights = weights};
    assert_int_equal(aur_points_write("points.csv", AUR_POINTS_CSV, &points, NULL, &error), AUR_OK);
    assert_true(file_contains("points.csv", "u,v,w\n0.5,0.25,1.5\n0.125,0.75,0.5\n"));
    assert_int_equal(aur_points_write("points.json", AUR_POINTS_JSON, &points, NULL, &error), AUR_OK);
    assert_true(file_contains("points.json", "[0.5, 0.25]"));
    aur_points *read;
    assert_int_equal(aur_points_read("points.csv", NULL, &read, &error), AUR_OK);
    assert_memory_equal(aur_points_get_view(read)->coordinates, coordinates, sizeof coordinates);
    assert_memory_equal(aur_points_get_view(read)->weights, weights, sizeof weights);
    aur_points_destroy(read);
    assert_int_equal(aur_weights_write("weights.csv", AUR_DOMAIN_SPHERE, 1, (const double[]){0.0, 0.6, 0.8},
                                       1, weights, &error),
                     AUR_OK);
    assert_true(file_contains("weights.csv", "0,0.59999999999999998,0.80000000000000004,1.5\n"));
}

static void reads_keys_of_sets(void **state) {
    (void)state;
    aur_error error = {0};
    aur_pointset *set;
    assert_int_equal(
        aur_pointset_create("fibonacci-lattice:offset=0.5",
                            &(aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 8}, &set,
                            &error),
        AUR_OK);
    aur_pointset_destroy(set);
    assert_int_equal(
        aur_pointset_create("fibonacci-lattice:offset=1.5",
                            &(aur_pointset_options){.size = sizeof(aur_pointset_options), .count = 8}, &set,
                            &error),
        AUR_ERROR_FORMAT);
    assert_null(strstr(error.message, "0,"));
}

static void saves_and_loads_weight_tables(void **state) {
    (void)state;
    aur_error error = {0};
    const aur_oswa_options options = {.size = sizeof(aur_oswa_options),
                                      .count = 4,
                                      .mirror_count = 4,
                                      .lobe = {.exponent = 1},
                                      .mirror_lobe = {.exponent = 7.5}};
    aur_weight_table *table;
    assert_int_equal(aur_weight_table_build(&options,
                                            &(aur_weight_table_grid){sizeof(aur_weight_table_grid), 2, 1, 1},
                                            1, NULL, &table, &error),
                     AUR_OK);
    assert_int_equal(aur_weight_table_save(table, "table.wt", &error), AUR_OK);
    aur_weight_table_destroy(table);
    assert_true(file_contains("table.wt", "mirror_exponent 7.5\n"));
    assert_int_equal(aur_weight_table_load("table.wt", &options, &table, &error), AUR_OK);
    aur_weight_table_destroy(table);
}

static void loads_scenes_with_meshes(void **state) {
    (void)state;
    write_text("mesh.obj", "v 0.5 0.25 1e-1\nv 1.5 0.25 0.1\nv 0.5 1.25 0.1\nf 1 2 3\n");
    write_text("mesh.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
               "0.5 0.25 0.1\n1.5 0.25 0.1\n0.5 1.25 0.1\n3 0 1 2\n");
    write_text("scene.xml",
               "<scene version='3.0.0'>\n"
               "<sensor type='perspective'><string name='focal_length' value='50.5mm'/>\n"
               "<transform name='to_world'><lookat origin='0.5, 0.5, 3' target='0.5 0.5 0.0' up='0 1 0'/>\n"
               "<rotate z='1' angle='0.5'/></transform></sensor>\n"
               "<shape type='obj'><string name='filename' value='mesh.obj'/></shape>\n"
               "<shape type='ply'><string name='filename' value='mesh.ply'/></shape>\n"
               "<shape type='sphere'><point name='center' x='0.5' y='0.5' z='0.5'/>\n"
               "<float name='radius' value='0.25'/><bsdf type='diffuse'><rgb name='reflectance' "
               "value='0.5, 0.25, 0.125'/></bsdf></shape>\n"
               "</scene>\n");
    aur_error error = {0};
    aur_scene *scene;
    const aur_result result = aur_scene_load("scene.xml", NULL, &scene, &error);
    if (result != AUR_OK)
        fail_msg("%s:%zu: %s", error.file, error.line, error.message);
    aur_scene_destroy(scene);
}

static void reads_float_maps(void **state) {
    (void)state;
    write_text("image.pfm", "Pf\n1 1\n-0.5\nabcd");
    aur_error error = {0};
    aur_image *image;
    assert_int_equal(aur_image_read("image.pfm", &image, &error), AUR_OK);
    aur_image_destroy(image);
}

/* C.UTF-8 is the only locale sure to be installed, so one is compiled here, if the sources of the C library's
 * locales are there. */
static bool enter_comma_locale(void) {
    if (system("mkdir -p locales && "
               "localedef -i de_DE -f UTF-8 locales/de_DE.UTF-8 >localedef.log 2>&1") < 0)
        return false;
    setenv("LOCPATH", "locales", 1);
    return setlocale(LC_ALL, "de_DE.UTF-8") != NULL && localeconv()->decimal_point[0] == ',';
}

static int enter(void **state) {
    (void)state;
    static char folder[] = "/tmp/aureole-test-XXXXXX";
    if (mkdtemp(folder) == NULL || chdir(folder) != 0)
        return 1;
    /* Without the locale the tests pass silently. */
    if (!enter_comma_locale())
        print_message("no locale with decimal commas can be had: nothing is tested\n");
    return 0;
}

static int leave(void **state) {
    (void)state;
    char folder[64], command[96];
    if (getcwd(folder, sizeof folder) == NULL)
        return 1;
    snprintf(command, sizeof command, "cd / && rm -r '%s'", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_and_writes_numbers), cmocka_unit_test(writes_and_reads_points),
        cmocka_unit_test(reads_keys_of_sets),       cmocka_unit_test(saves_and_loads_weight_tables),
        cmocka_unit_test(loads_scenes_with_meshes), cmocka_unit_test(reads_float_maps),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
