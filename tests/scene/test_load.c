#include "scene_text.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>

static void loads_a_small_scene(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        "<integrator type=\"path\"><integer name=\"max_depth\" value=\"6\"/></integrator>"
        "<shape type=\"rectangle\"><ref id=\"red\"/></shape>"
        "<shape type='cube'><transform name='to_world'><translate z='5'/></transform></shape>"
        "<bsdf type=\"diffuse\" id=\"red\"><rgb name=\"reflectance\" value=\"0.5 0 0\"/></bsdf>");
    aur_scene_description description = {.size = sizeof description};
    aur_scene_describe(scene, &description, NULL);
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

/* A scene in memory; files are looked for beside its name. */
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
    assert_int_equal(aur_scene_describe(scene, &description, &error), AUR_OK);
    assert_int_equal(description.shapes, 1);
    description.size = 0;
    assert_int_equal(aur_scene_describe(scene, &description, &error), AUR_ERROR_ARGUMENT);
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
    aur_scene_describe(scene, &description, NULL);
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
    aur_scene_describe(scene, &description, NULL);
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

/* Small files that would become large scenes: 10 includes of the next file in each of 14, and values that
 * double. */
static void ends_growth(void **state) {
    (void)state;
    char name[32], text[2048];
    for (size_t i = 0; i < 14; ++i) {
        strcpy(text, "<scene version='3.0.0'>");
        for (size_t k = 0; k < 10; ++k)
            sprintf(text + strlen(text), "<include filename='level%zu.xml'/>", i + 1);
        sprintf(name, "level%zu.xml", i);
        write_text(name, strcat(text, "</scene>"));
    }
    write_text("level14.xml", "<scene version='3.0.0'/>");
    aur_error error;
    aur_scene *none;
    assert_int_equal(load_body("<include filename='level0.xml'/>", NULL, &none, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "more than 10000 files"));
    char *const body = malloc(1 << 16);
    char *end = stpcpy(body, "<default name='v00' value='0123456789abcdef'/>");
    for (size_t i = 0; i < 19; ++i)
        end += sprintf(end, "<default name='v%02zu' value='$v%02zu$v%02zu'/>", i + 1, i, i);
    for (size_t i = 0; i < 100; ++i)
        end += sprintf(end, "<bsdf type='diffuse' id='$v19'/>");
    assert_int_equal(load_body(body, NULL, &none, &error), AUR_ERROR_FORMAT);
    assert_non_null(strstr(error.message, "$names make the scene more than 67108864 bytes longer"));
    free(body);
}

/* What a scene reads is looked for beside it, and is a regular file. */
static void finds_files_beside_the_scene(void **state) {
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
         "'/dev/zero' is no regular file"},
        {"<shape type='ply'><string name='filename' value='.'/></shape>", "'.' is no regular file"},
        {"<integrator type='finalgather'><string name='pattern' value='file:none.csv'/></integrator>",
         "cannot find 'none.csv'; looked in"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_error error = {0};
        assert_int_equal(load_body(rows[i][0], NULL, &scene, &error), AUR_ERROR_OPEN);
        assert_non_null(strstr(error.message, rows[i][1]));
    }
}

static void keep_warning(void *user, const char *message) {
    char *const text = user;
    strncat(text, message, 4000 - strlen(text));
    strncat(text, "\n", 4000 - strlen(text));
}

