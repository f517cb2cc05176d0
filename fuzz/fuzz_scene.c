/* Scene files: the tree of elements and the objects made of it, all but the ray-tracing structure. */
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "scene/scene_data.h"

static const char *input_path(void) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-scene-%ld.xml", (long)getpid());
    return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    FILE *const file = fopen(input_path(), "wb");
    fuzz_require(file != NULL && fwrite(data, 1, size, file) == size && fclose(file) == 0,
                 "cannot write the input");
    static const aur_definition definitions[] = {{"n", "3"}};
    const aur_scene_options options = {.definition_count = 1, .definitions = definitions};
    aur_error error = {0};
    aur_scene *const scene = calloc(1, sizeof *scene);
    fuzz_require(scene != NULL, "out of memory");
    aur_result result = aur_xml_read(input_path(), &options, &scene->document, &error);
    if (result == AUR_OK)
        result = aur_scene_build(scene, NULL, &error);
    unlink(input_path());
    if (result != AUR_OK) {
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
        fuzz_require(error.file[0] != '\0' || result == AUR_ERROR_MEMORY, "a failure without a place");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_ARGUMENT,
                     "a failure of the wrong kind");
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
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index >= sizeof seeds / sizeof seeds[0])
        return 0;
    const size_t size = strlen(seeds[index]);
    fuzz_require(size <= capacity, "a seed is too large");
    memcpy(data, seeds[index], size);
    return size;
}
