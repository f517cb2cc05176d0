/* Messages and locations for scenes that cannot be loaded. */
#include "scene_text.h"

#include <fcntl.h>
#include <sys/stat.h>

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

/* Errors in a file: the body, the location (line, column of scene.xml; the body is its second line), and a
 * part of the message. */
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
    {"<shape type='cube'><ref id='nix'/></shape>", 2, 20, "unknown id 'nix'"},
    {"<bsdf type='diffuse' id='white'/><shape type='cube'><ref id='whte'/></shape>", 2, 53,
     "did you mean 'white'?"},
    {"<bsdf type='twosided' id='a'><ref id='b'/></bsdf><bsdf type='twosided' id='b'><ref "
     "id='a'/></bsdf><shape "
     "type='cube'><ref id='a'/></shape>",
     2, 79, "a cycle"},
    {"<shape type='cube'><transform name='to_world'><scale value='0'/></transform></shape>", 2, 47,
     "<scale> must not be 0"},
    {"<shape type='cube'><transform name='to_world'><rotate angle='3'/></transform></shape>", 2, 47,
     "needs 'value' or 'x', 'y' and 'z'"},
    {"<shape type='cube'><transform name='to_world'><rotate angle='3' value='0 0 0'/></transform></shape>", 2,
     47, "the axis must not be 0 0 0"},
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
     2, 93, "takes shapes only"},
    {"<shape type='shapegroup'><bsdf type='diffuse'/></shape>", 2, 1, "needs a shape"},
    /* transforms and positions with which Embree would abort */
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
    {"<emitter type='directional'><vector name='direction' x='1e-13'/></emitter>", 2, 1, "or nearly 0"},
    {"<emitter type='area'/>", 2, 1, "must be inside a <shape>"},
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
    {"<alias id='q' as='r'/>", 2, 1, "unknown id 'q'"},
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
     2, 66, "<spectrum> is not allowed inside <spectrum>"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' type='irregular'><string name='values' "
     "value='1,2'/><string name='wavelengths' value='400'/></spectrum></bsdf>",
     2, 22, "it has 1 wavelengths and 2 values"},
    {"<bsdf type='diffuse'><spectrum name='reflectance' filename='no.spd'/></bsdf>", 2, 22,
     "cannot find 'no.spd'"},
    {"<integrator type='moment'/>", 2, 1, "needs an <integrator> inside"},
    {"<emitter type='area' id='lamp'/>", 2, 1, "must be inside a <shape>, or a shape must refer to it"},
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

/* Meshes that are generated on first use: the error quotes the command, wherever the folder was found. */
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

/* `count` materials, each of which refers to the next; the last one is plain. */
static char *chain(size_t count) {
    char *const text = malloc(count * 64 + 64);
    char *end = text;
    for (size_t i = 0; i + 1 < count; ++i)
        end += sprintf(end, "<bsdf type='twosided' id='b%zu'><ref id='b%zu'/></bsdf>", i, i + 1);
    sprintf(end, "<bsdf type='diffuse' id='b%zu'/><shape type='cube'><ref id='b0'/></shape>", count - 1);
    return text;
}

static void refuses_long_chains(void **state) {
    (void)state;
    static const size_t counts[] = {99, 100, 20000}; /* in a shape */
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

/* The hashed data must be the data that were read. */
static void changed_files_are_reported(void **state) {
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
        cmocka_unit_test(ends_growth),
        cmocka_unit_test(says_what_is_wrong),
        cmocka_unit_test(names_the_command_of_a_missing_mesh),
        cmocka_unit_test(refuses_long_chains),
        cmocka_unit_test(refuses_bad_roots),
        cmocka_unit_test(changed_files_are_reported),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
