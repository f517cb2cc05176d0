/* Bounds and camera distances over instances of a group are bit-identical to those over all corners, though
 * only few are visited. */
#include "scene_text.h"

#include "points/base/random.h"
#include "render/scene/load/stage.h"
#include "render/scene/scene_data.h"

enum { SIDE = 24, TRIANGLES = 2 * SIDE * SIDE, COPIES = 60, WHOLE = 8, MOST_TEXT = 1 << 16 };

static double unit(uint64_t a, uint64_t b) {
    return (double)aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

/* A bumpy patch, with its triangles in a random order, and a distant vertex that no triangle uses. */
static void write_patch(void) {
    char *const text = malloc(MOST_TEXT);
    int used = 0;
    for (size_t i = 0; i < (SIDE + 1) * (SIDE + 1); ++i)
        used += snprintf(text + used, (size_t)(MOST_TEXT - used), "v %.6f %.6f %.6f\n",
                         (double)(i % (SIDE + 1)) / SIDE - 0.3, (double)(i / (SIDE + 1)) / SIDE,
                         0.2 * unit(1, i));
    used += snprintf(text + used, (size_t)(MOST_TEXT - used), "v 90 90 90\n");
    for (size_t i = 0; i < SIDE * SIDE; ++i) {
        const size_t cell = i * 197 % (SIDE * SIDE), a = cell / SIDE * (SIDE + 1) + cell % SIDE + 1;
        used += snprintf(text + used, (size_t)(MOST_TEXT - used), "f %zu %zu %zu\nf %zu %zu %zu\n", a, a + 1,
                         a + SIDE + 2, a, a + SIDE + 2, a + SIDE + 1);
    }
    assert_in_range(used, 1, MOST_TEXT - 1);
    write_text("patch.obj", text);
    free(text);
}

/* Instances of one group, or as many groups with one instance each, which are visited completely. `turned`:
 * any transform, else they stand on a plane, rotated about z. */
static char *copies_of(const char *shapes, bool turned, bool one_group) {
    char *const text = malloc(MOST_TEXT);
    int used = 0;
    for (size_t i = 0; i < COPIES; ++i) {
        if (i == 0 || !one_group)
            used += snprintf(text + used, (size_t)(MOST_TEXT - used),
                             "<shape type='shapegroup' id='g%zu'>%s</shape>", i, shapes);
        used += snprintf(text + used, (size_t)(MOST_TEXT - used),
                         "<shape type='instance'><ref id='g%zu'/><transform name='to_world'>"
                         "<rotate x='%.4f' y='%.4f' z='1' angle='%.4f'/><scale value='%.4f'/>"
                         "<translate x='%.4f' y='%.4f' z='%.4f'/></transform></shape>",
                         one_group ? 0 : i, turned ? unit(2, i) : 0.0, turned ? unit(3, i) : 0.0,
                         360.0 * unit(4, i), turned ? unit(5, i) - 0.5 : 1.0, 3.0 * unit(6, i),
                         3.0 * unit(7, i), turned ? unit(8, i) : 0.25);
    }
    assert_in_range(used, 1, MOST_TEXT - 1);
    return text;
}

static aur_scene *must_load_staged(char *body, const char *camera) {
    const aur_scene_options options = {.size = sizeof options, .stage.camera = camera};
    aur_scene *scene = NULL;
    aur_error error = {0};
    if (load_body(body, &options, &scene, &error) != AUR_OK)
        fail_msg("%s", error.message);
    free(body);
    return scene;
}

static void test_views_are_those_of_all_corners(void **state) {
    (void)state;
    static const char *const groups[] = {
        "<shape type='obj'><string name='filename' value='patch.obj'/></shape>",
        "<shape type='obj'><string name='filename' value='patch.obj'/></shape><shape type='sphere'/>",
        "<shape type='linearcurve'><string name='filename' value='tube.txt'/></shape>",
    };
    write_patch();
    write_text("tube.txt", "0 0 0 .1\n1 0 .3 .2\n1 1 .5 .1\n\n0 0 2 .1\n0 1 2.5 .1\n");
    for (size_t i = 0; i < sizeof groups / sizeof groups[0] * 2; ++i)
        for (size_t k = 0; k < 3; ++k) {
            const char *const camera = ((const char *const[]){"iso", "top", "200,-35"})[k];
            aur_scene *const one = must_load_staged(copies_of(groups[i / 2], i % 2, true), camera);
            aur_scene *const many = must_load_staged(copies_of(groups[i / 2], i % 2, false), camera);
            assert_int_equal(one->group_count, 1);
            assert_int_equal(many->group_count, COPIES);
            assert_memory_equal(one->middle, many->middle, sizeof one->middle);
            assert_memory_equal(one->sensor.position, many->sensor.position, sizeof one->sensor.position);
            aur_scene_destroy(one);
            aur_scene_destroy(many);
        }
}

typedef struct tally {
    size_t corners;
    bool matter;
} tally;

static void count(void *user, const double point[3]) {
    ((tally *)user)->corners += isfinite(point[0]);
}

static bool all_or_none(const void *user, const aur_stage_box *box) {
    assert_true(box->sides[0][0] <= box->sides[1][0]);
    return ((const tally *)user)->matter;
}

/* Beyond the first copies only boxes are looked at where none matters, and each vertex once where all do. */
static void test_few_copies_are_walked_whole(void **state) {
    (void)state;
    write_patch();
    char *const body =
        copies_of("<shape type='obj'><string name='filename' value='patch.obj'/></shape>", true, true);
    aur_scene *const scene = must_load_uncut(body);
    free(body);
    assert_int_equal(scene->shapes[0]->mesh.triangle_count, TRIANGLES);
    const size_t whole = (size_t)WHOLE * 3 * TRIANGLES;
    tally none = {0}, all = {.matter = true};
    aur_stage_visit_points(scene, &(aur_stage_visitor){count, all_or_none, &none});
    aur_stage_visit_points(scene, &(aur_stage_visitor){count, all_or_none, &all});
    assert_int_equal(none.corners, whole);
    assert_int_equal(all.corners, whole + (size_t)(COPIES - WHOLE) * (SIDE + 1) * (SIDE + 1));
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_views_are_those_of_all_corners),
        cmocka_unit_test(test_few_copies_are_walked_whole),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
