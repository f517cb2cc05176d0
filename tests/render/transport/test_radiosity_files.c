/* Radiosity solutions stored in files. */
#include "radiosity_room.h"

#include "render/radiosity/solution.h"

static void saved_solutions_go_on(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    options.scramble = AUR_SCRAMBLE_OWEN;
    options.randomizations = 4;
    options.seed = 5;
    aur_radiosity *const whole = must_trace(scene, &options, 7000);
    aur_radiosity *const part = must_trace(scene, &options, 2345);
    aur_error error = {0};
    assert_int_equal(aur_radiosity_save(part, path_of("part"), &error), AUR_OK);
    aur_radiosity *loaded = NULL;
    const aur_radiosity_options two_threads = {.size = sizeof two_threads, .threads = 2};
    assert_int_equal(aur_radiosity_load(scene, path_of("part"), &two_threads, &loaded, &error), AUR_OK);
    assert_same(part, loaded);
    assert_int_equal(aur_radiosity_trace(loaded, 7000, &error), AUR_OK);
    assert_same(whole, loaded);
    assert_int_equal(aur_radiosity_trace(loaded, 6999, &error), AUR_ERROR_ARGUMENT);
    assert_non_null(strstr(error.message, "7000 paths already"));
    aur_radiosity_destroy(whole);
    aur_radiosity_destroy(part);
    aur_radiosity_destroy(loaded);
    aur_scene_destroy(scene);
}

static void expect_bad_file(const aur_scene *scene, size_t size, const char *data, const char *message) {
    aur_radiosity *loaded = NULL;
    aur_error error = {0};
    const char *const path = write_file("bad", data, size);
    const aur_result result = aur_radiosity_load(scene, path, NULL, &loaded, &error);
    if (result != AUR_ERROR_FORMAT || strstr(error.message, message) == NULL || strcmp(error.file, path) != 0)
        fail_msg("%d, %s: %s", result, error.file, error.message);
    assert_null(loaded);
}

static void damaged_files_are_refused(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM), *const other = must_load_body(FIVE_WALLS);
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    aur_radiosity *const radiosity = must_trace(scene, &options, 100);
    assert_int_equal(aur_radiosity_save(radiosity, path_of("good"), NULL), AUR_OK);
    char data[4096];
    FILE *const file = fopen(path_of("good"), "rb");
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    assert_in_range(size, 500, sizeof data - 1);
    expect_bad_file(scene, 0, data, "does not begin with");
    expect_bad_file(scene, 30, data, "head is cut");
    expect_bad_file(scene, size - 8, data, "cut short");
    expect_bad_file(scene, size + 1, data, "too long");
    expect_bad_file(other, size, data, "made for another scene");
    for (size_t at = 0; at < size; at += 7) {
        data[at] ^= 4;
        aur_radiosity *loaded = NULL;
        assert_int_not_equal(aur_radiosity_load(scene, write_file("bad", data, size), NULL, &loaded, NULL),
                             AUR_OK);
        assert_null(loaded);
        data[at] ^= 4;
    }
    aur_radiosity *loaded = NULL;
    aur_error error = {0};
    assert_int_equal(aur_radiosity_load(scene, path_of("nowhere"), NULL, &loaded, &error), AUR_ERROR_OPEN);
    assert_int_equal(aur_radiosity_save(radiosity, path_of("no-folder/file"), &error), AUR_ERROR_WRITE);
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
    aur_scene_destroy(other);
}

/* A PLY file that our reader accepts: the same triangles. */
static void meshes_are_written(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(ROOM);
    const aur_radiosity_options options = options_of(AUR_RADIOSITY_COSINE, 6);
    aur_radiosity *const radiosity = must_trace(scene, &options, 4000);
    assert_int_equal(aur_radiosity_write_ply(radiosity, path_of("room.ply"), 1.0, NULL), AUR_OK);
    aur_scene *const again =
        must_load_body("<shape type='ply'><string name='filename' value='room.ply'/></shape>");
    aur_scene_description a = {.size = sizeof a}, b = {.size = sizeof b};
    aur_scene_get_description(scene, &a, NULL);
    aur_scene_get_description(again, &b, NULL);
    assert_int_equal(b.triangles, 12);
    assert_memory_equal(a.lower, b.lower, sizeof a.lower);
    assert_memory_equal(a.upper, b.upper, sizeof a.upper);
    /* Radiance 1/2 at one stop is full white; each vertex has the radiance of its triangle. */
    char data[4096];
    FILE *const file = fopen(path_of("room.ply"), "rb");
    const size_t size = fread(data, 1, sizeof data - 1, file);
    fclose(file);
    data[size] = '\0';
    const char *const body = strstr(data, "end_header\n") + 11;
    assert_int_equal(size - (size_t)(body - data), 36 * (12 + 3 + 12) + 12 * 13);
    aur_radiosity_triangle_result results[MOST_TRIANGLES];
    get_results(radiosity, results);
    for (size_t v = 0; v < 36; ++v) {
        float radiance[3];
        memcpy(radiance, body + 27 * v + 15, sizeof radiance);
        assert_near(radiance[1], results[v / 3].radiance[1], 1e-6);
        assert_in_range((unsigned char)body[27 * v + 12], 250, 255);
    }
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(again);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(saved_solutions_go_on),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(meshes_are_written),
    };
    return cmocka_run_group_tests_name("radiosity files", tests, enter_folder, leave_folder);
}