static void reads_old_versions(void **state) {
    (void)state;
    char warnings[4096] = "";
    const aur_scene_options options = {.size = sizeof options, .warnings = {keep_warning, warnings}};
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

/* What a file may get wrong: the body, where it is (line, column of scene.xml, whose second line the body
 * is), and a part of the message. */
static const struct bad_row {
    const char *body;
    size_t line, column;
    const char *message;
} bad_rows[] = {
    {"<shape type=\"rectangle\">", 3, 69, "not well-formed XML: mismatched tag"},
    {"<shap type=\"cube\"/>", 2, 1, "unknown element <shap>; did you mean <shape>?"},
    {"<shape type=\"cub\"/>", 2, 1, "unknown shape 'cub'; did you mean 'cube'?"},
    {"<shape type=\"zzzzzz\"/>", 2, 1, "unknown shape 'zzzzzz'; there are: "},
    {"<shape/>", 2, 1, "<shape> needs the attribute 'type'"},
    {"<shape type='cube' idd='x'/>", 2, 1, "<shape> has no attribute 'idd'; did you mean 'id'?"},
    {"<shape type='cube'><bsdf type='difuse'/></shape>", 2, 20,
     "unknown bsdf 'difuse'; did you mean 'diffuse'?"},
    {"<bsdf type='diffuse'><rgb name='reflectence' value='1'/></bsdf>", 2, 22,
     "bsdf 'diffuse' has no 'reflectence'; did you mean 'reflectance'?"},
    {"<bsdf type='diffuse'><rgb name='reflectance' value='1.5'/></bsdf>", 2, 22,
     "'reflectance' must be between 0 and 1, not '1.5'"},
    {"<bsdf type='diffuse'><rgb name='reflectance' value='1 0'/></bsdf>", 2, 22,
     "must be one or three numbers"},
    {"<bsdf type='diffuse'><rgb name='reflectance' value='nan'/></bsdf>", 2, 22,
     "must be one or three numbers"},
    {"<bsdf type='phong'><rgb name='diffuse_reflectance' value='.7'/><rgb name='specular_reflectance' "
     "value='.4'/></bsdf>",
     2, 1, "must not exceed 1"},
    {"<bsdf type='twosided'/>", 2, 1, "needs one or two nested bsdfs"},
    {"<bsdf type='diffuse' id='a'/>\n<bsdf type='diffuse' id='a'/>", 3, 1, "id 'a' is given twice, first at"},
    {"<shape type='cube'><ref id='nix'/></shape>", 2, 20, "there is no object with the id 'nix'"},
    {"<bsdf type='diffuse' id='white'/><shape type='cube'><ref id='whte'/></shape>", 2, 53,
     "did you mean 'white'?"},
    {"<bsdf type='twosided' id='a'><ref id='b'/></bsdf><bsdf type='twosided' id='b'><ref id='a'/></bsdf>", 2,
     79, "a cycle"},
    {"<shape type='cube'><transform name='to_world'><scale value='0'/></transform></shape>", 2, 47,
     "<scale> by 0"},
    {"<shape type='cube'><transform name='to_world'><rotate angle='3'/></transform></shape>", 2, 47,
     "needs 'value' or 'x', 'y' and 'z'"},
    {"<shape type='cube'><transform name='to_world'><rotate angle='3' value='0 0 0'/></transform></shape>", 2,
     47, "needs an axis"},
    {"<shape type='cube'><transform name='to_world'><rotat angle='3' x='1'/></transform></shape>", 2, 47,
     "did you mean <rotate>?"},
    {"<shape type='cube'><transform name='to_world'><matrix value='1 2 3'/></transform></shape>", 2, 47,
     "must be 16 numbers"},
    {"<shape type='cube'><transform name='to_world'><matrix value='0 0 0 0 0 0 0 0 0'/></transform></shape>",
     2, 20, "no inverse"},
    {"<shape type='cube'><transform name='to_world'><lookat origin='1 1 1' target='1 1 "
     "1'/></transform></shape>",
     2, 47, "'target' must differ"},
    {"<shape type='cube'><point name='center' x='0' value='1 2 3'/></shape>", 2, 20, "not both"},
    {"<shape type='cube'><float name='radius'/></shape>", 2, 20, "<float> needs the attribute 'value'"},
    {"<shape type='cube'><boolean name='flip_normals' value='yes'/></shape>", 2, 20, "must be true or false"},
    {"<shape type='obj'/>", 2, 1, "needs the string 'filename'"},
    {"<shape type='obj'><string name='filename' value='none.obj'/></shape>", 2, 19,
     "cannot find 'none.obj'; looked in"},
    /* objects and values that are called by the name of another kind */
    {"<shape type='sphere'><texture type='checkerboard' name='bsdf'/></shape>", 2, 22,
     "shape 'sphere': 'bsdf' must be a <bsdf>"},
    {"<shape type='sphere'><texture type='checkerboard' name='emitter'/></shape>", 2, 22,
     "'emitter' must be a <emitter>"},
    {"<shape type='sphere'><float name='bsdf' value='1'/></shape>", 2, 22, "'bsdf' must be a <bsdf>"},
    {"<shape type='instance'><texture type='checkerboard' name='shape'/></shape>", 2, 24,
     "'shape' must be a <shape>"},
    {"<sensor type='perspective'><film type='hdrfilm'><texture type='checkerboard' "
     "name='rfilter'/></film></sensor>",
     2, 49, "'rfilter' must be a <rfilter>"},
    {"<sensor type='perspective'><texture type='checkerboard' name='film'/></sensor>", 2, 28,
     "'film' must be a <film>"},
    {"<sensor type='perspective'><sampler type='sobol'><integer name='sample_count' "
     "value='1073741825'/></sampler></sensor>",
     2, 50, "'sample_count' must be between 1 and 1073741824"},
    {"<shape type='shapegroup'><shape type='shapegroup'><shape type='cube'/></shape></shape>", 2, 26,
     "no instances or other groups"},
    {"<shape type='shapegroup' id='a'><shape type='cube' id='c'/></shape><shape "
     "type='shapegroup'><ref id='c'/></shape>",
     2, 93, "takes shapes of its own"},
    {"<shape type='shapegroup'><bsdf type='diffuse'/></shape>", 2, 1, "needs a shape"},
    /* maps and places with which Embree would end the process */
    {"<shape type='disk'><transform name='to_world'><scale value='1e13'/></transform></shape>", 2, 1,
     "shape 'disk': 'to_world' must move by at most 1e+12, and scale by 1e-12 to 1e+12"},
    {"<sensor type='perspective'><transform name='to_world'><lookat origin='1e20,1e20,1e20' target='0,0,1' "
     "up='0,1,0'/></transform></sensor>",
     2, 1, "sensor 'perspective': 'to_world' must move"},
    {"<sensor type='perspective'><transform name='to_world'><scale value='1e-38'/></transform></sensor>", 2,
     1, "sensor 'perspective': 'to_world' must move"},
    {"<sensor type='orthographic'><transform name='to_world'><scale value='1e18'/></transform></sensor>", 2,
     1, "'to_world' must move"},
    {"<sensor type='thinlens'><float name='aperture_radius' value='1e20'/></sensor>", 2, 25,
     "'aperture_radius' must be between"},
    {"<shape type='shapegroup' id='g'><shape type='cube'/></shape>\n<shape type='instance'><ref "
     "id='g'/><transform name='to_world'><scale value='1e-38'/></transform></shape>",
     3, 1, "shape 'instance': 'to_world' must move"},
    {"<shape type='shapegroup' id='g'><shape type='cube'/></shape><shape type='sphere'><float name='radius' "
     "value='1e9'/></shape>\n<shape type='instance'><ref id='g'/><transform name='to_world'><scale "
     "value='1e-10'/></transform></shape>",
     3, 1, "'to_world' shrinks too much"},
    {"<shape type='cube'/><shape type='sphere'><float name='radius' value='1e12'/><point name='center' "
     "x='1e12'/></shape>",
     2, 21, "shape 'sphere' reaches to 2e+12 from the origin"},
    {"<emitter type='point'><point name='position' x='1e12'/><transform name='to_world'><scale "
     "value='2'/></transform></emitter>",
     2, 1, "must be within 1e+12 of the origin"},
    {"<emitter type='directional'><vector name='direction' x='1e-13'/></emitter>", 2, 1, "nor nearly so"},
    {"<emitter type='area'/>", 2, 1, "must stand inside a <shape>"},
    {"<shape type='cube'><emitter type='area'><rgb name='radiance' value='-1'/></emitter></shape>", 2, 41,
     "must be between 0"},
    {"<medium type='homogenous'/>", 2, 1, "did you mean 'homogeneous'"},
    {"<medium type='homogeneous'><float name='albedo' value='1.5'/></medium>", 2, 28,
     "a number, a colour or a <volume>, from 0 to 1, not '1.5'"},
    {"<medium type='homogeneous'><phase type='hg'/><phase type='hg'/></medium>", 2, 46, "has no 'phase2'"},
    {"<medium type='homogeneous'><volume type='constvolume' name='sigma_t'><float name='value' "
     "value='1e30'/></volume><float name='scale' value='2'/></medium>",
     2, 1, "at most 1e30"},
    {"<shape type='cube'><medium type='homogeneous'/></shape>", 2, 20, "needs a 'name'"},
    {"<shape type='cube'><medium name='inside' type='homogeneous'/></shape>", 2, 20, "has no 'inside'"},
    {"<shape type='cube'><bsdf name='interior' type='diffuse'/><float name='interior' value='1'/></shape>", 2,
     58, "'interior' must be a <medium>"},
    {"<film type='hdrfilm'/>", 2, 1, "belongs inside a <sensor>"},
    {"<shape type='instance'/>", 2, 1, "needs a reference to a shapegroup"},
    {"<shape type='shapegroup'/>", 2, 1, "needs a shape"},
    {"<shape type='shapegroup'><shape type='cube'><emitter type='area'/></shape></shape>", 2, 26,
     "cannot be a light"},
    {"hello", 2, 1, "text between elements: 'hello'"},
    {"<include filename=''/>", 2, 1, "a file name is empty"},
    {"<shape type='obj'><string name='filename' value=''/></shape>", 2, 19, "a file name is empty"},
    {"<include filename='no.xml'/>", 2, 1, "cannot find 'no.xml'"},
    {"<default name='a'/>", 2, 1, "<default> needs the attribute 'value'"},
    {"<shape type='$kind'/>", 2, 1, "$kind is not defined: give it a <default>, or a value by -D kind=..."},
    {"<alias id='q' as='r'/>", 2, 1, "there is no id 'q'"},
    {"<bsdf type='diffuse'><texture type='checkerbord' name='reflectance'/></bsdf>", 2, 22,
     "unknown texture"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' value='400:0.1, 300:0.2'/></bsdf>", 2, 22,
     "must increase, but 300 nm comes after 400 nm"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' value='400:0.1'/></bsdf>", 2, 22,
     "at least two wavelengths, not 1"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' value='400:0.1, 500'/></bsdf>", 2, 22,
     "pairs such as 400:0.1, not '500'"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' value='400:0.1, 500:-1'/></bsdf>", 2, 22,
     "the value at 500 nm must not be negative"},
    {"<bsdf type='diffuse'><spectrum name='reflectance'/></bsdf>", 2, 22,
     "one of 'value', 'filename' and 'type'"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' type='d6'/></bsdf>", 2, 22, "did you mean 'd65'"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' type='blackbody'/></bsdf>", 2, 22,
     "it needs 'temperature'"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' type='uniform'><spectrum name='value' "
     "value='1'/></spectrum></bsdf>",
     2, 66, "<spectrum> cannot stand inside <spectrum>"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' type='irregular'><string name='values' "
     "value='1,2'/><string name='wavelengths' value='400'/></spectrum></bsdf>",
     2, 22, "it has 1 wavelengths and 2 values"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' filename='no.spd'/></bsdf>", 2, 22,
     "cannot find 'no.spd'"},
    {"<integrator type='moment'/>", 2, 1, "needs an <integrator> inside"},
    {"<emitter type='area' id='lamp'/>", 2, 1, "must stand inside a <shape>, or a shape refer to it"},
};

static void says_what_is_wrong(void **state) {
    (void)state;
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof bad_rows / sizeof bad_rows[0]; ++i) {
        const struct bad_row *const row = &bad_rows[i];
        aur_scene *scene = NULL;
        aur_error error = {0};
        const aur_result result = load_body(row->body, NULL, &scene, &error);
        if (result != AUR_OK && error.result == result && scene == NULL && error.line == row->line &&
            error.column == row->column && strstr(error.message, row->message) != NULL)
            continue;
        ++wrong;
        print_error("%s\n  gives %d at %zu:%zu: %s\n", row->body, result, error.line, error.column,
                    error.message);
    }
    assert_int_equal(wrong, 0);
}

