/* Photon maps in the format of the cache. A hash protects entries against damage; a malicious entry with a
 * correct hash must not cause out-of-bounds accesses. */
#include <aureole-render/scene.h>

#include "fuzz.h"
#include "render/photons/irradiance.h"

static aur_scene *load_room(void) {
    static const char text[] =
        "<scene version='3.0.0'><shape type='cube'><boolean name='flip_normals' value='true'/>"
        "<bsdf type='phong'/><emitter type='area'/></shape><shape type='sphere'><float name='radius' "
        "value='.4'/></shape></scene>";
    aur_scene *scene = NULL;
    fuzz_require(aur_scene_load_memory("room.xml", strlen(text), text, NULL, &scene, NULL) == AUR_OK,
                 "the scene cannot be loaded");
    return scene;
}

/* Looks up at the hit points of rays in all directions. */
static void look_up_all(const aur_irradiance_map *map, const aur_scene *scene) {
    for (size_t i = 0; i < 64; ++i) {
        const float z = 1.0f - (float)(2 * i + 1) / 64.0f, r = sqrtf(1.0f - z * z);
        const float turn = 2.4f * (float)i;
        const aur_ray ray = {.origin = {0.6f, 0.0f, 0.0f},
                             .direction = {r * cosf(turn), r * sinf(turn), z},
                             .farthest = INFINITY};
        aur_hit hit;
        if (!aur_scene_intersect(scene, &ray, &hit))
            continue;
        aur_surface surface;
        aur_scene_surface(scene, &ray, &hit, &surface);
        const aur_texel_view light =
            aur_irradiance_view(map, scene, &hit, &surface, aur_vector_scale(ray.direction, -1.0f));
        (void)light;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_scene *const scene = load_room();
    aur_irradiance_map *const map = aur_irradiance_map_unpack(scene, size, data);
    if (map != NULL) {
        look_up_all(map, scene);
        size_t packed;
        void *const bytes = aur_irradiance_map_pack(map, &packed);
        fuzz_require(packed == size && memcmp(bytes, data, size) == 0, "what is packed again is another map");
        free(bytes);
    }
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
    return 0;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index > 1)
        return 0;
    aur_scene *const scene = load_room();
    aur_irradiance_map *map = NULL;
    const aur_irradiance_map_options options = {
        .photons = {.count = 20 + 60 * index, .max_edges = 4, .threads = 1}, .photons_a_texel = 4.0};
    fuzz_require(aur_irradiance_map_create(scene, &options, &map, NULL) == AUR_OK, "no map");
    size_t size;
    void *const bytes = aur_irradiance_map_pack(map, &size);
    fuzz_require(bytes != NULL && size <= capacity, "a seed is too large");
    memcpy(data, bytes, size);
    free(bytes);
    aur_irradiance_map_destroy(map);
    aur_scene_destroy(scene);
    return size;
}
