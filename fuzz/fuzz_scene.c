/* Scene files: loads them and renders a few paths, which evaluates materials, textures and lights. Small
 * files exist for scenes to refer to. Two of three inputs may refer to no other files; inputs that contain $n
 * get a definition of it. */
#define _GNU_SOURCE /* memmem */
#include <aureole-render/render.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "render/scene/scene.h"
#include "render/scene/vol_file.h"

static const char *input_path(void) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-scene-%ld.xml", (long)getpid());
    return path;
}

/* Files of each kind that a scene may name. */
static void write_companions(void) {
    static const char *const files[][2] = {
        {"a.xml", "<scene version='3.0.0'><bsdf type='diffuse' id='included'/></scene>"},
        {"self.xml", "<scene version='3.0.0'><include filename='self.xml'/></scene>"},
        {"a.rad", "void plastic a 0 0 5 .5 .5 .5 0 0\na sphere s 0 0 4 1 2 3 .5\n"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "property float r\nproperty float g\nproperty float b\nelement face 1\nproperty uchar red\n"
         "property uchar green\nproperty uchar blue\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0 1 0 0\n1 0 0 0 1 0\n1 1 0 0 0 1\n255 51 0 3 0 1 2\n"},
        {"a.pfm", "Pf\n2 1\n-1\n\0\0\0?\0\0\0@"},
        {"a.hair", "# x y z radius\n-1 0 0 .5\n0 .2 0 .4\n1 0 0 .3\n2 .1 .1 .2\n\n0 -1 0 .3\n0 0 0 .3\n0 1 0 "
                   ".3\n0 2 0 .1\n"},
        {"far.hair", "3e17 0 0 1\n4e17 0 0 1\n"},
        {"none.hair", "# nothing\n"},
        {"a.spd", "# nm value\n400 .5\n500, 1\n\n700 .25\n"},
        {"bad.spd", "400 .5 x\n"},
        {"a.csv", "u,v\n0,0\n0.5,0.25\n"},
        {"HOW-TO-MAKE", "make the missing file\n"},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i)
        fuzz_write_file(files[i][0], (const uint8_t *)files[i][1],
                        strcmp(files[i][0], "a.pfm") == 0 ? 18 : strlen(files[i][1]));
    size_t size;
    char *const grid = vol_bytes(2, 1, 2, 1, (const float[4]){0.0f, 1.0f, 0.5f, 2.0f}, &size);
    fuzz_write_file("a.vol", (const uint8_t *)grid, size);
    free(grid);
}

/* The render may fail, because a scene may have settings that no sampler supports. The length of the input
 * selects the integrator. */
static void render(const aur_scene *scene, size_t size) {
    static const char *const integrators[] = {
        "path:max_depth=4",
        "direct",
        "path:max_depth=4,interleaved=true",
        "finalgather:photons=40,diffuse_samples=4,glossy_samples=4,max_depth=4",
        "radiosity:paths=16,gather_samples=4",
        "ao:samples=2",
        "aov:aovs=(n:sh_normal,u:uv)",
        "depth",
    };
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = aur_scene_has_media(scene) ? "volpath:max_depth=4"
                                                                                 : integrators[size % 8],
                                        .sampler = "random",
                                        .filter = "box",
                                        .samples_per_pixel = 1,
                                        .threads = 1,
                                        .width = 4,
                                        .height = 4,
                                        .crop_x1 = 4,
                                        .crop_y1 = 4};
    aur_renderer *renderer = NULL;
    aur_image *image = NULL;
    if (aur_renderer_create(scene, &renderer, NULL) == AUR_OK)
        aur_renderer_render(renderer, &options, &image, NULL, NULL);
    aur_image_destroy(image);
    aur_renderer_destroy(renderer);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static bool ready;
    if (!ready)
        write_companions();
    ready = true;
    fuzz_write_file(input_path(), data, size);
    static const aur_definition definitions[] = {{"n", "3"}};
    /* One input in sixteen gets a definition even if it does not use it. */
    const bool has_definition = size % 16 == 0 || memmem(data, size, "$n", 2) != NULL;
    const aur_scene_options options = {.size = sizeof options,
                                       .definition_count = has_definition,
                                       .definitions = definitions,
                                       .confine = size % 3 != 0};
    aur_error error = {0};
    aur_scene *scene = NULL;
    const aur_result result = aur_scene_load(input_path(), &options, &scene, &error);
    unlink(input_path());
    if (result != AUR_OK) {
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
        fuzz_require(error.file[0] != '\0' || result == AUR_ERROR_MEMORY, "a failure without a place");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_ARGUMENT,
                     "a failure of the wrong kind");
    } else {
        render(scene, size);
    }
    aur_scene_destroy(scene);
    return 0;
}

