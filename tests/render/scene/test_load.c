/* Loading of valid scenes. */
#include "scene_text.h"

#include <time.h>

static void loads_a_small_scene(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        "<integrator type=\"path\"><integer name=\"max_depth\" value=\"6\"/></integrator>"
        "<shape type=\"rectangle\"><ref id=\"red\"/></shape>"
        "<shape type='cube'><transform name='to_world'><translate z='5'/></transform></shape>"
        "<bsdf type=\"diffuse\" id=\"red\"><rgb name=\"reflectance\" value=\"0.5 0 0\"/></bsdf>");
    aur_scene_description description = {.size = sizeof description};
    aur_scene_get_description(scene, &description, NULL);
    assert_int_equal(description.shapes, 2);
    assert_int_equal(description.triangles, 14);
    assert_int_equal(description.emitters, 0);
    assert_int_equal(description.materials, 2); /* red and the default */
    assert_int_equal(description.width, 768);
    assert_int_equal(description.height, 576);
    assert_int_equal(description.samples_per_pixel, 4);
    assert_string_equal(description.integrator, "path");
    assert_string_equal(description.sampler, "random");
    assert_string_equal(description.filter, "gaussian");
    assert_near(description.lower[2], 0.0, 0.0);
    assert_near(description.upper[2], 6.0, 1e-6);
    aur_scene_destroy(scene);
}

/* A scene in memory; files are searched next to its name. */
static void loads_from_memory(void **state) {
    (void)state;
    static const char text[] =
        "<scene version='3.0.0'><sensor type='perspective'/><include filename='one.xml'/></scene>";
    char name[256];
    write_text("one.xml", "<scene version='3.0.0'><shape type='cube'/></scene>");
    snprintf(name, sizeof name, "%s/not-there.xml", scene_folder);
    aur_scene *scene;
    aur_error error;
    assert_int_equal(aur_scene_load_memory(name, sizeof text - 1, text, NULL, &scene, &error), AUR_OK);
    aur_scene_description description = {.size = sizeof description};
    assert_int_equal(aur_scene_get_description(scene, &description, &error), AUR_OK);
    assert_int_equal(description.shapes, 1);
    description.size = 0;
    assert_int_equal(aur_scene_get_description(scene, &description, &error), AUR_ERROR_ARGUMENT);
    aur_scene_destroy(scene);
    assert_int_equal(aur_scene_load_memory(name, 20, text, NULL, &scene, &error), AUR_ERROR_FORMAT);
    assert_string_equal(error.file, name);
    const aur_scene_options unset = {0};
    assert_int_equal(aur_scene_load_memory(name, sizeof text - 1, text, &unset, &scene, &error),
                     AUR_ERROR_ARGUMENT);
}