/* Meshes that are made when first needed: the error quotes the command, wherever the folder was to be found.
 */
static void names_the_command_of_a_missing_mesh(void **state) {
    (void)state;
    char folder[128], text[512];
    snprintf(folder, sizeof folder, "%s/made", scene_folder);
    assert_int_equal(mkdir(folder, 0777), 0);
    write_text("made/HOW-TO-MAKE", "scripts/make-them.sh --all\nand more that is not quoted\n");
    static const char *const bodies[] = {
        "<shape type='ply'><string name='filename' value='made/hare.ply'/></shape>",
        "<path value='made'/><shape type='ply'><string name='filename' value='hare.ply'/></shape>",
        "<emitter type='envmap'><string name='filename' value='../%s/made/sky.exr'/></emitter>"};
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; ++i) {
        snprintf(text, sizeof text, bodies[i], strrchr(scene_folder, '/') + 1);
        aur_scene *scene = NULL;
        aur_error error = {0};
        assert_int_equal(load_body(text, NULL, &scene, &error), AUR_ERROR_OPEN);
        assert_non_null(
            strstr(error.message, "is made by the command: scripts/make-them.sh --all (looked in"));
    }
    /* a line that is no text is not quoted */
    write_file("made/HOW-TO-MAKE", "\x1b[2J", 4);
    aur_scene *scene = NULL;
    aur_error error = {0};
    assert_int_equal(load_body(bodies[0], NULL, &scene, &error), AUR_ERROR_OPEN);
    assert_null(strstr(error.message, "made by the command"));
}

