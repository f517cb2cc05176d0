/* Radiosity solutions of a scene of 12 triangles. The hash at their end is corrected before they are read, so
 * that damaged data reach the later checks. */
#include "render/radiosity/solution.h"

#include "words.h"

enum { MAGIC_LENGTH = 20 };

static const char *path_of(const char *kind) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-radiosity-%ld.%s", (long)getpid(), kind);
    return path;
}

static aur_scene *load_room(void) {
    static const char text[] = "<scene version='3.0.0'><shape type='cube'><boolean name='flip_normals' "
                               "value='true'/><bsdf type='diffuse'/>"
                               "<emitter type='area'/></shape><sensor type='perspective'><float name='fov' "
                               "value='45'/></sensor></scene>";
    aur_scene *scene = NULL;
    fuzz_write_file(path_of("xml"), (const uint8_t *)text, strlen(text));
    fuzz_require(aur_scene_load(path_of("xml"), NULL, &scene, NULL) == AUR_OK, "the scene cannot be loaded");
    unlink(path_of("xml"));
    return scene;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_scene *const scene = load_room();
    uint8_t *const copy = fuzz_copy(data, size);
    if (size > MAGIC_LENGTH)
        fuzz_correct_hash(copy + MAGIC_LENGTH, size - MAGIC_LENGTH);
    fuzz_write_file(path_of("rad"), copy, size);
    free(copy);
    aur_radiosity *radiosity = NULL;
    aur_error error = {0};
    const aur_result result = aur_radiosity_load(scene, path_of("rad"), NULL, &radiosity, &error);
    unlink(path_of("rad"));
    fuzz_require((result == AUR_OK) == (radiosity != NULL), "a failure with a solution, or none without");
    if (result == AUR_OK) {
        /* Evaluating it must be safe whatever values it has. */
        aur_radiosity_description description = {.size = sizeof description};
        aur_radiosity_triangle_result results[12];
        aur_radiosity_get_description(radiosity, &description, NULL);
        fuzz_require(description.triangles == 12, "triangles that the scene does not have");
        fuzz_require(aur_radiosity_get_results(radiosity, 12, sizeof *results, results, NULL) == AUR_OK,
                     "no results");
    } else {
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
        fuzz_require(result != AUR_ERROR_INTERNAL, "a failure of the wrong kind");
    }
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
    return 0;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index >= 2)
        return 0;
    aur_scene *const scene = load_room();
    aur_radiosity_options options = {.size = sizeof options};
    aur_radiosity_options_init(&options, NULL);
    options.scramble = AUR_SCRAMBLE_OWEN;
    options.randomizations = index + 1;
    aur_radiosity *radiosity = NULL;
    fuzz_require(aur_radiosity_create(scene, &options, &radiosity, NULL) == AUR_OK &&
                     aur_radiosity_trace(radiosity, 16, NULL) == AUR_OK &&
                     aur_radiosity_save(radiosity, path_of("rad"), NULL) == AUR_OK,
                 "no seed");
    aur_radiosity_destroy(radiosity);
    aur_scene_destroy(scene);
    FILE *const file = fopen(path_of("rad"), "rb");
    fuzz_require(file != NULL, "no seed");
    const size_t size = fread(data, 1, capacity, file);
    fclose(file);
    unlink(path_of("rad"));
    return size;
}