/* A shape without a bsdf is grey, a light without one is black. */
static void gives_default_materials(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load_body("<shape type='rectangle'/><shape type='rectangle'><transform name='to_world'>"
                       "<translate x='5'/></transform><emitter type='area'/></shape>");
    static const double expected[2] = {0.5, 0.0};
    for (size_t i = 0; i < 2; ++i) {
        const aur_ray ray = {{5.0f * (float)i, 0.0f, 1.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, INFINITY};
        aur_hit hit;
        aur_surface surface;
        assert_true(aur_scene_intersect(scene, &ray, &hit));
        aur_scene_surface(scene, &ray, &hit, &surface);
        const aur_vector albedo =
            surface.bsdf->descriptor->diffuse_albedo(surface.bsdf, surface.texture, 1.0f);
        assert_near(albedo.x, expected[i], 0.0);
    }
    aur_scene_destroy(scene);
}

static void maps_samplers_to_sets(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {"<sampler type='independent'><integer name='sample_count' value='9'/></sampler>", "random"},
        {"<sampler type='multijitter'/>", "sobol"},
        {"<sampler type='ldsampler'><integer name='dimension' value='4'/></sampler>", "sobol"},
        {"<sampler type='halton'><string name='permute' value='random'/></sampler>", "halton:permute=random"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char text[512];
        snprintf(text, sizeof text, "<scene version='3.0.0'><sensor type='perspective'>%s</sensor></scene>",
                 rows[i][0]);
        aur_scene *scene;
        assert_int_equal(aur_scene_load(write_text("s.xml", text), NULL, &scene, NULL), AUR_OK);
        assert_string_equal(aur_scene_sampler(scene), rows[i][1]);
        assert_int_equal(aur_scene_samples_per_pixel(scene), i == 0 ? 9 : 4);
        aur_scene_destroy(scene);
    }
}

/* Emitters, samplers, films and filters at scene level are used where something refers to them. */
static void refers_to_parts(void **state) {
    (void)state;
    static const char text[] =
        "<scene version='3.0.0'><integrator type='moment'><integrator type='path' name='inner'/></integrator>"
        "<sampler type='multijitter' id='s'><integer name='sample_count' value='25'/></sampler>"
        "<sampler type='halton' id='unused'/><film type='hdrfilm' id='f'><integer name='width' value='7'/>"
        "<ref id='box'/></film><rfilter type='box' id='box'/><emitter type='area' id='lamp'/>"
        "<sensor type='perspective'><float name='focus_distance' value='2'/><ref id='s'/><ref "
        "id='f'/></sensor>"
        "<shape type='sphere'><ref id='lamp'/></shape></scene>";
    aur_scene *scene;
    aur_error error = {0};
    assert_int_equal(aur_scene_load(write_text("parts.xml", text), NULL, &scene, &error), AUR_OK);
    aur_scene_description description = {.size = sizeof description};
    aur_scene_get_description(scene, &description, NULL);
    assert_string_equal(description.integrator, "path");
    assert_string_equal(description.sampler, "sobol");
    assert_string_equal(description.filter, "box");
    assert_int_equal(description.samples_per_pixel, 25);
    assert_int_equal(description.width, 7);
    assert_int_equal(description.emitters, 1);
    aur_scene_destroy(scene);
}

static void substitutes_names(void **state) {
    (void)state;
    static const char body[] =
        "<default name='res' value='32'/><default name='resx' value='64'/><default name='f' value='tent'/>"
        "<sensor type='perspective'><film type='hdrfilm'><integer name='width' value='$resx'/>"
        "<integer name='height' value='$res'/><rfilter type='$f'/></film>"
        "<sampler type='sobol'><integer name='sample_count' value='$n'/></sampler></sensor>";
    const aur_definition definitions[] = {{"n", "16"}, {"res", "48"}};
    const aur_scene_options options = {
        .size = sizeof options, .definition_count = 2, .definitions = definitions};
    aur_scene *scene;
    aur_error error;
    char text[1024];
    snprintf(text, sizeof text, "<scene version='3.0.0'>%s</scene>", body);
    const char *const path = write_text("s.xml", text);
    assert_int_equal(aur_scene_load(path, &options, &scene, &error), AUR_OK);
    assert_int_equal(aur_scene_film(scene)->width, 64);
    assert_int_equal(aur_scene_film(scene)->height, 48);
    assert_string_equal(aur_filter_name(aur_scene_film(scene)->filter), "tent");
    assert_int_equal(aur_scene_samples_per_pixel(scene), 16);
    aur_scene_destroy(scene);

    const aur_definition unused[] = {{"n", "16"}, {"rex", "1"}};
    const aur_scene_options wrong = {.size = sizeof wrong, .definition_count = 2, .definitions = unused};
    assert_int_equal(aur_scene_load(path, &wrong, &scene, &error), AUR_ERROR_NAME);
    assert_non_null(strstr(error.message, "did you mean 'res"));
    assert_int_equal(aur_scene_load(path, NULL, &scene, &error), AUR_ERROR_NAME);
    assert_non_null(strstr(error.message, "$n is not defined"));
}

static void includes_files(void **state) {
    (void)state;
    write_text("walls.xml", "<scene version='3.0.0'><shape type='rectangle'><ref id='w'/></shape></scene>");
    write_text("white.xml", "<bsdf type='diffuse' id='w'/>");
    aur_scene *const scene =
        must_load_body("<include filename='walls.xml'/><include filename='white.xml'/>"
                       "<alias id='w' as='again'/><shape type='cube'><ref id='again'/></shape>");
    aur_scene_description description = {.size = sizeof description};
    aur_scene_get_description(scene, &description, NULL);
    assert_int_equal(description.shapes, 2);
    assert_int_equal(description.materials, 1);
    aur_scene_destroy(scene);

    write_text("itself.xml", "<scene version='3.0.0'><include filename='itself.xml'/></scene>");
    aur_error error;
    aur_scene *none;
    assert_int_equal(load_body("<include filename='itself.xml'/>", NULL, &none, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "nested deeper than 15"));
    assert_non_null(strstr(error.file, "itself.xml"));
}

/* Files of a scene are searched next to it, and must be regular files. */
static void finds_files_next_to_the_scene(void **state) {
    (void)state;
    write_text("own.csv", "x,y\n0.25,0.5\n0.75,0.5\n");
    char text[1024], expected[512];
    snprintf(
        text, sizeof text,
        "<scene version='3.0.0'><integrator type='finalgather'><string name='pattern' value='file:own.csv'/>"
        "<string name='photon_pattern' value='matrices:file=own.csv,skip=1'/></integrator>"
        "<sensor type='perspective'><sampler type='file:own.csv'/></sensor></scene>");
    aur_scene *scene;
    assert_int_equal(aur_scene_load(write_text("s.xml", text), NULL, &scene, NULL), AUR_OK);
    snprintf(expected, sizeof expected, "file:%s/own.csv", scene_folder);
    assert_string_equal(aur_scene_sampler(scene), expected);
    const aur_parameters *const integrator = aur_scene_integrator(scene);
    assert_string_equal(integrator->items[0].text, expected);
    snprintf(expected, sizeof expected, "matrices:file=%s/own.csv,skip=1", scene_folder);
    assert_string_equal(integrator->items[1].text, expected);
    aur_scene_destroy(scene);
    static const char *const rows[][2] = {
        {"<shape type='obj'><string name='filename' value='/dev/zero'/></shape>",
         "'/dev/zero' is not a regular file"},
        {"<shape type='ply'><string name='filename' value='.'/></shape>", "'.' is not a regular file"},
        {"<integrator type='finalgather'><string name='pattern' value='file:none.csv'/></integrator>",
         "cannot find 'none.csv'; looked in"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_error error = {0};
        assert_int_equal(load_body(rows[i][0], NULL, &scene, &error), AUR_ERROR_OPEN);
        assert_non_null(strstr(error.message, rows[i][1]));
    }
}

static void store_warning(void *user, const char *message) {
    char *const text = user;
    strncat(text, message, 4000 - strlen(text));
    strncat(text, "\n", 4000 - strlen(text));
}

static void reads_old_versions(void **state) {
    (void)state;
    char warnings[4096] = "";
    const aur_scene_options options = {.size = sizeof options, .warnings = {store_warning, warnings}};
    aur_scene *scene;
    aur_error error;
    assert_int_equal(
        aur_scene_load(
            write_text("old.xml",
                       "<scene version='0.5.0'><integrator type='path'><integer name='maxDepth' value='3'/>"
                       "</integrator><sensor type='perspective'><transform name='toWorld'>"
                       "<lookAt origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>"
                       "<float name='nearClip' value='1'/><film type='ldrfilm'>"
                       "<boolean name='banner' value='false'/></film></sensor></scene>"),
            &options, &scene, &error),
        AUR_OK);
    assert_non_null(strstr(warnings, "ldrfilm"));
    assert_non_null(strstr(warnings, "banner"));
    aur_parameters integrator;
    assert_int_equal(aur_parameters_copy(aur_scene_integrator(scene), &integrator, NULL), AUR_OK);
    assert_string_equal(aur_parameters_find(&integrator, "max_depth")->text, "3");
    aur_parameters_release(&integrator);
    aur_scene_destroy(scene);
}

/* The time of a load, in seconds, of `count` copies of a text between a head and a tail. */
static double seconds_to_load(const char *head, const char *format, size_t count, const char *tail) {
    char *const text = malloc(strlen(head) + count * 96 + strlen(tail) + 1);
    char *end = stpcpy(text, head);
    for (size_t i = 0; i < count; ++i)
        end += sprintf(end, format, count - i, count - i - 1);
    strcpy(end, tail);
    struct timespec from, to;
    clock_gettime(CLOCK_MONOTONIC, &from);
    aur_scene_destroy(must_load_body(text));
    clock_gettime(CLOCK_MONOTONIC, &to);
    free(text);
    return (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
}

/* These took the square of their number: 48 and more than 20 seconds at these sizes. */
static void loads_many_objects_in_time(void **state) {
    (void)state;
    assert_true(
        seconds_to_load("", "<alias as='a%zu' id='a%zu'/>\n", 20000, "<bsdf type='diffuse' id='a0'/>") < 5.0);
    assert_true(seconds_to_load("<shape type='shapegroup'>",
                                "<shape type='sphere'><point name='center' value='%zu %zu 0'/></shape>\n",
                                30000, "</shape>") < 10.0);
}

static void loads_bundled_scenes(void **state) {
    (void)state;
    static const char *const names[] = {"cornell-box.xml", "glossy.xml"};
    for (size_t i = 0; i < 2; ++i) {
        char path[512];
        snprintf(path, sizeof path, "%s/scenes/cornell-box/%s", AUR_SOURCE_DIR, names[i]);
        aur_scene *scene;
        aur_error error = {0};
        if (aur_scene_load(path, NULL, &scene, &error) != AUR_OK)
            fail_msg("%s:%zu:%zu: %s", error.file, error.line, error.column, error.message);
        assert_int_equal(aur_scene_emitter_count(scene), 1);
        aur_scene_destroy(scene);
    }
}

/* Public scenes in the project's parent folder, if present. */
static void loads_public_scenes(void **state) {
    (void)state;
    const char *const path = AUR_SOURCE_DIR "/../shared/scenes/cornell-box/scene.xml";
    if (access(path, R_OK) != 0)
        skip();
    aur_scene *scene;
    aur_error error = {0};
    if (aur_scene_load(path, NULL, &scene, &error) != AUR_OK)
        fail_msg("%s", error.message);
    aur_scene_description description = {.size = sizeof description};
    aur_scene_get_description(scene, &description, NULL);
    assert_int_equal(description.shapes, 8);
    assert_int_equal(description.triangles,
                     32); /* of 36: the boxes' undersides lie in the floor, which comes first */
    assert_int_equal(description.emitters, 1);
    assert_int_equal(description.width, 1024);
    assert_int_equal(description.samples_per_pixel, 64);
    assert_string_equal(description.filter, "tent");
    assert_string_equal(description.integrator, "path_guiding_integrator");
    aur_scene_destroy(scene);
}

/* Colours of vertices are interpolated, and a polygon's triangles all have its colour: bytes count by 255. */
static void reads_colors_of_meshes(void **state) {
    (void)state;
    write_text("c.ply", "ply\nformat ascii 1.0\nelement face 2\nproperty uchar red\nproperty uchar green\n"
                        "property uchar blue\nproperty list uchar int vertex_indices\nelement vertex 5\n"
                        "property float x\nproperty float y\nproperty float z\nproperty float r\n"
                        "property float g\nproperty float b\nend_header\n"
                        "255 51 0 4 0 1 2 3\n0 0 255 3 0 1 4\n"
                        "0 0 0 1 0 0\n1 0 0 0 1 0\n1 1 0 0 0 1\n0 1 0 0.5 0.5 0.5\n0 0 1 1 1 1\n");
    write_text("c.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 2\nf 1 2 3\n");
    aur_scene *const scene = must_load_body(
        "<shape type='ply'><string name='filename' value='c.ply'/>"
        "<bsdf type='roughplastic'><texture type='mesh_attribute' name='diffuse_reflectance'>"
        "<string name='name' value='face_color'/></texture><texture type='mesh_attribute' "
        "name='specular_reflectance'><string name='name' value='vertex_color'/></texture></bsdf></shape>"
        "<shape type='obj'><string name='filename' value='c.obj'/><transform name='to_world'>"
        "<translate z='2'/></transform><bsdf type='diffuse'>"
        "<texture type='mesh_attribute' name='reflectance'><string name='name' value='vertex_color'/>"
        "</texture></bsdf></shape>");
    static const double faces[3][3] = {{1.0, 0.2, 0.0}, {1.0, 0.2, 0.0}, {0.0, 0.0, 1.0}};
    assert_int_equal(aur_scene_shape_triangles(scene, 0), 3);
    aur_triangle triangle;
    for (size_t i = 0; i < 3; ++i) {
        aur_scene_triangle(scene, 0, i, &triangle);
        const aur_vector color = triangle.texture[1].face_color;
        assert_near(color.x, faces[i][0], 1e-7);
        assert_near(color.y, faces[i][1], 1e-7);
        assert_near(color.z, faces[i][2], 1e-7);
    }
    aur_scene_triangle(scene, 0, 0, &triangle); /* corners 0, 2, 3 */
    assert_near(triangle.texture[0].vertex_color.x, 1.0, 0.0);
    assert_near(triangle.texture[1].vertex_color.z, 1.0, 0.0);
    assert_near(triangle.texture[2].vertex_color.y, 0.5, 0.0);
    aur_scene_triangle(scene, 1, 0, &triangle); /* the third vertex has a weight and no colour: white */
    assert_near(triangle.texture[1].vertex_color.y, 1.0, 0.0);
    assert_near(triangle.texture[1].vertex_color.x, 0.0, 0.0);
    assert_near(triangle.texture[2].vertex_color.x, 1.0, 0.0);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_a_small_scene),     cmocka_unit_test(loads_from_memory),
        cmocka_unit_test(gives_default_materials), cmocka_unit_test(maps_samplers_to_sets),
        cmocka_unit_test(refers_to_parts),         cmocka_unit_test(substitutes_names),
        cmocka_unit_test(includes_files),          cmocka_unit_test(finds_files_next_to_the_scene),
        cmocka_unit_test(reads_old_versions),      cmocka_unit_test(loads_many_objects_in_time),
        cmocka_unit_test(loads_bundled_scenes),    cmocka_unit_test(loads_public_scenes),
        cmocka_unit_test(reads_colors_of_meshes),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
