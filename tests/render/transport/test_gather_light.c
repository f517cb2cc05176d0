/* Renders that request the same photon map share it, and no others do. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "render/gather/plan.h"

enum { PHOTONS = 500 };

/* As many points as photons: a lattice whose second coordinate is multiplied by `factor`. */
static void write_points(const char *path, unsigned factor) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    for (unsigned i = 0; i < PHOTONS; ++i)
        fprintf(file, "%.9f,%.9f\n", (i + 0.5) / PHOTONS, (i * factor % PHOTONS + 0.5) / PHOTONS);
    fclose(file);
}

static const aur_irradiance_map *map_of(const aur_integrator_context *context, const char *path) {
    char set[1024];
    snprintf(set, sizeof set, "file:%s", path);
    aur_gather_settings p = AUR_GATHER_SETTINGS_INITIAL;
    p.diffuse_samples = p.glossy_samples = 4;
    p.photons = PHOTONS;
    p.photon_pattern = set;
    aur_gather_plan *plan;
    aur_error error = {0};
    if (aur_gather_plan_create(&p, NULL, context, &plan, &error) != AUR_OK)
        fail_msg("%s", error.message);
    const aur_irradiance_map *const map = plan->light.map;
    aur_gather_plan_destroy(plan);
    return map;
}

/* A file with other points is another set, whatever its name, and so are files whose long names differ only
 * at the end. */
static void maps_go_by_content(void **state) {
    (void)state;
    aur_scene *scene = NULL;
    assert_int_equal(aur_scene_load(AUR_SOURCE_DIR "/tests/render/driver/furnace.xml", NULL, &scene, NULL),
                     AUR_OK);
    aur_cache *const cache = aur_cache_create();
    assert_non_null(cache);
    const aur_integrator_context context = {
        .scene = scene, .samples_per_pixel = 1, .seed = 1, .threads = 1, .cache = cache};
    char folder[] = "/tmp/aureole-light-XXXXXX", first[512], second[512], dots[400] = "";
    assert_non_null(mkdtemp(folder));
    while (strlen(dots) < 320)
        strcat(dots, "./");
    snprintf(first, sizeof first, "%s/%sfirst.csv", folder, dots);
    snprintf(second, sizeof second, "%s/%ssecond.csv", folder, dots);
    write_points(first, 7);
    write_points(second, 11);
    const aur_irradiance_map *const map = map_of(&context, first);
    assert_non_null(map);
    assert_ptr_equal(map_of(&context, first), map);
    assert_ptr_not_equal(map_of(&context, second), map);
    write_points(first, 13);
    assert_ptr_not_equal(map_of(&context, first), map);
    write_points(first, 7);
    assert_ptr_equal(map_of(&context, first), map);
    unlink(first);
    unlink(second);
    rmdir(folder);
    aur_cache_destroy(cache);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(maps_go_by_content)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