/* `count` materials of which each one refers to the next; the last one is plain. */
static char *chain(size_t count) {
    char *const text = malloc(count * 64 + 64);
    char *end = text;
    for (size_t i = 0; i + 1 < count; ++i)
        end += sprintf(end, "<bsdf type='twosided' id='b%zu'><ref id='b%zu'/></bsdf>", i, i + 1);
    sprintf(end, "<bsdf type='diffuse' id='b%zu'/>", count - 1);
    return text;
}

static void refuses_long_chains(void **state) {
    (void)state;
    static const size_t counts[] = {100, 101, 20000};
    for (size_t i = 0; i < 3; ++i) {
        char *const text = chain(counts[i]);
        aur_scene *scene = NULL;
        aur_error error = {0};
        const aur_result result = load_body(text, NULL, &scene, &error);
        assert_int_equal(result, i == 0 ? AUR_OK : AUR_ERROR_FORMAT);
        assert_true(i == 0 || strstr(error.message, "in a chain of more than 100") != NULL);
        aur_scene_destroy(scene);
        free(text);
    }
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
static void loads_many_things_in_time(void **state) {
    (void)state;
    assert_true(
        seconds_to_load("", "<alias as='a%zu' id='a%zu'/>\n", 20000, "<bsdf type='diffuse' id='a0'/>") < 5.0);
    assert_true(seconds_to_load("<shape type='shapegroup'>",
                                "<shape type='sphere'><point name='center' value='%zu %zu 0'/></shape>\n",
                                30000, "</shape>") < 10.0);
}

static void refuses_bad_roots(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {"<scene><sensor type='perspective'/></scene>", "needs the attribute 'version'"},
        {"<scene version='3'/>", "version must be like 3.0.0, not '3'"},
        {"<shape type='cube'/>", "the first element must be <scene>, not <shape>"},
        {"", "no element found"},
        {"<scene version='3.0.0'><sensor type='perspectiv'/></scene>", "did you mean 'perspective'?"},
        {"<scene version='3.0.0'><sensor type='perspective'><sampler type='sobool'/></sensor></scene>",
         "unknown sampler 'sobool'; did you mean 'sobol'?"},
        {"<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='190'/></sensor></scene>",
         "'fov' must be between"},
        {"<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'><integer name='width' "
         "value='0'/></film></sensor></scene>",
         "'width' must be between 1 and 65536"},
        {"<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'><rfilter type='gausian'/>"
         "</film></sensor></scene>",
         "unknown rfilter 'gausian'; did you mean 'gaussian'?"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_scene *scene;
        aur_error error = {0};
        const aur_result result = aur_scene_load(write_text("r.xml", rows[i][0]), NULL, &scene, &error);
        if (result == AUR_OK || strstr(error.message, rows[i][1]) == NULL)
            fail_msg("%s\n  gives: %s", rows[i][0], error.message);
    }
    aur_scene *scene;
    aur_error error = {0};
    assert_int_equal(aur_scene_load("/nowhere/scene.xml", NULL, &scene, &error), AUR_ERROR_OPEN);
    assert_string_equal(error.file, "/nowhere/scene.xml");
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

/* Public scenes beside the project, where they are present. */
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
    aur_scene_describe(scene, &description, NULL);
    assert_int_equal(description.shapes, 8);
    assert_int_equal(description.triangles, 36);
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
    aur_scene *const scene =
        must_load_body("<shape type='ply'><string name='filename' value='c.ply'/></shape>"
                       "<shape type='obj'><string name='filename' value='c.obj'/></shape>");
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
    aur_scene_triangle(scene, 0, 1, &triangle); /* corners 0, 2, 3 */
    assert_near(triangle.texture[0].vertex_color.x, 1.0, 0.0);
    assert_near(triangle.texture[1].vertex_color.z, 1.0, 0.0);
    assert_near(triangle.texture[2].vertex_color.y, 0.5, 0.0);
    aur_scene_triangle(scene, 1, 0, &triangle); /* the third vertex has a weight and no colour: white */
    assert_near(triangle.texture[1].vertex_color.y, 1.0, 0.0);
    assert_near(triangle.texture[1].vertex_color.x, 0.0, 0.0);
    assert_near(triangle.texture[2].vertex_color.x, 1.0, 0.0);
    aur_scene_destroy(scene);
}

/* What is hashed must be what was read. */
static void changed_files_are_told(void **state) {
    (void)state;
    static const char triangle[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    write_text("changing.obj", triangle);
    aur_scene *const scene =
        must_load_body("<shape type='obj'><string name='filename' value='changing.obj'/></shape>");
    char *contents = NULL;
    aur_error error = {0};
    assert_int_equal(aur_scene_contents(scene, &contents, &error), AUR_OK);
    free(contents);
    struct stat status;
    const char *const path = write_text("changing.obj", "v 0 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\n");
    assert_int_equal(stat(path, &status), 0);
    const struct timespec later[2] = {{.tv_sec = status.st_mtim.tv_sec + 1},
                                      {.tv_sec = status.st_mtim.tv_sec + 1}};
    assert_int_equal(utimensat(AT_FDCWD, path, later, 0), 0);
    assert_int_equal(aur_scene_contents(scene, &contents, &error), AUR_ERROR_OPEN);
    assert_null(contents);
    assert_non_null(strstr(error.message, "changed since"));
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(changed_files_are_told),
        cmocka_unit_test(loads_a_small_scene),
        cmocka_unit_test(maps_samplers_to_sets),
        cmocka_unit_test(gives_default_materials),
        cmocka_unit_test(refers_to_parts),
        cmocka_unit_test(reads_colors_of_meshes),
        cmocka_unit_test(substitutes_names),
        cmocka_unit_test(includes_files),
        cmocka_unit_test(reads_old_versions),
        cmocka_unit_test(says_what_is_wrong),
        cmocka_unit_test(names_the_command_of_a_missing_mesh),
        cmocka_unit_test(refuses_bad_roots),
        cmocka_unit_test(loads_public_scenes),
        cmocka_unit_test(loads_bundled_scenes),
        cmocka_unit_test(refuses_long_chains),
        cmocka_unit_test(loads_many_things_in_time),
        cmocka_unit_test(loads_from_memory),
        cmocka_unit_test(ends_growth),
        cmocka_unit_test(finds_files_beside_the_scene),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
