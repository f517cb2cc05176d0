/* Choosing light sources by a light tree against uniform choice: relative error at equal sample counts, and
 * cost. Rooms with many light sources are rendered both ways with two seeds. Also time and memory of large
 * trees. */
#include <aureole-render/render.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "error_pattern.h"
#include "points/base/random.h"
#include "render/scene/scene_data.h"

enum { WIDTH = 96, HEIGHT = 64, SAMPLES = 64, LIGHTS = 400, MOST_LIGHTS = 10000 };

static const char room[] =
    "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='70'/><transform "
    "name='to_world'><lookat origin='9,1.7,9' target='-3,.8,-3' up='0,1,0'/></transform></sensor>"
    "<bsdf type='diffuse' id='wall'><rgb name='reflectance' value='.7'/></bsdf>"
    "<shape type='cube'><transform name='to_world'><scale x='10' y='1.5' z='10'/><translate y='1.5'/>"
    "</transform><boolean name='flip_normals' value='true'/><ref id='wall'/></shape>";

static double unit(uint64_t a, uint64_t b) {
    return aur_unit_double(aur_hash2(a, b));
}

/* Light sources below the ceiling in rows, or at random positions and orientations. */
static void write_light(FILE *file, size_t i, size_t count, bool rows) {
    const double side = ceil(sqrt((double)count)), step = 20.0 / side;
    const double x = rows ? -10.0 + step * ((double)(i % (size_t)side) + 0.5) : 19.8 * unit(i, 1) - 9.9;
    const double z = rows ? -10.0 + step * ((double)(i / (size_t)side) + 0.5) : 19.8 * unit(i, 2) - 9.9;
    const double y = rows ? 2.99 : 0.5 + 2.4 * unit(i, 3);
    fprintf(file,
            "<shape type='rectangle'><transform name='to_world'><scale value='%g'/><rotate x='1' "
            "angle='%g'/><rotate y='1' angle='%g'/><translate x='%g' y='%g' z='%g'/></transform>"
            "<emitter type='area'><rgb name='radiance' value='%g'/></emitter></shape>\n",
            rows ? 0.05 * step : 0.03, rows ? 90.0 : 360.0 * unit(i, 4), rows ? 0.0 : 360.0 * unit(i, 5), x,
            y, z, 10.0 * (0.5 + unit(i, 6)));
}

/* A box that stands for furniture. */
static void write_box(FILE *file, size_t i) {
    const double height = 0.2 + 0.4 * unit(i, 11);
    fprintf(file,
            "<shape type='cube'><transform name='to_world'><scale x='%g' y='%g' z='%g'/><rotate y='1' "
            "angle='%g'/><translate x='%g' y='%g' z='%g'/></transform><ref id='wall'/></shape>\n",
            0.2 + 0.6 * unit(i, 12), height, 0.2 + 0.6 * unit(i, 13), 90.0 * unit(i, 14),
            18.0 * unit(i, 15) - 9.0, height, 18.0 * unit(i, 16) - 9.0);
}

static aur_scene *load_room(size_t lights, bool rows, aur_error *error) {
    char *text = NULL;
    size_t size = 0;
    aur_scene *scene = NULL;
    FILE *const file = open_memstream(&text, &size);
    if (file == NULL)
        return NULL;
    fputs(room, file);
    for (size_t i = 0; i < 40; ++i)
        write_box(file, i);
    for (size_t i = 0; i < lights; ++i)
        write_light(file, i, lights, rows);
    fputs("</scene>\n", file);
    if (fclose(file) == 0)
        aur_scene_load_memory("room.xml", size, text, NULL, &scene, error);
    free(text);
    return scene;
}

/* Disables the tree: every light source has the same probability. */
static bool choose_uniformly(aur_scene *scene) {
    const size_t count = scene->emitter_count;
    double *const ones = malloc(count * sizeof *ones);
    aur_light_choice_release(&scene->choice);
    for (size_t i = 0; i < count && ones != NULL; ++i) {
        ones[i] = 1.0;
        scene->emitters[i]->first_leaf = AUR_WHOLE_LIGHT;
        scene->emitters[i]->probability = 1.0f / (float)count;
    }
    const bool good =
        ones != NULL && aur_distribution_create(&scene->choice.emitters, count, ones, NULL) == AUR_OK;
    free(ones);
    return good;
}

/* The relative root mean square error of an image, and its CPU seconds. */
typedef struct lit_error {
    double error, seconds;
} lit_error;