static const char *const seeds[] = {
    "<scene version='3.0.0'><default name='a' value='0.5'/><integrator type='path'><integer name='max_depth' "
    "value='$n'/></integrator><sensor type='perspective'><float name='fov' value='45'/><string "
    "name='fov_axis' "
    "value='smaller'/><transform name='to_world'><lookat origin='0,0,5' target='0 0 0' "
    "up='0,1,0'/></transform>"
    "<film type='hdrfilm'><integer name='width' value='32'/><rfilter type='gaussian'><float name='stddev' "
    "value='$a'/>"
    "</rfilter></film><sampler type='halton'><integer name='sample_count' value='4'/><string name='permute' "
    "value='random'/></sampler></sensor><shape type='cube'><transform name='to_world'><scale x='2'/><rotate "
    "y='1' "
    "angle='30'/><matrix value='1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1'/><translate value='1,2,3'/></transform>"
    "<ref id='m'/><emitter type='area'><rgb name='radiance' value='1, 2 3e-008'/></emitter></shape>"
    "<bsdf type='twosided' id='m'><bsdf type='phong'><float name='exponent' "
    "value='3'/></bsdf></bsdf></scene>",
    "<?xml version=\"1.0\" encoding=\"utf-8\"?><scene version=\"0.6.0\"><default name=\"n\" "
    "value=\"1\"/><sensor type=\"thinlens\"><float "
    "name=\"apertureRadius\" value=\"1\"/><float name=\"focusDistance\" value=\"2\"/><film "
    "type=\"ldrfilm\"><boolean "
    "name=\"banner\" value=\"false\"/></film></sensor><shape type=\"sphere\"><point name=\"center\" "
    "x=\"1\"/><float "
    "name=\"radius\" value=\"2\"/><bsdf type=\"roughplastic\"><texture type=\"checkerboard\" "
    "name=\"diffuseReflectance\"><float name=\"uscale\" value=\"3\"/></texture><string name=\"intIOR\" "
    "value=\"water\"/></bsdf></shape><emitter type=\"spot\"><transform name=\"toWorld\"><lookAt "
    "origin=\"0,1,0\" "
    "target=\"0,0,0\"/></transform></emitter><emitter type=\"constant\"/><alias id=\"q\" as=\"r\"/><bsdf "
    "type=\"mask\" id=\"q\"><bsdf type=\"roughconductor\"><string name=\"material\" "
    "value=\"Au\"/></bsdf></bsdf>"
    "<shape type=\"cylinder\"><ref id=\"r\"/></shape><shape type=\"disk\"><bsdf "
    "type=\"roughdielectric\"/></shape>"
    "<!-- a comment --></scene>",
    "<!DOCTYPE scene [<!ENTITY a \"3.0.0\">]><scene version='&a;'><default name='n' value='2'/><path "
    "value='.'/>"
    "<sensor type='orthographic'/><shape type='rectangle' id='s'><emitter type='area'><texture "
    "type='checkerboard' "
    "name='radiance'><rgb name='color0' value='$n'/></texture></emitter></shape><emitter "
    "type='directional'><vector "
    "name='direction' x='0' y='0' z='1'/></emitter><bsdf type='dielectric'><string name='int_ior' "
    "value='diamond'/>"
    "<float name='ext_ior' value='1.1'/></bsdf><bsdf type='thindielectric'/><bsdf type='plastic'/></scene>",
    "<scene version='3.0.0'><sensor type='perspective'/><emitter type='sky'><string name='model' "
    "value='perez'/><float name='direct_normal' value='500'/><string name='date' value='2026-06-21'/><float "
    "name='latitude' value='48'/><vector name='up' value='0 0 1'/><float name='ground_albedo' "
    "value='.2'/></emitter><emitter type='sun'><vector name='sun_direction' value='1 2 $n'/><float "
    "name='half_angle' value='5'/></emitter><shape type='polygon'><string name='vertices' value='0 0 0 4 0 0 "
    "4 "
    "4 0 2 1 0 0 4 0'/><bsdf type='glass'><rgb name='transmissivity' value='.9 .8 .7'/></bsdf></shape><shape "
    "type='disk'><float name='inner_radius' value='.5'/></shape></scene>",
    "<scene version='3.0.0'><sensor type='perspective'/><emitter type='sky'><string name='model' "
    "value='cie'/><string name='coefficients' value='-1 -.3 10 -3 .4'/><vector name='sun_direction' value='1 "
    "2 "
    "3'/><float name='zenith_luminance' value='9000'/></emitter></scene>",
    "<scene version='3.0.0'><medium type='homogeneous' id='m'><rgb name='albedo' value='.9 .5 0'/><rgb "
    "name='sigma_t' value='.5 1 $n'/><float name='scale' value='2'/><phase type='blendphase'><float "
    "name='weight' value='.3'/><phase type='hg'><float name='g' value='-.5'/></phase><phase "
    "type='tabphase'><string name='values' value='1 0 2'/></phase></phase></medium><sensor "
    "type='perspective'><ref id='m'/></sensor><shape type='cube'><bsdf type='null'/><ref name='interior' "
    "id='m'/><medium name='exterior' type='heterogeneous'><volume type='constvolume' name='sigma_t'><float "
    "name='value' value='.1'/></volume></medium></shape><emitter type='constant'/><emitter "
    "type='point'><point "
    "name='position' z='3'/></emitter></scene>",
    /* Regression: a texture was taken for a bsdf of the same id. */
    "<scene version='3.0.0'><sensor type='perspective'/><shape type='sphere'><point name='center' "
    "z='$n'/><texture "
    "type='checkerboard' name='bsdf'/></shape><emitter type='constant'/></scene>",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return fuzz_text_seed(sizeof seeds / sizeof seeds[0], seeds, index, capacity, data);
}