static bool measure(const aur_scene *scene, const char *integrator, bool quick, lit_error *found,
                    aur_error *error) {
    aur_image *images[2] = {NULL, NULL};
    aur_renderer *renderer = NULL;
    aur_render_options options = {.size = sizeof options,
                                  .integrator = integrator,
                                  .filter = "box",
                                  .threads = 1,
                                  .width = quick ? WIDTH / 4 : WIDTH,
                                  .height = quick ? HEIGHT / 4 : HEIGHT,
                                  .samples_per_pixel = quick ? 4 : SAMPLES};
    bool good = aur_renderer_create(scene, &renderer, error) == AUR_OK;
    const double begin = bench_cpu_seconds();
    for (size_t i = 0; i < 2 && good; ++i) {
        options.seed = i + 1;
        good = aur_renderer_render(renderer, &options, &images[i], NULL, error) == AUR_OK;
    }
    found->seconds = 0.5 * (bench_cpu_seconds() - begin);
    error_pattern pattern = {.width = options.width, .height = options.height};
    good = good && error_pattern_open(options.width, options.height, aur_image_channel_count(images[0]),
                                      aur_image_data(images[0]), aur_image_data(images[1]), &pattern);
    double squares = 0.0, sum = 0.0;
    for (size_t i = 0; i < 3 * options.width * options.height && good; ++i) {
        squares += 0.5 * pattern.differences[i] * pattern.differences[i];
        sum += (double)aur_image_data(images[0])[i / 3 * aur_image_channel_count(images[0]) + i % 3];
    }
    found->error = sqrt(squares * 3.0 * (double)(options.width * options.height)) / sum;
    error_pattern_close(&pattern);
    aur_renderer_destroy(renderer);
    aur_image_destroy(images[0]);
    aur_image_destroy(images[1]);
    return good;
}

static bool compare(const bench_options *options, bool rows, aur_error *error) {
    static const char *const integrators[] = {"path:max_depth=2,hide_emitters=true",
                                              "path:max_depth=6,hide_emitters=true"};
    aur_scene *const tree = load_room(LIGHTS, rows, error), *const even = load_room(LIGHTS, rows, error);
    bool good = tree != NULL && even != NULL && choose_uniformly(even);
    for (size_t i = 0; i < sizeof integrators / sizeof integrators[0] && good; ++i) {
        lit_error by_tree, evenly;
        good = measure(tree, integrators[i], options->quick, &by_tree, error) &&
               measure(even, integrators[i], options->quick, &evenly, error);
        if (good)
            printf("%d lights %s, %s: error %.3g %% by the tree, %.3g %% evenly, ratio %.3f; CPU time %.2f "
                   "times\n",
                   LIGHTS, rows ? "in rows" : "anywhere", integrators[i], 100.0 * by_tree.error,
                   100.0 * evenly.error, by_tree.error / evenly.error, by_tree.seconds / evenly.seconds);
    }
    aur_scene_destroy(tree);
    aur_scene_destroy(even);
    return good;
}

static void create_again(void *context) {
    aur_scene *const scene = context;
    aur_light_choice_release(&scene->choice);
    bench_keep(aur_light_choice_create(scene, NULL) == AUR_OK ? 1.0 : 0.0);
}

static bool build(const bench_options *options, aur_error *error) {
    const size_t count = options->quick ? LIGHTS : MOST_LIGHTS;
    aur_scene *const scene = load_room(count, false, error);
    if (scene == NULL)
        return false;
    char name[64];
    snprintf(name, sizeof name, "a tree of %zu lights", count);
    const bench_work work = {.run = create_again, .context = scene, .units = (double)count};
    bench_print_seconds(options, name, &work);
    const aur_light_tree *const tree = &scene->choice.tree;
    printf("%s: %zu nodes, %.0f bytes a light\n", name, tree->node_count,
           (double)(tree->node_count * sizeof *tree->nodes +
                    tree->child_count *
                        (sizeof *tree->targets + sizeof tree->children / sizeof(float *) * sizeof(float))) /
                   (double)count +
               sizeof *tree->leaves + sizeof *scene->choice.parts);
    aur_scene_destroy(scene);
    return true;
}

static bool run(const bench_options *options) {
    aur_error error = {0};
    return (compare(options, true, &error) && compare(options, false, &error) && build(options, &error)) ||
           bench_fail("%s", error.message);
}

const bench bench_lights = {"lights", "a choice of lights by a tree against an even one", run};
